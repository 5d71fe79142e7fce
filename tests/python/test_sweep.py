"""Sweeps: the numbers of the program's, on any executor, with any number of workers, and on from where one was killed."""

import csv
import json
import multiprocessing
import os
import pickle
import signal
import subprocess
import sys
import textwrap
import threading
import time
from concurrent.futures import ProcessPoolExecutor

import matplotlib
import numpy as np
import pytest

import carom

matplotlib.use("Agg")

POINTS = {"disks.0.radius": [0.2, 0.3], "run.time": [2.0, 4.0]}


def same(one, other):
    return one.columns == other.columns and all(np.array_equal(one[c], other[c], equal_nan=one[c].dtype.kind == "f") for c in one)


@pytest.fixture
def swept(gas):
    return carom.sweep(gas, POINTS, seeds=[3, 4, 5], workers=1)


def test_a_sweep_has_the_programs_table(swept, gas, program, tmp_path):
    (tmp_path / "gas.toml").write_text(gas.toml)
    (tmp_path / "grid.toml").write_text(
        'scene = "gas.toml"\nseeds = [3, 4, 5]\n[grid]\n"disks.0.radius" = [0.2, 0.3]\n"run.time" = [2.0, 4.0]\n'
    )
    assert program("sweep", tmp_path / "grid.toml", "--out", tmp_path / "out", "--quiet").returncode == 0
    with open(tmp_path / "out/sweep.csv") as file:
        rows = list(csv.DictReader(file))
    assert swept.table["disks.0.radius"].tolist() == [float(row["disks.0.radius"]) for row in rows]
    numbers = [name.removesuffix("_mean") for name in rows[0] if name.endswith("_mean")]
    assert len(numbers) > 1
    for name in numbers:
        column = "Z" if name == "pressure.Z" else name
        assert swept.table[column].tolist() == [float(row[f"{name}_mean"]) for row in rows], name
        assert swept.table[f"{column}_error"].tolist() == [float(row[f"{name}_error"]) for row in rows], name
    assert swept.table["finished"].tolist() == [int(row["finished"]) for row in rows]


def test_a_function_of_a_lag_is_a_column(gas, program, tmp_path):
    name = "observables.mean_square_displacement.diffusion@0.3"
    gas = gas.set({"observe.mean_square_displacement.every": 0.125})
    (tmp_path / "gas.toml").write_text(gas.toml)
    (tmp_path / "grid.toml").write_text(
        f'scene = "gas.toml"\nseeds = [3, 4]\ntable = ["{name}"]\n[grid]\n"disks.0.radius" = [0.2, 0.3]\n'
    )
    assert program("sweep", tmp_path / "grid.toml", "--out", tmp_path / "out", "--quiet").returncode == 0
    with open(tmp_path / "out/sweep.csv") as file:
        rows = list(csv.DictReader(file))
    points = {"disks.0.radius": [0.2, 0.3]}
    swept = carom.sweep(gas, points, seeds=[3, 4], numbers=[name], out=tmp_path / "kept")
    assert swept.table[name] == pytest.approx([float(row[f"{name}_mean"]) for row in rows], rel=1e-12)
    assert swept.table.units[name] == "length^2 / time"
    table = carom.run(gas.set({"disks.0.radius": 0.2, "run.seed": 3})).observables["mean_square_displacement"].table
    low, high = table["diffusion"][1:3]  # at lags of 0.25 and 0.375
    assert swept.runs[name][0] == pytest.approx(0.6 * low + 0.4 * high, rel=1e-12)
    # Another lag, of runs that are kept: they run again.
    again = carom.sweep(gas, points, seeds=[3, 4], numbers=[name.replace("0.3", "0.25")], out=tmp_path / "kept")
    assert again.runs[name.replace("0.3", "0.25")][0] == pytest.approx(low, rel=1e-12)
    with pytest.raises(ValueError, match="no run is that long"):
        carom.sweep(gas, points, seeds=1, numbers=[name.replace("0.3", "1e9")])


def test_every_run_is_that_of_carom_run(swept, gas):
    runs = swept.runs
    for k in (0, 4, 11):
        changes = {"disks.0.radius": runs["disks.0.radius"][k], "run.time": runs["run.time"][k], "run.seed": runs["seed"][k]}
        result = carom.run(gas.set(changes))
        assert (result.state_hash, result.collisions) == (runs["state_hash"][k], runs["events.pair"][k])
        assert runs["Z"][k] == result.Z.value


