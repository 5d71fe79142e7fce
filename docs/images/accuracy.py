#!/usr/bin/env python3
"""Draws what accuracy costs from what `carom compare` wrote for the scenes accuracy_*.toml beside this file.

    docs/images/accuracy.py DILUTE MODERATE DENSE

Each argument is the directory of one comparison. Needs python3-matplotlib. Writes accuracy_work.svg, accuracy_growth.svg and
accuracy_steps.svg beside this file.
"""
import json
import pathlib
import statistics
import sys

import matplotlib

matplotlib.use("svg")
matplotlib.rcParams["svg.hashsalt"] = "carom"
matplotlib.rcParams["font.size"] = 8
import matplotlib.pyplot as plt

here = pathlib.Path(__file__).resolve().parent
studies = [json.loads((pathlib.Path(argument) / "compare.json").read_text()) for argument in sys.argv[1:]]

names = {"fast": "exact, fast engine", "textbook": "exact, double", "textbook-float": "exact, float",
         "textbook-long-double": "exact, 64 bits", "grid": "fixed step, grid", "guarded": "fixed step, guarded",
         "naive": "fixed step, naive"}
colours = {"fast": "#0072b2", "grid": "#d55e00", "guarded": "#009e73", "naive": "#cc79a7", "textbook-float": "#56b4e9",
           "textbook": "#000000", "textbook-long-double": "#7f7f00"}


def panels(height):
    figure, axes = plt.subplots(1, len(studies), figsize=(9.5, height), squeeze=False)
    for axis, study in zip(axes[0], studies):
        axis.set_title(f"packing fraction {study['packing_fraction']:.3g}")
        axis.grid(alpha=0.2)
    return figure, axes[0]


def save(figure, axes, name):
    handles, labels = axes[0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="lower center", ncols=len(labels), frameon=False, fontsize=7, columnspacing=1.2)
    figure.tight_layout(rect=(0, 0.07, 1, 1))
    figure.savefig(here / name, metadata={"Date": None})


figure, axes = panels(3.2)
for axis, study in zip(axes, studies):
    for method, name in names.items():
        rows = [row for row in study["summary"] if row["method"] == method and row["error_early"]["median"]]
        axis.plot([row["seconds_early"] for row in rows], [row["error_early"]["median"] for row in rows],
                  "o-" if len(rows) > 1 else "D", markersize=3 if len(rows) > 1 else 5, color=colours[method], label=name, linewidth=1)
    axis.set(xscale="log", yscale="log", xlabel="processor time (s)")
axes[0].set_ylabel("rms error of position (diameters)")
save(figure, axes, "accuracy_work.svg")

figure, axes = panels(3.2)
for axis, study in zip(axes, studies):
    plan = study["plan"]
    steps = [dt for dt in plan["dt"] if dt < 0.2 * plan["mean_free_time"]][::6]
    for method in ("textbook-float", "textbook", "fast", "textbook-long-double"):
        errors = [run["error"] for run in study["runs"] if run["method"] == method]
        times = [(k + 1) * plan["sample_step"] / plan["mean_free_time"] for k in range(len(errors[0]))]
        axis.plot(times, [statistics.median(e) for e in zip(*errors)], color=colours[method], label=names[method], linewidth=1)
    for dt in steps:
        errors = [run["error"] for run in study["runs"] if run["method"] == "grid" and run["dt"] == dt]
        if not errors:
            continue
        length = min(map(len, errors))
        times = [(k + 1) * plan["sample_step"] / plan["mean_free_time"] for k in range(length)]
        axis.plot(times, [statistics.median(e) for e in zip(*(e[:length] for e in errors))], color=colours["grid"], linewidth=1,
                  label="fixed step, grid: dt falls by 100 from line to line" if dt == steps[0] else None)
    axis.axvline(plan["early_time"] / plan["mean_free_time"], color="grey", linestyle=":", linewidth=1)
    axis.set(yscale="log", xlabel="time (collisions per disk)")
axes[0].set_ylabel("rms error of position (diameters)")
save(figure, axes, "accuracy_growth.svg")

figure, axes = panels(3.2)
for axis, study in zip(axes, studies):
    plan = study["plan"]
    for method in ("naive", "grid"):
        rows = [row for row in study["summary"] if row["method"] == method and row["bias"]["Z"]]
        axis.errorbar([row["dt"] / plan["mean_free_time"] for row in rows],
                      [100 * row["bias"]["Z"]["value"] for row in rows], [100 * row["bias"]["Z"]["error"] for row in rows], fmt="o-", markersize=3, linewidth=1,
                      color=colours[method], label=names[method])
    axis.axhline(0, color="grey", linewidth=0.5)
    axis.set(xscale="log", xlabel="dt (mean free times)")
axes[0].set_ylabel("bias of Z (%)")
save(figure, axes, "accuracy_steps.svg")
