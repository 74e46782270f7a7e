"""The crate kiri: structs and methods as Rust has them, over those of kiri-sys."""

import re

import naming
from rust_raw import NUMBERS, escaped

# By hand in lib.rs, for what they lend or take outlives the call.
BY_HAND = {"kiriDefaultWorldDef", "kiriCreateWorld", "kiriDestroyWorld", "kiriWorld_GetLastError", "kiriWorld_Replay",
           "kiriWorld_GetEvents", "kiriSheet_CopyVertices", "kiriGetVersion", "kiriDefaultDebugDraw",
           "kiriWorld_DebugDraw"}
STRUCTS_BY_HAND = {"kiriWorldDef", "kiriReplay", "kiriEvent"}
CONSTANTS = {"kiriBudgetLimit", "kiriNoteLimit"}
# Counts that say something by themselves too, where their pointer is null.
OWN_COUNTS = {"kiriSheetDef.frameCount"}
# Where there may be nothing: the field that says so, below zero.
MISSES = {"kiriHit": "triangle"}

HEAD = """// Made from kiri.h by `make bindings`.

use crate::{check, check_read, fail, text, view, Result, Status, World};
use kiri_sys as sys;
use std::mem::{align_of, offset_of, size_of, MaybeUninit};
use std::num::NonZeroU32;
"""


def snake_field(name):
    return "kind" if name == "type" else naming.snake(name)


def raw_field(name):
    return "type_" if name == "type" else name


