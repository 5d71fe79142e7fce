"""The naive method in numpy is the library's to the last bit, so that a reader can check how it treats such a script."""

from __future__ import annotations

import runpy

import matplotlib
import matplotlib.pyplot as plt
import numpy as np
import pytest
from conftest import ROOT

import carom

matplotlib.use("agg")
SCRIPT = runpy.run_path(str(ROOT / "docs/python/naive.py"))


def test_all_frames_have_the_bits_of_the_library() -> None:
    scene = carom.Scene.preset("box")
    start = carom.Simulation(scene)
    frames = SCRIPT["naive"](start.positions, start.velocities, 0.03, 0.001, 5000)
    same = carom.Simulation(scene, method="naive", dt=0.001).sample(0.001, until=5.0)
    assert frames.shape == (5001, 64, 2)
    assert np.array_equal(frames, same.positions)


@pytest.mark.filterwarnings("ignore:Animation was deleted")
def test_the_script_runs(capsys: pytest.CaptureFixture[str]) -> None:
    animation = SCRIPT["main"](steps=200)
    assert capsys.readouterr().out.startswith("carom's naive method has the same bits: True\na disk is off by a tenth")
    animation._init_draw()
    plt.close("all")
