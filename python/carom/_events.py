"""Collisions one by one, and as numpy arrays."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from carom._arguments import whole

if TYPE_CHECKING:
    import numpy.typing as npt

#: The fields of a collision in the arrays that `Simulation.record()` returns, which have the memory of the engine's own log.
EVENT = np.dtype(
    {
        "names": ["time", "time_remainder", "disk", "partner", "velocity", "partner_velocity"],
        "formats": ["f8", "f8", "i4", "i4", ("f8", 2), ("f8", 2)],
        "offsets": [0, 8, 16, 20, 32, 48],
        "itemsize": 64,
    }
)

_WALLS = {-1: "left wall", -2: "right wall", -3: "bottom wall", -4: "top wall"}
_THERMOSTAT = -500
_FIRST_OBSTACLE = -1000


def partner_name(partner: int) -> str:
    """Returns what the number of a partner stands for: "disk 3", "left wall", "obstacle 0", "thermostat"."""
    partner = whole(partner, "the partner", least=-(2**31))
    if partner >= 0:
        return f"disk {partner}"
    if partner <= _FIRST_OBSTACLE:
        return f"obstacle {_FIRST_OBSTACLE - partner}"
    return "thermostat" if partner == _THERMOSTAT else _WALLS.get(partner, f"partner {partner}")


class Event(NamedTuple):
    """One collision.

    Attributes:
        time: when, since the start of the measured run; in units of the scene.
        time_remainder: the exact time minus `time`: their unevaluated sum has twice the digits.
        disk: the disk, the lower id of a pair.
        partner: the other disk; or -1 to -4 for the walls left, right, bottom, top; or -1000 - k for obstacle k; or -500 for a
            new velocity by the thermostat.
        velocity, partner_velocity: of the two just after, (vx, vy); zero for a wall or an obstacle.
    """

    time: float
    time_remainder: float
    disk: int
    partner: int
    velocity: tuple[float, float]
    partner_velocity: tuple[float, float]

    @property
    def partner_name(self) -> str:
        """What the disk met: "disk 3", "left wall", "obstacle 0", "thermostat"."""
        return partner_name(self.partner)


def events_in(memory: npt.NDArray[np.uint8]) -> npt.NDArray[Any]:
    """Returns the bytes of a log as a structured array of dtype EVENT."""
    return memory.view(EVENT)
