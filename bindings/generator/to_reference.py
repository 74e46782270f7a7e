"""bindings/REFERENCE.md: the interface of kiri.h for people, with links."""

import re

INTRODUCTION = """# Reference

All of `include/kiri/kiri.h`, version {version}, by its sections. `make bindings` makes it from `kiri.json`; its text
copies the header. [The manual](../samples/manual/README.md) shows how the calls go together.
"""
BASICS = "Basics"  # what comes before the first section of the header


def anchor(heading):
    """As GitHub makes it."""
    return re.sub(r"[^\w -]", "", heading.lower()).replace(" ", "-")


def escaped(text):
    """Words of the header as Markdown: nothing in them is markup but `code`."""
    parts = re.split(r"(`[^`]*`)", text)
    return "".join(part if part.startswith("`") else re.sub(r"([*|<\[\]])", r"\\\1", part) for part in parts)


class Reference:
    def __init__(self, description):
        self._description = description
        self._things = {kind: description[kind] for kind in ("callbacks", "enums", "structs", "functions")}
        self._links = {thing["name"]: anchor(thing["name"]) for kind in self._things.values() for thing in kind}
        self._constants = {value["name"]: anchor(enum["name"]) for enum in description["enums"] for value in enum["values"]}
        self._prefixes = {enum["prefix"] + "...": anchor(enum["name"]) for enum in description["enums"]
                          if enum["prefix"] != "KIRI_"}
        self._here = None  # whose text is written: it needs no link to itself

    def text(self):
        sections = self._sections()
        parts = [INTRODUCTION.format(version=self._description["version"]), self._contents(sections)]
        parts += [self._section(section) for section in sections]
        return "\n".join(parts)

    def _sections(self):
        return list(dict.fromkeys(function["section"] for function in self._description["functions"]))

    def _of(self, kind, section):
        return [thing for thing in self._things[kind] if thing["section"] == section]

    def _contents(self, sections):
        lines = ["| section | functions |", "|---|---|"]
        for section in sections:
            names = ", ".join(f"[{f['name']}](#{anchor(f['name'])})" for f in self._of("functions", section))
            title = section or BASICS
            lines.append(f"| [{title}](#{anchor(title)}) | {names} |")
        structs = ", ".join(f"[{s['name']}](#{anchor(s['name'])})" for s in self._things["structs"])
        enums = ", ".join(f"[{e['name']}](#{anchor(e['name'])})" for e in self._things["enums"])
        return "\n".join(lines) + f"\n\nStructs: {structs}.\n\nEnums: {enums}.\n"

    def _section(self, section):
        parts = [f"## {section or BASICS}\n"]
        self._here = None
        parts += [self._linked(prose["text"]) + "\n" for prose in self._description["prose"] if prose["section"] == section]
        if not section:
            parts.append(self._ids())
        for kind, write in (("callbacks", self._callback), ("enums", self._enum), ("structs", self._struct),
                            ("functions", self._function)):
            for thing in self._of(kind, section):
                self._here = thing["name"]
                parts.append(write(thing))
        return "\n".join(parts)

    # ---- Texts

    def _linked(self, text):
        """What is named gets a link to where it is."""
        def link(match):
            word = match[0]
            goal = self._links.get(word) or self._constants.get(word) or self._prefixes.get(word)
            return word if goal is None or self._here and goal == anchor(self._here) else f"[{word}](#{goal})"
        parts = re.split(r"(`[^`]*`)", escaped(text))
        return "".join(part if part.startswith("`") else re.sub(r"\b(?:KIRI_[A-Z_0-9]+(?:\.\.\.)?|kiri\w+)", link, part)
                       for part in parts)

    def _cell(self, text):
        return self._linked(re.sub(r"\s+", " ", text))

    def _name(self, name):
        return f"[{name}](#{self._links[name]})" if name in self._links else f"`{name}`"

    def _ids(self):
        ids = ", ".join(f"`{one['name']}`" for one in self._description["ids"])
        return f"Ids, 32-bit numbers of which 0 is none: {ids}. `kiriWorld` is known by pointers only.\n"

    # ---- Callbacks, enums

    def _heading(self, name, code=None):
        return f"### {name}\n" + (f"\n```c\n{code}\n```\n" if code else "")

    def _callback(self, callback):
        parameters = ", ".join(f"{p['c']} {p['name']}" for p in callback["parameters"])
        code = f"typedef {callback['returns']} {callback['name']}({parameters or 'void'});"
        return f"{self._heading(callback['name'], code)}\n{self._linked(callback['doc'])}\n"

    def _enum(self, enum):
        events = enum["name"] == "kiriEventType"
        lines = [self._heading(enum["name"])] + ([self._linked(enum["doc"]) + "\n"] if enum["doc"] else [])
        lines += ["| name | value | |" + (" fields of kiriEvent |" if events else ""),
                  "|---|---|---|" + ("---|" if events else "")]
        for value in enum["values"]:
            fields = self._description["eventFields"].get(value["name"], [])
            lines.append(f"| `{value['name']}` | {value['value']} | {self._cell(value['doc'])} |" +
                         (" " + ", ".join(f"`{field}`" for field in fields) + " |" if events else ""))
        return "\n".join(lines) + "\n"

    # ---- Structs

    def _struct(self, struct):
        lines = [self._heading(struct["name"])]
        lines += [self._linked(struct["doc"]) + "\n"] if struct["doc"] else []
        size = f"{struct['size']['64']} bytes ({struct['size']['wasm32']} in wasm32)."
        default = struct.get("default")
        lines += [(f"{self._name(default)} fills it. " if default else "") + size + "\n", "| field | type | |", "|---|---|---|"]
        lines += [f"| `{field['name']}` | {self._field_type(field)} | {self._field_doc(field)} |" for field in struct["fields"]]
        return "\n".join(lines) + "\n"

    def _field_type(self, field):
        name = self._name(field["type"])
        if "count" in field:
            return f"{name} x {field['count']}"
        return f"{name}, pointer" if field["form"] in ("pointer", "callback") else name

    def _field_doc(self, field):
        notes = [self._cell(field["doc"])] if field["doc"] else []
        if field.get("length"):
            width = field.get("width", 1)
            notes.append(f"`{field['length']}` rows of {width}" if width != 1 else f"`{field['length']}` of them")
        if field.get("nullable"):
            notes.append("may be null")
        if field["name"] == "cookie":
            notes.append("the stamp that says that the struct was filled")
        if "enum" in field and not field["doc"]:
            notes.append(self._name(field["enum"]))
        return "; ".join(note.rstrip(".,") if i + 1 < len(notes) else note for i, note in enumerate(notes))

    # ---- Functions

    def _function(self, function):
        parts = [self._heading(function["name"], self._prototype(function))]
        parts.append(self._linked(function["doc"]) + "\n" if function["doc"] else "")
        rows = [row for row in map(self._parameter, function["parameters"]) if row]
        if rows:
            parts += ["\n".join(["| parameter | | |", "|---|---|---|", *rows]) + "\n"]
        changes = {True: "Changes the world.", False: "Only reads the world."}.get(function.get("changes"))
        lives = f"The string lives {function['lives']}." if "lives" in function else None
        notes = " ".join(filter(None, [changes, lives]))
        return "\n".join(filter(None, parts + [notes + "\n" if notes else ""]))

    @staticmethod
    def _prototype(function):
        words = []
        for parameter in function["parameters"]:
            c, bracket, count = parameter["c"].partition("[")
            words.append(f"{c} {parameter['name']}{bracket}{count}")
        line, indent = f"{function['returns']} {function['name']}(", " " * 4
        whole = line + (", ".join(words) or "void") + ");"
        if len(whole) <= 100:
            return whole
        lines = [line]
        for i, word in enumerate(words):
            word += ");" if i + 1 == len(words) else ","
            if lines[-1] == line or len(lines[-1]) + len(word) > 98:
                lines.append(indent + word)
            else:
                lines[-1] += " " + word
        return "\n".join(lines)

    def _parameter(self, parameter):
        """A row of the table; none for a world or a bare number or id that is handed in, of which the prototype says all."""
        form, direction = parameter["form"], parameter["direction"]
        if form == "world" and direction == "in" or form in ("number", "id") and direction == "in" and "enum" not in parameter:
            return None
        what = {"world": self._world, "array": self._array, "view": self._view, "bytes": self._bytes,
                "strided": self._strided}.get(form, self._plain)(parameter)
        notes = [what] + (["may be null"] if parameter.get("nullable") else [])
        notes += ["0 or 1"] if parameter.get("flag") else []
        words = {"in": "in", "out": "out", "inout": "in, out"}
        return f"| `{parameter['name']}` | {words[direction]} | {'; '.join(notes)} |"

    def _plain(self, parameter):
        return self._name(parameter.get("enum") or parameter["type"])

    def _world(self, parameter):
        return "`kiriWorld*`"

    def _array(self, parameter):
        width, length = parameter.get("width", 1), parameter["length"]
        length = length if isinstance(length, int) else f"`{length}`"
        return f"{length}{f' rows of {width}' if width != 1 else ''} {self._name(parameter['type'])}"

    def _view(self, parameter):
        return f"points to {self._array(parameter)} of the library's, {parameter['lives']}"

    def _bytes(self, parameter):
        return f"`{parameter['length']}` bytes"

    def _strided(self, parameter):
        return f"`{parameter['length']}` rows of 3 floats, `{parameter['stride']}` bytes apart"


def files(description):
    return {"bindings/REFERENCE.md": Reference(description).text()}
