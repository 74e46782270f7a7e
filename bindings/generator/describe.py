"""What bindings have to know of kiri.h, as one JSON: see bindings/README.md for its form."""

import re

import header

# What the header says of parameters in words only.
PARAMETERS = {
    "kiriFillRectangle.restPositions": {"direction": "out", "form": "array",
                                        "length": "2 * (columns + 1) * (rows + 1)"},
    "kiriFillRectangle.indices": {"direction": "out", "form": "array", "length": "6 * columns * rows"},
    "kiriSheet_CopyVertices.positions": {"direction": "out", "form": "strided", "length": "count",
                                         "stride": "positionStride"},
    "kiriSheet_CopyVertices.normals": {"direction": "out", "form": "strided", "length": "count",
                                       "stride": "normalStride"},
    "kiriSheet_CopyIndices16.indices": {"direction": "out", "form": "array", "length": "count", "width": 3},
    "kiriSheet_CopyPrevious.vertices": {"direction": "out", "form": "array", "length": "count", "width": 1},
    "kiriSheet_CopySources.sources": {"direction": "out", "form": "array", "length": "count", "width": 1},
    "kiriSheet_CopySourceWeights.weights": {"direction": "out", "form": "array", "length": "count", "width": 9},
    "kiriCut_Extend.restPoints": {"width": 2},
    "kiriSheet_Cut.restPoints": {"width": 2},
    "kiriSheet_SetTearLine.restPoints": {"width": 2},
    "kiriSheet_GetCollisionPoints.positions": {"width": 3},
    "kiriSheet_GetWeights.gradients": {"width": 2},
    "kiriWorld_DetachPieces.detached": {"direction": "out", "form": "array", "length": "count", "width": 1},
    "kiriWorld_Replay.recording": {"form": "bytes", "length": "size"},
    "kiriWorld_Replay.replay": {"direction": "inout"},
    "kiriFitBudget.budget": {"direction": "inout"},
    "kiriSheet_IsAwake.awake": {"flag": True},
    "kiriGetMaterial.preset": {"enum": "kiriMaterialPreset"},
    "kiriGetTearing.preset": {"enum": "kiriMaterialPreset"},
    "kiriGetQuality.preset": {"enum": "kiriQualityPreset"},
    "kiriGetSetup.preset": {"enum": "kiriSetupPreset"},
    "kiriGetStageName.stage": {"enum": "kiriStage"},
    "kiriGetResultName.result": {"enum": "kiriResultCode"},
    "kiriGetResultText.result": {"enum": "kiriResultCode"},
}
RETURNS = {"kiriGetResultName": "forever", "kiriGetResultText": "forever", "kiriGetStageName": "forever",
           "kiriWorld_GetLastError": "until the next call that changes the world"}

# Tags in comments: an id that may be 0, a number that is 0 or 1, a result, a pointer that may be null, an array with so many
# numbers for each of its rows, and a parameter that may be left out: null or 0 in C.
NONE, FLAG, PENDS, NULL = r"\b0: none\b", r"(?:^|\b{} )1: ", r"\bKIRI_PENDING: ", r"\b[Nn]ull\b"
OPTIONAL = r"(?<![*\w]){}`?(?: (?:and|or) \w+)? (?:null|0): "
ARRAY = r"\b(\d+) (?:floats (?:\(u, v\) )?)?an? (\w+)"

# Bytes and alignment.
NUMBERS = {"int32_t": 4, "uint32_t": 4, "int64_t": 8, "uint64_t": 8, "float": 4, "double": 8, "uint16_t": 2}
POINTERS = {"64": 8, "wasm32": 4}


