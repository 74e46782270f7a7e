"""bindings/python/kiri/_declarations.py and _methods.py: all but what the other files there say by hand."""

import pprint
import re

import naming

PARAMETERS = {"from": "start", "to": "end"}  # words of Python
# What Python's methods may leave out, while C always takes a number.
DEFAULTS = {"substeps": "1", "angularVelocity": "(0.0, 0.0, 0.0)", "torque": "(0.0, 0.0, 0.0)",
            "inertia": "(0.0, 0.0, 0.0, 0.0, 0.0, 0.0)", "centerOfMass": "(0.0, 0.0, 0.0)",
            "kiriObstacle_SetPose.rotation": "(1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0)"}
# By hand, for they are other in Python than in C.
BY_HAND = {"kiriCreateWorld": "World", "kiriDestroyWorld": "close", "kiriWorld_Replay": "replay", "kiriWorld_Save": "save",
           "kiriWorld_Load": "load", "kiriWorld_Snapshot": "snapshot", "kiriWorld_Restore": "restore",
           "kiriWorld_DetachPieces": "detach_pieces", "kiriWorld_Note": "note", "kiriWorld_Raycast": "raycast",
           "kiriSheet_Raycast": "raycast", "kiriSheet_GetWeights": "weights", "kiriSheet_SetSettings": "set_settings",
           "kiriSheet_SetContacts": "set_contacts", "kiriWorld_DebugDraw": "debug_draw", "kiriCreateSheet": "create_sheet",
           "kiriCreatePin": "create_pin", "kiriCreateObstacle": "create_obstacle", "kiriFrame_Hold": "hold",
           "kiriSheet_CopyVertices": "copy_vertices", "kiriSheet_CopyIndices16": "copy_indices16",
           "kiriSheet_CopySources": "copy_sources", "kiriSheet_CopySourceWeights": "copy_source_weights",
           "kiriSheet_CopyPrevious": "copy_previous",
           "kiriFillRectangle": "fill_rectangle", "kiriFitBudget": "fit_budget", "kiriWorld_GetLastError": "last_error"}
# What the header says of pointers and of C's ways to return, in Python's words; None: no docstring of another function.
DOCS = {"kiriWorld_GetSheets": "Returns the sheets of the world, in the order of their making.",
        "kiriSheet_GetFrames": "Returns the frames of the sheet.", "kiriSheet_GetPins": "Returns the pins of the sheet, of all types.",
        "kiriWorld_GetSeams": "Returns the seams of the world.",
        "kiriWorld_GetEvents": "Returns the events since the start of the last tick.",
        "kiriWorld_SetGravity": "Sets gravity (m/s^2) from the next tick on. All pieces wake.",
        "kiriWorld_SetBudget": "Sets the budget from the next tick on: fields of kiriBudget by name.",
        "kiriSheet_IsAwake": "Returns False where all pieces sleep; piece() tells which.", "kiriSheet_Wake": "Wakes all pieces.",
        "kiriSheet_GetPieceFrames": "Returns the frames of a piece.",
        "kiriFrame_GetPiece": "Returns the current index of the piece with this frame.",
        "kiriDestroySheet": "Destroys the sheet with its cuts, frames and pins.", "kiriDestroyPin": "Destroys a pin of any type.",
        "kiriDestroyObstacle": "Destroys the obstacle. Pieces that rested on it wake.",
        "kiriGetVersion": "Returns the version of the library, as KIRI_VERSION.",
        "kiriGetResultName": "Returns the name of a result, such as 'KIRI_OK'.",
        "kiriGetResultText": "Returns a line with the meaning of a result."}


def name_of(function):
    """As C's, but a getter is named by what it gets."""
    return BY_HAND.get(function["name"]) or naming.snake(re.sub(r"^Get(?=[A-Z])", "", function["method"]))


