"""The naive method to the letter in numpy, and how far one can trust it.

In each step, disk by disk: reverse the velocity beyond a wall; give every disk that is closer than two radii the velocities after a
collision; move by v dt. carom.Simulation(scene, method="naive", dt=dt) is the same to the last bit, 70 times as fast.
"""

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.animation import FuncAnimation
from matplotlib.collections import EllipseCollection

import carom


def naive(r, v, radius, dt, steps):
    """Returns positions, shape (steps + 1, N, 2), of equal disks in the box [-1, 1] x [-1, 1]; collisions reverse their velocities."""
    r, v = r.copy(), v.copy()
    frames = np.empty((steps + 1, *r.shape))
    for k in range(steps + 1):
        frames[k] = r
        for i in range(len(r)):
            v[i, np.abs(r[i]) > 1] *= -1
            x, y = (r - r[i]).T
            for j in np.flatnonzero(x**2 + y**2 < 2 * radius * (2 * radius)):
                if j != i:
                    d = v[i] - v[j]
                    v[i] -= d
                    v[j] += d
            r[i] += v[i] * dt
    return frames


def main(steps=5000):
    scene = carom.Scene.preset("box")
    start = carom.Simulation(scene)
    frames = naive(start.positions, start.velocities, radius=0.03, dt=0.001, steps=steps)

    same = carom.Simulation(scene, method="naive", dt=0.001).sample(dt=0.001, until=steps * 0.001)
    print("carom's naive method has the same bits:", np.array_equal(frames, same.positions))
    exact = carom.Simulation(scene).sample(dt=0.001, until=steps * 0.001)
    off = np.hypot(*(frames - exact.positions).transpose(2, 0, 1)).max(axis=1) > 0.006
    print(f"a disk is off by a tenth of its diameter from t = {exact.time[off.argmax()]:.3f} on")

    figure, both = plt.subplots(1, 2, figsize=(8, 4))
    pictures = []
    for axes, title in zip(both, ("naive, dt = 0.001", "exact")):
        axes.set(xlim=(-1, 1), ylim=(-1, 1), aspect="equal", xticks=[], yticks=[], title=title)
        size = np.full(64, 0.06)
        pictures.append(axes.add_collection(EllipseCollection(size, size, 0 * size, units="x", offset_transform=axes.transData)))

    def show(k):
        pictures[0].set_offsets(frames[k])
        pictures[1].set_offsets(exact.positions[k])
        return pictures

    animation = FuncAnimation(figure, show, frames=range(0, steps + 1, 10), interval=30, blit=True)
    plt.show()
    return animation


if __name__ == "__main__":
    main()
