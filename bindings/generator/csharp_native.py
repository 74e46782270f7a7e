"""Native.cs: functions, structs that are laid out as in C, enums, ids."""

import re
from xml.sax.saxutils import escape

import naming

NUMBERS = {"int32_t": "int", "uint32_t": "uint", "int64_t": "long", "uint64_t": "ulong", "uint16_t": "ushort",
           "float": "float", "double": "double", "void": "void", "char": "byte"}
# Of the header's structs these are seen by the host through a guard, or through World, only.
INTERNAL = {"kiriMesh", "kiriSolid", "kiriPieceMesh", "kiriReplay", "kiriWorldDef"}
# Of these a host gets a guarded view.
VIEWS = {"kiriMesh", "kiriSolid", "kiriPieceMesh"}
CONSTANTS = {"kiriBudgetLimit", "kiriNoteLimit"}
HEAD = "// Made from kiri.h by `make bindings`.\n"


def named_array(kind, count):
    """Float3 for three floats."""
    return f"{kind.capitalize()}{count}"


def summary(doc, pad):
    if not doc:
        return []
    lines = naming.wrapped(escape(doc), pad + "/// ", 120)
    lines[0] = lines[0].replace("/// ", "/// <summary>", 1)
    return lines[:-1] + [lines[-1] + "</summary>"]


def is_private(struct, field):
    """Stamps, pointers and what counts these: methods fill them in."""
    counts = {f.get("length") for f in struct["fields"] if f["form"] == "pointer"} - {"frameCount"}
    return field["form"] == "pointer" or field["name"] in counts or field["name"] == "cookie"


def field_name(struct, field):
    hidden = is_private(struct, field) and struct["name"] not in INTERNAL - VIEWS
    return field["name"] if hidden else naming.pascal(field["name"])