class Safe:
    def __init__(self, description):
        self._d = description
        self._structs = {struct["name"]: struct for struct in description["structs"]}
        self._enums = {enum["name"]: enum for enum in description["enums"]}
        self._ids = {kind["name"] for kind in description["ids"]}
        self._docs = self._rules_for_docs()

    def text(self):
        parts = [HEAD, *map(self._id, self._d["ids"]), *map(self._enum, self._d["enums"])]
        for struct in self._d["structs"]:
            if struct["name"] in STRUCTS_BY_HAND or self._is_hosted(struct["name"]):
                continue
            parts.append(self._plain(struct) if self._is_plain(struct) else self._converted(struct))
        parts.append(self._events())
        classes = {}
        for function in self._d["functions"]:
            if function["name"] not in BY_HAND and not function["name"].startswith("kiriDefault"):
                classes.setdefault(function["class"], []).append(self._function(function))
        for name, methods in classes.items():
            body = "\n\n".join(methods)
            parts.append(f"impl {name} {{\n{body}\n}}\n" if name else body + "\n")
        return "\n".join(parts)

    # ---- Comments

    def _rules_for_docs(self):
        """Names of C, as they are here."""
        names = {}
        for function in self._d["functions"]:
            if function["name"] in BY_HAND or function["name"].startswith("kiriDefault"):
                continue
            method = self._method(function)
            names[function["name"]] = f"[`{function['class']}::{method}`]" if function["class"] else f"[`{method}`]"
        names.update({name: f"[`{naming.bare(name)}`]" for name in self._structs if not self._is_hosted(name)})
        for enum in self._d["enums"]:
            if enum["name"] in CONSTANTS:
                continue
            if naming.is_flags(enum):
                names.update({value["name"]: f"[`{value['name'][5:]}`]" for value in enum["values"]})
                continue
            names.update({value["name"]: f"[`{naming.bare(enum['name'])}::{self._variant(enum, value)}`]"
                          for value in self._values(enum)})
        fields = {field["name"] for struct in self._d["structs"] for field in struct["fields"]}
        fields |= {parameter["name"] for function in self._d["functions"] for parameter in function["parameters"]}
        names.update({name: f"`{naming.snake(name)}`" for name in fields if naming.snake(name) != name})
        names.update({"kiriWorld_Tick": "[`World::tick`]", "kiriCreateWorld": "[`World::new`]",
                      "kiriWorld_GetEvents": "[`World::events`]", "kiriSheet_CopyVertices": "[`Sheet::copy_vertices`]",
                      "kiriDebugDraw": "[`DebugDraw`]", "kiriWorld_DebugDraw": "[`World::debug_draw`]",
                      "kiriWorld_Replay": "[`Replay`]", "kiriEvent": "[`Event`]", "kiriReplay": "[`Replay`]"})
        return names

    def _doc(self, doc, start, name=None):
        """Where C has no comment, the words of the name."""
        if not doc and name:
            doc = naming.snake(name).replace("_", " ").capitalize() + "."
        doc = re.sub(r"\w+", lambda match: self._docs.get(match[0], match[0]), re.sub(r"`(\w+)`", r"\1", self._plainer(doc)))
        return naming.wrapped(doc, start)

    @staticmethod
    def _plainer(doc):
        return re.sub(r"([*\[\]<>])", r"\\\1", doc)

    # ---- Ids, enums

    def _id(self, kind):
        name = naming.bare(kind["name"])
        return (f"/// An id. It is of one world, and may be of something that is gone: then calls give\n"
                f"/// [`ResultCode::ErrorId`].\n"
                f"#[repr(transparent)]\n#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]\n"
                f"pub struct {name}(NonZeroU32);\n\n"
                f"impl {name} {{\n"
                f"    /// Of a number that is an id of C; `None` for 0.\n"
                f"    pub fn from_raw(id: u32) -> Option<Self> {{\n        NonZeroU32::new(id).map(Self)\n    }}\n\n"
                f"    pub(crate) fn known(id: u32) -> Self {{\n"
                f"        Self::from_raw(id).expect(\"the library gives an id\")\n    }}\n\n"
                f"    /// As C has it.\n    pub fn raw(self) -> u32 {{\n        self.0.get()\n    }}\n}}\n")

    @staticmethod
    def _values(enum):
        return [value for value in enum["values"] if not value["name"].endswith("_COUNT")]

    @staticmethod
    def _variant(enum, value):
        return naming.pascal(naming.constant(enum, value))

    def _enum(self, enum):
        name = naming.bare(enum["name"])
        if enum["name"] in CONSTANTS:
            return "".join("\n".join([*self._doc(value["doc"], "/// ", value["name"][5:].lower()),
                                      f"pub const {value['name'][5:]}: i32 = {value['value']};\n"]) for value in enum["values"])
        if naming.is_flags(enum):
            lines = self._doc(enum["doc"], "// ")
            for value in enum["values"]:
                lines += self._doc(value["doc"], "/// ", value["name"][5:].lower())
                lines.append(f"pub const {value['name'][5:]}: u32 = {value['value']};")
            return "\n".join(lines + [""])
        lines = self._doc(enum["doc"], "/// ", naming.bare(enum["name"]))
        lines += ["#[non_exhaustive]", "#[repr(i32)]", "#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]", f"pub enum {name} {{"]
        for value in self._values(enum):
            lines += self._doc(value["doc"], "    /// ", naming.constant(enum, value).lower())
            lines.append(f"    {self._variant(enum, value)} = {value['value']},")
        lines += ["}", "", f"impl {name} {{", f"    /// All of them.", f"    pub const ALL: [Self; {len(self._values(enum))}] = ["]
        lines += [f"        Self::{self._variant(enum, value)}," for value in self._values(enum)]
        lines += ["    ];", "", "    /// Of a number of C.", "    pub fn from_raw(value: i32) -> Option<Self> {",
                  "        Self::ALL.into_iter().find(|known| *known as i32 == value)", "    }", "",
                  "    #[allow(dead_code)]", "    pub(crate) fn known(value: i32) -> Self {",
                  "        Self::from_raw(value).expect(\"the library gives what its header has\")", "    }", "}", ""]
        return "\n".join(lines)

    # ---- Structs

    def _is_hosted(self, name):
        return any(field["form"] == "callback" for field in self._structs[name]["fields"])

    def _is_plain(self, struct):
        """Laid out as in C, so that views need no copies."""
        return all(field["form"] in ("number", "id", "struct") and not field.get("flag") and not field.get("enum")
                   and field["name"] != "cookie"
                   and not (field["form"] == "id" and not field.get("none"))
                   and not (field["form"] == "struct" and not self._is_plain(self._structs[field["type"]]))
                   for field in struct["fields"])

    def _lends(self, struct):
        return any(field["form"] == "pointer" or field["form"] == "struct" and self._lends(self._structs[field["type"]])
                   for field in struct["fields"])

    def _of_number(self, kind):
        return NUMBERS[self._d["aliases"].get(kind, kind)]

    def _rows(self, field):
        kind = naming.bare(field["type"]) if field["type"] in self._ids else self._of_number(field["type"])
        return kind if field["width"] == 1 else f"[{kind}; {field['width']}]"

    def _field_type(self, struct, field):
        if field["form"] == "pointer":
            rows = f"&'a [{self._rows(field)}]"
            optional = field["nullable"] and (f"{struct['name']}.{field['length']}" in OWN_COUNTS or "default" not in struct)
            return f"Option<{rows}>" if optional else rows
        if field["form"] == "struct":
            inner = self._structs[field["type"]]
            return naming.bare(field["type"]) + ("<'a>" if self._lends(inner) else "")
        if field["form"] == "id":
            name = naming.bare(field["type"])
            return f"Option<{name}>" if field.get("none") else name
        if field.get("enum"):
            return naming.bare(field["enum"])
        if field.get("flag"):
            return "bool"
        kind = self._of_number(field["type"])
        return f"[{kind}; {field['count']}]" if "count" in field else kind

    def _plain(self, struct):
        name, default = naming.bare(struct["name"]), "" if "default" in struct else ", Default"
        lines = self._doc(struct["doc"], "/// ", naming.bare(struct["name"]))
        lines += ["#[repr(C)]", f"#[derive(Clone, Copy, Debug, PartialEq{default})]", f"pub struct {name} {{"]
        for field in struct["fields"]:
            lines += self._doc(field["doc"], "    /// ", field["name"])
            lines.append(f"    pub {snake_field(field['name'])}: {self._field_type(struct, field)},")
        lines += ["}", "", "const _: () = {",
                  f"    assert!(size_of::<{name}>() == size_of::<sys::{struct['name']}>());",
                  f"    assert!(align_of::<{name}>() == align_of::<sys::{struct['name']}>());"]
        lines += [f"    assert!(offset_of!({name}, {snake_field(field['name'])}) == "
                  f"offset_of!(sys::{struct['name']}, {raw_field(field['name'])}));" for field in struct["fields"]]
        lines += ["};", "", f"impl {name} {{",
                  f"    #[allow(dead_code)]", f"    pub(crate) fn from_raw(raw: &sys::{struct['name']}) -> Self {{",
                  f"        // SAFETY: the layout is the same, and any bits are a value of each field.",
                  f"        unsafe {{ *std::ptr::from_ref(raw).cast() }}", "    }", "",
                  f"    #[allow(dead_code)]", f"    pub(crate) fn raw(&self) -> sys::{struct['name']} {{",
                  f"        // SAFETY: as above.", f"        unsafe {{ *std::ptr::from_ref(self).cast() }}", "    }", "}", ""]
        return "\n".join(lines)

    def _converted(self, struct):
        name, lends, default = naming.bare(struct["name"]), self._lends(struct), struct.get("default")
        of, of_any = ("<'a>", "<'_>") if lends else ("", "")
        counts = {field["length"] for field in struct["fields"] if field["form"] == "pointer"}
        counts = {count for count in counts if f"{struct['name']}.{count}" not in OWN_COUNTS and default}
        fields = [field for field in struct["fields"] if field["name"] not in counts
                  and not (field["name"] == "cookie" and default)]
        lines = self._doc(struct["doc"], "/// ", naming.bare(struct["name"]))
        lines += ["#[derive(Clone, Copy, Debug)]", f"pub struct {name}{of} {{"]
        for field in fields:
            lines += self._doc(field["doc"], "    /// ", field["name"])
            public = "" if field["name"] == "cookie" else "pub "
            lines.append(f"    {public}{snake_field(field['name'])}: {self._field_type(struct, field)},")
        lines += ["}", ""]
        if default:
            lines += [f"impl Default for {name}{of_any} {{", "    fn default() -> Self {",
                      "        Self::from_raw(&Self::default_raw())", "    }", "}", ""]
        lines += [f"impl{of} {name}{of} {{"]
        if default:
            lines += [f"    fn default_raw() -> sys::{struct['name']} {{",
                      f"        let mut raw = MaybeUninit::<sys::{struct['name']}>::uninit();",
                      "        // SAFETY: it fills all of the struct.", f"        unsafe {{",
                      f"            sys::{default}(raw.as_mut_ptr());", "            raw.assume_init()", "        }", "    }", ""]
        lines += ["    #[allow(dead_code)]", f"    pub(crate) fn from_raw(raw: &sys::{struct['name']}) -> Self {{", "        Self {"]
        lines += [f"            {snake_field(field['name'])}: {self._taken(struct, field)}," for field in fields]
        lines += ["        }", "    }"]
        if self._goes_in(struct["name"]):
            start = "Self::default_raw()" if default else None
            lines += ["", f"    pub(crate) fn raw(&self) -> sys::{struct['name']} {{"]
            if start:
                lines.append(f"        let mut raw = {start};")
                for field in fields:
                    lines += self._put(struct, field)
                lines.append("        raw")
            else:
                lines.append(f"        sys::{struct['name']} {{")
                lines += [f"            {raw_field(field['name'])}: {self._given(field)}," for field in fields]
                lines.append("        }")
            lines.append("    }")
        return "\n".join(lines + ["}", ""])

    def _goes_in(self, name):
        if any(p["type"] == name and p["direction"] != "out" for f in self._d["functions"] for p in f["parameters"]):
            return True
        return any(field["type"] == name and self._goes_in(struct["name"])
                   for struct in self._d["structs"] for field in struct["fields"])

    def _taken(self, struct, field):
        raw = f"raw.{raw_field(field['name'])}"
        if field["form"] == "pointer":
            rows = f"unsafe {{ view({raw}, raw.{field['length']}) }}"
            return rows if not self._field_type(struct, field).startswith("Option") else \
                f"(!{raw}.is_null()).then(|| {rows})"
        if field["form"] == "struct":
            return f"{naming.bare(field['type'])}::from_raw(&{raw})"
        if field["form"] == "id":
            return f"{naming.bare(field['type'])}::{'from_raw' if field.get('none') else 'known'}({raw})"
        if field.get("enum"):
            return f"{naming.bare(field['enum'])}::known({raw})"
        return f"{raw} != 0" if field.get("flag") else raw

    def _given(self, field):
        name = f"self.{snake_field(field['name'])}"
        if field["form"] == "struct":
            return f"{name}.raw()"
        if field["form"] == "id":
            return f"{name}.map_or(0, |id| id.raw())" if field.get("none") else f"{name}.raw()"
        if field.get("enum"):
            return f"{name} as i32"
        return f"i32::from({name})" if field.get("flag") else name

    def _put(self, struct, field):
        raw, name = f"raw.{raw_field(field['name'])}", f"self.{snake_field(field['name'])}"
        if field["form"] != "pointer":
            return [f"        {raw} = {self._given(field)};"]
        if self._field_type(struct, field).startswith("Option"):
            return [f"        if let Some(rows) = {name} {{", f"            {raw} = rows.as_ptr().cast();",
                    f"            raw.{field['length']} = rows.len() as i32;", "        }"]
        empty = "std::ptr::null()" if field["nullable"] else None
        pointer = f"{name}.as_ptr().cast()"
        if empty:
            pointer = f"if {name}.is_empty() {{ {empty} }} else {{ {pointer} }}"
        return [f"        {raw} = {pointer};", f"        raw.{field['length']} = {name}.len() as i32;"]

    # ---- Events

    def _events(self):
        enum, struct = self._enums["kiriEventType"], self._structs["kiriEvent"]
        fields = {field["name"]: field for field in struct["fields"]}
        lines = self._doc(enum["doc"], "/// ") + ["#[non_exhaustive]", "#[derive(Clone, Copy, Debug, PartialEq)]",
                                                  "pub enum Event {"]
        arms = []
        for value in enum["values"]:
            used, variant = self._d["eventFields"][value["name"]], self._variant(enum, value)
            lines += self._doc(value["doc"], "    /// ", naming.constant(enum, value).lower()) + [f"    {variant} {{"]
            for name in used:
                field = fields[name]
                kind = naming.bare(field["type"]) if field["form"] == "id" else self._field_type(struct, field)
                lines += [*self._doc("" if field["doc"] == "0: none" else field["doc"], "        /// ", name), f"        {snake_field(name)}: {kind},"]
            lines.append("    },")
            taken = ", ".join(f"{snake_field(name)}: {self._of_event(fields[name])}" for name in used)
            arms.append(f"            EventType::{variant} => Self::{variant} {{ {taken} }},")
        lines += ["}", "", "impl Event {", "    pub(crate) fn from_raw(raw: &sys::kiriEvent) -> Self {",
                  "        match EventType::known(raw.type_) {", *arms, "        }", "    }", "}", ""]
        return "\n".join(lines)

    @staticmethod
    def _of_event(field):
        raw = f"raw.{raw_field(field['name'])}"
        if field["form"] == "id":
            return f"{naming.bare(field['type'])}::known({raw})"
        if field.get("enum"):
            return f"{naming.bare(field['enum'])}::known({raw})"
        return f"{raw} != 0" if field.get("flag") else raw

    # ---- Functions

    @staticmethod
    def _method(function):
        return naming.snake(re.sub(r"^Get(?=[A-Z])", "", function["method"]))

    def _function(self, function):
        return "\n".join(Call(self, function).lines())


