"""What one run of a random scene must be, and a refusal of one."""

import math
import re

import h5py
import numpy as np

from program_trials import WALLTIME, Skipped, expect, summary_of

EPSILON = 2.0**-52
ENDED = ("time", "collisions", "no_collisions", "grown", "jammed", "collapsed", "cooled")


def first_run(trial):
    """Whether the scene is accepted; if so, its main run."""
    checked = trial.carom("check", trial.path, codes=(0, 2))
    if checked.returncode == 2:
        refused(trial, checked.err)
        return False
    k = trial.random("sound").choice([7, 50, 300])
    trial.run("main", "--events", "--verify", k, "--walltime", f"{round(WALLTIME * trial.program.patience)}s", codes=(0, 1, 3, 130))
    if not (trial.main / "summary.json").exists():
        trial.carom("run", trial.path, "--out", trial.main, "-q", "--force", "--walltime", "1s", codes=(0, 130))  # it was too much for one file
    trial.summary = summary_of(trial.main)
    return True


def refused(trial, sentence):
    """A refused scene is refused by every command, and nothing is written."""
    before = sorted(trial.home.iterdir())
    for arguments in (("run", trial.path), ("run", trial.path, "--engine", "textbook"), ("run", trial.path, "--out", trial.home / "out", "--force"),
                      ("horizon", trial.path)):
        process = trial.carom(*arguments, codes=(2,))
        if arguments[0] == "run":
            expect(process.err == sentence, f"check says {sentence.strip()!r}, run {process.err.strip()!r}")
    expect(sorted(trial.home.iterdir()) == before, "a refused scene left files")


def sound(trial):
    """Files are whole and finite, energy and momentum are accounted for, disks are in the box and apart, and every file can be read."""
    summary = trial.summary
    verified = summary.get("verified", {})
    expect(not verified.get("faults"), f"an invariant is broken: {(verified.get('faults') or [''])[0]}")
    if summary["stopped"] == "interrupted":
        raise Skipped("it takes too long")
    blocked = summary["stopped"] == "blocked" and "changes" in trial.scene.tables and summary["blocked_by"]
    expect(blocked or summary["stopped"] in ENDED, f"stopped: {summary['stopped']}")
    names = sorted(path.name for path in trial.main.iterdir())
    expect(not [name for name in names if name.endswith(".partial")], f"left in the directory: {names}")
    for name in names:
        if name.endswith((".xyz", "samples.csv")):
            expect(not re.search(rb"\b(nan|inf)", (trial.main / name).read_bytes()), f"{name} holds a number that is not finite")
        trial.carom("info", trial.main / name, codes=(0,) if (trial.main / name).stat().st_size else (2,))  # empty: no sample, no word
    trial.carom("info", trial.main)
    trial.carom("info", trial.main, "--reproduce")
    with h5py.File(trial.main / "trajectory.h5md") as file:
        whole_file(trial, file)
        if not trial.summary.get("measured", True):
            return  # it ended while it was equilibrating, and the log never began
        disks_apart(trial, file)
        energy_and_momentum(trial, file)


def whole_file(trial, file):
    def finite(name, item):
        if isinstance(item, h5py.Dataset) and item.dtype.kind == "f" and not name.startswith("measurements"):
            expect(np.isfinite(item[()]).all(), f"{name} holds a number that is not finite")

    file.visititems(finite)
    summary, scene = trial.summary, trial.scene
    times, partner = file["events/time"][()], file["events/partner"][()]
    trial.log_length = len(times)
    expect((np.diff(times) >= 0.0).all(), "events go back in time")
    expect((times <= summary["time"] * (1.0 + 4.0 * EPSILON)).all(), "events after the end")
    counted = summary["events"]
    for name, which, count in (("pairs", partner >= 0, counted["pair"] + counted.get("well", 0) + counted.get("step", 0)), ("walls", (partner < 0) & (partner >= -4), counted["wall"]),
                               ("obstacles", partner <= -1000, counted.get("obstacle", 0))):
        count = count if summary.get("measured", True) else 0  # the log is that of the measured run
        expect(int(which.sum()) == count, f"{int(which.sum())} events with {name} in the log, {count} in the summary")
    expect((file["events/disk"][()] < np.where(partner < 0, np.int64(2**31), partner)).all(), "a pair whose lower id is not first")
    run = scene.table("run")
    if summary["stopped"] == "time":
        expect(summary["time"] == scene.number(run["time"]), f"ended at {summary['time']}")
    if summary["stopped"] == "collisions":
        expect(summary["events"]["pair"] == run["collisions"], "another number of collisions")
    if scene.table("output").get("trajectory", True) and ("sample_every" in run or "sample_log" in run):
        sampled = file["particles/trajectory/position/time"][()]
        expect(len(sampled) == summary["samples"], "another number of samples")
        expect((np.diff(sampled) >= 0.0).all(), "samples go back in time")
        if isinstance(run.get("sample_every"), float) and summary.get("measured", True):
            grid = np.arange(len(sampled)) * scene.number(run["sample_every"])
            expect((np.abs(sampled - grid) <= 4.0 * EPSILON * grid).all(), "samples are not on their grid")
        expect((np.diff(file["observables/pair_collisions/value"][()]) >= 0.0).all(), "the number of collisions falls")


