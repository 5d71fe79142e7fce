"""A scene brought to life."""

from __future__ import annotations

import math
import os
import warnings
from collections.abc import Callable, Iterator
from enum import StrEnum
from os import PathLike
from typing import TYPE_CHECKING, Any

import numpy as np

from carom import _core
from carom._arguments import numbers, pairs, path_text, real, require_steps_that_fit, shown, whole, words
from carom._errors import OutputError, SceneError, StoppedEarly
from carom._events import Event, events_in
from carom._frame_memory import FrameMemory
from carom._progress import Progress, reporting
from carom._toml import scene_text
from carom.frames import Frames, State
from carom.scene import Scene, SceneLike, as_scene, scene_of_parts

if TYPE_CHECKING:
    import numpy.typing as npt
    from matplotlib.animation import FuncAnimation

    from carom.frames import Floats, Integers
    from carom.pages import Player

#: Two disks in contact, which a collision rule of one's own gets: it sets `velocity` and `partner_velocity`, and reads the rest.
CollidingPair = _core.CollidingPair
CollisionRule = Callable[[_core.CollidingPair], object]

_NONE = 2**64 - 1
_FOREVER = math.inf
_new = tuple.__new__  # without the arguments of a named tuple's own, which cost more than the event
_LATEST = 1e15  # later than any run gets to
_MAGIC = b"carom simulation file 1\n"


class Stop(StrEnum):
    """Why a run returned. A member equals its text: `stop == "jammed"`."""

    TIME = "time"  #: the time asked for was reached
    COLLISIONS = "collisions"  #: the number of pair collisions asked for was reached
    EVENTS = "events"  #: the number of events asked for was reached
    CONDITION = "condition"  #: what the caller asked for was reached
    INTERRUPTED = "interrupted"  #: Ctrl-C, or a limit of real time
    JAMMED = "jammed"  #: time has stopped: disks touch and have no room to move
    COLLAPSED = "collapsed"  #: time has stopped: inelastic disks collide at ever shorter intervals
    OVERHEATED = "overheated"  #: time has all but stopped: disks become ever faster
    COOLED = "cooled"  #: inelastic disks have become too slow to compute with
    GROWN = "grown"  #: the packing fraction or pressure up to which disks were to grow was reached
    AT_REST = "at_rest"  #: drag has stopped the disks
    NO_COLLISIONS = "no_collisions"  #: no pair will ever collide
    BLOCKED = "blocked"  #: carom.run() could not make one of the scene's changes; a Simulation raises SceneError there
    INVALID_STATE = "invalid_state"  #: a number is not finite, or the engine found a fault in its plan

    @property
    def early(self) -> bool:
        """Whether the disks could not go on."""
        return self not in (Stop.TIME, Stop.COLLISIONS, Stop.EVENTS, Stop.CONDITION, Stop.INTERRUPTED, Stop.GROWN)


def as_stop(reason: str, time: float, disks: list[int] | None = None) -> Stop:
    """Returns the reason, with a warning where the disks could not go on."""
    stop = Stop(reason)
    if stop.early:
        which = f" (disks {', '.join(map(str, disks[:8]))}{', ...' if len(disks) > 8 else ''})" if disks else ""
        warnings.warn(f"the run ended early, at time {time:g}: {stop}{which}", StoppedEarly, stacklevel=3)
    return stop


