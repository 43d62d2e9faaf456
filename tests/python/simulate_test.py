"""Simulation: what the program writes, without copies, interruptible."""

import os
import signal
import subprocess
import sys
import threading
import time

import numpy as np
import pytest

import dpe
from conftest import DATA, small_cloth


@pytest.mark.parametrize("name", ["side", "corners", "flag", "flag_no_wind"])
def test_simulate_equals_the_program_bit_by_bit(name, tmp_path, run_program):
    path = DATA / f"{name}.txt"
    frames = 25
    run_program("simulate_cloth", f"--scene={path}", f"--frames={frames}",
                f"--output={tmp_path / 'motion.npy'}")
    run_program("simulate_cloth", f"--scene={path}", f"--frames={frames}",
                f"--output={tmp_path / 'motion.csv'}")
    positions = dpe.simulate(dpe.Scene.load(path), frames).positions
    expected = np.load(tmp_path / "motion.npy")
    assert positions.shape == (frames, 144, 3) and positions.dtype == np.float64
    assert positions.tobytes() == expected.tobytes()
    table = np.loadtxt(tmp_path / "motion.csv", delimiter=",", skiprows=1)
    assert (table[:, 2:].reshape(frames, 144, 3) == positions).all()
    assert not (positions[0] == positions[-1]).all()


def test_simulate_equals_the_program_for_other_methods(tmp_path, run_program, cloth):
    cloth.integration_method = "tr_bdf2"
    cloth.steps_per_frame = 3
    cloth.save(tmp_path / "cloth.txt")
    run_program("simulate_cloth", f"--scene={tmp_path / 'cloth.txt'}",
                f"--output={tmp_path / 'motion.npy'}")
    motion = dpe.simulate(cloth)
    assert motion.positions.tobytes() == np.load(tmp_path / "motion.npy").tobytes()
    motion.save(tmp_path / "saved.npy")
    assert (tmp_path / "saved.npy").read_bytes() == (
        tmp_path / "motion.npy").read_bytes()
    np.testing.assert_allclose(motion.times, 0.02 * np.arange(10), rtol=1e-15)


@pytest.mark.skipif(not os.path.exists("/proc/self/status"), reason="needs /proc")
def test_a_trajectory_of_96_by_96_vertices_and_500_frames_is_not_copied():
    """In a process of its own: peak memory is that of the two matrices alone."""
    code = """
import numpy as np
import dpe

# Of address space: what is resident depends on what else the machine does.
def peak():
    with open("/proc/self/status") as status:
        return 1024 * next(int(l.split()[1]) for l in status if l.startswith("VmPeak"))

scene = dpe.Scene.grid(96, 96, 7.0, pins=[0, 95], damping=0.0, drag=0.0)
scene.integration_method = "symplectic_euler"
scene.delta = 1e-4
dpe.simulate(scene, 2)
before = peak()
motion = dpe.simulate(scene, 500)
array = motion.positions
assert array.shape == (500, 96 * 96, 3) and array.dtype == np.float64
assert array.flags.c_contiguous and not array.flags.owndata
assert not array.flags.writeable
address = array.__array_interface__["data"][0]
for _ in range(5):
    assert motion.positions.__array_interface__["data"][0] == address
    assert motion.objects[0].positions.__array_interface__["data"][0] == address
assert np.isfinite(array[-1]).all() and not (array[0] == array[-1]).all()
# Positions and velocities; half of one of them would be left for everything else.
needed = 2 * array.nbytes
grown = peak() - before
assert 0.8 * needed < grown < 1.25 * needed, (grown, needed)
last = array[-1, -1].copy()
del motion
assert (array[-1, -1] == last).all()
print("ok", grown / needed)
"""
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    assert done.stdout.startswith("ok")


def test_arrays_keep_what_they_show_alive(cloth):
    expected = dpe.simulate(cloth).positions.copy()
    array = dpe.Simulator(cloth).run().positions
    hoard = [dpe.simulate(cloth, 10, parameters=2 * cloth.parameters)
             for _ in range(20)]
    assert (array == expected).all()
    assert len(hoard) == 20


