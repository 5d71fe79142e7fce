"""Memory for the frames of a simulation, which the engine fills."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any

import numpy as np

from carom.frames import Frames, State, state_of_frame

if TYPE_CHECKING:
    from carom.frames import Floats
    from carom.scene import Scene
    from carom.simulation import Simulation


def require_memory(frames: int, disks: int, bytes_per_frame: int, advice: str) -> None:
    """Raises MemoryError, with advice, where frames cannot fit into this machine."""
    if frames * bytes_per_frame > os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES"):
        raise MemoryError(f"{frames:,} frames of {disks:,} disks take {frames * bytes_per_frame / 1e9:.2g} GB; {advice}")


class FrameMemory:
    """The arrays into which the engine writes frames. Their names are those of the arguments of `run_sampled`.

    Args:
        simulation: the one that writes the frames.
        count: how many frames there is memory for.
        positions, velocities: whether they are kept.
        radii: those to which the scale of a frame refers; None: the radii at each frame.

    Raises:
        MemoryError: where the frames cannot fit into this machine.
    """

    def __init__(self, simulation: Simulation, count: int, positions: bool, velocities: bool, radii: Floats | None = None) -> None:
        disks = simulation.count
        periodic = any(simulation.scene.periodic)
        may_become_rough = "roughness" in str(simulation.scene.to_dict().get("changes", ""))
        spins = disks if len(simulation.spins) or may_become_rough else 0
        per_frame = 16 * disks * (positions + velocities + (positions and periodic)) + 8 * spins + 104
        require_memory(count, disks, per_frame, "iterate over sim.frames(dt, until), or give a stride")
        self.time, self.scale, self.shear_displacement, self.virial = (np.empty(count) for _ in range(4))
        self.walls = np.empty((count, 4, 2))
        self.collisions = np.empty(count, np.uint64)
        self.positions = np.empty((count, disks, 2)) if positions else None
        self.velocities = np.empty((count, disks, 2)) if velocities else None
        self.images = np.empty((count, disks, 2), np.int64) if positions and periodic else None
        self.spins = np.empty((count, spins)) if spins else None
        self.written = np.zeros(1, np.int64)
        (x0, x1), (y0, y1) = simulation.scene.box
        self.first_box = (x0, x1, y0, y1)
        self.first_radius = None if radii is None or not len(radii) else float(radii[0])

    def state(self) -> State:
        """Returns the first frame, which has memory of its own."""

        def row(array: Any) -> Any:
            return None if array is None else array[0]

        return state_of_frame(
            row(self.positions),
            row(self.velocities),
            row(self.images),
            row(self.spins),
            self.time[0],
            self.scale[0],
            self.walls[0],
            self.shear_displacement[0],
        )

    def frames(self, simulation: Simulation, scene: Scene, radii: Floats, interrupted: bool) -> Frames:
        """Returns the frames that have been written, in the same memory, which cannot be written from then on. `scene` and `radii` are those
        of the first frame, to which scale and walls refer."""
        count = int(self.written[0])

        def done(array: Any) -> Any:
            if array is None:
                return None
            array.flags.writeable = False
            return array[:count]

        return Frames(
            time=done(self.time),
            positions=done(self.positions),
            velocities=done(self.velocities),
            images=done(self.images),
            spins=done(self.spins),
            walls=done(self.walls),
            scale=done(self.scale),
            shear_displacement=done(self.shear_displacement),
            collisions=done(self.collisions),
            virial=done(self.virial),
            radii=radii,
            masses=simulation.masses,
            species=simulation.species,
            scene=scene,
            state_hash=simulation.state_hash,
            interrupted=interrupted,
        )
