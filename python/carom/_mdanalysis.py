"""Frames as a trajectory in memory of MDAnalysis."""

from __future__ import annotations

from typing import Any

import MDAnalysis
import numpy as np
import numpy.typing as npt
from MDAnalysis.coordinates.memory import MemoryReader

from carom.frames import Frames


class TimedReader(MemoryReader):  # type: ignore[misc,unused-ignore]
    """A trajectory in memory whose frames may lie at any times, which MemoryReader takes for equally far apart."""

    def __init__(self, *arguments: Any, times: npt.NDArray[np.float64], **options: Any) -> None:
        self._times = times
        super().__init__(*arguments, times=times, **options)

    def _read_next_timestep(self, ts: Any = None) -> Any:
        step = super()._read_next_timestep(ts)
        step.time = float(self._times[step.frame])
        return step


def universe_of(frames: Frames) -> Any:
    """Returns the MDAnalysis.Universe of `Frames.to_mdanalysis()`."""
    disks = len(frames.radii)

    def in_space(array: npt.NDArray[np.float64]) -> npt.NDArray[np.float32]:
        spatial = np.zeros((len(frames), disks, 3), np.float32)
        spatial[:, :, :2] = array
        return spatial

    velocities = None if frames._velocities is None else in_space(frames._velocities)
    universe = MDAnalysis.Universe.empty(disks, trajectory=True, velocities=velocities is not None)
    universe.add_TopologyAttr("radii", frames.radii)
    universe.add_TopologyAttr("masses", frames.masses)
    dt = float(frames.time[1] - frames.time[0]) if len(frames) > 1 else 1.0
    universe.load_new(
        in_space(frames.positions), format=TimedReader, dimensions=_boxes(frames), dt=dt, velocities=velocities, times=frames.time
    )
    return universe


def _boxes(frames: Frames) -> npt.NDArray[np.float32]:
    """Returns lengths and angles in degrees, shape (F, 6). Boxes are as thick as they are long, so that no disk meets its images in z."""
    (x0, x1), (y0, y1) = frames.scene.box
    moving = ~np.isnan(frames._walls[:, 0, 0])
    places = np.where(moving[:, None], frames._walls[:, :, 0], (x0, x1, y0, y1))
    lengths = places[:, 1::2] - places[:, ::2]
    tilt = frames._shear_displacement
    tilt = np.where(tilt > lengths[:, 0] / 2, tilt - lengths[:, 0], tilt)
    boxes = np.full((len(frames), 6), 90.0, np.float32)
    boxes[:, 0] = lengths[:, 0]
    boxes[:, 1] = np.hypot(tilt, lengths[:, 1])
    boxes[:, 2] = lengths.max(axis=1)
    boxes[:, 5] = np.degrees(np.arctan2(lengths[:, 1], tilt))
    return boxes
