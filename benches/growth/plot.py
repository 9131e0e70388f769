"""Draws what the growth benchmark has printed, and writes its tables: plot.py ROWS.tsv."""

import csv
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(ROOT / "benches"))

import document  # noqa: E402
import machine  # noqa: E402
import matplotlib  # noqa: E402

matplotlib.use("svg")
# The same rows give the same file.
matplotlib.rcParams["svg.hashsalt"] = "growth"

from matplotlib import pyplot  # noqa: E402

PLOT = ROOT / "docs" / "growth.svg"
RANDOM = ("permuted", "features", "1")
SERIES = [
    (("sane", "features", "1"), "row by row, one thread", "C0", "o-"),
    (("sane", "off", "1"), "row by row, one thread, features off", "C0", "o:"),
    (("sane", "features", "0"), "row by row, all threads", "C0", "o--"),
    (RANDOM, "random order, one thread", "C3", "s-"),
    (("permuted", "off", "1"), "random order, one thread, features off", "C3", "s:"),
    (("permuted", "features", "0"), "random order, all threads", "C3", "s--"),
]
NUMBERS = ["total_ns", "adjacency_ns", "features_ns", "sweep_ns", "wall_ns", "bytes_per_triangle", "peak_gib"]
# Sizes below this are left out of the memory plot: there the fixed costs of a process stand in for those of a triangle.
SETTLED = 90_000


def read(path):
    """Rows by setting, and in each by number of triangles."""
    rows = {}
    with open(path, encoding="utf-8", newline="") as file:
        for row in csv.DictReader(file, delimiter="\t"):
            setting = row["numbering"], row["features"], row["threads"]
            rows.setdefault(setting, {})[int(row["triangles"])] = {key: float(row[key]) for key in NUMBERS}
    return rows


def draw(rows):
    figure, (time, memory) = pyplot.subplots(1, 2, figsize=(11, 4.2), layout="constrained")
    for setting, label, color, style in SERIES:
        sizes = rows[setting]
        look = {"color": color, "label": label, "markersize": 4}
        time.plot(list(sizes), [row["wall_ns"] for row in sizes.values()], style, **look)
        large = {n: row for n, row in sizes.items() if n > SETTLED}
        memory.plot(list(large), [row["bytes_per_triangle"] for row in large.values()], style, **look)
    time.set_ylabel("whole call, two sweeps: ns per vertex")
    memory.set_ylabel("peak beyond the buffers: bytes per triangle")
    for axes in (time, memory):
        axes.set(xscale="log", xlabel="triangles", ylim=(0, None))
        axes.grid(alpha=0.3)
    time.legend(fontsize=7, handlelength=4)
    figure.savefig(PLOT, metadata={"Date": None})


def table(rows):
    head = (
        "| triangles | 1 thread | validation and stars | features | a sweep | features off | all threads "
        "| random order, 1 thread | random order, all threads | bytes a triangle | random order, bytes | peak, GiB | random order, GiB |"
    )
    lines = [head, "|---" * 13 + "|"]
    one, off, every = (rows["sane", *rest] for rest in (("features", "1"), ("off", "1"), ("features", "0")))
    random, random_every = (rows["permuted", "features", threads] for threads in ("1", "0"))
    for n, row in one.items():
        cells = [row["wall_ns"], row["adjacency_ns"], row["features_ns"], row["sweep_ns"], off[n]["wall_ns"]]
        cells += [every[n]["wall_ns"], random[n]["wall_ns"], random_every[n]["wall_ns"]]
        numbers = [f"{cell:,.0f}" for cell in cells]
        for key, form in (("bytes_per_triangle", ".1f"), ("peak_gib", ".2f")):
            for numbering in ("sane", "permuted"):
                most = max(series[n][key] for setting, series in rows.items() if setting[0] == numbering)
                numbers.append(format(most, form) if n > SETTLED else "–")
        lines.append("| " + " | ".join([f"{n:,}", *numbers]) + " |")
    return "\n".join(lines)


def ratios(rows):
    """How the largest mesh compares with the one of about a million, per vertex, and one thread with all."""
    one, every, random = (rows[*key] for key in (("sane", "features", "1"), ("sane", "features", "0"), RANDOM))
    largest, million = max(one), min(one, key=lambda n: abs(n - 1_000_000))
    base, most = one[million]["wall_ns"], one[largest]
    lines = {
        "time per vertex over that of a million, row by row": most["wall_ns"] / base,
        "the same, in random order, over a million row by row": random[largest]["wall_ns"] / base,
        "one thread over all threads, whole call": most["wall_ns"] / every[largest]["wall_ns"],
        "one thread over all threads, sweeps": most["sweep_ns"] / every[largest]["sweep_ns"],
    }
    return "\n".join([f"| at {largest:,} triangles | |", "|---|---|", *(f"| {a} | {b:.2f} |" for a, b in lines.items())])


def main():
    rows = read(sys.argv[1])
    draw(rows)
    text = f"{machine.sentence(machine.describe())}\n\n{ratios(rows)}\n\nNanoseconds per vertex:\n\n{table(rows)}"
    print(text)
    document.replace("growth", text)


main()
