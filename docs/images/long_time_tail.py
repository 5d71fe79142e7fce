#!/usr/bin/env python3
"""The velocity autocorrelation of a million disks at long times, against the sum over the slow modes of the box.

    carom validate --full --only long-time-tail-million && docs/images/long_time_tail.py

Reads validation/validation.json unless a file is named. Writes long_time_tail.svg and its dark version beside this file. Needs
python3-matplotlib.
"""
import json
import pathlib
import subprocess
import sys

import matplotlib

matplotlib.use("svg")
matplotlib.rcParams["svg.hashsalt"] = "carom"
import matplotlib.pyplot as plt

here = pathlib.Path(__file__).resolve().parent
source = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else pathlib.Path("validation/validation.json")
curves = [curve for trial in json.loads(source.read_text())["trials"] for curve in trial["curves"] if curve["plot"] == "long-time-tail"]
measured = next(curve for curve in curves if not curve["theory"])
modes = next(curve for curve in curves if curve["theory"])
ratios = [found / theory for found, theory in zip(measured["y"], modes["y"])]
errors = [error / theory for error, theory in zip(measured["error"], modes["y"])]

figure, (top, bottom) = plt.subplots(2, 1, figsize=(5.2, 4.6), sharex=True, height_ratios=[3, 2])
top.errorbar(measured["x"], measured["y"], measured["error"], fmt="o", markersize=3, fillstyle="none", label="a million disks")
top.plot(modes["x"], modes["y"], color="0.4", linewidth=1, label="shear and sound of the box")
top.set(xscale="log", yscale="log", ylabel=r"$\langle v_x(0)\, v_x(t) \rangle\ m / kT$")
top.legend(frameon=False)
bottom.errorbar(measured["x"], ratios, errors, fmt="o", markersize=3, fillstyle="none")
bottom.axhline(1, color="0.4", linewidth=1)
bottom.set(xlabel="time (mean free times)", ylabel="measured / modes")
ticks = [5, 10, 20, 30, 40, 60, 80]
bottom.set_xticks(ticks, [str(tick) for tick in ticks])
bottom.minorticks_off()
figure.tight_layout()
figure.savefig(here / "long_time_tail.svg", metadata={"Date": None})
subprocess.run([sys.executable, str(here / "dark.py"), str(here / "long_time_tail.svg")], check=True)
