"""Threads run simulations side by side; one simulation belongs to one caller at a time."""

from __future__ import annotations

import gc
import pickle
import resource
import threading
from concurrent.futures import ThreadPoolExecutor

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


def test_others_run_while_a_simulation_does() -> None:
    """A thread that counts gets on although another one is in a single long call."""
    sim, done = long_running(), threading.Event()
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
    assert told == sorted(set(told)), "between any two reports the other thread has counted"


def test_simulations_leave_nothing_behind(gas: carom.Scene) -> None:
    def many(count: int) -> None:
        for seed in range(count):
            sim = carom.Simulation(gas, seed=seed)
            sim.sample(0.5, until=1.0)
            sim.step(), sim.positions, sim.record(until=1.1), sim.totals

    many(1000)
    gc.collect()
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    many(9000)
    assert resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before <= 1024  # KiB
