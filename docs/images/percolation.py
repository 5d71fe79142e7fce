#!/usr/bin/env python3
"""How often hard disks percolate, against their packing fraction, and where boxes of all sizes do equally often.

    carom sweep docs/scenes/sweeps/percolation.toml --out percolation && docs/images/percolation.py percolation

Prints the table of docs/results.md and writes percolation.svg and its dark version beside this file. Needs python3-numpy and
python3-matplotlib.
"""
import collections
import csv
import math
import pathlib
import statistics
import subprocess
import sys

import matplotlib
import numpy as np

matplotlib.use("svg")
matplotlib.rcParams["svg.hashsalt"] = "carom"
import matplotlib.pyplot as plt

CRITICAL = 0.690473725  # along one of the axes or both of a square: Pinson (1994), Newman & Ziff (2001)

runs = collections.defaultdict(lambda: collections.defaultdict(list))
with (pathlib.Path(sys.argv[1]) / "runs.csv").open(newline="") as file:
    for row in csv.DictReader(line for line in file if not line.startswith("#")):
        runs[int(row["disks.0.count"])][float(row["disks.0.packing_fraction"])].append(float(row["observables.clusters.percolating"]))


def crossing(points):
    """Where a cubic through the log odds of the three or more points between 0.2 and 0.97 is that of CRITICAL, and its error."""
    near = [(eta, p, e) for eta, p, e in points if 0.2 < p < 0.97]
    eta, p, e = (np.array(column) for column in zip(*near))
    degree = min(3, len(near) - 1)

    def root(shares):
        fit = np.polyfit(eta - 0.48, np.log(shares / (1 - shares)), degree)
        fit[-1] -= math.log(CRITICAL / (1 - CRITICAL))
        return 0.48 + min((r.real for r in np.roots(fit) if abs(r.imag) < 1e-12), key=abs)
    moved = [root(p + e * (np.arange(len(p)) == k)) - root(p) for k in range(len(p))]
    return root(p), math.sqrt(sum(m * m for m in moved))


figure, axes = plt.subplots(figsize=(6.4, 3.8), layout="constrained")
axes.axhline(CRITICAL, color="tab:gray", linewidth=1.0)
print("| disks | packing fraction at which 0.6905 of the states percolate |\n|---|---|")
for (count, shares), marker in zip(sorted(runs.items()), "os^"):
    points = [(eta, statistics.mean(p), statistics.stdev(p) / math.sqrt(len(p))) for eta, p in sorted(shares.items())]
    where, error = crossing(points)
    print(f"| {count} | {where:.5f} ± {error:.5f} |")
    axes.errorbar(*zip(*[(eta, p, e) for eta, p, e in points]), fmt=f"{marker}-", markersize=4, linewidth=1.0, label=f"{count} disks")
axes.set_xlabel("packing fraction")
axes.set_ylabel("share of the states that percolate")
axes.legend(frameon=False)
here = pathlib.Path(__file__).resolve().parent
figure.savefig(here / "percolation.svg", metadata={"Date": None})
subprocess.run([sys.executable, str(here / "dark.py"), str(here / "percolation.svg")], check=True)
