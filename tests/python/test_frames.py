"""Frames and states: what they hold, and what becomes of them."""

from __future__ import annotations

import copy
import gc
import pickle
import weakref
from pathlib import Path
from typing import Any

import matplotlib
import matplotlib.pyplot as plt
import numpy as np
import numpy.typing as npt
import PIL.Image
import pytest
from conftest import GAS, ROOT

import carom

matplotlib.use("agg")


def test_a_grid_is_k_dt_with_its_end(gas: carom.Scene) -> None:
    frames = carom.Simulation(gas).sample(0.1, until=0.7)
    assert frames.time.tolist() == [k * 0.1 for k in range(8)]  # 7 * 0.1 is beyond 0.7 by its rounding
    assert frames.positions.shape == frames.velocities.shape == frames.images.shape == (8, 12, 2)
    assert frames.images.dtype == np.int64 and frames.collisions.dtype == np.uint64
    assert frames.spins.shape == (8, 0)
    assert frames.scale.tolist() == [1.0] * 8


def test_sampling_goes_on_where_the_last_one_ended(gas: carom.Scene) -> None:
    whole = carom.Simulation(gas).sample(0.25, until=5.0)
    sim = carom.Simulation(gas)
    parts = [sim.sample(0.25, until=until) for until in (1.1, 3.0, 5.0)]
    assert [len(part) for part in parts] == [5, 8, 9]
    assert parts[1][-1] == parts[2][0]  # where it stands is a sample of both
    assert np.array_equal(np.concatenate([part.positions for part in parts[:2]] + [parts[2].positions[1:]]), whole.positions)
    assert parts[-1].state_hash == whole.state_hash == sim.state_hash
    assert sim.trajectory is parts[-1]
    assert sim.sample(0.25, until=5.1).time.tolist() == [5.0]
    assert len(sim.sample(0.25, until=5.2)) == 0


def test_frames_one_by_one_are_those_of_sample(gas: carom.Scene) -> None:
    frames = carom.Simulation(gas).sample(0.25, until=5.0)
    one_by_one = list(carom.Simulation(gas).frames(0.25, until=5.0))
    assert len(frames) == len(one_by_one) == 21
    for k, state in enumerate(one_by_one):
        assert state == frames[k]
        assert state.time == frames.time[k]
    assert frames[-1] == frames[20]
    assert [state.time for state in frames] == frames.time.tolist()


@pytest.mark.parametrize(
    "tables",
    [{"shear": {"rate": 0.3}}, {"box": GAS["box"] | {"boundary": "walls"}, "walls": {"left": {"velocity": 0.1}, "top": {"velocity": -0.05}}}],
    ids=["images that slide", "walls that move"],
)
def test_a_frame_knows_where_images_and_walls_are(tables: dict[str, object]) -> None:
    scene = carom.Scene(GAS | tables).set({"run.time": 2.0})
    sim = carom.Simulation(scene)
    sampled = sim.sample(0.25, until=2.0)
    one_by_one = list(carom.Simulation(scene).frames(0.25, until=2.0))
    kept = carom.run(scene, frames=True).frames
    assert kept is not None
    of_state = carom.voronoi(scene, sim.state)["area"]
    assert of_state.sum() == pytest.approx(24.0 if "shear" in tables else (6.0 - 0.2) * (4.0 - 0.1))
    go_on = carom.Simulation(scene, state=sim.state)
    go_on.run_until(1.0)
    for state in (sampled[-1], one_by_one[-1], kept[-1]):
        assert state.walls == sim.state.walls
        assert carom.voronoi(scene, state)["area"] == pytest.approx(of_state, rel=1e-12)
        again = carom.Simulation(scene, state=state)
        again.run_until(1.0)
        assert again.state_hash == go_on.state_hash
    assert carom.voronoi(scene, sampled[3])["area"].sum() == pytest.approx(24.0 if "shear" in tables else (6.0 - 0.075) * (4.0 - 0.0375))


def test_stride_keeps_every_so_manieth_sample(gas: carom.Scene) -> None:
    frames = carom.Simulation(gas).sample(0.25, until=5.0)
    third = carom.Simulation(gas).sample(0.25, until=5.0, stride=3)
    assert np.array_equal(third.time, frames.time[::3])
    assert np.array_equal(third.positions, frames.positions[::3])
    assert [state.time for state in carom.Simulation(gas).frames(0.25, until=5.0, stride=3)] == third.time.tolist()


