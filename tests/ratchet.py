"""Compares figures of the sources with their limits (tests/ratchet.txt), which only get stricter: `make limits` runs it.

    python3 tests/ratchet.py               fails where a figure is worse than its limit
    python3 tests/ratchet.py --lower       makes each limit stricter whose figure is better
    python3 tests/ratchet.py --raise NAME  sets the named limits to the current figures, for a reason that the commit gives
    python3 tests/ratchet.py --list NAME   lists the places that a figure counts: short_single_caller, circles, plain_src,
                                           plain_include, tests_with_inner_headers, unknown_names_guide,
                                           longest_functions
"""

import pathlib
import re
import sys

repository = pathlib.Path(__file__).resolve().parents[1]
limits = repository / "tests/ratchet.txt"
AT_LEAST = {"assertions_per_kline"}  # all other figures have an upper limit
CEILINGS = {"function_lines_median": 12, "function_lines_90_percent": 40, "function_lines_longest": 80}  # these stay
SHORT = 12  # lines: a shorter function with one caller belongs where it is used
TOKEN = re.compile(r'"(?:\\.|[^"\\])*"|\'(?:\\.|[^\'\\])*\'|[A-Za-z_]\w*|\d[\w.]*|->|<<|>>|[<>=!+\-*/&|^%]=|&&|\|\||\+\+|--|\S')
COMMENT = re.compile(r"/\*.*?\*/|//[^\n]*", re.S)

# Turns of phrase that make readers stop. A line of a comment counts once.
HARD = [re.compile(rule) for rule in (
    r"(?:^|[.:;] )(?:Of|With|By|From|To|In|For) (?:what|that|those|these|each|which|others)\b",
    r"(?:^|[.:;] )(?:Of|With|By) (?!the\b|course\b|default\b)[a-z]+ [a-z]+",
    r"\b[Ww]hat (?:is|was|are|were|has|had|it|they|somebody|nobody|the|a|goes|comes|follows|came|went|waits|takes|lies|may"
    r"|must|can|does|follows)\b",
    r"\b(?:that|those) of\b",
    r"\b(?:is|are|was|were|be) no(?:ne)? (?!longer\b|more\b)[a-z]+",
    r"\bof others\b|\bof its own\b|\bof one's own\b",
    r"\b(?:nobody|whoever|somebody|who asks|who reads)\b",
    r"\bso many\b|\bas many as there\b",
    r"\bat hand\b|\bin force\b|\bas there\b|\ball else\b",
    r"\b(?:knows?|asks?|looks?|wants?|trusts?|waits?|sleeps?|bears?) (?:about|of|for|at|what|which|who)\b"
    r"(?=.*\b(?:cell|frame|link|vertex|grid|region|piece)s?\b)",
    r"\b(?:anew|thereof|therein|whereof|beforehand|thereby)\b",
)]


def read(*patterns):
    return {path.relative_to(repository).as_posix(): path.read_text() for pattern in patterns
            for path in sorted(repository.glob(pattern))}


def bare(text):
    """The text without comments, which leave their line ends."""
    return COMMENT.sub(lambda found: "\n" * found[0].count("\n") or " ", text)


def functions_of(text):
    """(name, whether it is static, its lines of code) for each function; the sources are formatted by clang-format."""
    lines = bare(text).splitlines()
    start = None
    for number, line in enumerate(lines):
        if re.match(r"[A-Za-z_]", line) and not re.match(r"(?:typedef|struct|enum|union|extern \"C\"|namespace)\b[^()]*$", line):
            if start is None or not re.search(r"[(,]\s*$", lines[number - 1]):
                start = number
        if line.startswith("}"):
            head = " ".join(lines[start:number + 1]).partition("{")[0] if start is not None else ""
            found = re.search(r"(\w+)\s*\([^=]*\)\s*(?:const\s*)?$", head.strip())
            if found and "=" not in head:
                yield found[1], "static" in head, sum(1 for code in lines[start:number + 1] if code.strip())
            start = None


def unit_of(path):
    return path.rpartition(".")[0]


def includes_of(texts):
    """Unit to the units of src that it includes."""
    graph = {}
    for path, text in texts.items():
        folder = path.rpartition("/")[0]
        targets = graph.setdefault(unit_of(path), set())
        for name in re.findall(r'^#include "([^"]+)"', text, re.M):
            target = (repository / folder / name).resolve()
            if target.exists() and repository / "src" in target.parents:
                targets.add(unit_of(target.relative_to(repository).as_posix()))
        targets.discard(unit_of(path))
    return graph


def in_circles(graph):
    """The nodes that reach themselves."""
    def reaches(start):
        seen, todo = set(), list(graph[start])
        while todo:
            node = todo.pop()
            if node not in seen:
                seen.add(node)
                todo += graph.get(node, ())
        return start in seen
    return sorted(node for node in graph if reaches(node))


def hard_lines(texts):
    """Words of comments, and the lines that HARD finds."""
    words, places = 0, []
    for path, text in texts.items():
        for comment in COMMENT.finditer(text):
            first = text.count("\n", 0, comment.start()) + 1
            for number, line in enumerate(comment[0].splitlines(), first):
                line = line.strip(" /*")
                words += len(re.findall(r"[A-Za-z']+", line))
                if any(rule.search(line) for rule in HARD):
                    places.append(f"{path}:{number}: {line}")
    return words, places


def with_inner_headers(texts):
    """Test programs that include a header of src, themselves or by a header of tests."""
    def includes(path, seen):
        if path in seen or path not in texts:
            return False
        seen.add(path)
        return any((repository / "src" / name.replace("../src/", "")).exists() and "../samples" not in name or includes(f"tests/{name}", seen)
                   for name in re.findall(r'^#include "([^"]+)"', texts[path], re.M))
    return [path for path in texts if re.match(r"tests/test_\w+\.c", path) and includes(path, set())]


