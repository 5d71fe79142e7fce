"""States at one instant, and over time."""

from __future__ import annotations

import copy
import math
from os import PathLike
from os.path import splitext
from typing import TYPE_CHECKING, Any, overload

import numpy as np

from carom import _core
from carom._arguments import frame_number, numbers, pairs, path_text, real, whole_pairs
from carom._errors import OutputError
from carom.scene import Scene

if TYPE_CHECKING:
    import numpy.typing as npt
    from matplotlib.animation import FuncAnimation

    Floats = npt.NDArray[np.float64]
    Integers = npt.NDArray[np.int64]


class State:
    """Positions and velocities of all disks at one instant. Arrays are read-only.

    A state that `Simulation.state` returns can begin another simulation: `Simulation(scene, state=state)`. So can one that is made
    of arrays:

    >>> state = carom.State(positions=[[0.0, 0.0], [0.5, 0.0]], velocities=[[1.0, 0.0], [0.0, 0.0]])
    >>> state.count
    2

    Args:
        positions: shape (N, 2), length.
        velocities: shape (N, 2), length / time; None: at rest.
        images: shape (N, 2), whole numbers of box lengths that disks have travelled past periodic edges; None: none.
        spins: shape (N,), angular velocities, 1 / time; None: smooth disks.
        time: of the state. A simulation that begins with it begins at 0.
    """

    __slots__ = ("_core",)

    def __init__(
        self,
        positions: npt.ArrayLike,
        velocities: npt.ArrayLike | None = None,
        images: npt.ArrayLike | None = None,
        spins: npt.ArrayLike | None = None,
        time: float = 0.0,
    ) -> None:
        places = pairs(positions, "positions")
        count = len(places)
        now = real(time, "time")
        if not math.isfinite(now):
            raise ValueError(f"time is {now}; give a finite number")
        self._core = _core.State(
            places,
            None if velocities is None else pairs(velocities, "velocities", count),
            None if images is None else whole_pairs(images, "images", count),
            None if spins is None else numbers(spins, "spins", count),
            now,
        )

    @classmethod
    def _of(cls, core: _core.State) -> State:
        state = cls.__new__(cls)
        state._core = core
        return state

    @property
    def time(self) -> float:
        """The time since the start of the measured run."""
        return self._core.time

    @property
    def count(self) -> int:
        """The number of disks."""
        return len(self.positions)

    @property
    def positions(self) -> Floats:
        """Positions, shape (N, 2), length; along periodic axes inside the box."""
        return self._core.positions

    @property
    def velocities(self) -> Floats:
        """Velocities, shape (N, 2), length / time."""
        return self._core.velocities

    @property
    def images(self) -> Integers:
        """Numbers of box lengths travelled past periodic edges, shape (N, 2); 0 along walled axes."""
        return self._core.images

    @property
    def spins(self) -> Floats:
        """Angular velocities, shape (N,), 1 / time, counter-clockwise; shape (0,) where disks have none."""
        return self._core.spins

    @property
    def scale(self) -> float:
        """The factor by which disks that grow have grown; 1 in other scenes."""
        return self._core.scale

    @property
    def walls(self) -> list[tuple[float, float]]:
        """Position and velocity of the walls left, right, bottom, top; empty where none of them moves."""
        return self._core.walls

    @property
    def state_hash(self) -> str:
        """16 hexadecimal digits: runs that end with equal hashes have ended in the same bits, whatever ran them."""
        return self._core.state_hash

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, State):
            return NotImplemented
        return self.state_hash == other.state_hash and bool(np.array_equal(self.images, other.images))

    def __hash__(self) -> int:
        return hash(self.state_hash)

    def __repr__(self) -> str:
        return f"<carom.State of {self.count} disks at time {self.time:g}, state_hash {self.state_hash}>"

    def __reduce__(self) -> tuple[Any, ...]:
        core = self._core
        spins = core.spins if len(core.spins) else None
        remainders = core.remainders if len(core.remainders) else None
        arrays = tuple(None if a is None else np.array(a) for a in (core.positions, core.velocities, core.images, spins))
        return _unpickled, (*arrays, core.time, core.scale, core.walls, core.bonds, core.shear_displacement, remainders, core.pairs_in_steps)


def _unpickled(*arguments: Any) -> State:
    return State._of(_core.State(*arguments))


def state_of_frame(
    positions: Floats,
    velocities: Floats | None,
    images: Integers | None,
    spins: Floats | None,
    time: float,
    scale: float,
    walls: Floats,
    shear_displacement: float,
) -> State:
    """Returns the state of one frame. `walls` has shape (4, 2), and is not a number where no wall moves."""
    moving = [] if np.isnan(walls[0, 0]) else [(float(place), float(velocity)) for place, velocity in walls]
    rows = (positions, velocities, images, spins)
    return State._of(_core.State(*rows, float(time), float(scale), moving, shear_displacement=float(shear_displacement)))


