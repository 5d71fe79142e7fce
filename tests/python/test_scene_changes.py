"""What Python knows of a simulation whose scene changes while it runs."""

from __future__ import annotations

import pickle
from pathlib import Path

import numpy as np
import pytest
from conftest import GAS

import carom


def changing(tables: dict[str, object], change: str) -> carom.Scene:
    """The gas with these tables, until `change` is made at time 1."""
    return carom.Scene(GAS | tables | {"changes": [{"time": 1.0, "set": [change]}]}).set({"run.time": 2.0})


def test_radii_are_those_of_the_engine_when_disks_no_longer_grow() -> None:
    sim = carom.Simulation(changing({"growth": {"rate": 0.1}}, "growth.rate=0"))
    assert sim.radii[0] == 0.4
    sim.run_until(2.0)
    assert sim.radii[0] * sim.state.scale == pytest.approx(0.44, rel=1e-12)


def test_radii_of_frames_and_files_are_those_at_each_time(tmp_path: Path) -> None:
    scene = changing({"growth": {"rate": 0.1}}, "growth.rate=0").set({"run.sample_every": 0.5})
    expected = [1.0, 1.05, 1.1, 1.1, 1.1]
    sampled = carom.Simulation(scene).sample(0.5, 2.0)
    result = carom.run(scene, frames=True, out=tmp_path / "run")
    assert result.frames is not None
    for frames in (sampled, result.frames):
        assert frames.radii[0] == 0.4
        assert frames.scale == pytest.approx(expected, rel=1e-12)
    assert [state.scale for state in carom.Simulation(scene).frames(0.5, 2.0)][3:] == [1.0, 1.0]  # of what are radii then
    run = carom.open_run(tmp_path / "run")
    assert [run.state(k).scale for k in range(5)] == pytest.approx(expected, rel=1e-12)
    assert run.summary["growth"]["scale"] == pytest.approx(1.1, rel=1e-12)
    whole = 12 * np.pi * 0.44**2 / 24.0
    assert run.summary["growth"]["packing_fraction"] == pytest.approx(whole, rel=1e-12)


@pytest.mark.parametrize("go_on", [lambda sim: list(sim.events(2.0)), lambda sim: sim.run_until(2.0)])
def test_the_scene_is_the_one_that_acts(go_on) -> None:
    sim = carom.Simulation(changing({}, "collision.restitution=0.5"))
    assert "restitution" not in sim.scene.to_dict()["collision"]
    go_on(sim)
    assert sim.scene.to_dict()["collision"]["restitution"] == 0.5


@pytest.mark.parametrize(("before", "change", "spinning"), [(0.5, "collision.roughness=-1", [1, 2, 3, 4]), (None, "collision.roughness=0.5", [3, 4])])
def test_spins_begin_with_roughness_and_stay(before: float | None, change: str, spinning: list[int]) -> None:
    rough = {} if before is None else {"collision": {"rule": "specular", "roughness": before}}
    scene = changing(rough, change)
    frames = carom.Simulation(scene).sample(0.5, 2.0)
    assert frames.spins.shape == (5, 12)
    assert list(np.flatnonzero(np.any(frames.spins != 0.0, axis=1))) == spinning
    kept = carom.run(scene.set({"run.sample_every": 0.5}), frames=True).frames
    assert np.array_equal(kept.spins, frames.spins)


@pytest.mark.parametrize(("tables", "change"), [({}, "collision.roughness=0.5"), ({"growth": {"rate": 0.05}}, "growth.rate=0")])
def test_a_run_in_which_the_engine_changed_verifies(tables: dict[str, object], change: str, tmp_path: Path) -> None:
    carom.run(changing(tables, change), out=tmp_path / "run")
    run = carom.open_run(tmp_path / "run")
    assert run.summary["engine_asked"] == "auto"
    assert run.verify() == []


DENSE = {
    "box": {"x": (0.0, 12.0), "y": (0.0, 12.0), "boundary": "periodic"},
    "disks": {"count": 100, "radius": 0.4, "mass": 1.0, "positions": "random", "velocities": {"temperature": 1.0}},
    "growth": {"rate": 0.3},
}


def grows_beyond_random_placement() -> carom.Simulation:
    sim = carom.Simulation(changing(DENSE, "growth.rate=0"))
    sim.run_until(1.5)
    assert sim.scene.packing_fraction == pytest.approx(100 * np.pi * 0.52**2 / 144.0, rel=1e-12)  # 0.59; random ends at 0.547
    return sim


def moved_by_a_wall() -> carom.Simulation:
    walls = {"box": DENSE["box"] | {"boundary": "walls"}, "walls": {"right": {"velocity": -0.5}}, "growth": {"rate": 0.0}}
    sim = carom.Simulation(changing(DENSE | walls, "walls.right.velocity=0"))
    sim.run_until(1.5)
    assert sim.scene.box[0][1] == pytest.approx(11.5, rel=1e-12)
    return sim


@pytest.mark.parametrize("begin", [grows_beyond_random_placement, moved_by_a_wall])
def test_the_scene_of_now_is_one_to_begin_with(begin) -> None:
    sim = begin()
    assert np.array_equal(carom.Simulation(sim.scene, state=sim.state).positions, sim.positions)
    assert carom.voronoi(sim.scene, sim.state)["area"].sum() == pytest.approx(np.prod(np.diff(sim.scene.box)), rel=1e-12)
    assert carom.clusters(sim.scene, sim.state, gap=0.1).rows == 100
    assert pickle.loads(pickle.dumps(sim.scene)) == sim.scene
    assert carom.Simulation(sim.scene.set({"run.time": 3.0})).run_until(1.0) == carom.Stop.TIME


@pytest.mark.parametrize("change", ["growth.rate=0", "growth.rate=0.1"])
def test_a_box_without_disks_runs(change: str) -> None:
    scene = changing({"growth": {"rate": 0.1}}, change).set({"disks.0.count": 0, "run.sample_every": 0.5})
    frames = carom.run(scene, frames=True).frames
    assert frames is not None
    assert frames.positions.shape == carom.Simulation(scene).sample(0.5, 2.0).positions.shape == (5, 0, 2)


@pytest.mark.parametrize(
    ("walls", "change"),
    [
        ({"right": {"velocity": 0.5}}, "walls.right.velocity=0"),
        ({"bottom": {"vibration": {"form": "sine", "amplitude": 0.5, "frequency": 0.125}}}, "walls.bottom.vibration.amplitude=0"),
    ],
)
def test_a_wall_that_a_change_stops_stays_there_in_files_and_frames(walls, change, tmp_path: Path) -> None:
    box = {"box": DENSE["box"] | {"boundary": "walls"}, "walls": walls, "growth": {"rate": 0.0}}
    scene = changing(DENSE | box, change).set({"run.sample_every": 0.5, "disks.0.radius": 0.3})
    result = carom.run(scene, frames=True, out=tmp_path / "run")
    run = carom.open_run(tmp_path / "run")
    at_change = [position for position, _ in run.state(2).walls]
    assert at_change != [0.0, 12.0, 0.0, 12.0]
    for k in (3, 4):
        assert [position for position, _ in run.state(k).walls] == pytest.approx(at_change, rel=1e-12)
        assert [position for position, _ in result.frames[k].walls] == pytest.approx(at_change, rel=1e-12)
    (x0, x1), (y0, y1) = (at_change[:2], at_change[2:])
    covered = 100 * np.pi * 0.3**2 / ((x1 - x0) * (y1 - y0))
    assert run.summary["packing_fraction_end"] == pytest.approx(covered, rel=1e-12)