def doc_of(function):
    """As a docstring says it: what C writes behind a pointer is returned, null is None, ids are objects."""
    if function["name"] in DOCS:
        return DOCS[function["name"]]
    if function["name"].startswith("kiriDefault"):
        return f"Returns the defaults of {function['parameters'][0]['type']}."
    doc = re.sub(r"^Gets? ", "Returns ", function["doc"])
    doc = re.sub(r" ?On failure \*\w+ is 0\.", "", doc)
    doc = re.sub(r"\*\w+: ", "Result: ", doc)
    doc = re.sub(r"\*(\w+) is 0", lambda found: "the result is None", doc)
    doc = re.sub(r"\b[Nn]ull\b", "None", doc)
    return doc[:1].upper() + doc[1:]


def hint_of(kind, ids, width=1):
    """The type of a number, an id or an array, as annotations have it."""
    if kind in ids:
        return f"kiri.{kind[4:]}"
    return "float" if kind in ("float", "double") else "bool" if kind == "bool" else "int"


def enums(description):
    text = '"""Made from kiri.h by `make bindings`: the enums of C, whose values are ints, too."""\n\nimport enum as _enum\n'
    for one in description["enums"]:
        base = "IntFlag" if naming.is_flags(one) else "IntEnum"
        text += f"\n\nclass {naming.bare(one['name'])}(_enum.{base}):\n"
        text += naming.comment(f'"""{one["doc"]}"""', "    ", 112) if one["doc"] else ""
        text += "".join(f"    {naming.constant(one, value)} = {value['value']}\n" for value in one["values"])
    text += "\n\n"
    text += "".join(f"{value['name']} = {naming.bare(one['name'])}.{naming.constant(one, value)}\n"
                    for one in description["enums"] for value in one["values"])
    return text


def declarations(description):
    structs, ids = description["structs"], [alias["name"] for alias in description["ids"]]
    functions = [function for function in description["functions"]
                 if function["class"] and function["returns"] == "kiriResult"]
    constants = {value["name"]: value["value"] for enum in description["enums"] for value in enum["values"]}
    tables = {
        "ARRAYS": {struct["name"]: {field["name"]: (field["length"], field["width"]) for field in struct["fields"]
                                    if field["form"] == "pointer" and field.get("length")} for struct in structs},
        "IDS": {struct["name"]: {field["name"]: field["type"][4:] for field in struct["fields"] if field["type"] in ids}
                for struct in structs},
        "ENUMS": {struct["name"]: {field["name"]: field["enum"][4:] for field in struct["fields"] if "enum" in field}
                  for struct in structs},
        "CHANGES": {function["name"]: function["changes"] for function in functions},
        "METHODS": {function["name"]: (function["class"], name_of(function)) for function in description["functions"]},
    }
    text = '"""Made from kiri.h by `make bindings`."""\n\n'
    text += f"VERSION = \"{description['version']}\"\n\n"
    for name, table in tables.items():
        kept = {key: value for key, value in table.items() if value not in ({}, None)}
        text += f"{name} = {pprint.pformat(kept, width=116, sort_dicts=False)}\n\n"
    text += f"CONSTANTS = {pprint.pformat(constants, width=116, sort_dicts=False)}\n\n"
    text += f'CDEF = """\n{cdef(description)}\n"""\n'
    return text