class Describer:
    def __init__(self, text):
        reader = header.Reader(text)
        self._declared = {kind: [d for d in reader.declarations if d["kind"] == kind]
                          for kind in ("alias", "opaque", "enum", "struct", "callback", "function")}
        self._prose = reader.prose
        self._numbers = {**NUMBERS, **{d["name"]: NUMBERS[d["type"]["type"]] for d in self._declared["alias"]}}
        self._ids = [d["name"] for d in self._declared["alias"] if d["type"]["type"] == "uint32_t"]
        self._callbacks = {d["name"] for d in self._declared["callback"]}
        self._enums = {self._prefix(d): d["name"] for d in self._declared["enum"]}
        self._structs = {}
        self._used = set()
        self._version = ".".join(re.search(rf"#define KIRI_VERSION_{part} (\d+)", text)[1]
                                 for part in ("MAJOR", "MINOR", "PATCH"))

    def describe(self):
        structs = [self._struct(d) for d in self._declared["struct"]]
        description = {
            "version": self._version,
            "prose": self._prose,
            "ids": [{"name": d["name"], "doc": d["doc"]} for d in self._declared["alias"] if d["name"] in self._ids],
            "opaque": [d["name"] for d in self._declared["opaque"]],
            "aliases": {d["name"]: d["type"]["type"] for d in self._declared["alias"]},
            "enums": [self._enum(d) for d in self._declared["enum"]],
            "callbacks": [self._callback(d) for d in self._declared["callback"]],
            "structs": structs,
            "functions": [self._function(d) for d in self._declared["function"]],
        }
        description["eventFields"] = self._event_fields()
        unused = set(PARAMETERS) - self._used
        if unused:
            raise SyntaxError(f"not in the header: {sorted(unused)}")
        return description

    # ---- Enums, events

    @staticmethod
    def _prefix(enum):
        """What the names of an enum have in common, up to a line."""
        names = [value["name"] for value in enum["values"]]
        first, last = min(names), max(names)
        same = next((i for i, (a, b) in enumerate(zip(first, last)) if a != b), len(first))
        return first[:first.rfind("_", 0, same) + 1]

    def _enum(self, enum):
        return {"name": enum["name"], "prefix": self._prefix(enum), "section": enum["section"], "doc": enum["doc"],
                "values": enum["values"]}

    def _enum_of(self, doc):
        named = re.search(r"(KIRI_[A-Z_]+_)\.\.\.", doc)
        return self._enums[named[1]] if named else None

    def _event_fields(self):
        """A comment of an event type names the fields that it fills: all of it, or what is before a colon."""
        event = {field["name"] for field in self._structs["kiriEvent"]["fields"]}
        fields = {}
        for enum in self._declared["enum"]:
            for value in enum["values"] if enum["name"] == "kiriEventType" else []:
                before, colon, _ = re.sub(r"\(.*?\)", "", value["doc"]).partition(":")
                names = [name.strip() for name in before.split(",")]
                if not event.issuperset(names):
                    if colon:
                        raise SyntaxError(f"{value['name']}: {names} are not all fields of kiriEvent")
                    names = []
                fields[value["name"]] = ["sheet"] + [name for name in names if name != "sheet"]
        return fields

    # ---- Structs

    def _struct(self, struct):
        fields = [self._field(struct["name"], field, struct["fields"]) for field in struct["fields"]]
        laid = {"name": struct["name"], "section": struct["section"], "doc": struct["doc"], "size": {}, "align": {},
                "fields": fields}
        default = struct["name"].replace("kiri", "kiriDefault", 1)
        if any(function["name"] == default for function in self._declared["function"]):
            laid["default"] = default
        for machine in POINTERS:
            at = alignment = 0
            for field in fields:
                size, align = self._size(field, machine)
                at += -at % align
                field["offset"][machine] = at
                at, alignment = at + size, max(alignment, align)
            laid["size"][machine], laid["align"][machine] = at + -at % alignment, alignment
        self._structs[struct["name"]] = laid
        return laid

    def _size(self, field, machine):
        if field["form"] in ("pointer", "callback"):
            return POINTERS[machine], POINTERS[machine]
        if field["form"] == "struct":
            struct = self._structs[field["type"]]
            return struct["size"][machine], struct["align"][machine]
        return self._numbers[field["type"]] * field.get("count", 1), self._numbers[field["type"]]

    def _field(self, struct, field, fields):
        if struct == "kiriSheetSettings":  # "as there", says the header
            there = {f["name"]: f["doc"] for f in self._structs["kiriSheetDef"]["fields"]}
            field = {**field, "doc": field["doc"] or there.get(field["name"], "")}
        name = f"{struct}.{field['name']}"
        form = ("callback" if field["type"] in self._callbacks else "pointer" if field["stars"] else
                "struct" if field["type"] in self._structs else "id" if field["type"] in self._ids else "number")
        described = {"name": field["name"], "type": field["type"], "form": form, "offset": {}, "doc": field["doc"]}
        if field["count"] is not None:
            described["count"] = field["count"]
        if form == "pointer":
            described["const"] = field["const"]
            described.update(self._rows(name, field, fields))
        if form in ("pointer", "callback"):
            described["nullable"] = form == "callback" or field["type"] == "void" or bool(re.search(NULL, field["doc"]))
        if form == "number" and re.search(FLAG.format(field["name"]), field["doc"]):
            described["flag"] = True
        if form == "id" and re.search(NONE, field["doc"]):
            described["none"] = True
        if form == "number" and self._enum_of(field["doc"]):
            described["enum"] = self._enum_of(field["doc"])
        return described

    @staticmethod
    def _rows(name, field, fields):
        """The field that counts rows is called after a row, or after the array."""
        array, own = re.search(ARRAY, field["doc"]), field["name"]
        noun = array[2] if array else ""
        counts = {f"{noun}Count", f"{own}Count", f"{own.removesuffix('s')}Count", f"count{own[-1]}"} & {f["name"] for f in fields}
        if field["type"] == "void" and not counts:
            return {}
        if len(counts) != 1 or not array and field["type"] != "void":
            raise SyntaxError(f"{name}: its comment has no '3 a vertex', or no field counts its rows")
        return {"length": counts.pop(), "width": int(array[1]) if array else 1}

    # ---- Functions

    def _callback(self, callback):
        return {"name": callback["name"], "section": callback["section"], "doc": callback["doc"],
                "returns": self._c(callback["returns"]),
                "parameters": [{"name": p["name"], "c": self._c(p)} for p in callback["parameters"]]}

    @staticmethod
    def _c(declared):
        return ("const " if declared["const"] else "") + declared["type"] + "*" * declared["stars"]

    def _function(self, function):
        name, parameters = function["name"], function["parameters"]
        described = {"name": name, "section": function["section"], "doc": function["doc"],
                     "returns": self._c(function["returns"])}
        if name in RETURNS:
            described["lives"] = RETURNS[name]
        world = parameters[0] if parameters and parameters[0]["type"] == "kiriWorld" else None
        if world and world["stars"] == 1:
            described["changes"] = not world["const"]
        made = [self._parameter(function, i) for i in range(len(parameters))]
        described["class"], described["method"] = self._method(name, made)
        described["parameters"] = made
        # Bytes that are pending are no bytes: callers get an error.
        if re.search(PENDS, function["doc"]) and all(p["form"] != "bytes" or p["direction"] == "in" for p in described["parameters"]):
            described["pends"] = True
        for p in described["parameters"]:
            if p["form"] == "id" and p["direction"] == "out" and (
                    described.get("pends") or re.search(rf"\*{p['name']} {NONE}", function["doc"])):
                p["none"] = True
        return described

    def _method(self, name, parameters):
        """The class is that of the id after the world, or the world; f"kiri{class}_{method}" or a verb and the class."""
        takes_world = bool(parameters) and parameters[0]["c"] in ("kiriWorld*", "const kiriWorld*")
        of = "World" if takes_world else None
        if takes_world and len(parameters) > 1 and parameters[1]["c"] in self._ids and not parameters[1].get("nullable"):
            of = parameters[1]["type"][4:]
        method = name[4:].partition("_")[2] or name[4:]
        if of and method == f"Destroy{of}":
            method = "Destroy"
        return of, method

    def _parameter(self, function, i):
        parameters = function["parameters"]
        parameter = parameters[i]
        name = f"{function['name']}.{parameter['name']}"
        described = {"name": parameter["name"], "type": parameter["type"], "c": self._c(parameter),
                     **self._passed(parameters, i), **PARAMETERS.get(name, {})}
        self._used.add(name)
        if parameter["count"] is not None:
            described["c"] = f"{'const ' if parameter['const'] else ''}{parameter['type']}[{parameter['count']}]"
        if described["form"] == "view":
            described["lives"] = "until the next tick"
        optional = parameter["stars"] < 2 and bool(re.search(OPTIONAL.format(parameter["name"]), function["doc"]))
        if described["form"] not in ("number", "id"):
            described["nullable"] = optional
        elif optional:
            described["nullable" if described["form"] == "id" else "optional"] = True
        return described

    def _passed(self, parameters, i):
        """Direction, form, and what counts an array, by the header's conventions."""
        p, after = parameters[i], [q["name"] for q in parameters[i + 1:]]
        direction = "in" if p["const"] or not (p["stars"] or p["count"]) else "out"
        if p["type"] == "kiriWorld":
            return {"direction": "out" if p["stars"] == 2 else "in", "form": "world"}
        if p["count"]:
            return {"direction": direction, "form": "array", "length": p["count"]}
        if p["type"] == "char":
            return {"direction": "in", "form": "string"}
        if p["stars"] == 2:
            return {"direction": "out", "form": "view", "length": "count", "width": 1}
        if p["stars"] and p["type"] == "void":
            length = "capacity" if direction == "out" else after[0]
            return {"direction": direction, "form": "bytes", "length": length}
        if p["stars"] and direction == "in" and after[:1] == ["count"]:
            return {"direction": "in", "form": "array", "length": "count", "width": 1}
        if p["stars"] and direction == "out" and "capacity" in after:
            return {"direction": "out", "form": "array", "length": "capacity", "width": 1}
        form = "struct" if p["type"] in self._structs else "id" if p["type"] in self._ids else "number"
        return {"direction": direction, "form": form}


def describe(text):
    return Describer(text).describe()
