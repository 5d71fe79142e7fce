"""Whole runs: what the program does, with the same numbers, bits and files; observables of one's own; runs read back."""

import json
import os
import pickle
import re
import signal
import subprocess
import threading

import matplotlib
import matplotlib.pyplot as plt
import numpy as np
import pytest
from conftest import PROGRAM, ROOT, needs_program
from run_files import NOT_COMPARED

import carom

matplotlib.use("agg")

CLOCKS = (*NOT_COMPARED, "carom", "scene")


@pytest.fixture
def gas():
    return carom.Scene.load(ROOT / "docs/scenes/gas.toml").set({"run.time": 20.0, "run.sample_every": 0.5})


def without_clocks(summary):
    return {key: value for key, value in summary.items() if key not in CLOCKS}


@needs_program
@pytest.mark.parametrize("name", ["box", "granular_gas", "piston", "square_well", "shear", "rough", "growth", "thermostat", "drag"])
def test_a_run_has_the_programs_summary(name, tmp_path):
    scene = ROOT / f"docs/scenes/{name}.toml"
    changes = {"run.time": 2.0} if name not in ("growth", "box") else {}
    options = [option for key, value in changes.items() for option in ("--set", f"{key}={value}")]
    subprocess.run([PROGRAM, "run", scene, "--out", tmp_path / "run", "--quiet", *options], check=True)
    expected = json.loads((tmp_path / "run/summary.json").read_text())
    result = carom.run(carom.Scene.load(scene).set(changes))
    assert without_clocks(result.summary) == without_clocks(expected)


@needs_program
def test_files_that_python_wrote_are_the_programs(tmp_path, gas):
    carom.run(gas, out=tmp_path / "run", events=True, observables=["pressure", "velocity_autocorrelation"])
    verified = subprocess.run([PROGRAM, "verify", tmp_path / "run"], capture_output=True, text=True)
    assert verified.returncode == 0, verified.stdout + verified.stderr
    assert "the same to the last bit" in verified.stdout


def test_a_run_without_files_has_the_numbers_of_one_with_files(tmp_path, gas):
    observables = {"pressure": True, "radial_distribution": {"range": 4.0}}
    bare = carom.run(gas, observables=observables, frames=True)
    written = carom.run(gas, observables=observables, out=tmp_path / "run")
    assert without_clocks(bare.summary) == without_clocks(written.summary)
    assert np.array_equal(bare.observables["radial_distribution"].table["g"], written.observables["radial_distribution"].table["g"])
    assert bare.observables["pressure"]["Z"] == written.observables["pressure"]["Z"]
    assert written.files == ["trajectory.h5md", "observe_radial_distribution.csv", "summary.json"]
    assert bare.files == [] and bare.directory is None
    stored = carom.open_run(tmp_path / "run").frames
    assert np.array_equal(stored.positions, bare.frames.positions)
    assert np.array_equal(stored.velocities[3:5], bare.frames.velocities[3:5])
    assert np.array_equal(stored.time, bare.frames.time)


def test_frames_of_a_run_are_those_of_a_simulation_that_equilibrated(gas):
    frames = carom.run(gas, frames=True).frames
    sim = carom.Simulation(gas)
    assert sim.equilibrate() == "collisions"
    sampled = sim.sample(0.5, 20.0)
    for name in ("time", "positions", "velocities", "images", "collisions", "virial"):
        assert np.array_equal(getattr(frames, name), getattr(sampled, name)), name
    assert sampled.state_hash == frames.state_hash


class Everything(carom.Observable):
    """Keeps all that it is told."""

    name, step, follows_collisions = "everything", 0.5, True

    def start(self, state):
        self.begin = state.time
        self.times, self.seen, self.batches = [], 0, []
        self.impulse = carom.Blocking()

    def sample(self, state, collisions, virial):
        self.times.append(state.time)
        assert self.seen == collisions, "all collisions come before a sample"

    def collisions(self, batch):
        self.seen += len(batch)
        self.batches.append(batch)  # which stays what it is
        self.impulse.add(np.hypot(*batch["impulse"].T))

    def finish(self, time, collisions, virial):
        told = np.concatenate(self.batches)
        # The virial of the hard-disk force, from what the observable was told.
        own = (told["separation"] * told["impulse"]).sum()
        table = carom.Table({"t": self.times, "n": np.arange(len(self.times))}, {"t": "time"})
        return {"virial": own, "of_library": virial, "impulse": self.impulse.estimate("momentum"), "times": table}


def test_an_observable_of_ones_own_is_told_everything_and_changes_nothing(gas):
    everything = Everything()
    result = carom.run(gas, observables=["pressure", everything])
    assert result.state_hash == carom.run(gas).state_hash
    measured = result.observables["everything"]
    assert measured["virial"].value == pytest.approx(measured["of_library"].value, rel=1e-11)
    assert measured["impulse"].error > 0 and measured["impulse"].unit == "momentum"
    assert measured.table["t"].tolist() == [0.5 * k for k in range(41)]
    assert everything.seen == result.collisions
    told = np.concatenate(everything.batches)
    assert (np.diff(told["time"]) >= 0).all() and told["contact"].all()
    # Momentum is conserved in each collision; masses are 1.
    before = told["velocity_before"] + told["partner_velocity_before"]
    assert np.allclose(before, told["velocity"] + told["partner_velocity"], atol=1e-13)