def cdef(description):
    def listed(parameters):
        parts = []
        for parameter in parameters:
            kind, bracket, count = parameter["c"].partition("[")
            parts.append(f"{kind} {parameter['name']}{bracket}{count}")
        return ", ".join(parts) or "void"

    def field_of(field):
        stars = "*" if field["form"] in ("pointer", "callback") else ""
        count = f"[{field['count']}]" if "count" in field else ""
        return f"{'const ' if field.get('const') else ''}{field['type']}{stars} {field['name']}{count};"

    lines = [f"typedef struct {name} {name};" for name in description["opaque"]]
    lines += [f"typedef {of} {name};" for name, of in description["aliases"].items()]
    for enum in description["enums"]:
        values = ", ".join(f"{value['name']} = {value['value']}" for value in enum["values"])
        lines.append(f"enum {enum['name']} {{ {values} }};")
    callbacks, structs = description["callbacks"], description["structs"]
    for struct in structs:  # callbacks have pointers to some
        lines.append(f"typedef struct {struct['name']} {struct['name']};")
    lines += [f"typedef {callback['returns']} {callback['name']}({listed(callback['parameters'])});" for callback in callbacks]
    lines += [f"struct {struct['name']} {{ {' '.join(field_of(field) for field in struct['fields'])} }};"
              for struct in structs]
    lines += [f"{function['returns']} {function['name']}({listed(function['parameters'])});"
              for function in description["functions"]]
    return "\n".join(lines)


