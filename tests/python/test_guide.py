"""Every block of docs/python.md runs, one after the other, and the examples in docstrings do what they say."""

import doctest
import importlib
import json
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import threading

import matplotlib
import numpy
import pytest
from conftest import ROOT

import carom

matplotlib.use("Agg")
MODULES = sorted(path.stem for path in pathlib.Path(carom.__file__).parent.glob("*.py") if ">>>" in path.read_text())


def blocks(page="docs/python.md"):
    return re.findall(r"^```python\n(.*?)^```", (ROOT / page).read_text(), re.M | re.S)


def test_the_guide_has_all_blocks():
    assert len(blocks()) >= 12


@pytest.mark.filterwarnings("ignore:Animation was deleted")
def test_every_block_of_the_guide_runs(program, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    for name in ("box", "gas", "two_disks"):
        shutil.copy(ROOT / f"docs/scenes/{name}.toml", tmp_path)
    gas = (tmp_path / "gas.toml").read_text().replace("time = 1000.0", "time = 20.0")  # enough to see that it works
    (tmp_path / "gas.toml").write_text(gas)
    variables = {}
    for block in blocks():
        timer = None
        if "Ctrl-C here" in block:
            timer = threading.Timer(0.3, os.kill, (os.getpid(), signal.SIGINT))
            timer.start()
        try:
            exec(compile(block, "docs/python.md", "exec"), variables)
        finally:
            if timer:
                timer.cancel()
                timer.join()
    shown = capsys.readouterr().out
    assert program("run", "box.toml", "--out", "of_program", "--quiet").returncode == 0
    assert json.loads((tmp_path / "of_program/summary.json").read_text())["state_hash"] in shown, "the box ends in the program's bits"
    assert " meets disk 1" in shown and "frames until" in shown
    matplotlib.pyplot.close("all")


@pytest.mark.parametrize("page", ["docs/python.md", "README.md"])
def test_the_types_of_every_block_are_right(page, tmp_path):
    script = tmp_path / "page.py"
    script.write_text("".join(blocks(page)))
    # A reader's functions have no annotations, and names are used again from block to block; all else is strict.
    options = ["--strict", "--allow-untyped-defs", "--allow-untyped-calls", "--allow-redefinition", "--check-untyped-defs"]
    configuration = ["--config-file", str(ROOT / "pyproject.toml"), "--cache-dir", os.path.join(os.environ["CAROM_BUILD_DIR"], "mypy")]
    paths = os.environ | {"MYPYPATH": str(pathlib.Path(carom.__file__).parents[1])}
    found = subprocess.run([sys.executable, "-m", "mypy", *options, *configuration, str(script)], capture_output=True, text=True, env=paths)
    assert found.returncode == 0, found.stdout + found.stderr


@pytest.mark.parametrize("name", MODULES)
def test_examples_in_docstrings_hold(name, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    module = carom if name == "__init__" else importlib.import_module(f"carom.{name}")
    found = doctest.testmod(module, extraglobs={"carom": carom, "np": numpy, "Number": carom.Number, "Table": carom.Table})
    assert found.attempted > 0 and found.failed == 0
