"""Scenes from files, text, values of Python and arrays are the same scenes."""

from __future__ import annotations

import copy
import pickle
import subprocess
import sys
import tomllib
from pathlib import Path

import numpy as np
import pytest
from conftest import GAS, ROOT

import carom

SCENES = sorted((ROOT / "docs/scenes").glob("*.toml"))


@pytest.mark.parametrize("path", SCENES, ids=lambda path: path.stem)
def test_a_file_its_text_and_its_mapping_are_one_scene(path: Path) -> None:
    loaded = carom.Scene.load(path)
    assert carom.Scene.parse(path.read_text(), directory=path.parent) == loaded
    assert carom.Scene.parse(loaded.toml) == loaded
    assert hash(carom.Scene.parse(loaded.toml)) == hash(loaded)
    given = tomllib.loads(path.read_text())
    if "file" not in str(given):  # a mapping does not say in which directory its files are
        assert carom.Scene(given) == loaded
    assert carom.Scene(loaded.to_dict()) == loaded
    assert loaded.to_dict() == tomllib.loads(loaded.toml)


def test_presets_are_scenes() -> None:
    assert carom.presets()[0] == "box"
    for name in carom.presets():
        assert carom.Scene.preset(name).count >= 1
    assert carom.Scene.preset("box").title == "Disks in a square box"


def test_keywords_and_a_mapping_are_one_table() -> None:
    assert carom.Scene(**GAS) == carom.Scene(GAS)
    assert carom.Scene(GAS, run={"time": 1.0}).to_dict()["run"]["time"] == 1.0
    assert carom.Scene(GAS, observe=None) == carom.Scene(GAS)
    assert carom.Scene(GAS, disks=[GAS["disks"]]) == carom.Scene(GAS)


def test_values_of_numpy_count_as_those_of_python() -> None:
    places = np.array([[0.0, 0.0], [1.0 / 3.0, 0.7]])
    disks = {"radius": np.float64(0.25), "mass": np.int64(2), "positions": places, "velocities": np.zeros((2, 2))}
    scene = carom.Scene(GAS, box={"x": np.array([-1.0, 1.0]), "y": range(-1, 2, 2), "boundary": "walls"}, disks=disks)
    assert scene.count == 2
    assert carom.Simulation(scene).positions.tolist() == [[0.0, 0.0], [1.0 / 3.0, 0.7]]
    assert scene.box == ((-1.0, 1.0), (-1.0, 1.0)) and scene.periodic == (False, False)


@pytest.mark.parametrize("value", [0.1, 1e-300, 1.7976931348623157e308, -0.0, 5e-324, 2.0**53, 1.0 / 3.0])
def test_numbers_keep_their_bits_as_text(value: float) -> None:
    from carom._toml import value_text

    assert tomllib.loads(f"x = {value_text(value)}")["x"].hex() == value.hex()


@pytest.mark.parametrize("text", ["", 'a"b', "back\\slash", "tab\tline\nreturn\r", "\x7f\x00\x1f", "ß€😀"])
def test_strings_keep_their_characters(text: str) -> None:
    from carom._toml import scene_text

    assert tomllib.loads(scene_text({"title": text, text or "key": {text or "key": [text]}}))["title"] == text


def test_set_has_the_grammar_of_the_program(gas: carom.Scene) -> None:
    boundary = {"x": "walls", "y": "periodic"}
    changed = gas.set({"run.time": 2, "disks.0.radius": 0.05, "box.boundary": boundary, "gravity.acceleration": (1, 0)})
    assert changed.to_dict()["run"]["time"] == 2.0
    assert changed.to_dict()["disks"][0]["radius"] == 0.05
    assert changed.periodic == (False, True)
    assert gas.periodic == (True, True) and "gravity" not in gas.to_dict()  # the scene itself is as before
    run = changed.set({"run.time": 3}).set({"run.seed": 8}).to_dict()["run"]
    assert run == {**changed.to_dict()["run"], "time": 3.0, "seed": 8}


def test_with_disks_takes_all_bits_of_arrays(gas: carom.Scene) -> None:
    places = np.stack(np.meshgrid(np.arange(3) * 1.1 + 1.0 / 3.0, [0.7, 2.0]), -1).reshape(-1, 2)
    velocities = np.random.default_rng(1).normal(size=(6, 2))
    radii, masses = np.linspace(0.1, 0.4, 6), np.arange(1.0, 7.0)
    scene = gas.with_disks(places, velocities, radii, masses)
    sim = carom.Simulation(scene)
    assert scene.count == 6
    assert np.array_equal(sim.positions, places) and np.array_equal(sim.velocities, velocities)
    assert np.array_equal(sim.radii, radii) and np.array_equal(sim.masses, masses)
    assert sim.sample(0.1, until=5.0).radii.tolist() == radii.tolist()
    for again in (pickle.loads(pickle.dumps(scene)), carom.Scene.parse(scene.toml), carom.Scene(scene.to_dict())):
        assert again == scene
        twin = carom.Simulation(again)
        twin.run_until(5.0)
        assert twin.state_hash == sim.state_hash


