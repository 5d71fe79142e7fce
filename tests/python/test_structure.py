"""Voronoi cells and clusters of a state, disk by disk."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

import carom


def lattice() -> carom.Scene:
    """A hexagonal lattice of 4 x 4 disks of radius 0.4, one apart, with rows along x."""
    box = {"x": (0.0, 4.0), "y": (0.0, 2.0 * 3.0**0.5), "boundary": "periodic"}
    disks = {"count": 16, "radius": 0.4, "mass": 1.0, "positions": "hexagonal", "velocities": {"temperature": 1.0}}
    return carom.Scene({"box": box, "disks": disks, "collision": {"rule": "specular"}, "run": {"time": 1.0}})


def test_cells_of_a_lattice_are_hexagons() -> None:
    cells = carom.voronoi(lattice(), carom.Simulation(lattice()).state)
    assert cells["neighbours"].tolist() == [6] * 16
    assert cells["area"] == pytest.approx(np.full(16, 0.5 * 3.0**0.5), rel=1e-9)
    assert cells["psi6"] == pytest.approx(np.ones(16), rel=1e-9)
    assert cells["psi6_angle"] == pytest.approx(np.zeros(16), abs=1e-9)
    assert not cells["at_wall"].any()
    assert cells.units == {"area": "length^2", "psi6_angle": "radians"}


def test_clusters_of_a_lattice_are_all_or_none() -> None:
    state = carom.Simulation(lattice()).state
    apart, together = carom.clusters(lattice(), state, 0.19), carom.clusters(lattice(), state, 0.21)  # surfaces are 0.2 apart
    assert apart["size"].tolist() == [1] * 16 and len(set(apart["cluster"])) == 16
    assert not apart["percolates_x"].any()
    assert together["size"].tolist() == [16] * 16 and len(set(together["cluster"])) == 1
    assert together["percolates_x"].all() and together["percolates_y"].all()


def test_observables_are_the_means_of_these(gas: carom.Scene) -> None:
    observe = {"voronoi": {"every": 0.5}, "clusters": {"every": 0.5, "gap": 0.5}}
    measured = carom.run({**gas.to_dict(), "observe": observe}).observables
    frames = carom.Simulation(gas).sample(0.5, until=10.0)
    cells = [carom.voronoi(gas, state) for state in frames]
    assert all((6 - one["neighbours"]).sum() == 0 for one in cells)
    assert all(one["area"].sum() == pytest.approx(24.0, rel=1e-12) for one in cells)
    assert np.mean([one["psi6"] for one in cells]) == pytest.approx(float(measured["voronoi"]["local"]), rel=1e-12)
    found = [carom.clusters(gas, state, 0.4) for state in frames]  # half a diameter
    assert np.mean([one["size"] for one in found]) == pytest.approx(float(measured["clusters"]["mean_size"]), rel=1e-12)
    either = [(one["percolates_x"] | one["percolates_y"]).any() for one in found]
    assert np.mean(either) == pytest.approx(float(measured["clusters"]["percolating"]), rel=1e-12)


def test_a_cell_at_a_wall_has_no_sixfold_order(gas: carom.Scene) -> None:
    walls = carom.Scene({**gas.to_dict(), "box": {"x": (0.0, 6.0), "y": (0.0, 4.0), "boundary": "walls"}})
    cells = carom.voronoi(walls, carom.Simulation(walls).state)
    assert cells["at_wall"].any()
    assert np.array_equal(np.isnan(cells["psi6"]), cells["at_wall"]) and np.array_equal(np.isnan(cells["psi6_angle"]), cells["at_wall"])
    assert cells["area"].sum() == pytest.approx(24.0, rel=1e-12)


@pytest.mark.parametrize(
    ("call", "kind", "sentence"),
    [
        (lambda gas, state: carom.voronoi(gas, state.positions), TypeError, "give a carom.State"),
        (lambda gas, state: carom.voronoi(3, state), TypeError, "3 is no scene"),
        (lambda gas, state: carom.voronoi(lattice(), state), ValueError, "12 positions and 12 velocities is given for 16 disks"),
        (lambda gas, state: carom.voronoi(gas, carom.State(np.zeros((12, 2)))), ValueError, "two disks have the same centre, which has no Voronoi cell"),
        (lambda gas, state: carom.clusters(gas, state, -0.1), ValueError, "gap=-0.1: a gap between surfaces is >= 0 and finite"),
        (lambda gas, state: carom.clusters(gas, state, float("nan")), ValueError, "gap=nan: a gap"),
        (lambda gas, state: carom.clusters(gas, state, 4.5), ValueError, "4 long in y, so that every disk would be near its own image; make the gap smaller"),
        (lambda gas, state: carom.clusters(gas.set({"shear.rate": 0.5}), state, 0.1), ValueError, "under .shear. images slide past each other"),
        (lambda gas, state: carom.clusters(gas, state, "wide"), TypeError, "gap is 'wide'; give a number"),
    ],
)
def test_refusals_are_sentences(gas: carom.Scene, call: Callable[..., Any], kind: type[Exception], sentence: str) -> None:
    with pytest.raises(kind, match=sentence):
        call(gas, carom.Simulation(gas).state)