class Simulation:
    """Disks that move from event to event, exactly.

    >>> sim = carom.Simulation(carom.Scene.preset("box"))
    >>> sim.run_until(5.0)
    <Stop.TIME: 'time'>
    >>> sim.positions.shape
    (64, 2)

    The same scene and seed give the same bits as the program `carom`, on every machine; `state_hash` tells. Arrays are read-only
    copies of what was there when they were asked for. To move disks by hand, make a state and begin anew:
    `Simulation(scene, state=carom.State(positions, velocities))`; `set_velocities()` changes velocities in passing.

    A simulation belongs to one caller at a time; two threads need one each. Two simulations never share anything.

    Args:
        scene: a Scene, the path of a scene file, or a mapping.
        seed: in place of the scene's run.seed.
        engine: "auto", or one of the names that `carom.engines()` returns.
        method: a fixed-step method in place of exact events: one of `carom.fixed_step_methods()`, such as "naive".
        dt: its step, time.
        stiffness: of the springs of the method "soft", force per overlap; None: such that the shortest contact takes 30 steps.
        state: where the disks begin, in place of the scene's own start.
        threads: how many cores compute it, 1 to 32, to the same bits; see `threads`.
        on_collision: a rule of one's own for collisions of two disks, see `set_collision_rule()`.

    Raises:
        SceneError: where the scene is wrong, or its disks cannot be placed.
        ValueError: where there is no such engine or method, or the state does not fit: the scene has other disks, or these overlap
            each other or a wall by more than rounding and the scene does not say accept_overlap in [run].
    """

    def __init__(
        self,
        scene: SceneLike,
        *,
        seed: int | None = None,
        engine: str = "auto",
        method: str | None = None,
        dt: float | None = None,
        stiffness: float | None = None,
        state: State | None = None,
        on_collision: CollisionRule | None = None,
        threads: int = 1,
    ) -> None:
        given = as_scene(scene)
        if seed is not None:
            given = given.set({"run.seed": seed})
        if (method is None) != (dt is None):
            raise ValueError("a fixed-step method needs both: method=\"naive\" and its step dt=0.001")
        require_steps_that_fit(method, engine, stiffness)
        if state is not None and not isinstance(state, State):
            raise TypeError(f"the state is {shown(state)}; give a carom.State")
        name = None if method is None else words(method, "method")
        step = 0.0 if dt is None else real(dt, "dt")
        spring = None if stiffness is None else real(stiffness, "stiffness")
        start = None if state is None else state._core
        self._begin(given, _core.Simulation(given._core, words(engine, "engine"), name, step, spring, start))
        if on_collision is not None:
            self.set_collision_rule(on_collision)
        if threads != 1:
            self.threads = threads

    def _begin(self, scene: Scene, core: _core.Simulation) -> None:
        self._core = core
        self._made = scene
        self._now: Scene | None = scene
        self._rule: CollisionRule | None = None
        self._state: State | None = None
        self._disks: tuple[Floats, Floats, npt.NDArray[np.int32]] | None = None
        self._trajectory: Frames | None = None
        self._recorded: npt.NDArray[Any] | None = None

    # What it is.

    @property
    def scene(self) -> Scene:
        """The scene, with what acts on the disks now. Where they have grown so far that its start has no room for them, it lists them
        as they are."""
        if self._now is None:
            self._now = Scene._of(self._core.scene, self._made._directory)
        return self._now

    @property
    def engine(self) -> str:
        """The name of the engine, or of the fixed-step method."""
        return self._core.engine

    @property
    def engine_reason(self) -> str:
        """Why that engine, in half a sentence; empty for a fixed-step method."""
        return self._core.engine_reason

    @property
    def dt(self) -> float | None:
        """The step of a fixed-step method; None where events are exact."""
        return self._core.time_step

    @property
    def stiffness(self) -> float | None:
        """The stiffness that was given to the method "soft"; None where none was."""
        return self._core.stiffness

    @property
    def threads(self) -> int:
        """How many cores compute this simulation, 1 to 32; no bit depends on it. May be set at any time.

        Several pay from some 50,000 disks on, on a machine that is not busy with other work; `carom.run()` chooses by itself. While
        an effect acts that has been set since and does not run on several cores, such as shear, it is 1.

        Raises:
            ValueError: where several are asked for and the simulation cannot be shared out; it goes on with one.
        """
        return self._core.threads

    @threads.setter
    def threads(self, threads: int) -> None:
        self._core.set_threads(whole(threads, "threads", least=1, most=32))

    @property
    def thread_counts(self) -> dict[str, int]:
        """What sharing the disks out has taken since `threads` was set: windows, windows_redone, copied_events and others, as
        docs/parallel.md names them."""
        return self._core.thread_counts

    @property
    def count(self) -> int:
        """The number of disks."""
        return len(self.radii)

    def _properties(self) -> tuple[Floats, Floats, npt.NDArray[np.int32]]:
        if self._disks is None:
            self._disks = self._core.disks()
        return self._disks

    @property
    def radii(self) -> Floats:
        """Radii, shape (N,), length. Disks that grow have `state.scale` times these."""
        return self._properties()[0]

    @property
    def masses(self) -> Floats:
        """Masses, shape (N,)."""
        return self._properties()[1]

    @property
    def species(self) -> npt.NDArray[np.int32]:
        """The number of the species of each disk, shape (N,); `scene.species` names them."""
        return self._properties()[2]

    # Where it stands.

    @property
    def time(self) -> float:
        """The time since the start of the measured run."""
        return self._core.time

    @property
    def collisions(self) -> int:
        """The number of collisions of two disks since time 0."""
        return self._core.collisions

    @property
    def totals(self) -> dict[str, Any]:
        """Counts of all events since time 0 by kind, and their sums: virial, impulses to walls, energies."""
        return self._core.totals

    @property
    def state(self) -> State:
        """The exact state now, to rounding. Reading it never changes what follows; it is kept until the clock moves."""
        if self._state is None:
            self._state = State._of(self._core.state())
        return self._state

    @property
    def positions(self) -> Floats:
        """Positions now, shape (N, 2), length; along periodic axes inside the box. Read-only."""
        return self.state.positions

    @property
    def velocities(self) -> Floats:
        """Velocities now, shape (N, 2), length / time. Read-only; `set_velocities()` changes them."""
        return self.state.velocities

    @property
    def images(self) -> Integers:
        """Box lengths travelled past periodic edges, shape (N, 2)."""
        return self.state.images

    @property
    def unwrapped(self) -> Floats:
        """Positions that go on past periodic edges, shape (N, 2)."""
        (x0, x1), (y0, y1) = self.scene.box
        return np.asarray(self.positions + self.images * np.array([x1 - x0, y1 - y0]))

    @property
    def spins(self) -> Floats:
        """Angular velocities, shape (N,), 1 / time; shape (0,) where disks have none."""
        return self.state.spins

    @property
    def kinetic_energy(self) -> float:
        """The kinetic energy of all disks, spins of solid disks included; mass length^2 / time^2."""
        energy = 0.5 * float(self.masses @ (self.velocities**2).sum(axis=1))
        if len(self.spins):
            energy += 0.25 * float((self.masses * (self.radii * self.state.scale) ** 2) @ self.spins**2)
        return energy

    @property
    def state_hash(self) -> str:
        """16 hexadecimal digits of time, positions, velocities and spins: equal where the bits are equal."""
        return self.state.state_hash

    @property
    def trajectory(self) -> Frames:
        """The frames of the last `sample()`, also where it was interrupted. Raises ValueError before the first one."""
        if self._trajectory is None:
            raise ValueError("this simulation has no trajectory yet; sample(dt, until) makes one")
        return self._trajectory

    @property
    def recorded(self) -> npt.NDArray[Any]:
        """The collisions of the last `record()`, also where it was interrupted. Raises ValueError before the first one."""
        if self._recorded is None:
            raise ValueError("this simulation has recorded no collisions yet; record(until) does")
        return self._recorded

    # Going on.

    def _moved(self) -> None:
        """Forgets the state, before it changes."""
        self._state = None
        if self._core.changes_to_come > 0:
            self._now = self._disks = None

    def run(self, duration: float, *, progress: Progress | None = None) -> Stop:
        """Goes on for `duration`. Repeated calls add up with rounding; `sample()` has an exact grid."""
        return self.run_until(self.time + real(duration, "duration"), progress=progress)

    def run_until(self, time: float, collisions: int | None = None, *, progress: Progress | None = None) -> Stop:
        """Processes every event up to and including `time`; an earlier time does nothing. Bits do not depend on where one stops.

        Args:
            time: since the start of the measured run.
            collisions: ends the run earlier, at this number of pair collisions since time 0.
            progress: True for a bar (needs tqdm), or a function of the fraction done.

        Returns:
            why it returned. Where the disks could not go on, a StoppedEarly warning says so too.
        """
        begin, end = self.time, real(time, "time")
        limit = None if collisions is None else whole(collisions, "collisions")
        with reporting(progress, "run") as report_fraction:
            report_time = None if report_fraction is None else lambda now: report_fraction(_fraction(begin, now, end))
            self._moved()
            reason = self._core.run_until(end, limit, report_time)
        return as_stop(reason, self.time)

    def equilibrate(self, *, progress: Progress | None = None) -> Stop:
        """Runs the scene's run.equilibrate and makes then the zero of time, as `carom.run()` does before it measures.

        A scene without it stays where it is. Returns why the equilibration ended.
        """
        asked = self.scene.to_dict()["run"].get("equilibrate")
        if asked is None:
            return Stop.TIME
        if "time" in asked:
            stop = self.run_until(asked["time"], progress=progress)
        else:
            stop = self.run_until(_LATEST, math.ceil(asked["collisions_per_disk"] * self.count / 2), progress=progress)
        if not stop.early:
            self.reset_clock()
        return stop

    def step(self, until: float = _FOREVER) -> Event | None:
        """Goes to the next event up to `until`, and returns it: a collision with a disk, a wall or an obstacle, the edge of a square
        well, or a new velocity by the thermostat. Returns None where there is none; the simulation then stands at `until`."""
        end = until if until is _FOREVER else real(until, "until")
        self._moved()
        event = self._core.step(end)
        return None if event is None else _new(Event, event)

    def events(self, until: float) -> Iterator[Event]:
        """Iterates over all events up to `until`; the simulation stands at the event at hand."""
        while (event := self.step(until)) is not None:
            yield event

    def record(self, until: float) -> npt.NDArray[Any]:
        """Runs up to `until` and returns all collisions on the way as a structured array, in order of time.

        Its fields are time, time_remainder, disk, partner, velocity (2) and partner_velocity (2), as in `Event`. Edges of square
        wells are among them, new velocities by a thermostat are not.

        Raises:
            KeyboardInterrupt: on Ctrl-C. `recorded` has the collisions until then, and the simulation can go on.
        """
        end = real(until, "until")
        self._moved()
        memory, reason, raised = self._core.record(end)
        self._recorded = events_in(memory)
        if isinstance(raised, BaseException):
            raise raised
        as_stop(reason, self.time)
        return self._recorded

    def sample(
        self,
        dt: float,
        until: float,
        *,
        positions: bool = True,
        velocities: bool = True,
        stride: int = 1,
        progress: Progress | None = None,
    ) -> Frames:
        """Runs up to `until` and returns the states at k dt, k whole, from now to then, both included: the program's samples, to the
        last bit, where dt is the scene's run.sample_every.

        Args:
            dt: from one sample to the next; time.
            until: where the run ends.
            positions, velocities: whether they are kept.
            stride: keeps every n-th sample alone, n = stride.
            progress: True for a bar (needs tqdm), or a function of the fraction done.

        Raises:
            MemoryError: where the frames cannot fit into this machine; `frames()` needs no memory for them.
            KeyboardInterrupt: on Ctrl-C. `trajectory` has the frames until then, and the simulation can go on.
        """
        dt, until, stride = real(dt, "dt"), real(until, "until"), whole(stride, "stride", least=1)
        first, count = self._sample_range(dt, until, stride)
        memory = FrameMemory(self, count, bool(positions), bool(velocities), self.radii)
        begin, radii, scene = self.time, self.radii, self.scene
        reason: str | None = None
        with reporting(progress, "sample") as report_fraction:
            report_time = None if report_fraction is None else lambda now: report_fraction(_fraction(begin, now, until))
            self._moved()
            try:
                reason = self._core.run_sampled(until, dt, first, stride, _NONE, **vars(memory), report=report_time)
            finally:
                self._trajectory = memory.frames(self, scene, radii, interrupted=reason is None)
        as_stop(reason, self.time)
        return self._trajectory

    def frames(self, dt: float, until: float, *, stride: int = 1) -> Iterator[State]:
        """Iterates over the states that `sample()` returns, in constant memory. The scale of each refers to `radii` at that time."""
        dt, until, stride = real(dt, "dt"), real(until, "until"), whole(stride, "stride", least=1)
        first, count = self._sample_range(dt, until, stride)
        memory = FrameMemory(self, 1, True, True)
        for k in range(first, first + count * stride, stride):
            if k * dt < self.time - 1e-9 * dt:  # the caller has moved on meanwhile
                continue
            memory.written[0] = 0
            self._moved()
            reason = self._core.run_sampled(until, dt, k, stride, 1, **vars(memory), report=None)
            if not memory.written[0]:
                as_stop(reason, self.time)
                return
            yield memory.state()
            as_stop(reason, self.time)
            if Stop(reason).early:
                return

    def _sample_range(self, dt: float, until: float, stride: int) -> tuple[int, int]:
        if not (dt > 0 and math.isfinite(dt)):
            raise ValueError(f"samples are {dt:g} apart; that must be positive and finite")
        if not math.isfinite(until):
            raise ValueError("a simulation runs to a finite time only")
        if until / 2**53 > dt:
            raise ValueError(f"samples {dt:g} apart until {until:g} would be more than 2^53; give a larger dt")
        return self._core.sample_range(until, dt, 0, stride)

    def play(self, until: float) -> Player:
        """Runs up to `until` as `run_until()` does, and returns what happened as a player, whose clock begins at 0.

        It is exact at any instant, in a notebook or as a page, and needs no files. Where collisions alone do not determine the motion,
        or are more than a million, it draws straight lines between samples; `Player.why_not` is then the reason.
        """
        from carom.player import play

        return play(self, until)

    def animate(self, dt: float, frames: int | None = None, color: str = "speed", interval: float = 30) -> FuncAnimation:
        """Returns an animation of matplotlib that runs the simulation as it is shown, by `dt` from frame to frame. Obstacles are those of
        `scene` at the time.

        Args:
            dt: simulated time from one frame to the next.
            frames: their number; None: without end.
            color: "speed", "species" or any colour of matplotlib.
            interval: milliseconds from one frame to the next.
        """
        from carom.animate import live_animation

        return live_animation(self, dt, frames, color=color, interval=interval)

    # Changing it while it runs.

    def set(self, key: str | dict[str, Any], value: Any = None) -> None:
        """Changes what acts on the disks from now on, by a key of the scene: `sim.set("gravity.acceleration", (0, -1))`.

        Time, totals and random numbers go on. Whatever acts can be changed: collision, gravity, walls, obstacles, growth, thermostat,
        tumbling, brownian, shear, square_well, stepped_potential, drag, non_additivity; a dict changes several keys at once. A table whose value is None no longer acts.

        Raises:
            SceneError: where the scene, as it would begin now, is wrong. Then nothing is changed.
            ValueError: for a key that does not say what acts on the disks.
        """
        if isinstance(key, dict) and value is not None:
            raise TypeError(f"a dict of keys has its values in it; the second argument, {shown(value)}, is left over")
        changes = key if isinstance(key, dict) else {words(key, "a key"): value}
        acting = {name: table for name, table in self.scene.to_dict().items() if name in _EFFECTS}
        for name, entry in changes.items():
            path = words(name, "a key").split(".")
            if path[0] not in _EFFECTS:
                raise ValueError(f"{name!r} does not say what acts on the disks while they move; {', '.join(_EFFECTS)} do")
            _put(acting, path, entry)
        try:
            self._core.set_effects(scene_text(acting))
        except SceneError as error:
            raise SceneError(error.sentence) from None  # the user has not seen the lines of that text
        self._moved()
        self._now = self._disks = None

    def set_velocities(self, velocities: npt.ArrayLike, spins: npt.ArrayLike | None = None) -> None:
        """Gives all disks these velocities, shape (N, 2), and where they spin these spins, shape (N,). All else goes on."""
        turning = None if spins is None else numbers(spins, "spins", self.count)
        try:
            self._core.set_velocities(pairs(velocities, "velocities", self.count), turning)
        except SceneError as error:
            raise SceneError(error.sentence) from None
        self._moved()

    def set_collision_rule(self, rule: CollisionRule | None) -> None:
        """Has two disks that meet do what `rule` says; None brings the scene's rule back.

        `rule(pair)` is called at every collision of two disks and sets `pair.velocity` and `pair.partner_velocity`; it reads their
        masses, radii, ids and `pair.normal`, the unit vector from the partner to the disk. The disks must not approach each other
        afterwards. This is slow, about a microsecond per collision; the simulation cannot be asked anything meanwhile.
        """
        call: CollisionRule | None = None
        if rule is not None:
            if not callable(rule):
                raise TypeError(f"the collision rule is {shown(rule)}; give a function of two disks that meet")
            given = rule

            # The library refers to this function weakly: a rule that holds the simulation is then collected with it.
            def call(pair: CollidingPair) -> None:
                given(pair)

        self._core.set_collision_rule(call)
        self._rule, self._call = rule, call

    def reset_clock(self) -> None:
        """Makes now the zero of time and forgets all totals, as a run does when it has equilibrated. The state stays."""
        self._core.reset_clock()
        self._moved()

    def check_invariants(self) -> list[str]:
        """Compares the engine's plan with what an exhaustive search finds. Returns one sentence per fault: none, if all is well."""
        return self._core.check_invariants()

    # Keeping it.

    def copy(self) -> Simulation:
        """Returns another simulation that goes on to the same bits, on as many threads."""
        other = _begun(self._made, self._core.save(), self._rule)
        if self.threads > 1:
            other.threads = self.threads
        return other

    __copy__ = copy

    def __deepcopy__(self, memo: dict[int, Any]) -> Simulation:
        return self.copy()

    def __reduce__(self) -> tuple[Any, ...]:
        return _restored, (self._made.parts(), self._core.save(), self._rule)

    def save(self, path: str | PathLike[str]) -> None:
        """Writes the simulation into a file from which `Simulation.load()` goes on to the same bits, with this build of carom."""
        import json

        place = path_text(path, "path")
        if self._rule is not None:
            raise ValueError("a collision rule of one's own cannot be saved; set_collision_rule(None) takes it away")
        part = f"{place}.partial"
        try:
            with open(part, "wb") as file:
                file.write(_MAGIC + json.dumps(self._made.parts()).encode() + b"\n" + self._core.save())
            os.replace(part, place)
        except OSError as error:
            raise OutputError(f"{place}: cannot write the simulation: {error.strerror}") from None

    @classmethod
    def load(cls, path: str | PathLike[str]) -> Simulation:
        """Returns the simulation that `save()` wrote. Raises OutputError for any other file, and for one of another build."""
        import io
        import json

        place = path_text(path, "path")
        try:
            with open(place, "rb") as file:
                content = io.BytesIO(file.read())
        except OSError as error:
            raise OutputError(f"{place}: cannot read the simulation: {error.strerror}") from None
        if content.read(len(_MAGIC)) != _MAGIC:
            raise OutputError(f"{place}: this was not written by Simulation.save()")
        try:
            return _restored(json.loads(content.readline()), content.read(), None)
        except (RuntimeError, ValueError, TypeError) as error:
            raise OutputError(f"{place}: {error}") from None

    def __repr__(self) -> str:
        return f"<carom.Simulation of {self.count} disks at time {self.time:g}, {self.collisions} collisions, engine {self.engine}>"


