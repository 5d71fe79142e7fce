#!/usr/bin/env python3
"""Diffusion in the periodic Lorentz gas over that of Machta & Zwanzig's random walk, against the gap between the scatterers.

    carom sweep docs/scenes/sweeps/lorentz.toml --out lorentz && docs/images/lorentz.py lorentz

D is the slope of <r^2>(t) / 4 between lags of 10 and 20, for every run by itself; the mean over the runs of a gap has the error of
their scatter. Prints the table of docs/results.md and writes lorentz.svg and its dark version beside this file. Needs
python3-matplotlib.
"""
import csv
import math
import pathlib
import statistics
import subprocess
import sys

import matplotlib

matplotlib.use("svg")
matplotlib.rcParams["svg.hashsalt"] = "carom"
import matplotlib.pyplot as plt


def slope(file, first=10.0, last=20.0):
    """Returns the slope of <r^2> / 4 between two lags of observe_mean_square_displacement.csv."""
    with file.open(newline="") as lines:
        rows = csv.DictReader(line for line in lines if not line.startswith("#"))
        squares = {float(row["lag"]): float(row["msd"]) for row in rows}
    return (squares[last] - squares[first]) / (4.0 * (last - first))


def random_walk(gap):
    """Returns D of Machta & Zwanzig, Phys. Rev. Lett. 50, 1959 (1983), for scatterers of radius 1 and speed 1."""
    spacing = 2.0 + gap
    return gap * spacing**2 / (math.pi * (math.sqrt(3.0) * spacing**2 - 2.0 * math.pi))


found = []
for point in sorted(pathlib.Path(sys.argv[1]).glob("w=*"), key=lambda path: float(path.name[2:])):
    slopes = [slope(file) for file in sorted(point.glob("seed=*/observe_mean_square_displacement.csv"))]
    error = statistics.stdev(slopes) / math.sqrt(len(slopes))
    found.append((float(point.name[2:]), statistics.mean(slopes), error))

print("| gap w | D | random walk | ratio |\n|---|---|---|---|")
for gap, value, error in found:
    digits = 1 - math.floor(math.log10(error))
    walk = random_walk(gap)
    print(f"| {gap:g} | {value:.{digits}f} ± {error:.{digits}f} | {walk:.{digits}f} | {value / walk:.3f} ± {error / walk:.3f} |")

figure, axes = plt.subplots(figsize=(6.4, 3.6), layout="constrained")
axes.axhline(1.0, color="tab:gray", linewidth=1.0)
axes.errorbar([gap for gap, _, _ in found], [value / random_walk(gap) for gap, value, _ in found],
              [error / random_walk(gap) for gap, _, error in found], fmt="o", markersize=4, color="tab:blue")
axes.set_xscale("log")
axes.set_xlabel("gap w between the scatterers, in their radii")
axes.set_ylabel("D / D of Machta and Zwanzig")
here = pathlib.Path(__file__).resolve().parent
figure.savefig(here / "lorentz.svg", metadata={"Date": None})
subprocess.run([sys.executable, str(here / "dark.py"), str(here / "lorentz.svg")], check=True)