class Batches(carom.Observable):
    name, follows_collisions = "batches", True

    def __init__(self):
        self.contacts = []

    def collisions(self, batch):
        self.contacts += batch["contact"].tolist()


def test_batches_hold_edges_of_wells_which_are_no_contacts():
    batches = Batches()
    result = carom.run(carom.Scene.preset("square_well").set({"run.time": 1.0}), observables=[batches])
    assert sum(batches.contacts) == result.collisions < len(batches.contacts)


def test_the_effects_that_change_velocities_between_collisions_are_refused_beside_observables_that_follow_them(gas):
    effects = {
        "growth": {"rate": 0.01},
        "thermostat": {"temperature": 1.0, "rate": 0.1},
        "tumbling": {"rate": 0.1},
        "brownian": {"temperature": 1.0, "rate": 10.0},
        "shear": {"rate": 0.1},
        "drag": {"rate": 0.1},
    }
    for name, table in effects.items():
        scene = carom.Scene({**gas.to_dict(), "run": {"time": 1.0, "sample_every": 0.5}, "observe": None, name: table})
        with pytest.raises(carom.SceneError, match=rf"batches follows disks from collision to collision, and \[{name}\] changes their velocities"):
            carom.run(scene, observables=[Batches()])
        assert f"[{name}]" in carom.Observable.__doc__


@pytest.mark.parametrize("others", [[], ["pressure"]])
def test_an_observable_of_ones_own_is_no_difference(gas, tmp_path, program, others):
    carom.run(gas, observables=[*others, Everything()], out=tmp_path / "run")
    assert carom.open_run(tmp_path / "run").verify() == []
    told = program("verify", tmp_path / "run")
    assert told.returncode == 0
    assert told.stdout.endswith("summary.json (without everything, which the scene does not ask for)\n")


def test_a_number_that_another_run_has_not_is_a_difference(gas, tmp_path):
    carom.run(gas, observables=["pressure", Everything()], out=tmp_path / "run")
    summary = tmp_path / "run" / "summary.json"
    told = json.loads(summary.read_text())
    told["observables"]["pressure"]["Z"]["value"] *= 1.0 + 1e-15
    summary.write_text(json.dumps(told))
    assert ["/observables/pressure/Z/value" in difference for difference in carom.open_run(tmp_path / "run").verify()] == [True]


def test_an_observable_that_keeps_no_batch_is_told_the_same(gas):
    class Virial(carom.Observable):
        name, step, follows_collisions, own = "virial", 0.5, True, 0.0

        def collisions(self, batch):
            self.own += (batch["separation"] * batch["impulse"]).sum()

        def finish(self, time, collisions, virial):
            return {"own": self.own, "of_library": virial}

    measured = carom.run(gas, observables=[Virial()]).observables["virial"]
    assert measured["own"].value == pytest.approx(measured["of_library"].value, rel=1e-11)


def test_debuggers_and_coverage_see_an_observable_at_work(gas):
    seen = set()

    class Watched(carom.Observable):
        step = 0.5

        def sample(self, state, collisions, virial):
            pass

    threading.settrace(lambda frame, event, argument: seen.add(frame.f_code.co_name))
    try:
        carom.run(gas, observables=[Watched()])
    finally:
        threading.settrace(None)
    assert {"sample", "finish"} <= seen


def test_what_an_observable_raises_comes_out_of_the_run(gas, tmp_path):
    class Broken(carom.Observable):
        name, follows_collisions = "broken", True

        def collisions(self, batch):
            raise RuntimeError("it broke")

    with pytest.raises(RuntimeError, match="it broke"):
        carom.run(gas, observables=[Broken()])
    with pytest.raises(TypeError, match="no observable"):
        carom.run(gas, observables=[3])

    class Wrong(carom.Observable):
        name = "wrong"

        def finish(self, time, collisions, virial):
            return {"x": object()}

    with pytest.raises(TypeError, match="wrong.x is a object"):
        carom.run(gas, observables=[Wrong()])


class Samples(carom.Observable):
    """Counts its samples."""

    def __init__(self, name, step=0.5):
        self.name, self.step, self.samples = name, step, 0

    def sample(self, state, collisions, virial):
        self.samples += 1

    def finish(self, time, collisions, virial):
        return {"samples": self.samples}


@needs_program
def test_a_run_goes_on_with_the_observables_with_which_it_began(gas, tmp_path, program):
    directory = tmp_path / "run"
    carom.run(gas, out=directory, observables=[Samples("one"), Samples("other"), "pressure"], checkpoint_every="1h")
    before = {path.name: path.read_bytes() for path in directory.iterdir()}
    for observables, sentence in [
        ([], r"saved with the observable one \(sampled every 0.5\) of a program's own; go on with it in such a program"),
        ([Samples("one")], r"saved with the observable other \(sampled"),
        ([Samples("other"), Samples("one")], r"saved with the observable one \(sampled every 0.5\), and the observable other"),
        ([Samples("one", 0.25), Samples("other")], r"sampled every 0.5\), and the observable one \(sampled every 0.25\) is in its place"),
        ([Samples("one"), Samples("other"), Samples("third")], "saved without the observable third"),
    ]:
        with pytest.raises(ValueError, match=sentence):
            carom.resume(directory, time=30.0, observables=observables)
    refused = program("extend", directory, "--time", "30")
    assert refused.returncode == 2 and "saved with the observable one" in refused.stderr
    assert {path.name: path.read_bytes() for path in directory.iterdir()} == before
    longer = carom.resume(directory, time=30.0, observables=[Samples("one"), Samples("other")])
    assert longer.observables["one"]["samples"].value == 61


