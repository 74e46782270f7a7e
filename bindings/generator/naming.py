"""Names and comments, as languages have them: for the generators of all of them."""

import re
import textwrap

# Arrays that were handed out end with these calls.
ENDS_VIEWS = ("kiriWorld_Tick", "kiriWorld_Replay", "kiriDestroyWorld")

def snake(name):
    """snake_case of a name: sheetDef, SheetDef and CopyIndices16 give sheet_def, sheet_def and copy_indices16."""
    return re.sub(r"(?<=[a-z0-9])(?=[A-Z])|(?<=[A-Z])(?=[A-Z][a-z])", "_", name).lower()


def pascal(name):
    """PascalCase of KIRI_STYLE or of camelCase."""
    if "_" in name or name.isupper():
        return "".join(part.capitalize() for part in name.split("_"))
    return name[:1].upper() + name[1:]


def camel(name):
    made = pascal(name)
    return made[:1].lower() + made[1:]


def bare(name):
    """Without the prefix of the library: kiriSheetDef gives SheetDef."""
    return name[4:] if name.startswith("kiri") else name


def classes(description):
    """World, and the things that have ids."""
    return ["World", *(bare(alias["name"]) for alias in description["ids"])]


def constant(enum, value):
    """The name of a value without what the names of its enum have in common: CUT_FINISHED."""
    return value["name"][len(enum["prefix"]):]


def wrapped(doc, start, width=100):
    """A comment, each line with `start` before it; [] where there is none. Lists stay line by line."""
    lines = []
    for line in doc.split("\n") if doc else []:
        indent = "  " if line.startswith("- ") else ""
        lines += textwrap.wrap(line, width - len(start), subsequent_indent=indent, break_long_words=False,
                               break_on_hyphens=False) or [""]
    return [(start + line).rstrip() for line in lines]


def comment(text, prefix, width=118):
    """A text as lines that begin with a prefix."""
    return "".join(f"{prefix}{line}\n" for paragraph in text.split("\n") if paragraph
                   for line in textwrap.wrap(paragraph, width - len(prefix), break_long_words=False,
                                             break_on_hyphens=False))


def derived(function):
    """Parameters that only count what is given in another one: a language that knows the length of an array drops them."""
    return {parameter["length"] for parameter in function["parameters"]
            if parameter["direction"] == "in" and parameter["form"] in ("array", "bytes")
            and isinstance(parameter.get("length"), str)}


def terms(length, name=lambda word: word):
    """A length with its parameters renamed."""
    return re.sub(r"[a-z]\w*", lambda word: name(word[0]), str(length))


def is_flags(enum):
    """Whether values are added up: 1, 2, 4 and so on, up to one for all of them."""
    values = [value["value"] for value in enum["values"][:-1]]
    return len(values) > 2 and values == [1 << i for i in range(len(values))]