def test_the_error_is_that_of_independent_seeds(swept):
    Z = swept.runs["Z"].reshape(4, 3)
    assert np.allclose(swept.table["Z"], Z.mean(axis=1), rtol=1e-14)
    assert np.allclose(swept.table["Z_error"], Z.std(axis=1, ddof=1) / np.sqrt(3), rtol=1e-12)
    assert swept.complete and swept.failed == 0


def test_the_number_of_threads_changes_nothing(swept, gas):
    several = carom.sweep(gas, POINTS, seeds=[3, 4, 5], workers=3)
    assert same(several.runs, swept.runs) and same(several.table, swept.table)


def test_processes_have_the_results_of_threads(swept, gas):
    with ProcessPoolExecutor(2, mp_context=multiprocessing.get_context("spawn")) as pool:
        elsewhere = carom.sweep(gas, POINTS, seeds=[3, 4, 5], executor=pool)
    assert same(elsewhere.runs, swept.runs) and same(elsewhere.table, swept.table)


def test_a_dask_cluster_has_the_results_of_threads(swept, gas):
    distributed = pytest.importorskip("distributed", reason="distributed is not installed")
    with (
        distributed.LocalCluster(n_workers=2, processes=True, threads_per_worker=1, dashboard_address=None) as cluster,
        distributed.Client(cluster) as client,
    ):
        elsewhere = carom.sweep(gas, POINTS, seeds=[3, 4, 5], executor=client.get_executor())
    assert same(elsewhere.runs, swept.runs) and same(elsewhere.table, swept.table)


class Count(carom.Observable):
    """An observable of one's own; each run has a copy."""

    name, follows_collisions = "count", True

    def start(self, state):
        self.seen = 0

    def collisions(self, batch):
        self.seen += len(batch)

    def finish(self, time, collisions, virial):
        return {"seen": float(self.seen)}


def test_observables_are_columns(gas):
    swept = carom.sweep(gas, {"radius": [0.2, 0.3]}, seeds=2, observables=["temperature", Count()], workers=2)
    assert (swept.runs["observables.count.seen"] == swept.runs["events.pair"]).all()
    assert np.isfinite(swept.table["observables.temperature.kT"]).all()


def test_points_may_be_a_list_and_keys_short(gas):
    swept = carom.sweep(gas, [{"radius": 0.2}, {"radius": 0.3, "rule": "reversal"}], seeds=1, numbers=["events.pair", "pressure.Z"])
    assert swept.table["radius"].tolist() == [0.2, 0.3]
    assert swept.table["rule"].tolist() == [None, "reversal"]
    assert swept.table.columns == ["radius", "rule", "finished", "failed", "events.pair", "events.pair_error", "Z", "Z_error"]
    assert np.isnan(swept.table["Z_error"]).all(), "one seed has no error"


def test_what_a_sweep_shows(swept):
    pandas = pytest.importorskip("pandas")
    assert isinstance(swept.table.to_pandas(), pandas.DataFrame)
    axes = swept.plot()
    assert len(axes.get_legend().get_texts()) == 2, "a line for each value of the other key"
    assert axes.get_xlabel() == "disks.0.radius (length)" and axes.get_ylabel() == "Z"
    matplotlib.pyplot.close("all")
    assert "±" in str(swept) and "<table>" in swept._repr_html_()
    assert same(pickle.loads(pickle.dumps(swept)).table, swept.table)


def test_a_run_that_fails_is_listed_and_the_others_go_on(gas):
    class Broken(carom.Observable):
        name = "broken"

        def start(self, state):
            if len(state.positions) == 11:
                raise RuntimeError("it broke")

    with pytest.warns(RuntimeWarning, match="2 of 4 runs failed, as Sweep.runs says; the first: it broke"):
        swept = carom.sweep(gas, {"count": [11, 12]}, seeds=2, observables=[Broken()])
    assert swept.runs["state"].tolist() == ["failed", "failed", "finished", "finished"] and not swept.complete
    assert swept.table["failed"].tolist() == [2, 0] and np.isnan(swept.table["Z"][0]) and swept.table["Z"][1] > 1