@pytest.mark.parametrize("method", ["sample", "collisions"])
def test_files_are_complete_until_an_observable_failed(gas, tmp_path, method):
    class Broken(carom.Observable):
        name, step, follows_collisions = "broken", 0.25, True

        def collisions(self, batch):
            self.last = batch["time"][-1]
            if method == "collisions" and self.last > 3.0:
                raise RuntimeError("it broke")

        def sample(self, state, collisions, virial):
            if method == "sample" and state.time > 3.0:
                raise RuntimeError("it broke")

        def finish(self, time, collisions, virial):
            raise AssertionError("an observable that has failed is not asked for results")

    long = gas.set({"run.time": 1e6, "run.sample_every": 0.25})
    with pytest.raises(RuntimeError, match="it broke") as caught:
        carom.run(long, observables=[Broken(), "pressure"], out=tmp_path / "run")
    assert caught.value.__notes__ == ["besides: the observable broken cannot be saved: it has failed; the run cannot go on later"]
    run = carom.open_run(tmp_path / "run")
    assert 3.0 < run.frames.time[-1] < 1e6
    assert run.summary["stopped"] == "interrupted" and run.summary["observables"]["broken"] == {}
    assert run.summary["observables"]["pressure"]["Z"]["value"] > 1.0


def test_a_run_goes_on_from_where_it_was_saved_before_an_observable_failed(gas, tmp_path):
    class Sum(carom.Observable):
        name, step, needs_positions = "sum", 0.25, False
        fails, total = False, 0.0

        def sample(self, state, collisions, virial):
            self.total += collisions
            if Sum.fails and state.time > 50.0:
                raise RuntimeError("it broke")

        def finish(self, time, collisions, virial):
            return {"total": self.total}

    scene = gas.set({"run.time": 300.0})
    expected = carom.run(scene, observables=[Sum()]).observables["sum"]["total"]
    Sum.fails = True
    with pytest.raises(RuntimeError, match="it broke") as caught:
        carom.run(scene.set({"run.time": 1e6}), observables=[Sum()], out=tmp_path / "run", checkpoint_every="5000 collisions")
    assert "the run can go on from where it was saved before, and not from here" in caught.value.__notes__[0]
    Sum.fails = False
    assert carom.resume(tmp_path / "run", time=300.0, observables=[Sum()]).observables["sum"]["total"] == expected


def test_an_observable_that_cannot_be_pickled_loses_no_files(gas, tmp_path):
    class Locked(carom.Observable):
        name = "locked"

        def start(self, state):
            self.lock = threading.Lock()

    with pytest.warns(UserWarning, match="the observable locked cannot be saved: TypeError: cannot pickle"):
        result = carom.run(gas, observables=[Locked()], out=tmp_path / "run", checkpoint_every="1 collisions")
    assert carom.open_run(tmp_path / "run").summary["state_hash"] == result.state_hash


def test_a_complete_run_that_could_not_be_saved_keeps_no_older_checkpoint(gas, tmp_path):
    class LockedLater(Samples):
        def sample(self, state, collisions, virial):
            if state.time > 50.0:
                self.lock = threading.Lock()

    with pytest.warns(UserWarning, match="the run is complete, and cannot be extended from here"):
        carom.run(gas.set({"run.time": 300.0}), observables=[LockedLater("later")], out=tmp_path / "run", checkpoint_every="500 collisions")
    assert carom.open_run(tmp_path / "run").summary["stopped"] == "time"
    with pytest.raises(carom.OutputError, match="no checkpoint"):
        carom.resume(tmp_path / "run", observables=[Samples("later")])


@pytest.mark.parametrize(
    ("attributes", "kind", "sentence"),
    [
        ({"name": 5}, TypeError, "the name of an observable is 5; give a string"),
        ({"name": "a b"}, ValueError, "has the name 'a b'; take at most 100 letters, digits and underscores"),
        ({"name": "pressure"}, ValueError, "two observables have the name 'pressure'"),
        ({"name": "other"}, ValueError, "two observables have the name 'other'"),
        ({"step": "x"}, TypeError, "the step of own is 'x'; give a number"),
        ({"step": -1.0}, ValueError, "the step of own is -1.0; give a time, or 0"),
        ({"step": float("nan")}, ValueError, "the step of own is nan"),
        ({"__class__": type("Sampling", (carom.Observable,), {"sample": print})}, ValueError, "own has a sample.., and its step is 0"),
        ({"__class__": type("Following", (carom.Observable,), {"collisions": print})}, ValueError, "follows_collisions is False"),
        ({"finish": lambda *_: None}, TypeError, r"own.finish\(\) returned None; give a mapping"),
        ({"finish": lambda *_: {1: 2.0}}, TypeError, r"a name of what own.finish\(\) returned is 1; give a string"),
    ],
)
def test_an_observable_that_makes_no_sense_is_refused(gas: carom.Scene, attributes, kind, sentence: str) -> None:
    own, other = carom.Observable(), carom.Observable()
    own.name, other.name = "own", "other"
    for name, value in attributes.items():
        setattr(own, name, value)
    with pytest.raises(kind, match=sentence):
        carom.run(gas, observables=[other, own, "pressure"])


