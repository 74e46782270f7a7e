"""Compares the binary interface with that of the last version: python3 tests/abi.py LIBRARY LIST [--write].

LIST has a line for each function, type of a function, field of a struct and constant of an enum, as 64-bit machines
have them. Lines that are new do no harm to programs that were linked with the last version; lines that changed or are
gone do, and then the version in the shared library's name has to be another one. Needs cffi."""

import pathlib
import re
import sys

repository = pathlib.Path(__file__).resolve().parents[1]
sys.path.insert(0, str(repository / "bindings/python"))
sys.dont_write_bytecode = True


def interface(path):
    """Names, and what programs rely on of each."""
    import kiri
    ffi, library = kiri.ffi, kiri.load(path)
    lines = {"version": f"{kiri.KIRI_VERSION_MAJOR}.{kiri.KIRI_VERSION_MINOR}.{kiri.KIRI_VERSION_PATCH}"}
    for name in dir(library):
        value = getattr(library, name)
        if isinstance(value, int):
            lines[f"constant {name}"] = str(value)
        else:
            lines[f"function {name}"] = ffi.typeof(value).cname
    for name in ffi.list_types()[0]:
        pointer = ffi.typeof(f"{name} *")  # for a function has no type of its own in Python
        if pointer.kind == "function":
            lines[f"type {name}"] = pointer.cname
        elif pointer.item.kind == "struct" and pointer.item.fields is not None:
            lines[f"struct {name}"] = f"{ffi.sizeof(pointer.item)} bytes"
            for field, at in pointer.item.fields:
                lines[f"field {name}.{field}"] = f"at {at.offset}: {at.type.cname}"
        elif pointer.item.kind != "struct":
            lines[f"type {name}"] = pointer.item.cname
    return lines


def read(text):
    return dict(line.split(" = ", 1) for line in text.splitlines())


def linked_as(version):
    """The version in the shared library's name: before 1.0 a minor version may change the interface."""
    return re.match(r"0\.\d+|\d+", version)[0]


def changed(old, new):
    """Lines of the old interface that the new one does not have."""
    return [f"{name}: {value}, now {new.get(name, 'gone')}" for name, value in old.items()
            if name != "version" and new.get(name) != value]


def breaks(old, new):
    """Whether a program linked with the old version would start with the new one, and go wrong."""
    return bool(changed(old, new)) and linked_as(old["version"]) == linked_as(new["version"])


def report(old, new):
    added = [name for name in new if name not in old]
    print(f"abi: {old['version']} to {new['version']}: {len(added)} new, {len(changed(old, new))} changed or gone")
    for line in changed(old, new):
        print("   ", line)
    if breaks(old, new):
        part = "MINOR" if new["version"].startswith("0.") else "MAJOR"
        print(f"abi: programs linked with {old['version']} would start with this library: raise KIRI_VERSION_{part}, or "
              "undo the change")


def main():
    try:
        import cffi
    except ImportError:
        print("abi: no cffi, not compared")
        return 0
    if cffi.FFI().sizeof("void*") != 8:
        print("abi: the list is of 64-bit machines, not compared")
        return 0
    library, path = sys.argv[1], pathlib.Path(sys.argv[2])
    new = interface(library)
    if sys.argv[3:] == ["--write"]:
        path.write_text("".join(f"{name} = {value}\n" for name, value in sorted(new.items())))
        return 0
    old = read(path.read_text())
    report(old, new)
    return 1 if breaks(old, new) else 0


if __name__ == "__main__":
    sys.exit(main())