#: Tables of a scene that say what acts on the disks.
_EFFECTS = ("collision", "gravity", "walls", "obstacles", "growth", "thermostat", "tumbling", "brownian", "shear", "square_well", "stepped_potential", "drag", "non_additivity")


def _put(tables: dict[str, Any], path: list[str], value: Any) -> None:
    """Sets one entry of nested mappings and lists, whose entries are numbered from 0; None removes it."""
    holder: Any = tables
    key: Any = ""
    for k, name in enumerate(path):
        if k > 0:
            holder = holder.setdefault(key, {}) if isinstance(holder, dict) else holder[key]
        key = name
        if isinstance(holder, list):
            if not (name.isdecimal() and int(name) < len(holder)):
                raise ValueError(f"{'.'.join(path[:k])} has {len(holder)} entries, numbered from 0, and none is {name!r}")
            key = int(name)
        elif not isinstance(holder, dict):
            raise ValueError(f"{'.'.join(path[:k])} is {holder!r}, which has no keys")
    if value is not None:
        holder[key] = value
    elif isinstance(holder, list) or key in holder:
        del holder[key]


def _restored(parts: tuple[str, str, list[str], str], saved: bytes, rule: CollisionRule | None) -> Simulation:
    _core.Simulation.check_saved(saved)  # another build's scene might be none here
    return _begun(scene_of_parts(*parts), saved, rule)


def _begun(made: Scene, saved: bytes, rule: CollisionRule | None) -> Simulation:
    simulation = Simulation.__new__(Simulation)
    simulation._begin(made, _core.Simulation.restore(made._core, saved))
    simulation._now = None
    if rule is not None:
        simulation.set_collision_rule(rule)
    return simulation


def _fraction(begin: float, now: float, end: float) -> float:
    return 1.0 if end <= begin else min(1.0, (now - begin) / (end - begin))


def engines() -> list[str]:
    """Returns the names of the engines, those first that "auto" prefers."""
    return _core.engine_names()


def fixed_step_methods() -> list[str]:
    """Returns the names of the fixed-step methods: "naive", "naive-edge", "guarded", "grid", "backtrack", "swept", "soft"."""
    return _core.fixed_step_names()
