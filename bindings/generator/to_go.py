"""bindings/go/kiri.go: types, constants and methods of the header. What is by hand is in the other files there."""

import re

import naming

NUMBERS = {"int32_t": "int32", "uint32_t": "uint32", "int64_t": "int64", "uint64_t": "uint64", "float": "float32",
           "double": "float64", "uint16_t": "uint16"}
C_NUMBERS = {"float": "C.float", "double": "C.double"}
BY_HAND = {"kiriCreateWorld": "NewWorld", "kiriDestroyWorld": "Destroy", "kiriWorld_Replay": "Replay",
           "kiriWorld_DebugDraw": "DebugDraw", "kiriFillRectangle": "FillRectangle", "kiriDefaultWorldDef": "NewWorld",
           "kiriSheet_CopyIndices16": "CopyIndices16", "kiriSheet_CopyVertices": "CopyVertices",
           "kiriSheet_CopySources": "CopySources", "kiriSheet_CopySourceWeights": "CopySourceWeights",
           "kiriSheet_CopyPrevious": "CopyPrevious",
           "kiriDefaultDebugDraw": "DebugDraw", "kiriFitBudget": "FitBudget", "kiriWorld_Save": "Save",
           "kiriWorld_Snapshot": "Snapshot",
           "kiriSheet_GetWeights": "Weights",
           "kiriWorld_GetLastError": "LastError"}
HAND_STRUCTS = {"kiriWorldDef", "kiriReplay", "kiriDebugDraw"}
WORDS = {"type": "kind", "range": "span", "func": "function"}


def constant(name):
    """As Go names it: an error begins with Err, and ID is in capitals."""
    return re.sub(r"Id$", "ID", re.sub(r"^Error(?=.)", "Err", naming.pascal(name[5:])))


def receiver(name):
    """One small letter."""
    return naming.bare(name)[0].lower()


