"""A simulation has the bits of the program, however it is run, looked at and kept."""

from __future__ import annotations

import copy
import json
import math
import os
import pickle
import subprocess
import sys
import tomllib
from pathlib import Path

import h5py
import numpy as np
import pytest
from conftest import GAS, ROOT

import carom

SCENES = sorted((ROOT / "docs/scenes").glob("*.toml"))


def begin(scene: carom.Scene) -> carom.Simulation:
    """Returns the simulation where the program begins to measure."""
    sim = carom.Simulation(scene)
    sim.equilibrate()
    return sim


@pytest.mark.filterwarnings("ignore::carom.StoppedEarly")
@pytest.mark.parametrize("path", SCENES, ids=lambda path: path.stem)
def test_samples_and_events_are_those_of_the_program(path: Path, tmp_path: Path, program) -> None:
    whole = tomllib.loads(path.read_text())
    run = whole["run"]
    dt = run.get("sample_every", 0.5)
    changes: dict[str, object] = {"run.time": 20 * dt, "run.sample_every": dt, "output.unwrapped": False}
    if "equilibrate" in run:
        changes["run.equilibrate"] = {"time": 5.0} if "time" in run["equilibrate"] else {"collisions_per_disk": 2}
    if "changes" in whole:
        changes["changes"] = [change for change in whole["changes"] if change["time"] <= 20 * dt]
    scene = carom.Scene.load(path).set(changes)
    (tmp_path / "scene.toml").write_text(scene.toml)
    told = program("run", tmp_path / "scene.toml", "--events", "--quiet", "--out", tmp_path / "run")
    assert told.returncode == 0, told.stderr

    frames = begin(scene).sample(dt, until=20 * dt)
    events = begin(scene).record(until=20 * dt)
    summary = json.loads((tmp_path / "run/summary.json").read_text())
    with h5py.File(tmp_path / "run/trajectory.h5md") as file:
        particles = file["particles/trajectory"]
        assert np.array_equal(frames.time, particles["position/time"])
        assert np.array_equal(frames.positions, particles["position/value"][:, :, :2])
        assert np.array_equal(frames.velocities, particles["velocity/value"][:, :, :2])
        assert np.array_equal(frames.images, particles["image/value"][:, :, :2])
        assert np.array_equal(frames.radii, particles["radius"])
        for name in carom.EVENT.names:
            assert np.array_equal(events[name], file["events"][name]), name
    assert frames.state_hash == summary["state_hash"]
    assert frames.collisions[-1] == summary["events"]["pair"]


def test_program_writes_what_its_scenes_say_by_any_engine(tmp_path: Path, program) -> None:
    scene = ROOT / "docs/scenes/two_disks.toml"
    for engine in carom.engines():
        told = program("run", scene, "--engine", engine, "--quiet", "--out", tmp_path / engine)
        assert told.returncode == 0, told.stderr
        summary = json.loads((tmp_path / engine / "summary.json").read_text())
        sim = carom.Simulation(scene, engine=engine)
        assert sim.engine == engine
        sim.run_until(sim.scene.to_dict()["run"]["time"])
        assert sim.state_hash == summary["state_hash"]


@pytest.mark.parametrize("method", carom.fixed_step_methods())
def test_fixed_steps_are_those_of_the_program(method: str, tmp_path: Path, program) -> None:
    told = program(
        *("run", ROOT / "docs/scenes/box.toml", "--set=run.time=0.2", "--set=collision.rule='specular'"),
        *("--method", method, "--dt", 0.01, "--quiet", "--out", tmp_path / "run"),
    )
    assert told.returncode == 0, told.stderr
    sim = carom.Simulation(carom.Scene.preset("box").set({"collision.rule": "specular"}), method=method, dt=0.01)
    assert (sim.engine, sim.dt, sim.stiffness) == (method, 0.01, None)
    frames = sim.sample(0.001, until=0.2)
    with h5py.File(tmp_path / "run/trajectory.h5md") as file:
        assert np.array_equal(frames.positions, file["particles/trajectory/position/value"][:, :, :2])
    assert frames.state_hash == json.loads((tmp_path / "run/summary.json").read_text())["state_hash"]


