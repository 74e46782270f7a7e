"""Holds the tables of fields by which state is saved (src/core/kiri_archive.h) against the structs that they describe:
python3 tests/fields.py. Each field is in the tables of its struct once, and as what it is."""

import pathlib
import re
import sys

repository = pathlib.Path(__file__).resolve().parents[1]
NUMBERS = {"int32_t": 4, "uint32_t": 4, "int": 4, "int64_t": 8, "uint64_t": 8, "double": 8, "float": 4, "uint8_t": 1,
           "int8_t": 1, "int16_t": 2, "uint16_t": 2, "char": 1, "bool": "bool"}


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


def entries_of(texts):
    """(struct, macro, width or record, first field, last field) of each line of a table."""
    for text in texts:
        for table in re.findall(r"kiriMember \w+\[\] = \{(.*?)\n\};", text, flags=re.S):
            for macro, arguments in re.findall(r"KIRI_(\w+)\((.*?)\)", table, flags=re.S):
                parts = [part.strip() for part in arguments.split(",")]
                if macro in ("RUN", "ITEMS"):
                    width, parts = int(parts[0]), parts[1:]
                else:
                    width = "bool" if macro == "BOOLS" else None
                last = parts[2] if macro in ("RUN", "BOOLS") else parts[1]
                yield parts[0], macro, width, parts[1], last


def main():
    texts, faults, seen = read(), [], {}
    structs, names = types_of(texts)
    dropped = {}  # in one table, and maybe not in another
    for struct, macro, width, first, last in entries_of(texts):
        fields = structs[struct]
        order = [name for name, _, _ in fields]
        if first not in order or last not in order:
            faults.append(f"{struct} has no field {first}, or {last}")
            continue
        for name, kind, how in fields[order.index(first):order.index(last) + 1]:
            if macro == "DROPPED":
                dropped.setdefault(struct, set()).add(name)
                continue
            if name in seen.setdefault(struct, set()):
                faults.append(f"{struct}.{name} is in its table twice")
            seen[struct].add(name)
            expected = {"RUN": "value", "BOOLS": "value", "PART": "value", "ITEMS": "array", "PARTS": "array",
                        "ROOM_OF": "array", "SPACE_OF": "array", "SHOWN_OF": "array", "OWNED": "pointer"}.get(macro, how)
            if how != expected or (width and width_of(structs, names, kind) != width):
                faults.append(f"{struct}.{name} is no {macro}" + (f" of width {width}" if width else ""))
    for struct, names_seen in seen.items():
        faults += [f"{struct}.{name} is in no table" for name, _, _ in structs[struct] if name not in names_seen | dropped.get(struct, set())]
    print("\n".join(faults) or f"fields: {len(seen)} structs are saved as they are declared")
    return bool(faults)


if __name__ == "__main__":
    sys.exit(main())
