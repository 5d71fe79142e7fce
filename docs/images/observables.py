#!/usr/bin/env python3
"""Draws what some observables look like, from runs that it makes: docs/images/observables.svg and its dark version.

    docs/images/observables.py path/to/carom

Needs python3-numpy and python3-matplotlib, and half a minute of two cores. 400 disks at packing fraction 0.68, the work on a gas
by a wall that moves in, and the Lyapunov spectrum of 32 disks.
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
carom = str(pathlib.Path(sys.argv[1]).resolve())

GAS = """
[box]
aspect = 1.0
boundary = "periodic"
[[disks]]
count = {count}
radius = 0.5
mass = 1.0
packing_fraction = {density}
positions = {{ packing_fraction = {density} }}
velocities = {{ temperature = 1.0 }}
[collision]
rule = "specular"
[run]
time = {time}
"""
DENSE = GAS.format(count=400, density=0.68, time=400.0) + """equilibrate = { time = 50.0 }
[observe]
intermediate_scattering = { every = 0.1 }
overlap = { every = 0.1 }
non_gaussian = { every = 0.1 }
van_hove = { every = 0.1 }
"""
WORK = f"""
scene = "{here.parent}/scenes/jarzynski.toml"
seeds = 600
table = ["observables.work.work_right"]
[set]
"output.trajectory" = false
"run.sample_every" = false
"observe.work.every" = 4.0
"""


def call(*words):
    return subprocess.run([carom, *map(str, words), "--progress", "never"], check=True, capture_output=True, text=True).stdout


def table(path):
    """Returns the columns of a table of a run, by name."""
    lines = path.read_text().splitlines()
    names, rows = lines[1].split(","), np.array([[float(x or "nan") for x in line.split(",")] for line in lines[2:]])
    return dict(zip(names, rows.T))


def measure(directory):
    (directory / "dense.toml").write_text(DENSE)
    call("run", directory / "dense.toml", "--out", directory / "dense", "--quiet")
    (directory / "work.toml").write_text(WORK)
    call("sweep", directory / "work.toml", "--out", directory / "work", "--quiet")
    rows = (directory / "work" / "runs.csv").read_text().splitlines()
    at = rows[0].split(",").index("observables.work.work_right")
    work = np.array([float(row.split(",")[at]) for row in rows[1:]])
    (directory / "few.toml").write_text(GAS.format(count=32, density=0.4, time=10.0))
    spectrum = json.loads(call("horizon", directory / "few.toml", "--spectrum", "--json"))["lyapunov_spectrum"]["exponents"]
    return {name: table(directory / "dense" / f"observe_{name}.csv") for name in ("intermediate_scattering", "overlap", "non_gaussian", "van_hove")}, work, np.array(spectrum)


def draw(tables, work, spectrum):
    figure, axes = plt.subplots(2, 3, figsize=(10.5, 6.2), layout="constrained")
    (scattering, overlap, gaussian), (hove, fluctuations, exponents) = axes
    t = tables["intermediate_scattering"]
    later = t["lag"] > 0
    scattering.errorbar(t["lag"][later], t["F"][later] / t["F"][0], t["F_error"][later] / t["F"][0], fmt=".-", ms=3, lw=1, label="F(k,t) / S(k)")
    scattering.errorbar(t["lag"][later], t["F_self"][later], t["F_self_error"][later], fmt=".-", ms=3, lw=1, label="Fₛ(k,t)")
    scattering.set(title="intermediate_scattering", xlabel="lag", xscale="log", ylim=(-0.05, 1.05))
    t = tables["overlap"]
    overlap.errorbar(t["lag"], t["overlap"], t["overlap_error"], fmt=".-", ms=3, lw=1, label="Q(t)")
    overlap.errorbar(t["lag"], t["chi_4"] / np.nanmax(t["chi_4"]), t["chi_4_error"] / np.nanmax(t["chi_4"]), fmt=".-", ms=3, lw=1, label="χ₄(t) / greatest")
    overlap.set(title="overlap", xlabel="lag", xscale="log")
    t = tables["non_gaussian"]
    gaussian.errorbar(t["lag"], t["alpha_2"], t["alpha_2_error"], fmt=".-", ms=3, lw=1, label="α₂(t)")
    gaussian.axhline(0, color="0.7", lw=1)
    gaussian.set(title="non_gaussian", xlabel="lag", xscale="log")
    t = tables["van_hove"]
    for lag in ("0.8", "6.4", "51.2"):
        if f"density_{lag}" in t:
            hove.plot(t["r"], t[f"density_{lag}"], lw=1.2, label=f"Gₛ(r, {lag})")
    hove.set(title="van_hove", xlabel="r", xlim=(0, 3), ylim=(0, None))
    fluctuations.hist(work, bins=40, density=True, color="#4878a8", label="P(W)")
    # Jarzynski: the free energy of two disks in the smaller box, less that in the larger one; kT is 1.
    free = -np.log(np.mean(np.exp(-work)))
    fluctuations.axvline(free, color="#c03028", lw=1.2, label=f"−ln⟨exp(−W)⟩ = {free:.2f}")
    fluctuations.axvline(np.mean(work), color="#207040", lw=1.2, ls="--", label=f"⟨W⟩ = {np.mean(work):.2f}")
    fluctuations.set(title="work: 600 runs", xlabel="W / kT")
    n = len(spectrum)
    exponents.plot(np.arange(1, n + 1), spectrum, ".", ms=4, label="λᵢ")
    exponents.plot(np.arange(1, n + 1), spectrum + spectrum[::-1], "-", lw=1, color="#c03028", label="λᵢ + λ of its partner")
    exponents.set(title="carom horizon --spectrum", xlabel="i", ylabel="1 / time")
    for one in axes.flat:
        one.legend(frameon=False, fontsize=8)
        one.spines[["top", "right"]].set_visible(False)
    figure.savefig(here / "observables.svg", metadata={"Date": None})
    subprocess.run([sys.executable, str(here / "dark.py"), str(here / "observables.svg")], check=True)


with tempfile.TemporaryDirectory() as place:
    draw(*measure(pathlib.Path(place)))
