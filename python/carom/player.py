"""Runs to watch: at any instant, forwards and backwards, at any speed."""

from __future__ import annotations

from os import PathLike, fspath
from typing import TYPE_CHECKING

from carom import _files
from carom._arguments import real
from carom.pages import Page, Player

if TYPE_CHECKING:
    from carom.simulation import Simulation

_MOST_SAMPLES = 1000
_MOST_STATES = 1_000_000  # of single disks, 32 bytes each


def play(simulation: Simulation, until: float) -> Player:
    """Runs up to `until` as `run_until()` does, and returns that part of the run as a player, whose clock begins at 0.

    A player holds up to a million collisions; a longer run is drawn between samples, and so is one by a fixed-step method. Where
    Ctrl-C interrupts it, the simulation stands whole where it was interrupted.

    Args:
        simulation: a simulation, wherever it stands.
        until: its time at the end.

    Returns:
        the player. Where the disks could not go on, a StoppedEarly warning says so too.
    """
    from carom.simulation import as_stop

    end = real(until, "until")
    most = _files.most_events_of_a_player
    samples = max(2, min(_MOST_SAMPLES, _MOST_STATES // max(1, simulation.count)))
    step = (end - simulation.time) / samples
    simulation._moved()
    states, log, reason = simulation._core.record_for_player(end, step if step > 0.0 else 1.0, most)
    why_no_log = f"it has more than the {most} events that a page can hold"
    if simulation.dt is not None:
        why_no_log = "a fixed-step method has no collisions between two steps"
    facts = [("Engine", simulation.engine), ("Stopped by", reason)]
    scene = simulation.scene._core
    page = _files.player_in_memory(scene, *simulation._properties(), states, log, why_no_log, facts)
    as_stop(reason, simulation.time)
    return Player(*page)


def player_of(directory: str | PathLike[str]) -> Player:
    """Returns the player of a run in a directory, as `carom play` makes it. Raises OutputError where it cannot be read."""
    return Player(*_files.player_of(fspath(directory)))


def report_of(directory: str | PathLike[str]) -> Page:
    """Returns the page of a run in a directory, as `carom report` makes it. Raises OutputError where it cannot be read."""
    return Page(_files.report_of(fspath(directory)), height=900)