class Go:
    def __init__(self, description):
        self.of = description
        self.structs = {struct["name"]: struct for struct in description["structs"]}
        self.ids = [alias["name"] for alias in description["ids"]]

    def number(self, declared):
        if declared.get("enum"):
            return naming.bare(declared["enum"])
        return naming.bare(declared["type"]) + "ID" if declared["type"] in self.ids else NUMBERS[declared["type"]]

    # ---- Types

    def enums(self):
        lines = []
        for enum in self.of["enums"]:
            name, kind = naming.bare(enum["name"]), "uint32" if naming.is_flags(enum) else "int32"
            values = {value["value"]: value for value in enum["values"]}
            lines.append(naming.comment(enum["doc"], "// ") + f"type {name} {kind}\n\nconst (")
            for value in enum["values"]:
                lines.append(naming.comment(value["doc"], "\t// ") + f"\t{constant(value['name'])} {name} = {value['value']}")
            lines.append(f")\n\nvar names{name} = map[{name}]string{{")
            lines += [f"\t{value['value']}: \"{constant(value['name'])}\"," for value in values.values()]
            lines.append(f"}}\n\nfunc (v {name}) String() string {{ return names{name}[v] }}\n")
        return "\n".join(lines)

    def types(self):
        made = [f"// {naming.bare(name)}ID is an id as C has it; 0 is none.\ntype {naming.bare(name)}ID uint32\n" for name in self.ids]
        for name, struct in self.structs.items():
            if name in HAND_STRUCTS:
                continue
            fields = self.viewed(struct) if self.has_pointers(struct) else [
                (naming.pascal(field["name"]) if field["name"] != "cookie" else "cookie", self.type_of(field), field["doc"])
                for field in struct["fields"]]
            body = "".join(naming.comment(doc, "\t// ") + f"\t{field} {kind}\n" for field, kind, doc in fields)
            made.append(naming.comment(struct["doc"], "// ") + f"type {naming.bare(name)} struct {{\n{body}}}\n")
        return "\n".join(made)

    def type_of(self, field):
        base = naming.bare(field["type"]) if field["form"] == "struct" else self.number(field)
        return f"[{field['count']}]{base}" if "count" in field else base

    def has_pointers(self, struct):
        return any(field["form"] in ("pointer", "callback") for field in struct["fields"])

    def is_out(self, struct):
        return struct["name"] in ("kiriMesh", "kiriSolid", "kiriPieceMesh")

    def viewed(self, struct):
        """Slices in a def that goes in, views in what comes out; lengths of slices are known."""
        counted = {field["length"] for field in struct["fields"] if field["form"] == "pointer"} if not self.is_out(struct) else ()
        for field in struct["fields"]:
            name = naming.pascal(field["name"]) if field["name"] != "cookie" else "cookie"
            if field["form"] == "pointer":
                row = f"[{field['width']}]{NUMBERS[field['type']]}" if field["width"] > 1 else NUMBERS[field["type"]]
                yield name, f"View[{row}]" if self.is_out(struct) else f"[]{row}", field["doc"]
            elif field["name"] not in counted or field["name"] == "frameCount":
                yield name, self.type_of(field), field["doc"]

    def layouts(self):
        """Assertions that structs are as in C."""
        return "".join(f"var _ [0]struct{{}} = [unsafe.Sizeof({naming.bare(name)}{{}}) - C.sizeof_{name}]struct{{}}{{}}\n"
                       for name, struct in self.structs.items() if not self.has_pointers(struct))

    def converters(self):
        made = []
        for name, struct in self.structs.items():
            if not self.has_pointers(struct) or name in HAND_STRUCTS:
                continue
            made.append(self.from_c(struct) if self.is_out(struct) else self.to_c(struct))
        return "\n".join(made)

    def from_c(self, struct):
        name = naming.bare(struct["name"])
        lines = [f"func view{name}(world *World, c *C.{struct['name']}) {name} {{", f"\treturn {name}{{"]
        for field in struct["fields"]:
            at = f"c.{WORDS_C(field['name'])}"
            value = f"{NUMBERS[field['type']]}({at})"
            if field["form"] == "pointer":
                row = f"[{field['width']}]{NUMBERS[field['type']]}" if field["width"] > 1 else NUMBERS[field["type"]]
                value = f"viewOf[{row}](world, unsafe.Pointer({at}), int(c.{field['length']}))"
            lines.append(f"\t\t{naming.pascal(field['name'])}: {value},")
        return "\n".join(lines + ["\t}", "}", ""])

    def to_c(self, struct):
        name, lines = naming.bare(struct["name"]), []
        lines.append(f"// Arrays stay where they are until the pinner lets go.\nfunc (def *{name}) toC(pinner *runtime.Pinner) "
                     f"*C.{struct['name']} {{\n\tc := new(C.{struct['name']})")
        back = [f"func (def *{name}) fromC(c *C.{struct['name']}) {{"]
        slices = {field["length"]: field for field in struct["fields"] if field["form"] == "pointer"}
        for field in struct["fields"]:
            go = naming.pascal(field["name"]) if field["name"] != "cookie" else "cookie"
            at = f"c.{WORDS_C(field['name'])}"
            if field["form"] == "pointer":
                lines.append(f"\tif len(def.{go}) > 0 {{\n\t\tpinner.Pin(&def.{go}[0])\n\t\t{at} = (*C.{field['type']})"
                             f"(unsafe.Pointer(&def.{go}[0]))\n\t}}")
            elif field["name"] in slices and field["name"] != "frameCount":
                lines.append(f"\t{at} = C.int32_t(len(def.{naming.pascal(slices[field['name']]['name'])}))")
            elif field["form"] == "struct" or "count" in field:
                kind = self.type_of(field)
                lines.append(f"\t*(*{kind})(unsafe.Pointer(&{at})) = def.{go}")
                back.append(f"\tdef.{go} = *(*{kind})(unsafe.Pointer(&{at}))")
            else:
                lines.append(f"\t{at} = C.{field['type']}(def.{go})")
                back.append(f"\tdef.{go} = {self.number(field)}({at})")
        if "frameCount" in slices:
            lines.append("\tif len(def.FramePoints) > 0 {\n\t\tc.frameCount = C.int32_t(len(def.FramePoints))\n\t}")
        return "\n".join(lines + ["\treturn c", "}", "", *back, "}", ""])

    def methods(self):
        return "\n".join(Method(self, function).text() for function in self.of["functions"] if function["name"] not in BY_HAND)


