"""What is round each disk of a state: its Voronoi cell, and the cluster that it belongs to."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from carom import _core
from carom._arguments import real, shown
from carom.frames import State
from carom.results import Table
from carom.scene import as_scene

if TYPE_CHECKING:
    from carom.scene import SceneLike


def voronoi(scene: SceneLike, state: State) -> Table:
    """Returns the Voronoi cells of the disks' centres, a row for each disk: what the observable `voronoi` averages.

    >>> import carom
    >>> scene = carom.Scene.preset("defects")
    >>> cells = carom.voronoi(scene, carom.Simulation(scene).state)
    >>> int((6 - cells["neighbours"]).sum())
    0

    The columns are `area` (length^2), `neighbours`, `psi6` and `psi6_angle`, and `at_wall`. The sixfold order of a cell is the mean
    of exp(6 i theta) over its sides, weighted by their lengths, theta the direction to the neighbour; psi6 is its size, from 0 to 1,
    and psi6_angle its argument in radians, six times the direction of the lattice. Both are nan where a wall cuts the cell off.

    Args:
        scene: a Scene, the path of a scene file, or a mapping.
        state: of the scene's disks, such as `Simulation.state` or a frame of `Frames`.

    Raises:
        ValueError: where the state is not one of these disks, a centre is outside the box, or two centres are in one place.
    """
    areas, neighbours, order, angle, at_wall = _core.voronoi(as_scene(scene)._core, _state_of(state))
    columns = {"area": areas, "neighbours": neighbours, "psi6": order, "psi6_angle": angle, "at_wall": at_wall.astype(np.bool_)}
    return Table(columns, {"area": "length^2", "psi6_angle": "radians"}, "Voronoi cells")


def clusters(scene: SceneLike, state: State, gap: float) -> Table:
    """Returns the clusters of disks whose surfaces are nearer than a gap, a row for each disk: what the observable `clusters` averages.

    The columns are `cluster`, the number of the disk's cluster, which is that of one of its disks; `size`, the number of disks in it;
    and whether it percolates, `percolates_x` and `percolates_y`: along a periodic axis it is joined to its own image, and between
    walls it has disks nearer than the gap to both.

    Args:
        scene: a Scene, the path of a scene file, or a mapping.
        state: of the scene's disks, such as `Simulation.state` or a frame of `Frames`.
        gap: length. The scene format gives it in mean diameters.

    Raises:
        ValueError: where the gap is not >= 0 and finite, or longer than a periodic box; where the scene shears its disks; where the state
            is not one of these disks, or a centre is outside the box.
    """
    gap = real(gap, "gap")
    if not 0.0 <= gap < np.inf:
        raise ValueError(f"gap={gap:g}: a gap between surfaces is >= 0 and finite")
    numbers, sizes, along_x, along_y = _core.clusters(as_scene(scene)._core, _state_of(state), gap)
    percolates = {"percolates_x": along_x.astype(np.bool_), "percolates_y": along_y.astype(np.bool_)}
    return Table({"cluster": numbers, "size": sizes, **percolates}, title="Clusters")


def _state_of(state: State) -> _core.State:
    if not isinstance(state, State):
        raise TypeError(f"the state is {shown(state)}; give a carom.State, such as Simulation.state or a frame of Frames")
    return state._core