class Method:
    def __init__(self, description, function):
        self._structs = {struct["name"]: struct for struct in description["structs"]}
        self._ids = [alias["name"] for alias in description["ids"]]
        self._function = function
        self._derived = naming.derived(function)
        self._world = "self" if function["class"] == "World" else "self.world"
        skip = 0 if not function["class"] else 1 if function["class"] == "World" else 2
        self._parameters = function["parameters"][skip:]
        self._given, self._keywords, self._passed, self._before, self._out = [], [], [], [], []

    def text(self):
        function = self._function
        if function["class"] not in (None, "World"):
            self._passed.append("self.id")
        for parameter in self._parameters:
            if parameter["name"] in self._derived:
                continue
            (self._in if parameter["direction"] == "in" else self._out.append)(parameter)
        body = self._before + self._body()
        first = ["self"] if function["class"] else []
        names = ["*names: str"] if self._is_copied() else []
        returned = self._returned()
        head = f"def {name_of(function)}({', '.join(first + self._given + names + self._keywords)}) -> {returned}:"
        doc = naming.comment(doc_of(function), "", 108).rstrip("\n").replace("\\", "\\\\").replace('"', "'")
        made = [f'"""{doc}"""' if "\n" not in doc else f'"""{doc}\n"""', *body]
        text = self._indented(head, made)
        if self._is_copied():
            viewed = f"def {name_of(function)}_view({', '.join(first + self._given + self._keywords)}) -> core.Loan:"
            kind = self._out[0]["type"]
            text += "\n" + self._indented(viewed, [
                '"""The same without copies, for a `with` statement, within which the world does not change: see Loan."""',
                f"return core.Loan({', '.join([self._world, self._quoted(), repr(kind), *self._passed])})"])
        return text

    @staticmethod
    def _indented(head, body):
        lines = "\n".join(body).split("\n")
        return head + "\n" + "".join(f"    {line}".rstrip() + "\n" for line in lines)

    def _quoted(self):
        return repr(self._function["name"])

    # ---- In

    def _in(self, parameter):
        name = PARAMETERS.get(parameter["name"], naming.snake(parameter["name"]))
        form = parameter["form"]
        if parameter["name"] in ("capacity", "count") and form == "number":
            return
        if form == "struct":
            self._structure(parameter)
            return
        default = DEFAULTS.get(f"{self._function['name']}.{parameter['name']}", DEFAULTS.get(parameter["name"]))
        hint = self._hint(parameter)
        if parameter.get("nullable") or parameter.get("optional"):
            default = {"int": "0", "float": "0.0"}.get(hint, "None")
        given = f"{name}: {hint}" + (f" = {default}" if default else "")
        (self._keywords if default and self._is_copied() else self._given).append(given)
        if form == "number" and parameter["type"] not in self._ids:
            self._passed.append(name)
        elif form == "id":
            null = f" if {name} else 0" if parameter.get("nullable") else ""
            self._passed.append(f"{self._world}.id_of({name}, '{parameter['type'][4:]}'){null}")
        elif form == "array" and isinstance(parameter["length"], int):
            self._passed.append(f"core.vector({name}, {parameter['length']})")
        elif form == "array" and parameter["type"] in self._ids:
            self._before.append(f"ids = [{self._world}.id_of(thing, '{parameter['type'][4:]}') for thing in {name}]")
            self._passed += [f"core.ffi.new('{parameter['type']}[]', ids)", "len(ids)"]
        elif form == "array":
            self._passed.append(f"*core.rows('{parameter['type']}', {name}, {parameter['width']})")
        else:
            raise SyntaxError(f"{self._function['name']}: {form}")

    def _structure(self, parameter):
        self._keywords.append(f"**fields: {'Any' if parameter['type'] == 'kiriFold' else 'Unpack[' + parameter['type'][4:] + ']'}")
        self._before += ["kept = []  # until C has read it",
                         f"structure = core.structure({self._world}, '{parameter['type']}', fields, kept)"]
        self._passed.append("structure")

    def _hint(self, parameter):
        kind = hint_of(parameter["type"], self._ids)
        if parameter["form"] == "array":
            numbers = "Iterable" if parameter["type"] in self._ids else "Numbers"
            kind = f"{numbers}[{kind}]" if numbers == "Iterable" else numbers
        return f"Optional[{kind}]" if parameter.get("nullable") else kind

    # ---- Out

    def _returned(self):
        """The annotation of what the function returns."""
        function, out = self._function, self._out
        if not function["class"]:
            return "str" if function["returns"] == "const char*" else "Record" if out else "int"
        if self._is_copied():
            return "Record"
        if not out:
            return "int"
        kind = hint_of(out[0]["type"], self._ids)
        if out[0]["form"] == "view":
            if out[0]["type"] in self._structs:
                return "List[Record]"
            return f"List[{kind}]" if out[0]["type"] in self._ids else "Any"
        if any(parameter.get("length") == "capacity" for parameter in out):
            return f"List[{kind}]"
        if out[0]["form"] == "array":
            made = ["Tuple[float, ...]" if hint_of(p["type"], ()) == "float" else "Tuple[int, ...]" for p in out]
            return made[0] if len(made) == 1 else f"Tuple[{', '.join(made)}]"
        if out[0]["form"] == "struct":
            return "Record"
        if out[0]["form"] == "id":
            return f"Optional[{kind}]" if out[0].get("none") else kind
        return "bool" if out[0].get("flag") else kind

    def _is_copied(self):
        return any(parameter["form"] == "struct" and parameter["direction"] == "out"
                   and any(field["form"] == "pointer" for field in self._structs[parameter["type"]]["fields"])
                   and self._function["class"] for parameter in self._parameters)

    def _call(self, *more):
        return ", ".join([self._quoted(), *self._passed, *more])

    def _body(self):
        function, world = self._function, self._world
        if not function["class"]:
            return self._plain()
        if self._is_copied():
            kind = self._out[0]["type"]
            passed = ", ".join(["names", self._quoted(), repr(kind), *self._passed])
            return [f"return {world}.get_copies({passed})"]
        forms = [parameter["form"] for parameter in self._out]
        if not forms:
            return [f"return {world}.call({self._call()})"]
        if forms[0] == "view":
            return self._viewed()
        if any(parameter.get("length") == "capacity" for parameter in self._out):
            kind = self._out[0]["type"]
            return [f"things, = {world}.lists({self._quoted()}, ('{kind}',), {', '.join(self._passed)})".replace(", )", ")"),
                    f"return [{world}.thing('{kind[4:]}', thing) for thing in things]"]
        if forms[0] == "array":
            made = [f"{naming.snake(p['name'])} = core.ffi.new('{p['type']}[{p['length']}]')" for p in self._out]
            names = [naming.snake(parameter["name"]) for parameter in self._out]
            return made + [f"{world}.call({self._call(*names)})", f"return {', '.join(f'tuple({name})' for name in names)}"]
        out, = self._out
        passed = ", ".join([self._quoted(), repr(out["type"]), *self._passed])
        got = f"{world}.get({passed})"
        if out["form"] == "id":
            return [f"return {world}.thing('{out['type'][4:]}', {got})"]
        if out["form"] == "struct":
            return [f"return core.record({got}, {world})"]
        return [f"return {got}{' != 0' if out.get('flag') else ''}"]

    def _viewed(self):
        view, kind = self._out[0], self._out[0]["type"]
        if kind in self._ids:
            take = f"lambda array, count: [{self._world}.thing('{kind[4:]}', array[i]) for i in range(count)]"
        elif kind in self._structs:
            take = f"lambda array, count: [core.record(array[i], {self._world}) for i in range(count)]"
        else:
            take = f"lambda array, count: core.copy(array, count, {view['width']})"
        return [f"return {self._world}.get_array(", f"    {take},",
                f"    {', '.join([self._quoted(), repr(kind), *self._passed])})"]

    def _plain(self):
        """Of no world."""
        function = self._function
        call = f"core.load().{function['name']}"
        if function["returns"] == "const char*":
            return [f"return core.ffi.string({call}({', '.join(self._passed)})).decode()"]
        if not self._out:
            return [f"return {call}({', '.join(self._passed)})"]
        made = [f"structure = core.ffi.new('{self._out[0]['type']}*')"]
        passed = ', '.join([*self._passed, 'structure'])
        called = f"core.check({function['name']!r}, {passed})" if function["returns"] == "kiriResult" else f"{call}({passed})"
        return made + [called, "return core.record(structure[0])"]


