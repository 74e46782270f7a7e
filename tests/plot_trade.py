"""Draws what accuracy costs: python3 plot_trade.py TRADE.csv OUT.png. Needs matplotlib."""
import csv
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

KIRI = "tab:blue"
PRESETS = {"fast": "tab:orange", "balanced": "tab:green", "accurate": "tab:red"}
SPRINGS = {"10": "0.75", "20": "0.55", "40": "0.35"}  # squares along: grey


def best(points):
    """Settings that none is as fast as and better than."""
    front = []
    for point in sorted(points):
        if not front or point[1] < front[-1][1]:
            front.append(point)
    return front


def draw(panel, title, rows):
    at = [(float(row["ms a tick"]), float(row["error %"])) for row in rows]
    panel.set_title(title, fontsize=10)
    panel.axhspan(1e-3, float(rows[0]["error of the reference %"]), color="0.93", zorder=0)
    for squares, color in SPRINGS.items():
        own = [p for p, row in zip(at, rows) if row["method"] == "springs" and row["frames or squares along"] == squares]
        panel.plot(*zip(*own), "--", marker=".", color=color, label=f"springs, {squares} squares along")
    own = best(p for p, row in zip(at, rows) if row["method"] == "kiri" and not row["preset"])
    panel.plot(*zip(*own), "-", marker=".", linewidth=2, color=KIRI, label="Kiri, best settings")
    for preset, color in PRESETS.items():
        own = [p for p, row in zip(at, rows) if row["preset"] == preset]
        panel.plot(*zip(*own), "s", markersize=8, color=color, markeredgecolor="white", label=f"Kiri, {preset}")


def main(table, out):
    sheets = {}
    with open(table, encoding="utf-8") as lines:
        for row in csv.DictReader(lines):
            sheets.setdefault(row["scene and material"], []).append(row)
    figure, panels = plt.subplots(4, 5, sharex=True, sharey=True, figsize=(15, 10.5), layout="constrained")
    for panel, (title, rows) in zip(panels.flat, sheets.items()):
        draw(panel, title, rows)
        panel.set(xscale="log", yscale="log", xlim=(0.01, 40), ylim=(0.05, 200))
        panel.grid(color="0.85", linewidth=0.6)
        for axis in (panel.xaxis, panel.yaxis):
            axis.set_major_formatter(matplotlib.ticker.FormatStrFormatter("%g"))
    figure.supxlabel("milliseconds a tick of 1/60 s")
    figure.supylabel("error, % of the way (grey: error of the reference)")
    figure.suptitle(" ")  # room for the legend
    figure.legend(*panels[0, 0].get_legend_handles_labels(), loc="upper center", ncols=7, frameon=False)
    figure.savefig(out, dpi=100)


if __name__ == "__main__":
    main(*sys.argv[1:])
