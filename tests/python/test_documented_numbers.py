"""Numbers that pages quote from a command with its seed: every machine gets the same bits, so the command still prints them."""

import json
import re
import subprocess

import pytest
from conftest import PROGRAM, ROOT, needs_program

VALIDATION = (ROOT / "docs/validation.md").read_text()

pytestmark = needs_program


def summary_of(directory, scene, *overrides):
    settings = [word for override in overrides for word in ("--set", override)]
    subprocess.run([PROGRAM, "run", ROOT / scene, "--out", directory, "--quiet", "--force", *settings], check=True)
    return json.loads((directory / "summary.json").read_text())


@pytest.mark.parametrize("rule, packing_fraction", [("specular", "0.05"), ("reversal", "0.60")])
def test_the_equation_of_state(tmp_path, rule, packing_fraction):
    found = summary_of(
        tmp_path / "run",
        "docs/images/equation_of_state.toml",
        f"disks.0.packing_fraction={packing_fraction}",
        f'collision.rule="{rule}"',
    )["pressure"]
    assert f"| {rule} | {packing_fraction} | {found['Z']:.5f} ± {found['Z_error']:.5f} |" in VALIDATION


def test_observables(tmp_path):
    found = summary_of(tmp_path / "run", "docs/scenes/observe.toml", "run.time=3000")["observables"]

    def number(observable, name, digits):
        entry = found[observable][name]
        return f"{entry['value']:.{digits}f} ± {entry['error']:.{digits}f}"

    rows = [line for line in VALIDATION.splitlines() if line.startswith("| ")]

    def assert_row(beginning, *numbers):
        row = next(line for line in rows if line.startswith("| " + beginning))
        for one in numbers:
            assert one in row

    assert_row("Z from momentum transfer", number("pressure", "Z", 4))
    assert_row("Z from the collision rate", number("pressure", "Z_rate", 4))
    assert_row("contact value of g(r)", number("radial_distribution", "contact", 3))
    assert_row("P_xx, P_yy, P_xy", *(number("pressure", name, 4) for name in ("P_xx", "P_yy", "P_xy")))
    assert_row("kurtosis of the velocities", number("velocity_moments", "kurtosis", 4))
    assert_row("initial slope of the velocity autocorrelation", number("velocity_autocorrelation", "initial_slope", 3).removeprefix("-"))
    assert_row("viscosity, Green-Kubo", number("viscosity", "green_kubo", 3))
    assert_row("heat conductivity, Green-Kubo", number("heat_conductivity", "green_kubo", 2))


def test_the_mean_free_path_of_the_lorentz_gas(tmp_path):
    found = summary_of(tmp_path / "run", "docs/scenes/lorentz.toml")
    hits = found["events"]["obstacle"]
    assert f"{found['time'] / hits:.4f} over {hits} hits" in VALIDATION


def test_the_horizon_of_the_gas():
    said = subprocess.run([PROGRAM, "horizon", ROOT / "docs/scenes/gas.toml"], check=True, capture_output=True, text=True).stdout
    page = " ".join((ROOT / "docs/numerics.md").read_text().replace("\n> ", " ").split())
    for sentence in (r"is right to 0\.001 diameters until t = \S+ \(\d+ collisions per disk\)", r"right until about t = \S+ \(\d+ collisions per disk\)"):
        found = re.search(sentence, " ".join(said.split()))
        assert found and found[0] in page
