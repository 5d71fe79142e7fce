"""Starts from files of other programs, and from universes of MDAnalysis."""

import numpy as np
import pytest

import carom

BOX = {"x": (-5.0, 5.0), "y": (-4.0, 4.0), "boundary": "periodic"}
XY = np.array([[-4.0, -3.0], [0.5, 1.25], [3.0, 2.0]])
V = np.array([[1.0, 0.0], [-0.5, 0.25], [0.1, -2.0]])


def scene(box=BOX, **effects):
    disks = {"count": 1, "radius": 0.5, "mass": 1, "positions": "random", "velocities": "rest"}
    return carom.Scene(box=box, disks=disks, collision={"rule": "specular"}, run={"time": 1, "sample_every": 0.1}, **effects)


def begins(start, radii=0.5, masses=1.0):
    sim = carom.Simulation(scene().with_disks(start))
    assert np.array_equal(sim.positions, XY) and np.array_equal(sim.velocities, V)
    assert np.all(sim.radii == radii) and np.all(sim.masses == masses)


def test_numpys_own_files(tmp_path):
    np.save(tmp_path / "start.npy", np.hstack([XY, V]))
    begins(carom.read_start(tmp_path / "start.npy"))


def test_text_as_savetxt_writes_it(tmp_path):
    columns = np.column_stack([XY, V, [0.25, 0.5, 0.125]])
    np.savetxt(tmp_path / "start.csv", columns, delimiter=",", header="x,y,vx,vy,radius")
    begins(carom.read_start(tmp_path / "start.csv"), radii=[0.25, 0.5, 0.125])
    with pytest.raises(carom.SceneError, match="wx"):
        np.savetxt(tmp_path / "wrong.csv", columns, delimiter=",", header="x,y,wx,vy,radius")
        carom.read_start(tmp_path / "wrong.csv")


def test_what_is_given_takes_the_place_of_what_was_read(tmp_path):
    np.save(tmp_path / "start.npy", np.hstack([XY, V]))
    sim = carom.Simulation(scene().with_disks(carom.read_start(tmp_path / "start.npy"), velocities=2 * V, masses=[1, 2, 3]))
    assert np.array_equal(sim.velocities, 2 * V) and sim.masses.tolist() == [1, 2, 3]


def test_gsd(tmp_path):
    hoomd = pytest.importorskip("gsd.hoomd", reason="gsd is not installed")
    frame = hoomd.Frame()
    frame.configuration.box = [10, 8, 1, 0, 0, 0]
    frame.particles.N = 3
    frame.particles.position = np.column_stack([XY, np.zeros(3)])
    frame.particles.velocity = np.column_stack([V, np.zeros(3)])
    frame.particles.diameter = [1, 1, 1]
    frame.particles.mass = [2, 2, 2]
    with hoomd.open(tmp_path / "start.gsd", "w") as file:
        file.append(frame)
    start = carom.read_start(tmp_path / "start.gsd")
    assert start.box == ((-5.0, 5.0), (-4.0, 4.0))
    # GSD has single precision: what it cannot hold is what it made of it.
    sim = carom.Simulation(scene().with_disks(start))
    assert np.array_equal(sim.positions, XY.astype(np.float32)) and np.array_equal(sim.velocities, V.astype(np.float32))
    assert np.all(sim.radii == 0.5) and np.all(sim.masses == 2)
    with pytest.raises(ValueError, match="no frame 7"):
        carom.read_start(tmp_path / "start.gsd", frame=7)
    (tmp_path / "none.gsd").write_bytes(b"nothing")
    with pytest.raises(carom.OutputError, match="none.gsd"):
        carom.read_start(tmp_path / "none.gsd")


def test_a_universe_of_mdanalysis_there_and_back():
    pytest.importorskip("MDAnalysis", reason="MDAnalysis is not installed")
    box = {"x": (0, 10), "y": (0, 8), "boundary": "periodic"}
    sim = carom.Simulation(scene(box).with_disks(XY + [5, 4], V))
    frames = sim.sample(0.125, 1.0)
    universe = frames.to_mdanalysis()
    assert len(universe.trajectory) == len(frames) and universe.atoms.n_atoms == 3
    start = carom.read_start(universe, frame=-1)
    assert np.array_equal(start.positions, frames.positions[-1].astype(np.float32))
    assert np.array_equal(start.velocities, frames.velocities[-1].astype(np.float32))
    assert start.box == ((0.0, 10.0), (0.0, 8.0)) and np.all(start.radii == 0.5)
    assert np.array_equal(start.masses, frames.masses) and np.array_equal(frames.masses, sim.masses)
    carom.Simulation(scene(box).with_disks(start))


