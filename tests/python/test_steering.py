"""What acts on the disks may change while they move: time, totals and random numbers go on."""

from __future__ import annotations

import gc
import math
import pickle
import runpy
import weakref

import numpy as np
import pytest
from conftest import GAS, ROOT

import carom


def specular(pair: carom.CollidingPair) -> None:
    """Smooth elastic disks, as a textbook has them."""
    normal, velocity, other = np.array(pair.normal), np.array(pair.velocity), np.array(pair.partner_velocity)
    impulse = -2 * pair.mass * pair.partner_mass / (pair.mass + pair.partner_mass) * ((velocity - other) @ normal) * normal
    pair.velocity, pair.partner_velocity = velocity + impulse / pair.mass, other - impulse / pair.partner_mass


def grown(collisions: int, disks: int = 12, side: float = 6.0) -> float:
    """Returns how far disks may be apart after so many collisions where they began apart by roundings of coordinates: 2^-52 of the
    box, which every collision of each disk enlarges by e^3.2 at most, the exponent of the most dilute gas that was measured."""
    return side * 2**-52 * math.exp(3.2 * 2 * collisions / disks)


def test_gravity_that_is_turned_on_accelerates_free_flight() -> None:
    box = {"x": (0, 10), "y": (0, 10), "boundary": "walls"}
    disks = {"radius": 0.1, "mass": 2, "positions": [(5, 5)], "velocities": [(0.5, 0)]}
    sim = carom.Simulation({"box": box, "disks": disks, "collision": {"rule": "specular"}, "run": {"time": 1}})
    sim.run_until(1.0)
    sim.set("gravity.acceleration", (0.0, -2.0))
    assert sim.scene.to_dict()["gravity"]["acceleration"] == [0.0, -2.0]
    sim.run_until(2.5)
    assert sim.time == 2.5
    assert sim.positions == pytest.approx(np.array([[6.25, 5.0 - 0.5 * 2.0 * 1.5**2]]), abs=1e-12)
    assert sim.velocities == pytest.approx(np.array([[0.5, -3.0]]), abs=1e-12)
    sim.set("gravity", None)
    assert "gravity" not in sim.scene.to_dict()
    sim.run_until(3.0)
    assert sim.velocities == pytest.approx(np.array([[0.5, -3.0]]), abs=1e-12)


def test_a_change_is_the_scene_with_that_change_from_there(gas: carom.Scene) -> None:
    sim = carom.Simulation(gas)
    sim.run_until(2.0)
    changes = {"collision.restitution": 0.5, "drag.rate": 0.3}
    anew = carom.Simulation(gas.set(changes), state=sim.state)
    sim.set(changes)
    before = sim.collisions
    sim.run_until(2.5)
    anew.run_until(0.5)
    assert sim.collisions - before == anew.collisions > 0
    assert sim.positions == pytest.approx(anew.positions, abs=grown(anew.collisions))
    assert sim.velocities == pytest.approx(anew.velocities, abs=grown(anew.collisions))


def test_entries_of_lists_change_by_number() -> None:
    sim = carom.Simulation(carom.Scene.load(ROOT / "docs/scenes/lorentz.toml"))
    radius = sim.scene.to_dict()["obstacles"][0]["disk"]["radius"]
    sim.set("obstacles.0.disk.radius", radius / 2)
    assert sim.scene.to_dict()["obstacles"][0]["disk"]["radius"] == radius / 2
    with pytest.raises(ValueError, match=r"obstacles has \d+ entr.*, numbered from 0, and none is '77'"):
        sim.set("obstacles.77.disk.radius", 0.1)
    with pytest.raises(carom.SceneError):
        sim.set("obstacles.0.disk.radius", -1.0)
    assert sim.scene.to_dict()["obstacles"][0]["disk"]["radius"] == radius / 2
    assert sim.check_invariants() == []


def test_reversed_velocities_lead_back(gas: carom.Scene) -> None:
    sim = carom.Simulation(gas)
    start = np.array(sim.positions)
    sim.run_until(1.5)
    assert sim.collisions > 5
    sim.set_velocities(-sim.velocities)
    sim.run_until(3.0)
    assert sim.time == 3.0
    assert sim.positions == pytest.approx(start, abs=grown(sim.collisions))