def box_of(trial, file, sample):
    box = file["particles/trajectory/box"]
    lower = np.array(box.attrs["origin"][:2])
    upper = lower + np.diagonal(box["edges/value"][sample])[:2]
    if "observables/walls" in file:
        left, right, bottom, top = file["observables/walls/value"][sample]
        lower, upper = np.array([left, bottom]), np.array([right, top])
    periodic = np.array([word in (b"periodic", "periodic") for word in box.attrs["boundary"][:2]])
    return lower, upper, periodic


def contact_distances(trial, file):
    """The distance at which each pair of disks touches, where that changes the least of all."""
    radii = file["particles/trajectory/radius"][()]
    sigma = radii[:, None] + radii[None, :]
    kind = file["particles/trajectory/species"][()]
    if not len(radii):
        return sigma
    deltas = [between(tables.get("non_additivity", {}), kind.max() + 1) for tables in trial.scene.stages()]
    return sigma * (1.0 + np.min(deltas, axis=0)[kind[:, None], kind[None, :]])


def between(mixture, kinds):
    """delta of each two species."""
    delta = np.where(np.eye(kinds, dtype=bool), 0.0, mixture.get("delta", 0.0))
    for pair in mixture.get("pairs", []):
        if max(pair["species"]) < kinds:  # a species may have no disks
            one, other = pair["species"]
            delta[one, other] = delta[other, one] = pair["delta"]
    return delta


