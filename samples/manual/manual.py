"""The programs of the manual: python3 samples/manual/manual.py FOLDER COMMAND [--pictures RENDERER | --write].

Each chapter has programs, ```c, each with what it prints, ```text. COMMAND compiles `{source}` to `{program}`. A program that
does not compile without a warning, fails, or prints something else is an error. --write puts into the chapters what
programs print. --pictures compiles with picture.h before each program, and RENDERER, objects and libraries, after it."""

import os
import pathlib
import re
import subprocess
import sys

here = pathlib.Path(__file__).resolve().parent
pictures = here.parent / "pictures"
PROGRAM = re.compile(r"```c\n(?P<program>(?:(?!```).)*)```\n```text\n(?P<prints>(?:(?!```).)*)```\n(?:<!-- picture: (?P<picture>.*?) -->)?", re.S)


def compiled(folder, name, text, command, more=()):
    source, program = folder / f"{name}.c", folder / name
    source.write_text(text)
    words = [word.format(source=source, program=program) for word in command]
    made = subprocess.run([*words, *more], capture_output=True, text=True)
    if made.returncode:
        sys.exit(f"{name}.md: its program does not compile\n{made.stderr}")
    return program


def run(name, program, environment=None):
    ran = subprocess.run([program], capture_output=True, text=True, env={**os.environ, **(environment or {})})
    if ran.returncode:
        sys.exit(f"{name}.md: its program ended with {ran.returncode}\n{ran.stderr}")
    return ran.stdout


def main(folder, command, option=None, *renderer):
    folder = pathlib.Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    chapters = sorted(path for path in here.glob("*.md") if path.name != "README.md")
    for path in chapters:
        text = path.read_text()
        programs = list(PROGRAM.finditer(text))
        if len(programs) != text.count("```c\n") or not programs:
            sys.exit(f"{path.name} has no program, or one without what it prints")
        for number, found in reversed(list(enumerate(programs, 1))):
            name = path.stem if len(programs) == 1 else f"{path.stem}_{number}"
            if option == "--pictures":
                if found["picture"]:
                    program = compiled(folder, name, f'#include "picture.h"\n{found["program"]}', command.split(),
                                       [f"-I{here}", *renderer])
                    run(name, program, {"KIRI_PICTURE": f"{pictures / f'manual_{name}.png'}; {found['picture']}"})
                continue
            prints = run(name, compiled(folder, name, found["program"], command.split()))
            if option == "--write":
                text = text[:found.start("prints")] + prints + text[found.end("prints"):]
            elif prints != found["prints"]:
                sys.exit(f"{path.name}: its program prints\n{prints}and not\n{found['prints']}"
                         "`make manual-golden` puts it there")
        if option == "--write":
            path.write_text(text)
    print(f"manual: {len(chapters)} chapters {'have their pictures' if option == '--pictures' else 'hold'}")


if __name__ == "__main__":
    main(*sys.argv[1:])
