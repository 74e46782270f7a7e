"""bindings/godot: the tables of the functions for the classes of Godot 3 and 4, their documents, and the names of constants
for Godot 3."""

import re
from xml.sax.saxutils import escape

import naming

TYPES = {"int32_t": "INT32", "uint32_t": "UINT32", "int64_t": "INT64", "uint64_t": "UINT64", "uint16_t": "UINT16",
         "void": "BYTE", "float": "FLOAT", "double": "DOUBLE", "kiriResult": "INT32"}
# Keys that scripts do not see: stamps, and what functions of the host get.
HIDDEN = {"cookie", "user"}
Y_IS_UP = "default (0, -9.81, 0): y is up"

# As Godot names what scripts see.
GODOT = {"NIL": "Variant", "BOOL": "bool", "INT": "int", "REAL": "float", "STRING": "String", "VECTOR2": "Vector2",
         "VECTOR3": "Vector3", "BASIS": "Basis", "DICTIONARY": "Dictionary", "ARRAY": "Array",
         "BYTES": "PackedByteArray", "INTS": "PackedInt32Array", "FLOATS": "PackedFloat32Array",
         "VECTORS2": "PackedVector2Array", "VECTORS3": "PackedVector3Array"}
# What comments say of pointers, as it is for scripts.
AS_SCRIPTS_SEE = [
    (r"Writes up to `capacity` ids of (.*?); \*count is how many there are\.", r"The objects of \1."),
    (r"On failure \*\w+ is (0|null)\.", "Null on failure."),
    (r"\*(\w+) is 0\b", r"\1 is null"),
    (r"\*(\w+)\b", r"\1"),
]
# Where a comment says little but how C gives something.
SAYS = {
    "kiriWorld_Save": "The world as bytes; none while a cut is being worked on.",
    "kiriWorld_Snapshot": "The world as bytes for this process.",
    "kiriWorld_GetEvents": "What happened in the last tick, one dictionary each: `type`, and what such an event has.",
    "kiriSheet_GetPieceFrames": "The frames of a piece; the first one names it.",
    "kiriSheet_IsAwake": "False where all pieces of the sheet sleep, see sleep_speed; kiriPieceState says which do. "
                         "kiriSheet_Wake wakes all of them.",
    "kiriSheet_Wake": "Wakes all pieces.",
    "kiriSheet_GetWeights": "The shape functions at a rest point: frames, their weights (sum 1), and gradients (1/m).",
    "kiriSheet_CopyIndices16": "Corners of some triangles as numbers of 16 bits, for a buffer of indices. "
                               "KIRI_ERROR_STATE: there are more than 65535 vertices.",
    "kiriFillRectangle": "The mesh of a rectangle, for kiriCreateSheet.",
}
DEFAULTS = {"DICTIONARY": "{}", "NIL": "null", "OBJECT": "null"}

# Written by hand in by_hand.c: arguments (name, kind, class), how many are required, answer, and what is said of them;
# None: as the header has it.
BY_HAND = {
    "kiriCreateWorld": ("CreateWorld", [("def", "DICTIONARY", None)], 0, ("OBJECT", "World"),
                        "Makes an empty world. Null where that failed. Keys of the def: those of "
                        "[method default_world_def]; `record`: [method KiriWorld.take_recording] has its recording; "
                        "`clock`: its profile has times. [code]KiriWorld.new()[/code] makes one with the defaults."),
    "kiriDestroyWorld": ("DestroyWorld", [], 0, None,
                         "Frees the world and all that is in it, before the last script lets go of it. Its objects stay, "
                         "and calls of them are errors."),
    "kiriSheet_CopyVertices": ("CopyVertices", [("first", "INT", None), ("count", "INT", None)], 2, ("DICTIONARY", None),
                               "Copies of [code]positions[/code] and [code]normals[/code] of some vertices."),
    "kiriWorld_DebugDraw": ("DebugDraw", [("draw", "DICTIONARY", None)], 0, ("DICTIONARY", None),
                            "What is to be drawn of the world as after the last tick: [code]points[/code], "
                            "[code]lines[/code] and [code]triangles[/code], each with [code]positions[/code] and "
                            "[code]colors[/code]. Keys of draw: those of [method Kiri.default_debug_draw]."),
}
# Beside the functions of the header: class, name, in by_hand.c, arguments, answer, and what is said of them.
MORE = [
    ("World", "get_last_result", "GetLastResult", [], ("INT", None),
     "The result of the last call of a method of this world or of one of its objects: [constant Kiri.OK], "
     "[constant Kiri.PENDING], or what failed."),
    ("World", "take_recording", "TakeRecording", [], ("BYTES", None),
     "The bytes that the recording has got since the last call: one after the other they are the recording. Of worlds "
     "that were made with [code]record[/code]."),
    ("Sheet", "get_revision", "GetRevision", [], ("INT", None),
     "Grows where a cut has changed the triangles of the mesh or where its vertices are in the rest plane."),
    ("Sheet", "get_surface_arrays", "GetSurfaceArrays", [], ("ARRAY", None),
     "What [code]ArrayMesh.add_surface_from_arrays[/code] takes: positions, normals, UVs, which are rest positions in m, "
     "and indices, clockwise as Godot has them. Copies."),
    ("Sheet", "get_solid_arrays", "GetSolidArrays", [("thickness", "REAL", None)], ("ARRAY", None),
     "The same of the sheet with a thickness in m: both its sides, and rims along its outline and lips. See "
     "[method get_solid]."),
    ("Sheet", "get_vertex_buffer", "GetVertexBuffer", [], ("BYTES", None),
     "What [code]RenderingServer.mesh_surface_update_vertex_region[/code] of Godot 4 takes, for a surface made from "
     "[method get_surface_arrays]: while [method get_revision] stays the same, this is enough in each frame."),
]


