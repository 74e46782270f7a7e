"""The crate kiri-sys: the header as Rust has it, with C's names."""

import re

import naming

NUMBERS = {"int32_t": "i32", "uint32_t": "u32", "int64_t": "i64", "uint64_t": "u64", "uint16_t": "u16", "float": "f32",
           "double": "f64", "char": "c_char", "void": "c_void"}
KEYWORDS = {"type"}

HEAD = """// Made from kiri.h by `make bindings`.

use core::ffi::{c_char, c_void};
use core::mem::{align_of, offset_of, size_of};
"""


def escaped(doc):
    """A comment of C as Markdown: what it uses for itself stays plain text."""
    return re.sub(r"([*\[\]<>`])", r"\\\1", doc)


def field_name(name):
    return name + "_" if name in KEYWORDS else name


def named(base):
    return NUMBERS.get(base, base)


def of_c(c, callbacks):
    """The type of Rust for a type of C."""
    base, array, _ = c.replace("const ", "").partition("[")
    stars = base.count("*") + bool(array)
    base = base.rstrip("*")
    if base in callbacks:
        return base
    if not stars and base == "void":
        return "()"
    text = named(base)
    for level in range(stars):
        text = f"*{'const' if level == 0 and c.startswith('const ') else 'mut'} {text}"
    return text


class Raw:
    def __init__(self, description):
        self._d = description
        self._callbacks = {callback["name"] for callback in description["callbacks"]}

    def text(self):
        parts = [HEAD, *self._types(), *self._enums(), *map(self._callback, self._d["callbacks"]),
                 *map(self._struct, self._d["structs"]), self._functions(), self._layout("64"), self._layout("wasm32")]
        return "\n".join(parts)

    def _types(self):
        for name, base in self._d["aliases"].items():
            yield f"pub type {name} = {named(base)};"
        for name in self._d["opaque"]:
            yield f"\n#[repr(C)]\npub struct {name} {{\n    _private: [u8; 0],\n}}\n"
        major, minor, patch = map(int, self._d["version"].split("."))
        yield f"/// Of the header.\npub const KIRI_VERSION: i32 = {10000 * major + 100 * minor + patch};\n"

    def _enums(self):
        for enum in self._d["enums"]:
            lines = []
            for value in enum["values"]:
                lines += naming.wrapped(escaped(value["doc"]), "/// ")
                lines.append(f"pub const {value['name']}: i32 = {value['value']};")
            yield "\n".join(lines) + "\n"

    def _callback(self, callback):
        parameters = ", ".join(f"{p['name']}: {of_c(p['c'], self._callbacks)}" for p in callback["parameters"])
        returns = of_c(callback["returns"], self._callbacks)
        lines = naming.wrapped(escaped(callback["doc"]), "/// ")
        gives = "" if returns == "()" else f" -> {returns}"
        lines.append(f"pub type {callback['name']} = Option<unsafe extern \"C\" fn({parameters}){gives}>;")
        return "\n".join(lines) + "\n"

    def _struct(self, struct):
        lines = naming.wrapped(escaped(struct["doc"]), "/// ")
        lines += ["#[repr(C)]", "#[derive(Clone, Copy, Debug)]", f"pub struct {struct['name']} {{"]
        for field in struct["fields"]:
            lines += naming.wrapped(escaped(field["doc"]), "    /// ")
            lines.append(f"    pub {field_name(field['name'])}: {self._field(field)},")
        return "\n".join(lines + ["}", ""])

    def _field(self, field):
        kind = named(field["type"])
        if field["form"] == "pointer":
            return f"*{'const' if field['const'] else 'mut'} {kind}"
        return f"[{kind}; {field['count']}]" if "count" in field else kind

    def _functions(self):
        lines = ['unsafe extern "C" {']
        for function in self._d["functions"]:
            lines += naming.wrapped(escaped(function["doc"]), "    /// ")
            parameters = ", ".join(f"{p['name']}: {of_c(p['c'], self._callbacks)}" for p in function["parameters"])
            returns = of_c(function["returns"], self._callbacks)
            lines.append(f"    pub fn {function['name']}({parameters}){'' if returns == '()' else ' -> ' + returns};")
        return "\n".join(lines + ["}", ""])

    def _layout(self, machine):
        """What does not compile where a struct is laid out otherwise than in C."""
        where = 'target_arch = "wasm32"' if machine == "wasm32" else 'target_pointer_width = "64"'
        lines = [f"#[cfg({where})]", "const _: () = {"]
        for struct in self._d["structs"]:
            name = struct["name"]
            lines.append(f"    assert!(size_of::<{name}>() == {struct['size'][machine]});")
            lines.append(f"    assert!(align_of::<{name}>() == {struct['align'][machine]});")
            lines += [f"    assert!(offset_of!({name}, {field_name(field['name'])}) == {field['offset'][machine]});"
                      for field in struct["fields"]]
        return "\n".join(lines + ["};", ""])
