"""Makes bindings/javascript/kiri.js and kiri.d.ts: classes over the exports of kiri.wasm. runtime.js is by hand."""

import re
import textwrap

import typescript

FOLDER = "bindings/javascript"
# Of a world def, what only threads and memory outside of WebAssembly would use; hooks are set by runtime.js.
HIDDEN = {"kiriWorldDef": {"alloc", "free", "log", "clock", "startTask", "finishTask", "workerCount", "user", "record"},
          "kiriDebugDraw": {"points", "lines", "triangles", "user"}}
# Functions that the host gives by these names.
HOOKS = {"kiriWorldDef": ["log", "clock", "record"], "kiriDebugDraw": ["points", "lines", "triangles"]}
ARRAYS = {"float": "Float32Array", "double": "Float64Array", "int32_t": "Int32Array", "uint32_t": "Uint32Array",
          "uint16_t": "Uint16Array"}
HEAPS = {"float": ("F32", 2), "double": ("F64", 3), "int32_t": ("I32", 2), "uint32_t": ("U32", 2),
         "uint64_t": ("U64", 3)}
SIZES = {"float": 4, "double": 8, "int32_t": 4, "uint32_t": 4, "uint16_t": 2, "int64_t": 8, "uint64_t": 8}


def camel(name):
    return name[0].lower() + name[1:]


def pascal(name):
    return "".join(part.capitalize() for part in name.split("_"))


def short(name):
    """kiriSheetDef: SheetDef."""
    return name[4:]


def value_names(enum):
    return [(pascal(value["name"][len(enum["prefix"]):]), value) for value in enum["values"]]


