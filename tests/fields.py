"""Holds the tables of fields by which state is saved (src/core/kiri_archive.h) against the structs that they describe:
python3 tests/fields.py. Each field is in the table of its struct once, and as what it is; with KIRI_DERIVED numbers may be
missing. Structs in no table own nothing."""

import pathlib
import re
import sys

repository = pathlib.Path(__file__).resolve().parents[1]
NUMBERS = {"int32_t": 4, "uint32_t": 4, "int": 4, "int64_t": 8, "uint64_t": 8, "double": 8, "float": 4, "uint8_t": 1,
           "int8_t": 1, "int16_t": 2, "uint16_t": 2, "char": 1, "bool": "bool"}
# What an entry may be of, and the width of its numbers.
VALUES = {"RUN": None, "REALS": 8, "FLOATS": 4, "COUNTS": 8, "INDEX": 4, "INDEX_OR_NONE": 4, "WITHIN": 4, "BOOLS": "bool"}
ARRAYS = {"ITEMS": None, "REAL_ITEMS": 8, "FLOAT_ITEMS": 4, "INDICES": 4, "PARTS": None, "ROOM_OF": None, "SPACE_OF": None,
          "ARRAYS": None, "ROOMS": None}
SKIPPED = {"DROPPED", "KEPT"}  # may be anything
ARGUMENTS_BEFORE = {"RUN": 1, "ITEMS": 1, "INDEX": 1, "INDEX_OR_NONE": 1, "WITHIN": 2, "INDICES": 1}


def read():
    """Sources without comments."""
    files = sorted(repository.glob("src/*/*.[ch]")) + [repository / "include/kiri/kiri.h"]
    return [re.sub(r"/\*.*?\*/", "", path.read_text(), flags=re.S) for path in files]


def types_of(texts):
    """Structs: name to fields, each (name, type, kind); and names of enums, of arrays, and of other numbers."""
    structs, names, arrays = {}, dict(NUMBERS), {"kiriIndices": "int32_t"}
    for text in texts:
        names.update((name, 4) for name in re.findall(r"typedef\s+enum\s+(\w+)", text))
        names.update((name, 4) for name in re.findall(r"typedef\s+uint32_t\s+(\w+);", text))
        arrays.update((name, item) for item, name in re.findall(r"typedef\s+KIRI_ARRAY\((.*?)\)\s*(\w+);", text))
    for text in texts:
        for name, body in re.findall(r"struct\s+(\w+)\s*\{(.*?)\n\}", text, flags=re.S):
            structs[name] = fields_of(body, arrays)
    return structs, names


def fields_of(body, arrays):
    fields = []
    for declaration in (re.sub(r"\s+", " ", part).strip() for part in body.split(";")):
        array = re.match(r"KIRI_ARRAY\((.*?)\) ?(.*)$", declaration)
        plain = re.match(r"(?:const )?(?:struct )?(\w+) ?(.*)$", declaration)
        if array:
            fields += [(name.strip(), array[1].strip(), "array") for name in array[2].split(",")]
        elif plain:
            for name in plain[2].split(","):
                kind = "pointer" if "*" in name else "array" if plain[1] in arrays else "value"
                fields.append((re.sub(r"[*\[].*|\*", "", name.replace("*", "")).strip(),
                               arrays.get(plain[1], plain[1]), kind))
    return fields


def width_of(structs, names, kind):
    """Bytes a number, where a type is made of numbers of one width alone; else None."""
    if kind in names:
        return names[kind]
    widths = {width_of(structs, names, type) if how == "value" else None for _, type, how in structs.get(kind, [])}
    return widths.pop() if len(widths) == 1 else None


def owns(structs, kind):
    """Has the type arrays or pointers?"""
    return any(how != "value" or owns(structs, type) for _, type, how in structs.get(kind, []))


def tables_of(texts):
    """(struct, has KIRI_DERIVED, entries) of each table; an entry is (macro, arguments)."""
    for text in texts:
        for struct, body in re.findall(r"^KIRI_(?:SHARED_)?TABLE\(\w+, (\w+),\s*\{(.*?)\}\)$", text, flags=re.M | re.S):
            entries = re.findall(r"KIRI_(\w+)\((.*?)\)", body, flags=re.S)
            yield struct, "KIRI_DERIVED" in body, [(macro, [part.strip() for part in arguments.split(",")])
                                                   for macro, arguments in entries]


def check_table(struct, is_derived, entries, structs, names, blocks):
    fields, seen, custom = structs[struct], set(), set()
    order = [name for name, _, _ in fields]
    for macro, arguments in entries:
        if macro == "CUSTOM":
            custom.add(arguments[0])
            continue
        before = ARGUMENTS_BEFORE.get(macro, 0)
        width = int(arguments[0]) if macro in ("RUN", "ITEMS") else VALUES.get(macro, ARRAYS.get(macro))
        first, last = arguments[before], arguments[-1]
        covered = [first]
        if macro in ("ARRAYS", "ROOMS"):  # the items of an array of arrays are listed one by one
            covered = list(dict.fromkeys(re.sub(r"\[\d+\]$", "", name) for name in arguments))
        if macro in VALUES or macro in SKIPPED:
            covered = order[order.index(first):order.index(last) + 1] if first in order and last in order else [first]
        if macro in ("PART", "PARTS", "OWNED"):
            covered = [arguments[0]]
        for name in covered:
            if name not in order:
                yield f"{struct} has no field {name}"
                continue
            _, kind, how = fields[order.index(name)]
            if name in seen and macro not in SKIPPED:
                yield f"{struct}.{name} is in its table twice"
            seen.add(name)
            expected = "array" if macro in ARRAYS else "pointer" if macro == "OWNED" else "value"
            is_fine = macro in SKIPPED or (how == expected and (not width or width_of(structs, names, kind) == width))
            if not is_fine or (macro in ("ARRAYS", "ITEMS") and owns(structs, kind)):
                yield f"{struct}.{name} is no {macro}" + (f" of width {width}" if width else "")
    for name, kind, how in fields:
        is_number = how == "value" and not owns(structs, kind)
        if name not in seen | custom | blocks and not (is_derived and is_number):
            yield f"{struct}.{name} is in no table"


def main():
    texts, faults, count = read(), [], 0
    structs, names = types_of(texts)
    blocks = {name for text in texts for name in re.findall(r"kiriArchive_Block\(archive, \(void\*\*\)&\w+->(\w+)", text)}
    for struct, is_derived, entries in tables_of(texts):
        faults += check_table(struct, is_derived, entries, structs, names, blocks)
        count += 1
    print("\n".join(faults) or f"fields: {count} structs are saved as they are declared")
    return bool(faults)


if __name__ == "__main__":
    sys.exit(main())
