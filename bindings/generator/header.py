"""Reads kiri.h: tokens, comments, and the few forms of declaration that it has."""

import re

TOKEN = re.compile(r"""(?P<comment>/\*.*?\*/) | (?P<name>[A-Za-z_]\w*) | (?P<number>\d\w*) | (?P<mark><<|[-+{}()\[\];,*=])
                       | (?P<space>\s+)""", re.X | re.S)


class Token:
    def __init__(self, kind, text, line, end):
        self.kind, self.text, self.line, self.end = kind, text, line, end


def without_directives(text):
    """Lines of the preprocessor, and what only C++ sees, left empty: lines keep their numbers."""
    hide = lambda match: "\n" * match[0].count("\n")
    text = re.sub(r"^#ifdef __cplusplus\n.*?^#endif$", hide, text, flags=re.M | re.S)
    return re.sub(r"^#.*$", "", text, flags=re.M)


def tokens_of(text):
    tokens, at, line = [], 0, 1
    while at < len(text):
        match = TOKEN.match(text, at)
        if not match:
            raise SyntaxError(f"line {line}: {text[at:at + 20]!r}")
        end = line + match[0].count("\n")
        if match.lastgroup != "space":
            tokens.append(Token(match.lastgroup, match[0], line, end))
        at, line = match.end(), end
    return tokens


def plain(comment):
    """The text of a comment: paragraphs apart by an empty line, lists line by line."""
    lines = [line.strip() for line in comment[2:-2].strip().splitlines()]
    text = ""
    for line in lines:
        joined = text and line and not text.endswith("\n") and not line.startswith("- ")
        text += (" " if joined else "\n" if text and line and not text.endswith("\n") else "") + (line or "\n\n")
    return re.sub(r"\n{3,}", "\n\n", text).strip()


class Reader:
    """Declarations in their order: dicts with "kind", "name", "doc", "section"."""

    def __init__(self, text):
        self._tokens = tokens_of(without_directives(text))
        self._at = 0
        self._doc, self._free = "", False  # the last comment, and whether it is nobody's yet
        self._section = ""
        self._last_line = 0  # where the last declaration or comment ended
        self.declarations = []
        self.prose = []  # comments that stand alone: section, text
        self._read()

    # ---- Tokens

    def _peek(self):
        return self._tokens[self._at] if self._at < len(self._tokens) else Token("end", "", 0, 0)

    def _next(self):
        self._at += 1
        return self._tokens[self._at - 1]

    def _take(self, text):
        token = self._next()
        if token.text != text:
            raise SyntaxError(f"line {token.line}: {text!r} wanted, not {token.text!r}")
        return token

    def _has(self, text):
        if self._peek().text != text:
            return False
        self._at += 1
        return True

    def _comments(self, after=None):
        """Comments that come next: all of them, or those that begin on the line `after`."""
        texts = []
        while self._peek().kind == "comment" and (after is None or self._peek().line == after):
            texts.append(self._next())
        return texts

    # ---- Declarations

    def _read(self):
        while self._peek().kind != "end":
            if self._peek().kind == "comment":
                self._read_comment(self._next())
            else:
                self._read_declaration()
        self._drop_comment()

    def _read_comment(self, token):
        section = re.match(r"/\* -+ (.*?) -+ \*/$", token.text)
        self._drop_comment()
        if section:
            self._section = section[1]
        else:
            self._doc, self._free = plain(token.text), True
        self._last_line = token.end

    def _drop_comment(self):
        """A comment that no declaration follows at once is prose of its section."""
        if self._doc and self._free:
            self.prose.append({"section": self._section, "text": self._doc})
        self._doc, self._free = "", False

    def _read_declaration(self):
        """The comment before a group of declarations without empty lines between them is that of all of them."""
        first = self._peek()
        if first.line > self._last_line + 1:
            self._drop_comment()
        self._free = False
        read = {"typedef": self._read_typedef, "enum": self._read_enum}.get(first.text, self._read_function)
        declaration = read()
        end = self._tokens[self._at - 1].end
        trailing = self._comments(after=end)
        doc = " ".join(filter(None, [self._doc, *(plain(token.text) for token in trailing)]))
        declaration.update(doc=doc, section=self._section)
        self.declarations.append(declaration)
        self._last_line = trailing[-1].end if trailing else end

    def _read_typedef(self):
        self._take("typedef")
        if self._has("struct"):
            tag = self._next().text
            if self._peek().text != "{":
                self._next()
                self._take(";")
                return {"kind": "opaque", "name": tag}
            fields = self._read_fields()
            self._next()
            self._take(";")
            return {"kind": "struct", "name": tag, "fields": fields}
        returns = self._read_type()
        name = self._next().text
        if self._peek().text == "(":
            parameters = self._read_parameters()
            self._take(";")
            return {"kind": "callback", "name": name, "returns": returns, "parameters": parameters}
        self._take(";")
        return {"kind": "alias", "name": name, "type": returns}

    def _read_type(self):
        """const and stars apart: {"type", "const", "stars"}."""
        const = self._has("const")
        name, stars = self._next().text, 0
        while self._has("*"):
            stars += 1
        return {"type": name, "const": const, "stars": stars}

    def _read_declarator(self, base):
        stars = 0
        while self._has("*"):
            stars += 1
        name, count = self._next().text, None
        if self._has("["):
            count = self._read_value()
            self._take("]")
        return {"name": name, **base, "stars": base["stars"] + stars, "count": count}

    def _read_fields(self):
        fields = []
        self._take("{")
        before = self._comments(after=self._tokens[self._at - 1].line)
        lead = self._comments()
        while not self._has("}"):
            base, group = self._read_type(), []
            group.append(self._read_declarator(base))
            while self._has(","):
                group.append(self._read_declarator(base))
            end = self._take(";")
            trailing = self._comments(after=end.line)
            text = " ".join(plain(token.text) for token in before + lead + trailing)
            fields += [{**field, "doc": text} for field in group]
            before, lead = [], self._comments()
        return fields

    def _read_enum(self):
        self._take("enum")
        name = self._next().text
        self._take("{")
        values, value = [], 0
        while True:
            lead = self._comments()
            if self._has("}"):
                break
            constant = self._next()
            if self._has("="):
                value = self._read_value()
            trailing = self._comments()
            if self._has(","):
                trailing += self._comments(after=self._tokens[self._at - 1].line)
            text = " ".join(plain(token.text) for token in lead + trailing)
            values.append({"name": constant.text, "value": value, "doc": text})
            value += 1
        self._take(";")
        return {"kind": "enum", "name": name, "values": values}

    def _read_value(self):
        """A number, the name of a constant, -number, or number << number."""
        sign = -1 if self._has("-") else 1
        token = self._next()
        value = int(token.text) if token.kind == "number" else self._constant(token.text)
        while self._has("<<"):
            value <<= int(self._next().text)
        return sign * value

    def _constant(self, name):
        for declaration in self.declarations:
            for value in declaration.get("values", []):
                if value["name"] == name:
                    return value["value"]
        raise SyntaxError(f"{name} is no constant so far")

    def _read_function(self):
        self._take("KIRI_API")
        returns, name = self._read_type(), self._next().text
        parameters = self._read_parameters()
        self._take(";")
        return {"kind": "function", "name": name, "returns": returns, "parameters": parameters}

    def _read_parameters(self):
        parameters = []
        self._take("(")
        if self._has("void") and self._has(")"):
            return parameters
        if self._tokens[self._at - 1].text == "void":
            self._at -= 1
        while True:
            base = self._read_type()
            parameters.append(self._read_declarator(base))
            if not self._has(","):
                break
        self._take(")")
        return parameters