class Maker:
    def __init__(self, description):
        self.all = description
        self.ids = [i["name"] for i in description["ids"]]
        self.aliases = description["aliases"]
        self.structs = {s["name"]: s for s in description["structs"]}
        self.functions = description["functions"]
        # Structs that the host gives, and those that it gets.
        self.given, self.got = set(), set()
        for function in self.functions:
            for p in function["parameters"]:
                if p["type"] in self.structs:
                    self._reach(p["type"], self.given if p["direction"] != "out" else self.got)
                    if p["direction"] == "inout" or "default" in self.structs[p["type"]]:
                        self._reach(p["type"], self.got)

    def _reach(self, name, found):
        found.add(name)
        for field in self.structs[name]["fields"]:
            if field["form"] == "struct":
                self._reach(field["type"], found)

    def number(self, type_name):
        return self.aliases.get(type_name, type_name)

    def fields(self, struct):
        return [f for f in struct["fields"] if f["name"] not in HIDDEN.get(struct["name"], ())]

    @staticmethod
    def shows(struct):
        return any(f["form"] == "pointer" and f.get("length") and f["type"] != "void" for f in struct["fields"])

    # ---- Enums and layouts

    def enums(self):
        for enum in self.all["enums"]:
            if len(enum["values"]) == 1:
                value = enum["values"][0]
                yield f"export const {value['name'][5:]} = {value['value']};"
                continue
            values = ", ".join(f"{name}: {value['value']}" for name, value in value_names(enum))
            yield from self.wrap(f"export const {short(enum['name'])} = enumeration({{ {values} }});")

    @staticmethod
    def wrap(line, indent=0):
        return textwrap.wrap(line, 118, initial_indent=" " * indent, subsequent_indent=" " * (indent + 4),
                             break_long_words=False, break_on_hyphens=False)

    def layouts(self):
        yield "/** Bytes of structs in the memory of WebAssembly, and where their fields are: for calls of `wasm`. */"
        yield "export const layouts = {"
        for struct in self.all["structs"]:
            fields = ", ".join(f"{f['name']}: {f['offset']['wasm32']}" for f in struct["fields"])
            yield from self.wrap(f"{struct['name']}: {{ size: {struct['size']['wasm32']}, fields: {{ {fields} }} }},", 4)
        yield "};"

    # ---- Structs

    def struct_class(self, struct):
        name = short(struct["name"])
        shows = self.shows(struct) and struct["name"] not in self.given
        yield f"export class {name}{' extends Shown' if shows else ''} {{"
        for f in self.fields(struct):
            if f["form"] == "pointer" and shows:
                continue
            yield f"    {f['name']} = {self.initial(f)};"
        for f in self.fields(struct):
            if f["form"] == "pointer" and shows:
                count = f"this.{f['length']}" if f["width"] == 1 else f"{f['width']} * this.{f['length']}"
                yield ""
                yield f"    get {f['name']}() {{"
                yield f"        return this._view(\"{f['name']}\", \"{ARRAYS[self.number(f['type'])]}\", {count});"
                yield "    }"
        yield "}"

    def initial(self, f):
        if f["form"] == "struct":
            return f"new {short(f['type'])}()"
        if f["form"] in ("pointer", "id"):
            return "null"
        value = "0n" if f["type"] == "uint64_t" else "false" if f.get("flag") else "0"
        return f"[{', '.join([value] * f['count'])}]" if "count" in f else value

    def reader(self, struct):
        shows = self.shows(struct) and struct["name"] not in self.given
        yield f"function read{short(struct['name'])}(o, at, world) {{"
        if shows:
            yield "    o._show(world);"
        for f in self.fields(struct):
            yield "    " + self.read_field(f, shows)
        yield "    return o;"
        yield "}"

    def read_field(self, f, shows):
        name, at = f["name"], f"at + {f['offset']['wasm32']}" if f["offset"]["wasm32"] else "at"
        if f["form"] == "struct":
            return f"read{short(f['type'])}(o.{name}, {at}, world);"
        if f["form"] == "id":
            return f"o.{name} = thing({short(f['type'])}, world, U32[({at}) >> 2], o.{name});"
        if f["form"] == "pointer":
            if shows:
                return f"o._at.{name} = U32[({at}) >> 2];"
            if f["type"] == "void":
                return f"o.{name} = bytesAt(U32[({at}) >> 2], I32[({self.at(f['struct'], f['length'])}) >> 2]);"
            return f"o.{name} = null;"
        if self.number(f["type"]) == "int64_t":
            return f"o.{name} = int64({at});"
        heap, shift = HEAPS[self.number(f["type"])]
        if "count" in f:
            return f"fill({heap}, ({at}) >> {shift}, o.{name});"
        value = f"{heap}[({at}) >> {shift}]"
        return f"o.{name} = {value}{' !== 0' if f.get('flag') else ''};"

    def at(self, struct, field):
        return f"at + {next(f for f in self.structs[struct]['fields'] if f['name'] == field)['offset']['wasm32']}"

    def writer(self, struct):
        """Only what the host gave; the rest stays as the default function, or zeros, have it."""
        name = short(struct["name"])
        counted = {f["length"] for f in struct["fields"] if f["form"] == "pointer" and f.get("length")}
        allowed = [f["name"] for f in self.fields(struct)] + HOOKS.get(struct["name"], [])
        yield from self.wrap(f"const fieldsOf{name} = new Set([{', '.join(repr(n)[1:-1].join(chr(34) * 2) for n in allowed)}]);")
        yield ""
        yield f"function write{name}(o, at, world) {{"
        yield f"    known(o, fieldsOf{name}, \"{name}\");"
        for f in self.fields(struct):
            if f["name"] in counted and f["name"] != "frameCount":
                continue
            if f["form"] == "pointer" and (f["type"] == "void" or not f.get("length")):
                continue
            yield from self.write_field(struct, f)
        yield "}"

    def write_field(self, struct, f):
        name, at = f["name"], f"at + {f['offset']['wasm32']}" if f["offset"]["wasm32"] else "at"
        given = f"o.{name}"
        if f["form"] == "pointer":
            count = self.at(struct["name"], f["length"])
            body = [f"U32[({at}) >> 2] = putRows(\"{ARRAYS[f['type']]}\", {given}, {f['width']}, \"{name}\");",
                    f"I32[({count}) >> 2] = {given}.length / {f['width']};"]
        elif f["form"] == "struct":
            body = [f"write{short(f['type'])}({given}, {at}, world);"]
        elif f["form"] == "id":
            body = [f"U32[({at}) >> 2] = idOf({given}, world);"]
        elif "count" in f:
            body = [f"put(\"{ARRAYS[self.number(f['type'])]}\", {at}, {given}, {f['count']}, \"{name}\");"]
        elif self.number(f["type"]) in ("int64_t", "uint64_t"):
            body = [f"U64[({at}) >> 3] = BigInt({given});"]
        else:
            heap, shift = HEAPS[self.number(f["type"])]
            body = [f"{heap}[({at}) >> {shift}] = {given};"]
        test = f"{given} != null" if f["form"] == "pointer" else f"{given} !== undefined"
        yield f"    if ({test}) {{"
        yield from (f"        {line}" for line in body)
        yield "    }"

    # ---- Functions

    def call(self, function):
        return Call(self, function)


