"""Starts from what people have: files of numpy, GSD, and universes of MDAnalysis."""

from __future__ import annotations

from dataclasses import dataclass
from os import PathLike
from typing import TYPE_CHECKING, Any

import numpy as np

from carom import _core
from carom._arguments import path_text
from carom._errors import OutputError

if TYPE_CHECKING:
    from carom.frames import Floats


#: How far beyond the edge of its box single precision may put a centre, as a part of the box.
_SINGLE = 1e-6


@dataclass(frozen=True, eq=False)
class Start:
    """Disks as another program has left them, for `Scene.with_disks()`.

    Attributes:
        positions: shape (N, 2), length.
        velocities: shape (N, 2), length / time; None where the source has none.
        radii, masses: shape (N,); None where the source has none.
        box: ((x_low, x_high), (y_low, y_high)), for `Scene(box={"x": start.box[0], "y": start.box[1], ...})`; None where the source
            has none. A universe has lengths alone: along x and along y its box begins at 0, or has 0 in its middle where only that
            holds all centres. Where both do, it is as along the other axis.

    GSD files leave out what is the default of their format: velocities of 0, diameters and masses of 1 are None.
    """

    positions: Floats
    velocities: Floats | None = None
    radii: Floats | None = None
    masses: Floats | None = None
    box: tuple[tuple[float, float], tuple[float, float]] | None = None


def read_start(source: Any, frame: int = -1) -> Start:
    """Reads where disks are and how they move.

    >>> np.savetxt("start.csv", [[0.0, 0.0, 1.0, 0.0]], delimiter=",", header="x,y,vx,vy")
    >>> carom.read_start("start.csv").velocities.tolist()
    [[1.0, 0.0]]

    Args:
        source: a start file as scenes name it (`.npy`, or CSV with the names of the columns, which `np.savetxt(header=...)` writes); a
            `.gsd` file, which needs gsd; or an MDAnalysis Universe or AtomGroup. The third coordinate is left out.
        frame: of a trajectory, counted from the end where it is negative.

    Raises:
        SceneError: for a file that is no start, with the line; OutputError where it cannot be read; ValueError where its box leans.
    """
    if isinstance(source, (str, PathLike)):
        path = path_text(source, "the path")
        return _of_gsd(path, frame) if path.endswith(".gsd") else _of_file(path)
    if hasattr(source, "atoms") and hasattr(source, "universe"):
        return _of_universe(source, frame)
    raise TypeError(f"{type(source).__name__}: a start is read from a .npy, .csv or .gsd file, or an MDAnalysis universe")


def _of_file(path: str) -> Start:
    positions, velocities, radii, masses = _core.read_start_file(path)
    return Start(
        positions,
        velocities if len(velocities) else None,
        radii if len(radii) else None,
        masses if len(masses) else None,
    )


def _plane(vectors: Any) -> Floats:
    return np.ascontiguousarray(np.asarray(vectors, dtype=np.float64)[:, :2])


def _of_gsd(path: str, frame: int) -> Start:
    import gsd.hoomd

    try:
        with gsd.hoomd.open(path, "r") as trajectory:
            found = trajectory[frame]
            frame %= len(trajectory)

            def is_written(name: str) -> bool:
                """Tells what the file holds from what its readers assume: disks at rest, of diameter 1 and mass 1."""
                return any(trajectory.file.chunk_exists(frame=k, name=f"particles/{name}") for k in (frame, 0))

            written = {name for name in ("velocity", "diameter", "mass") if is_written(name)}
    except (OSError, RuntimeError) as error:
        raise OutputError(f"{path}: cannot read this GSD file: {error}") from None
    except IndexError:
        raise ValueError(f"{path}: there is no frame {frame}") from None
    particles = found.particles
    x, y, _, tilt = (float(length) for length in found.configuration.box[:4])
    if tilt != 0:
        raise ValueError(f"{path}: its box leans by xy = {tilt:g}; a start has a rectangular box")
    return Start(
        _plane(particles.position),
        _plane(particles.velocity) if "velocity" in written else None,
        np.asarray(particles.diameter, np.float64) / 2 if "diameter" in written else None,
        np.asarray(particles.mass, np.float64) if "mass" in written else None,
        ((-x / 2, x / 2), (-y / 2, y / 2)),
    )


def _limits(length: float, centred: bool) -> tuple[float, float]:
    return (-float(length) / 2, float(length) / 2) if centred else (0.0, float(length))


def _of_universe(source: Any, frame: int) -> Start:
    universe, atoms = source.universe, source.atoms
    here = universe.trajectory.frame
    try:
        universe.trajectory[frame]
        positions = _plane(atoms.positions)
        velocities = _plane(atoms.velocities) if universe.trajectory.ts.has_velocities else None
        size = None if universe.trajectory.ts.dimensions is None else universe.trajectory.ts.dimensions.copy()
    finally:
        universe.trajectory[here]
    if size is not None and size[5] != 90:
        raise ValueError("the box of the universe leans; a start has a rectangular box")

    def column(name: str) -> Floats | None:
        found = getattr(atoms, name, None)
        if getattr(getattr(universe._topology, name, None), "is_guessed", False):
            return None  # from the symbols of elements, which stand for species
        return None if found is None or not np.all(np.asarray(found) > 0) else np.asarray(found, np.float64)

    box = None
    if size is not None:
        lengths = size[:2].astype(np.float64)
        fits_middle = np.max(np.abs(positions), axis=0, initial=0.0) <= 0.5 * lengths * (1 + _SINGLE)
        fits_zero = np.min(positions, axis=0, initial=0.0) >= -_SINGLE * lengths
        centred = fits_middle & ~fits_zero
        centred |= fits_middle & fits_zero & centred[::-1]
        box = _limits(lengths[0], centred[0]), _limits(lengths[1], centred[1])
        for axis, (low, high) in enumerate(box):  # back to the edge what is beyond it by the rounding of single precision
            at, beyond = positions[:, axis], _SINGLE * (high - low)
            positions[:, axis] = np.where((at >= low - beyond) & (at <= high + beyond), np.clip(at, low, high), at)
    return Start(positions, velocities, column("radii"), column("masses"), box)