def test_what_is_not_asked_for_is_not_kept(gas: carom.Scene) -> None:
    all_of_it = carom.Simulation(gas).sample(0.25, until=3.0)
    velocities = carom.Simulation(gas).sample(0.25, until=3.0, positions=False)
    positions = carom.Simulation(gas).sample(0.25, until=3.0, velocities=False)
    for absent in (lambda: velocities.positions, lambda: velocities.images, lambda: velocities.unwrapped, lambda: velocities[0]):
        with pytest.raises(ValueError, match="these frames have no positions; sample with positions=True"):
            absent()
    with pytest.raises(ValueError, match="these frames have no velocities; sample with velocities=True"):
        positions.velocities
    assert np.array_equal(velocities.velocities, all_of_it.velocities)
    assert np.array_equal(positions.positions, all_of_it.positions)
    assert np.array_equal(velocities.virial, all_of_it.virial)
    with pytest.raises(ValueError, match="these frames have no positions"):
        velocities[0]


def test_virial_and_collisions_are_those_of_the_events(gas: carom.Scene) -> None:
    frames = carom.Simulation(gas).sample(0.5, until=4.0)
    sim = carom.Simulation(gas)
    for k, time in enumerate(frames.time):
        sim.run_until(time)
        assert frames.collisions[k] == sim.collisions
        assert frames.virial[k] == sim.totals["virial"]


def test_unwrapped_positions_have_no_jumps(gas: carom.Scene) -> None:
    frames = carom.Simulation(gas).sample(0.05, until=10.0)
    fastest = np.hypot(*np.moveaxis(frames.velocities, 2, 0)).max()
    assert np.abs(np.diff(frames.positions, axis=0)).max() > 2.0
    assert np.abs(np.diff(frames.unwrapped, axis=0)).max() < 0.1 * fastest
    assert frames.unwrapped[-1] - frames.positions[-1] == pytest.approx(frames.images[-1] * [6.0, 4.0], abs=1e-12)


def test_disks_that_grow_have_a_scale() -> None:
    sim = carom.Simulation(carom.Scene.load(ROOT / "docs/scenes/growth.toml"))
    frames = sim.sample(0.5, until=5.0)
    assert np.all(np.diff(frames.scale) > 0)
    assert sim.state.scale == frames.scale[-1] > frames.scale[0]


def test_a_state_of_arrays() -> None:
    state = carom.State([[1, 2], [3, 3]], velocities=[[0.5, 0], [0, 1]], images=[[1, 0], [-2, 3]], time=4.0)
    assert (state.count, state.time, state.scale) == (2, 4.0, 1.0)
    assert state.positions.tolist() == [[1, 2], [3, 3]] and state.images.tolist() == [[1, 0], [-2, 3]]
    assert carom.State([[1, 2]]).velocities.tolist() == [[0, 0]]
    for again in (pickle.loads(pickle.dumps(state)), copy.deepcopy(state)):
        assert again == state and hash(again) == hash(state)
        assert again.images.tolist() == state.images.tolist() and again.time == 4.0
    assert state != carom.State([[1, 2], [3, 3]]) and state != 1
    with pytest.raises(ValueError, match="time is nan; give a finite number"):
        carom.State([[1, 2]], time=np.nan)


def test_arrays_outlive_what_they_came_from(gas: carom.Scene) -> None:
    gc_threshold = gc.get_threshold()
    gc.set_threshold(1)
    try:
        sim = carom.Simulation(gas)
        sim.run_until(1.0)
        expected = [np.array(array) for array in (sim.positions, sim.velocities, sim.images, sim.radii)]
        kept = [sim.positions, sim.velocities, sim.images, sim.radii, sim.record(until=2.0), sim.sample(0.5, until=4.0).positions]
        record, positions = kept[4].copy(), kept[5].copy()
        sim.run_until(5.0)
        gone = weakref.ref(sim)
        del sim
        gc.collect()
        assert gone() is None
        trash = [np.full(10_000, np.nan) for _ in range(50)]
        assert all(np.array_equal(array, as_it_was) for array, as_it_was in zip(kept, expected))
        assert np.array_equal(kept[4], record) and np.array_equal(kept[5], positions)
        del trash
    finally:
        gc.set_threshold(*gc_threshold)


def test_an_array_is_kept_until_the_clock_moves(gas: carom.Scene) -> None:
    sim = carom.Simulation(gas)
    assert sim.positions.ctypes.data == sim.positions.ctypes.data
    before = sim.positions
    copied = before.copy()
    sim.run_until(1.0)
    assert np.array_equal(before, copied) and not np.array_equal(sim.positions, before)


def test_frames_in_files_and_other_packages(gas: carom.Scene, tmp_path: Path) -> None:
    xarray = pytest.importorskip("xarray")
    frames = carom.Simulation(gas).sample(0.5, until=3.0)
    frames.save(tmp_path / "frames.npz")
    with np.load(tmp_path / "frames.npz") as file:
        assert np.array_equal(file["positions"], frames.positions) and np.array_equal(file["time"], frames.time)
        assert carom.Scene.parse(str(file["scene"])) == frames.scene
        assert str(file["state_hash"]) == frames.state_hash
    with pytest.raises(carom.OutputError, match="cannot write the frames"):
        frames.save(tmp_path / "nowhere" / "frames.npz")
    data = frames.to_xarray()
    assert isinstance(data, xarray.Dataset)
    assert np.array_equal(data["positions"].sel(time=1.5, axis="y"), frames.positions[3, :, 1])
    again = pickle.loads(pickle.dumps(frames))
    assert np.array_equal(again.positions, frames.positions) and again.scene == frames.scene


