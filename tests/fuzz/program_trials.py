"""What tests/fuzz/whole_program holds of the built program: each trial runs one scene in some ways and raises Failed where something is wrong."""

import json
import math
import os
import random
import re
import resource
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

import h5py
import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
from run_files import data_differences, differences

EPSILON = 2.0**-52
ENDED = ("time", "collisions", "no_collisions", "grown", "jammed", "collapsed", "cooled")
DISASTER = re.compile(r"Sanitizer|runtime error|[Aa]ssert|terminate called|what\(\):|Segmentation|core dumped|std::|basic_string")
WALLTIME = 20  # seconds for the main run
LONGEST = 30.0  # of processor time for any
LARGEST_FILE = 300 << 20
LONGEST_LOG = 200_000


class Failed(Exception):
    """Something that must not happen."""


class Skipped(Exception):
    """Nothing to be tried here."""


def expect(condition, sentence):
    if not condition:
        raise Failed(sentence)


class Program:
    """The program under trial, and how often it was run."""

    def __init__(self, path, patience):
        self.path, self.patience, self.runs = path, patience, 0
        self.sanitized = b"__asan_init" in path.read_bytes()

    def environment(self, more=None):
        return {key: value for key, value in os.environ.items() if key != "CAROM_INSTRUCTIONS"} | (more or {})

    def limits(self):
        resource.setrlimit(resource.RLIMIT_FSIZE, (LARGEST_FILE, LARGEST_FILE))
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
        if not self.sanitized:
            resource.setrlimit(resource.RLIMIT_AS, (6 << 30, 6 << 30))

    def start(self, home, *arguments, env=None):
        self.runs += 1
        return subprocess.Popen([self.path, *map(str, arguments)], cwd=home, env=self.environment(env), preexec_fn=self.limits, stdin=subprocess.DEVNULL,
                                stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, errors="replace")


    @staticmethod
    def processor_seconds(pid):
        fields = Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()
        return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


class Trial:
    """One scene in a directory of its own, its main run, and random numbers for one kind of trial."""

    def __init__(self, program, scene, home, seed):
        self.program, self.scene, self.home, self.seed = program, scene, home, seed
        shutil.rmtree(home, ignore_errors=True)
        home.mkdir(parents=True)
        self.path = home / "scene.toml"
        scene.write(self.path)
        self.main = home / "main"
        self.summary = None
        self.log_length = 0

    def random(self, kind):
        return random.Random(f"{kind} of {self.seed}")

    def carom(self, *arguments, codes=(0,), env=None):
        """Runs the program to its end, which must be one of these exit codes."""
        process = self.program.start(self.home, *arguments, env=env)
        self.finish(process, arguments)
        self.judge(process, arguments, codes)
        return process

    def finish(self, process, arguments):
        """Waits for the end, for so much processor time and ten times as much on the clock."""
        began = time.monotonic()
        while True:
            try:
                process.out, process.err = process.communicate(timeout=2.0)
                return
            except subprocess.TimeoutExpired:
                used = self.program.processor_seconds(process.pid)
            if used > LONGEST * self.program.patience or time.monotonic() - began > 10.0 * LONGEST * self.program.patience:
                process.kill()
                process.communicate()
                raise Failed(f"carom {' '.join(map(str, arguments))}: no end after {used:.0f} s of processor time")

    def judge(self, process, arguments, codes):
        words = " ".join(str(a) for a in arguments)
        said = process.err.strip()[-600:]
        expect(not DISASTER.search(process.err), f"carom {words}: {said}")
        expect(process.returncode in codes, f"carom {words}: exit code {process.returncode}: {said}")
        if process.returncode == 2:
            lines = process.err.strip().splitlines()
            expect(len(lines) == 1 and lines[0].startswith("carom: "), f"carom {words}: not one sentence: {said!r}")

    def run(self, name, *options, scene=None, codes=(0,), env=None):
        """A run into a directory of that name, of this scene or another; where it is given a time on the clock it may take that and no more."""
        path = self.path
        if scene is not None:
            path = self.home / f"{name}.scene" / "scene.toml"
            path.parent.mkdir(exist_ok=True)
            scene.write(path)
        out = self.home / name
        shutil.rmtree(out, ignore_errors=True)
        limited = "--walltime" in options
        if self.carom("run", path, "--out", out, "-q", *options, codes=(*codes, 130) if limited else codes, env=env).returncode == 130 and name != "main":
            raise Skipped("it takes too long")
        return out

    def expect_same(self, one, other, what, but=()):
        found = differences(one, other, but)
        expect(not found, f"{what}: not the same: {', '.join(found[:5])}")


