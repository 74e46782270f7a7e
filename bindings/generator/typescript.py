"""The declarations of kiri.js for TypeScript, with the comments of the header."""

import re
import textwrap

NUMBERS = "ArrayLike<number>"

HEAD = """/// <reference lib="esnext.disposable" />
// Made from include/kiri/kiri.h by bindings/generator. Do not edit.

/** Loads kiri.wasm, once, before anything else here is used. source: its URL, bytes or module; else it lies beside kiri.js. */
export function load(source?: string | URL | BufferSource | Response | WebAssembly.Module): Promise<void>;

/** All functions as C has them, with pointers as numbers: `layouts` has the structs. Null before load(). */
export const wasm: Record<string, any> & { memory: WebAssembly.Memory };

/** Bytes of structs in that memory, and where their fields are. */
export const layouts: Record<string, { size: number, fields: Record<string, number> }>;

/** Of the header that this file is made from. */
export const VERSION: string;

/** What failed, and the library's line about it. */
export class KiriError extends Error {
    readonly code: ResultCode;
}

/** Numbers of the library, without a copy. After the next tick they are gone, and `array` throws. Ask for it anew after
 *  other calls: the memory may have grown. */
export class View<A> {
    readonly length: number;
    readonly array: A;
}

/** Structs of the library, read one by one. After the next tick they are gone, and `at` throws. */
export class Rows<T> implements Iterable<T> {
    readonly length: number;
    /** into: what to read into, for those who make no garbage. */
    at(index: number, into?: T): T;
    [Symbol.iterator](): Iterator<T>;
}
"""


class Declarations:
    def __init__(self, maker):
        self.maker = maker
        self.camels = {}

    def doc(self, text, indent=0):
        """Names of C become those of JavaScript, where it is plain which."""
        if not text:
            return []
        text = re.sub(r"\bkiri([A-Z][a-z]\w*)_([A-Z]\w*)", lambda m: f"{m[1]}.{m[2][0].lower()}{m[2][1:]}", text)
        pad = " " * indent
        lines = []
        for paragraph in text.replace("*/", "* /").split("\n"):
            lines += textwrap.wrap(paragraph, 116 - indent, break_long_words=False, break_on_hyphens=False) or [""]
        if len(lines) == 1:
            return [f"{pad}/** {lines[0]} */"]
        return [f"{pad}/** {lines[0]}"] + [f"{pad} *  {line}".rstrip() for line in lines[1:-1]] + [f"{pad} *  {lines[-1]} */"]

    def enum(self, enum, value_names, short):
        if len(enum["values"]) == 1:
            value = enum["values"][0]
            yield from self.doc(enum["doc"] or value["doc"])
            yield f"export const {value['name'][5:]}: {value['value']};"
            return
        yield from self.doc(enum["doc"])
        yield f"export enum {short(enum['name'])} {{"
        for name, value in value_names(enum):
            yield from self.doc(value["doc"], 4)
            yield f"    {name} = {value['value']},"
        yield "}"

    def of_field(self, f, got):
        """The type that is read, or may be given."""
        short = self.short
        if f["form"] == "struct":
            return short(f["type"]) if got else f"Partial<{short(f['type'])}>"
        if f["form"] == "id":
            return f"{short(f['type'])} | null"
        if f["form"] == "pointer":
            if f["type"] == "void":
                return "Uint8Array | null"
            array = self.arrays[self.maker.number(f["type"])]
            return (f"{array}" if got else NUMBERS) + (" | null" if f["nullable"] or not got else "")
        if "count" in f:
            return "number[]" if got else NUMBERS
        if f.get("flag"):
            return "boolean" if got else "boolean | number"
        return self.short(f["enum"]) if f.get("enum") else "bigint" if f["type"] == "uint64_t" else "number"

    def struct(self, struct):
        maker, name = self.maker, self.short(struct["name"])
        if struct["name"] == "kiriEvent":
            yield from self.events(struct)
            return
        got, given = struct["name"] in maker.got, struct["name"] in maker.given
        if got:
            yield from self.doc(struct["doc"] + (" Arrays are those of the library: after the next tick they throw." if maker.shows(struct) and not given else ""))
            yield f"export class {name} {{"
            yield from self.fields(struct, True)
            yield "}"
        if given:
            yield from self.doc(f"What a host gives as {name}: what is left out is " +
                                ("as the default has it." if "default" in struct else "0."))
            yield f"export interface {name}Given {{"
            yield from self.fields(struct, False)
            if struct["name"] == "kiriWorldDef":
                yield "    /** Gets one line for each error. */"
                yield "    log?: (line: string) => void;"
                yield "    /** Seconds, for the profile. */"
                yield "    clock?: () => number;"
                yield "    /** Gets the next bytes of the recording. */"
                yield "    record?: (bytes: Uint8Array) => void;"
            if struct["name"] == "kiriDebugDraw":
                for name, what in (("points", "one vertex each"), ("lines", "two"), ("triangles", "three")):
                    yield f"    /** Gets {name}, {what}. vertices: x, y, z and a color a row; colors: the same memory. */"
                    yield f"    {name}?: (vertices: Float32Array, colors: Uint32Array, count: number) => void;"
            yield "}"

    def fields(self, struct, got):
        counted = set() if got else {f["length"] for f in struct["fields"] if f.get("length")} - {"frameCount"}
        for f in self.maker.fields(struct):
            if f["name"] in counted or not got and f["type"] == "void":
                continue
            yield from self.doc(f["doc"], 4)
            shown = got and f["form"] == "pointer" and struct["name"] not in self.maker.given
            given = self.of_field(f, got) if got or f["form"] != "struct" else f"{self.short(f['type'])}Given"
            yield f"    {'readonly ' if shown else ''}{f['name']}{'' if got else '?'}: {given};"

    def events(self, struct):
        fields = {f["name"]: f for f in struct["fields"]}
        enum = next(e for e in self.maker.all["enums"] if e["name"] == "kiriEventType")
        yield from self.doc(struct["doc"])
        yield "export type Event ="
        rows = []
        for name, value in self.value_names(enum):
            filled = "; ".join(f"{n}: {self.of_field(fields[n], True).replace(' | null', '')}"
                               for n in self.maker.all["eventFields"][value["name"]])
            rows.append(f"    {{ type: EventType.{name}; {filled} }}")
        yield " |\n".join(rows) + ";"

    # ---- Functions

    def argument(self, function, argument):
        optional = "=" in argument
        name = argument.split(" = ")[0]
        p = next(p for p in function["parameters"] if p["name"] == name)
        return f"{name}{'?' if optional else ''}: {self.of_argument(p)}"

    def of_argument(self, p):
        nullable = " | null" if p.get("nullable") else ""
        if p["form"] == "struct":
            return self.short(p["type"]) + ("" if p["direction"] == "inout" else "Given") + nullable
        if p["form"] == "id":
            return self.short(p["type"]) + nullable
        if p["form"] == "bytes":
            return "Uint8Array"
        if p["form"] == "strided":
            return "Float32Array | null"
        if p["form"] == "array":
            if p["type"] in self.maker.structs:
                return f"{self.short(p['type'])}Given[]"
            if p["type"] in self.maker.ids:
                return f"{self.short(p['type'])}[]"
            return NUMBERS + nullable
        if p.get("enum"):
            return self.short(p["enum"])
        return {"int64_t": "number", "uint64_t": "number | bigint"}.get(p["type"], "number")

    def of_result(self, p):
        if p["form"] == "struct":
            return self.short(p["type"])
        if p["form"] == "id":
            return f"{self.short(p['type'])} | null" if p["name"] in ("detached",) or p["type"] == "kiriSheet" and \
                p["name"] == "sheet" and p.get("hit") else self.short(p["type"])
        if p["form"] == "bytes":
            return "Uint8Array"
        if p["form"] in ("array", "view"):
            if p["type"] in self.maker.structs:
                return f"Rows<{self.short(p['type'])}>"
            if p["type"] in self.maker.ids:
                return f"({self.short(p['type'])} | null)[]" if p["name"] == "detached" else f"{self.short(p['type'])}[]"
            array = self.arrays[self.maker.number(p["type"])]
            return f"View<{array}>" if p["form"] == "view" else array
        if p.get("flag"):
            return "boolean"
        return "bigint" if p["type"] == "uint64_t" else "number"

    def function(self, function, call, indent):
        list(call.text())  # fills results
        parameters = {p["name"]: p for p in function["parameters"]}
        arguments = [self.argument(function, a) for a in call.arguments]
        if call.into:
            arguments.append(f"into?: {call.into.split('new ')[1][:-2]}")
        if function["returns"] == "void":
            result = "void"
        elif function["returns"] == "const char*":
            result = "string"
        elif function["returns"] != "kiriResult":
            result = "number"
        elif not call.results:
            result = "ResultCode"
        elif len(call.results) == 1:
            result = self.of_result(parameters[call.results[0][0]])
        else:
            result = "{ " + ", ".join(f"{name}: {self.of_result(parameters[name])}" for name, _ in call.results) + " }"
            if function["name"] == "kiriWorld_Raycast":
                result = result.replace("sheet: Sheet,", "sheet: Sheet | null,")
        yield from self.doc(function["doc"], indent)
        head = "export function " if function["class"] is None else " " * indent
        yield f"{head}{call.name}({', '.join(arguments)}): {result};"


