"""bindings/lua/kiri.lua: the declarations and classes of the header, in what is written by hand (bindings/lua/layer.lua)."""

import pathlib

import naming

LAYER = pathlib.Path(__file__).resolve().parents[1] / "lua/layer.lua"
RENAMED = {"End": "finish"}  # a word of Lua
BY_HAND = {"kiriCreateWorld", "kiriDestroyWorld", "kiriWorld_DebugDraw"}

ROCKSPEC = """-- luarocks make, in a checkout: builds the library by make, with g++ and Eigen.
rockspec_format = "3.0"
package = "kiri"
version = "VERSION-1"
source = {url = "git+file://."}
description = {
    summary = "Cuts thin sheets while they move: the library Kiri for LuaJIT and LOVE",
    license = "MIT",
}
supported_platforms = {"unix"}
dependencies = {"lua == 5.1"}
build = {
    type = "make",
    build_target = "lib",
    build_variables = {BUILD = "build/rock-build"},
    install_pass = false,
    install = {lua = {kiri = "bindings/lua/kiri.lua"}, lib = {libkiri = "build/rock-build/libkiri.so"}},
}
"""


class Lua:
    def __init__(self, description):
        self._of = description
        self._ids = [alias["name"] for alias in description["ids"]]
        self._structs = {struct["name"]: struct for struct in description["structs"]}
        self.kinds = naming.classes(description)[1:]

    # ---- Declarations

    def cdef(self):
        lines = [f"typedef struct {name} {name};" for name in self._of["opaque"]]
        lines += [f"typedef {of} {name};" for name, of in self._of["aliases"].items()]
        # First the names of structs, for callbacks get pointers to some.
        lines += [f"typedef struct {name} {name};" for name in self._structs]
        for callback in self._of["callbacks"]:
            lines.append(f"typedef {callback['returns']} {callback['name']}({self._c(callback['parameters'])});")
        for struct in self._of["structs"]:
            fields = " ".join(self._field(field) for field in struct["fields"])
            lines.append(f"struct {struct['name']} {{ {fields} }};")
        for function in self._of["functions"]:
            lines.append(f"{function['returns']} {function['name']}({self._c(function['parameters'])});")
        return "\n".join(lines)

    @staticmethod
    def _c(parameters):
        def one(parameter):
            kind, bracket, count = parameter["c"].partition("[")
            return f"{kind} {parameter['name']}{bracket}{count}"
        return ", ".join(one(parameter) for parameter in parameters) or "void"

    @staticmethod
    def _field(field):
        stars = "*" if field["form"] in ("pointer", "callback") else ""
        const = "const " if field.get("const") else ""
        count = f"[{field['count']}]" if "count" in field else ""
        return f"{const}{field['type']}{stars} {field['name']}{count};"

    def enums(self):
        lines = []
        for enum in self._of["enums"]:
            values = {value["value"]: value["name"][len(enum["prefix"]):] for value in enum["values"]}
            lines += [f"kiri.{value['name'][5:]} = {value['value']}" for value in enum["values"]]
            if len(values) > 1:
                names = ", ".join(f"[{value}] = \"{name}\"" for value, name in values.items())
                lines.append(f"kiri.{enum['name'][4:]} = {{{names}}}")
        return "\n".join(lines)

    def fields(self):
        """What is said of the fields of structs that a host fills by tables."""
        lines = []
        for name, struct in self._structs.items():
            fields = ", ".join(f"{field['name']} = {self._kind(field)}" for field in struct["fields"])
            default = f", default = \"{struct['default']}\"" if "default" in struct else ""
            lines.append(f"structs.{name} = {{fields = {{{fields}}}{default}}}")
        return "\n".join(lines)

    @staticmethod
    def _kind(field):
        form = field["form"]
        if form == "struct":
            return f"\"{field['type']}\""
        if form == "pointer" and field.get("length"):
            return f"{{item = \"{field['type']}\", count = \"{field['length']}\", width = {field['width']}}}"
        if form == "number" and "count" in field:
            return str(field["count"])
        return f"\"{form}\""

    def views(self):
        """Structs that point to arrays of the library, or name things: they know their world."""
        lines = []
        for name, struct in self._structs.items():
            if name not in self._viewed():
                continue
            fields = [field for field in struct["fields"] if field["form"] in ("pointer", "id")]
            made = []
            for field in fields:
                if field["form"] == "id":
                    made.append(f"{field['name']} = {{\"{field['type'][4:]}\"}}")
                else:
                    made.append(f"{field['name']} = {{\"{field['type']}\", \"{field['length']}\", {field['width']}}}")
            lines.append(f"view_type(\"{name}\", {{{', '.join(made)}}})")
        rows = sorted({parameter["type"] for function in self._of["functions"] for parameter in function["parameters"]
                       if parameter["form"] == "view"}
                      | {field["type"] for name in self._viewed() for field in self._structs[name]["fields"]
                         if field["form"] == "pointer"})
        for name in rows:
            named = f"\"{name[4:]}\"" if name in self._ids else "nil"
            ids = {field["name"]: field["type"][4:] for field in self._structs.get(name, {"fields": []})["fields"]
                   if field["form"] == "id"}
            made = "{" + ", ".join(f"{field} = \"{kind}\"" for field, kind in ids.items()) + "}"
            lines.insert(0, f"array_type(\"{name}\", {named}, {made if name in self._structs else 'nil'})")
        return "\n".join(lines)

    def _viewed(self):
        out = {parameter["type"] for function in self._of["functions"] for parameter in function["parameters"]
               if parameter["form"] == "struct" and parameter["direction"] == "out" and "Default" not in function["name"]}
        return {name for name in out if "default" not in self._structs[name] and any(field["form"] in ("pointer", "id") for field in self._structs[name]["fields"])}

    # ---- Functions

    def methods(self):
        return "\n".join(Method(self, function).text() for function in self._of["functions"]
                         if function["name"] not in BY_HAND)

    def is_view(self, struct):
        return struct in self._viewed()

    def is_id(self, name):
        return name in self._ids


    # ---- For LuaLS

    def hint(self, given):
        """The type of a field, or of a parameter that is given."""
        form, kind = given["form"], given["type"]
        if form == "struct":
            return f"kiri.{kind[4:]}"
        if form == "id":
            return f"kiri.{kind[4:]}"
        if form == "callback":
            return "function"
        if form in ("string", "bytes"):
            return "string|ffi.cdata*"
        if form in ("array", "pointer", "strided") or "count" in given:
            item = f"kiri.{kind[4:]}" if kind.startswith("kiri") else "number"
            return f"{item}[]|ffi.cdata*"
        return "boolean|integer" if given.get("flag") else number_of(given)

    def types(self):
        lines = ["---@meta kiri", "-- Made from kiri.h by `make bindings`: types for LuaLS. kiri.lua is what runs.", "",
                 "---@class kiri", "local kiri = {}", ""]
        for enum in self._of["enums"]:
            lines += [f"kiri.{value['name'][5:]} = {value['value']}" for value in enum["values"]]
        for name, struct in self._structs.items():
            lines += ["", *naming.comment(struct["doc"], "--- ").splitlines(), f"---@class kiri.{name[4:]}"]
            for field in struct["fields"]:
                doc = " ".join(field["doc"].split())
                lines.append(f"---@field {field['name']}? {self.hint(field)}{' # ' + doc if doc else ''}")
        lines += ["", "--- An array of the library, from 0 on. It ends with the next tick.", "---@class kiri.Array: ffi.cdata*",
                  "---@field [integer] any", ""]
        for kind in ["World", *self.kinds]:
            lines += [f"---@class kiri.{kind}", *(["---@overload fun(def?: kiri.WorldDef): kiri.World"] if kind == "World" else
                                                 ["---@field id integer", "---@field world kiri.World"]), f"local {kind} = {{}}", ""]
            if kind == "World":
                lines += ["kiri.World = World", "", "--- Frees the world and all its content.", "function World:destroy() end", "",
                          "--- Draws the world as after the last tick, by functions of the host.", "---@param draw kiri.DebugDraw",
                          "function World:debugDraw(draw) end", ""]
                for other in self.kinds:
                    lines += [f"---@param id integer", f"---@return kiri.{other}", f"function World:{other.lower()}(id) end", ""]
        lines += [Method(self, function).stub() for function in self._of["functions"] if function["name"] not in BY_HAND]
        return "\n".join([*lines, "return kiri", ""])