class Call:
    """One function: arguments of JavaScript, what is done before and after the call, and what comes back."""

    def __init__(self, maker, function):
        self.maker, self.function = maker, function
        self.arguments, self.before, self.c, self.after, self.results = [], [], [], [], []
        self.takes = False  # memory that is given back
        self.two = None  # (arrays, count) of a call that is made twice: how many, then which
        self.into = None
        self.room = 0
        self.world = "this.world" if function["class"] not in (None, "World") else "this"
        parameters = function["parameters"]
        self.lengths = {p["length"] for p in parameters if p["form"] in ("array", "bytes") and
                        isinstance(p.get("length"), str) and (p["direction"] == "in" or p["length"] == "capacity")}
        self.lengths |= {p["length"] for p in parameters if p["form"] == "view"}
        self.lengths |= {"capacity"} & {p["name"] for p in parameters}
        for i, p in enumerate(parameters):
            if p["form"] == "world":
                self.c.append("$world")
            elif i == 1 and p["form"] == "id" and function["class"] not in (None, "World"):
                self.c.append("this.id")
            else:
                getattr(self, f"{p['direction']}_{p['form']}")(p)

    def keep(self, size):
        """Room in the scratch memory."""
        at = self.room
        self.room += (size + 7) // 8 * 8
        return f"scratch + {at}" if at else "scratch"

    # Arguments.

    def in_number(self, p):
        if p["name"] in self.lengths:
            owner = next((q for q in self.function["parameters"] if q.get("length") == p["name"]
                          and q["direction"] == "in" and q["form"] in ("array", "bytes")), None)
            if owner:
                rows = f"{owner['name']}.length" + (f" / {owner['width']}" if owner.get("width", 1) > 1 else "")
                self.c.append(f"BigInt({rows})" if p["type"] == "int64_t" else rows)
            else:
                self.c.append("$capacity")
            return
        self.arguments.append(p["name"] + (" = 0" if p.get("optional") else ""))
        if any(q.get("stride") == p["name"] for q in self.function["parameters"]):
            self.arguments[-1] += " = 12"
            self.c.append("12")  # rows go to the host's strides after the call
            return
        big = p["type"] in ("int64_t", "uint64_t")
        self.c.append(f"BigInt({p['name']})" if big else p["name"])

    def in_id(self, p):
        self.arguments.append(p["name"] + (" = null" if p.get("nullable") else ""))
        self.c.append(f"idOf({p['name']}, {self.world})")

    def in_struct(self, p):
        struct, name = self.maker.structs[p["type"]], p["name"]
        self.arguments.append(name + (" = null" if p["nullable"] else ""))
        at = self.keep(struct["size"]["wasm32"])
        start = (f"wasm.{struct['default']}({at});" if "default" in struct
                 else f"U8.fill(0, {at}, {at} + {struct['size']['wasm32']});")
        world = self.world if self.function["class"] else "null"
        lines = [start, f"write{short(p['type'])}({name}, {at}, {world});"]
        if p["type"] == "kiriDebugDraw":
            lines.append(f"setDraw({name}, {at});")
        self.takes |= any(f["form"] == "pointer" and f.get("length") for f in struct["fields"])
        if p["nullable"]:
            lines = [f"if ({name}) {{"] + [f"    {line}" for line in lines] + ["}"]
        self.before += lines
        self.c.append(f"{name} ? {at} : 0" if p["nullable"] else at)

    def inout_struct(self, p):
        self.in_struct(p)
        at = self.c[-1]
        self.after.append(f"read{short(p['type'])}({p['name']}, {at}, {self.world if self.function['class'] else 'null'});")

    def in_array(self, p):
        name, type_name = p["name"], p["type"]
        self.arguments.append(name + (" = null" if p["nullable"] else ""))
        if isinstance(p["length"], int):
            size = SIZES[type_name] * p["length"]
            at = self.keep(size)
            line = f"put(\"{ARRAYS[type_name]}\", {at}, {name}, {p['length']}, \"{name}\")"
            self.c.append(f"{name} ? {line} : 0" if p["nullable"] else line)
            return
        self.takes = True
        if type_name in self.maker.structs:
            struct = self.maker.structs[type_name]
            size = struct["size"]["wasm32"]
            self.before += [f"const ${name} = take({size} * {name}.length);",
                            f"U8.fill(0, ${name}, ${name} + {size} * {name}.length);",
                            f"for (let i = 0; i < {name}.length; i++) {{",
                            f"    write{short(type_name)}({name}[i], ${name} + {size} * i, {self.world});", "}"]
        elif type_name in self.maker.ids:
            self.before += [f"const ${name} = take(4 * {name}.length);",
                            f"for (let i = 0; i < {name}.length; i++) {{",
                            f"    U32[(${name} >> 2) + i] = idOf({name}[i], {self.world});", "}"]
        else:
            self.before.append(f"const ${name} = putRows(\"{ARRAYS[type_name]}\", {name}, {p['width']}, \"{name}\");")
        self.c.append(f"${name}")

    def in_bytes(self, p):
        self.takes = True
        self.arguments.append(p["name"])
        self.before.append(f"const ${p['name']} = putRows(\"Uint8Array\", {p['name']}, 1, \"{p['name']}\");")
        self.c.append(f"${p['name']}")

    # Results.

    def out_number(self, p):
        type_name = self.maker.number(p["type"])
        at = self.keep(8)
        self.c.append(at)
        if type_name == "int64_t":
            value = f"int64({at})"
        else:
            heap, shift = HEAPS[type_name]
            value = f"{heap}[({at}) >> {shift}]" + (" !== 0" if p.get("flag") else "")
        if p["name"] in self.lengths or p["name"] == "size" or (self.two and p["name"] == "count"):
            self.count = value
        else:
            self.results.append((p["name"], value))

    def out_id(self, p):
        at = self.keep(8)
        self.c.append(at)
        self.results.append((p["name"], f"thing({short(p['type'])}, {self.world}, U32[({at}) >> 2])"))

    def out_struct(self, p):
        at = self.keep(self.maker.structs[p["type"]]["size"]["wasm32"])
        self.into = f"into = new {short(p['type'])}()"
        self.c.append(at)
        world = self.world if self.function["class"] else "null"
        self.results.append((p["name"], f"read{short(p['type'])}(into, {at}, {world})"))

    def out_array(self, p):
        name, type_name = p["name"], self.maker.number(p["type"])
        array = ARRAYS[type_name]
        if isinstance(p["length"], int):
            at = self.keep(SIZES[type_name] * p["length"])
            self.c.append(at)
            self.results.append((name, f"copy(\"{array}\", {at}, {p['length']})"))
            return
        self.takes = True
        if p["length"] == "capacity":
            self.two = True
            self.before.append(f"const ${name} = take({SIZES[type_name] * p['width']} * $capacity);")
            count = "$capacity"
        else:
            count = p["length"]
            owner = next((q for q in self.function["parameters"] if q.get("length") == count and q["direction"] == "in"), None)
            count = f"{owner['name']}.length" if owner else count
            width = p.get("width", 1)
            count = f"{width} * {count}" if width > 1 else f"{count}"
            self.before.append(f"const ${name} = take({SIZES[type_name]} * {count});")
        self.c.append(f"${name}")
        if p["length"] == "capacity" and p["width"] > 1:
            count = f"{p['width']} * {count}"
        if p["type"] in self.maker.ids:
            self.results.append((name, f"things({short(p['type'])}, {self.world}, ${name}, {count})"))
        else:
            self.results.append((name, f"copy(\"{array}\", ${name}, {count})"))

    def out_bytes(self, p):
        self.takes, self.two = True, True
        self.before.append(f"const ${p['name']} = take($capacity);")
        self.c.append(f"${p['name']}")
        self.results.append((p["name"], f"copy(\"Uint8Array\", ${p['name']}, $capacity)"))

    def out_strided(self, p):
        self.takes = True
        name = p["name"]
        self.arguments.append(f"{name} = null")
        self.before.append(f"const ${name} = {name} ? take(12 * count) : 0;")
        self.c.append(f"${name}")
        self.after += [f"if ({name}) {{", f"    scatter(${name}, {name}, {p['stride']}, count);", "}"]

    def out_view(self, p):
        at = self.keep(4)
        self.c.append(at)
        start, count = f"U32[({at}) >> 2]", "$count"
        type_name = p["type"]
        if type_name in self.maker.structs:
            size = self.maker.structs[type_name]["size"]["wasm32"]
            made = f"new Rows({self.world}, {start}, {count}, {size}, {short(type_name)}, read{short(type_name)})"
        elif type_name in self.maker.ids:
            made = f"things({short(type_name)}, {self.world}, {start}, {count})"
        else:
            length = f"{p['width']} * {count}" if p["width"] > 1 else count
            made = f"new View({self.world}, \"{ARRAYS[type_name]}\", {start}, {length})"
        self.view = True
        self.results.append((p["name"], made))

    # The text.

    @property
    def name(self):
        return camel(self.function["method"])

    def text(self):
        f, maker = self.function, self.maker
        arguments = list(self.arguments) + ([self.into] if self.into else [])
        takes_world = "$world" in self.c
        static = f["class"] is None
        lines = []
        if takes_world:
            lines.append(f"const $world = pointer({self.world});")
        called = f"wasm.{f['name']}({', '.join(self.c)})"
        if f["returns"] == "void":
            body = [called + ";"]
        elif f["returns"] == "const char*":
            body = [f"return string({called});"]
        elif f["returns"] != "kiriResult":
            body = [f"return {called};"]
        else:
            body = self.checked(called, static)
        if self.takes:
            body = ["try {"] + [f"    {line}" for line in body] + ["} finally {", "    release();", "}"]
        head = f"export function {camel(f['method'])}" if static else f"{self.name}"
        yield f"{head}({', '.join(arguments)}) {{"
        for line in lines + body:
            yield f"    {line}"
        yield "}"

    def checked(self, called, static):
        of = "" if static else f"{self.function['class']}."
        fail = f"fail({'null' if static else self.world}, $result, \"{of}{camel(self.function['method'])}\");"
        check = ["if ($result < 0) {", f"    {fail}", "}"]
        body = []
        if self.function["name"] in ("kiriWorld_Tick", "kiriWorld_FinishCuts", "kiriWorld_Load", "kiriWorld_Restore",
                                     "kiriWorld_Replay"):
            body.append("this._epoch++;")
        if self.two:
            outs = {f"${p['name']}" for p in self.function["parameters"]
                    if p["direction"] == "out" and p["form"] in ("array", "bytes") and p.get("length") == "capacity"}
            bytes_ = any(p["form"] == "bytes" and p["direction"] == "out" for p in self.function["parameters"])
            zero = "0n" if bytes_ else "0"
            first = [("0" if bytes_ else "scratch + 2048") if c in outs else zero if c == "$capacity" else c
                     for c in self.c]
            again = ["BigInt($capacity)" if c == "$capacity" and bytes_ else c for c in self.c]
            name = f"wasm.{self.function['name']}"
            early = [line for line in self.before if not any(line.startswith(f"const {out} ") for out in outs)]
            late = [line for line in self.before if line not in early]
            body += early + [f"let $result = {name}({', '.join(first)});"] + check
            body += [f"const $capacity = {self.count};"] + late
            body += [f"$result = {name}({', '.join(again)});"] + check
        else:
            body += self.before + [f"const $result = {called};"] + check
        body += self.after
        if getattr(self, "view", False):
            body.append(f"const $count = {self.count};")
        if not self.results:
            body.append("return $result;")
        elif len(self.results) == 1:
            body.append(f"return {self.results[0][1]};")
        else:
            body.append(f"return {{ {', '.join(f'{name}: {value}' for name, value in self.results)} }};")
        return body