class Call:
    """One function: what it takes, what is called, what it gives."""

    def __init__(self, safe, function):
        self._s, self._f = safe, function
        self._takes, self._before, self._arguments, self._outs, self._after = [], [], [], [], []
        self._counts = {p["length"] for p in function["parameters"] if p["form"] in ("array", "bytes", "view", "strided")
                        and isinstance(p["length"], str)}
        self._growing = "capacity" in self._counts
        self._total = next((p["name"] for p in function["parameters"] if p["direction"] == "out"
                            and p["name"] in ("count", "size")), None)
        self._unsafe = any(p["type"] in safe._structs and safe._is_hosted(p["type"]) for p in function["parameters"])
        for i, parameter in enumerate(function["parameters"]):
            self._parameter(i, parameter)

    def lines(self):
        f, of = self._f, self._f["class"]
        pad = "    " if of else ""
        lines = self._s._doc(f["doc"], pad + "/// ")
        if self._unsafe:
            lines += [pad + "///", pad + "/// # Safety", pad + "///", pad + "/// The functions that it is given are called within."]
        if len(self._takes) > 6:
            lines.append(pad + "#[allow(clippy::too_many_arguments)]")
        changes = "mut " if f.get("changes") else ""
        receiver = {None: [], "World": [f"&{changes}self"]}.get(of, ["self", f"world: &{changes}World"])
        must = pad + "#[must_use]\n" if not f["returns"] == "kiriResult" else ""
        lines.append(f"{must}{pad}pub {'unsafe ' if self._unsafe else ''}fn {self._s._method(f)}("
                     f"{', '.join(receiver + self._takes)}) -> {self._returned()} {{")
        lines += [pad + "    " + line for line in self._body()]
        return lines + [pad + "}"]

    # ---- Parameters

    def _parameter(self, i, p):
        name, kind = naming.snake(p["name"]), p["form"]
        if kind == "world":
            changes = self._f.get("changes")
            holder = "self" if self._f["class"] == "World" else "world"
            self._arguments.append(f"{holder}.{'raw_mut' if changes else 'raw'}()")
        elif kind == "id" and p["direction"] == "in" and i == 1 and self._f["class"] == naming.bare(p["type"]):
            self._arguments.append("self.raw()")
        elif p["name"] in self._counts and p["direction"] == "in":
            self._arguments.append(f"capacity as {self._s._of_number(p['type'])}" if p["name"] == "capacity" else
                                   f"{self._source(p['name'])}.len() as {self._s._of_number(p['type'])}")
        elif p["name"] == self._total and (self._growing or p["name"] in self._counts):
            self._before.append(f"let mut {name} = 0;")
            self._arguments.append(f"&mut {name}")
        else:
            getattr(self, f"_{p['direction']}_{kind}")(p, name)

    def _source(self, count):
        """The slice whose length is that count."""
        p = next(p for p in self._f["parameters"] if p.get("length") == count)
        return naming.snake(p["name"])

    def _in_number(self, p, name):
        if p.get("enum"):
            self._takes.append(f"{name}: {naming.bare(p['enum'])}")
            self._arguments.append(f"{name} as i32")
        else:
            self._takes.append(f"{name}: {self._s._of_number(p['type'])}")
            self._arguments.append(name)

    def _in_id(self, p, name):
        kind = naming.bare(p["type"])
        self._takes.append(f"{name}: Option<{kind}>" if p.get("nullable") else f"{name}: {kind}")
        self._arguments.append(f"{name}.map_or(0, |id| id.raw())" if p.get("nullable") else f"{name}.raw()")

    def _in_struct(self, p, name):
        if self._s._is_hosted(p["type"]):
            self._takes.append(f"{name}: &sys::{p['type']}")
            self._arguments.append(name)
            return
        kind = naming.bare(p["type"]) + ("<'_>" if self._s._lends(self._s._structs[p["type"]]) else "")
        if p.get("nullable"):
            self._takes.append(f"{name}: Option<&{kind}>")
            self._before.append(f"let {name} = {name}.map(|{name}| {name}.raw());")
            self._arguments.append(f"{name}.as_ref().map_or(std::ptr::null(), |{name}| {name})")
        else:
            self._takes.append(f"{name}: &{kind}")
            self._arguments.append(f"&{name}.raw()")

    def _inout_struct(self, p, name):
        self._takes.append(f"{name}: &mut {naming.bare(p['type'])}")
        self._arguments.append(f"std::ptr::from_mut({name}).cast()")

    def _element(self, p):
        if p["type"] in self._s._ids or p["type"] in self._s._structs:
            kind = naming.bare(p["type"])
        else:
            kind = self._s._of_number(p["type"])
        width = p.get("width") or self._width_of_field(p)
        return kind if width == 1 else f"[{kind}; {width}]"

    def _width_of_field(self, p):
        """Of an array that goes into a field of a struct."""
        return next(field["width"] for struct in self._s._d["structs"] for field in struct["fields"]
                    if field["name"] == p["name"] and "width" in field)

    def _in_array(self, p, name):
        if isinstance(p["length"], int):
            kind = f"[{self._s._of_number(p['type'])}; {p['length']}]"
            takes = f"impl Into<{kind}>" if p["length"] in (2, 3, 9) else kind  # vectors and matrices of other crates, too
            self._takes.append(f"{name}: Option<{kind}>" if p["nullable"] else f"{name}: {takes}")
            if not p["nullable"] and takes != kind:
                self._before.append(f"let {name}: {kind} = {name}.into();")
            self._arguments.append(f"{name}.as_ref().map_or(std::ptr::null(), |rows| rows.as_ptr())" if p["nullable"]
                                   else f"{name}.as_ptr()")
        else:
            self._takes.append(f"{name}: &[{self._element(p)}]")
            self._arguments.append(f"{name}.as_ptr().cast()")

    def _in_bytes(self, p, name):
        self._takes.append(f"{name}: &[u8]")
        self._arguments.append(f"{name}.as_ptr().cast()")

    def _out_number(self, p, name):
        kind = self._s._of_number(p["type"])
        self._before.append(f"let mut {name}: {kind} = Default::default();")
        self._arguments.append(f"&mut {name}")
        self._outs.append(("bool", f"{name} != 0") if p.get("flag") else (kind, name))

    def _out_id(self, p, name):
        kind, none = naming.bare(p["type"]), p.get("none")
        self._before.append(f"let mut {name} = 0;")
        self._arguments.append(f"&mut {name}")
        self._outs.append((f"Option<{kind}>", f"{kind}::from_raw({name})") if none else (kind, f"{kind}::known({name})"))

    def _out_struct(self, p, name):
        struct = self._s._structs[p["type"]]
        life = ("<'_>" if self._f["class"] else "<'static>") if self._s._lends(struct) else ""
        self._before.append(f"let mut {name} = MaybeUninit::<sys::{p['type']}>::uninit();")
        self._arguments.append(f"{name}.as_mut_ptr()")
        self._after.append(f"// SAFETY: it filled the struct.")
        self._after.append(f"let {name} = unsafe {{ {name}.assume_init() }};")
        kind = naming.bare(p["type"])
        self._outs.append((f"{kind}{life}", f"{kind}::from_raw(&{name})"))

    def _out_view(self, p, name):
        self._before.append(f"let mut {name} = std::ptr::null();")
        self._arguments.append(f"&mut {name}")
        self._outs.append((f"&[{self._element(p)}]", f"unsafe {{ view({name}, {p['length']}) }}"))

    def _out_bytes(self, p, name):
        self._before.append(f"let mut {name} = Vec::<u8>::new();")
        self._arguments.append(f"if capacity == 0 {{ std::ptr::null_mut() }} else {{ {name}.as_mut_ptr().cast() }}")
        self._outs.append(("Vec<u8>", name))

    def _out_array(self, p, name):
        if isinstance(p["length"], int):
            kind = f"[{self._s._of_number(p['type'])}; {p['length']}]"
            self._before.append(f"let mut {name}: {kind} = Default::default();")
            self._arguments.append(f"{name}.as_mut_ptr()")
            self._outs.append((kind, name))
        elif p["length"] == "capacity":
            self._before.append(f"let mut {name} = Vec::<{self._element(p)}>::new();")
            self._arguments.append(f"{name}.as_mut_ptr().cast()")
            self._outs.append((f"Vec<{self._element(p)}>", name))
        elif re.fullmatch(r"\w+", p["length"]):
            self._out_array_of_length(p, name)
        else:
            self._out_array_of_term(p, name)

    def _out_array_of_length(self, p, name):
        source = next(q for q in self._f["parameters"] if q.get("length") == p["length"])
        if source is p:
            self._takes.append(f"{name}: &mut [{self._element(p)}]")
        else:  # an id or none for each
            self._before.append(f"let mut {name} = vec![None::<{self._element(p)}>; {naming.snake(source['name'])}.len()];")
            self._outs.append((f"Vec<Option<{self._element(p)}>>", name))
        self._arguments.append(f"{name}.as_mut_ptr().cast()")

    def _out_array_of_term(self, p, name):
        width = self._width_of_field(p)
        term = re.sub(r"[a-z]\w*", lambda match: f"{naming.snake(match[0])}.clamp(0, 4096) as usize", p["length"])
        self._before.append(f"let mut {name} = vec![[{self._s._of_number(p['type'])}::default(); {width}]; ({term}) / {width}];")
        self._arguments.append(f"{name}.as_mut_ptr().cast()")
        self._outs.append((f"Vec<{self._element(p)}>", name))

    # ---- What it does

    def _returned(self):
        if self._f["returns"] == "const char*":
            return "&'static str"
        return f"Result<{self._given()[0]}>"

    def _given(self):
        """The type, and the value."""
        outs = list(self._outs)
        miss = next((MISSES[p["type"]] for p in self._f["parameters"] if p["type"] in MISSES), None)
        if miss:
            outs = [(kind.replace("Option<", "").rstrip(">") if i + 1 < len(outs) else kind,
                     value.replace("::from_raw(", "::known(") if i + 1 < len(outs) else value)
                    for i, (kind, value) in enumerate(outs)]
        kinds, values = [kind for kind, _ in outs], [value for _, value in outs]
        if self._f.get("pends") and not outs:
            return "Status", "Status::of(result)"
        kind, value = ("()", "()") if not kinds else (kinds[0], values[0]) if len(kinds) == 1 else \
            (f"({', '.join(kinds)})", f"({', '.join(values)})")
        if miss:
            name = naming.snake(next(p["name"] for p in self._f["parameters"] if p["type"] in MISSES))
            return f"Option<{kind}>", f"({name}.{miss} >= 0).then(|| {value})"
        return kind, value

    def _body(self):
        call = f"sys::{self._f['name']}({', '.join(self._arguments)})"
        if self._f["returns"] == "const char*":
            return ["// SAFETY: texts of the library stay.", f"unsafe {{ text({call}) }}"]
        of = self._f["class"]
        named = f"{of}::{self._s._method(self._f)}" if of else self._s._method(self._f)
        checked = "fail({}, \"NAMED\")?" if of is None else "check_read({}, \"NAMED\")?" if not self._f.get("changes") else \
            f"check({{}}, {'self' if of == 'World' else 'world'}, \"NAMED\")?"
        checked = checked.replace("NAMED", named)
        call = checked.format(f"unsafe {{ {call} }}")
        if self._growing:
            return self._growing_body(call)
        gives = "let result = " if "Status" == self._given()[0] else ""
        lines = [*self._before, "// SAFETY: pointers are to what is named, and lengths are theirs.", f"{gives}{call};",
                 *self._after]
        return lines + [f"Ok({self._given()[1]})"]

    def _growing_body(self, call):
        """Asks how many there are, then takes them."""
        arrays = [name for kind, name in self._outs if kind.startswith("Vec")]
        lines = [*self._before, "let mut capacity = 0;", "loop {",
                 "    // SAFETY: the arrays have room for so many.", f"    {call};",
                 f"    let needed = {self._total} as usize;", "    if needed <= capacity {",
                 *[f"        unsafe {{ {name}.set_len(needed) }};" for name in arrays], "        break;", "    }",
                 "    capacity = needed;", *[f"    {name}.reserve_exact(capacity);" for name in arrays], "}"]
        return lines + [f"Ok({self._given()[1]})"]
