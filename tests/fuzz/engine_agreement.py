"""Engines against each other: the events of a random scene that no rounding decides are those of all."""

import json
import re

import h5py
import numpy as np

from program_trials import WALLTIME, Failed, Skipped, summary_of
from run_checks import EPSILON, pull_of
from scene_text import Quantity


class Log:
    """The events of a run, as arrays."""

    def __init__(self, out):
        with h5py.File(out / "trajectory.h5md") as file:
            events = file["events"]
            self.time, self.disk, self.partner = (events[name][()] for name in ("time", "disk", "partner"))
            self.velocity, self.partner_velocity = events["velocity"][()], events["partner_velocity"][()]
            self.start = {name: events["start"][name][()] for name in ("position", "velocity")}
            self.radius, self.mass, self.species = (file[f"particles/trajectory/{name}"][()] for name in ("radius", "mass", "species"))
        self.engine = summary_of(out)["engine"]

    def __len__(self):
        return len(self.time)


def agree(a, b, tolerance, length, pull):
    """Which of the first events are the same, as tests/support/engine_agreement.hpp has it: places are known to a part in 1e13 of the box, so squares
    of speeds to what a fall from there to here gives."""
    n = min(len(a), len(b))
    norms = [np.linalg.norm(v[:n], axis=1) for log in (a, b) for v in (log.velocity, log.partner_velocity)]
    with np.errstate(over="ignore", invalid="ignore"):
        time, speed, place = np.maximum(abs(a.time[:n]), abs(b.time[:n])), np.max(norms, axis=0), 1e-13 * length
        same = (a.disk[:n] == b.disk[:n]) & ((a.partner[:n] == b.partner[:n]) | ((a.partner[:n] < 0) & (b.partner[:n] < 0)))
        same &= abs(a.time[:n] - b.time[:n]) * speed <= tolerance * time * speed + place
        for v, w in ((a.velocity, b.velocity), (a.partner_velocity, b.partner_velocity)):
            same &= np.linalg.norm(v[:n] - w[:n], axis=1) * speed <= tolerance * speed * speed + pull * place
    return same


def determined(one, others, disks, length, pull, stops):
    """How many events hang on no rounding: two precisions and nudged starts have them, no two come at one time, no pair parts together."""
    n = min(len(log) for log in (one, *others))
    good = np.ones(n, dtype=bool)
    for other in others:
        good &= agree(one, other, 1e-9, length, pull)[:n]
    pairs = one.partner[:n] >= 0
    speeds = np.linalg.norm(one.velocity[:n], axis=1)
    together = np.linalg.norm(one.velocity[:n] - one.partner_velocity[:n], axis=1) <= 1e-5 * speeds
    good &= ~(pairs & together)
    good &= ~(pairs & stops)
    good[1:] &= np.diff(one.time[:n]) > 1e-9 * one.time[1:n]
    slow = np.where(one.velocity[:n] != 0.0, np.abs(one.velocity[:n]), np.inf).min(axis=1, initial=np.inf)
    good &= slow > 1e-120
    count = n if good.all() else int(np.argmin(good))
    if pull > 0.0:
        last = {}
        for k in range(count):
            disk, partner, time = one.disk[k], one.partner[k], one.time[k]
            before = last.get(disk)
            last[disk] = (partner, time)
            if partner >= 0:
                last[partner] = (partner, time)
            if partner < 0 and before and before[0] == partner and pull * (time - before[1]) ** 2 / 8.0 <= 1e-10 * length:
                count = k
                break
    return max(0, count - disks - 2)