def test_a_rule_in_python_is_the_librarys(gas: carom.Scene) -> None:
    own, library = carom.Simulation(gas, on_collision=specular), carom.Simulation(gas)
    own.run_until(1.0)
    library.run_until(1.0)
    assert own.collisions == library.collisions > 5
    assert own.positions == pytest.approx(library.positions, abs=grown(own.collisions))
    assert own.totals["virial"] == pytest.approx(library.totals["virial"], rel=grown(own.collisions))


def test_a_rule_reads_the_pair(gas: carom.Scene) -> None:
    seen: list[carom.CollidingPair] = []

    def rule(pair: carom.CollidingPair) -> None:
        seen.append(pair)
        specular(pair)

    sim = carom.Simulation(gas, on_collision=rule)
    events = [event for event in sim.events(until=2.0) if event.partner >= 0]
    assert len(seen) == len(events) > 10
    for pair, event in zip(seen, events):  # pairs can be kept
        assert (pair.disk, pair.partner) == (event.disk, event.partner)
        assert (pair.velocity, pair.partner_velocity) == (event.velocity, event.partner_velocity)
        assert np.hypot(*pair.normal) == pytest.approx(1.0, rel=1e-12)
        assert (pair.mass, pair.partner_mass, pair.radius, pair.partner_radius) == (1.0, 1.0, 0.4, 0.4)
    sim.set_collision_rule(None)
    energy = sim.kinetic_energy
    sim.run_until(4.0)
    assert len(seen) == len(events)
    assert sim.kinetic_energy == pytest.approx(energy, rel=1e-12)


@pytest.mark.parametrize(
    "rule, kind, sentence",
    [
        (lambda pair: 1 / 0, ZeroDivisionError, "division by zero"),
        (lambda pair: None, ValueError, "the collision rule leaves approaching each other disks"),
        (lambda pair: setattr(pair, "velocity", (np.nan, 0.0)), ValueError, "gives velocities that are not finite"),
        (lambda pair: setattr(pair, "velocity", "fast"), TypeError, r"a velocity is 'fast'; give two numbers, \(vx, vy\)"),
        (lambda pair: setattr(pair, "partner_velocity", (1, 2, 3)), TypeError, r"a velocity is \(1, 2, 3\); give two numbers"),
    ],
)
def test_a_rule_that_fails_ends_the_call_before_the_collision(gas: carom.Scene, rule, kind, sentence: str) -> None:
    sim = carom.Simulation(gas, on_collision=rule)
    energy = sim.kinetic_energy
    with pytest.raises(kind, match=sentence):
        sim.run_until(5.0)
    assert sim.collisions == 0 and sim.time > 0
    assert sim.check_invariants() == []
    sim.set_collision_rule(None)
    assert sim.run_until(5.0) == "time"
    assert sim.kinetic_energy == pytest.approx(energy, rel=1e-12)


def test_a_rule_cannot_ask_the_simulation_that_waits_for_it(gas: carom.Scene) -> None:
    sim = carom.Simulation(gas)
    sim.set_collision_rule(lambda pair: sim.time)
    with pytest.raises(RuntimeError, match="this simulation is running"):
        sim.run_until(5.0)
    assert sim.check_invariants() == []


def test_a_rule_that_holds_its_simulation_is_collected_with_it(gas: carom.Scene) -> None:
    sim = carom.Simulation(gas)

    def rule(pair: carom.CollidingPair) -> None:
        assert sim is not None
        specular(pair)

    sim.set_collision_rule(rule)
    sim.run_until(1.0)
    gone = weakref.ref(sim)
    del sim, rule
    gc.collect()
    assert gone() is None


