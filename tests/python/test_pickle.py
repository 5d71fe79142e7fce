"""Pickles go on to the same bits, in this process and in others; those that are damaged are refused."""

from __future__ import annotations

import copy
import pickle
import re
import subprocess
import sys
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context
from pathlib import Path

import pytest
from conftest import ROOT

import carom

SCENES = ["box", "gas", "rough", "square_well", "piston", "growth", "shear", "thermostat", "drag", "lorentz"]


@pytest.mark.parametrize("name", SCENES)
def test_a_simulation_goes_on_to_the_same_bits(name: str) -> None:
    scene = carom.Scene.load(ROOT / f"docs/scenes/{name}.toml")
    sim = carom.Simulation(scene)
    sim.run_until(1.0)
    pickles = [pickle.dumps(sim, protocol) for protocol in range(pickle.HIGHEST_PROTOCOL + 1)]
    twins = [pickle.loads(bytes_) for bytes_ in pickles] + [copy.deepcopy(sim)]
    sim.run_until(3.0)
    for twin in twins:
        assert twin.time == 1.0 and twin.scene == scene
        twin.run_until(3.0)
        assert (twin.state_hash, twin.totals, twin.engine) == (sim.state_hash, sim.totals, sim.engine)


@pytest.mark.parametrize("engine", carom.engines())
def test_every_engine_pickles(gas: carom.Scene, engine: str) -> None:
    sim = carom.Simulation(gas, engine=engine)
    sim.run_until(2.0)
    twin = pickle.loads(pickle.dumps(sim))
    assert twin.engine == engine
    sim.run_until(4.0)
    twin.run_until(4.0)
    assert twin.state_hash == sim.state_hash


@pytest.mark.parametrize("method", carom.fixed_step_methods())
def test_every_fixed_step_pickles(gas: carom.Scene, method: str) -> None:
    sim = carom.Simulation(gas, method=method, dt=0.01)
    sim.run_until(2.003)
    twin = pickle.loads(pickle.dumps(sim))
    assert (twin.engine, twin.dt) == (method, 0.01)
    sim.run_until(4.0)
    twin.run_until(4.0)
    assert twin.state_hash == sim.state_hash


def test_changes_in_passing_are_pickled(gas: carom.Scene) -> None:
    sim = carom.Simulation(gas)
    sim.run_until(1.0)
    sim.set("collision.restitution", 0.5)
    sim.set_velocities(2 * sim.velocities)
    twin = pickle.loads(pickle.dumps(sim))
    assert twin.scene == sim.scene != gas
    sim.run_until(3.0)
    twin.run_until(3.0)
    assert (twin.state_hash, twin.totals) == (sim.state_hash, sim.totals)


def moved_on(sim: carom.Simulation) -> carom.Simulation:
    sim.run_until(5.0)
    return sim


def test_a_scene_with_a_start_file_pickles_for_any_directory(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "sub").mkdir()
    (tmp_path / "sub/start.csv").write_text("x,y,vx,vy\n1,1,1,0\n3,3,0,1\n")
    text = """box = { x = [0, 4], y = [0, 4], boundary = "walls" }
collision = { rule = "specular" }
run = { time = 1.0 }
[[disks]]
radius = 0.5
mass = 1.0
positions = { file = "start.csv" }
"""
    (tmp_path / "sub/scene.toml").write_text(text)
    monkeypatch.chdir(tmp_path)
    loaded, parsed = carom.Scene.load("sub/scene.toml"), carom.Scene.parse(text, "sub")
    made = carom.Scene({**loaded.to_dict(), "disks": {"radius": 0.5, "mass": 1.0, "positions": {"file": "sub/start.csv"}}})
    simulation = carom.Simulation(loaded)
    simulation.run_until(0.5)
    pickles = [pickle.dumps(one) for one in (loaded, parsed, simulation, made)]
    monkeypatch.chdir("/")
    assert [pickle.loads(one).count for one in pickles] == [2, 2, 2, 2]
    assert pickle.loads(pickles[2]).state_hash == simulation.state_hash
    assert loaded.set({"run.time": 2.0}).count == 2


def test_simulations_go_to_other_processes_and_back(gas: carom.Scene) -> None:
    sims = [carom.Simulation(gas, seed=seed) for seed in (1, 2)]
    with ProcessPoolExecutor(2, mp_context=get_context("spawn")) as pool:
        back = list(pool.map(moved_on, sims))
    for sim, there in zip(sims, back):
        assert moved_on(sim).state_hash == there.state_hash


def test_a_damaged_pickle_is_refused(gas: carom.Scene) -> None:
    sim = carom.Simulation(gas)
    saved = sim._core.save()
    content = pickle.dumps(sim)
    at = content.index(saved)
    for damaged in (saved[:-1], saved[: len(saved) // 2], saved[:-9] + bytes([saved[-9] ^ 1]) + saved[-8:], b"?" * len(saved)):
        other = content[:at] + damaged.ljust(len(saved), b"\0") + content[at + len(saved) :]
        with pytest.raises((ValueError, RuntimeError), match="saved|simulation|checkpoint") as raised:
            pickle.loads(other)
        assert "\n" not in str(raised.value)


def test_a_pickle_of_another_build_is_refused_for_that(gas: carom.Scene, tmp_path: Path) -> None:
    """Whatever else of it this build does not understand, such as its scene."""
    sim = carom.Simulation(gas)
    other_version = re.sub(r"\d", "9", carom.__version__)
    foreign = f"carom {carom.__version__} (".encode(), f"carom {other_version} (".encode()
    content = pickle.dumps(sim)
    assert content.count(foreign[0]) == 1
    sentence = rf"carom {re.escape(other_version)} \(.* has saved it, and only that one can go on to the last bit; this is carom "
    for other in (content, content.replace(b"restitution", b"rustitution").replace(b"boundary", b"boundery")):
        with pytest.raises(RuntimeError, match=sentence):
            pickle.loads(other.replace(*foreign))
    sim.save(tmp_path / "kept")
    (tmp_path / "kept").write_bytes((tmp_path / "kept").read_bytes().replace(*foreign))
    with pytest.raises(carom.OutputError, match=sentence):
        carom.Simulation.load(tmp_path / "kept")


def test_a_simulation_of_another_scene_is_refused(gas: carom.Scene) -> None:
    saved = carom.Simulation(gas)._core.save()
    with pytest.raises((ValueError, RuntimeError), match="scene"):
        carom._core.Simulation.restore(gas.set({"disks.0.radius": 0.3})._core, saved)


def test_a_pickle_is_small(gas: carom.Scene) -> None:
    assert len(pickle.dumps(carom.Simulation(carom.Scene.preset("box")))) < 100_000


def test_a_pickle_opens_in_a_process_that_has_not_imported_carom(gas: carom.Scene, tmp_path: Path) -> None:
    sim = carom.Simulation(gas)
    sim.run_until(1.0)
    (tmp_path / "kept").write_bytes(pickle.dumps(sim))
    code = f"import pickle; sim = pickle.load(open({str(tmp_path / 'kept')!r}, 'rb')); sim.run_until(2.0); print(sim.state_hash)"
    told = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=60)
    sim.run_until(2.0)
    assert (told.stdout.strip(), told.stderr) == (sim.state_hash, "")