def engines(trial):
    """Every engine sees the same events for as long as these are determined, and stays sound beyond."""
    scene = trial.scene.without("observe", "output", "run.sample_every", "run.sample_log", "run.equilibrate")
    r = trial.random("engines")
    with h5py.File(trial.main / "trajectory.h5md") as file:
        times = file["events/time"][()]
        edges = box_edges(file)
    options = ["--events", "--walltime", f"{round(WALLTIME * trial.program.patience)}s"]
    if len(times) > 1500 and "equilibrate" not in trial.scene.table("run"):
        if "changes" in scene.tables:
            scene.tables["changes"] = [change for change in scene.tables["changes"] if scene.number(change["time"]) < times[1500]]
        options += ["--set", f"run.time={times[1500]!r}"]
    chosen = Log(trial.run("engine-auto", *options, scene=scene))
    logs, covered = [chosen], []
    for engine in ("general", "textbook", "textbook-long-double"):
        out = trial.run(f"engine-{engine}", *options, "--engine", engine, "--verify", r.choice([1, 20, 300]) if len(times) < 300 else 300, scene=scene, codes=(0, 2) if engine == "general" else (0,))
        if (out / "summary.json").exists():
            covered.append(engine)
            if engine != chosen.engine:
                logs.append(Log(out))
    if r.random() < 0.1:
        trial.run("engine-textbook-quad", *options, "--engine", "textbook-quad", scene=scene)
        if scene.units == (0, 0, 0):  # floats cannot square other lengths
            trial.run("engine-textbook-float", *options, "--engine", "textbook-float", scene=scene, codes=(0, 2, 3))
    disks = len(chosen.radius)
    if not disks or not len(chosen):
        return
    pull = pull_of(trial, edges)
    finer = logs[-1]
    nudged = [nudge(trial, scene, chosen, by, edges, options) for by in (4.0, -4.0)]
    others = [finer] + [log for log in nudged if log is not None]
    if len(others) < 3:
        raise Skipped("the start cannot be nudged")
    stops = min(stage["collision"].get("restitution", 1.0) for stage in scene.stages()) <= 1e-5
    textbook = chosen if chosen.engine == "textbook" else logs[-2]
    count = determined(textbook, others, disks, max(edges), pull, stops)
    for one, other in zip(logs, logs[1:]):
        same = agree(one, other, 1e-6, max(edges), pull)[:count]
        if not same.all():
            k = int(np.argmin(same))
            told = [f"{log.engine} has {log.disk[k]} and {log.partner[k]} at {log.time[k]!r}" for log in (one, other)]
            raise Failed(f"event {k} of {count} that are determined: {', '.join(told)}")


def box_edges(file):
    """The sides of the box as the scene has it."""
    return [np.ptp(limits) for limits in box_limits(file)]


def box_limits(file):
    """The lower and upper limit of the box in x and y as the scene has it."""
    text = file["parameters"].attrs["resolved_scene"]
    text = text.decode() if isinstance(text, bytes) else text
    if circle := re.search(r"^circle = { centre = (\[.*\]), radius = (.*) }$", text, re.M):
        radius = float(circle.group(2))
        return [[c - radius, c + radius] for c in json.loads(circle.group(1))]
    return [json.loads(re.search(rf"^{axis} = (\[.*\])$", text, re.M).group(1)) for axis in "xy"]


def nudge(trial, scene, start, by, edges, options):
    """The same scene from a start whose coordinates are some roundings off, each by another amount; None where such a start is refused."""
    places = start.start["position"]
    with h5py.File(trial.main / "trajectory.h5md") as file:
        limits = box_limits(file)
    moved = places.copy()
    for axis in (0, 1):
        step = by * EPSILON * max(abs(limit) for limit in limits[axis])
        sign = np.where((np.arange(len(places)) + axis) % 2 == 0, 1.0, -1.0)
        moved[:, axis] += step * sign * (np.arange(len(places)) + 1)
        moved[:, axis] = np.clip(moved[:, axis], limits[axis][0], np.nextafter(limits[axis][1], limits[axis][0]))
    rows = np.column_stack([moved, start.start["velocity"], start.radius, start.mass])
    name = f"nudged{'+' if by > 0 else '-'}"
    files = {f"{name}{kind}.csv": rows[start.species == kind] for kind in range(len(scene.tables["disks"]))}
    other = rewritten(scene)
    if "circle" not in other.tables["box"]:
        other.tables["box"] = {"x": limits[0], "y": limits[1], "boundary": scene.tables["box"]["boundary"]}
    other.tables["disks"] = [{"positions": {"file": file}} for file in files]
    other.start_files = {file: (["x", "y", "vx", "vy", "radius", "mass"], disks.tolist()) for file, disks in files.items()}
    other.tables["run"] |= {"accept_overlap": True, "keep_momentum": True}
    out = trial.run(name, *options, "--engine", "textbook-long-double", scene=other, codes=(0, 2))
    return Log(out) if (out / "summary.json").exists() else None


def rewritten(scene):
    """The scene with plain numbers, so that others can stand beside them."""
    def plain(value):
        if isinstance(value, Quantity):
            return scene.number(value)
        if isinstance(value, dict):
            return type(value)((key, plain(item)) for key, item in value.items())
        return [plain(item) for item in value] if isinstance(value, list) else value

    other = scene.copy()
    other.tables = plain(other.tables)
    other.units = (0, 0, 0)
    return other
