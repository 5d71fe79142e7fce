"""What pip installs: the wheel and the source distribution."""

from __future__ import annotations

import os
import subprocess
import sys
import tarfile
import zipfile
from pathlib import Path

import pytest
from conftest import ROOT

import carom

pytest.importorskip("scikit_build_core", reason="scikit-build-core is not installed")

#: The build directory whose extensions the wheel takes, so that nothing is compiled here.
BUILD = os.environ.get("CAROM_BUILD_DIR")
MIB = 2**20


@pytest.mark.skipif(BUILD is None, reason="CAROM_BUILD_DIR names no build directory")
def test_the_wheel_is_whole_and_small_and_works_where_it_is_installed(tmp_path: Path) -> None:
    pip = [sys.executable, "-m", "pip", "--quiet", "--disable-pip-version-check"]
    without = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
    command = [*pip, "wheel", "--no-build-isolation", "--no-deps", "--wheel-dir", tmp_path, ROOT]
    told = subprocess.run(command, capture_output=True, text=True, env=without, timeout=250)
    assert told.returncode == 0, told.stderr
    (wheel,) = tmp_path.glob("*.whl")
    assert wheel.name.startswith(f"carom-{carom.__version__}-cp3")
    assert wheel.stat().st_size <= 6 * MIB
    with zipfile.ZipFile(wheel) as file:
        names = {name.removeprefix("carom/") for name in file.namelist() if name.startswith("carom/")}
        assert sum(entry.file_size for entry in file.infolist()) <= 16 * MIB
    sources = {path.name for path in (ROOT / "python/carom").iterdir() if path.suffix in (".py", ".typed")}
    compiled = {name for name in names if name.endswith((".so", ".pyi"))}
    assert names - compiled == sources
    assert sorted(name.partition(".")[0] for name in compiled) == ["_core", "_core", "_files", "_files"]

    told = subprocess.run([*pip, "install", "--no-deps", "--target", tmp_path / "there", wheel], capture_output=True, text=True)
    assert told.returncode == 0, told.stderr
    code = 'import carom; sim = carom.Simulation(carom.Scene.preset("box")); sim.run(5); print(carom.__file__, sim.state_hash)'
    elsewhere = {**without, "PYTHONPATH": str(tmp_path / "there")}
    told = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, cwd=tmp_path, env=elsewhere)
    sim = carom.Simulation(carom.Scene.preset("box"))
    sim.run_until(5.0)
    assert told.stdout.split() == [str(tmp_path / "there/carom/__init__.py"), sim.state_hash], told.stderr


def test_the_source_distribution_holds_what_is_compiled_and_little_else(tmp_path: Path) -> None:
    code = f"from scikit_build_core.build import build_sdist; print(build_sdist({str(tmp_path)!r}))"
    told = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, cwd=ROOT)
    assert told.returncode == 0, told.stderr
    (archive,) = tmp_path.glob("*.tar.gz")
    assert archive.stat().st_size <= 6 * MIB
    with tarfile.open(archive) as file:
        names = {name.partition("/")[2] for name in file.getnames()}
    for folder, pattern in (("src", "*.*pp"), ("src", "*.cmake"), ("include", "*.hpp"), ("python", "*.py"), ("cmake", "*.*")):
        given = {str(path.relative_to(ROOT)) for path in (ROOT / folder).rglob(pattern)}
        assert given and given <= names, sorted(given - names)[:5]
    assert {f"tests/hard_cases/{path.name}" for path in (ROOT / "tests/hard_cases").glob("*.toml")} <= names
    assert {"CMakeLists.txt", "pyproject.toml", "LICENSE", "README.md", "caromConfig.cmake.in"} <= names
    assert not any(name.startswith(("build/", "bench/", "tests/core", ".git")) for name in names)