def disks_apart(trial, file):
    """By numbers of their own: no sample, first, last or in between, shows disks in each other or beyond a wall."""
    count = len(file["particles/trajectory/position/value"])
    overlap = trial.summary["overlap"]
    place = EPSILON * np.abs(file["particles/trajectory/position/value"][()]).max(initial=0.0)
    radii = file["particles/trajectory/radius"][()]
    smallest = radii.min(initial=np.inf)
    sigma = contact_distances(trial, file)
    smallest = min(smallest, 0.5 * sigma.min(initial=np.inf))
    bound = max(1e-12, overlap.get("start", 0.0), start_overlap(file, sigma)) + 8.0 * place / smallest
    expect(overlap["max_relative"] <= bound, f"an overlap of {overlap['max_relative']:.3g} where {bound:.3g} is allowed")
    for sample in sorted({0, count // 3, count // 2, count - 1}) if count else ():
        lower, upper, periodic = box_of(trial, file, sample)
        scale = file["observables/scale/value"][sample] if "observables/scale" in file else 1.0
        slide = file["observables/shear_displacement/value"][sample] if "observables/shear_displacement" in file else 0.0
        r = file["particles/trajectory/position/value"][sample][:, :2]
        if trial.scene.table("output").get("unwrapped"):
            r = r - file["particles/trajectory/image/value"][sample][:, :2] * (upper - lower)
        margin = 1e-11 * (upper - lower) + 32.0 * place
        out = np.where(periodic, (r < lower - margin) | (r > upper + margin), (r - radii[:, None] * scale < lower - margin) | (r + radii[:, None] * scale > upper + margin))
        if circle := trial.scene.table("box").get("circle"):
            from_centre = np.linalg.norm(r - [trial.scene.number(c) for c in circle["centre"]], axis=1)
            out |= (from_centre + radii * scale > trial.scene.number(circle["radius"]) + margin.max())[:, None]
        expect(not out.any(), f"sample {sample}: disk {np.argwhere(out)[:1].tolist()} is out of the box")
        deepest = deepest_overlap(r, sigma * scale, upper - lower, periodic, slide)
        expect(deepest <= bound + 64.0 * place / smallest, f"sample {sample}: an overlap of {deepest:.3g}")


def start_overlap(file, sigma):
    """What the start itself brought along: lists may overlap by 1e-9."""
    r = file["events/start/position"][()]
    box = file["particles/trajectory/box"]
    periodic = np.array([word in (b"periodic", "periodic") for word in box.attrs["boundary"][:2]])
    edges = box["edges/value"]
    if not len(edges) or len(r) > 300:
        return 1e-9
    return max(0.0, min(1e-9, deepest_overlap(r, sigma, np.diagonal(edges[0])[:2], periodic, 0.0)))


def deepest_overlap(r, sigma, lengths, periodic, slide):
    """The largest (sigma - distance) / sigma over all pairs and their images, a disk's own among them."""
    deepest = 0.0
    apart = r[:, None, :] - r[None, :, :]
    base = np.where(periodic, np.round(apart / lengths), 0.0)
    for row in (-1, 0, 1) if periodic[1] else (0,):
        rows = base[..., 1] + row
        y = apart[..., 1] - rows * lengths[1]
        x = apart[..., 0] - rows * slide
        nearest = np.round(x / lengths[0]) if periodic[0] else np.zeros_like(x)
        for column in (-1, 0, 1) if periodic[0] else (0,):
            distance = np.hypot(x - (nearest + column) * lengths[0], y)
            itself = np.eye(len(r), dtype=bool) & (distance < 0.5 * sigma)
            deepest = max(deepest, np.where(itself, 0.0, 1.0 - distance / sigma).max(initial=0.0))
    return deepest


def pull_of(trial, lengths):
    """The largest acceleration of a disk or piston."""
    number = trial.scene.number
    pull = []
    for tables in trial.scene.stages():
        pull += [abs(number(g)) for g in tables.get("gravity", {}).get("acceleration", [])]
        pull += [number(wall["load"]) * max(lengths) / number(wall["mass"]) for wall in tables.get("walls", {}).values() if "mass" in wall]
    return max(pull, default=0.0)


def energy_and_momentum(trial, file):
    """As tests/support/watched_run.hpp has it: every event rounds what it moves, and weights are placed to some roundings of the box."""
    summary, stages, number = trial.summary, list(trial.scene.stages()), trial.scene.number
    tables = set().union(*stages)
    walls = [wall for stage in stages for wall in stage.get("walls", {}).values()]
    if "time" not in summary or not summary["disks"]:
        return
    energy, events = summary["energy"], summary["events"]
    masses, radii = file["particles/trajectory/mass"][()], file["particles/trajectory/radius"][()]
    gives = {"walls", "growth", "thermostat", "brownian", "shear", "drag", "changes"} & tables or {"restitution", "roughness"} & set(stages[0]["collision"])
    turnover = abs(energy["initial"]) + sum(abs(part) for part in energy.get("parts", {"all": energy["final"]}).values()) + abs(summary.get("dissipated", 0.0))
    turnover += sum(abs(summary.get(name, {}).get("energy", 0.0)) for name in ("thermostat", "brownian", "growth", "shear", "changes"))
    turnover += sum(abs(wall.get("energy", 0.0)) for wall in summary.get("walls", {}).values())
    turnover += np.abs(file["observables/kinetic_energy/value"][()]).max(initial=0.0)
    places = file["events/start/position"][()]
    place = np.abs(places).max(initial=0.0)
    lengths = np.ptp(places, axis=0) + 4.0 * radii.max()
    weight = max(math.hypot(*map(number, stage["gravity"]["acceleration"])) if "gravity" in stage else 0.0 for stage in stages) * masses
    loads = sum(number(wall["load"]) * max(lengths) for wall in walls if "load" in wall)
    bounces = events["wall"] + events.get("obstacle", 0)
    all_events = bounces + events["pair"] + events.get("well", 0) + events.get("step", 0)
    turnover += events.get("well", 0) * max(abs(number(stage["square_well"]["depth"])) if "square_well" in stage else 0.0 for stage in stages)
    energies = [abs(number(step["energy"])) for stage in stages for step in stage.get("stepped_potential", {}).get("steps", [])]
    turnover += 2.0 * events.get("step", 0) * max(energies, default=0.0)
    slack = 16.0 * EPSILON * place * (2.0 * (weight.sum() + loads) + 2.0 * all_events * (weight.max() + loads))
    slack += bounces * 2.0**-40 * radii.max() * (weight.max() + loads)
    if "growth" in tables:
        scale = summary["growth"]["scale"]
        turnover += (bounces + events["pair"]) * 4.0 * masses.max() * (2.0 * radii.max() * scale * max(number(stage["growth"]["rate"]) for stage in stages)) ** 2
    if "supplied" in energy or not gives:
        change = energy["final"] - energy["initial"] - energy.get("supplied", 0.0)
        expect(abs(change) <= 1e-11 * turnover + slack, f"energy changed by {change:.3g} of {turnover:.3g} unexplained ({slack:.3g} for weights)")
    thermal = any("temperature" in wall for wall in walls)
    _, _, periodic = box_of(trial, file, 0) if len(file["particles/trajectory/box/edges/value"]) else (0, 0, boundary_words(file))
    for axis in (0, 1):
        if not periodic[axis] or thermal or {"obstacles", "thermostat", "tumbling", "brownian", "shear", "growth", "drag", "changes"} & tables:
            continue
        gained = summary["momentum"]["final"][axis] - summary["momentum"]["initial"][axis]
        size = np.sqrt(2.0 * masses * turnover).sum()
        expect(abs(gained) <= 1e-11 * size, f"momentum along axis {axis} changed by {gained:.3g} of {size:.3g}")


def boundary_words(file):
    return [word in (b"periodic", "periodic") for word in file["particles/trajectory/box"].attrs["boundary"][:2]]