@pytest.mark.filterwarnings("ignore:Animation was deleted")
def test_animations_show_the_frames(gas: carom.Scene, tmp_path: Path) -> None:
    frames = carom.Simulation(gas).sample(0.25, until=2.0)
    for color, trail in (("speed", 3), ("species", 0), ("tab:red", 0)):
        animation = frames.animate(every=2, color=color, trail=trail)
        animation.save(tmp_path / "frames.gif", writer="pillow", dpi=40)
        assert PIL.Image.open(tmp_path / "frames.gif").n_frames == 5
    sim = carom.Simulation(gas)
    sim.animate(dt=0.25, frames=4).save(tmp_path / "live.gif", writer="pillow", dpi=40)
    assert sim.time == 0.75
    assert PIL.Image.open(tmp_path / "live.gif").n_frames == 4
    plt.close("all")


@pytest.mark.filterwarnings("ignore:Animation was deleted")
def test_an_animation_draws_disks_where_they_are(gas: carom.Scene) -> None:
    frames = carom.Simulation(gas).sample(0.25, until=2.0)
    animation = frames.animate(every=4)
    shown = [list(animation._func(k))[1] for k in animation.new_frame_seq()]
    assert np.array_equal(shown[-1].get_offsets()[:12], frames.positions[8])
    animation._init_draw()
    plt.close("all")


@pytest.mark.filterwarnings("ignore:Animation was deleted")
@pytest.mark.parametrize("preset", ["gas", "shear"])
def test_an_animation_draws_disks_that_stick_out_of_a_periodic_edge_on_the_other_side_too(preset: str) -> None:
    sim = carom.Simulation(carom.Scene.preset(preset))
    lower, upper = np.array(sim.scene.box).T
    disks = list(sim.animate(dt=1.3)._func(3))[1]
    places, radius = np.asarray(disks.get_offsets()), sim.radii[0]
    sticking_out = (sim.positions < lower + radius) | (sim.positions > upper - radius)
    assert len(places) >= sim.count + sticking_out.sum() and sticking_out.any(axis=0).all()
    assert len(disks.get_array()) == len(places)
    distances = np.hypot(*(places[:, None] - places[None]).T)[np.triu_indices(len(places), 1)]
    assert distances.min() > 2 * radius * (1 - 1e-9), "an image is where it would overlap a disk"
    plt.close("all")


def drawn_shapes(artists: tuple[Any, ...]) -> tuple[list[npt.NDArray[Any]], npt.NDArray[Any]]:
    """The lines and the centres of fixed disks in what an animation has drawn."""
    *_, lines, posts = artists
    return [np.asarray(line) for line in lines.get_segments()], np.asarray(posts.get_offsets())


@pytest.mark.filterwarnings("ignore:Animation was deleted")
def test_an_animation_draws_the_obstacles_of_the_scene() -> None:
    for preset in ("sinai", "galton", "stadium", "mushroom", "lorentz"):
        sim = carom.Simulation(carom.Scene.preset(preset))
        obstacles = sim.scene.to_dict()["obstacles"]
        for animation in (sim.animate(dt=0.05), sim.sample(0.05, 0.2).animate()):
            lines, posts = drawn_shapes(animation._func(0))
            segments = [line for line in lines if len(line) == 2]
            arcs = [line for line in lines if len(line) > 2]
            ends = [[o["segment"]["from"], o["segment"]["to"]] for o in obstacles if "segment" in o]
            assert [line.tolist() for line in segments] == ends
            for line, arc in zip(arcs, [o["arc"] for o in obstacles if "arc" in o], strict=True):
                assert np.hypot(*(line - arc["centre"]).T) == pytest.approx(arc["radius"])
            centres = [o["disk"]["centre"] for o in obstacles if "disk" in o]
            assert posts[: len(centres)].tolist() == centres
            assert (len(posts) > len(centres)) == (preset == "lorentz"), "a fixed disk that sticks out is on the other side too"
    plt.close("all")