@pytest.mark.parametrize(
    ("mistake", "kind", "sentence"),
    [
        (lambda gas, **_: carom.sweep(gas, {"radius": [0.2, 9.0]}), carom.SceneError, "point radius = 9.0 is refused"),
        (lambda gas, **_: carom.sweep(gas, {"radious": [0.2]}), ValueError, "radious: no key of the scene ends so; give"),
        (lambda gas, **_: carom.sweep(gas, {"run.tim": [1]}), carom.SceneError, r"refused: \[run\] has no key \"tim\""),
        (lambda gas, **_: carom.sweep(gas, {"run.seed": [1]}), ValueError, "run.seed cannot be swept; use seeds"),
        (lambda gas, **_: carom.sweep(gas, {"radius": []}), ValueError, "radius: there are no values"),
        (lambda gas, **_: carom.sweep(gas, []), ValueError, "there are no points"),
        (lambda gas, **_: carom.sweep(gas, "radius"), TypeError, "'radius' are no points; give values by key"),
        (lambda gas, **_: carom.sweep(gas, {1: [2]}), TypeError, "the key 1 is no string"),
        (lambda gas, **_: carom.sweep(gas, POINTS, seeds=0), ValueError, "there are no seeds"),
        (lambda gas, **_: carom.sweep(gas, POINTS, seeds=[1, 1]), ValueError, "hold one twice"),
        (lambda gas, **_: carom.sweep(gas, POINTS, seeds=[0.5]), TypeError, "a seed is 0.5; give a whole number"),
        (lambda gas, **_: carom.sweep(gas, POINTS, workers=0), ValueError, "workers is 0; it must be from 1"),
        (lambda gas, **_: carom.sweep(gas, POINTS, numbers=["presure.Z"]), ValueError, 'did you mean "pressure.Z"'),
        (lambda gas, **_: carom.sweep(gas, POINTS, engine="slow"), ValueError, 'there is no engine "slow"'),
        (lambda gas, **_: carom.sweep(gas, POINTS, dt=0.1), ValueError, "needs both"),
        (lambda gas, **_: carom.sweep(gas, POINTS, method="soft", dt="a"), TypeError, "dt is 'a'; give a number"),
        (lambda gas, **_: carom.sweep(gas, POINTS, stiffness=1e4), ValueError, 'a stiffness is that of the springs of method="soft"'),
        (lambda gas, **_: carom.sweep(gas, POINTS, method="naive", dt=0.1, stiffness=1e4), ValueError, "naive. has no springs"),
        (lambda gas, **_: carom.sweep(gas, POINTS, method="soft", dt=0.1, stiffness=1e9), ValueError, "unstable|stable"),
    ],
)
def test_mistakes_are_told_before_anything_runs(gas, tmp_path, mistake, kind, sentence):
    with pytest.raises(kind, match=sentence) as caught:
        mistake(gas)
    assert "\n" not in str(caught.value)


def test_of_points_with_one_scene_the_first_stays(gas: carom.Scene) -> None:
    with pytest.warns(RuntimeWarning, match=r"left out: radius = 0.2 \(that of radius = 0.2\); radius = 0.1 \(that of radius = 0.1\)$"):
        swept = carom.sweep(gas, {"radius": [0.2, 0.2, 0.1, 0.1]}, seeds=2)
    assert swept.table["radius"].tolist() == [0.2, 0.1]
    assert swept.table["finished"].tolist() == [2, 2]


def test_soft_disks_are_swept(gas, tmp_path):
    soft = {"method": "soft", "dt": 0.001, "stiffness": 2e4}
    swept = carom.sweep(gas, {"run.time": [0.5]}, seeds=[3], out=tmp_path / "out", **soft)
    assert swept.runs["state_hash"].tolist() == [carom.run(gas.set({"run.time": 0.5}), seed=3, **soft).state_hash]
    with pytest.raises(carom.OutputError, match="these runs are of other arguments"):
        carom.sweep(gas, {"run.time": [0.5]}, seeds=[3], out=tmp_path / "out", **{**soft, "stiffness": 1e4})


