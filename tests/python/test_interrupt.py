"""Ctrl-C ends a call soon, leaves the simulation whole at an event, and what goes on has the bits of what was never interrupted."""

from __future__ import annotations

import math
import os
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Callable
from pathlib import Path

import pytest

import carom


def interrupted(action: Callable[[], object], after: float = 0.2) -> None:
    """Sends SIGINT while `action` runs, which must raise KeyboardInterrupt."""
    timer = threading.Timer(after, os.kill, (os.getpid(), signal.SIGINT))
    timer.start()
    try:
        with pytest.raises(KeyboardInterrupt):
            action()
    finally:
        timer.cancel()
        timer.join()


CALLS: dict[str, Callable[[carom.Simulation], object]] = {
    "run_until": lambda sim: sim.run_until(1e9),
    "run": lambda sim: sim.run(1e9),
    "sample": lambda sim: sim.sample(100.0, until=1e7, velocities=False),
    "frames": lambda sim: list(sim.frames(1e8, until=1e9)),
    "record": lambda sim: sim.record(until=1e9),
    "events": lambda sim: [None for _ in sim.events(until=1e9)],
}


@pytest.mark.parametrize("name", CALLS)
def test_going_on_gives_the_uninterrupted_bits(gas: carom.Scene, name: str) -> None:
    sim, twin = carom.Simulation(gas), carom.Simulation(gas)
    interrupted(lambda: CALLS[name](sim))
    assert 0 < sim.time < 1e9
    assert sim.check_invariants() == []
    ahead = sim.time + 5.0
    sim.run_until(ahead)
    twin.run_until(ahead)
    assert (sim.state_hash, sim.totals) == (twin.state_hash, twin.totals)


@pytest.mark.parametrize("engine", carom.engines())
def test_every_engine_can_be_interrupted(engine: str) -> None:
    sim = carom.Simulation(carom.Scene.preset("gas"), engine=engine)
    interrupted(lambda: sim.run_until(1e9))
    assert sim.time > 0 and sim.check_invariants() == []


def too_full() -> carom.Scene:
    """Walls leave no room for these disks, which an error says after minutes."""
    count, packing_fraction = 50_000, 0.905
    side = math.sqrt(count * math.pi / 4 / packing_fraction)
    box = {"x": [0, side], "y": [0, side], "boundary": "walls"}
    disks = {"count": count, "radius": 0.5, "mass": 1, "positions": {"packing_fraction": packing_fraction}, "velocities": {"temperature": 1}}
    return carom.Scene(box=box, disks=disks, collision={"rule": "specular"}, run={"collisions": 1})


@pytest.mark.parametrize(
    "make",
    [carom.Simulation, carom.run, lambda scene: carom.run(scene, observables=[carom.Observable()]), carom.Scene.check],
    ids=["made", "run", "observed", "checked"],
)
def test_the_placing_of_disks_can_be_interrupted(make: Callable[[carom.Scene], object]) -> None:
    scene = too_full()
    interrupted(lambda: make(scene), after=0.5)


def test_what_is_in_the_way_is_told_before_disks_are_placed(gas: carom.Scene, tmp_path: Path) -> None:
    carom.run(gas, out=tmp_path / "run")
    with pytest.raises(carom.OutputError, match="overwrite=True"):
        carom.run(too_full(), out=tmp_path / "run")
    with pytest.raises(ValueError, match="fortnight"):
        carom.run(too_full(), out=tmp_path / "new", checkpoint_every="1 fortnight")
    assert not (tmp_path / "new").exists()


def test_a_second_ctrl_c_leaves_the_run_behind_and_python_ends_after_it() -> None:
    code = """
import carom, time
class Slow(carom.Observable):
    step = 0.5
    def sample(self, *arguments):
        print("begun", flush=True)
        ends = time.monotonic() + 3
        while time.monotonic() < ends: pass
carom.run(carom.Scene.preset("gas"), observables=[Slow()])
"""
    script = subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    assert script.stdout is not None and script.stdout.readline() == "begun\n"
    script.send_signal(signal.SIGINT)
    time.sleep(1.0)  # two at once are one
    script.send_signal(signal.SIGINT)
    _, error = script.communicate(timeout=30)
    assert script.returncode == -signal.SIGINT
    assert error.rstrip().endswith("KeyboardInterrupt") and "Fatal" not in error


@pytest.mark.parametrize("method", carom.fixed_step_methods())
def test_every_fixed_step_can_be_interrupted(gas: carom.Scene, method: str) -> None:
    sim, twin = (carom.Simulation(gas, method=method, dt=1e-3) for _ in range(2))
    interrupted(lambda: sim.run_until(1e7))
    ahead = sim.time + 0.1
    sim.run_until(ahead)
    twin.run_until(ahead)
    assert sim.state_hash == twin.state_hash


def test_the_frames_until_then_are_kept(gas: carom.Scene) -> None:
    sim = carom.Simulation(gas)
    interrupted(lambda: sim.sample(5.0, until=1e6))
    frames = sim.trajectory
    assert frames is not None and frames.interrupted and 0 < len(frames) < 200_000
    whole = carom.Simulation(gas).sample(5.0, until=float(frames.time[-1]))
    assert not whole.interrupted
    assert (frames.positions == whole.positions).all()
    assert sim.time >= frames.time[-1]


def test_the_collisions_until_then_are_kept(gas: carom.Scene) -> None:
    sim = carom.Simulation(gas)
    with pytest.raises(ValueError, match="has recorded no collisions yet"):
        sim.recorded
    interrupted(lambda: sim.record(until=1e6))
    until = sim.time
    assert 0 < len(sim.recorded) and sim.recorded["time"][-1] <= until
    # The time of the last collision has a remainder, which may lie above the number that stands for it.
    assert sim.recorded.tobytes() == carom.Simulation(gas).record(math.nextafter(until, math.inf)).tobytes()
    assert (sim.record(until + 5.0)["time"] > until).all()


def test_a_callback_ends_the_call_with_its_own_exception(gas: carom.Scene) -> None:
    sim, twin = carom.Simulation(gas), carom.Simulation(gas)

    def enough(fraction: float) -> None:
        raise LookupError("enough")

    with pytest.raises(LookupError, match="enough"):
        sim.run_until(1e9, progress=enough)
    ahead = sim.time + 1.0
    assert sim.run_until(ahead) == twin.run_until(ahead) == "time"
    assert sim.state_hash == twin.state_hash


def test_a_script_ends_as_python_scripts_do() -> None:
    code = """
import carom
sim, begun = carom.Simulation(carom.Scene.preset("gas")), []
sim.run_until(1e9, progress=lambda fraction: begun or begun.append(print("begun", flush=True)))
"""
    script = subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    assert script.stdout is not None and script.stdout.readline() == "begun\n"
    script.send_signal(signal.SIGINT)
    _, error = script.communicate(timeout=30)
    assert script.returncode == -signal.SIGINT
    assert "run_until" in error and error.rstrip().endswith("KeyboardInterrupt")


def test_no_handler_is_put_in_place_of_the_callers(gas: carom.Scene) -> None:
    heard: list[int] = []
    before = signal.signal(signal.SIGINT, lambda number, frame: heard.append(number))
    try:
        timer = threading.Timer(0.1, os.kill, (os.getpid(), signal.SIGINT))
        timer.start()
        ends = time.monotonic() + 30.0
        sim = carom.Simulation(gas)
        while not heard and time.monotonic() < ends:
            sim.run(1000.0)
        timer.join()
    finally:
        signal.signal(signal.SIGINT, before)
    assert heard == [signal.SIGINT]
