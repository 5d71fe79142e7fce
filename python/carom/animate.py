"""Animations of matplotlib. Needs matplotlib (pip install carom[plot])."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from carom._arguments import real, whole

if TYPE_CHECKING:
    import numpy.typing as npt
    from matplotlib.animation import FuncAnimation

    from carom.frames import Floats, Frames
    from carom.scene import Scene
    from carom.simulation import Simulation


class _Picture:
    """A box with its disks, drawn in units of the scene."""

    def __init__(self, scene: Scene, radii: Floats, species: npt.NDArray[np.int32], color: str, trail: int = 0) -> None:
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
        self.half = np.array([x1 - x0, y1 - y0]) / 2
        self.color, self.trail, self.past = color, trail, list[Any]()
        self.trails = LineCollection([], linewidths=0.8, colors="0.6")
        axes.add_collection(self.trails)
        widths = 2 * radii
        self.disks = EllipseCollection(
            widths, widths, np.zeros_like(widths), units="xy", offsets=np.zeros((len(radii), 2)), offset_transform=axes.transData
        )
        if color == "speed":
            self.disks.set_cmap("viridis")
        elif color == "species":
            self.disks.set_cmap("tab10")
            self.disks.set_array(species.astype(float))
            self.disks.set_clim(0, 9)
        else:
            self.disks.set_facecolor(color)
        axes.add_collection(self.disks)
        self.clock = axes.text(0.01, 0.99, "", transform=axes.transAxes, va="top", fontsize="small")

    def show(self, time: float, positions: Floats, velocities: Floats | None, radii: Floats) -> tuple[Any, ...]:
        """Moves the disks; returns what has changed."""
        self.disks.set_offsets(positions)
        self.disks.set(widths=2 * radii, heights=2 * radii)
        if self.color == "speed" and velocities is not None:
            speeds = np.hypot(velocities[:, 0], velocities[:, 1])
            self.disks.set_array(speeds)
            if self.disks.norm.vmax is None:
                self.disks.set_clim(0, 2.5 * float(np.sqrt((speeds**2).mean())) or 1.0)
        if self.trail:
            self.past = [*self.past[-self.trail :], np.array(positions)]
            paths = np.swapaxes(np.array(self.past), 0, 1)
            # A disk that has crossed a periodic edge leaves a gap, and no line through the box.
            jumps = (np.abs(np.diff(paths, axis=1)) > self.half).any(axis=2)
            paths[:, 1:][jumps] = np.nan
            self.trails.set_segments(list(paths))
        self.clock.set_text(f"t = {time:.4g}")
        return self.trails, self.disks, self.clock


def animation_of_frames(frames: Frames, *, every: int, color: str, trail: int, interval: float) -> FuncAnimation:
    """Frames as an animation: see Frames.animate()."""
    from matplotlib.animation import FuncAnimation

    positions, velocities = frames.positions, frames._velocities
    every, trail = whole(every, "every", least=1), whole(trail, "trail")
    if color == "speed" and velocities is None:
        raise ValueError('these frames have no velocities for color="speed"; sample with velocities=True, or take another colour')
    picture = _Picture(frames.scene, frames.radii, frames.species, color, trail)

    def show(k: int) -> tuple[Any, ...]:
        if k == 0:
            picture.past = []
        return picture.show(
            float(frames.time[k]), positions[k], None if velocities is None else velocities[k], frames.radii * frames.scale[k]
        )

    return FuncAnimation(picture.figure, show, frames=range(0, len(frames), every), interval=real(interval, "interval"), blit=True)


def live_animation(simulation: Simulation, dt: float, frames: int | None, *, color: str, interval: float) -> FuncAnimation:
    """A simulation that runs as it is shown: see Simulation.animate()."""
    from matplotlib.animation import FuncAnimation

    dt = real(dt, "dt")
    if not dt > 0:
        raise ValueError(f"frames are {dt:g} apart; that must be positive")
    frames = None if frames is None else whole(frames, "frames", least=1)
    picture = _Picture(simulation.scene, simulation.radii, simulation.species, color)
    begin = simulation.time

    def show(k: int) -> tuple[Any, ...]:
        simulation.run_until(begin + k * dt)
        state = simulation.state
        return picture.show(simulation.time, state.positions, state.velocities, simulation.radii * state.scale)

    return FuncAnimation(picture.figure, show, frames=frames, interval=real(interval, "interval"), blit=True, cache_frame_data=False)
