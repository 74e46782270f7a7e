"""Kiri.cs: the classes, over Native.cs."""

import re

import naming
from csharp_native import HEAD, VIEWS, Native, field_name, named_array, summary

# By hand in World.cs.
BY_HAND = {"kiriDefaultWorldDef", "kiriCreateWorld", "kiriDestroyWorld", "kiriWorld_GetLastError", "kiriWorld_Replay",
           "kiriSheet_CopyVertices", "kiriGetVersion", "kiriWorld_DebugDraw"}
KEYWORDS = {"def", "in", "out", "ref", "base", "object", "string", "params", "is", "as", "fixed"}

HANDLE = """    public unsafe partial struct {name} : IEquatable<{name}>
    {{
        public readonly World World;
        public readonly {name}Id Id;

        internal {name}(World world, {name}Id id) {{ World = world; Id = id; }}
        public bool IsNone {{ get {{ return Id.IsNone; }} }}
        public bool Equals({name} other) {{ return World == other.World && Id == other.Id; }}
        public override bool Equals(object other) {{ return other is {name} && Equals(({name})other); }}
        public override int GetHashCode() {{ return Id.GetHashCode(); }}
        public static implicit operator {name}Id({name} handle) {{ return handle.Id; }}
"""

VIEW = """    /// <summary>An array of the library, without a copy. It may be used until the next tick.</summary>
    public unsafe struct {view}
    {{
        readonly World world;
        readonly int epoch;
        readonly {kind}* rows;
        readonly int length;

        internal {view}(World world, void* rows, int length)
        {{
            this.world = world;
            this.epoch = world.Epoch;
            this.rows = ({kind}*)rows;
            this.length = rows == null ? 0 : length;
        }}

        /// <summary>Where it is. Nothing guards what is read there.</summary>
        public {kind}* Pointer
        {{
            get
            {{
                if (world != null && world.Epoch != epoch) World.ThrowStale();
                return rows;
            }}
        }}

        public int Length {{ get {{ return length; }} }}
        public bool IsNull {{ get {{ return rows == null; }} }}

        public {kind} this[int i]
        {{
            get
            {{
                if ((uint)i >= (uint)length) World.ThrowRange();
                return Pointer[i];
            }}
        }}

        /// <summary>Copies so many, from the first on.</summary>
        public void CopyTo({kind}[] into)
        {{
            if (into.Length < length) World.ThrowRange();
            {kind}* from = Pointer;
            for (int i = 0; i < length; ++i) into[i] = from[i];
        }}

        public {kind}[] ToArray()
        {{
            var into = new {kind}[length];
            CopyTo(into);
            return into;
        }}
#if NETSTANDARD2_1_OR_GREATER || NETCOREAPP || UNITY_2021_2_OR_NEWER

        /// <summary>Nothing guards it after this.</summary>
        public ReadOnlySpan<{kind}> AsSpan() {{ return new ReadOnlySpan<{kind}>(Pointer, length); }}
#endif

        public Enumerator GetEnumerator() {{ return new Enumerator(this); }}

        public struct Enumerator
        {{
            readonly {view} of;
            int at;

            internal Enumerator({view} of) {{ this.of = of; at = -1; }}
            public bool MoveNext() {{ return ++at < of.length; }}
            public {kind} Current {{ get {{ return of[at]; }} }}
        }}
    }}
"""


def local(name):
    return "@" + name if name in KEYWORDS else name