def test_ctrl_c_completes_the_files_and_a_checkpoint_goes_on(tmp_path, gas):
    long = gas.set({"run.time": 1e6, "run.sample_every": 1e3})
    timer = threading.Timer(0.4, os.kill, (os.getpid(), signal.SIGINT))
    timer.start()
    with pytest.raises(carom.Interrupted) as caught:
        carom.run(long, out=tmp_path / "run", observables=[Everything()])
    timer.join()
    result = caught.value.result
    assert result.stopped == "interrupted" and result.saved and result.time > 0
    assert json.loads((tmp_path / "run/summary.json").read_text())["state_hash"] == result.state_hash
    end = float(np.ceil(result.time)) + 1.0
    resumed = carom.resume(tmp_path / "run", time=end, observables=[Everything()])
    assert resumed.time == end
    whole = carom.run(gas.set({"run.time": end, "run.sample_every": 1e3}), observables=[Everything()])
    assert whole.state_hash == resumed.state_hash
    assert whole.observables["everything"]["impulse"] == resumed.observables["everything"]["impulse"]
    assert isinstance(pickle.loads(pickle.dumps(caught.value)).result, carom.Result)


@needs_program
def test_a_run_that_checks_its_invariants_still_does_where_python_goes_on(tmp_path, gas):
    scene = tmp_path / "gas.toml"
    scene.write_text(gas.set({"run.time": 1e6, "run.sample_every": 1e4}).toml)
    command = [PROGRAM, "run", scene, "--out", tmp_path / "run", "--verify", "1000", "--walltime", "1s", "--quiet"]
    assert subprocess.run(command).returncode == 130
    stopped = json.loads((tmp_path / "run/summary.json").read_text())
    resumed = carom.resume(tmp_path / "run", time=stopped["time"] + 5.0)
    assert resumed.summary["verified"]["every"] == 1000
    assert resumed.summary["verified"]["checks"] > stopped["verified"]["checks"] > 0


def test_a_limit_of_real_time_stops_a_run(gas):
    result = carom.run(gas.set({"run.time": 1e9, "run.sample_every": 1e6}), walltime="1s")
    assert result.stopped == "interrupted" and 0 < result.time < 1e9


def test_an_observable_may_write_with_h5py_while_the_run_writes_too(tmp_path, gas):
    h5py = pytest.importorskip("h5py", reason="h5py is not installed")

    class Writer(carom.Observable):
        name, step = "writer", 1.0

        def start(self, state):
            self.file = h5py.File(tmp_path / "own.h5", "w")

        def sample(self, state, collisions, virial):
            self.file[f"{state.time}"] = state.positions

        def finish(self, time, collisions, virial):
            count = len(self.file)
            self.file.close()
            return {"frames": count}

    result = carom.run(gas, out=tmp_path / "run", observables=[Writer()])
    assert result.observables["writer"]["frames"].value == 21


def test_progress_is_told(gas):
    told = []
    carom.run(gas.set({"run.time": 400.0, "run.sample_every": 100.0}), progress=told.append)
    assert told == sorted(told) and all(0 <= fraction <= 1.0 for fraction in told)


@pytest.mark.parametrize("end", [{}, {"time": 9000.0}, {"collisions": 5_000_000}], ids=["its own end", "a later time", "more collisions"])
def test_progress_of_a_run_that_goes_on_is_that_of_the_whole_run(gas, tmp_path, end):
    def interrupt(fraction):
        if fraction > 0.0:
            raise KeyboardInterrupt

    with pytest.raises(carom.Interrupted) as stopped:
        carom.run(gas.set({"run.time": 8000.0, "run.sample_every": 1000.0}), out=tmp_path / "run", progress=interrupt)
    told = []
    result = carom.resume(tmp_path / "run", progress=told.append, **end)
    before = stopped.value.result
    share = before.collisions / result.collisions if "collisions" in end else before.time / result.time
    assert told == sorted(told) and told and share <= told[0] and told[-1] <= 1.0


def test_runs_side_by_side_have_the_bits_of_one_after_the_other(gas, tmp_path):
    from concurrent.futures import ThreadPoolExecutor

    alone = [carom.run(gas, seed=seed).state_hash for seed in range(4)]
    with ThreadPoolExecutor(4) as pool:
        together = list(pool.map(lambda seed: carom.run(gas, seed=seed).state_hash, range(4)))
        written = list(pool.map(lambda seed: carom.run(gas, seed=seed, out=tmp_path / str(seed)).state_hash, range(4)))
    assert together == alone and written == alone


def test_results_in_the_way_are_kept(tmp_path, gas):
    carom.run(gas, out=tmp_path / "run")
    before = (tmp_path / "run/summary.json").read_bytes()
    with pytest.raises(carom.OutputError, match="overwrite=True"):
        carom.run(gas, out=tmp_path / "run")
    assert (tmp_path / "run/summary.json").read_bytes() == before
    carom.run(gas, out=tmp_path / "run", overwrite=True)


def test_more_disks_than_there_is_memory_for_are_refused_before_they_are_drawn(tmp_path, gas):
    if not os.path.exists("/proc/meminfo"):
        pytest.skip("the system does not say how much memory is free")
    many = gas.set({"disks.0.count": 2_000_000_000})
    with pytest.raises(MemoryError, match=r"there is not enough memory for 2,000,000,000 disks: they need some 215 bytes per disk, and 700 GB"):
        carom.run(many, out=tmp_path / "run")
    assert not (tmp_path / "run").exists()


