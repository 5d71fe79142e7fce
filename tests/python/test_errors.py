"""What is wrong is said in one sentence, before anything has happened."""

from __future__ import annotations

import pickle
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from conftest import GAS, ROOT

import carom

BROKEN = sorted((ROOT / "tests/scene/broken").glob("*.toml"))
DISKS = GAS["disks"]


@pytest.mark.parametrize("path", BROKEN, ids=lambda path: path.stem)
def test_a_broken_scene_is_refused_with_its_sentence(path: Path) -> None:
    """The first line of each file says which sentence its author expects; the program's tests hold it to the same line."""
    expected = path.read_text(errors="replace").splitlines()[0].removeprefix("# expect: ")
    with pytest.raises(carom.SceneError) as raised:
        carom.Scene.load(path)
    error = raised.value
    assert str(error).replace(f"{path.parent}/", "") == expected
    assert isinstance(error, ValueError)
    assert str(error).endswith(error.sentence)
    assert error.line == 0 or f":{error.line}:{error.column}: " in expected


def test_a_scene_of_values_is_refused_without_lines_of_its_text() -> None:
    with pytest.raises(carom.SceneError) as raised:
        carom.Scene(GAS, disks={**DISKS, "radius": "big"})
    assert str(raised.value) == (
        'disks.0.radius is a string ("big"); it must be a finite number above zero, such as radius = 0.03'
    )
    assert (raised.value.source, raised.value.line, raised.value.column) == ("", 0, 0)


def test_errors_pickle(gas: carom.Scene) -> None:
    error = carom.SceneError("a sentence", "file.toml", 3, 7)
    again = pickle.loads(pickle.dumps(error))
    assert str(again) == str(error) == "file.toml:3:7: a sentence"
    assert (again.sentence, again.source, again.line, again.column) == ("a sentence", "file.toml", 3, 7)


Sim = carom.Simulation
WALLS = {"box.boundary": "walls"}
OBSTACLE = {"obstacles": [{"disk": {"centre": (5.2, 2.0), "radius": 0.4}}]}