def test_neither_stops_nor_looks_nor_copies_change_a_bit(gas: carom.Scene) -> None:
    whole = carom.Simulation(gas)
    whole.run_until(10.0)

    stretches = carom.Simulation(gas)
    while stretches.time < 10.0:
        stretches.run_until(min(stretches.time + 0.07, 10.0))
        assert stretches.positions.shape == (12, 2)
    assert stretches.state_hash == whole.state_hash

    steps = carom.Simulation(gas)
    met = [event for event in steps.events(until=10.0) if event.partner >= 0]
    assert steps.state_hash == whole.state_hash
    assert len(met) == steps.collisions == whole.collisions > 50

    for keep in (copy.copy, copy.deepcopy, lambda sim: pickle.loads(pickle.dumps(sim)), through_a_file):
        begun = carom.Simulation(gas)
        begun.run_until(3.3)
        kept = keep(begun)
        begun.run_until(4.0)
        assert kept.time == 3.3
        kept.run_until(10.0)
        assert (kept.state_hash, kept.totals) == (whole.state_hash, whole.totals)


def through_a_file(sim: carom.Simulation) -> carom.Simulation:
    path = Path(os.environ.get("TMPDIR", "/tmp")) / f"carom-{os.getpid()}.sim"
    try:
        sim.save(path)
        return carom.Simulation.load(path)
    finally:
        path.unlink(missing_ok=True)


def test_events_are_the_records(gas: carom.Scene) -> None:
    record = carom.Simulation(gas).record(until=5.0)
    events = list(carom.Simulation(gas).events(until=5.0))
    assert record.dtype == carom.EVENT
    assert len(record) == len(events) > 20
    for row, event in zip(record, events):
        assert (event.time, event.time_remainder, event.disk, event.partner) == tuple(row.tolist()[:4])
        assert event.velocity == tuple(row["velocity"]) and event.partner_velocity == tuple(row["partner_velocity"])
    assert events[0].partner_name == f"disk {events[0].partner}"


@pytest.mark.parametrize("drag", [None, {"rate": 0.1}])
def test_an_earlier_time_does_nothing(gas: carom.Scene, drag: Any) -> None:
    sim = carom.Simulation(gas.set({"drag": drag}) if drag else gas)
    sim.run_until(0.5)
    before = sim.state_hash
    sim.run_until(0.2)
    assert sim.time == 0.5 and sim.state_hash == before


def test_run_until_stops_at_a_number_of_collisions(gas: carom.Scene) -> None:
    sim = carom.Simulation(gas)
    assert sim.run_until(100.0, collisions=17) == carom.Stop.COLLISIONS == "collisions"
    assert sim.collisions == 17
    assert sim.run_until(sim.time) == "time"
    assert sim.run_until(0.0) == "time"  # an earlier time does nothing
    before = sim.time
    sim.run(1.5)
    assert sim.time == before + 1.5


def test_a_run_that_ends_early_says_why_once(gas: carom.Scene) -> None:
    sim = carom.Simulation(gas.set({"drag.rate": 10.0}))
    with pytest.warns(carom.StoppedEarly, match=r"^the run ended early, at time 3\.6\d*: at_rest$") as warned:
        stop = sim.run_until(10.0)
    assert len(warned) == 1
    assert stop is carom.Stop.AT_REST and stop.early


def test_facts_about_the_disks() -> None:
    light = {**GAS["disks"], "name": "light"}
    scene = carom.Scene(GAS, disks=[light, {**light, "name": "heavy", "count": 3, "radius": 0.2, "mass": 5.0}])
    sim = carom.Simulation(scene)
    assert sim.count == scene.count == 15
    assert scene.species == ["light", "heavy"]
    assert sim.species.tolist() == [0] * 12 + [1] * 3
    assert sim.radii.tolist() == [0.4] * 12 + [0.2] * 3
    assert sim.masses.tolist() == [1.0] * 12 + [5.0] * 3
    assert scene.packing_fraction == pytest.approx(math.pi * (sim.radii**2).sum() / 24.0, rel=1e-14)
    energy = 0.5 * (sim.masses * (sim.velocities**2).sum(axis=1)).sum()
    assert sim.kinetic_energy == pytest.approx(energy, rel=1e-14)
    sim.run_until(3.0)
    assert sim.kinetic_energy == pytest.approx(energy, rel=1e-12)
    assert sim.check_invariants() == []


def test_unwrapped_positions_follow_straight_flights() -> None:
    """A lone pair that misses each other flies on for ever; the images count how often."""
    state = carom.State(positions=[[1.0, 1.0], [1.0, 3.0]], velocities=[[2.0, 0.0], [-3.0, 0.0]])
    sim = carom.Simulation(carom.Scene(GAS).set({"disks.0.count": 2}), state=state)
    assert sim.run_until(10.0) == "time"
    assert sim.time == 10.0
    assert sim.unwrapped == pytest.approx(np.array([[21.0, 1.0], [-29.0, 3.0]]), abs=1e-12)
    assert sim.images.tolist() == [[3, 0], [-5, 0]]


