"""Animations of matplotlib. Needs matplotlib (pip install carom[plot])."""

from __future__ import annotations

import copy
import math
from itertools import product
from typing import TYPE_CHECKING, Any

import numpy as np

from carom._arguments import real, whole
from carom.simulation import _put

if TYPE_CHECKING:
    import numpy.typing as npt
    from matplotlib.animation import FuncAnimation

    from carom.frames import Floats, Frames
    from carom.scene import Scene
    from carom.simulation import Simulation


#: Of obstacles.
_SOLID = "0.35"


class _Picture:
    """A box with its obstacles and disks, drawn in units of the scene. What sticks out of a periodic edge is on the other side too."""

    def __init__(self, scene: Scene, species: npt.NDArray[np.int32], color: str, trail: int = 0) -> None:
        import matplotlib.pyplot as plt
        from matplotlib.collections import EllipseCollection, LineCollection
        from matplotlib.patches import Circle

        (x0, x1), (y0, y1) = scene.box
        self.figure, axes = plt.subplots(figsize=(5, max(1.5, min(10.0, 5 * (y1 - y0) / (x1 - x0)))))
        axes.set(xlim=(x0, x1), ylim=(y0, y1), aspect="equal", xticks=[], yticks=[])
        axes.set_title(scene.title or "carom", fontsize="medium")
        for side, periodic in (("left", 0), ("right", 0), ("bottom", 1), ("top", 1)):
            axes.spines[side].set_linestyle((0, (4, 4)) if scene.periodic[periodic] else "solid")
        if scene.circle is not None:
            centre, radius = scene.circle
            axes.axis("off")
            axes.add_patch(Circle(centre, radius, fill=False, clip_on=False))
        self.middle, self.half, self.periodic = np.array([x0 + x1, y0 + y1]) / 2, np.array([x1 - x0, y1 - y0]) / 2, scene.periodic
        self.color, self.trail, self.past = color, trail, list[Any]()
        self.trails = LineCollection([], linewidths=0.8, colors="0.6")
        axes.add_collection(self.trails)
        self.lines = LineCollection([], linewidths=2.0, colors=_SOLID)
        axes.add_collection(self.lines)
        self.posts, self.disks = (
            EllipseCollection([], [], 0.0, units="xy", offsets=np.empty((0, 2)), offset_transform=axes.transData) for _ in range(2)
        )
        self.posts.set_facecolor(_SOLID)
        axes.add_collection(self.posts)
        self.species = species
        if color == "speed":
            self.disks.set_cmap("viridis")
        elif color == "species":
            self.disks.set_cmap("tab10")
            self.disks.set_clim(0, 9)
        else:
            self.disks.set_facecolor(color)
        axes.add_collection(self.disks)
        self.clock = axes.text(0.01, 0.99, "", transform=axes.transAxes, va="top", fontsize="small")

    def _images(self, places: Floats, radii: Floats, displacement: float = 0.0) -> tuple[npt.NDArray[np.intp], Floats]:
        """Returns the numbers of disks and where they are, these disks first, then those images of them that reach into the box. Images
        above are `displacement` to the right."""
        numbers, found = [np.arange(len(places))], [places]
        for right, up in product(range(-2, 3) if self.periodic[0] else (0,), (-1, 0, 1) if self.periodic[1] else (0,)):
            if right == up == 0:
                continue
            shifted = places + [2 * right * self.half[0] + up * displacement, 2 * up * self.half[1]]
            seen = (np.abs(shifted - self.middle) < self.half + radii[:, None]).all(axis=1)
            numbers.append(np.flatnonzero(seen))
            found.append(shifted[seen])
        return np.concatenate(numbers), np.concatenate(found)

    def set_obstacles(self, obstacles: list[dict[str, Any]]) -> None:
        """Draws these obstacles, tables of the scene format."""
        posts = [entry["disk"] for entry in obstacles if "disk" in entry]
        radii = np.array([post["radius"] for post in posts])
        numbers, places = self._images(np.array([post["centre"] for post in posts]).reshape(-1, 2), radii)
        self.posts.set(offsets=places, widths=2 * radii[numbers], heights=2 * radii[numbers])
        lines = [np.array([line["from"], line["to"]]) for entry in obstacles if (line := entry.get("segment"))]
        for arc in (entry["arc"] for entry in obstacles if "arc" in entry):
            angles = np.radians(np.linspace(arc["from"], arc["to"], 181))
            lines.append(arc["centre"] + arc["radius"] * np.stack([np.cos(angles), np.sin(angles)], axis=1))
        self.lines.set_segments(lines)

    def show(self, time: float, positions: Floats, velocities: Floats | None, radii: Floats, displacement: float) -> tuple[Any, ...]:
        """Moves the disks; returns what has changed."""
        numbers, places = self._images(positions, radii, displacement)
        self.disks.set(offsets=places, widths=2 * radii[numbers], heights=2 * radii[numbers])
        if self.color == "speed" and velocities is not None:
            speeds = np.hypot(velocities[:, 0], velocities[:, 1])
            self.disks.set_array(speeds[numbers])
            if self.disks.norm.vmax is None:
                self.disks.set_clim(0, 2.5 * float(np.sqrt((speeds**2).mean())) or 1.0)
        elif self.color == "species":
            self.disks.set_array(self.species[numbers].astype(float))
        if self.trail:
            self.past = [*self.past[-self.trail :], np.array(positions)]
            paths = np.swapaxes(np.array(self.past), 0, 1)
            # A disk that has crossed a periodic edge leaves a gap, and no line through the box.
            jumps = (np.abs(np.diff(paths, axis=1)) > self.half).any(axis=2)
            paths[:, 1:][jumps] = np.nan
            self.trails.set_segments(list(paths))
        self.clock.set_text(f"t = {time:.4g}")
        return self.trails, self.disks, self.clock, self.lines, self.posts