class Methods:
    def __init__(self, description):
        self._d = description
        self.native = Native(description)
        self.structs = {struct["name"]: struct for struct in description["structs"]}
        self.ids = {kind["name"] for kind in description["ids"]}

    def text(self):
        parts = [HEAD + "using System;\n\nnamespace Kiri\n{"]
        parts += [VIEW.format(view=self.view_of(kind), kind=kind) for kind in self._viewed()]
        parts += [self._view_struct(struct) for struct in self._d["structs"] if struct["name"] in VIEWS]
        classes = {kind: [] for kind in ["World", None]}
        for function in self._d["functions"]:
            if function["name"] not in BY_HAND and not function["name"].startswith("kiriDefault"):
                classes.setdefault(function["class"], []).append("\n".join(Call(self, function).lines()))
        for name, methods in classes.items():
            head = {"World": "    public sealed unsafe partial class World\n    {\n" + self._gets(),
                    None: "    /// <summary>Functions without a world.</summary>\n    public static unsafe partial class Library\n    {\n"}
            parts.append(head.get(name) or HANDLE.format(name=name))
            parts.append("\n\n".join(methods) + "\n    }\n")
        return "\n".join(parts + ["}\n"])

    def _gets(self):
        return "\n".join(f"        public {naming.bare(kind)} Get({naming.bare(kind)}Id id) "
                         f"{{ return new {naming.bare(kind)}(this, id); }}" for kind in sorted(self.ids)) + "\n"

    # ---- Views

    def element(self, kind):
        return (naming.bare(kind) + "Id" if kind in self.ids else naming.bare(kind) if kind in self.structs else
                self.native._number(kind))

    @staticmethod
    def view_of(kind):
        return f"{naming.pascal(kind)}View"

    def _viewed(self):
        kinds = {self.element(p["type"]) for f in self._d["functions"] for p in f["parameters"] if p["form"] == "view"}
        for name in VIEWS:
            kinds |= {self.element(field["type"]) for field in self.structs[name]["fields"] if field["form"] == "pointer"}
        return sorted(kinds)

    def _view_struct(self, struct):
        name = naming.bare(struct["name"])
        lines = summary(struct["doc"], "    ") + [f"    public unsafe struct {name}View", "    {",
                 "        readonly World world;", f"        readonly Native{name} raw;", "",
                 f"        internal {name}View(World world, Native{name} raw) {{ this.world = world; this.raw = raw; epoch = world.Epoch; }}",
                 "        readonly int epoch;", "",
                 "        World Now()", "        {", "            if (world.Epoch != epoch) World.ThrowStale();",
                 "            return world;", "        }"]
        for field in struct["fields"]:
            member = naming.pascal(field["name"])
            lines += [""] + summary(field["doc"], "        ")
            if field["form"] == "pointer":
                view = self.view_of(self.element(field["type"]))
                length = f"raw.{field['length']}" if field["width"] == 1 else f"{field['width']} * raw.{field['length']}"
                lines.append(f"        public {view} {member} {{ get {{ return new {view}(Now(), raw.{field['name']}, {length}); }} }}")
            else:
                lines.append(f"        public {self.native.field_type(field)} {member} {{ get {{ return raw.{field_name(struct, field)}; }} }}")
        return "\n".join(lines + ["    }", ""])