def unknown_names(texts):
    """Names of code in the guide to the source that are not in the code."""
    guide = (repository / "src/README.md").read_text()
    words = set(re.findall(r"\w+", "\n".join(texts)))
    names = {word for code in re.findall(r"`([^`]+)`", guide) for word in re.findall(r"\b(?:kiri[A-Z]\w+|[A-Z][a-z]+[A-Z]\w+)", code)}
    return sorted(names - words)


def measure():
    """Name to figure; and name to the places that it counts."""
    src, include = read("src/*/*.c", "src/*/*.h", "src/*/*.cpp"), read("include/kiri/*.h")
    tests = read("tests/*.c", "tests/*.h", "tests/*.cpp")
    code = {path: bare(text) for path, text in src.items()}
    lines = sum(text.count("\n") for text in src.values())
    functions = [(path, *function) for path, text in src.items() for function in functions_of(text)]
    lengths = sorted(length for *_, length in functions)
    uses, calls = {}, {}  # a callback is used without a call
    for text in code.values():
        text = re.sub(r"^[A-Za-z_][\w *]*\([^;{]*\);", "", text, flags=re.M)
        for name, opens in re.findall(r"\b([A-Za-z_]\w*)(\()?", text):
            uses[name] = uses.get(name, 0) + 1
            calls[name] = calls.get(name, 0) + len(opens)
    short = [f"{path}: {name}, {length} lines" for path, name, static, length in functions
             if static and length < SHORT and uses.get(name) == calls.get(name) == 2]
    files = includes_of(src)
    folders = {}
    for unit, targets in files.items():
        folders.setdefault(unit.split("/")[1], set()).update(target.split("/")[1] for target in targets)
    folders = {folder: targets - {folder} for folder, targets in folders.items()}
    inner = with_inner_headers(tests)
    unknown = unknown_names([*src.values(), *include.values(), *tests.values(), *read("samples/*.h").values()])
    plain = {"src": hard_lines(src), "include": hard_lines(include)}
    places = {"short_single_caller": short, "circles": in_circles(files), "tests_with_inner_headers": inner,
              "unknown_names_guide": unknown, "plain_src": plain["src"][1], "plain_include": plain["include"][1],
              "longest_functions": [f"{length} {path}: {name}"
                                    for path, name, _, length in sorted(functions, key=lambda f: -f[3])[:30]]}
    return {
        "tokens_src": sum(len(TOKEN.findall(text)) for text in code.values()),
        "lines_src": lines,
        "files_src": len(src),
        "units_src": len({unit_of(path) for path in src}),
        "functions_src": len(functions),
        "function_lines_median": lengths[len(lengths) // 2],
        "function_lines_90_percent": lengths[len(lengths) * 9 // 10],
        "function_lines_longest": lengths[-1],
        "short_single_caller": len(short),
        "assertions_per_kline": round(1000 * sum(len(re.findall(r"\b\w*(?:ASSERT|assert)\w*\(", text))
                                                 for text in src.values()) / lines, 1),
        "plain_src_per_kword": round(1000 * len(plain["src"][1]) / plain["src"][0], 1),
        "plain_include_per_kword": round(1000 * len(plain["include"][1]) / plain["include"][0], 1),
        "units_in_include_circles": len(places["circles"]),
        "folders_in_include_circles": len(in_circles(folders)),
        "tests_with_inner_headers": len(inner),
        "lines_guide": (repository / "src/README.md").read_text().count("\n"),
        "unknown_names_guide": len(unknown),
        "lines_header": sum(text.count("\n") for text in include.values()),
        "lines_c_tests": sum(text.count("\n") for path, text in tests.items() if path.endswith(".c")),
    }, places


def main(arguments):
    figures, places = measure()
    if arguments[:1] == ["--list"]:
        print("\n".join(places[arguments[1]]))
        return 0
    old = {name: float(limit) for name, limit in (line.split() for line in limits.read_text().splitlines() if line[:1] not in ("", "#"))}
    old.update(CEILINGS)
    if set(old) ^ set(figures):
        print(f"tests/ratchet.txt: missing or unknown limits: {', '.join(sorted(set(old) ^ set(figures)))}")
    lower = arguments[:1] == ["--lower"]
    raised = arguments[1:] if arguments[:1] == ["--raise"] else []
    if arguments and not lower and not raised or set(raised) - set(figures):
        print(__doc__)
        return 2
    failed, better, new = set(old) != set(figures) and not lower and not raised, [], {}
    for name, figure in figures.items():
        limit = old.get(name, figure)
        isWorse, isBetter = (figure < limit, figure > limit) if name in AT_LEAST else (figure > limit, figure < limit)
        isBetter = isBetter and name not in CEILINGS
        new[name] = figure if name in raised or isBetter and lower else limit
        if isWorse and name not in raised:
            failed = True
            print(f"{name}: {figure}, the limit is {limit:.6g}: mend the change, or `python3 tests/ratchet.py --raise {name}`")
        elif isBetter and new[name] != figure:
            better.append(f"{name} {figure} (limit {limit:.6g})")
    if lower or raised:
        head = [line for line in limits.read_text().splitlines() if line.startswith("#")]
        rows = [f"{name} {limit:.0f}" if limit == int(limit) else f"{name} {limit}" for name, limit in new.items() if name not in CEILINGS]
        limits.write_text("\n".join(head + rows) + "\n")
    elif better:
        print(f"better than the limits: {', '.join(better)}; `python3 tests/ratchet.py --lower` keeps that")
    print("ratchet: some figures got worse" if failed else "ratchet: all figures are within their limits")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
