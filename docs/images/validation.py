#!/usr/bin/env python3
"""Draws theory against measurement from what `carom validate` wrote.

    docs/images/validation.py [FILE]

FILE is validation/validation.json unless named. Needs python3-matplotlib. Writes validation.svg beside this file.
"""
import json
import pathlib
import sys

import matplotlib

matplotlib.use("svg")
matplotlib.rcParams["svg.hashsalt"] = "carom"
import matplotlib.pyplot as plt

here = pathlib.Path(__file__).resolve().parent
source = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else pathlib.Path("validation/validation.json")
measured = json.loads(source.read_text())

panels = (
    ("speeds-periodic", "speeds of 64 disks", "speed (v_T)", "density", None),
    ("h-theorem", "Boltzmann's H", "time", "H", None),
    ("equation-of-state-residual", "Z over theory - 1", "packing fraction", "parts in a thousand", 0.0),
    ("rate-by-speed", "collisions by speed", "speed (v_T)", "rate / mean rate", None),
    ("free-times", "flights longer than t", "t (mean free times)", "share", None),
    ("diffusion", "D(t) over Enskog", "t (mean free times)", "", 1.0),
    ("haff", "cooling", "time", "(T(0)/T)^1/2", None),
    ("barometer", "a gas with weight", "height", "disks in a layer", None),
    ("wall-pressure", "pressure on walls", "N^-1/2", "Z from walls", None),
)
curves = [curve for trial in measured["trials"] for curve in trial["curves"]]
figure, places = plt.subplots(3, 3, figsize=(9.0, 8.4))
for axes, (plot, title, x_title, y_title, line) in zip(places.flat, panels):
    points = {}
    for curve in curves:
        if curve["plot"] != plot:
            continue
        if curve["theory"]:
            if len(curve["x"]) > 1:
                axes.plot(curve["x"], curve["y"], color="black", linewidth=1, zorder=1)
            continue
        x, y, error = points.setdefault(curve["name"], ([], [], []))
        x += curve["x"]
        y += curve["y"]
        error += curve["error"] or [0.0] * len(curve["x"])
    for number, (name, (x, y, error)) in enumerate(points.items()):
        axes.errorbar(x, y, error, fmt="o", color=f"C{number}", markersize=3, fillstyle="none", linewidth=1,
                      label=name if len(points) > 1 else None)
    if line is not None:
        axes.axhline(line, color="black", linewidth=1, zorder=1)
    if plot in ("free-times", "barometer"):
        axes.set_yscale("log")
    if plot == "diffusion":
        axes.set_xscale("log")
    axes.set(title=title, xlabel=x_title, ylabel=y_title)
    axes.grid(alpha=0.2)
    if len(points) > 1:
        axes.legend(frameon=False, fontsize="x-small")
figure.tight_layout()
figure.savefig(here / "validation.svg", metadata={"Date": None})