def test_directories_that_are_none_are_named(tmp_path):
    with pytest.raises(carom.OutputError, match="no directory of a finished run"):
        carom.open_run(tmp_path)
    with pytest.raises(carom.OutputError):
        carom.resume(tmp_path)


def test_a_run_read_back_measures_what_the_run_did(tmp_path, gas):
    result = carom.run(gas, out=tmp_path / "run", events=True, observables={"temperature": True, "free_flight": True})
    run = carom.open_run(tmp_path / "run")
    stored = run.observables
    assert dict(stored["temperature"]) == dict(result.observables["temperature"])
    measured = run.analyze(["free_flight"])["free_flight"]
    for observed in (stored["free_flight"], measured):
        assert dict(observed) == dict(result.observables["free_flight"])
        for name, table in result.observables["free_flight"].tables.items():
            assert all(np.array_equal(observed.tables[name][column], table[column], equal_nan=True) for column in table)
    assert run.verify() == [] and run.scene == result.scene and run.state_hash == result.state_hash
    sim = carom.Simulation(gas)
    sim.equilibrate()
    assert np.array_equal(run.events, sim.record(20.0))


def test_an_analysis_of_a_gas_with_wells_warns_of_what_the_run_did(tmp_path):
    side = float(np.sqrt(60 * np.pi / 4 / 0.71))
    scene = carom.Scene(
        box={"x": (0, side), "y": (0, side), "boundary": "periodic"},
        disks={"count": 60, "radius": 0.5, "mass": 1, "positions": "hexagonal", "velocities": {"temperature": 1}},
        collision={"rule": "specular"},
        square_well={"width": 1.1, "depth": 0.1},
        run={"collisions": 30_000},
    )
    result = carom.run(scene, out=tmp_path / "run", events=True, observables=["free_flight"])
    note = result.observables["free_flight"].note
    assert "domains" in note and carom.open_run(tmp_path / "run").analyze(["free_flight"])["free_flight"].note == note


def test_arrays_of_a_stored_run_are_indexed_as_numpys_are(gas, tmp_path):
    stored = carom.run(gas.set({"run.time": 3.0}), out=tmp_path / "run") and carom.open_run(tmp_path / "run").frames.positions
    whole = stored[:]
    frames, disks, _ = whole.shape
    assert whole.shape == stored.shape == (7, gas.count, 2) and stored.ndim == 3 and stored.dtype == whole.dtype
    everything, mask, odd = slice(None), np.arange(frames) % 3 == 0, np.arange(disks) % 2 == 1
    of_frames = [0, -1, np.int64(2), everything, slice(1, 5, 2), slice(None, None, -1), [4, 0, 4], [], mask, np.array([2, -1])]
    of_disks = [3, -2, everything, slice(-5, None), slice(9, 2, -3), [7, 1], odd]
    of_axes = [0, 1, -1, -2, everything, slice(1), slice(None, None, -1), [1, 0], [True, False]]
    indices = [(a, b, c) for a in of_frames for b in of_disks for c in of_axes] + [(a, b) for a in of_frames for b in of_disks]
    indices += [*of_frames, (), Ellipsis, (Ellipsis, 0), (Ellipsis, -1), (2, Ellipsis), (2, Ellipsis, 1), (slice(2), 1, 0, Ellipsis), None]
    indices += [(everything, None, 0), (None, 1), True, whole > 0.0, whole[..., 0] > 0.0, ([0, 1], [2, 3], [1, 0]), (7,), (0, disks), (0, 0, 2), (0, 0, 0, 0)]
    refused = 0
    for index in indices:
        try:
            expected = whole[index]
        except IndexError:
            refused += 1
            with pytest.raises(IndexError):
                stored[index]
            continue
        found = stored[index]
        assert found.shape == expected.shape and np.array_equal(found, expected), index
    assert refused < len(indices) // 3
    assert np.array_equal(stored**2 - 1, whole**2 - 1) and np.mean(stored) == np.mean(whole)
    with pytest.raises(TypeError):
        stored += 1.0
    with pytest.raises(TypeError):
        np.add.at(stored, 0, 1.0)
    assert np.array_equal(np.hypot(*np.moveaxis(stored, 2, 0)), np.hypot(*np.moveaxis(whole, 2, 0)))


def test_frames_that_a_run_gains_later_are_there(gas, tmp_path):
    carom.run(gas, out=tmp_path / "run", checkpoint_every="1h")
    run = carom.open_run(tmp_path / "run")
    frames = run.frames
    assert len(frames) == 41 and frames[-1].time == run.state().time == 20.0
    carom.resume(tmp_path / "run", time=30.0)
    assert len(frames) == 61 and frames[-1].time == run.state().time == carom.open_run(tmp_path / "run").state().time == 30.0
    assert [state.time for state in frames] == frames.time.tolist() == np.arange(0.0, 30.5, 0.5).tolist()
    carom.resume(tmp_path / "run", time=40.0)  # more than are read at once
    assert [state.time for state in frames] == np.arange(0.0, 40.5, 0.5).tolist()