def test_a_step_may_be_the_scenes_own(gas):
    swept = carom.sweep(gas, {"run.time": [0.5]}, seeds=[3], method="swept")
    assert swept.runs["state_hash"].tolist() == [carom.run(gas.set({"run.time": 0.5}), seed=3, method="swept").state_hash]


def test_a_sweep_goes_on_and_takes_more_seeds_and_values(gas, tmp_path, swept):
    first = carom.sweep(gas, {**POINTS, "run.time": [2.0]}, seeds=[3, 4], out=tmp_path / "out")
    kept = (tmp_path / "out/runs.jsonl").read_text().splitlines()
    assert len(kept) == 1 + 4 and first.complete
    # A line that was cut short by a kill is taken off, and its run made anew.
    (tmp_path / "out/runs.jsonl").write_text("\n".join(kept[:-1]) + "\n" + kept[-1][:40])
    whole = carom.sweep(gas, POINTS, seeds=[3, 4, 5], out=tmp_path / "out")
    assert same(whole.runs, swept.runs) and same(whole.table, swept.table)
    lines = (tmp_path / "out/runs.jsonl").read_text().splitlines()
    assert len(lines) == 1 + 12 and lines[: len(kept) - 1] == kept[:-1]
    again = carom.sweep(gas, POINTS, seeds=[3, 4, 5], out=tmp_path / "out")
    assert same(again.table, swept.table) and (tmp_path / "out/runs.jsonl").read_text().splitlines() == lines


@pytest.mark.parametrize(
    ("change", "sentence"),
    [
        ({"scene": {"disks.0.mass": 2.0}}, "these runs are of another scene"),
        ({"points": {"radius": [0.2]}}, "these runs are of changes of other keys"),
        ({"points": {**POINTS, "run.time": [8.0]}}, "a run of disks.0.radius = 0.2, run.time = 2.0, seed 3, which this"),
        ({"seeds": [4]}, "seed 3, which this sweep has not"),
        ({"engine": "textbook"}, "these runs are of other arguments"),
    ],
)
def test_runs_of_something_else_are_refused_and_kept(gas, tmp_path, change, sentence):
    carom.sweep(gas, POINTS, seeds=[3], out=tmp_path, workers=1)
    before = (tmp_path / "runs.jsonl").read_bytes()
    call = {"points": POINTS, "seeds": [3], "engine": "auto", **change}
    scene = gas.set(call.pop("scene", {}))
    with pytest.raises(carom.OutputError, match=sentence) as caught:
        carom.sweep(scene, call.pop("points"), out=tmp_path, **call)
    assert "\n" not in str(caught.value) and (tmp_path / "runs.jsonl").read_bytes() == before


def test_a_file_of_something_else_is_refused(gas, tmp_path):
    (tmp_path / "runs.jsonl").write_text("something else\n")
    with pytest.raises(carom.OutputError, match="this was not written by carom.sweep"):
        carom.sweep(gas, POINTS, out=tmp_path)
    (tmp_path / "file").write_text("")
    with pytest.raises(carom.OutputError, match="cannot write it"):
        carom.sweep(gas, POINTS, out=tmp_path / "file")


def interrupted(call, out):
    """Sends Ctrl-C when a run is finished, and returns the partial sweep."""

    def send():
        while not (out / "runs.jsonl").exists() or len((out / "runs.jsonl").read_text().splitlines()) < 2:
            time.sleep(0.01)
        os.kill(os.getpid(), signal.SIGINT)

    sender = threading.Thread(target=send, daemon=True)
    sender.start()
    with pytest.raises(carom.Interrupted) as caught:
        call()
    sender.join()
    return caught.value.result


#: A short run, and one that would not end: it equilibrates, and then goes on for ever.
ENDLESS = {"run.time": [1.0, 1e12]}


def test_ctrl_c_stops_threads_and_keeps_what_is_finished(gas, tmp_path):
    endless = gas.set({"run.sample_every": False, "output.trajectory": False})
    partial = interrupted(lambda: carom.sweep(endless, ENDLESS, seeds=1, out=tmp_path, workers=2), tmp_path)
    assert partial.runs["state"].tolist() == ["finished", "missing"] and not partial.complete
    assert not [thread for thread in threading.enumerate() if thread.name.startswith("carom.sweep")]