class Native:
    def __init__(self, description):
        self._d = description
        self._ids = {kind["name"] for kind in description["ids"]}
        self._structs = {struct["name"]: struct for struct in description["structs"]}
        self._callbacks = {callback["name"] for callback in description["callbacks"]}

    def text(self):
        parts = [HEAD + "using System;\nusing System.Runtime.InteropServices;\n\nnamespace Kiri\n{"]
        parts += map(self._array, self._arrays_once())
        parts += map(self._id, self._d["ids"])
        parts += [self._enum(enum) for enum in self._d["enums"] if enum["name"] not in CONSTANTS]
        parts += map(self._struct, self._d["structs"])
        parts += [self._functions(), "}\n"]
        return "\n".join(parts)

    # ---- Types

    def _number(self, kind):
        return NUMBERS[self._d["aliases"].get(kind, kind)]

    def _arrays(self):
        """The fixed arrays that there are: (number, count)."""
        for struct in self._d["structs"]:
            for field in struct["fields"]:
                if "count" in field:
                    yield self._number(field["type"]), field["count"]
        for function in self._d["functions"]:
            for p in function["parameters"]:
                if p["form"] == "array" and isinstance(p["length"], int):
                    yield self._number(p["type"]), p["length"]

    def _arrays_once(self):
        return sorted(set(self._arrays()))

    @staticmethod
    def _array(made):
        kind, count = made
        name = named_array(kind, count)
        names = "XYZW"[:count] if count <= 3 else [f"M{i}" for i in range(count)]
        parameters = ", ".join(f"{kind} {n.lower()}" for n in names)
        lines = [f"    /// <summary>{count} numbers, one after the other.</summary>",
                 "    [StructLayout(LayoutKind.Sequential)]", f"    public unsafe struct {name}", "    {",
                 f"        public {kind} {', '.join(names)};", "",
                 f"        public {name}({parameters})", "        {"]
        lines += [f"            {n} = {n.lower()};" for n in names]
        lines += ["        }", "", f"        public {kind} this[int i]", "        {",
                  "            get", "            {", f"                if ((uint)i >= {count}) throw new IndexOutOfRangeException();",
                  f"                fixed ({kind}* first = &{names[0]}) return first[i];", "            }",
                  "            set", "            {", f"                if ((uint)i >= {count}) throw new IndexOutOfRangeException();",
                  f"                fixed ({kind}* first = &{names[0]}) first[i] = value;", "            }", "        }"]
        if name == "Float3":
            lines += ["#if UNITY_2019_1_OR_NEWER || KIRI_UNITY",
                      "        public static implicit operator Float3(UnityEngine.Vector3 v) { return new Float3(v.x, v.y, v.z); }",
                      "        public static implicit operator UnityEngine.Vector3(Float3 v) { return new UnityEngine.Vector3(v.X, v.Y, v.Z); }",
                      "#endif"]
        if name == "Float2":
            lines += ["#if UNITY_2019_1_OR_NEWER || KIRI_UNITY",
                      "        public static implicit operator Float2(UnityEngine.Vector2 v) { return new Float2(v.x, v.y); }",
                      "        public static implicit operator UnityEngine.Vector2(Float2 v) { return new UnityEngine.Vector2(v.X, v.Y); }",
                      "#endif"]
        return "\n".join(lines + ["    }", ""])

    @staticmethod
    def _id(kind):
        name = naming.bare(kind["name"])
        return f"""    /// <summary>The number of a {name.lower()}; 0 is none. World.Get makes a {name} of it.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct {name}Id : IEquatable<{name}Id>
    {{
        public readonly uint Value;

        public {name}Id(uint value) {{ Value = value; }}
        public bool IsNone {{ get {{ return Value == 0; }} }}
        public bool Equals({name}Id other) {{ return Value == other.Value; }}
        public override bool Equals(object other) {{ return other is {name}Id && Equals(({name}Id)other); }}
        public override int GetHashCode() {{ return (int)Value; }}
        public static bool operator ==({name}Id a, {name}Id b) {{ return a.Value == b.Value; }}
        public static bool operator !=({name}Id a, {name}Id b) {{ return a.Value != b.Value; }}
    }}
"""

    @staticmethod
    def _enum(enum):
        flags = naming.is_flags(enum)
        lines = summary(enum["doc"], "    ") + (["    [Flags]"] if flags else [])
        lines += [f"    public enum {naming.bare(enum['name'])}{' : uint' if flags else ''}", "    {"]
        for value in enum["values"]:
            lines += summary(value["doc"], "        ")
            lines.append(f"        {naming.pascal(naming.constant(enum, value))} = {value['value']},")
        return "\n".join(lines + ["    }", ""])

    def field_type(self, field):
        if field["form"] == "callback":
            return "IntPtr"
        if field["form"] == "pointer":
            return f"{self._number(field['type'])}*"
        if field["form"] == "struct":
            return naming.bare(field["type"])
        if field["form"] == "id":
            return naming.bare(field["type"]) + "Id"
        if field.get("enum"):
            return naming.bare(field["enum"])
        if field.get("flag"):
            return "Flag"
        kind = self._number(field["type"])
        return named_array(kind, field["count"]) if "count" in field else kind

    def struct_name(self, name):
        return ("Native" if name in INTERNAL else "") + naming.bare(name)

    def _struct(self, struct):
        name = self.struct_name(struct["name"])
        lines = summary(struct["doc"], "    ")
        lines += ["    [StructLayout(LayoutKind.Sequential)]", f"    public unsafe struct {name}", "    {"]
        for field in struct["fields"]:
            shown = "internal" if is_private(struct, field) and struct["name"] not in INTERNAL else "public"
            lines += summary(field["doc"], "        ")
            lines.append(f"        {shown} {self.field_type(field)} {field_name(struct, field)};")
        if "default" in struct:
            lines += ["", "        /// <summary>With the defaults of the library.</summary>",
                      f"        public static {name} Default", "        {", "            get", "            {",
                      f"                {name} def;", f"                Native.{struct['default']}(&def);",
                      "                return def;", "            }", "        }"]
        return "\n".join(lines + ["    }", ""])

    # ---- Functions

    def of_c(self, c):
        base, array, _ = c.replace("const ", "").partition("[")
        stars = base.count("*") + bool(array)
        base = base.rstrip("*")
        if base in self._d["opaque"]:
            return "IntPtr" + "*" * (stars - 1)
        kind = (naming.bare(base) + "Id" if base in self._ids else self.struct_name(base) if base in self._structs else
                "IntPtr" if base in self._callbacks else self._number(base))
        return kind + "*" * stars

    def _functions(self):
        lines = ["    /// <summary>The functions as C has them.</summary>", "    public static unsafe class Native", "    {",
                 "#if (UNITY_IOS || UNITY_WEBGL) && !UNITY_EDITOR", '        const string Library = "__Internal";', "#else",
                 '        const string Library = "kiri";', "#endif", ""]
        major, minor, patch = map(int, self._d["version"].split("."))
        lines.append(f"        /// <summary>Of the header.</summary>\n        public const int Version = {10000 * major + 100 * minor + patch};")
        lines += [f"        public const int {naming.pascal(value['name'][5:])} = {value['value']};"
                  for enum in self._d["enums"] if enum["name"] in CONSTANTS for value in enum["values"]]
        for function in self._d["functions"]:
            parameters = ", ".join(f"{self.of_c(p['c'])} @{p['name']}" for p in function["parameters"])
            parameters = re.sub(r"@(?!def|in|out|ref|base|object|string|params|is|as|fixed)", "", parameters)
            lines += ["", "        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]",
                      f"        public static extern {self.of_c(function['returns'])} {function['name']}({parameters});"]
        return "\n".join(lines + ["    }"])

    # ---- The test

    def layout_test(self):
        lines = [HEAD + "using System;\n", "namespace Kiri.Tests\n{", "    /// <summary>Structs are laid out as in C.</summary>",
                 "    static unsafe class Layout", "    {", "        public static int Checked;", "",
                 "        static void Is(string what, long is_, long as_)", "        {",
                 '            if (is_ != as_) throw new Exception(what + " is " + is_ + ", in C " + as_);',
                 "            ++Checked;", "        }", "", "        public static void Run()", "        {",
                 "            if (IntPtr.Size != 8) return;"]
        lines += [f"            {naming.bare(struct['name'])}();" for struct in self._d["structs"]] + ["        }"]
        for struct in self._d["structs"]:
            name = self.struct_name(struct["name"])
            lines += ["", f"        static void {naming.bare(struct['name'])}()", "        {", f"            {name} s;",
                      f"            byte* at = (byte*)&s;", f'            Is("{name}", sizeof({name}), {struct["size"]["64"]});']
            for field in struct["fields"]:
                member = field_name(struct, field)
                lines.append(f'            Is("{name}.{member}", (byte*)&s.{member} - at, {field["offset"]["64"]});')
            lines.append("        }")
        return "\n".join(lines + ["    }", "}", ""])
