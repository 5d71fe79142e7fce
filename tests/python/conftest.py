"""What the tests share: the program, and the scenes of the repository."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

import carom

ROOT = Path(__file__).resolve().parents[2]
sys.path.append(str(ROOT / "tests/support"))

PROGRAM = os.environ.get("CAROM_PROGRAM", "")

needs_program = pytest.mark.skipif(not PROGRAM, reason="CAROM_PROGRAM names no program")

#: Twelve disks that meet often, in a periodic box.
GAS = {
    "box": {"x": (0.0, 6.0), "y": (0.0, 4.0), "boundary": "periodic"},
    "disks": {"count": 12, "radius": 0.4, "mass": 1.0, "positions": "random", "velocities": {"temperature": 1.0}},
    "collision": {"rule": "specular"},
    "run": {"time": 10.0, "sample_every": 0.25, "seed": 3},
}


@pytest.fixture
def gas() -> carom.Scene:
    return carom.Scene(GAS)


@pytest.fixture(scope="session")
def program() -> Callable[..., subprocess.CompletedProcess[str]]:
    """Runs the program that the environment variable CAROM_PROGRAM names, with these arguments."""
    if not PROGRAM:
        pytest.fail("CAROM_PROGRAM does not say where the program is; ctest -L python does")

    def run(*arguments: object) -> subprocess.CompletedProcess[str]:
        return subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True, timeout=120)

    return run
