"""Makes what is generated from kiri.h: python3 bindings/generator [--check].

bindings/kiri.json describes the header; each to_X.py beside this file makes the files of a language from it, by
files(description): path in the repository to text. With --check nothing is written: what is not as it would be made is
named, and the exit code is 1."""

import importlib
import json
import pathlib
import sys

here = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(here))
sys.dont_write_bytecode = True

import describe

repository = here.parents[1]


def made():
    """Path to text, of all."""
    description = describe.describe((repository / "include/kiri/kiri.h").read_text())
    files = {"bindings/kiri.json": json.dumps(description, indent=1, ensure_ascii=False) + "\n"}
    for language in sorted(here.glob("to_*.py")):
        files.update(importlib.import_module(language.stem).files(description))
    return {repository / path: text for path, text in files.items()}


def main(check):
    stale = [path for path, text in made().items() if not path.exists() or path.read_text() != text]
    for path in stale:
        print(f"{path.relative_to(repository)}: {'is not as `make bindings` makes it' if check else 'made'}")
        if not check:
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(made()[path])
    return 1 if check and stale else 0


if __name__ == "__main__":
    sys.exit(main("--check" in sys.argv[1:]))