def keywords(description):
    """Of the structs that are given by the names of their fields."""
    text = '"""Made from kiri.h by `make bindings`: keywords of defs, for editors and type checkers."""\n\n'
    text += "from typing import Any, TypedDict\n"
    for struct in description["structs"]:
        if "default" in struct or struct["name"][4:] in ("Budget", "SheetSettings", "Tearing", "Wind"):
            text += f"\n\nclass {struct['name'][4:]}(TypedDict, total=False):\n"
            for field in struct["fields"]:
                kind = hint_of(field["type"], []) if field["form"] == "number" and "count" not in field else "Any"
                text += f"    {field['name']}: {kind}\n" if field["name"] not in ("cookie", "type", "restPoint", "target") else ""
    return text


def methods(description):
    text = '"""Made from kiri.h by `make bindings`: the functions of C as methods of what they are about."""\n\n'
    text += "from __future__ import annotations\n\n"
    text += "from types import SimpleNamespace as Record\n"
    text += "from typing import TYPE_CHECKING, Any, Iterable, List, Optional, Tuple\n\n"
    text += "from . import _core as core\nfrom ._core import Numbers\n\n"
    text += "if TYPE_CHECKING:\n    import kiri\n    from typing_extensions import Unpack\n    from ._fields import *\n"
    plain = [name_of(one) for one in description["functions"] if not one["class"] and one["name"] not in BY_HAND]
    text += f"\n__all__ = {pprint.pformat(plain, width=116, compact=True)}\n"
    for of in (None, *naming.classes(description)):
        made = [Method(description, function).text() for function in description["functions"]
                if function["class"] == of and function["name"] not in BY_HAND]
        if of:
            indented = "\n".join("".join(f"    {line}".rstrip() + "\n" for line in one.rstrip("\n").split("\n"))
                                 for one in made)
            text += f"\n\nclass {of}:\n{indented or '    pass'}"
        else:
            text += "".join("\n\n" + one for one in made)
    return text


def files(description):
    return {"bindings/python/kiri/_declarations.py": declarations(description),
            "bindings/python/kiri/_enums.py": enums(description), "bindings/python/kiri/_methods.py": methods(description),
            "bindings/python/kiri/_fields.py": keywords(description)}
