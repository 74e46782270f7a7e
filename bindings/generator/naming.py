"""Names and comments, as languages want them. For the to_X.py beside this file."""

import re
import textwrap

# Arrays that were handed out end with these calls.
ENDS_VIEWS = ("kiriWorld_Tick", "kiriWorld_Replay", "kiriDestroyWorld")


def camel(name):
    """GetMesh: getMesh."""
    return name[:1].lower() + name[1:]


def snake(name):
    """GetMesh, frameCount: get_mesh, frame_count; CopyIndices16: copy_indices16."""
    return re.sub(r"(?<=[a-z0-9])(?=[A-Z])", "_", name).lower()


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