def summary_of(out):
    def refuse(word):
        raise Failed(f"{out.name}/summary.json holds {word}")

    return json.loads((out / "summary.json").read_text(), parse_constant=refuse)


# What one run must be --------------------------------------------------------------------------------------------------------------------------


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
    """As tests/support/fighter.hpp has it: every event rounds what it moves, and weights are placed to some roundings of the box."""
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


# What runs must be to each other ---------------------------------------------------------------------------------------------------------------


def instructions(trial):
    """The same bits with every instruction set."""
    for name in ("portable", "avx2"):
        out = trial.run(name, "--events", env={"CAROM_INSTRUCTIONS": name})
        trial.expect_same(trial.main, out, name, but=("carom", "verified", "numerics" if "verified" not in trial.summary else "verified"))


def threads(trial):
    """The same bits on one thread."""
    if "observe" not in trial.scene.tables:
        raise Skipped("nothing is observed")
    out = trial.run("one-thread", "--events", "--threads", 1)
    other = trial.run("two-threads", "--events", "--threads", 2)
    trial.expect_same(out, other, "--threads 1 and 2")
    trial.expect_same(trial.main, other, "--threads 2", but=("verified",))


def cores(trial):
    """The same bits on three cores."""
    told = trial.carom("check", trial.path).out
    if " cores: " not in told and "from which on several cores pay" not in told:
        raise Skipped("one core computes it in any case")
    out = trial.run("three-cores", "--events", "--threads", 3)
    trial.expect_same(trial.main, out, "--threads 3", but=("verified",))


def verify(trial):
    """carom verify finds the run again."""
    done = trial.carom("verify", trial.main, env={"TMPDIR": str(trial.home)}, codes=(0,))
    expect("same" in done.out, f"carom verify says {done.out.strip()!r}")


def resolved(trial):
    """The scene with every default filled in is the same run."""
    done = trial.carom("check", trial.path, "--resolved")
    (trial.home / "resolved.toml").write_text(done.out)
    out = trial.home / "resolved"
    trial.carom("run", trial.home / "resolved.toml", "--out", out, "-q", "--events")
    trial.expect_same(trial.main, out, "the resolved scene", but=("scene", "verified"))


def samples(trial):
    """What is sampled and observed does not disturb the motion."""
    scene = trial.scene.without("observe", "output", "run.sample_every", "run.sample_log")
    r = trial.random("samples")
    if r.random() < 0.5:
        scene = scene.set("run", sample_every={"collisions": r.randint(1, 30)})
    out = trial.run("other-samples", "--events", scene=scene)
    with h5py.File(trial.main / "trajectory.h5md") as a, h5py.File(out / "trajectory.h5md") as b:
        for name in ("time", "time_remainder", "disk", "partner", "velocity", "partner_velocity", "start/position", "start/velocity"):
            expect(a["events"][name][()].tobytes() == b["events"][name][()].tobytes(), f"other samples, other events/{name}")
    other = summary_of(out)
    for key in ("time", "stopped", "events", "momentum", "virial", "wall_impulse", "numerics"):
        expect(trial.summary[key] == other[key], f"other samples, other {key}: {trial.summary[key]} and {other[key]}")


