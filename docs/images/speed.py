#!/usr/bin/env python3
"""Draws the speed of both engines against the number of disks from what `carom bench --json` wrote.

    docs/images/speed.py [FILE]

FILE is bench/results/speed.json unless named. Needs python3-matplotlib. Writes speed.svg beside this file.
"""
import json
import pathlib
import sys

import matplotlib

matplotlib.use("svg")
matplotlib.rcParams["svg.hashsalt"] = "carom"
import matplotlib.pyplot as plt
import matplotlib.ticker

here = pathlib.Path(__file__).resolve().parent
source = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else here.parents[1] / "bench" / "results" / "speed.json"
measured = json.loads(source.read_text())

figure, axes = plt.subplots(figsize=(6.4, 3.6))
packing_fractions = sorted({row["packing_fraction"] for row in measured["rows"]})
for number, packing_fraction in enumerate(packing_fractions):
    rows = sorted((r for r in measured["rows"] if r["packing_fraction"] == packing_fraction), key=lambda r: r["disks"])
    disks = [row["disks"] for row in rows]
    for engine, line, marker in (("fast", "-", "o"), ("textbook", "--", "s")):
        speed = [row[engine]["collisions_per_second"] for row in rows]
        down = [row[engine]["collisions_per_second"] - row[engine]["slowest_turn"] for row in rows]
        up = [row[engine]["fastest_turn"] - row[engine]["collisions_per_second"] for row in rows]
        axes.errorbar(disks, speed, (down, up), fmt=line + marker, color=f"C{number}", markersize=4, capsize=2, fillstyle="none",
                      label=f"{engine}, η = {packing_fraction}")
ticks = [0.1, 0.2, 0.5, 1, 2, 5, 10, 20]
axes.set(xscale="log", yscale="log", xlabel="disks", ylabel="million pair collisions per second")
axes.set_yticks([1e6 * tick for tick in ticks], labels=[f"{tick:g}" for tick in ticks], minor=False)
axes.yaxis.set_minor_locator(matplotlib.ticker.NullLocator())
speeds = [row[engine]["collisions_per_second"] for row in measured["rows"] for engine in ("fast", "textbook")]
axes.set_ylim(0.7 * min(speeds), 1.4 * max(speeds))
axes.grid(alpha=0.2)
axes.legend(frameon=False, fontsize="small", loc="center left", bbox_to_anchor=(1.0, 0.5))
axes.set_title(f"{measured['machine']['processor']}, {measured['carom']['compiler']}, {measured['instructions']}", fontsize="small")
figure.tight_layout()
figure.savefig(here / "speed.svg", metadata={"Date": None})
