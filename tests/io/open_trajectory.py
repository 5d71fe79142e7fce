"""Opens a trajectory with h5py and MDAnalysis, and holds it against samples.csv of the same run.

usage: open_trajectory.py RUN_DIRECTORY NUMBER_OF_SAMPLES NUMBER_OF_DISKS LX LY [effects]
"effects" says that the run is one of scene_with_effects(), whose box becomes higher.
Prints nothing when all is well. Exits with 77 where a package is missing.
"""
import sys
import warnings

try:
    import numpy as np
    import h5py
    warnings.simplefilter("ignore")
    import MDAnalysis
except ImportError as error:
    print(error)
    sys.exit(77)

directory, samples, disks = sys.argv[1], int(sys.argv[2]), int(sys.argv[3])
lengths = np.tile([float(argument) for argument in sys.argv[4:6]], (samples, 1))
effects = sys.argv[6:] == ["effects"]
if effects:
    lengths[:, 1] += 0.75 * np.arange(samples)
table = np.loadtxt(directory + "/samples.csv", delimiter=",", skiprows=1).reshape(samples, disks, 7 if effects else 6)
path = directory + "/trajectory.h5md"

with h5py.File(path, "r") as file:
    group = file["particles/trajectory"]
    position = group["position/value"]
    assert position.shape == (samples, disks, 3) and position.dtype == np.float64
    assert np.array_equal(position[:, :, :2], table[:, :, 2:4])
    assert np.array_equal(group["velocity/value"][:, :, :2], table[:, :, 4:6])
    assert np.array_equal(group["position/time"][:], table[:, 0, 0])
    assert np.array_equal(group["velocity/step"][:], np.arange(samples))
    assert isinstance(position.attrs["unit"], str)
    assert list(group["box"].attrs["boundary"]) == ["periodic", "none", "none"]
    assert isinstance(file["parameters"].attrs["scene"], str)
    assert file["parameters"].attrs["spatial_dimension"] == 2
    edges = group["box/edges/value"][:]
    assert np.array_equal(edges[:, 0, 0], lengths[:, 0]) and np.array_equal(edges[:, 1, 1], lengths[:, 1])
    for name, observable in file["observables"].items():
        assert observable["value"].shape[0] == samples and observable["time"] == group["position/time"], name
    if effects:
        assert np.array_equal(file["observables/spin/value"][:], table[:, :, 6])
        walls = file["observables/walls/value"]
        assert np.array_equal(walls[:, 3] - walls[:, 2], lengths[:, 1])
        # the box as readers without origins need it, from its own corner
        assert walls.shape == (samples, 4) and np.all(walls[:, 0] == group["box"].attrs["origin"][0])
        total = sum(file["observables"][part + "_energy/value"][:] for part in ("kinetic", "spin", "potential", "piston"))
        assert np.allclose(total, file["observables/total_energy/value"][:], rtol=1e-15, atol=1e-12)
    assert file["events/velocity"].shape == (len(file["events/time"]), 2)

universe = MDAnalysis.Universe(path)
assert len(universe.atoms) == disks
assert universe.trajectory.n_frames == samples
for frame in universe.trajectory:
    (x, _, _), (tilt, y, _), (_, _, z) = edges[frame.frame]
    assert np.allclose(frame.dimensions[:3], (x, np.hypot(tilt, y), z)) and z == max(lengths[frame.frame])
    assert np.allclose(frame.dimensions[3:], (90, 90, np.degrees(np.arctan2(y, tilt))))
    # MDAnalysis keeps single precision
    assert np.array_equal(frame.positions[:, :2], table[frame.frame, :, 2:4].astype(np.float32))
    assert np.array_equal(frame.velocities[:, :2], table[frame.frame, :, 4:6].astype(np.float32))
    assert frame.time == table[frame.frame, 0, 0]
    assert frame.data["step"] == frame.frame
    assert set(frame.data) >= {"kinetic_energy", "temperature"}
    if effects:
        assert np.array_equal(frame.data["spin"], table[frame.frame, :, 6])
        assert frame.data["scale"] == 1 + 0.0625 * frame.frame
        assert len(frame.data["walls"]) == 4
