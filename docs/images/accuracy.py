#!/usr/bin/env python3
"""Measures and draws what accuracy costs: `carom compare` of the scenes accuracy_*.toml beside this file.

    docs/images/accuracy.py DIRECTORY [--carom build/release/carom]

Runs the comparisons into DIRECTORY, or takes those that it holds: four of 256 disks, and at three densities 64, 1,024 and 16,384
disks. Needs python3-matplotlib. Writes accuracy_work.svg, accuracy_trust.svg, accuracy_growth.svg, accuracy_steps.svg, and their
numbers as accuracy_prices.csv, accuracy_points.csv and accuracy_mistakes.csv beside this file, and prints the tables of
docs/accuracy.md.
"""
import argparse
import csv
import json
import pathlib
import statistics
import subprocess

import matplotlib

matplotlib.use("svg")
matplotlib.rcParams["svg.hashsalt"] = "carom"
matplotlib.rcParams["font.size"] = 8
import matplotlib.pyplot as plt

here = pathlib.Path(__file__).resolve().parent
parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
parser.add_argument("directory", type=pathlib.Path)
parser.add_argument("--carom", default="build/release/carom")
arguments = parser.parse_args()


def study_of(scene, name, *options):
    directory = arguments.directory / name
    if not (directory / "compare.json").exists():
        subprocess.run([arguments.carom, "compare", str(here / f"accuracy_{scene}.toml"), "--out", str(directory), "--no-costs",
                        *options], check=True)
    return json.loads((directory / "compare.json").read_text())


def study_of_size(scene, count):
    """The study of a scene with another number of disks: a large box is compared at chosen steps and from fewer starts."""
    options = ["--set", f"disks.0.count={count}"]
    if count > 256:
        options += ["--seeds", "4"]
    if count > 2000:
        free_time = every[scene]["plan"]["mean_free_time"]
        steps = (2, 1, 0.5, 0.3, 0.1, 0.03, 0.01, 0.003, 0.001)
        options += ["--longest", "1", *(f"--dt={free_time * step:.3g}" for step in steps)]
    return study_of(scene, f"{scene}_{count}", *options)


every = {name: study_of(name, name) for name in ("dilute", "moderate", "dense", "reversal")}
sizes = [(name, study_of_size(name, count)) for count in (64, 1024, 16384) for name in ("dilute", "moderate", "dense")]
studies = [every[name] for name in ("dilute", "moderate", "dense")]

names = {"fast": "exact, fast engine", "textbook": "exact, double", "textbook-float": "exact, float",
         "textbook-long-double": "exact, 64 bits", "grid": "grid", "naive": "naive", "backtrack": "backtrack", "swept": "swept",
         "soft": "soft"}
colours = {"fast": "#0072b2", "grid": "#d55e00", "naive": "#cc79a7", "textbook-float": "#56b4e9", "textbook": "#000000",
           "textbook-long-double": "#7f7f00", "backtrack": "#e69f00", "swept": "#009e73", "soft": "#999999"}


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
    per_disk = 1e9 * plan["mean_free_time"] / study["disks"]
    for method, name in names.items():
        rows = [row for row in study["summary"] if row["method"] == method and row["horizon_in_collisions_per_disk"]]
        if rows and rows[0]["dt"] > 0:
            axis.plot([per_disk * row["seconds_per_time"] for row in rows], [row["horizon_in_collisions_per_disk"] for row in rows],
                      "o-", markersize=3, color=colours[method], label=name, linewidth=1)
        exact = [row for row in study["horizon"]["rows"] if row["engine"] == method and row["collisions_per_disk"]]
        for row in exact:
            axis.plot(per_disk * row["seconds"] / study["horizon"]["timed_until"], row["collisions_per_disk"], "D", markersize=5,
                      color=colours[method], label=name)
    axis.set(xscale="log", xlabel="processor time per disk and mean free time (ns)")