class Call:
    def __init__(self, methods, function):
        self._m, self._f = methods, function
        self._takes, self._before, self._fixed, self._arguments, self._outs = [], [], [], [], []
        self._optional = []
        parameters = function["parameters"]
        self._growing = any(p.get("length") == "capacity" for p in parameters)
        self._counts = {p["length"] for p in parameters if p["form"] in ("array", "bytes", "view", "strided")
                        and isinstance(p["length"], str)}
        self._world = {"World": "this", None: None}.get(function["class"], "World")
        for i, p in enumerate(parameters):
            self._parameter(i, p)

    # ---- Parameters

    def _parameter(self, i, p):
        name, form = local(p["name"]), p["form"]
        if form == "world":
            self._arguments.append("Handle" if self._world == "this" else "World.Handle")
        elif i == 1 and form == "id" and p["direction"] == "in" and self._f["class"] == naming.bare(p["type"]):
            self._arguments.append("Id")
        elif p["name"] in self._counts and p["direction"] == "in":
            self._arguments.append(self._count(p))
        elif p["direction"] == "out" and p["name"] in ("count", "size") and (self._growing or p["name"] in self._counts):
            kind = self._m.native._number(p["type"])
            self._before.append(f"{kind} {p['name']} = 0;")
            self._arguments.append(f"&{p['name']}")
            if self._growing:
                self._outs.append((kind, p["name"]))
        else:
            getattr(self, f"_{p['direction']}_{form}")(p, name)

    def _count(self, p):
        """Of the host's array: all of it, or what the host says."""
        kind = self._m.native._number(p["type"])
        source = next(q for q in self._f["parameters"] if q.get("length") == p["name"])
        rows = f"{local(source['name'])}.Length" + (f" / {source['width']}" if source.get("width", 1) > 1 else "")
        if p["name"] == "capacity":
            others = [q for q in self._f["parameters"] if q.get("length") == "capacity" and q is not source]
            for q in others:
                self._before.append(f"World.CheckRoom({local(q['name'])}, {q['width']} * {local(source['name'])}.Length);")
            return f"({local(source['name'])} == null ? 0 : {rows})"
        if any(q["direction"] == "out" and q.get("length") == p["name"] and q is not source for q in self._f["parameters"]):
            other = next(q for q in self._f["parameters"] if q["direction"] == "out" and q.get("length") == p["name"])
            self._before.append(f"World.CheckRoom({local(other['name'])}, {local(source['name'])}.Length);")
        if source["form"] == "bytes":
            return rows if kind == "int" else rows
        self._optional.append(f"int {p['name']} = -1")
        self._before.append(f"if ({p['name']} < 0) {p['name']} = {rows};")
        self._before.append(f"if ({p['name']} > {rows}) World.ThrowRange();")
        return p["name"]

    def _in_number(self, p, name):
        kind = naming.bare(p["enum"]) if p.get("enum") else self._m.native._number(p["type"])
        self._takes.append(f"{kind} {name}")
        self._arguments.append(f"(int){name}" if p.get("enum") else name)

    def _in_id(self, p, name):
        self._takes.append(f"{naming.bare(p['type'])}Id {name}")
        self._arguments.append(name)

    def _in_struct(self, p, name):
        struct = self._m.structs[p["type"]]
        kind = self._m.native.struct_name(p["type"])
        hosted = any(field["form"] == "callback" for field in struct["fields"])
        if p.get("nullable"):
            self._optional.append(f"{kind}? {name} = null")
            self._before.append(f"{kind} {p['name']}Value = {name}.GetValueOrDefault();")
            self._arguments.append(f"{name}.HasValue ? &{p['name']}Value : null")
            return
        arrays = [] if hosted else [field for field in struct["fields"] if field["form"] == "pointer"]
        for field in arrays:
            taken = f"{self._m.native._number(field['type'])}[] {field['name']}"
            if field["nullable"]:
                self._optional.append(taken + " = null")
            else:
                self._takes.append(taken)
            pointer = f"{field['name']}Rows"
            self._fixed.append(f"fixed ({self._m.native._number(field['type'])}* {pointer} = {field['name']})")
            counted = field_name(struct, next(f for f in struct["fields"] if f["name"] == field["length"]))
            condition = f"if ({field['name']} != null) " if field["nullable"] else ""
            self._before.append(f"{condition}{name}.{counted} = {field['name']}.Length / {field['width']};")
        self._takes.append(f"{kind} {name}")
        if arrays:
            self._late = [f"{name}.{field['name']} = {field['name']}Rows;" for field in arrays]
        self._arguments.append(f"&{name}")

    def _inout_struct(self, p, name):
        kind = self._m.native.struct_name(p["type"])
        self._takes.append(f"ref {kind} {name}")
        self._fixed.append(f"fixed ({kind}* {p['name']}Value = &{name})")
        self._arguments.append(f"{p['name']}Value")

    def _in_array(self, p, name):
        kind = self._m.element(p["type"])
        if isinstance(p["length"], int):
            kind, number = named_array(kind, p["length"]), kind
            if p["nullable"]:
                self._optional.append(f"{kind}? {name} = null")
                self._before.append(f"{kind} {p['name']}Value = {name}.GetValueOrDefault();")
                self._arguments.append(f"{name}.HasValue ? ({number}*)&{p['name']}Value : null")
            else:
                self._takes.append(f"{kind} {name}")
                self._arguments.append(f"({number}*)&{name}")
            return
        self._host_array(kind, p, name)

    def _host_array(self, kind, p, name):
        self._takes.append(f"{kind}[] {name}")
        self._fixed.append(f"fixed ({kind}* {p['name']}Rows = {name})")
        self._arguments.append(f"{p['name']}Rows")

    def _in_bytes(self, p, name):
        self._host_array("byte", p, name)

    _out_bytes = _in_bytes

    def _out_number(self, p, name):
        kind = self._m.native._number(p["type"])
        self._before.append(f"{kind} {p['name']}Value = 0;")
        self._arguments.append(f"&{p['name']}Value")
        self._outs.append(("bool", f"{p['name']}Value != 0", name) if p.get("flag") else (kind, f"{p['name']}Value", name))

    def _out_id(self, p, name):
        kind = naming.bare(p["type"])
        self._before.append(f"var {p['name']}Value = new {kind}Id();")
        self._arguments.append(f"&{p['name']}Value")
        self._outs.append((kind, f"new {kind}({self._world}, {p['name']}Value)", name))

    def _out_struct(self, p, name):
        kind = self._m.native.struct_name(p["type"])
        self._before.append(f"var {p['name']}Value = new {kind}();")
        self._arguments.append(f"&{p['name']}Value")
        if p["type"] in VIEWS:
            view = naming.bare(p["type"]) + "View"
            self._outs.append((view, f"new {view}({self._world}, {p['name']}Value)", name))
        else:
            self._outs.append((kind, f"{p['name']}Value", name))

    def _out_view(self, p, name):
        kind = self._m.element(p["type"])
        view, length = self._m.view_of(kind), p["length"] if p["width"] == 1 else f"{p['width']} * {p['length']}"
        self._before.append(f"{kind}* {p['name']}Value = null;")
        self._arguments.append(f"&{p['name']}Value")
        self._outs.append((view, f"new {view}({self._world}, {p['name']}Value, {length})", name))

    def _out_array(self, p, name):
        kind = self._m.element(p["type"])
        if isinstance(p["length"], int):
            made = named_array(kind, p["length"])
            self._before.append(f"var {p['name']}Value = new {made}();")
            self._arguments.append(f"({kind}*)&{p['name']}Value")
            self._outs.append((made, f"{p['name']}Value", name))
        elif re.fullmatch(r"\w+", p["length"]):
            self._host_array(kind, p, name)
        else:
            self._takes.append(f"out {kind}[] {name}")
            self._before.append(f"{name} = new {kind}[{re.sub(r'[a-z]+', lambda m: f'Math.Max(0, Math.Min({m[0]}, 4096))', p['length'])}];")
            self._fixed.append(f"fixed ({kind}* {p['name']}Rows = {name})")
            self._arguments.append(f"{p['name']}Rows")

    # ---- The method

    def lines(self):
        f = self._f
        missing = any(p["type"] == "kiriHit" for p in f["parameters"])
        outs = [(*out, out[1])[:3] for out in self._outs]
        returned, gives, after = "void", None, []
        if f["returns"] == "const char*":
            returned, gives = "string", "text"
        elif missing:
            returned, gives = "bool", "hitValue.Triangle >= 0"
        elif len(outs) == 1:
            returned, gives = outs[0][0], outs[0][1]
        elif f.get("pends") and not outs:
            returned, gives = "Status", "result == 0 ? Status.Done : Status.Pending"
        takes = list(self._takes)
        if missing or len(outs) > 1:
            takes += [f"out {kind} {name}" for kind, _, name in outs]
            after = [f"{name} = {value};" for _, value, name in outs]
        static = "static " if f["class"] is None else ""
        lines = summary(f["doc"], "        ")
        lines.append(f"        public {static}{returned} {f['method']}({', '.join(takes + self._optional)})")
        lines.append("        {")
        body = [*self._before]
        call = f"Native.{f['name']}({', '.join(self._arguments)})"
        if gives == "text":
            return lines + [f"            return World.Text({call});", "        }"]
        if f["name"] == "kiriWorld_Tick":
            body.append("EndViews();")
        check = "Check" if f.get("changes") else "CheckRead" if f["class"] else "CheckStatic"
        named = f"{f['class'] or 'Library'}.{f['method']}"
        checked = f"{'' if f['class'] and self._world == 'this' else 'World.'}{check}({call}, \"{named}\")"
        late = getattr(self, "_late", [])
        body += self._fixed
        statement = f"{'result = ' if 'result' in (gives or '') else ''}{checked};"
        if statement.startswith("result"):
            body.insert(0, "int result;")
        body += ["{", *["    " + line for line in late], "    " + statement, "}"] if self._fixed or late else [statement]
        body += after
        if gives:
            body.append(f"return {gives};")
        return lines + ["            " + line for line in body] + ["        }"] + self._allocating()

    def _allocating(self):
        """The same for a host that has no array yet."""
        arrays = [p for p in self._f["parameters"] if p.get("length") == "capacity"]
        if len(arrays) != 1:
            return []
        kind = "byte" if arrays[0]["form"] == "bytes" else self._m.element(arrays[0]["type"])
        name = arrays[0]["name"]
        takes = [take for take in self._takes if not take.endswith(" " + name)]
        others = [take.split()[1] + ", " for take in takes]
        return ["", f"        public {kind}[] {self._f['method']}({', '.join(takes)})", "        {",
                f"            var {name} = new {kind}[{self._f['method']}({''.join(others)}null)];",
                f"            {self._f['method']}({''.join(others)}{name});", f"            return {name};", "        }"]