def class_name(name):
    return f"Kiri{name or ''}"


def class_number(name):
    return f"CLASS_{(name or 'KIRI').upper()}"


class Godot:
    def __init__(self, description):
        self._d = description
        self._ids = {kind["name"] for kind in description["ids"]}
        self._structs = {struct["name"]: struct for struct in description["structs"]}
        self._used = []
        self.methods = [self._method(function) for function in description["functions"]]
        self.methods += [{"class": of, "name": name, "function": None, "by_hand": by_hand, "arguments": arguments,
                          "required": len(arguments), "answer": answer, "doc": doc, "returns": "RESULT"}
                         for of, name, by_hand, arguments, answer, doc in MORE]

    # ---- Kinds of what scripts see

    def _kind(self, kind, name, count=1, row=None):
        """Of a number, a vector inside, or rows."""
        if kind in self._structs or kind in self._ids:
            return "ARRAY" if row else "DICTIONARY" if kind in self._structs else "OBJECT"
        real = kind in ("float", "double")
        if row:
            return ({2: "VECTORS2", 3: "VECTORS3"}.get(row, "FLOATS") if real else "INTS" if kind == "int32_t" else "BYTES")
        if count > 1:
            return {2: "VECTOR2", 3: "VECTOR3", 12: "VECTORS3"}.get(count) or ("BASIS" if name == "rotation" else "FLOATS")
        return "REAL" if real else "INT"

    @staticmethod
    def _type(kind, ids, structs, flag=False):
        return "TYPE_ID" if kind in ids else "TYPE_STRUCT" if kind in structs else "TYPE_FLAG" if flag else f"TYPE_{TYPES[kind]}"

    def _class(self, kind):
        return class_number(kind[4:]) if kind in self._ids else "CLASS_NONE"

    def _struct_name(self, kind):
        return naming.snake(naming.bare(kind)).upper()

    # ---- Structs

    def fields(self, struct):
        """Those that scripts see, with what the table says of them."""
        lengths = {f["length"] for f in struct["fields"] if f["form"] == "pointer" and f.get("length")
                   and not (struct["name"] == "kiriSheetDef" and f["name"] == "framePoints")}
        for field in struct["fields"]:
            if field["form"] != "callback" and field["name"] not in HIDDEN | lengths:
                yield field, self._field_kind(field)

    def _field_kind(self, field):
        if field["form"] == "pointer":
            return self._kind(field["type"], field["name"], row=field["width"])
        if field.get("flag"):
            return "BOOL"
        return self._kind(field["type"], field["name"], field.get("count", 1))

    def _field(self, struct, field, kind):
        name, of = struct["name"], field["type"]
        rows = (f"(int)offsetof({name}, {field['length']}), {field['width']}, {int(field['nullable'])}"
                if field["form"] == "pointer" else "0, 0, 0")
        to = f"&{self._struct_name(of)}" if of in self._structs else "NULL"
        return (f'    {{ "{naming.snake(field["name"])}", {self._type(of, self._ids, self._structs, field.get("flag"))}, '
                f'KIND_{kind}, (int)offsetof({name}, {field["name"]}), {field.get("count", 1)}, {rows}, '
                f'{self._class(of)}, {to} }},')

    def _struct(self, struct):
        name, upper = struct["name"], self._struct_name(struct["name"])
        fields = [self._field(struct, field, kind) for field, kind in self.fields(struct)]
        size, fill = f"SIZE_OF({name})", f"Fill{naming.bare(name)}" if "default" in struct else "NULL"
        lines, masks = [], "NULL"
        if name == "kiriWorldDef":
            size, fill = "SIZE_OF(HostDef)", "FillWorldDef"
            fields += [f'    {{ "{extra}", TYPE_FLAG, KIND_BOOL, (int)offsetof(HostDef, {extra}), 1, 0, 0, 0, CLASS_NONE, NULL }},'
                       for extra in ("record", "clock")]
        elif "default" in struct:
            lines += [f"static void {fill}(void* filled)", "{", f"    {struct['default']}(filled);", "}", ""]
        if name == "kiriEvent":
            masks = "EVENT_MASKS"
            lines += self._masks(struct)
        lines += [f"static const Field {upper}_FIELDS[] = {{", *fields, "};", ""]
        static = "" if name in ("kiriWorldDef", "kiriDebugDraw", "kiriSheetSettings", "kiriHit") else "static "
        lines.append(f'{static}const Struct {upper} = {{ "{naming.bare(name)}", {size}, {len(fields)}, {upper}_FIELDS, {fill}, '
                     f"{masks} }};")
        return "\n".join(lines) + "\n"

    def _masks(self, struct):
        """Fields that an event of each type has."""
        names = [field["name"] for field, _ in self.fields(struct)]
        values = {value["name"]: value["value"] for enum in self._d["enums"] for value in enum["values"]}
        masks = {values[event]: sum(1 << names.index(name) for name in ["type", *fields])
                 for event, fields in self._d["eventFields"].items()}
        row = ", ".join(hex(masks.get(i, 1)) for i in range(max(masks) + 1))
        return ["/* Fields of events, by type. */", f"static const uint32_t EVENT_MASKS[] = {{ {row} }};", ""]

    # ---- Methods

    def _method(self, function):
        made = {"class": function["class"], "name": naming.snake(function["method"]), "function": function["name"],
                "doc": SAYS.get(function["name"], function["doc"]), "source": function}
        if function["name"] in BY_HAND:
            by_hand, arguments, required, answer, doc = BY_HAND[function["name"]]
            return {**made, "by_hand": by_hand, "arguments": arguments, "required": required, "answer": answer, "doc": doc,
                    "returns": "RESULT" if answer else "NOTHING"}
        return {**made, "by_hand": None, **self._shape(function)}

    def _shape(self, function):
        parameters = function["parameters"]
        forms = [self._form(function, i) for i in range(len(parameters))]
        given = [(p, form) for p, form in zip(parameters, forms)
                 if form in ("IN", "IN_STRUCT", "IN_NUMBERS", "IN_ROWS", "INOUT_STRUCT")]
        arguments = [(naming.snake(p["name"]), "NIL" if form == "IN_NUMBERS" and p.get("nullable") else self._kind_of(p, form),
                      p["type"][4:] if p["type"] in self._ids else None) for p, form in given]
        required = len(given)
        while required and given[required - 1][0].get("nullable"):
            required -= 1
        outs = [(p, form) for p, form in zip(parameters, forms) if form.startswith("OUT") and form != "OUT_COUNT"]
        returns = {"kiriResult": "RESULT", "void": "NOTHING", "int32_t": "INT"}.get(function["returns"], "TEXT")
        answer = {"NOTHING": None, "TEXT": ("STRING", None)}.get(returns, ("INT", None))
        if len(outs) == 1:
            p, form = outs[0]
            answer = (self._kind_of(p, form), p["type"][4:] if self._kind_of(p, form) == "OBJECT" else None)
        elif outs:
            answer = ("DICTIONARY", None)
        return {"forms": forms, "arguments": arguments, "required": required, "answer": answer, "returns": returns}

    def _form(self, function, i):
        p, parameters = function["parameters"][i], function["parameters"]
        form, direction = p["form"], p["direction"]
        if form == "world":
            return "WORLD"
        if form == "id" and direction == "in" and i == 1 and function["class"] == naming.bare(p["type"]):
            return "SELF"
        if p["name"] == "capacity":
            return "CAPACITY"
        if p["name"] in naming.derived(function):
            return "IN_COUNT"
        if direction == "out" and p["name"] in ("count", "size") and any(
                q["form"] == "view" or q.get("length") == "capacity" for q in parameters):
            return "OUT_COUNT"
        if direction == "inout":
            return "INOUT_STRUCT"
        if direction == "in":
            return {"struct": "IN_STRUCT", "bytes": "IN_ROWS"}.get(
                form, "IN" if form != "array" else "IN_NUMBERS" if isinstance(p["length"], int) else "IN_ROWS")
        if form == "view":
            return "OUT_VIEW"
        if form in ("array", "bytes"):
            return ("OUT_NUMBERS" if isinstance(p["length"], int) else "OUT_LIST" if p["length"] == "capacity" else "OUT_ROWS")
        return "OUT_STRUCT" if form == "struct" else "OUT"

    def _kind_of(self, p, form):
        if form in ("IN_ROWS", "OUT_ROWS", "OUT_LIST", "OUT_VIEW"):
            return self._kind(p["type"], p["name"], row=self._width(p))
        if p.get("flag"):
            return "BOOL"
        return self._kind(p["type"], p["name"], p["length"] if form.endswith("NUMBERS") else 1)

    @staticmethod
    def _width(p):
        """Numbers in a row; the term of kiriFillRectangle's positions counts numbers of two."""
        return 2 if str(p.get("length")).startswith("2 * ") else p.get("width", 1)

    def _parameter(self, method, i):
        function = method["source"]
        p, form = function["parameters"][i], method["forms"][i]
        if form == "WORLD":
            return '    { "world", FORM_WORLD, TYPE_NONE, KIND_NIL, 0, 0, 0, 0, CLASS_NONE, NULL, NULL },'
        names = [q["name"] for q in function["parameters"]]
        count = p["length"] if form.endswith("NUMBERS") else 1
        length = names.index(p["length"]) if form == "IN_ROWS" else 0
        width = self._width(p) if form in ("IN_ROWS", "OUT_ROWS", "OUT_LIST", "OUT_VIEW") else 0
        of = f"&{self._struct_name(p['type'])}" if p["type"] in self._structs else "NULL"
        rows = f"RowsOf_{function['name']}_{p['name']}" if form == "OUT_ROWS" else "NULL"
        return (f'    {{ "{naming.snake(p["name"])}", FORM_{form}, {self._type(p["type"], self._ids, self._structs, p.get("flag"))}, '
                f'KIND_{self._kind_of(p, form)}, {count}, {length}, {width}, {int(bool(p.get("nullable")))}, '
                f"{self._class(p['type'])}, {of}, {rows} }},")

    def _rows(self, method):
        """How many rows an array has that C fills."""
        function, lines = method["source"], []
        names = [p["name"] for p in function["parameters"]]
        for p, form in zip(function["parameters"], method["forms"]):
            if form != "OUT_ROWS":
                continue
            name = f"RowsOf_{function['name']}_{p['name']}"
            term = re.sub(r"^2 \* ", "", str(p["length"]))
            term = re.sub(r"[a-z]\w*", lambda word: f"(int64_t)*(int32_t*)a[{names.index(word[0])}]", term)
            lines += [f"static int64_t {name}(void* const* a)", "{", f"    return {term};", "}", ""]
        return lines

    def _call(self, method):
        function = method["source"]
        passed = []
        for i, (p, form) in enumerate(zip(function["parameters"], method["forms"])):
            kind = {"kiriWorld": "kiriWorld"}.get(p["type"], p["type"])
            passed.append(f"*({kind}*)a[{i}]" if form in ("SELF", "IN", "IN_COUNT", "CAPACITY") else f"a[{i}]")
        call = f"{function['name']}({', '.join(passed)})"
        if function["name"] == "kiriDefaultWorldDef":
            call = "FillWorldDef(a[0])"
        body = {"NOTHING": [f"    {call};", "    return 0;"], "TEXT": [f"    *(const char**)a[{len(passed)}] = {call};",
                "    return 0;"]}.get(method["returns"], [f"    return {call};"])
        if not passed and method["returns"] != "TEXT":
            body.insert(0, "    (void)a;")
        return [f"static int64_t Call_{function['name']}(void* const* a)", "{", *body, "}", ""]

    def _tables_of(self, method):
        name = f"{method['class'] or 'Kiri'}_{method['name']}".upper()
        lines = []
        if method["arguments"]:
            rows = [f'    {{ "{argument}", KIND_{kind}, {class_number(of) if of else "CLASS_NONE"} }},'
                    for argument, kind, of in method["arguments"]]
            lines += [f"static const Argument {name}_ARGUMENTS[] = {{", *rows, "};", ""]
        if not method["by_hand"]:
            lines += self._rows(method) + self._call(method)
            if method["forms"]:
                rows = [self._parameter(method, i) for i in range(len(method["forms"]))]
                lines += [f"static const Parameter {name}_PARAMETERS[] = {{", *rows, "};", ""]
        return lines

    def _row(self, method):
        name = f"{method['class'] or 'Kiri'}_{method['name']}".upper()
        answer, of = method["answer"] or ("NIL", None)
        count = 0 if method["by_hand"] else len(method["forms"])
        return (f'    {{ {class_number(method["class"])}, "{method["name"]}", '
                + (f'"{method["function"]}"' if method["function"] else "NULL")
                + f', RETURNS_{method["returns"]}, KIND_{answer}, {class_number(of) if of else "CLASS_NONE"}, '
                f'{len(method["arguments"])}, {method["required"]}, {name + "_ARGUMENTS" if method["arguments"] else "NULL"}, '
                f'{count}, {name + "_PARAMETERS" if count else "NULL"}, '
                + ("NULL, " + method["by_hand"] if method["by_hand"] else f"Call_{method['function']}, NULL") + " },")

    def constants(self):
        for enum in self._d["enums"]:
            for value in enum["values"]:
                yield naming.bare(enum["name"]), value["name"][5:], value["value"], naming.is_flags(enum), value["doc"]

    def tables(self):
        names = ", ".join(f'"{class_name(of)}"' for of in [None, *naming.classes(self._d)])
        lines = ["/* Made from kiri.h by `make bindings`. */", '#include "objects.h"', "", "#include <stddef.h>", "",
                 "/* clang-format off */",
                 f'const char* const CLASS_NAMES[CLASS_COUNT] = {{ "", {names} }};', "",
                 "/* ---- Structs ---- */", ""]
        lines += [self._struct(struct) for struct in self._d["structs"] if struct["name"] != "kiriDrawVertex"]
        lines += ["/* ---- Methods ---- */", ""]
        for method in self.methods:
            lines += self._tables_of(method)
        lines += ["const Method METHODS[] = {", *[self._row(method) for method in self.methods], "};",
                  "const int METHOD_COUNT = (int)(sizeof METHODS / sizeof *METHODS);", "",
                  "/* ---- Constants ---- */", "", "const Constant CONSTANTS[] = {"]
        lines += [f'    {{ "{of}", "{name}", {value}, {int(flag)} }},' for of, name, value, flag, _ in self.constants()]
        lines += ["};", "const int CONSTANT_COUNT = (int)(sizeof CONSTANTS / sizeof *CONSTANTS);", ""]
        return "\n".join(lines)

    # ---- Godot 3

    def script(self):
        """kiri.gd: what Godot 3 has no way to say in native classes, constants and static methods."""
        lines = ["# Made from kiri.h by `make bindings`. Constants, and what needs no world:",
                 '# const Kiri = preload("res://addons/kiri/kiri.gd")', "extends Reference", ""]
        lines += [f'const Native = preload("kiri.gdns")', 'const World = preload("kiri_world.gdns")', ""]
        lines += [f"const {name} = {value}" for _, name, value, _, _ in self.constants()]
        for method in self.methods:
            if method["class"] is None:
                takes = [name + (f" = {DEFAULTS[kind]}" if i >= method["required"] else "")
                         for i, (name, kind, _) in enumerate(method["arguments"])]
                given = ", ".join(name for name, _, _ in method["arguments"])
                lines += ["", f"static func {method['name']}({', '.join(takes)}):",
                          f"\treturn Native.new().{method['name']}({given})"]
        return "\n".join(lines) + "\n"

    # ---- Documents

    def _named(self, text):
        """Names of C as scripts have them."""
        for pattern, scripts in AS_SCRIPTS_SEE:
            text = re.sub(pattern, scripts, text)
        functions = {m["function"]: m for m in self.methods if m["function"]}
        def function(found):
            m = functions.get(found[0])
            return f"[method {class_name(m['class'])}.{m['name']}]" if m else found[0]
        text = escape(text).replace("[", "[lb]") if "[" in text and "[method" not in text else escape(text)
        text = re.sub(r"\bkiri\w+_\w+\b|\bkiri(?:Create|Destroy|Begin|Get|Default|Fill|Fit)\w+\b", function, text)
        text = re.sub(r"\bKIRI_(\w*[A-Z])\b", r"[constant Kiri.\1]", text)
        text = re.sub(r"`([^`]+)`", r"[code]\1[/code]", text)
        text = re.sub(r"\bkiri[A-Z]\w+\b", self._giver, text)
        return re.sub(r"\bkiriWorld\b", "KiriWorld", text).replace("default (0, 0, -9.81)", Y_IS_UP)

    def _giver(self, found):
        """The method that gives, or else takes, a struct."""
        for method in self.methods:
            for p in method.get("source", {}).get("parameters", []):
                if p["type"] == found[0] and p["type"] in self._structs:
                    return f"[method {class_name(method['class'])}.{method['name']}]"
        return found[0]

    def _keys(self, kind, seen=()):
        struct = self._structs[kind]
        lines = []
        for field, of in self.fields(struct):
            name = naming.snake(field["name"])
            type_name = class_name(field["type"][4:]) if of == "OBJECT" else GODOT[of]
            lines.append(f"- [code]{name}[/code] ({type_name})" + (f": {self._named(field['doc'])}" if field["doc"] else ""))
            if field["type"] in self._structs and field["type"] not in seen:
                lines += ["  " + line for line in self._keys(field["type"], (*seen, kind))]
        return lines

    def _describe(self, method):
        lines = [self._named(method["doc"]) if method["function"] not in BY_HAND and method["function"] else escape(method["doc"])]
        for p in method.get("source", {}).get("parameters", []):
            if p["type"] in self._structs and method["function"] not in BY_HAND or p["type"] in (
                    "kiriWorldDef", "kiriDebugDraw"):
                lines += [f"Keys of [code]{naming.snake(p['name'])}[/code]:", *self._keys(p["type"])]
        return "\n".join(lines)

    def document(self, of):
        name = class_name(of)
        brief = {None: "Constants of Kiri, and what needs no world.", "World": "A world of sheets that are cut while they move.",
                 "Sheet": "A sheet of a KiriWorld."}.get(of, f"A {(of or str()).lower()} of a KiriWorld.")
        lines = ['<?xml version="1.0" encoding="UTF-8" ?>', "<!-- Made from kiri.h by `make bindings`. -->",
                 f'<class name="{name}" inherits="RefCounted">', f"\t<brief_description>{brief}</brief_description>",
                 "\t<description>Arrays and dictionaries that it gives are copies, which scripts may keep.</description>",
                 "\t<methods>"]
        for method in sorted((m for m in self.methods if m["class"] == of), key=lambda m: m["name"]):
            lines += self._document_method(method)
        lines.append("\t</methods>")
        if of is None:
            lines.append("\t<constants>")
            for enum, constant, value, flag, doc in self.constants():
                bits = ' is_bitfield="true"' if flag else ""
                lines.append(f'\t\t<constant name="{constant}" value="{value}" enum="{enum}"{bits}>{self._named(doc)}</constant>')
            lines.append("\t</constants>")
        return "\n".join(lines + ["</class>", ""])

    def _document_method(self, method):
        answer, of = method["answer"] or ("NIL", None)
        kind = "void" if not method["answer"] else class_name(of) if answer == "OBJECT" else GODOT[answer]
        static = ' qualifiers="static"' if method["class"] is None else ""
        lines = [f'\t\t<method name="{method["name"]}"{static}>', f'\t\t\t<return type="{kind}" />']
        for i, (name, kind, of) in enumerate(method["arguments"]):
            default = f' default="{DEFAULTS[kind]}"' if i >= method["required"] else ""
            lines.append(f'\t\t\t<param index="{i}" name="{name}" type="{class_name(of) if of else GODOT[kind]}"{default} />')
        return lines + [f"\t\t\t<description>{self._describe(method)}</description>", "\t\t</method>"]


def files(description):
    godot = Godot(description)
    made = {"bindings/godot/tables.c": godot.tables(), "bindings/godot/godot3/kiri.gd": godot.script()}
    for of in [None, *naming.classes(description)]:
        made[f"bindings/godot/doc_classes/{class_name(of)}.xml"] = godot.document(of)
    return made