def number_of(declared):
    return "number" if declared["type"] in ("float", "double") else "integer"


class Method:
    """A Lua function for one of C: what is given first, then where answers go (left out: they are made), then lengths."""

    def __init__(self, lua, function):
        self._lua = lua
        self._function = function
        self._derived = naming.derived(function)
        self._given, self._optional, self._lengths = [], [], []
        self._before, self._passed, self._after, self._returned, self._kinds = [], [], [], [], []
        self._place = 0

    def text(self):
        function = self._function
        of = function["class"]
        parameters = function["parameters"]
        if of:
            self._passed.append("world.c")
            if of != "World":
                self._passed.append("self.id")
            parameters = parameters[1 if of == "World" else 2:]
        self._known = [parameter["name"] for parameter in parameters]
        for parameter in parameters:
            self._parameter(parameter)
        name = self.name()
        arguments = ", ".join(self._given + self._optional + self._lengths)
        head = f"function {of}:{name}({arguments})" if of else f"function kiri.{name}({arguments})"
        body = ([f"local world = self{'' if of == 'World' else '.world'}"] if of else []) + self._before + self._call()
        return (naming.comment(function["doc"], "--- ") + head + "\n" + "".join(f"    {line}\n" for line in body) + "end\n")

    def _give(self, value, kind):
        self._returned.append(value)
        self._kinds.append(kind)

    def stub(self):
        """The function with types, for LuaLS."""
        self.text()
        function, parameters = self._function, {parameter["name"]: parameter for parameter in self._function["parameters"]}
        of, text = function["class"], naming.comment(function["doc"], "--- ")
        for name in self._given + self._optional + self._lengths:
            parameter = parameters[name]
            optional = name not in self._given or parameter.get("nullable") or parameter["form"] in ("struct", "strided")
            text += f"---@param {name}{'?' if optional else ''} {self._lua.hint(parameter)}\n"
        kinds = self._kinds or [{"const char*": "string", "kiriResult": "boolean # work is left for later ticks"}.get(
            function["returns"], "integer")]
        text += "".join(f"---@return {kind}\n" for kind in kinds)
        arguments = ", ".join(self._given + self._optional + self._lengths)
        return text + f"function {of + ':' if of else 'kiri.'}{self.name()}({arguments}) end\n"

    def _call(self):
        function = self._function
        call = f"C.{function['name']}({', '.join(self._passed)})"
        if function["returns"] == "const char*":
            return [f"return ffi.string({call})"]
        if function["returns"] == "void":
            return [call, *self._after, f"return {', '.join(self._returned)}"]
        if function["returns"] != "kiriResult":
            return [f"return {call}"]
        lines = [f"local result = {call}"]
        if function["name"] in naming.ENDS_VIEWS:
            lines.append("passed(world)")
        of = function["class"]
        lines.append(f"if result < 0 then fail({'world' if of else 'nil'}, \"{of + ':' if of else ''}{self.name()}\", result, "
                     f"{'true' if function.get('changes') else 'false'}) end")
        lines += self._after
        lines.append(f"return {', '.join(self._returned)}" if self._returned else "return result == 1")
        return lines

    def _parameter(self, parameter):
        name, form, direction = parameter["name"], parameter["form"], parameter["direction"]
        if name in self._derived:
            self._lengths.append(name)
            self._passed.append(name)
        elif name in ("capacity", "count", "size") and (direction == "out" or name == "capacity"):
            self._counted(parameter)
        else:
            getattr(self, f"_{direction}_{form}")(parameter)

    def _counted(self, parameter):
        """Room, and how much there is."""
        forms = {(p["form"], p.get("length"), p["direction"]) for p in self._function["parameters"]}
        if ("bytes", "capacity", "out") in forms:
            self._passed.append("capacity or 0" if parameter["name"] == "capacity" else "out.int64_t")
        elif ("array", "capacity", "out") in forms:
            self._passed.append("room.size" if parameter["name"] == "capacity" else "out.int32_t")
        elif ("view", "count", "out") in forms:
            self._passed.append("out.int32_t")
        else:
            self._out_number(parameter)

    # ---- In

    def _in_number(self, parameter):
        self._given.append(parameter["name"])
        self._passed.append(parameter["name"])

    _in_string = _in_number
    _out_strided = _in_number

    def _in_id(self, parameter):
        self._given.append(parameter["name"])
        self._passed.append(f"id_of(world, {parameter['name']}, \"{parameter['type'][4:]}\")")

    def _in_struct(self, parameter):
        name, world = parameter["name"], "world" if self._function["class"] else "nil"
        self._given.append(name)
        self._passed.append(f"struct_of({world}, {name}, \"{parameter['type']}\")")

    def _inout_struct(self, parameter):
        self._given.append(parameter["name"])
        self._passed.append(parameter["name"])

    def _in_array(self, parameter):
        name, length = parameter["name"], parameter["length"]
        self._given.append(name)
        if isinstance(length, int):
            self._place += 1
            null = f"{name} and " if parameter.get("nullable") else ""
            self._passed.append(f"{null}vector({self._place}, {name}, {length})")
        elif self._lua.is_id(parameter["type"]):
            self._before.append(f"{name}, {length} = ids_of(world, {name}, {length}, \"{parameter['type']}\")")
            self._passed.append(name)
        else:
            self._before.append(f"{name}, {length} = rows_of({name}, {length}, \"{parameter['type']}\", "
                                f"{parameter.get('width', 1)})")
            self._passed.append(name)

    def _in_bytes(self, parameter):
        name = parameter["name"]
        self._given.append(name)
        self._before.append(f"{parameter['length']} = {parameter['length']} or #{name}")
        self._passed.append(name)

    # ---- Out

    def _out_number(self, parameter):
        place = f"out.{parameter['type']}"
        kept = naming.camel(parameter["name"])
        self._passed.append(place)
        self._after.append(f"local {kept} = {place}[0]" + (" ~= 0" if parameter.get("flag") else ""))
        self._give(kept, "boolean" if parameter.get("flag") else number_of(parameter))

    def _out_id(self, parameter):
        kind = parameter["type"][4:]
        self._passed.append(f"out.{kind}")
        self._give(f"handle(world, out.{kind}[0], \"{kind}\")", f"kiri.{kind}{'?' if parameter.get('none') else ''}")

    def _out_struct(self, parameter):
        name, kind = parameter["name"], parameter["type"]
        self._optional.append(name)
        if self._lua.is_view(kind):
            self._before.append(f"{name} = {name} or new.{kind}View()")
            self._passed.append(f"{name}.c")
            self._after.append(f"{name}.world, {name}.epoch = world.cell, now[world.cell]")
        else:
            self._before.append(f"{name} = {name} or new.{kind}()")
            self._passed.append(name)
        self._give(name, f"kiri.{kind[4:]}")

    def _out_view(self, parameter):
        kind = parameter["type"]
        self._passed.append(f"out.{kind}Rows")
        self._give(f"new.{kind}Array(out.{kind}Rows[0], out.int32_t[0], {parameter['width']}, world.cell, now[world.cell])",
                   "kiri.Array")

    def _out_array(self, parameter):
        name, kind, length = parameter["name"], parameter["type"], parameter["length"]
        width = parameter.get("width", 1)
        if length == "capacity":
            self._out_list(parameter)
        elif length in self._derived:  # an answer for each that was given
            self._before.append(f"local {name} = ffi.new(\"{kind}[?]\", {length})")
            self._passed.append(name)
            self._give(f"list_of(world, {name}, {length}, \"{kind[4:]}\", false)", f"kiri.{kind[4:]}[]")
        else:
            count = f"{width} * {length}" if width > 1 else length
            (self._given if length in self._known else self._optional).append(name)
            self._before.append(f"{name} = {name} or ffi.new(\"{kind}[?]\", {count})")
            self._passed.append(name)
            self._give(name, "ffi.cdata*")

    def _out_list(self, parameter):
        """Into the room that there is; again where that was not enough."""
        kind, width = parameter["type"], parameter.get("width", 1)
        if not any("make_room" in line for line in self._after):
            again = ", ".join(["self", *self._given])
            self._after.append(f"if out.int32_t[0] > room.size then make_room(out.int32_t[0]) "
                               f"return {self._function['class']}.{self.name()}({again}) end")
        self._passed.append(f"room.{kind}" if width == 1 else f"room.{kind}{width}")
        what = f"\"{kind[4:]}\"" if self._lua.is_id(kind) else "nil"
        many = f" * {width}" if width > 1 else ""
        self._give(f"list_of(world, {self._passed[-1]}, out.int32_t[0]{many}, {what})",
                   f"kiri.{kind[4:]}[]" if self._lua.is_id(kind) else "number[]")

    def _out_bytes(self, parameter):
        """Into the host's buffer, or a string."""
        name = parameter["name"]
        self._optional += [name, "capacity"]
        self._passed.append(name)
        self._after += [f"if {name} then return tonumber(out.int64_t[0]) end",
                        f"{name} = ffi.new(\"uint8_t[?]\", out.int64_t[0])",
                        f"local size = self:{self.name()}({', '.join([*self._given, name, 'out.int64_t[0]', *self._lengths])})"]
        self._give(f"ffi.string({name}, size)", "string")

    def name(self):
        return RENAMED.get(self._function["method"], naming.camel(self._function["method"]))


def files(description):
    lua = Lua(description)
    text = LAYER.read_text()
    made = {"VERSION": description["version"], "CDEF": lua.cdef(), "ENUMS": lua.enums(), "STRUCTS": lua.fields(),
            "VIEWS": lua.views(), "METHODS": lua.methods(), "CLASSES": ", ".join(lua.kinds),
            "KINDS": ", ".join(f'"{kind}"' for kind in lua.kinds)}
    for name, part in made.items():
        text = text.replace(f"--@{name}@", part).replace(f"@{name}@", part)
    version = description["version"]
    return {"bindings/lua/kiri.lua": text, "bindings/lua/types/kiri.lua": lua.types(), f"bindings/lua/kiri-{version}-1.rockspec": ROCKSPEC.replace("VERSION", version)}