@pytest.mark.parametrize("part", [slice(None), slice(2, -1, 2), slice(None, None, -3), slice(5, 2)], ids=str)
@pytest.mark.parametrize("preset", ["gas", "growth", "compression", "couette", "rough"])
def test_a_slice_of_stored_frames_is_that_of_frames_in_memory(tmp_path, preset, part):
    scene = carom.Scene.preset(preset).set({"run.time": 1.0, "run.sample_every": 0.1})
    frames = carom.run(scene, out=tmp_path / "run", frames=True).frames[part]
    stored = carom.open_run(tmp_path / "run").frames[part]
    assert len(frames) == len(stored) == len(range(11)[part])
    assert stored.state_hash == frames.state_hash and stored.scene == frames.scene
    for name in ("time", "positions", "velocities", "images", "unwrapped", "scale", "collisions", "virial", "radii", "masses", "species"):
        array, expected = getattr(stored, name), getattr(frames, name)
        assert array.dtype == expected.dtype and np.array_equal(array, expected), name
    for state, expected in zip(stored, frames, strict=True):
        assert state == expected and np.array_equal(state.spins, expected.spins) and state.walls == expected.walls
    assert stored.to_xarray().identical(frames.to_xarray()) or len(frames) == 0


class Odd(carom.Observable):
    name = "odd"

    def __init__(self, results):
        self.results = results

    def finish(self, time, collisions, virial):
        return self.results


@pytest.mark.parametrize(
    ("results", "kind", "sentence"),
    [
        ({"x/y": 1.0}, ValueError, "a result of odd has the name 'x/y'; take a word without / , \" and control characters"),
        ({"": 1.0}, ValueError, "has the name ''"),
        ({"t": carom.Table({"a\0b": [1.0]})}, ValueError, "take a word without /"),
        ({"x": 10**400}, ValueError, "odd.x is beyond the range of a double"),
        ({"x": carom.Number(1.0, error="small")}, TypeError, "the error of odd.x is a str"),
        ({"tables": 1.0}, ValueError, "a result of odd has the name 'tables', which the summary uses itself"),
        ({"t": carom.Table({"c,d": [1.0]})}, ValueError, "has the name 'c,d'"),
        ({"t u": carom.Table({"c": [1.0]})}, ValueError, "a table of odd has the name 't u', and a file of its own"),
        ({"x": carom.Number(1.0, unit=3)}, TypeError, "the unit of odd.x is 3; give a string"),
    ],
    ids=["slash", "empty", "column", "huge", "error", "tables", "comma", "space", "unit"],
)
def test_results_that_files_cannot_hold_are_refused_and_the_others_kept(gas, tmp_path, results, kind, sentence):
    with pytest.raises(kind) as refused:
        carom.run(gas.set({"run.time": 0.5}), observables=[Odd(results)], out=tmp_path / "run")
    assert sentence in str(refused.value)
    assert carom.open_run(tmp_path / "run").verify() == []


def test_tables_of_one_name_have_files_of_their_own(gas, tmp_path):
    class Even(Odd):
        name = "even"

    one, other = carom.Table({"x": [1.0]}), carom.Table({"x": [2.0]})
    carom.run(gas.set({"run.time": 0.5}), observables=[Odd({"t": one}), Even({"t": other})], out=tmp_path / "run")
    found = carom.open_run(tmp_path / "run").observables
    assert [list(found[name].tables) for name in ("odd", "even")] == [["t"], ["even_t"]]
    assert found["even"].tables["even_t"]["x"].tolist() == [2.0]


def test_whether_an_observable_follows_collisions_is_a_bool(gas):
    odd = Odd({})
    odd.follows_collisions = 1
    with pytest.raises(TypeError, match="follows_collisions of odd is 1; give True or False"):
        carom.run(gas, observables=[odd])


@pytest.mark.parametrize("own", [[], [Odd({})]])
def test_what_a_signal_raises_ends_a_run_whose_files_are_complete(gas, tmp_path, own):
    class OutOfTime(Exception):
        pass

    rings = []

    def ring(*_):
        rings.append(signal.SIGALRM)
        if len(rings) < 3:
            raise OutOfTime

    before = signal.signal(signal.SIGALRM, ring)
    try:
        signal.setitimer(signal.ITIMER_REAL, 0.5, 0.001 if own else 0.0)  # and again, while files are completed
        with pytest.raises(OutOfTime):
            carom.run(gas.set({"run.time": 1e6, "run.sample_every": 1e5}), observables=own, out=tmp_path / "run")
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, before)
    assert threading.active_count() == 1
    assert carom.open_run(tmp_path / "run").summary["stopped"] == "interrupted"


@pytest.mark.parametrize("text", ["[]", "{}", "3", "{"])
def test_a_summary_that_is_none_is_refused(tmp_path, text):
    (tmp_path / "summary.json").write_text(text)
    with pytest.raises(carom.OutputError, match="this is not the summary of a run"):
        carom.open_run(tmp_path)


def test_a_run_with_springs_is_verified_with_their_stiffness(tmp_path, gas):
    specular = gas.set({"collision.rule": "specular"})
    result = carom.run(specular, out=tmp_path / "run", method="soft", dt=0.002, stiffness=2e3)
    assert carom.open_run(tmp_path / "run").verify() == []
    assert carom.run(specular, method="soft", dt=0.002).state_hash != result.state_hash


