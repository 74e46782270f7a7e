"""Measured numbers in documents, from one file, tests/data/figures.txt: a name in brackets, and its text. Documents quote a
text between <!-- figures: NAME --> and <!-- end -->.

python3 tests/figures.py            fails where a document quotes another text
python3 tests/figures.py --measure  takes texts from the tables that benchmarks wrote to build, and quotes them"""
import csv
import pathlib
import re
import sys

root = pathlib.Path(__file__).resolve().parents[1]
FILE = root / "tests/data/figures.txt"
DOCUMENTS = ["README.md", "tests/README.md", "samples/manual/accuracy.md"]
QUOTE = re.compile(r"(<!-- figures: (\S+) -->)(.*?)(<!-- end -->)", re.S)


def rows(name):
    """Columns with the same name get numbers."""
    with open(root / "build" / name, encoding="utf-8") as lines:
        table = [[cell.strip() for cell in row] for row in csv.reader(lines)]
    names = [name + str(table[0][:i].count(name) or "") for i, name in enumerate(table[0])]
    return [dict(zip(names, row)) for row in table[1:]]


def short(number):
    """Two digits, or all before the point."""
    number = float(number)
    return f"{number:.0f}" if number >= 10 else f"{number:.2g}"


def rate(number):
    """Three digits, in tens."""
    return f"{round(float(number), -1 if float(number) < 1000 else -2):.0f}"


def ends(numbers, unit="", text=short):
    return f"{text(min(numbers))} to {text(max(numbers))}{unit}"


def scenes():
    table = ["| scene | frames | before, cutting, after | paper | commit, ms: median, worst | from scratch, times "
             "| tick while cutting, ms: median, worst |", "|---|---|---|---|---|---|---|"]
    slowest, worst = [], []
    for row in rows("bench/rates.csv"):
        stages = {stage["stage"]: stage for stage in rows(f"bench/stages_{row['scene']}.csv")}
        commit, tick = stages["commit"], stages["all"]
        paper = [row["paper before"], row["paper cutting"], row["paper after"]]
        table.append("| " + " | ".join([
            row["scene"], row["last"], ", ".join(rate(row[when]) for when in ("before", "cutting", "after")),
            ", ".join(paper) if paper[0] != "nan" else "", f"{short(commit['cutting'])}, {short(commit['worst1'])}",
            short(commit["scratch/cutting"]), f"{short(tick['cutting'])}, {short(tick['worst1'])}"]) + " |")
        slowest += [float(row["cutting"])] if paper[0] != "nan" else []
        worst.append(float(tick["worst1"]))
    return {"scenes": "\n".join(table), "worst": ends(worst, " ms"), "slowest": ends(slowest, text=rate)}


def features():
    table = ["| feature | tick, times | memory, times |", "|---|---|---|"]
    measured = rows("bench/features.csv")
    for row in measured:
        least, most = float(row["least"]), float(row["most"])
        times = "below 0.001" if most < 0.001 else f"{least:.2f} to {most:.2f}"
        table.append(f"| {row['feature']} | {times} | {float(row['memory, times']):.2f} |")
    plain = f"{float(measured[0]['plain ms']):.2f} ms"
    return {"features": "\n".join(table), "plain": plain, "memory": f"{float(measured[0]['plain KB']) / 1000:.1f} MB"}


def growth():
    found = [row for row in rows("bench/growth.csv") if row["grid"] and float(row["grid"]) >= 32]
    table = ["| grid, squared; frames | " + " | ".join(f"{row['grid']}; {row['frames']}" for row in found) + " |",
             "|---" * (len(found) + 1) + "|", "| commit, ms | " + " | ".join(short(row["all"]) for row in found) + " |",
             "| from scratch, times | " + " | ".join(short(row["scratch/all"]) for row in found) + " |"]
    return {"growth": "\n".join(table)}


def accuracy():
    errors = {}
    for row in rows("accuracy/accuracy.csv"):
        if row["case"] == "cantilever" and row["layout"] == "rows" and row["setting"] == "nu 0":
            errors.setdefault(int(row["frames"]), []).append(100 * float(row["error"]))
    return {"cantilever": ", ".join(f"{frames}: {max(found):.1g} %" for frames, found in sorted(errors.items())),
            "strip": f"{max(errors[9]):.1g} %"}


def bullet():
    """The same cloth by Bullet with 10 iterations."""
    row = rows("bench/bullet.csv")[1]
    return {"bullet": f"{float(row['bullet ms']) / float(row['kiri ms']):.0f} times as long, and hangs "
                      f"{100 * (float(row['drop']) - 1):.0f} % too low"}


def read():
    parts = re.split(r"^\[(\S+)\]\n", FILE.read_text(encoding="utf-8"), flags=re.M)
    return {name: text.strip("\n") for name, text in zip(parts[1::2], parts[2::2])}


def main():
    if sys.argv[1:] == ["--measure"]:
        measured = {**scenes(), **features(), **growth(), **accuracy(), **bullet()}
        FILE.write_text("".join(f"[{name}]\n{text}\n\n" for name, text in measured.items())[:-1], encoding="utf-8")
    figures, faults, used = read(), [], set()

    def quote(found):
        start, name, text, end = found.groups()
        used.add(name)
        figure = figures.get(name, "")
        figure = f"\n{figure}\n" if "\n" in figure else figure
        if text != figure:
            faults.append(f"{document}: {name} is not that of tests/data/figures.txt")
        return start + figure + end

    for document in DOCUMENTS:
        path = root / document
        text = path.read_text(encoding="utf-8")
        renewed = QUOTE.sub(quote, text)
        if sys.argv[1:] and renewed != text:
            path.write_text(renewed, encoding="utf-8")
    faults += [] if sys.argv[1:] else [f"tests/data/figures.txt: no document quotes {name}" for name in figures.keys() - used]
    if faults and not sys.argv[1:]:
        sys.exit("\n".join(faults))
    print(f"figures: documents quote {len(used)} of tests/data/figures.txt")


main()