def beginning(x: float, y: float) -> carom.State:
    """Disk 0 at some place; the eleven others stand apart from each other at x <= 3.5."""
    return carom.State([[x, y], *[[0.5 + k % 4, 0.5 + k // 4] for k in range(11)]])


MISTAKES_OF_SCENES: list[tuple[Callable[[carom.Scene], object], type[Exception], str]] = [
    (lambda s: carom.Scene(5), TypeError, "a scene is 5; give a mapping"),
    (lambda s: carom.Scene("gas.toml"), TypeError, r"give a mapping, or the path of a scene file to Scene\.load"),
    (lambda s: carom.Scene({3: 4}), TypeError, "the key 3 is no string"),
    (lambda s: carom.Scene(GAS, foo=1), carom.SceneError, 'the scene has no key "foo"; did you mean "box"'),
    (lambda s: carom.Scene(GAS, run=None), carom.SceneError, r"the scene has no \[run\] table"),
    (lambda s: carom.Scene(GAS, run={"time": 10**30}), ValueError, "run.time is 1000.* has at most 64 bits"),
    (lambda s: carom.Scene(GAS, run={"time": True}), carom.SceneError, "run.time is a boolean"),
    (lambda s: carom.Scene(GAS, title="\ud800"), ValueError, r"title is '\\ud800'"),
    (lambda s: carom.Scene(GAS, box={**GAS["box"], "x": {0, 6}}), TypeError, "box.x is {0, 6}; a scene holds"),
    (lambda s: carom.Scene(GAS, box={**GAS["box"], "x": b"ab"}), TypeError, "box.x is b'ab'; a scene holds"),
    (lambda s: carom.Scene(GAS, disks=5), carom.SceneError, "disks is an integer"),
    (lambda s: carom.Scene(GAS, disks={**DISKS, "radius": np.nan}), carom.SceneError, "disks.0.radius is a floating"),
    (lambda s: carom.Scene(GAS, disks={**DISKS, "radius": 1 + 2j}), TypeError, r"disks.0.radius is \(1\+2j\); a scene holds"),
    (lambda s: carom.Scene(GAS, disks={**DISKS, "radius": object}), TypeError, "disks.0.radius is <class 'object'>"),
    (lambda s: carom.Scene(GAS, disks={**DISKS, "positions": np.array([["a"]])}), TypeError, "disks.0.positions: an array of <U"),
    (lambda s: carom.Scene(GAS, disks={**DISKS, "positions": np.array([None])}), TypeError, "disks.0.positions: an array of obj"),
    (lambda s: carom.Scene.parse(5), TypeError, "the text is 5; give a string"),
    (lambda s: carom.Scene.load("nowhere.toml"), carom.SceneError, "nowhere.toml: there is no such file"),
    (lambda s: carom.Scene.load(5), TypeError, "path is 5; give a path"),
    (lambda s: carom.Scene.load("\udcff.toml"), ValueError, r"path is '\\udcff.toml'; half of a pair"),
    (lambda s: carom.Scene.preset("bix"), ValueError, 'there is no preset "bix"; did you mean "box"'),
    (lambda s: s.set({"run.tim": 1}), carom.SceneError, r'\[run\] has no key "tim"; did you mean "time"'),
    (lambda s: s.set({"disks.7.radius": 1}), carom.SceneError, "disks has 1 entry, numbered from 0"),
    (lambda s: s.set([1]), TypeError, r"the changes are \[1\]; give a mapping"),
    (lambda s: s.set({"run.time": None}), TypeError, "run.time is None; a scene holds"),
    (lambda s: s.with_disks(np.zeros((3, 3))), ValueError, r"positions: the array has shape \(3, 3\); give one of shape \(N, 2\)"),
    (lambda s: s.with_disks([[0, 0], [1]]), ValueError, "positions: the rows differ in length"),
    (lambda s: s.with_disks(np.array([[1, 2]], dtype=object)), TypeError, "positions: an array of object is given"),
    (lambda s: s.with_disks([[1 + 1j, 2]]), TypeError, "positions: an array of complex128"),
    (lambda s: s.with_disks([[np.nan, 0.0]]), carom.SceneError, "disks.0.positions.0.0 is a floating-point number"),
    (lambda s: s.with_disks([[1, 1], [1, 1.1]]), carom.SceneError, "disks 0 and 1 overlap by 0.7"),
    (lambda s: s.with_disks([[1, 1], [30, 3]]), carom.SceneError, "disk 1 is outside the box"),
    (lambda s: s.with_disks([[1, 1], [3, 3]], velocities=[[1, 1]]), carom.SceneError, "there are 1 velocities and 2 positions"),
    (lambda s: s.with_disks([[1, 1], [3, 3]], radii=[[0.1, 1]]), ValueError, r"radii: the array has shape \(1, 2\)"),
    (lambda s: s.with_disks([[1, 1], [3, 3]], radii=[0.1, -1]), carom.SceneError, "disks.0.radius.1 is a floating-point number"),
    (lambda s: s.with_disks([[1, 1], [3, 3]], masses=[0.1, np.inf]), carom.SceneError, "disks.0.mass.1 is a floating"),
    (lambda s: s.check(None), TypeError, "engine is None; give a string"),
    (lambda s: carom.Scene.load("x.toml", 5), TypeError, "overrides is 5; give a list of strings"),
    (lambda s: Sim(np.zeros((9, 2))), TypeError, r"^array\(\[\[0., 0.\], .*\.\.\. is no scene"),
    (lambda s: carom.sweep(s, {"run.time": [1]}, seeds=10**30), ValueError, "seeds is 1000.*; it must be from 0 to 1000000"),
    (lambda s: carom.sweep(s, {"run.time": [1]}, numbers=5), TypeError, "numbers is 5; give a list of strings"),
    (lambda s: carom.validate(only=5), TypeError, "only is 5; give a list of strings"),
    (lambda s: carom.hardcases([5]), TypeError, "names is 5; give a string"),
    (lambda s: carom.read_start("\udcff.npy"), ValueError, "half of a pair of surrogates"),
    (lambda s: carom.Table([1, 2]), TypeError, r"the columns are \[1, 2\]; give a mapping"),
    (lambda s: carom.partner_name("x"), TypeError, "the partner is 'x'; give a whole number"),
    (lambda s: s.check("fst"), ValueError, 'there is no engine "fst"; choose one of auto, fast'),
    (lambda s: Sim(5), TypeError, "5 is no scene; give a carom.Scene"),
    (lambda s: Sim(s, engine="fst"), ValueError, 'there is no engine "fst"'),
    (lambda s: Sim(s, engine=5), TypeError, "engine is 5; give a string"),
    (lambda s: Sim(s, method="naive"), ValueError, "a fixed-step method needs both"),
    (lambda s: Sim(s, method="nave", dt=0.1), ValueError, 'there is no fixed-step method "nave"; choose one of naive'),
    (lambda s: Sim(s, method="naive", dt=-1), ValueError, "the time step is -1; it must be positive"),
    (lambda s: Sim(s, method="naive", dt="a"), TypeError, "dt is 'a'; give a number"),
    (lambda s: Sim(s, stiffness=1e4), ValueError, 'a stiffness is that of the springs of method="soft"'),
    (lambda s: Sim(s, method="naive", dt=0.01, stiffness=1e4), ValueError, 'the method "naive" has no springs'),
    (lambda s: Sim(s, method="soft", dt=0.01, stiffness="a"), TypeError, "stiffness is 'a'; give a number"),
    (lambda s: Sim(s, method="naive", dt=0.1, engine="fast"), ValueError, "a fixed-step method has no engine"),
    (lambda s: Sim(s, seed=-1), carom.SceneError, r"run.seed is an integer \(-1\)"),
    (lambda s: Sim(s, state=5), TypeError, "the state is 5; give a carom.State"),
    (lambda s: Sim(s, state=carom.State([[1, 1]])), ValueError, "a state of 1 positions and 1 velocities is given for 12 disks"),
    (lambda s: Sim(s, state=carom.State(np.full((12, 2), np.nan))), ValueError, "of the given state is not finite"),
    (lambda s: Sim(s, state=carom.State(np.full((12, 2), 99.0))), ValueError, "has a position outside the box in x"),
    (lambda s: Sim(s, state=beginning(2.5, 2.8)), ValueError, r"disk 11 overlaps disk 0 by 0\.5 in the given state; put its centre at"),
    (lambda s: Sim(s.set(WALLS), state=beginning(5, 0.3)), ValueError, r"disk 0 overlaps a wall in y by 0\.1 in the given state; put"),
    (lambda s: Sim(s.set(WALLS), state=beginning(5, -1)), ValueError, "has a position outside the box in y; put it between the walls"),
    (lambda s: Sim(s.set(WALLS), state=beginning(5, 0.3), method="naive", dt=0.1), ValueError, "disk 0 overlaps a wall in y"),
    (lambda s: Sim(s.set(WALLS), state=beginning(5, -1), method="soft", dt=0.01), ValueError, "has a position outside the box in y"),
    (lambda s: Sim(s.set(OBSTACLE), state=beginning(5, 2)), ValueError, r"disk 0 overlaps obstacles\.0 by 0\.6 in the given state"),
    (lambda s: Sim(s, on_collision=5), TypeError, "the collision rule is 5; give a function"),
    (lambda s: carom.State([[1, 1]], velocities=[[1, 1], [2, 2]]), ValueError, "velocities: there are 2 rows for 1 disks"),
    (lambda s: carom.State([[1, 1]], images=[[0.5, 1]]), TypeError, "images: an array of float64 is given; give whole numbers"),
    (lambda s: carom.State([[1, 1]], spins=[1, 2]), ValueError, "spins: there are 2 for 1 disks"),
    (lambda s: carom.State([[1, 1]], time="x"), TypeError, "time is 'x'; give a number"),
]


@pytest.mark.parametrize("mistake, kind, sentence", MISTAKES_OF_SCENES)
def test_a_mistake_about_a_scene_is_told(gas: carom.Scene, mistake, kind, sentence: str) -> None:
    with pytest.raises(kind, match=sentence) as raised:
        mistake(gas)
    one_sentence(raised.value)


MISTAKES_OF_SIMULATIONS: list[tuple[Callable[[carom.Simulation], object], type[Exception], str]] = [
    (lambda sim: sim.run_until("a"), TypeError, "time is 'a'; give a number"),
    (lambda sim: sim.run_until(np.nan), ValueError, "to a finite time only"),
    (lambda sim: sim.run_until(1, collisions=2.5), TypeError, "collisions is 2.5; give a whole number"),
    (lambda sim: sim.run_until(1, collisions=-1), ValueError, "collisions is -1; it must be from 0"),
    (lambda sim: sim.run(None), TypeError, "duration is None; give a number"),
    (lambda sim: sim.step(np.nan), ValueError, "NaN is none"),
    (lambda sim: sim.record(np.inf), ValueError, "to a finite time only"),
    (lambda sim: sim.sample(0, 1), ValueError, "samples are 0 apart; that must be positive"),
    (lambda sim: sim.sample(np.nan, 1), ValueError, "samples are nan apart"),
    (lambda sim: sim.sample(0.1, np.inf), ValueError, "to a finite time only"),
    (lambda sim: sim.sample(1e-320, 1), ValueError, r"samples 9.9\d+e-321 apart until 1 would be more than 2\^53; give a larger dt"),
    (lambda sim: sim.sample(0.1, 1, stride=0), ValueError, "stride is 0; it must be from 1"),
    (lambda sim: sim.sample(1e-12, 1e3), MemoryError, r"999,000,000,000,001 frames of 12 disks take .* iterate over sim.frames"),
    (lambda sim: list(sim.frames("a", 1)), TypeError, "dt is 'a'; give a number"),
    (lambda sim: sim.set("box.x", (0, 1)), ValueError, "'box.x' does not say what acts on the disks"),
    (lambda sim: sim.set(5, 1), TypeError, "a key is 5; give a string"),
    (lambda sim: sim.set({"drag.rate": 1}, 7), TypeError, "a dict of keys has its values in it; the second argument, 7, is left over"),
    (lambda sim: sim.set("gravity.acceleration", "down"), carom.SceneError, r"^gravity.acceleration is a string \(\"down\"\)"),
    (lambda sim: sim.set("collision.rule.x", 1), ValueError, "collision.rule is 'specular', which has no keys"),
    (lambda sim: sim.set("obstacles", [{"disk": {"center": (3.0, 2.0), "radius": 0.3}}]), carom.SceneError, "did you mean"),
    (lambda sim: sim.set_velocities(np.zeros((3, 2))), ValueError, "velocities: there are 3 rows for 12 disks"),
    (lambda sim: sim.set_velocities(np.full((12, 2), np.nan)), ValueError, "is not finite"),
    (lambda sim: sim.set_velocities(np.full((12, 2), 1e300)), carom.SceneError, "^the heaviest disk .* overflows"),
    (lambda sim: sim.set_velocities(np.zeros((12, 2)), spins=np.zeros(12)), ValueError, "12 spins are given for 0 disks that spin"),
    (lambda sim: sim.set_collision_rule(5), TypeError, "the collision rule is 5; give a function"),
    (lambda sim: sim.save(5), TypeError, "path is 5; give a path"),
    (lambda sim: sim.save("/nowhere/x"), carom.OutputError, "/nowhere/x: cannot write the simulation: No such file"),
    (lambda sim: sim.set([], 1), TypeError, r"a key is \[\]; give a string"),
    (lambda sim: sim.animate(0.1, frames=0), ValueError, "frames is 0; it must be from 1"),
    (lambda sim: sim.animate(0.1, interval=[]), TypeError, r"interval is \[\]; give a number"),
    (lambda sim: sim.animate(0), ValueError, "frames are 0 apart"),
]


@pytest.mark.parametrize("mistake, kind, sentence", MISTAKES_OF_SIMULATIONS)
def test_a_mistake_about_a_simulation_is_told_and_changes_nothing(gas: carom.Scene, mistake, kind, sentence: str) -> None:
    sim, twin = carom.Simulation(gas), carom.Simulation(gas)
    sim.run_until(1.0)
    with pytest.raises(kind, match=sentence) as raised:
        mistake(sim)
    one_sentence(raised.value)
    twin.run_until(1.0)
    assert sim.state_hash == twin.state_hash
    sim.run_until(3.0)
    twin.run_until(3.0)
    assert (sim.state_hash, sim.totals) == (twin.state_hash, twin.totals)


MISTAKES_OF_RUNS: list[tuple[dict[str, object], type[Exception], str]] = [
    ({"engine": "fst"}, ValueError, 'there is no engine "fst"'),
    ({"engine": 5}, TypeError, "engine is 5; give a string"),
    ({"method": "naive", "dt": "a"}, TypeError, "dt is 'a'; give a number"),
    ({"method": "naive", "engine": "fast"}, ValueError, "a fixed-step method has no engine"),
    ({"method": "naive", "dt": 0.01, "observables": ["pressure"]}, ValueError, "observables measure exact trajectories"),
    ({"method": "nave", "dt": 0.01}, ValueError, 'there is no fixed-step method "nave"'),
    ({"dt": 0.1}, ValueError, "exact events need none"),
    ({"stiffness": 1e4}, ValueError, 'a stiffness is that of the springs of method="soft"'),
    ({"observables": 5}, TypeError, "observables are 5; give names"),
    ({"observables": [5]}, TypeError, "5 is no observable; give a name"),
    ({"observables": {"pressur": True}}, carom.SceneError, 'did you mean "pressure"'),
    ({"observables": {"pressure": {"evry": 5}}}, carom.SceneError, 'did you mean "every"'),
    ({"threads": "a"}, TypeError, "threads is 'a'; give a whole number"),
    ({"threads": 0}, ValueError, "threads is 0; it must be from 1 to 32"),
    ({"threads": 33}, ValueError, "threads is 33; it must be from 1 to 32"),
    ({"threads": 3, "engine": "textbook"}, ValueError, "threads=3: only one core can compute this run, for"),
    ({"walltime": "\ud800"}, ValueError, "half of a pair of surrogates"),
    ({"observables": "\ud800"}, ValueError, "half of a pair of surrogates"),
    ({"walltime": -1}, ValueError, "walltime is -1 s; it must be positive"),
    ({"walltime": "soon"}, ValueError, "give a length of time such as 90s"),
    ({"checkpoint_every": "1min"}, ValueError, 'give out="directory" too'),
    ({"out": 5}, TypeError, "out is 5; give a path"),
    ({"out": "/dev/null"}, carom.OutputError, "/dev/null: this is a file, and the results need a directory"),
    ({"progress": 5}, TypeError, "progress is 5; give True, False, or a function"),
]


@pytest.mark.parametrize("arguments, kind, sentence", MISTAKES_OF_RUNS)
def test_a_mistake_about_a_run_is_told(gas: carom.Scene, arguments, kind, sentence: str) -> None:
    with pytest.raises(kind, match=sentence) as raised:
        carom.run(gas, **arguments)
    one_sentence(raised.value)


def test_a_run_that_cannot_go_on_is_told_in_words_of_python(gas: carom.Scene, tmp_path: Path) -> None:
    carom.run(gas, out=tmp_path / "done")
    stopped = carom.run(gas.set({"run.time": 1e7, "run.sample_every": 1e5}), out=tmp_path / "stopped", walltime=0.1)
    assert stopped.saved
    run = carom.open_run(tmp_path / "done")
    for call, words in (
        (lambda: run.state(99), "k is 99; it must be from -41 to 40"),
        (lambda: run.analyze(5), "observables is 5; give a list of strings"),
        (lambda: carom.resume(tmp_path / "stopped", observables=[5]), "5 is no observable"),
    ):
        with pytest.raises((TypeError, ValueError), match=words):
            call()
    for mistake, sentence in (
        (lambda: carom.resume(tmp_path / "done"), "there is no checkpoint from which a run could go on; checkpoint_every= has"),
        (lambda: carom.run(gas, out=tmp_path / "done"), "replace it with overwrite=True, or name another directory with out="),
        (lambda: carom.run(gas, out=tmp_path / "stopped"), "overwrite=True, or name another directory with out="),
        (lambda: carom.resume(tmp_path / "nowhere"), "there is no such directory"),
        (lambda: carom.open_run(tmp_path / "nowhere"), "this is no directory of a finished run"),
    ):
        with pytest.raises(carom.OutputError, match=sentence) as raised:
            mistake()
        one_sentence(raised.value)
        assert "--" not in str(raised.value)


def one_sentence(error: BaseException) -> None:
    text = str(error)
    assert text and "\n" not in text and "incompatible function arguments" not in text


def test_files_that_are_no_simulation_are_refused(gas: carom.Scene, tmp_path: Path) -> None:
    path = tmp_path / "kept"
    carom.Simulation(gas).save(path)
    whole = path.read_bytes()
    with pytest.raises(carom.OutputError, match="cannot read the simulation: No such file"):
        carom.Simulation.load(tmp_path / "nowhere")
    for content in (b"", b"carom", whole[:30], whole[: len(whole) // 2], whole[:-1], b"x" + whole, whole[:-9] + b"?" + whole[-8:]):
        path.write_bytes(content)
        with pytest.raises(carom.OutputError, match="kept: ") as raised:
            carom.Simulation.load(path)
        one_sentence(raised.value)


@pytest.mark.parametrize("name", ["positions", "velocities", "images", "radii", "masses", "species", "spins"])
def test_arrays_are_read_only(gas: carom.Scene, name: str) -> None:
    sim = carom.Simulation(gas)
    frames = sim.sample(0.5, until=2.0)
    for holder in (sim, sim.state, frames):
        array = getattr(holder, name, None)
        if array is None or not array.size:
            continue
        with pytest.raises(ValueError, match="read-only"):
            array[0] = 1
        with pytest.raises(ValueError):
            array.setflags(write=True)
