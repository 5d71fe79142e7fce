"""How far a trajectory can be trusted: horizons in several precisions, and Lyapunov exponents.

The studies are the program's, `carom horizon` and `carom horizon --spectrum`, with the same numbers and sentences.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from carom import _arguments
from carom._progress import Progress, reporting
from carom._study_tools import column_of_numbers, column_of_words, naming_arguments, paragraphs
from carom.results import Number, Table
from carom.scene import SceneLike, as_scene

if TYPE_CHECKING:
    from matplotlib.axes import Axes


@dataclass(frozen=True, eq=False)
class Horizon:
    """How far a trajectory can be trusted: the same start in 24, 53, 64 and 113 bits, each held against the next better one.

    Attributes:
        summary: everything in numbers, as `carom horizon --json` prints it.
        sentence: until when the trajectory is right, in one sentence.
        rows: a row for each precision. `time` is the time until which positions are right, nan where they are to the end or that is
            not known; `estimated` says whether it is extrapolated. `first_difference` is the number of the first collision that
            differs, counted from 1, nan where none does; `price` is processor time over that of double precision.
        lyapunov: the largest Lyapunov exponent, 1 / time; None where pairs of disks collide too rarely.
    """

    summary: dict[str, Any] = field(repr=False)
    sentence: str
    rows: Table = field(repr=False)
    lyapunov: Number | None
    _text: str = field(repr=False)

    def plot(self, ax: Axes | None = None) -> Axes:
        """Draws the time until which each precision is right over its bits. Needs matplotlib.

        Args:
            ax: where to draw; None: a figure of its own.
        """
        import matplotlib.pyplot as plt

        axes = plt.subplots()[1] if ax is None else ax
        for estimated, label in ((False, "measured"), (True, "extrapolated")):
            chosen = self.rows["estimated"] == estimated
            face = "none" if estimated else None
            axes.plot(self.rows["bits"][chosen], self.rows["time"][chosen], "o", markerfacecolor=face, label=label)
        all_bits, labelled = self.rows["bits"], list[int]()
        for bits, time, engine in zip(all_bits, self.rows["time"], self.rows["engine"], strict=True):
            if not math.isnan(time):
                # Labels of the same bits are on either side, and those on the right of the picture reach inwards.
                to_left = bool(bits > (all_bits.min() + all_bits.max()) / 2) != (bits in labelled)
                labelled.append(bits)
                style: dict[str, Any] = {"fontsize": "small", "verticalalignment": "bottom", "horizontalalignment": "right" if to_left else "left"}
                axes.annotate(engine, (bits, time), (-4 if to_left else 4, 2), textcoords="offset points", **style)
        axes.set_xlabel("bits of the significand")
        axes.set_ylabel(f"right until (time), every disk within {self.summary['horizon']['tolerance']:g} diameters")
        axes.legend()
        return axes

    def __str__(self) -> str:
        return self._text + "\n" + self.sentence

    def _repr_html_(self) -> str:
        return paragraphs([self.sentence]) + self.rows._repr_html_()


@dataclass(frozen=True, eq=False)
class LyapunovSpectrum:
    """All Lyapunov exponents of a scene, and the rate at which its trajectories lose the memory of their start.

    Attributes:
        summary: everything in numbers, as `carom horizon --spectrum --json` prints it.
        exponents: a row for each of the 4 N exponents of N disks, the largest first: `exponent` and its standard error, 1 / time; the
            error is nan where the run is too short.
        entropy: the Kolmogorov-Sinai entropy, the sum of the positive exponents, 1 / time.
        pairing: the largest sum of an exponent and its partner, the first and the last, the second and the last but one, and so on,
            1 / time; 0 to rounding where the dynamics is Hamiltonian.
        collision_rate: collisions of one disk per time, the natural unit of the exponents.
    """

    summary: dict[str, Any] = field(repr=False)
    exponents: Table = field(repr=False)
    entropy: Number
    pairing: float
    collision_rate: float
    _text: str = field(repr=False)

    def plot(self, ax: Axes | None = None) -> Axes:
        """Draws the exponents over their numbers. Needs matplotlib.

        Args:
            ax: where to draw; None: a figure of its own.
        """
        import matplotlib.pyplot as plt

        axes = plt.subplots()[1] if ax is None else ax
        values, errors = self.exponents["exponent"], np.nan_to_num(self.exponents["exponent_error"])
        axes.errorbar(np.arange(1, len(values) + 1), values, errors, fmt=".")
        axes.axhline(0.0, color="gray", linewidth=0.5)
        axes.set_xlabel("number of the exponent")
        axes.set_ylabel("Lyapunov exponent (1 / time)")
        return axes

    def __str__(self) -> str:
        return self._text.rstrip("\n")

    def _repr_html_(self) -> str:
        return self.exponents._repr_html_()


def horizon(
    scene: SceneLike, *, engine: str = "auto", collisions: int | None = None, progress: Progress | None = None
) -> Horizon:
    """Measures how far a scene's trajectory can be trusted.

    Args:
        scene: a Scene, the path of a scene file, or a mapping.
        engine: the one that is to run the scene, whose precision the sentence is about: "auto", or one of `carom.engines()`.
        collisions: pair collisions over which the Lyapunov exponent is measured; None: half a million, or 100 per disk.
        progress: True for a bar (needs tqdm), or a function of the fraction done.

    Raises:
        SceneError: where the scene is wrong; ValueError: where an argument is, or something acts that the study does not know.
    """
    import json

    from carom import _files

    core = as_scene(scene)._core
    count = None if collisions is None else _arguments.whole(collisions, "collisions")
    with naming_arguments(), reporting(progress, "horizon") as report_fraction:
        text, table, sentence = _files.horizon(core, _arguments.words(engine, "engine"), count, report_fraction)
    summary: dict[str, Any] = json.loads(text)
    rows = summary["horizon"]["rows"]
    columns: dict[str, npt.ArrayLike] = {
        "engine": column_of_words(row["engine"] for row in rows),
        "bits": [row["bits"] for row in rows],
        "against": column_of_words(row["against"] or "" for row in rows),
        "time": column_of_numbers(row["time"] for row in rows),
        "collisions_per_disk": column_of_numbers(row["collisions_per_disk"] for row in rows),
        "estimated": [row["estimated"] for row in rows],
        "first_difference": column_of_numbers(row["first_difference"] and row["first_difference"]["index"] + 1 for row in rows),
        "first_difference_time": column_of_numbers(row["first_difference"] and row["first_difference"]["time"] for row in rows),
        "seconds": column_of_numbers(row["seconds"] for row in rows),
        "price": column_of_numbers(row["price"] for row in rows),
    }
    units = {"time": "time", "first_difference_time": "time", "seconds": "s"}
    exponent = summary["horizon"]["lyapunov"]
    lyapunov = exponent and Number(exponent["per_time"], exponent["per_time_error"], "1 / time")
    return Horizon(summary, sentence, Table(columns, units, "Horizons"), lyapunov, table)


def lyapunov_spectrum(scene: SceneLike, *, collisions: int | None = None, progress: Progress | None = None) -> LyapunovSpectrum:
    """Measures all Lyapunov exponents of a scene with up to 256 disks, by Benettin's method.

    Args:
        scene: a Scene, the path of a scene file, or a mapping.
        collisions: pair collisions over which they are measured; None: 20,000.
        progress: True for a bar (needs tqdm), or a function of the fraction done.

    Raises:
        SceneError: where the scene is wrong; ValueError: where an argument is, there are too many disks or fewer than two, or
        something acts that the study does not know; RuntimeError: where pairs collide too rarely, or collisions lose energy.
    """
    import json

    from carom import _files

    core = as_scene(scene)._core
    count = None if collisions is None else _arguments.whole(collisions, "collisions")
    with naming_arguments(), reporting(progress, "Lyapunov exponents") as report_fraction:
        text, lines = _files.lyapunov_spectrum(core, count, report_fraction)
    summary: dict[str, Any] = json.loads(text)
    found = summary["lyapunov_spectrum"]
    columns: dict[str, npt.ArrayLike] = {"exponent": found["exponents"], "exponent_error": column_of_numbers(found["errors"])}
    units = {"exponent": "1 / time", "exponent_error": "1 / time"}
    entropy = Number(found["entropy"], found["entropy_error"], "1 / time")
    table = Table(columns, units, "Lyapunov exponents")
    return LyapunovSpectrum(summary, table, entropy, found["pairing"], found["collision_rate"], lines)