def units(trial):
    """In other units of length, time and mass, by powers of two, not a bit of the motion changes."""
    scene = trial.scene.copy()
    r = trial.random("units")
    if any(isinstance(one.get("positions"), dict) and "packing_fraction" in one["positions"] for one in scene.tables.get("disks", [])):
        raise Skipped("grown starts are made in units of their own")
    scene.units = tuple(u + r.randint(-8, 8) for u in scene.units)
    if trial.scene.bold:
        raise Skipped("numbers at the edge of what is allowed")
    out = trial.run("other-units", "--events", scene=scene)
    with h5py.File(trial.main / "trajectory.h5md") as a, h5py.File(out / "trajectory.h5md") as b:
        # Speeds that vanish end a run at the smallest numbers there are, and these know no units.
        vanishing = trial.summary["stopped"] in ("collapsed", "cooled")
        common = min(len(a["events/time"]), len(b["events/time"])) if vanishing else None
        for name in ("disk", "partner"):
            expect(a["events"][name][:common].tobytes() == b["events"][name][:common].tobytes(), f"other units, other events/{name}")
        shift = [after - before for after, before in zip(scene.units, trial.scene.units)]
        for name, power in (("time", (0, 1)), ("velocity", (1, -1)), ("partner_velocity", (1, -1)), ("start/position", (1, 0))):
            part = common if name != "start/position" else None
            scaled = np.ldexp(a["events"][name][:part], power[0] * shift[0] + power[1] * shift[1])
            expect((scaled == b["events"][name][:part]).all(), f"other units, other events/{name}")


def analyze(trial):
    """Observables from what a run has kept are those of the run."""
    scene, r = trial.scene.copy(), trial.random("analyze")
    if "observe" not in scene.tables:
        raise Skipped("nothing is observed")
    span = trial.summary["time"] / 2.0 ** scene.units[1]
    if not span > 0.0:
        raise Skipped("no time to sample")
    dt = scene.table("run").get("sample_every")
    from drawn_scene import time as seconds

    if not isinstance(dt, float):
        dt = seconds(span / r.uniform(2.0, 30.0))
    scene = scene.without("run.sample_log", "output", "observe.work").set("run", sample_every=dt).set("output", events=True)
    for name, settings in scene.tables["observe"].items():
        settings = dict(settings) if isinstance(settings, dict) else {}
        if r.random() < 0.7 or "every" in settings:
            settings["every"] = seconds(float(dt) * r.choice([1, 1, 2, 3]))
        scene.tables["observe"][name] = settings or True
    # Steps that are no multiples of the samples' serve the run alone; free flight has no use for one.
    scene.tables["observe"] = {
        name: value for name, value in scene.tables["observe"].items() if isinstance(value, dict) and "every" in value or name == "free_flight"
    }
    if not scene.tables["observe"]:
        raise Skipped("nothing is observed")
    out = trial.run("kept", scene=scene, codes=(0, 2))
    if not (out / "summary.json").exists():
        raise Skipped("refused with these samples")
    summary = summary_of(out)
    if "observables" not in summary:
        raise Skipped("nothing was observed")
    trial.carom("analyze", out, "-q", "--force", "--out", trial.home / "analysis")
    analysis = json.loads((trial.home / "analysis/analysis.json").read_text())
    for name, observable in summary["observables"].items():
        expect(analysis["observables"].get(name) == observable, f"{name} of the analysis is not that of the run")
    tables = sorted(path.name for path in out.glob("observe_*.csv"))
    for name in tables:
        expect((trial.home / "analysis" / name).read_bytes() == (out / name).read_bytes(), f"{name} of the analysis is not that of the run")


def resume(trial):
    """Killed at random moments and resumed, a run has the files of one that nothing happened to."""
    r = trial.random("resume")
    began = time.monotonic()
    whole = trial.run("whole", "--events", "--threads", 1)
    lasted = time.monotonic() - began
    out = trial.home / "killed"
    every = max(1, int(trial.summary["events"]["pair"] / r.choice([1.5, 4.0, 15.0])))
    begin = ["run", trial.path, "--out", out, "-q", "--force", "--events", "--threads", 1, "--checkpoint-every", f"{every} collisions"]
    arguments = begin
    for attempt in range(4):
        process = trial.program.start(trial.home, *arguments)
        chosen, moment = signal.SIGKILL if r.random() < 0.6 else signal.SIGTERM, r.uniform(0.2, 1.1) * lasted
        if attempt < 3:
            try:
                process.wait(moment)
            except subprocess.TimeoutExpired:
                process.send_signal(chosen)
        trial.finish(process, arguments)
        codes = (0, 130, -signal.SIGKILL, -signal.SIGTERM) if attempt < 3 else (0,)
        if process.returncode == 2 and "come to its end" in process.err:
            break
        trial.judge(process, arguments, codes)
        if process.returncode == 0:
            break
        saved = any((out / name).exists() for name in ("checkpoint.h5", "checkpoint-previous.h5"))
        arguments = ["resume", out, "-q", "--threads", 1] if saved else begin
    trial.expect_same(whole, out, "killed and resumed")