def test_results_pickle_and_go_to_pandas(gas):
    pandas = pytest.importorskip("pandas")
    result = carom.run(gas, observables=["pressure"], frames=True)
    copy = pickle.loads(pickle.dumps(result))
    assert copy.summary == result.summary and copy.observables["pressure"]["Z"] == result.observables["pressure"]["Z"]
    assert copy.state == result.state and np.array_equal(copy.frames.positions, result.frames.positions)
    series = result.to_series()
    assert isinstance(series, pandas.Series) and series["pressure.Z"] == result.Z.value
    assert "<table>" in result._repr_html_()


def test_numbers_print_with_their_errors():
    assert str(carom.Number(2.06018, 0.00103)) == "2.0602 ± 0.0010"
    assert str(carom.Number(12345.6, 123.4)) == "12350 ± 120"
    assert str(carom.Number(5.0, 0.0996)) == "5.00 ± 0.10"
    assert str(carom.Number(np.float32(1e-9), np.float32(1e-10))) == "1.00e-09 ± 0.10e-09"
    assert str(carom.Number(9.96e7, 1e3)) == "9.96000e+07 ± 0.00010e+07"
    assert str(carom.Number(1.5)) == "1.5" and float(carom.Number(1.5)) == 1.5


def test_a_table_over_a_grid_is_a_dataset_over_its_axes(gas):
    xarray = pytest.importorskip("xarray")
    table = carom.run(gas, observables={"fields": {"cells": [4, 3]}}).observables["fields"].tables["fields"]
    data = table.to_xarray()
    assert isinstance(data, xarray.Dataset) and dict(data.sizes) == {"x": 4, "y": 3} and data["density"].dims == ("x", "y")
    for k in range(12):
        place = {"x": table["x"][k], "y": table["y"][k]}
        assert float(data["density"].sel(place)) == table["density"][k] and data["density"].attrs["units"]
    over_time = carom.Table({"time": [0.0, 1.0, 0.0, 1.0], "x": [1.0, 1.0, 0.0, 0.0], "n": [1, 2, 3, 4]}).to_xarray()
    assert over_time["n"].dims == ("time", "x") and over_time["n"].values.tolist() == [[3, 1], [4, 2]]
    words = np.array(["specular", "specular", "reversal", "reversal"], dtype=object)
    for first, keys in {"count": [64, 64, 128, 128], "rule": words, "on": [False, False, True, True]}.items():
        data = carom.Table({first: keys, "eta": [0.1, 0.2, 0.1, 0.2], "Z": [1.0, 2.0, 3.0, 4.0]}).to_xarray()
        assert dict(data.sizes) == {first: 2, "eta": 2} and data["Z"].sel({first: keys[2], "eta": 0.2}) == 4.0
    mixed = carom.Table({"rate": np.array([None, "fast", None, "fast"]), "eta": [0.1, 0.1, 0.2, 0.2], "Z": [1.0, 2.0, 3.0, 4.0]}).to_xarray()
    assert mixed["Z"].dims == ("rate",)
    scattered = carom.Table({"time": [0.0, 1.0, 0.0], "x": [1.0, 1.0, 0.0]}).to_xarray()
    assert scattered["x"].dims == ("time",) and scattered["x"].values.tolist() == [1.0, 1.0, 0.0]


def test_the_numbers_of_a_measurement_are_a_dataset(gas):
    pytest.importorskip("xarray")
    pressure = carom.run(gas, observables={"pressure": True}).observables["pressure"]
    data = pressure.to_xarray()
    assert data["name"].values.tolist() == list(pressure) and data.attrs["title"] == "pressure"
    assert float(data["value"].sel(name="Z")) == pressure["Z"].value and float(data["error"].sel(name="Z")) == pressure["Z"].error


def test_a_table_is_drawn_as_the_page_of_a_report_draws_it(gas):
    source = (ROOT / "src/pages/observable_plots.cpp").read_text()
    frame = r'\{"(\w+)",\s+"[\w-]+",(?:\s+"[^"]*",){3}\s+\{\{(.*?)\}\},\s+(true|false),\s+(true|false)'
    of_report = {}
    for table, columns, log_x, log_y in re.findall(frame, source):
        of_report.setdefault(table, (re.findall(r'\{"(\w+)"', columns), log_x, log_y))
    names = """radial_distribution structure_factor free_flight speeds hexatic voronoi clusters density_profile fields mean_square_displacement
        overlap intermediate_scattering non_gaussian van_hove velocity_autocorrelation viscosity heat_conductivity h_function""".split()
    found = carom.run(gas, observables=dict.fromkeys(names, True)).observables
    drawn = set()
    for table, columns in [pair for measurement in found.values() for pair in measurement.tables.items()]:
        if table.startswith("fields"):
            continue
        axes = columns.plot()
        starts, log_x, log_y = of_report[table]
        expected = [c for c in columns if not c.endswith("_error") and any(c == start or c.startswith(start + "_") for start in starts)]
        assert [line.get_label().split(" (")[0] for line in axes.containers] == expected, table
        assert (axes.get_xscale() == "log", axes.get_yscale() == "log") == (log_x == "true", log_y == "true"), table
        drawn.add(table)
        plt.close("all")
    assert drawn == set(of_report)
    viscosity = found["viscosity"].table
    by_integral, by_moment = (line.lines[0].get_xdata() for line in viscosity.plot().containers)
    assert np.array_equal(by_integral, viscosity["integral_to"]) and np.array_equal(by_moment, viscosity["lag"])
    diffusion = found["velocity_autocorrelation"].plot(y="diffusion")
    assert diffusion.get_xlabel() == "integral_to (time)" and diffusion.get_ylabel() == "diffusion (length^2 / time)"
    plt.close("all")