def _obstacles_in_time(scene: Scene) -> list[tuple[float, list[dict[str, Any]]]]:
    """Returns the obstacles of a scene, and those after each of its changes, with the time after which they are there."""
    import tomllib

    tables = scene.to_dict()
    acting = {"obstacles": tables.get("obstacles", [])}
    history = [(-math.inf, acting["obstacles"])]
    for change in tables.get("changes", []):
        acting = copy.deepcopy(acting)
        if "add_obstacle" in change:
            acting["obstacles"].append(change["add_obstacle"])
        elif "remove_obstacle" in change:
            del acting["obstacles"][change["remove_obstacle"]]
        for key, value in (entry.split("=", 1) for entry in change.get("set", [])):
            if key.strip().startswith("obstacles"):
                _put(acting, key.strip().split("."), tomllib.loads(f"value = {value}")["value"])
        history.append((change["time"], acting["obstacles"]))
    return history


def animation_of_frames(frames: Frames, *, every: int, color: str, trail: int, interval: float) -> FuncAnimation:
    """Frames as an animation: see Frames.animate()."""
    from matplotlib.animation import FuncAnimation

    positions, velocities = frames.positions, frames._velocities
    every, trail = whole(every, "every", least=1), whole(trail, "trail")
    if color == "speed" and velocities is None:
        raise ValueError('these frames have no velocities for color="speed"; sample with velocities=True, or take another colour')
    picture = _Picture(frames.scene, frames.species, color, trail)

    history = _obstacles_in_time(frames.scene)

    def show(k: int) -> tuple[Any, ...]:
        if k == 0:
            picture.past = []
        time, moving = float(frames.time[k]), None if velocities is None else velocities[k]
        picture.set_obstacles(next(obstacles for since, obstacles in reversed(history) if since < time))
        return picture.show(time, positions[k], moving, frames.radii * frames.scale[k], float(frames._shear_displacement[k]))

    return FuncAnimation(picture.figure, show, frames=range(0, len(frames), every), interval=real(interval, "interval"), blit=True)


def live_animation(simulation: Simulation, dt: float, frames: int | None, *, color: str, interval: float) -> FuncAnimation:
    """A simulation that runs as it is shown: see Simulation.animate()."""
    from matplotlib.animation import FuncAnimation

    dt = real(dt, "dt")
    if not dt > 0:
        raise ValueError(f"frames are {dt:g} apart; that must be positive")
    frames = None if frames is None else whole(frames, "frames", least=1)
    picture = _Picture(simulation.scene, simulation.species, color)
    begin = simulation.time

    def show(k: int) -> tuple[Any, ...]:
        simulation.run_until(begin + k * dt)
        state = simulation.state
        picture.set_obstacles(_obstacles_in_time(simulation.scene)[0][1])
        radii, displacement = simulation.radii * state.scale, state._core.shear_displacement
        return picture.show(simulation.time, state.positions, state.velocities, radii, displacement)

    return FuncAnimation(picture.figure, show, frames=frames, interval=real(interval, "interval"), blit=True, cache_frame_data=False)
