#!/usr/bin/env python3
"""What Python costs: the numbers of the last table of docs/python.md.

    PYTHONPATH=build/release/python python bench/python.py [--bench build/release/bench/carom_bench] [--wheel carom-0.1.0-....whl]

Every ratio is of medians of pairs that take turns in this process; the twins in C++ are run by carom_bench before and after. Nothing is
timed before its answer was checked.
"""

import argparse
import gc
import json
import os
import pathlib
import platform
import signal
import statistics
import subprocess
import sys
import threading
import time
import zipfile

import numpy as np

import carom

TURNS = 9


def seconds(action):
    """Processor time of one call."""
    began = time.process_time()
    action()
    return time.process_time() - began


def twin(bench, name):
    """Milliseconds of a benchmark of carom_bench: the median of nine repetitions."""
    command = [bench, f"--benchmark_filter=^{name}$", "--benchmark_format=json", f"--benchmark_repetitions={TURNS}"]
    found = json.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout)
    return next(b["cpu_time"] for b in found["benchmarks"] if b.get("aggregate_name") == "median")


def sample(disks):
    """Milliseconds of sample(), and its frames."""
    scene = carom.Scene.preset("box") if disks == 64 else carom.Scene.preset("gas").set({"disks.0.count": disks})
    dt, until = (0.001, 5.0) if disks == 64 else (0.005, 1.0)
    times = []
    for _ in range(TURNS):
        sim = carom.Simulation(scene)
        sim.radii, sim.spins  # asked for once in a simulation's life
        times.append(1e3 * seconds(lambda sim=sim: sim.sample(dt, until)))
        assert len(sim.trajectory) == round(until / dt) + 1
    return statistics.median(times)


def step(disks, events=20_000):
    """Microseconds of step()."""
    sim = carom.Simulation(carom.Scene.preset("gas").set({"disks.0.count": disks}))
    sim.run_until(1.0)
    before = sim.totals["pair"]

    def go():
        for _ in range(events):
            sim.step()

    taken = seconds(go)
    assert sim.totals["pair"] == before + events
    return 1e6 * taken / events


class Nothing(carom.Observable):
    """Follows collisions, and does nothing with them."""

    name, follows_collisions = "nothing", True


def observable():
    """The ratio of the time of a run with an empty observable to that of one without."""
    scene = carom.Scene.preset("gas").set({"disks.0.count": 2000, "run.time": 300, "run.sample_every": 100, "run.equilibrate": {"time": 1}})
    ratios, bits = [], set()
    for _ in range(2 * TURNS):
        results = [carom.run(scene, threads=1), carom.run(scene, observables=[Nothing()], threads=1)]
        ratios.append(results[1].summary["loop_seconds"] / results[0].summary["loop_seconds"])
        bits |= {result.state_hash for result in results}
    assert len(bits) == 1
    return statistics.median(ratios)


def importing():
    """Milliseconds that `import carom` takes beyond numpy: the median of 25 processes."""
    code = "import numpy, time; t = time.process_time(); import carom; print(1e3 * (time.process_time() - t))"
    environment = {k: v for k, v in os.environ.items() if k != "PYTHONDONTWRITEBYTECODE"}
    run = lambda: float(subprocess.run([sys.executable, "-c", code], env=environment, check=True, capture_output=True, text=True).stdout)
    run()
    return statistics.median(run() for _ in range(25))


def ctrl_c(action):
    """Milliseconds from the signal to the exception: the longest of five."""
    longest = 0.0
    for _ in range(5):
        sent = []

        def send():
            time.sleep(0.5)
            sent.append(time.monotonic())
            os.kill(os.getpid(), signal.SIGINT)

        thread = threading.Thread(target=send)
        thread.start()
        try:
            action()
            raise AssertionError("it ended before it was interrupted")
        except KeyboardInterrupt:
            longest = max(longest, time.monotonic() - sent[0])
        thread.join()
    return 1e3 * longest


def resident():
    """Kilobytes of memory that this process has."""
    gc.collect()
    return int(pathlib.Path("/proc/self/statm").read_text().split()[1]) * os.sysconf("SC_PAGE_SIZE") // 1024


def growth(action, count):
    """Kilobytes that the process grew by from the first tenth of the calls to the last."""
    for k in range(count):
        action(k)
        if k == count // 10:
            before = resident()
    return resident() - before


def row(what, value):
    print(f"| {what} | {value} |", flush=True)


def main():
    arguments = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    arguments.add_argument("--bench", help="carom_bench, for the ratios to C++")
    arguments.add_argument("--wheel", help="a wheel, to tell its size")
    options = arguments.parse_args()
    cpu = next((line.split(":")[1].strip() for line in open("/proc/cpuinfo") if line.startswith("model name")), platform.machine())
    print(f"{cpu}, {os.cpu_count()} processors; Python {platform.python_version()}, numpy {np.__version__}; {carom.build()['compiler']}, "
          f"{carom.build()['flags']}\n")
    print("| what | measured |\n|---|---|")
    if options.bench:
        for disks, name in ((64, "5,001 frames of 64 disks"), (10_000, "201 frames of 10,000 disks")):
            before, python, after = twin(options.bench, f"sampled/{disks}"), sample(disks), twin(options.bench, f"sampled/{disks}")
            row(f"`sample()`, {name}, over the same loop in C++", f"{2 * python / (before + after):.3f} ({python:.3g} ms)")
        scene = carom.Scene.preset("gas").set({"disks.0.count": 1000})
        times = [1e3 * seconds(lambda sim=carom.Simulation(scene): sim.run_until(200.0)) for _ in range(TURNS)]
        row("`run_until()` that can be interrupted, over one call in C++ that cannot",
            f"{statistics.median(times) / twin(options.bench, 'in_one_call/1000'):.3f}")
    row("`step()`, 64 disks", f"{statistics.median(step(64) for _ in range(TURNS)):.2f} µs")
    row("`step()`, 100,000 disks", f"{statistics.median(step(100_000) for _ in range(3)):.2f} µs")
    row("an empty observable in Python, over none", f"{observable():.3f}")
    row("`import carom` beyond numpy", f"{importing():.1f} ms")
    scene = carom.Scene.preset("gas")
    for engine in carom.engines():
        row(f"Ctrl-C to `KeyboardInterrupt`, engine {engine}, longest of five",
            f"{ctrl_c(lambda: carom.Simulation(scene, engine=engine).run_until(1e9)):.0f} ms")
    row("the same in `sample()`", f"{ctrl_c(lambda: carom.Simulation(scene).sample(1e4, 1e9)):.0f} ms")
    row("the same in `run()`", f"{ctrl_c(lambda: carom.run(scene.set({'run.time': 1e9, 'run.sample_every': 1e6}))):.0f} ms")
    box = carom.Scene.preset("box")
    row("growth over 10,000 simulations, made, sampled, dropped",
        f"{growth(lambda k: carom.Simulation(box, seed=k).sample(0.01, 0.1), 10_000)} kB")
    short = box.set({"run.time": 0.1})
    row("growth over 1,000 runs", f"{growth(lambda k: carom.run(short, seed=k, observables=['pressure']), 1000)} kB")
    if options.wheel:
        inside = sum(entry.file_size for entry in zipfile.ZipFile(options.wheel).infolist())
        row("wheel, installed", f"{pathlib.Path(options.wheel).stat().st_size / 1e6:.1f} MB, {inside / 1e6:.1f} MB")


if __name__ == "__main__":
    main()