def test_rough_disks_spin() -> None:
    scene = carom.Scene.load(ROOT / "docs/scenes/rough.toml")
    sim = carom.Simulation(scene)
    assert sim.spins.shape == (256,)
    sim.run_until(5.0)
    energy = 0.5 * (sim.velocities**2).sum() + 0.25 * (sim.radii**2 * sim.spins**2).sum()
    assert np.abs(sim.spins).max() > 0
    assert sim.kinetic_energy == pytest.approx(energy, rel=1e-13)
    assert sim.sample(0.5, until=6.0).spins.shape == (3, 256)


def test_beginning_from_a_state_is_beginning_from_the_disks(gas: carom.Scene) -> None:
    sim = carom.Simulation(gas)
    again = carom.Simulation(gas, state=carom.State(sim.positions, sim.velocities))
    assert again.state_hash == sim.state_hash
    sim.run_until(3.0)
    middle = carom.Simulation(gas, state=sim.state)
    assert middle.time == 0.0
    assert np.array_equal(middle.positions, sim.positions)


@pytest.mark.parametrize("engine", carom.engines())
def test_a_state_that_a_run_left_begins_another(engine: str) -> None:
    """Disks in it may overlap by the engine's rounding."""
    scene = carom.Scene.preset("gas").set({"disks.0.count": 1000})
    sim = carom.Simulation(scene, engine=engine)
    sim.run_until(0.2)
    assert carom.Simulation(scene, engine=engine, state=sim.state).state.positions.tolist() == sim.positions.tolist()


def test_a_state_in_a_sheared_box_knows_where_its_images_are() -> None:
    scene = carom.Scene.load(ROOT / "docs/scenes/shear.toml")
    sim = carom.Simulation(scene)
    sim.run_until(1.37)
    assert carom.Simulation(scene, state=sim.state).check_invariants() == []
    with pytest.raises(ValueError, match="overlaps disk"):
        carom.Simulation(scene, state=carom.State(sim.positions, sim.velocities))  # without the displacement


def test_a_scene_that_accepts_overlaps_takes_any_state_inside(gas: carom.Scene) -> None:
    state = carom.State(np.linspace([1.0, 1.0], [3.0, 1.0], 12))
    with pytest.raises(ValueError, match="disk 1 overlaps disk 0"):
        carom.Simulation(gas, state=state)
    for choice in ({}, {"method": "guarded", "dt": 0.01}):
        sim = carom.Simulation(gas.set({"run.accept_overlap": True}), state=state, **choice)
        assert sim.positions == pytest.approx(state.positions, abs=1e-15)


def test_seed_changes_the_start_alone(gas: carom.Scene) -> None:
    assert carom.Simulation(gas, seed=3).state_hash == carom.Simulation(gas).state_hash
    assert carom.Simulation(gas, seed=4).state_hash == carom.Simulation(gas.set({"run.seed": 4})).state_hash
    assert carom.Simulation(gas, seed=4).state_hash != carom.Simulation(gas).state_hash


def test_progress_is_a_fraction_that_grows(gas: carom.Scene) -> None:
    seen: list[float] = []
    carom.Simulation(gas.set({"disks.0.count": 30, "disks.0.radius": 0.3})).run_until(30_000.0, progress=seen.append)
    assert seen and seen == sorted(seen) and 0.0 <= seen[0] and seen[-1] <= 1.0


@pytest.mark.parametrize("name", ["box", "gas"])
def test_no_instruction_set_changes_a_bit(name: str) -> None:
    code = f"""
import carom
sim = carom.Simulation(carom.Scene.preset({name!r}))
frames = sim.sample(0.5, until=3.0)
print(carom.build()["instructions"], frames.state_hash, hash(frames.positions.tobytes()))
"""
    told = [
        subprocess.run(
            [sys.executable, "-c", code],
            capture_output=True,
            text=True,
            env={**os.environ, "CAROM_INSTRUCTIONS": instructions, "PYTHONHASHSEED": "0"},
        ).stdout.split()
        for instructions in ("portable", "avx2", "avx512")
    ]
    assert told[0][0] == "portable"
    assert told[0][1:] == told[1][1:] == told[2][1:] != []