def test_a_table_over_a_plane_is_drawn_as_an_image(gas):
    fields = carom.run(gas, observables={"fields": {"cells": [4, 3]}}).observables["fields"]
    for drawn, name in ((fields.plot(), "density"), (fields.plot(y="temperature", cmap="magma"), "temperature")):
        (image,) = drawn.collections
        table = fields.table
        assert np.array_equal(np.ravel(image.get_array()), table[name][np.lexsort((table["x"], table["y"]))])
        assert (drawn.get_xlabel(), drawn.get_ylabel()) == ("x (length)", "y (length)") and image.colorbar.ax.get_ylabel().startswith(name)
    with pytest.raises(ValueError, match="over x and y, and an image shows one column, not 2; give one as y, or give x"):
        fields.plot(y=["density", "temperature"])
    with pytest.raises(ValueError, match=r"over time, x, y; draw a part of it, such as to_xarray\(\).isel\(time=0\)"):
        fields.tables["fields_in_time"].plot()
    line = carom.run(gas, observables={"fields": {"cells": [1, 5]}}).observables["fields"].plot()
    assert line.get_xlabel() == "y (length)" and len(line.containers) == 1
    own = carom.Table({"t": [0.0, 1.0], "x": [1.0, 0.5], "x_error": [0.1, 0.1], "n": [1, 2]})
    assert [drawn.get_label() for drawn in own.plot().containers] == ["x", "n"]
    rules = carom.Table({"rule": ["a", "a", "b", "b"], "eta": [0.1, 0.2, 0.1, 0.2], "Z": [1.0, 2.0, 3.0, 4.0]})
    assert [drawn.get_label() for drawn in rules.plot(x="eta", y="Z").containers] == ["Z"]
    plt.close("all")


def test_the_state_at_the_end_is_in_the_terms_of_the_scene(tmp_path):
    """A change ends the growth, and another one stops a wall; the scene of a result is that of the start."""
    places = np.stack(np.meshgrid(*[np.arange(5) * 2 + 1.0] * 2), -1).reshape(-1, 2)
    disks = {"radius": 0.5, "mass": 1, "positions": places, "velocities": np.random.default_rng(0).normal(size=places.shape)}
    parts = {"disks": disks, "collision": {"rule": "specular"}, "run": {"time": 8.0, "sample_every": 1.0}}
    box = {"x": (0, 10), "y": (0, 10)}
    growing = carom.Scene(box={**box, "boundary": "periodic"}, growth={"rate": 0.05}, changes=[{"time": 4.5, "set": ["growth.rate=0"]}], **parts)
    walled = {**box, "boundary": "walls"}
    moving = carom.Scene(box=walled, walls={"right": {"velocity": 0.3}}, changes=[{"time": 4.5, "set": ["walls.right.velocity=0"]}], **parts)
    pushed = carom.Scene(box=walled, changes=[{"time": 0.5, "set": ["walls.right.velocity=-0.1"]}], **parts)
    for name, scene in {"growing": growing, "moving": moving, "pushed": pushed}.items():
        result = carom.run(scene, out=tmp_path / name, frames=True)
        stored = carom.open_run(tmp_path / name).state()
        assert result.state.scale == stored.scale == result.frames[-1].scale
        assert [wall[0] for wall in result.state.walls] == [wall[0] for wall in stored.walls]
    assert carom.run(growing).state.scale == pytest.approx(1.0 + 0.05 * 4.5, rel=1e-12)
    run = carom.open_run(tmp_path / "pushed")
    areas = [carom.voronoi(run.scene, frame)["area"].sum() for frame in run.frames]
    assert areas == pytest.approx([100.0, *(100.0 - (k - 0.5) for k in range(1, 9))], rel=1e-9)


def test_blocking_knows_the_error_of_independent_numbers():
    series = carom.Blocking()
    values = np.random.default_rng(1).normal(3.0, 2.0, 40_000)
    series.add(values)
    assert series.estimate(step=0.5).integrated_correlation_time == pytest.approx(0.25, rel=0.1), "half a step"
    estimate = series.estimate()
    assert estimate.value == pytest.approx(values.mean(), rel=1e-12)
    # The standard error of 40,000 independent numbers is 2 / 200; its own relative error by blocks is a few per cent.
    assert estimate.error == pytest.approx(0.01, rel=0.15)
    assert pickle.loads(pickle.dumps(series)).estimate() == estimate
    assert np.isnan(carom.Blocking().estimate().value)


def test_every_public_name_is_there_when_it_is_asked_for():
    assert all(hasattr(carom, name) for name in carom.__all__) and set(carom.__all__) <= set(dir(carom))
    with pytest.raises(AttributeError, match="no attribute 'sweeep'"):
        carom.sweeep  # noqa: B018


def test_names_stay_where_pickles_of_earlier_versions_look_for_them():
    for module, names in {"runs": ("Run", "open_run"), "studies": ("Horizon", "LyapunovSpectrum", "horizon", "lyapunov_spectrum")}.items():
        for name in names:
            assert pickle.loads(f"ccarom.{module}\n{name}\n.".encode()) is getattr(carom, name)