@pytest.mark.filterwarnings("ignore:Animation was deleted")
def test_an_animation_follows_obstacles_that_come_and_go() -> None:
    door = {"segment": {"from": [3.0, 0.0], "to": [3.0, 4.0]}}
    changes = [{"time": 1.0, "add_obstacle": door}, {"time": 2.0, "set": ["obstacles.0.segment.to=[3.0, 2.0]"]}, {"time": 3.0, "remove_obstacle": 0}]
    disks = {"radius": 0.1, "mass": 1, "positions": [[1.0, 1.0], [5.0, 1.0]], "velocities": [[0.0, 0.5], [0.0, 0.5]]}
    scene = carom.Scene({**GAS, "box": {**GAS["box"], "boundary": "walls"}, "disks": disks, "changes": changes})
    ends = [None, None, 4.0, 2.0, None]  # of the door at 0, 1, 2, 3 and 4: a change is made after what happens at its time
    live, frames = carom.Simulation(scene).animate(dt=1.0), carom.Simulation(scene).sample(1.0, 4.0).animate()
    for animation in (live, frames):
        drawn = [drawn_shapes(animation._func(k))[0] for k in range(5)]
        assert [lines[0][1, 1] if lines else None for lines in drawn] == ends
    sim = carom.Simulation(scene.set({"changes": []}))
    steered = sim.animate(dt=1.0)
    assert drawn_shapes(steered._func(0))[0] == []
    sim.set("obstacles", [door])
    assert len(drawn_shapes(steered._func(1))[0]) == 1
    plt.close("all")


def test_frames_that_cannot_fit_are_refused_before_anything_runs(gas: carom.Scene) -> None:
    sim = carom.Simulation(gas)
    with pytest.raises(MemoryError, match="frames of 12 disks take"):
        sim.sample(1e-9, until=1e6)
    assert sim.time == 0.0


def test_a_box_without_periodic_axes_has_images_of_zero() -> None:
    frames = carom.Simulation({**GAS, "box": {**GAS["box"], "boundary": "walls"}}).sample(0.5, until=2.0)
    assert frames.images.shape == frames.positions.shape and not frames.images.any()
    assert frames.unwrapped is frames.positions


@pytest.mark.parametrize("part", [slice(None), slice(2, -1, 2), slice(None, None, -3), slice(5, 2)], ids=str)
def test_a_slice_of_frames_has_the_frames_of_it(gas: carom.Scene, part: slice) -> None:
    frames = carom.Simulation(gas).sample(0.25, until=3.0)
    some = frames[part]
    assert list(some) == [frames[k] for k in range(len(frames))[part]]
    assert some.time.tolist() == frames.time[part].tolist() and some.collisions.tolist() == frames.collisions[part].tolist()
    assert np.array_equal(some.unwrapped, frames.unwrapped[part]) and some.to_xarray().sizes["time"] == len(some)


def test_a_simulation_has_a_trajectory_when_it_was_sampled(gas: carom.Scene) -> None:
    sim = carom.Simulation(gas)
    with pytest.raises(ValueError, match="this simulation has no trajectory yet; sample"):
        sim.trajectory
    assert sim.sample(0.5, until=1.0) is sim.trajectory


def test_a_time_before_the_start_has_no_frames(gas: carom.Scene) -> None:
    sim = carom.Simulation(gas)
    assert len(sim.sample(0.1, until=-1.0)) == len(list(sim.frames(0.1, until=-1.0))) == 0
    assert sim.play(-1.0).exact and sim.time == 0.0


def test_frames_of_a_change_have_the_scene_of_the_first():
    places = np.stack(np.meshgrid(*[np.arange(5) * 2 + 1.0] * 2), -1).reshape(-1, 2)
    disks = {"radius": 0.5, "mass": 1, "positions": places, "velocities": np.random.default_rng(0).normal(size=places.shape)}
    parts = {"disks": disks, "collision": {"rule": "specular"}, "run": {"time": 12.0}}
    box = {"x": (0, 10), "y": (0, 10)}
    moving = carom.Scene(
        box={**box, "boundary": "walls"}, walls={"right": {"velocity": 0.3}}, changes=[{"time": 4.5, "set": ["walls.right.velocity=0"]}], **parts
    )
    frames = carom.Simulation(moving).sample(1.0, 9.0)
    assert frames.scene.box[0] == (0.0, 10.0)
    areas = [carom.voronoi(frames.scene, frames[k])["area"].sum() for k in range(len(frames))]
    assert areas == pytest.approx([10.0 * (10.0 + 0.3 * min(time, 4.5)) for time in frames.time], rel=1e-9)
    growing = carom.Scene(box={**box, "boundary": "periodic"}, growth={"rate": 0.05}, changes=[{"time": 4.5, "set": ["growth.rate=0"]}], **parts)
    frames = carom.Simulation(growing).sample(1.0, 9.0)
    assert carom.Simulation(frames.scene, state=frames[0]).radii[0] == frames.radii[0] == 0.5
    sim, times = carom.Simulation(growing), []
    for state in sim.frames(1.0, 9.0):
        times.append(state.time)
        if state.time == 2.0:
            sim.run_until(4.7)
    assert times == [0.0, 1.0, 2.0, 5.0, 6.0, 7.0, 8.0, 9.0]
