"""Maxwell's demon: two gases at one temperature, a wall between them, and a door in it that lets fast disks pass to the right and
slow ones to the left. Heat flows from cold to hot, for the demon looks at every disk."""

import numpy as np

import carom


def demon(until=400.0, seed=1):
    """Returns the simulation at the end, and how often the door was opened."""
    wall = [{"segment": {"from": (20, 0), "to": (20, 8)}}, {"segment": {"from": (20, 12), "to": (20, 20)}}]
    door = {"segment": {"from": (20, 8), "to": (20, 12)}}
    disks = {"count": 100, "radius": 0.5, "mass": 1, "positions": "random", "velocities": {"temperature": 1}}
    box = {"x": (0, 40), "y": (0, 20), "boundary": "walls"}
    run = {"time": until, "seed": seed}
    scene = carom.Scene(box=box, disks=disks, obstacles=[*wall, door], collision={"rule": "specular"}, run=run)
    sim, is_open, openings = carom.Simulation(scene), False, 0
    for time in np.arange(0.1, until, 0.1):
        sim.run_until(time)
        distance, from_middle, speed = 20 - sim.positions[:, 0], sim.positions[:, 1] - 10, np.hypot(*sim.velocities.T)
        before_door = np.abs(from_middle) < 2.5
        if (before_door & (np.abs(distance) < 0.51)).any():
            continue  # a disk in the doorway keeps the door as it is
        comes = before_door & (np.abs(distance) < 2) & (distance * sim.velocities[:, 0] > 0)
        may_pass = (speed > np.sqrt(2)) == (distance > 0)
        wants = bool(comes.any() and may_pass[comes].all())
        if wants != is_open:
            sim.set("obstacles", wall if wants else [*wall, door])
            is_open, openings = wants, openings + wants
    return sim, openings


def temperatures(sim):
    """Returns kT of the disks on the left and of those on the right."""
    energy, left = (sim.velocities**2).sum(axis=1) / 2, sim.positions[:, 0] < 20
    return energy[left].mean(), energy[~left].mean()


if __name__ == "__main__":
    sim, openings = demon()
    print("the door was opened {} times; kT is {:.3f} on the left and {:.3f} on the right".format(openings, *temperatures(sim)))