def WORDS_C(name):
    """Cgo puts _ before fields that are words of Go."""
    return f"_{name}" if name in ("type", "range", "func", "map") else name


class Method:
    def __init__(self, go, function):
        self._go, self._function = go, function
        self._derived = naming.derived(function)
        self._given, self._before, self._passed, self._after = [], [], [], []
        self._kinds, self._values = [], []
        self._block, self._filled = {}, []  # what C reads and writes by pointer: in memory of a pool
        self._of = receiver(function["class"]) if function["class"] else ""
        self._world = "w" if function["class"] == "World" else f"{self._of}.World"

    @staticmethod
    def name(function):
        if function["name"] in BY_HAND:
            return BY_HAND[function["name"]]
        return re.sub(r"^Get(?=[A-Z])", "", function["method"]) if function["class"] else function["method"]

    def text(self):
        function = self._function
        of = function["class"]
        if of:
            self._passed.append(f"{self._world}.c")
        if of not in (None, "World"):
            self._passed.append(f"C.kiri{of}({self._of}.ID)")
        for parameter in function["parameters"][0 if not of else 1 if of == "World" else 2:]:
            self._parameter(parameter)
        receiver = "" if not of else "(w *World) " if of == "World" else f"({self._of} {of}) "
        body, results = self._body()
        head = f"func {receiver}{self.name(function)}({', '.join(self._given)}) {results} {{"
        return self._pool() + naming.comment(function["doc"], "// ") + "\n".join([head, *(f"\t{line}" for line in body), "}", ""])

    # ---- Memory that C reads and writes

    def _pool(self):
        fields = "".join(f"\t{name} {kind}\n" for name, kind in self._block.items())
        return f"var {self._pool_name()} pool[struct {{\n{fields}}}]\n\n" if self._block else ""

    def _pool_name(self):
        return f"pool{self._function['class'] or ''}{self._function['method']}"

    def _in_block(self, name, kind):
        self._block[name] = kind
        return f"&block.{name}"

    def _called(self, call):
        if not self._block:
            return [call]
        pool = self._pool_name()
        reads = any("answer." in line for line in [*self._after, *self._values])
        return [f"block := {pool}.take()", *self._filled, call, f"{'answer := ' if reads else ''}{pool}.give(block)"]

    def _body(self):
        function = self._function
        call = f"C.{function['name']}({', '.join(self._passed)})"
        if function["returns"] == "const char*":
            return [f"return C.GoString({call})"], "string"
        if function["returns"] == "void":
            return self._before + [*self._called(call), *self._after, f"return {', '.join(self._values)}"], self._kinds[0]
        if function["returns"] != "kiriResult":
            return [f"return {NUMBERS[function['returns']]}({call})"], NUMBERS[function["returns"]]
        pends = function.get("pends") and not self._kinds
        zero = [f"made{i}" for i in range(len(self._kinds))]
        lines = [f"var {name} {kind}" for name, kind in zip(zero, self._kinds)]
        failed = ", ".join([*zero, *(["false"] if pends else []), "err"])
        if function["class"]:
            lines += [f"if err := {self._world}.check(); err != nil {{", f"\treturn {failed}", "}"]
        lines += self._before + self._called(f"result := {call}")
        if function["name"] in naming.ENDS_VIEWS:
            lines.append("w.epoch++")
        if function["class"]:
            lines.append(f"runtime.KeepAlive({self._world})")
        world, of = self._world if function["class"] else "nil", function["class"]
        lines += [f"if err := failure({world}, \"{of + '.' if of else ''}{self.name(function)}\", result, {str(bool(function.get('changes'))).lower()}); err != nil {{",
                  f"\treturn {failed}", "}", *self._after]
        values = [*self._values, *(["result == C.KIRI_PENDING"] if pends else []), "nil"]
        kinds = [*self._kinds, *(["bool"] if pends else []), "error"]
        return lines + [f"return {', '.join(values)}"], f"({', '.join(kinds)})" if len(kinds) > 1 else kinds[0]

    def _parameter(self, parameter):
        name, form, direction = parameter["name"], parameter["form"], parameter["direction"]
        if name in self._derived:
            return
        if name == "capacity":
            self._passed.append("room")
        elif direction == "out" and name == "count":
            self._passed.append(self._in_block("count", "C.int32_t"))
            if not any(p["form"] in ("view",) or p.get("length") == "capacity" for p in self._function["parameters"]):
                self._kinds.append("int")
                self._values.append("int(answer.count)")
        else:
            getattr(self, f"_{direction}_{form}")(parameter)

    @staticmethod
    def _go_name(parameter):
        return WORDS.get(parameter["name"], parameter["name"])

    # ---- In

    def _in_number(self, parameter):
        name = self._go_name(parameter)
        self._given.append(f"{name} {self._go.number(parameter)}")
        self._passed.append(f"C.{parameter['type']}({name})")

    def _in_id(self, parameter):
        name = self._go_name(parameter)
        self._given.append(f"{name} {naming.bare(parameter['type'])}")
        self._passed.append(f"C.{parameter['type']}({name}.ID)")

    def _in_struct(self, parameter):
        name, kind = self._go_name(parameter), parameter["type"]
        self._given.append(f"{name} *{naming.bare(kind)}")
        if self._go.has_pointers(self._go.structs[kind]):
            self._before += ["var pinner runtime.Pinner", "defer pinner.Unpin()"]
            if parameter.get("nullable"):
                self._before += [f"var inC *C.{kind}", f"if {name} != nil {{", f"\tinC = {name}.toC(&pinner)", "}"]
                self._passed.append("inC")
            else:
                self._passed.append(f"{name}.toC(&pinner)")
        else:
            self._passed.append(f"(*C.{kind})(unsafe.Pointer({name}))")

    def _in_array(self, parameter):
        name, kind, length = self._go_name(parameter), parameter["type"], parameter["length"]
        if isinstance(length, int):
            array = f"[{length}]{NUMBERS[kind]}"
            self._given.append(f"{name} {'*' if parameter.get('nullable') else ''}{array}")
            at = name
            if not parameter.get("nullable"):
                at = self._in_block(name, array)
                self._filled.append(f"block.{name} = {name}")
            self._passed.append(f"(*C.{kind})(unsafe.Pointer({at}))")
        elif kind in self._go.ids:
            self._given.append(f"{name} []{naming.bare(kind)}")
            self._before.append(f"ids := idsOf({name})")
            self._passed += [f"(*C.{kind})(unsafe.Pointer(unsafe.SliceData(ids)))", "C.int32_t(len(ids))"]
        else:
            row = naming.bare(kind) if kind in self._go.structs else NUMBERS[kind]
            row = f"[{parameter['width']}]{row}" if parameter.get("width", 1) > 1 else row
            self._given.append(f"{name} []{row}")
            self._passed += [f"(*C.{kind})(unsafe.Pointer(unsafe.SliceData({name})))", f"C.int32_t(len({name}))"]

    def _in_bytes(self, parameter):
        name = self._go_name(parameter)
        kind = next(p["type"] for p in self._function["parameters"] if p["name"] == parameter["length"])
        self._given.append(f"{name} []byte")
        self._passed += [f"unsafe.Pointer(unsafe.SliceData({name}))", f"C.{kind}(len({name}))"]

    # ---- Out

    def _out_number(self, parameter):
        name, kind = parameter["name"], parameter["type"]
        self._passed.append(self._in_block(name, f"C.{kind}"))
        self._kinds.append("bool" if parameter.get("flag") else NUMBERS[kind])
        self._values.append(f"answer.{name} != 0" if parameter.get("flag") else f"{NUMBERS[kind]}(answer.{name})")

    def _out_id(self, parameter):
        name, kind = parameter["name"], naming.bare(parameter["type"])
        self._passed.append(self._in_block(name, f"C.{parameter['type']}"))
        self._kinds.append(kind)
        self._values.append(f"{kind}{{{self._world}, {kind}ID(answer.{name})}}")

    def _out_struct(self, parameter):
        name, kind = parameter["name"], parameter["type"]
        self._kinds.append(naming.bare(kind))
        struct = self._go.structs[kind]
        if not self._go.has_pointers(struct):
            self._passed.append(f"(*C.{kind})(unsafe.Pointer({self._in_block(name, naming.bare(kind))}))")
            self._values.append(f"answer.{name}")
            return
        self._passed.append(self._in_block(name, f"C.{kind}"))
        if self._go.is_out(struct):
            self._values.append(f"view{naming.bare(kind)}({self._world}, &answer.{name})")
        else:
            self._after += [f"var made {naming.bare(kind)}", f"made.fromC(&answer.{name})"]
            self._values.append("made")

    def _out_view(self, parameter):
        kind = parameter["type"]
        row = naming.bare(kind) if kind in self._go.structs else self._go.number(parameter)
        row = f"[{parameter['width']}]{row}" if parameter["width"] > 1 else row
        self._passed.append(self._in_block(parameter["name"], f"*C.{kind}"))
        self._kinds.append(f"View[{row}]")
        self._values.append(f"viewOf[{row}]({self._world}, unsafe.Pointer(answer.{parameter['name']}), int(answer.count))")

    def _out_array(self, parameter):
        name, kind, length = parameter["name"], parameter["type"], parameter["length"]
        if isinstance(length, int):
            array = f"[{length}]{NUMBERS[kind]}"
            self._passed.append(f"(*C.{kind})(unsafe.Pointer({self._in_block(name, array)}))")
            self._kinds.append(array)
            self._values.append(f"answer.{name}")
            return
        self._kinds.append(f"[]{naming.bare(kind)}")
        if length == "capacity":
            self._before += ["room := C.int32_t(64)", "again:", f"{name} := make([]C.{kind}, room)"]
            self._passed.append(f"unsafe.SliceData({name})")
            self._after += ["if answer.count > room {", "\troom = answer.count", "\tgoto again", "}"]
            self._values.append(f"things[{naming.bare(kind)}]({self._world}, {name}[:answer.count])")
        else:
            self._before.append(f"{name} := make([]C.{kind}, len(ids))")
            self._passed.append(f"unsafe.SliceData({name})")
            self._values.append(f"things[{naming.bare(kind)}]({self._world}, {name})")


