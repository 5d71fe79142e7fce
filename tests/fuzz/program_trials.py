"""Trials of the built program for tests/fuzz/whole_program: each runs one scene in some ways, which must lead to the same, and raises Failed
where something is wrong."""

import json
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
from run_files import differences

DISASTER = re.compile(r"Sanitizer|runtime error|[Aa]ssert|terminate called|what\(\):|Segmentation|core dumped|std::|basic_string")
WALLTIME = 20  # seconds for the main run
LONGEST = 30.0  # of processor time for any
LARGEST_FILE = 300 << 20


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