def extend(trial):
    """A run that is extended is the longer run from the start."""
    scene, r, summary = trial.scene.copy(), trial.random("extend"), trial.summary
    if summary["stopped"] not in ("time", "collisions"):
        raise Skipped("it has another end")
    if scene.bold:
        raise Skipped("numbers at the edge of what is allowed")
    if summary["stopped"] == "collisions" and "growth" in scene.tables:
        raise Skipped("growth needs an end in time")
    if "sample_log" in scene.table("run") and "block" not in scene.table("run")["sample_log"]:
        raise Skipped("blocks follow from the length of the run")
    observed = scene.table("observe").values()
    if not all(isinstance(settings, dict) and "every" in settings for settings in observed):
        scene = scene.without("observe")
    key = summary["stopped"]
    end = scene.table("run")[key]
    part = r.choice([0.5, 1.0 / 3.0, r.random(), 0.0])
    dt = scene.table("run").get("sample_every")
    if key == "time":
        earlier = end.like(end * part)
        if isinstance(dt, float) and r.random() < 0.5:
            earlier = end.like(float(f"{round(float(earlier) / float(dt)) * float(dt):.12g}"))
        if not earlier < end:
            raise Skipped("no earlier end")
        goal = ("--time", repr(scene.number(end)))
    else:
        earlier, goal = int(end * part), ("--collisions", end)
        if earlier == end:
            raise Skipped("no earlier end")
    whole = trial.run("longer", "--events", scene=scene)
    out = trial.run("extended", "--events", "--checkpoint-every", "1h", scene=scene.set("run", **{key: earlier}), codes=(0, 2))
    if not (out / "summary.json").exists():
        raise Skipped("refused with an earlier end")
    if summary_of(out)["stopped"] != key:
        raise Skipped("it has another end")
    trial.carom("extend", out, *goal, "-q")
    trial.expect_same(whole, out, f"extended from {earlier!r}", but=("scene", "resolved_scene"))
    trial.carom("verify", out, env={"TMPDIR": str(trial.home)})


def pages(trial):
    """Pages are made of every run."""
    if trial.random("pages").random() > 0.2:
        raise Skipped("not of every scene")
    for command in ("play", "report"):
        trial.carom(command, trial.main, "-o", trial.home / f"{command}.html", codes=(0,) if command == "report" else (0, 2))


# Engines against each other --------------------------------------------------------------------------------------------------------------------


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
    """Which of the first events are the same, as tests/support/duel.hpp has it: places are known to a part in 1e13 of the box, so squares
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
    fighters, covered = [chosen], []
    for engine in ("general", "textbook", "textbook-long-double"):
        out = trial.run(f"engine-{engine}", *options, "--engine", engine, "--verify", r.choice([1, 20, 300]) if len(times) < 300 else 300, scene=scene, codes=(0, 2) if engine == "general" else (0,))
        if (out / "summary.json").exists():
            covered.append(engine)
            if engine != chosen.engine:
                fighters.append(Log(out))
    if r.random() < 0.1:
        trial.run("engine-textbook-quad", *options, "--engine", "textbook-quad", scene=scene)
        if scene.units == (0, 0, 0):  # floats cannot square other lengths
            trial.run("engine-textbook-float", *options, "--engine", "textbook-float", scene=scene, codes=(0, 2, 3))
    disks = len(chosen.radius)
    if not disks or not len(chosen):
        return
    pull = pull_of(trial, edges)
    finer = fighters[-1]
    nudged = [nudge(trial, scene, chosen, by, edges, options) for by in (4.0, -4.0)]
    others = [finer] + [log for log in nudged if log is not None]
    if len(others) < 3:
        raise Skipped("the start cannot be nudged")
    stops = min(stage["collision"].get("restitution", 1.0) for stage in scene.stages()) <= 1e-5
    textbook = chosen if chosen.engine == "textbook" else fighters[-2]
    count = determined(textbook, others, disks, max(edges), pull, stops)
    for one, other in zip(fighters, fighters[1:]):
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
    from drawn_scene import Quantity

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


KINDS = {kind.__name__: kind for kind in (sound, engines, instructions, threads, cores, verify, resolved, samples, units, analyze, resume, extend, pages)}
