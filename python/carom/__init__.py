"""Carom: hard disks in a box, moved exactly from collision to collision.

>>> import carom
>>> sim = carom.Simulation(carom.Scene.preset("box"))
>>> frames = sim.sample(dt=0.001, until=5.0)
>>> frames.positions.shape
(5001, 64, 2)

A `Scene` says what is to be simulated, with the keys of the scene format. A `Simulation` moves the disks; `run()` does a scene's whole
schedule with its observables, and writes files where it is told to. What the program `carom` does, these do with the same bits.
"""

from importlib import import_module as _import_module
from typing import TYPE_CHECKING as _TYPE_CHECKING

from carom._errors import Interrupted, OutputError, SceneError, StoppedEarly
from carom._events import EVENT, Event, partner_name
from carom.frames import Frames, State
from carom.scene import Check, Scene, build, presets
from carom.simulation import CollidingPair, Simulation, Stop, engines, fixed_step_methods

if _TYPE_CHECKING:
    from carom.horizons import Horizon, LyapunovSpectrum, horizon, lyapunov_spectrum
    from carom.observables import COLLISION, Blocking, Observable
    from carom.pages import Page, Player
    from carom.results import Measurement, Number, Table
    from carom.runs import Result, resume, run
    from carom.starts import Start, read_start
    from carom.stored_runs import Run, open_run
    from carom.studies import (
        Comparison,
        Difference,
        Validation,
        beside,
        compare,
        diff,
        hard_case_names,
        hardcases,
        validate,
        validation_trials,
    )
    from carom.structure import clusters, voronoi
    from carom.sweeps import Sweep, sweep

#: Names by the module that is imported where one of them is first asked for: a simulation needs none of these.
_LATER = {
    "horizons": ("Horizon", "LyapunovSpectrum", "horizon", "lyapunov_spectrum"),
    "observables": ("COLLISION", "Blocking", "Observable"),
    "pages": ("Page", "Player"),
    "results": ("Measurement", "Number", "Table"),
    "runs": ("Result", "resume", "run"),
    "starts": ("Start", "read_start"),
    "stored_runs": ("Run", "open_run"),
    "studies": (
        "Comparison",
        "Difference",
        "Validation",
        "beside",
        "compare",
        "diff",
        "hard_case_names",
        "hardcases",
        "validate",
        "validation_trials",
    ),
    "structure": ("clusters", "voronoi"),
    "sweeps": ("Sweep", "sweep"),
}
_MODULES = {name: module for module, names in _LATER.items() for name in names}


def __getattr__(name: str) -> object:
    if name not in _MODULES:
        raise AttributeError(f"module 'carom' has no attribute {name!r}")
    value: object = getattr(_import_module(f"carom.{_MODULES[name]}"), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted({*globals(), *_MODULES})


__version__ = build()["version"]

__all__ = [
    "COLLISION",
    "EVENT",
    "Blocking",
    "Check",
    "CollidingPair",
    "Comparison",
    "Difference",
    "Event",
    "Frames",
    "Horizon",
    "Interrupted",
    "LyapunovSpectrum",
    "Measurement",
    "Number",
    "Observable",
    "OutputError",
    "Page",
    "Player",
    "Result",
    "Run",
    "Scene",
    "SceneError",
    "Simulation",
    "Start",
    "State",
    "Stop",
    "StoppedEarly",
    "Sweep",
    "Table",
    "Validation",
    "beside",
    "build",
    "clusters",
    "compare",
    "diff",
    "engines",
    "fixed_step_methods",
    "hard_case_names",
    "hardcases",
    "horizon",
    "lyapunov_spectrum",
    "open_run",
    "partner_name",
    "presets",
    "read_start",
    "resume",
    "run",
    "sweep",
    "validate",
    "validation_trials",
    "voronoi",
]