def test_a_rule_goes_with_copies_and_pickles(gas: carom.Scene) -> None:
    sim = carom.Simulation(gas, on_collision=specular)
    sim.run_until(1.0)
    for again in (sim.copy(), pickle.loads(pickle.dumps(sim))):
        again.run_until(3.0)
        twin = sim.copy()
        twin.run_until(3.0)
        assert again.state_hash == twin.state_hash
    with pytest.raises(ValueError, match="a collision rule of one's own cannot be saved"):
        sim.save("nowhere")


def test_maxwells_demon_makes_heat_flow_from_cold_to_hot() -> None:
    script = runpy.run_path(str(ROOT / "docs/python/demon.py"))
    sim, openings = script["demon"](until=400.0)
    left, right = script["temperatures"](sim)
    on_left = (sim.positions[:, 0] < 20).sum()
    assert openings > 10
    # The mean of n energies m v^2 / 2, of which each has the mean kT and as large a spread, is known to 1 / sqrt(n).
    assert np.log(right / left) > 3 * np.sqrt(1 / on_left + 1 / (100 - on_left))
    untouched = carom.Simulation(carom.Scene.parse(sim.scene.toml))
    assert sim.kinetic_energy == pytest.approx(untouched.kinetic_energy, rel=1e-11)  # a door does no work
    assert sim.check_invariants() == []


def test_a_scene_changes_itself_on_the_way() -> None:
    box = {"x": (0, 10), "y": (0, 10), "boundary": "walls"}
    disks = {"radius": 0.1, "mass": 2, "positions": [(5, 5)], "velocities": [(0.5, 0)]}
    changes = [{"time": 1.0, "set": ["gravity.acceleration=[0.0, -2.0]"]}, {"time": 2.5, "scale_velocities": 0.0}]
    scene = {"box": box, "disks": disks, "collision": {"rule": "specular"}, "run": {"time": 3}, "changes": changes}
    sim = carom.Simulation(scene)
    sim.run_until(1.0)
    assert "gravity" not in sim.scene.to_dict()
    sim.run_until(2.5)
    assert sim.scene.to_dict()["gravity"]["acceleration"] == [0.0, -2.0]
    assert len(sim.scene.to_dict()["changes"]) == 1
    assert sim.positions == pytest.approx(np.array([[6.25, 5.0 - 0.5 * 2.0 * 1.5**2]]), abs=1e-12)
    again = pickle.loads(pickle.dumps(sim))
    for one in (sim, again):
        one.run_until(3.0)
        assert one.positions == pytest.approx(np.array([[6.25, 2.75 - 0.5 * 2.0 * 0.5**2]]), abs=1e-12)
    assert carom.run(scene).state_hash == sim.state.state_hash


def test_a_change_that_a_disk_blocks_is_told() -> None:
    box = {"x": (0, 10), "y": (0, 10), "boundary": "walls"}
    disks = {"radius": 0.5, "mass": 1, "positions": [(5, 5)], "velocities": "rest"}
    changes = [{"time": 1.0, "add_obstacle": {"disk": {"centre": (5, 5.1), "radius": 0.2}}}]
    scene = {"box": box, "disks": disks, "collision": {"rule": "specular"}, "run": {"time": 3}, "changes": changes}
    sim = carom.Simulation(scene)
    with pytest.raises(carom.SceneError, match="the change of time 1 cannot be made: disk 0 overlaps obstacles.0"):
        sim.run_until(3.0)
    assert sim.time == 1.0
    with pytest.warns(carom.StoppedEarly):
        assert carom.run(scene).stopped == "blocked"


def test_the_scene_of_a_wall_that_would_close_the_box_can_begin_a_simulation() -> None:
    box = {**GAS["box"], "boundary": "walls"}
    sim = carom.Simulation({**GAS, "box": box, "run": {**GAS["run"], "time": 1000.0}})
    sim.run_until(1.0)
    sim.set("walls.right.velocity", -0.125)
    now = sim.scene
    assert now.set({"run.seed": 4}).to_dict()["run"]["time"] == 0.0  # how long the wall is to move, the program says
    assert pickle.loads(pickle.dumps(now)) == now
    twin = carom.Simulation(now, state=sim.state)
    sim.run_until(2.0)
    twin.run_until(1.0)
    assert np.array_equal(twin.positions, sim.positions)