def test_a_universe_of_mdanalysis_has_the_times_and_boxes_of_its_frames():
    pytest.importorskip("MDAnalysis", reason="MDAnalysis is not installed")
    from MDAnalysis.lib.distances import self_capped_distance

    box = {"x": (0, 10), "y": (0, 8), "boundary": "periodic"}
    sim = carom.Simulation(scene(box).with_disks(XY + [5, 4], V))
    sim.run_until(5.0)
    universe = sim.sample(0.125, 6.0).to_mdanalysis()
    assert [step.time for step in universe.trajectory] == [5.0 + 0.125 * k for k in range(9)]
    assert [step.time for step in universe.copy().trajectory][-1] == 6.0
    pairs, _ = self_capped_distance(universe.atoms.positions, 3.9, box=universe.dimensions)  # half the box is 4
    assert len(pairs) <= 3, "no disk is a neighbour of its own image above it"
    closing = scene(box | {"boundary": "walls"}, walls={"right": {"velocity": -0.5}}).with_disks(XY + [5, 4], V)
    universe = carom.Simulation(closing).sample(1.0, 2.0).to_mdanalysis()
    assert [step.dimensions[:3].tolist() for step in universe.trajectory] == [[10, 8, 10], [9.5, 8, 9.5], [9, 8, 9]]
    sheared = carom.Simulation(scene(box, shear={"rate": 0.25}).with_disks(XY + [5, 4], V))
    universe = sheared.sample(1.0, 1.0).to_mdanalysis()
    x, y, _, _, _, angle = universe.trajectory[1].dimensions
    assert x == 10 and abs(y - np.hypot(2, 8)) < 1e-6 and abs(angle - np.degrees(np.arctan2(8, 2))) < 1e-4  # rate * height * time


def test_a_universe_whose_middle_is_0_has_such_a_box():
    MDAnalysis = pytest.importorskip("MDAnalysis", reason="MDAnalysis is not installed")
    universe = MDAnalysis.Universe.empty(2, trajectory=True)
    universe.load_new(np.array([[[-4.5, 0, 0], [4.5, 1, 0]]]), dimensions=np.array([10, 8, 8, 90, 90, 90]))
    assert carom.read_start(universe).box == ((-5.0, 5.0), (-4.0, 4.0))
    for x, y, box in [
        ((-4.5, 4.5), (3, 7), ((-5.0, 5.0), (0.0, 8.0))),  # each axis by itself
        ((-0.01, 5.01), (1, 3), ((0.0, 10.0), (0.0, 8.0))),  # no box holds x
        ((-4.5, 5.0000005), (-1, 1), ((-5.0, 5.0), (-4.0, 4.0))),  # as single precision rounds
        ((2, 4), (1, 3), ((0.0, 10.0), (0.0, 8.0))),  # both boxes hold all
    ]:
        universe.load_new(np.array([[[x[0], y[0], 0], [x[1], y[1], 0]]]), dimensions=np.array([10, 8, 8, 84, 90, 90]))
        start = carom.read_start(universe)
        assert start.box == box, (x, y)
        if x[0] != -0.01:
            of_box = {"x": box[0], "y": box[1], "boundary": "periodic"}
            assert carom.Simulation(scene(of_box).with_disks(start.positions, [[1, 0], [0, 1]])).state.count == 2


def test_a_universe_has_the_box_of_the_frame_that_is_read():
    MDAnalysis = pytest.importorskip("MDAnalysis", reason="MDAnalysis is not installed")
    universe = MDAnalysis.Universe.empty(1, trajectory=True)
    lengths = np.array([[10, 8, 8, 90, 90, 90], [9, 8, 8, 90, 90, 90]])
    universe.load_new(np.ones((2, 1, 3)), dimensions=lengths)
    universe.trajectory[0]
    assert carom.read_start(universe, frame=1).box == ((0.0, 9.0), (0.0, 8.0))
    assert universe.trajectory.frame == 0
    lengths[1, 5] = 84
    universe.load_new(np.ones((2, 1, 3)), dimensions=lengths)
    with pytest.raises(ValueError, match="the box of the universe leans"):
        carom.read_start(universe, frame=1)


def test_a_gsd_file_gives_what_is_written_in_it(tmp_path):
    gsd_hoomd = pytest.importorskip("gsd.hoomd", reason="gsd is not installed")
    frame = gsd_hoomd.Frame()
    frame.particles.N = 2
    frame.particles.position = [[-1, 0, 0], [1, 0, 0]]
    frame.configuration.box = [10, 8, 0, 0, 0, 0]
    with gsd_hoomd.open(tmp_path / "bare.gsd", "w") as file:
        file.append(frame)
    start = carom.read_start(tmp_path / "bare.gsd")
    assert start.velocities is None and start.radii is None and start.masses is None
    frame.configuration.box = [10, 8, 0, 0.5, 0, 0]
    with gsd_hoomd.open(tmp_path / "tilted.gsd", "w") as file:
        file.append(frame)
    with pytest.raises(ValueError, match="its box leans by xy = 0.5; a start has a rectangular box"):
        carom.read_start(tmp_path / "tilted.gsd")


def test_what_is_no_start_is_refused(tmp_path):
    with pytest.raises(TypeError, match="int: a start is read from"):
        carom.read_start(3)
    with pytest.raises(carom.SceneError, match="nothing.csv"):
        carom.read_start(tmp_path / "nothing.csv")