axes[0].set_ylabel("horizon (collisions per disk)")
save(figure, axes, "accuracy_trust.svg")

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
    for method in ("naive", "grid", "backtrack", "swept", "soft"):
        rows = [row for row in study["summary"] if row["method"] == method and row["bias"]["Z"]]
        axis.errorbar([row["dt"] / plan["mean_free_time"] for row in rows],
                      [100 * row["bias"]["Z"]["value"] for row in rows], [100 * row["bias"]["Z"]["error"] for row in rows], fmt="o-", markersize=3, linewidth=1,
                      color=colours[method], label=names[method])
    axis.axhline(0, color="grey", linewidth=0.5)
    axis.set(xscale="log", xlabel="dt (mean free times)")
axes[0].set_ylabel("bias of Z (%)")
save(figure, axes, "accuracy_steps.svg")

with open(here / "accuracy_prices.csv", "w", newline="") as file:
    table = csv.writer(file)
    table.writerow(["scene", "disks", "machine", "method", "target", "ratio", "least", "greatest", "extrapolation", "dt", "seconds"])
    for name, study in [*every.items(), *sizes]:
        for price in study["prices"]:
            if price["ratio"] is not None:
                table.writerow([name, study["disks"], study["plan"]["machine"], price["method"], price["target"], price["ratio"],
                                *price["spread"], price["extrapolation"], price["dt"], price["seconds"]])

with open(here / "accuracy_points.csv", "w", newline="") as file:
    table = csv.writer(file)
    table.writerow(["scene", "method", "dt", "error_early", "seconds_early", "horizon", "bias_of_Z", "error_of_bias"])
    for name, study in every.items():
        for row in study["summary"]:
            bias = row["bias"]["Z"] or {"value": None, "error": None}
            table.writerow([name, row["method"], row["dt"], row["error_early"]["median"], row["seconds_early"],
                            row["horizon_in_collisions_per_disk"], bias["value"], bias["error"]])

with open(here / "accuracy_mistakes.csv", "w", newline="") as file:
    table = csv.writer(file)
    table.writerow(["scene", "c", "error", "dilute_grazes", "over_x_squared", "error_over_x_squared"])
    for name, study in every.items():
        law = study["answers"]["backtrack_mistakes"]
        c, error = (law[key] / (8 * law["dilute_grazes"]) for key in ("c", "error"))
        table.writerow([name, law["c"], law["error"], law["dilute_grazes"], c, error])


def cell(study, method, target):
    for price in study["prices"]:
        if price["method"] == method and price["target"] == target and price["ratio"] is not None:
            two_digits = f"{price['ratio']:.2g}"
            ratio = two_digits if price["ratio"] < 100 else f"{float(two_digits):,.0f}"
            step = f" ({price['dt'] / study['plan']['mean_free_time']:.2g})" if price["dt"] else ""
            return ratio + ("*" if price["extrapolated"] else "") + step
    return "–"


for name, study in [*every.items(), *sizes]:
    print(f"\n{name}, {study['disks']} disks: {study['plan']['machine']}")
    for sentence in study["sentences"]:
        print(f"  {sentence}")
    for method in names:
        print(f"| {method} | " + " | ".join(cell(study, method, target) for target in
                                            ("error 1e-6", "error 1e-10", "Z 1 %", "Z 0.1 %")) + " |")


def with_spread(study, methods, target):
    """The price of the cheapest of these methods, with its spread over the starts."""
    prices = [price for price in study["prices"]
              if price["method"] in methods and price["target"] == target and price["ratio"] is not None]
    if not prices:
        return "–"
    price = min(prices, key=lambda price: price["ratio"])
    ends = ["–" if end is None else f"{end:.2g}" for end in price["spread"]]
    name = "" if len(methods) == 1 else f", {price['method']}"
    return f"{price['ratio']:.2g} ({ends[0]} to {ends[1]}){name}, dt {price['dt'] / study['plan']['mean_free_time']:.2g}"


print("\n| packing fraction | disks | starts | backtrack, 1e-6 | swept, 1e-6 |")
for name in ("dilute", "moderate", "dense"):
    for study in sorted([study for scene, study in [*every.items(), *sizes] if scene == name], key=lambda study: study["disks"]):
        cells = [with_spread(study, [method], "error 1e-6") for method in ("backtrack", "swept")]
        print(f"| {study['packing_fraction']:.3g} | {study['disks']:,} | {len(study['plan']['seeds'])} | " + " | ".join(cells) + " |")
