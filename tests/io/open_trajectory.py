"""Opens a trajectory with h5py and MDAnalysis, and holds it against samples.csv of the same run.

usage: open_trajectory.py RUN_DIRECTORY NUMBER_OF_SAMPLES NUMBER_OF_DISKS LX LY
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
lengths = [float(argument) for argument in sys.argv[4:6]]
table = np.loadtxt(directory + "/samples.csv", delimiter=",", skiprows=1).reshape(samples, disks, 6)
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
    assert file["events/velocity"].shape == (len(file["events/time"]), 2)

universe = MDAnalysis.Universe(path)
assert len(universe.atoms) == disks
assert universe.trajectory.n_frames == samples
for frame in universe.trajectory:
    assert np.allclose(frame.dimensions[:2], lengths) and frame.dimensions[2] > 0
    assert np.allclose(frame.dimensions[3:], 90)
    # MDAnalysis keeps single precision
    assert np.array_equal(frame.positions[:, :2], table[frame.frame, :, 2:4].astype(np.float32))
    assert np.array_equal(frame.velocities[:, :2], table[frame.frame, :, 4:6].astype(np.float32))
    assert frame.time == table[frame.frame, 0, 0]
    assert frame.data["step"] == frame.frame
    assert set(frame.data) >= {"kinetic_energy", "temperature"}
