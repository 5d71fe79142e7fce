#!/usr/bin/env python3
"""Draws the figures of the docs from runs of Carom.

    docs/images/draw.py path/to/carom

Needs python3-numpy, python3-matplotlib and ffmpeg. Writes box.gif, equation_of_state.svg and their dark versions beside
this file, and prints the table of the latter.
"""
import json
import pathlib
import subprocess
import sys
import tempfile

import matplotlib
import numpy as np

matplotlib.use("svg")
matplotlib.rcParams["svg.hashsalt"] = "carom"
import matplotlib.pyplot as plt

here = pathlib.Path(__file__).resolve().parent
scenes = here.parent / "scenes"
carom = str(pathlib.Path(sys.argv[1]).resolve())


def run(scene, out, *overrides):
    """The summary of a run of a scene."""
    arguments = [carom, "run", str(scene), "--out", str(out), "--json", "--progress", "never"]
    for override in overrides:
        arguments += ["--set", override]
    return json.loads(subprocess.run(arguments, check=True, capture_output=True, text=True).stdout)


def draw_box(directory):
    run(scenes / "box.toml", directory / "box", "run.time=1.5", "output.events=true")
    film = "--size 360 --fps 15 --speed 0.3 --trails 0.25 --force --quiet"
    subprocess.run([carom, "movie", str(directory / "box"), "-o", str(here / "box.gif"), *film.split()], check=True)
    dark = directory / "dark.gif"
    subprocess.run([carom, "movie", str(directory / "box"), "-o", str(dark), "--dark", *film.split()], check=True)
    few = "split[a][b];[a]palettegen=max_colors=32:stats_mode=diff[p];[b][p]paletteuse=dither=none:diff_mode=rectangle"
    subprocess.run(["ffmpeg", "-y", "-loglevel", "error", "-i", str(dark), "-filter_complex", few, str(here / "box_dark.gif")], check=True)


def kolafa_rottner(eta):
    x = eta / (1 - eta)
    a = [1, 2, 1.12801775, 0.00181895291, -0.0526134737, 0.0504960168, -0.0325537792, 0.0134578632, 0.00140888182, -0.00834273601,
         0.00694127367, -0.00262254723, 0.000355746352]
    return sum(c * x**i for i, c in enumerate(a)) - 5.24672938e-9 * x**22 + 5.88054639e-23 * x**57


def finite_size(eta, disks):
    """First order in 1/N for a periodic box at total momentum zero."""
    h = 1e-4
    z, up, down = (kolafa_rottner(e) for e in (eta, eta + h, eta - h))
    z1, z2 = (up - down) / (2 * h), (up - 2 * z + down) / h**2
    return z - eta / (2 * disks) * (2 * z1 + eta * z2) / (z + eta * z1)


def draw_equation_of_state(directory):
    disks = 256
    etas = np.array([0.05, 0.1, 0.2, 0.3, 0.4, 0.5, 0.55, 0.6])
    rows = []
    for rule in ("specular", "reversal"):
        for eta in etas:
            summary = run(here / "equation_of_state.toml", directory / f"{rule}-{eta}", f"disks.0.packing_fraction={eta}", f"collision.rule={rule}")
            rows.append((rule, eta, summary["pressure"]["Z"], summary["pressure"]["Z_error"], finite_size(eta, disks)))
    print("| rule | η | Z, measured | Z, Kolafa & Rottner at N = 256 | difference / error |\n|---|---|---|---|---|")
    for rule, eta, z, error, theory in rows:
        print(f"| {rule} | {eta:.2f} | {z:.5f} ± {error:.5f} | {theory:.5f} | {(z - theory) / error:+.1f} |")

    figure, (top, bottom) = plt.subplots(2, 1, figsize=(5.2, 4.6), sharex=True, height_ratios=[3, 2])
    line = np.linspace(0, 0.63, 200)
    top.plot(line, kolafa_rottner(line), color="0.4", label="Kolafa & Rottner 2006")
    for rule, marker in (("specular", "o"), ("reversal", "x")):
        mine = [r for r in rows if r[0] == rule]
        eta, z, error, theory = (np.array([r[k] for r in mine]) for k in (1, 2, 3, 4))
        top.plot(eta, z, marker, label=f"Carom, {rule}", fillstyle="none")
        bottom.errorbar(eta, 100 * (z / theory - 1), 100 * error / theory, fmt=marker, fillstyle="none", capsize=2)
    top.set_ylabel("Z = PA/NkT")
    top.legend(frameon=False)
    bottom.axhline(0, color="0.4")
    bottom.set(xlabel="packing fraction η", ylabel="deviation, %")
    figure.tight_layout()
    figure.savefig(here / "equation_of_state.svg", metadata={"Date": None})
    subprocess.run([sys.executable, str(here / "dark.py"), str(here / "equation_of_state.svg")], check=True)


with tempfile.TemporaryDirectory() as temporary:
    draw_box(pathlib.Path(temporary))
    draw_equation_of_state(pathlib.Path(temporary))