DEFAULTS = """export function {function}(into = new {name}()) {{
    wasm.{c}(scratch);
    return read{name}(into, scratch, null);
}}"""

WORLD = """    /** def: what differs from defaultWorldDef(); and log, clock and record, functions. */
    constructor(def = {{}}) {{
        super();
        wasm.kiriDefaultWorldDef(scratch);
        writeWorldDef(def, scratch, this);
        this._begin(def, scratch);
        const $result = wasm.kiriCreateWorld(scratch, scratch + {size});
        if ($result < 0) {{
            this._end();
            fail(this, $result, "World");
        }}
        this._pointer = U32[(scratch + {size}) >> 2];
    }}

    /** Frees the world and all that is in it; once is enough. */
    destroy() {{
        if (this._pointer) {{
            wasm.kiriDestroyWorld(this._pointer);
            this._end();
        }}
    }}
"""

HEAD = """// Made from include/kiri/kiri.h by bindings/generator/to_javascript.py. Do not edit.

import {
    F32, F64, I32, KiriError, Rows, Shown, Thing, U32, U64, U8, View, WorldBase, copy, enumeration, fail, fill, idOf, int64,
    known, load, pointer, put, putRows, release, scatter, scratch, setDraw, string, take, thing, wasm,
} from "./runtime.js";

export { KiriError, Rows, View, load, wasm };

/** Of the header that this file is made from. */
export const VERSION = "%s";
"""