def test_parameters_are_in_place_of_the_scene_s(cloth):
    p = 1.5 * cloth.parameters
    by_parameters = dpe.simulate(cloth, parameters=p).positions
    by_scene = dpe.simulate(cloth.with_parameters(p)).positions
    by_rollout = dpe.Simulator(cloth).run(p).positions
    assert (by_parameters == by_scene).all() and (by_rollout == by_scene).all()
    assert (by_scene != dpe.simulate(cloth).positions).any()


def test_a_failure_is_an_exception_with_what_was_reached(cloth):
    cloth.integration_method = "explicit_euler"
    cloth.stiffness = 1e9
    cloth.frames = 60
    with pytest.raises(dpe.SimulationError, match="frame") as caught:
        dpe.simulate(cloth)
    reached = caught.value.trajectory
    assert not reached.ok and reached.message == str(caught.value)
    assert np.isfinite(reached.positions[0]).all()
    assert np.isnan(reached.positions[-1]).all()
    assert not dpe.simulate(cloth, check=False).ok
    rollout = dpe.Simulator(cloth).run(check=False)
    with pytest.raises(dpe.SimulationError):
        rollout.gradient(np.zeros((60, 16, 3)))


def test_several_objects(cloth):
    other = small_cloth(5, 3)
    cloth.add(other.objects[0])
    motion = dpe.simulate(cloth)
    assert [m.positions.shape for m in motion.objects] == [(10, 16, 3), (10, 15, 3)]
    with pytest.raises(AttributeError, match="objects"):
        motion.positions


def test_bad_arguments(cloth):
    with pytest.raises(ValueError, match="frames"):
        dpe.simulate(cloth, 0)
    with pytest.raises(ValueError, match="threads"):
        dpe.simulate(cloth, threads=0)
    with pytest.raises(TypeError):
        dpe.simulate(cloth, frame=3)


def test_other_threads_run_meanwhile():
    scene = small_cloth(20, 20, frames=300)
    count = 0
    done = threading.Event()

    def simulate():
        dpe.simulate(scene)
        done.set()

    thread = threading.Thread(target=simulate)
    thread.start()
    while not done.is_set():
        count += 1
        time.sleep(0.001)
    thread.join()
    assert count > 20  # 1 or so if the GIL were kept


def test_threads_may_share_a_simulator(cloth):
    simulator = dpe.Simulator(cloth)
    weights = np.random.default_rng(1).standard_normal((10, 16, 3))
    values = [cloth.parameters * (1 + 0.1 * i) for i in range(8)]
    expected = [dpe.gradient(cloth, weights, parameters=p) for p in values]
    rollouts = [simulator.run(p) for p in values]
    results = [None] * len(values)

    def work(i):
        results[i] = rollouts[i].gradient(weights)

    threads = [threading.Thread(target=work, args=(i,)) for i in range(len(values))]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    for result, wanted in zip(results, expected):
        assert (result == wanted).all()


def test_ctrl_c_ends_a_simulation():
    scene = small_cloth(24, 24, frames=1000)
    scene.steps_per_frame = 100
    sent = []

    def send():
        sent.append(time.process_time())
        os.kill(os.getpid(), signal.SIGINT)

    timer = threading.Timer(0.3, send)
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        dpe.simulate(scene)
    # Processor time: the machine may be busy with other things.
    assert time.process_time() - sent[0] < 1.0


def test_what_a_signal_handler_raises_comes_through():
    class Enough(Exception):
        pass

    def handle(*_):
        raise Enough

    scene = small_cloth(24, 24)
    scene.steps_per_frame = 100  # long enough, and stable
    before = signal.signal(signal.SIGALRM, handle)
    signal.setitimer(signal.ITIMER_REAL, 0.2)
    try:
        with pytest.raises(Enough):
            dpe.Simulator(scene).run(frames=1000)
    finally:
        signal.signal(signal.SIGALRM, before)