def formatted(text):
    """As gofmt has it: columns of fields, constants and keyed values are aligned, labels stand out."""
    lines, run, inside = [], [], False

    def flush():
        width = max((len(first) for first, _ in run), default=0)
        lines.extend(f"{first:<{width}} {rest}" for first, rest in run)
        run.clear()

    for line in text.split("\n"):
        entry = re.fullmatch(r"(\t+\"?[-\w]+\"?:) (.+)", line) or (inside and re.fullmatch(r"(\t+\w+) (.+)", line))
        if entry:
            run.append(entry.groups())
            continue
        flush()
        inside = line.endswith(("struct {", "const (")) or inside and not line.lstrip().startswith(("}", ")"))
        lines.append(line[1:] if re.fullmatch(r"\t+\w+:", line) else line)
    flush()
    return "\n".join(lines)


def files(description):
    go = Go(description)
    text = "// Code generated from kiri.h by make bindings. DO NOT EDIT.\n\npackage kiri\n\n// #include <kiri/kiri.h>\nimport \"C\"\n\n"
    text += "import (\n\t\"runtime\"\n\t\"unsafe\"\n)\n\n"
    text += f"// Version of the header.\nconst Version = \"{description['version']}\"\n\n"
    text += "\n".join([go.enums(), go.types(), go.layouts(), go.converters(), go.methods()])
    names = "".join(f"\t\"{function['name']}\": \"{function['class'] or ''}.{Method.name(function)}\",\n"
                    for function in description["functions"])
    text += f"\n// For the test that none is missing.\nvar functions = map[string]string{{\n{names}}}\n"
    return {"bindings/go/kiri.go": formatted(text)}