HELPERS = """
function things(Class, world, at, count) {
    return Array.from(U32.subarray(at >> 2, (at >> 2) + count), (id) => thing(Class, world, id));
}

function bytesAt(at, count) {
    return at ? U8.slice(at, at + count) : null;
}
"""


def module(maker):
    yield HEAD % maker.all["version"]
    yield from maker.enums()
    yield HELPERS.strip("\n").join("\n\n")
    yield from maker.layouts()
    yield ""
    for struct in maker.all["structs"]:
        for field in struct["fields"]:
            field["struct"] = struct["name"]
        if struct["name"] in maker.got:
            yield from maker.struct_class(struct)
            yield ""
            yield from maker.reader(struct)
            yield ""
        if struct["name"] in maker.given:
            yield from maker.writer(struct)
            yield ""
    for struct in maker.all["structs"]:
        if "default" in struct:
            yield DEFAULTS.format(function=camel(short(struct["default"])), name=short(struct["name"]),
                                  c=struct["default"])
            yield ""
    made = {"kiriCreateWorld", "kiriDestroyWorld"} | {s["default"] for s in maker.all["structs"] if "default" in s}
    for function in maker.functions:
        if function["class"] is None and function["name"] not in made:
            yield from maker.call(function).text()
            yield ""
    for name in ["World"] + [short(i) for i in maker.ids]:
        yield f"export class {name} extends {'WorldBase' if name == 'World' else 'Thing'} {{"
        if name == "World":
            yield WORLD.format(size=(maker.structs["kiriWorldDef"]["size"]["wasm32"] + 7) // 8 * 8).rstrip("\n")
        first = name != "World"
        for function in maker.functions:
            if function["class"] == name and function["name"] not in made:
                if not first:
                    yield ""
                first = False
                yield from (f"    {line}" for line in maker.call(function).text())
        yield "}"
        yield ""


def files(description):
    maker = Maker(description)
    return {f"{FOLDER}/kiri.js": "\n".join(module(maker)).rstrip("\n") + "\n",
            f"{FOLDER}/kiri.d.ts": typescript.declarations(maker)}