def declarations(maker):
    from to_javascript import ARRAYS, camel, short, value_names
    d = Declarations(maker)
    d.short, d.arrays, d.value_names = short, ARRAYS, value_names
    lines = [HEAD]
    for enum in maker.all["enums"]:
        lines += [*d.enum(enum, value_names, short), ""]
    for struct in maker.all["structs"]:
        lines += [*d.struct(struct), ""]
        if "default" in struct:
            name = short(struct["name"])
            lines += [f"export function {camel(short(struct['default']))}(into?: {name}): {name};", ""]
    made = {"kiriCreateWorld", "kiriDestroyWorld"} | {s["default"] for s in maker.all["structs"] if "default" in s}
    for function in maker.functions:
        if function["class"] is None and function["name"] not in made:
            lines += [*d.function(function, maker.call(function), 0), ""]
    for name in ["World"] + [short(i) for i in maker.ids]:
        if name == "World":
            lines += ["/** A world, empty at first. Destroy it when it is done with: its memory is not JavaScript's. */",
                      "export class World {", "    /** def: what differs from defaultWorldDef(). */",
                      "    constructor(def?: WorldDefGiven);", "    readonly isAlive: boolean;",
                      "    /** Frees the world and all that is in it; once is enough. */", "    destroy(): void;",
                      "    /** For `using world = new World()`. */", "    [Symbol.dispose](): void;"]
        else:
            lines += [f"export class {name} {{", "    readonly world: World;",
                      "    /** Two that are the same have the same id. */", "    readonly id: number;"]
        for function in maker.functions:
            if function["class"] == name and function["name"] not in made:
                lines += list(d.function(function, maker.call(function), 4))
        lines += ["}", ""]
    return "\n".join(lines).rstrip("\n") + "\n"