def test_ctrl_c_stops_processes(gas, tmp_path):
    endless = gas.set({"run.sample_every": False, "output.trajectory": False})
    with ProcessPoolExecutor(2, mp_context=multiprocessing.get_context("spawn")) as pool:
        partial = interrupted(lambda: carom.sweep(endless, ENDLESS, seeds=1, out=tmp_path, executor=pool), tmp_path)
        # The pool is free again: its workers have stopped.
        assert list(pool.map(abs, [-1, -2])) == [1, 2]
    assert partial.runs["state"].tolist() == ["finished", "missing"]


def test_a_sweep_that_was_killed_goes_on(gas, tmp_path):
    code = textwrap.dedent(
        """
        import sys, carom
        from pathlib import Path
        scene = carom.Scene.parse(Path(sys.argv[1]).read_text())
        carom.sweep(scene, {"run.time": [1.0, 2.0, 3.0, 1e12]}, seeds=[3], out=sys.argv[2], workers=1)
        """
    )
    endless = gas.set({"run.sample_every": False, "output.trajectory": False})
    (tmp_path / "gas.toml").write_text(endless.toml)
    out = tmp_path / "out"
    child = subprocess.Popen([sys.executable, "-c", code, tmp_path / "gas.toml", out])
    while not (out / "runs.jsonl").exists() or len((out / "runs.jsonl").read_text().splitlines()) < 4:
        assert child.poll() is None
        time.sleep(0.01)
    with pytest.raises(carom.OutputError, match="another sweep is writing here"):
        carom.sweep(carom.Scene.parse((tmp_path / "gas.toml").read_text()), {"run.time": [1.0]}, seeds=[3], out=out)
    child.kill()
    child.wait()
    kept = (out / "runs.jsonl").read_text().splitlines()
    values = {"run.time": [1.0, 2.0, 3.0, 4.0]}
    scene = carom.Scene.parse((tmp_path / "gas.toml").read_text())
    whole = carom.sweep(scene, values, seeds=[3], out=out)
    assert (out / "runs.jsonl").read_text().splitlines()[:4] == kept
    assert same(whole.runs, carom.sweep(scene, values, seeds=[3]).runs)
    assert [json.loads(line)["found"]["state"] for line in kept[1:]] == ["finished"] * 3


def test_progress_is_told(gas):
    told = []
    carom.sweep(gas, POINTS, seeds=2, progress=told.append)
    assert told == [k / 8 for k in range(1, 9)]


def test_what_progress_raises_stops_the_sweep(gas, tmp_path):
    def broken(fraction):
        raise RuntimeError("it broke")

    with pytest.raises(RuntimeError, match="it broke"):
        carom.sweep(gas, POINTS, seeds=1, progress=broken, out=tmp_path)
    assert len((tmp_path / "runs.jsonl").read_text().splitlines()) >= 2


def test_numbers_that_would_take_the_place_of_other_columns_are_refused(gas):
    name = "observables.pressure.P_xx"
    scene = gas.set({"observe.pressure": True})
    for numbers, sentence in [
        ([name, f"{name}_error"], "for the standard error of observables.pressure.P_xx over seeds; leave observables.pressure.P_xx_error out"),
        (["time"], "the table has a column time for the values of that key"),
    ]:
        with pytest.raises(ValueError, match=sentence):
            carom.sweep(scene, {"time": [1.0, 2.0]}, seeds=[1], numbers=numbers)


class Scaled(carom.Observable):
    name, step = "scaled", 0.5

    def __init__(self, factor):
        self.factor = factor

    def sample(self, state, collisions, virial):
        self.sum = getattr(self, "sum", 0.0) + self.factor * (state.velocities**2).sum()

    def finish(self, time, collisions, virial):
        return {"sum": self.sum}


def test_kept_runs_are_those_of_the_same_observables(gas, tmp_path):
    def swept(factor):
        return carom.sweep(gas, {"radius": [0.3]}, seeds=[1], observables=[Scaled(factor)], out=tmp_path / "kept")

    first = swept(1.0).table["observables.scaled.sum"][0]
    assert swept(1.0).table["observables.scaled.sum"][0] == first
    with pytest.raises(carom.OutputError):
        swept(10.0)