class Frames:
    """States at equal distances in time. All arrays begin with the axis of frames, F of them, and are read-only.

    Attributes:
        time: shape (F,).
        scale: shape (F,): radii at frame k are scale[k] * radii.
        collisions: shape (F,), pair collisions since time 0.
        virial: shape (F,), the sum of sigma_ij times the normal impulse over these; mass length^2 / time.
        radii: shape (N,), length.
        masses: shape (N,).
        species: shape (N,), numbers of the species that `scene.species` names.
        scene: the scene.
        state_hash: that of the simulation when sampling ended.
        interrupted: whether Ctrl-C has ended it.
    """

    def __init__(
        self,
        *,
        time: Floats,
        positions: Floats | None,
        velocities: Floats | None,
        images: Integers | None,
        spins: Floats | None,
        walls: Floats,
        scale: Floats,
        shear_displacement: Floats,
        collisions: npt.NDArray[np.uint64],
        virial: Floats,
        radii: Floats,
        masses: Floats,
        species: npt.NDArray[np.int32],
        scene: Scene,
        state_hash: str = "",
        interrupted: bool = False,
    ) -> None:
        self.time = time
        self._positions = positions
        self._velocities = velocities
        self._images = images
        self._spins = spins
        self._walls = walls
        self._shear_displacement = shear_displacement
        self.scale = scale
        self.collisions = collisions
        self.virial = virial
        self.radii = radii
        self.masses = masses
        self.species = species
        self.scene = scene
        self.state_hash = state_hash
        self.interrupted = interrupted

    @property
    def positions(self) -> Floats:
        """Positions, shape (F, N, 2), length; along periodic axes inside the box. Raises ValueError where they were not sampled."""
        if self._positions is None:
            raise ValueError("these frames have no positions; sample with positions=True")
        return self._positions

    @property
    def velocities(self) -> Floats:
        """Velocities, shape (F, N, 2), length / time. Raises ValueError where they were not sampled."""
        if self._velocities is None:
            raise ValueError("these frames have no velocities; sample with velocities=True")
        return self._velocities

    @property
    def images(self) -> Integers:
        """Numbers of box lengths travelled past periodic edges, shape (F, N, 2); 0 along walled axes. Sampled with the positions."""
        if self._images is None:
            return np.broadcast_to(np.int64(0), self.positions.shape)
        return self._images

    @property
    def spins(self) -> Floats:
        """Angular velocities, shape (F, N), 1 / time, counter-clockwise; shape (F, 0) where disks have none."""
        return np.empty((len(self), 0)) if self._spins is None else self._spins

    def __repr__(self) -> str:
        what = [name for name in ("positions", "velocities") if getattr(self, f"_{name}") is not None]
        return (
            f"<carom.Frames, {len(self)} of {len(self.radii)} disks, with {' and '.join(what) or 'neither positions nor velocities'}, "
            f"state_hash {self.state_hash}{', interrupted' if self.interrupted else ''}>"
        )

    def __len__(self) -> int:
        return len(self.time)

    @overload
    def __getitem__(self, k: int) -> State: ...

    @overload
    def __getitem__(self, k: slice) -> Frames: ...

    def __getitem__(self, k: int | slice) -> State | Frames:
        """Returns frame k, counted from the end where k is negative, or for a slice the frames of it, in the same memory. Where
        velocities were not kept the disks of a frame are at rest."""
        if isinstance(k, slice):
            return self._part(k)
        k = frame_number(k, len(self))

        def row(array: Any) -> Any:
            return None if array is None else np.ascontiguousarray(array[k])

        return state_of_frame(
            row(self.positions),
            row(self._velocities),
            row(self._images),
            row(self._spins),
            self.time[k],
            self.scale[k],
            self._walls[k],
            self._shear_displacement[k],
        )

    def _part(self, k: slice) -> Frames:
        part = copy.copy(self)
        for name in ("time", "scale", "collisions", "virial", "_positions", "_velocities", "_images", "_spins", "_walls", "_shear_displacement"):
            array = getattr(self, name)
            setattr(part, name, None if array is None else array[k])
        return part

    @property
    def unwrapped(self) -> Floats:
        """Positions that go on past periodic edges, shape (F, N, 2): for displacements. Under shear they jump along x where a disk crosses
        an edge where images slide."""
        if self._images is None:
            return self.positions
        (x0, x1), (y0, y1) = self.scene.box
        lengths = np.array([x1 - x0, y1 - y0])
        return np.asarray(self.positions + self._images * lengths)

    def animate(self, every: int = 1, color: str = "speed", trail: int = 0, interval: float = 30) -> FuncAnimation:
        """Returns the frames as an animation of matplotlib. Obstacles are those of the scene at the time of the frame.

        Args:
            every: shows every n-th frame, n = every.
            color: "speed", "species" or any colour of matplotlib.
            trail: the number of frames over which a disk leaves a trail.
            interval: milliseconds from one frame to the next.
        """
        from carom.animate import animation_of_frames

        return animation_of_frames(self, every=every, color=color, trail=trail, interval=interval)

    def save(self, path: str | PathLike[str]) -> None:
        """Writes all arrays and the scene into an .npz file, for `numpy.load()`. Raises OutputError where it cannot be written, ValueError
        for a name with another ending.

        `walls`, shape (F, 4, 2), has position and velocity of the walls left, right, bottom and top where one of them moves, and
        `shear_displacement`, shape (F,), how far images above are from those below where the box is sheared.
        """
        place = path_text(path, "path")
        if (ending := splitext(place)[1]) != ".npz" and ending[1:2].isalpha():
            raise ValueError(f"{place}: frames are written in numpy's format; name a file that ends in .npz, not in {ending}")
        arrays = {name: getattr(self, name) for name in ("time", "scale", "collisions", "virial", "radii", "masses", "species")} | self._sampled()
        try:
            np.savez(place, scene=np.array(self.scene.toml), state_hash=np.array(self.state_hash), **arrays)
        except OSError as error:
            raise OutputError(f"{place}: cannot write the frames: {error.strerror}") from None

    def _sampled(self) -> dict[str, npt.NDArray[Any]]:
        """The arrays that were sampled and that the scene has."""
        arrays = {"positions": self._positions, "velocities": self._velocities, "images": self._images, "spins": self._spins}
        if not np.isnan(self._walls).all():
            arrays["walls"] = self._walls
        if self._shear_displacement.any():
            arrays["shear_displacement"] = self._shear_displacement
        return {name: array for name, array in arrays.items() if array is not None}

    def to_xarray(self) -> Any:
        """Returns an xarray.Dataset with the coordinates time, disk and axis ("x", "y"). Needs xarray (pip install carom[tables])."""
        import xarray

        dims: dict[str, tuple[str, ...]] = {"positions": ("time", "disk", "axis"), "velocities": ("time", "disk", "axis"), "images": ("time", "disk", "axis")}
        dims |= {"walls": ("time", "wall", "motion"), "shear_displacement": ("time",)}
        variables: dict[str, Any] = {name: (dims.get(name, ("time", "disk")), array) for name, array in self._sampled().items()}
        variables |= {name: (("time",), getattr(self, name)) for name in ("scale", "collisions", "virial")}
        variables |= {name: (("disk",), getattr(self, name)) for name in ("radii", "masses", "species")}
        coordinates: dict[str, Any] = {"time": self.time, "axis": ["x", "y"]}
        if "walls" in variables:
            coordinates |= {"wall": ["left", "right", "bottom", "top"], "motion": ["position", "velocity"]}
        return xarray.Dataset(variables, coords=coordinates, attrs={"scene": self.scene.toml, "state_hash": self.state_hash})

    def to_mdanalysis(self) -> Any:
        """Returns an MDAnalysis.Universe with these positions (z = 0), velocities and times, and an atom per disk.

        The box of each frame begins at 0, follows walls that move, leans where it is sheared, and is as thick as it is long; radii are
        those at scale 1. Needs MDAnalysis.
        """
        from carom._mdanalysis import universe_of

        return universe_of(self)


def frames_of(
    sampled: tuple[Any, ...], properties: tuple[Floats, Floats, npt.NDArray[np.int32]], scene: Scene, state_hash: str, interrupted: bool = False
) -> Frames:
    """Returns the samples of a run as the library has them. `properties` are radii, masses and species."""
    radii, masses, species = properties
    times, positions, velocities, images, spins, walls, scale, shear_displacement, collisions, virial = sampled
    return Frames(
        time=times,
        positions=positions,
        velocities=velocities,
        images=images if any(scene.periodic) else None,
        spins=spins if spins.shape[1] else None,
        walls=walls,
        scale=scale,
        shear_displacement=shear_displacement,
        collisions=collisions,
        virial=virial,
        radii=radii,
        masses=masses,
        species=species,
        scene=scene,
        state_hash=state_hash,
        interrupted=interrupted,
    )