@pytest.mark.parametrize(
    "array",
    [
        np.arange(12.0).reshape(6, 2).astype(np.float32),
        np.asfortranarray(np.arange(12.0).reshape(6, 2)),
        np.arange(24.0).reshape(6, 4)[:, ::2] / 2,
        np.arange(12).reshape(6, 2),
        np.arange(12.0).reshape(6, 2)[::-1][::-1],
        np.arange(12.0).reshape(6, 2).tolist(),
    ],
    ids=["float32", "fortran", "strided", "integers", "negative strides", "lists"],
)
def test_arrays_of_any_layout_are_taken(gas: carom.Scene, array: object) -> None:
    wide = gas.set({"box.x": (-1.0, 20.0), "box.y": (-1.0, 20.0)})
    assert wide.with_disks(array).to_dict()["disks"][0]["positions"] == np.arange(12.0).reshape(6, 2).tolist()


def test_disks_of_arrays_and_changes_go_together(gas: carom.Scene) -> None:
    places = [[0.5, 0.5], [2.0, 2.0]]
    scene = gas.with_disks(places).set({"run.time": 7.0})
    assert scene.count == 2 and scene.to_dict()["run"]["time"] == 7.0
    assert carom.Simulation(scene).positions.tolist() == places
    assert carom.Scene.parse(scene.toml) == scene == pickle.loads(pickle.dumps(scene))


def test_scenes_copy_and_pickle(gas: carom.Scene) -> None:
    for protocol in range(pickle.HIGHEST_PROTOCOL + 1):
        assert pickle.loads(pickle.dumps(gas, protocol)) == gas
    assert copy.deepcopy(gas) == copy.copy(gas) == gas
    assert gas != gas.set({"run.seed": 99}) and gas != "a scene"
    assert len({gas, copy.copy(gas), gas.set({"run.seed": 99})}) == 2


def test_check_says_what_the_program_says(program) -> None:
    path = ROOT / "docs/scenes/box.toml"
    told = program("check", path)
    assert told.returncode == 0, told.stderr
    check = carom.Scene.load(path).check()
    said = " ".join(told.stdout.split())
    for _, words in check.what:
        assert " ".join(words.split()) in said
    assert check.engine in carom.engines() and check.engine in said
    assert check.cost in str(check)


def test_import_brings_nothing_but_numpy() -> None:
    heavy = "h5py", "matplotlib", "pandas", "xarray", "tqdm", "MDAnalysis", "IPython", "concurrent.futures", "multiprocessing"
    heavy += "carom._files", "carom.runs", "carom.stored_runs", "carom.sweeps"
    code = f"""
import signal, sys, threading
def handlers():
    return [signal.getsignal(s) for s in signal.valid_signals()]
began = handlers()
import numpy
before = set(sys.modules)
import carom
print([m for m in {heavy} if m in sys.modules and m not in before], threading.active_count(), began == handlers())
"""
    told = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=60)
    assert (told.stdout, told.stderr) == ("[] 1 True\n", "")


def test_version_is_that_of_the_program(program) -> None:
    assert carom.__version__ == carom.build()["version"]
    assert carom.__version__ in program("--version").stdout


def test_a_box_may_be_a_circle() -> None:
    scene = carom.Scene(
        box={"circle": {"centre": [1.0, 2.0], "radius": 3.0}},
        disks={"count": 5, "radius": 0.25, "mass": 1.0, "positions": "random", "velocities": {"temperature": 1.0}},
        collision={"rule": "specular"},
        obstacles={"arc": {"centre": [1.0, 2.0], "radius": 1.0, "from": 0, "to": 180}},
        run={"time": 1.0},
    )
    assert scene.circle == ((1.0, 2.0), 3.0) and scene.box == ((-2.0, 4.0), (-1.0, 5.0))
    assert scene.packing_fraction == pytest.approx(5 * 0.25**2 / 9)
    simulation = carom.Simulation(scene)
    simulation.run_until(20.0)
    assert simulation.totals["circle_impulse"] > 0
    simulation.set("gravity.acceleration", (0.0, -1.0))
    simulation.run_until(40.0)
    assert (((simulation.positions - [1.0, 2.0]) ** 2).sum(axis=1) < 2.75**2 * (1 + 1e-9)).all()


def test_what_is_wrong_in_a_start_file_has_its_line(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    Path("start.csv").write_text("x,y\n1,abc\n")
    tables = {**GAS, "disks": {"radius": 0.4, "mass": 1.0, "positions": {"file": "start.csv"}, "velocities": {"temperature": 1.0}}}
    Path("gas.toml").write_text(carom.Scene(GAS).toml)
    file = tmp_path / "start.csv"
    for scene in (lambda: carom.Scene(tables), lambda: carom.Scene.load("gas.toml").set({"disks.0": tables["disks"]})):
        with pytest.raises(carom.SceneError, match=r'start.csv:2:3: y is "abc"; it must be a finite number') as raised:
            scene()
        error = raised.value
        assert (Path(error.source).resolve(), error.line, error.column) == (file.resolve(), 2, 3) and error.sentence.startswith("y is")
    with pytest.raises(carom.SceneError, match=r"start.csv:2:3: the scene of the point .* is refused: y is") as raised:
        carom.sweep(carom.Scene(GAS), [{"disks.0": tables["disks"]}])
    assert raised.value.line == 2
    for wrong in ({"run.tim": 1.0}, {"disks.0.radius": 3.0}, {"disks.0": {**tables["disks"], "positions": {"file": "none.csv"}}}):
        with pytest.raises(carom.SceneError) as raised:
            carom.Scene.load("gas.toml").set(wrong)
        assert (raised.value.source, raised.value.line) == ("", 0)
