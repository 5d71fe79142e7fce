"""Threads run simulations side by side; one simulation belongs to one caller at a time."""

from __future__ import annotations

import gc
import pickle
import resource
import threading
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest

import carom


def ended(scene: carom.Scene, seed: int) -> str:
    sim = carom.Simulation(scene, seed=seed)
    sim.sample(0.5, until=3.0)
    return sim.state_hash


def test_eight_threads_give_the_bits_of_one(gas: carom.Scene) -> None:
    alone = [ended(gas, seed) for seed in range(100)]
    assert len(set(alone)) == 100
    with ThreadPoolExecutor(8) as pool:
        together = [pool.submit(ended, gas, seed) for _ in range(8) for seed in range(100)]
        assert [future.result() for future in together] == 8 * alone


def many_disks() -> carom.Scene:
    return carom.Scene(
        box={"x": (0, 60), "y": (0, 50), "boundary": "periodic"},
        disks={"count": 2000, "radius": 0.5, "mass": 1, "positions": "hexagonal", "velocities": {"temperature": 1.0}},
        collision={"rule": "specular"},
        run={"time": 3.0, "sample_every": 0.5},
    )


def test_one_simulation_on_several_threads_has_the_bits_of_one() -> None:
    alone, shared = carom.Simulation(many_disks()), carom.Simulation(many_disks(), threads=3)
    assert (alone.threads, shared.threads) == (1, 3)
    assert (alone.sample(0.25, until=2.0).positions == shared.sample(0.25, until=2.0).positions).all()
    shared.threads = 2
    for sim in alone, shared:
        sim.run_until(4.0)
    assert shared.state_hash == alone.state_hash and shared.totals == alone.totals
    counts = shared.thread_counts
    assert counts["threads"] == counts["domains"] == 2
    assert counts["windows"] > 0 and counts["copied_events"] > 0
    assert alone.thread_counts["windows"] == 0


def test_threads_are_kept_by_copies_and_forgotten_by_pickles() -> None:
    sim = carom.Simulation(many_disks(), threads=2)
    sim.run_until(1.0)
    copied, pickled = sim.copy(), pickle.loads(pickle.dumps(sim))
    assert (copied.threads, pickled.threads) == (2, 1)
    for one in sim, copied, pickled:
        one.run_until(2.0)
    assert sim.state_hash == copied.state_hash == pickled.state_hash


def test_threads_are_one_while_an_effect_acts_that_runs_on_one_core() -> None:
    sim = carom.Simulation(many_disks(), threads=2)
    sim.run_until(0.5)
    sim.set("drag.rate", 1.0)
    assert sim.threads == 1
    sim.set("drag", None)
    assert sim.threads == 2


def test_threads_are_refused_where_one_core_must_do() -> None:
    sim = carom.Simulation(many_disks().set({"drag.rate": 1.0}))
    with pytest.raises(ValueError, match="this simulation runs on one core: drag slows the clock"):
        sim.threads = 2
    assert sim.threads == 1
    for wrong, error in ((0, ValueError), (33, ValueError), ("two", TypeError)):
        with pytest.raises(error, match="^threads is "):
            carom.Simulation(many_disks(), threads=wrong)  # type: ignore[arg-type]


def test_a_run_on_several_threads_has_the_results_of_one() -> None:
    one, three = (carom.run(many_disks(), observables={"pressure": True}, frames=True, threads=n) for n in (1, 3))
    assert three.summary.pop("cores")["threads"] == 3
    assert "cores" not in one.summary
    assert three.state_hash == one.state_hash
    assert three.observables["pressure"]["Z"].value == one.observables["pressure"]["Z"].value
    assert one.frames is not None and three.frames is not None
    assert (three.frames.positions == one.frames.positions).all()


def long_running() -> carom.Simulation:
    """Returns a simulation whose next unit of time takes a while."""
    return carom.Simulation(carom.Scene.preset("dense"), engine="textbook-quad")


def test_a_second_caller_is_refused_and_the_first_goes_on() -> None:
    sim, seen = long_running(), list[BaseException]()
    velocities = sim.velocities
    running, stop = threading.Event(), threading.Event()

    def progress(fraction: float) -> None:
        running.set()
        if stop.is_set():
            raise StopIteration

    def run() -> None:
        try:
            sim.run_until(1e6, progress=progress)
        except StopIteration as asked:
            seen.append(asked)

    thread = threading.Thread(target=run)
    thread.start()
    try:
        assert running.wait(30), "the run has told nothing of its progress"
        for ask in (
            lambda: sim.positions,
            lambda: sim.time,
            lambda: sim.run_until(1.0),
            lambda: sim.step(),
            lambda: sim.sample(0.1, until=1.0),
            lambda: sim.record(until=1.0),
            lambda: sim.copy(),
            lambda: pickle.dumps(sim),
            lambda: sim.set("gravity", None),
            lambda: sim.set_velocities(velocities),
            lambda: sim.check_invariants(),
        ):
            with pytest.raises(RuntimeError, match="^this simulation is running"):
                ask()
        # Another one can be asked meanwhile.
        assert carom.Simulation(carom.Scene.preset("box")).run_until(1.0) == "time"
    finally:
        stop.set()
        thread.join(30)
    assert len(seen) == 1
    assert sim.check_invariants() == [] and sim.time > 0


@pytest.mark.parametrize("begin", [long_running, lambda: carom.Simulation(many_disks(), threads=2)], ids=["one", "several"])
def test_others_run_while_a_simulation_does(begin: Callable[[], carom.Simulation]) -> None:
    """A thread that counts gets on although another one is in a single long call, of one thread or of several."""
    sim, done = begin(), threading.Event()
    counted, told = 0, list[int]()

    def progress(fraction: float) -> None:
        told.append(counted)
        if len(told) >= 5:
            done.set()
            raise StopIteration

    def run() -> None:
        with pytest.raises(StopIteration):
            sim.run_until(1e6, progress=progress)

    thread = threading.Thread(target=run)
    thread.start()
    while not done.is_set() and counted < 10**9:
        counted += 1
    thread.join(30)
    assert not thread.is_alive()
    assert len(told) == 5 and told == sorted(set(told)), "between any two reports the other thread has counted"


def memory_held() -> int:
    """Returns the bytes that are resident now: the maximum so far may be that of earlier tests."""
    return int(Path("/proc/self/statm").read_text().split()[1]) * resource.getpagesize()


def test_simulations_leave_nothing_behind(gas: carom.Scene) -> None:
    def many(count: int) -> None:
        for seed in range(count):
            sim = carom.Simulation(gas, seed=seed)
            sim.sample(0.5, until=1.0)
            sim.step(), sim.positions, sim.record(until=1.1), sim.totals

    many(1000)
    gc.collect()
    before = memory_held()
    many(9000)
    assert memory_held() - before <= 2**20, "116 bytes a simulation: less than any object of one"
