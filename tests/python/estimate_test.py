"""Estimation: the program's values, arrays as targets, progress, Ctrl-C."""

import json
import os
import signal
import subprocess
import sys
import time

import numpy as np
import pytest

import dpe
from conftest import DATA, small_cloth


def program_report(run_program, folder, *arguments):
    run_program("estimate_cloth", *arguments, f"--output_dir={folder}")
    return json.loads((folder / "report.json").read_text())


def flags(options):
    return [f"--{name}={str(value).lower() if isinstance(value, bool) else value}"
            for name, value in options.items()]


def assert_same_result(found, report):
    assert found.termination == report["termination"]
    assert found.iterations == report["iterations"]
    assert found.evaluations == report["evaluations"]
    assert found.solver == report["solver"] and found.init == report["init"]
    assert found.cost == report["final_cost"]
    assert found.rms == report["rms_position_error_m"]
    values = np.concatenate([b["values"] for b in report["parameters"]])
    assert values.tolist() == found.parameters.tolist()


CASES = {
    "inverse dynamics": dict(settings="nL", frames=20),
    "uniform start": dict(settings="nG", frames=15, init="uniform:3", estimate="damping"),
    "noisy": dict(settings="nR", frames=20, noise_sigma=0.002, seed=3, loss="huber",
                  uncertainty="on", estimate="drag,damping"),
    "gradient": dict(settings="nG", frames=12, solver="lbfgs", init="screen",
                     max_iterations=30),
    "prior": dict(settings="nL", frames=12, noise_sigma=0.01, seed=1, horizon="full",
                  prior="stiffness:lognormal:30,0.5", smoothness="stiffness=100",
                  threads=2, validate_frames=20, init="uniform:20", max_iterations=20),
    "auto": dict(settings="auto", frames=24),
}


@pytest.mark.parametrize("case", CASES)
def test_estimate_reproduces_the_program(case, tmp_path, run_program):
    options = CASES[case]
    path = tmp_path / "cloth.txt"
    small_cloth(5, 5, frames=30).save(path)
    try:
        report = program_report(run_program, tmp_path / "out", f"--scene={path}",
                                *flags(options))
    except subprocess.CalledProcessError as stopped:
        assert stopped.returncode == 2, stopped.stderr
        report = json.loads((tmp_path / "out" / "report.json").read_text())
    found = dpe.estimate(path, **options)
    assert_same_result(found, report)
    in_memory = dpe.estimate(dpe.Scene.load(path), **options)
    assert in_memory.parameters.tolist() == found.parameters.tolist()
    assert found.parameter_deviation_percent == report["parameter_deviation_percent"]
    if options.get("validate_frames"):
        assert found.validation_rms == report["validation"]["rms_position_error_m"]
    mine, theirs = found.report(), dict(report)
    for times in (mine, theirs):
        times.pop("wall_time_s")
        for candidate in (times.get("model_selection") or {}).get("candidates", []):
            candidate.pop("seconds")
    assert mine == theirs


def test_a_target_in_a_file_and_in_memory(tmp_path, run_program):
    scene = small_cloth(5, 5, frames=20)
    path = tmp_path / "cloth.txt"
    scene.save(path)
    motion = dpe.simulate(scene)
    motion.save(tmp_path / "motion.npy")
    wrong = scene.copy()
    wrong.stiffness = 99.0
    wrong.save(tmp_path / "wrong.txt")
    report = program_report(run_program, tmp_path / "out",
                            f"--scene={tmp_path / 'wrong.txt'}",
                            f"--target={tmp_path / 'motion.npy'}")
    by_file = dpe.estimate(tmp_path / "wrong.txt", tmp_path / "motion.npy")
    assert_same_result(by_file, report)
    for target in (motion.positions, motion, dpe.Observations(motion.positions)):
        by_array = dpe.estimate(wrong, target)
        assert by_array.parameters.tolist() == by_file.parameters.tolist()
    np.testing.assert_allclose(by_array.parameters, scene.parameters, rtol=1e-6)
    np.testing.assert_allclose(by_array.scene.stiffness[by_array.blocks[0].elements],
                               by_array.parameters, rtol=0)
    assert (wrong.stiffness == 99.0).all()


def test_missing_vertices_are_nan(cloth):
    target = dpe.simulate(cloth, 20).positions.copy()
    target[::3, 4] = np.nan
    target[5, 7] = np.nan
    cloth.settings = "nG"
    cloth.stiffness = cloth.stiffness.mean()
    found = dpe.estimate(cloth, target, frames=20, init="uniform:5")
    whole = dpe.estimate(cloth, dpe.simulate(cloth, 20), frames=20, init="uniform:5")
    assert found.init == "uniform"
    assert found.converged and whole.converged
    assert whole.rms < 1e-9 < found.rms


def test_several_captures(cloth):
    other = cloth.copy()
    other.wind = [0.0, 0.0, 3.0]
    cloth.settings = other.settings = "nG"
    cloth.stiffness = other.stiffness = 17.0
    targets = [dpe.simulate(s, 15).positions for s in (cloth, other)]
    found = dpe.estimate([cloth, other], targets, frames=15, init="uniform:4")
    assert found.parameters == pytest.approx([17.0], rel=1e-6)
    assert len(found.scenes) == len(found.trajectories) == 2


def test_markers_between_vertices(cloth):
    cloth.settings = "nG"
    cloth.stiffness = 12.0
    motion = dpe.simulate(cloth, 24)
    vertices, weights = cloth.triangles[3:9], np.tile([0.2, 0.3, 0.5], (6, 1))
    times = np.arange(1, 23) + 0.4
    seen = dpe.marker_positions(motion, vertices, weights, times)
    at_frames = dpe.marker_positions(motion, vertices, weights, np.arange(4.0))
    np.testing.assert_allclose(
        at_frames, (motion.positions[:4, vertices] * weights[..., None]).sum(axis=2),
        atol=1e-13)
    observations = dpe.Observations(sigma=0.001)
    observations.add_markers(vertices, weights, times, seen)
    assert observations.num_markers == 6 and observations.num_samples == 6 * 22
    found = dpe.estimate(cloth, observations, frames=24, init="uniform:40")
    assert found.uncertainty.noise_is_known
    assert found.parameters == pytest.approx([12.0], rel=1e-5)


def test_markers_that_are_not_on_the_cloth_are_refused(cloth):
    motion = dpe.simulate(cloth, 5)
    for vertices, weights, message in (
        ([[16]], [[1.0]], "vertex 16"),
        ([[-1]], [[1.0]], "vertex -1"),
        ([[1, 2, 3]], [[0.5, 0.5, 0.5]], "add up"),
        ([[1, 2]], [[0.5, 0.5]], r"\(markers, 3\)"),
    ):
        with pytest.raises(ValueError, match=message):
            dpe.marker_positions(motion, vertices, weights, [1.0])
        with pytest.raises(ValueError, match=message):
            observations = dpe.Observations()
            observations.add_markers(vertices, weights, [1.0], [[[0.0, 0.0, 0.0]]])
            dpe.estimate(cloth, observations)
    with pytest.raises(ValueError, match="0 to 4"):
        dpe.marker_positions(motion, [[1]], [[1.0]], [4.5])


def test_error_bars(cloth):
    cloth.settings = "nG"
    cloth.estimate_damping = True
    cloth.stiffness = 15.0
    found = dpe.estimate(cloth, frames=20, noise_sigma=0.001, seed=5, uncertainty="on")
    assert found.uncertainty.ok and found.uncertainty.noise_is_known
    assert found.covariance.shape == (2, 2)
    std = found.standard_deviations
    # Coordinates are logarithms: std(p) = p std(ln p).
    np.testing.assert_allclose(
        std, found.parameters * np.sqrt(np.diag(found.covariance)), rtol=1e-10)
    assert (np.abs(found.parameters - cloth.parameters) < 5 * std).all()
    assert 0.8 < found.uncertainty.reduced_chi_square < 1.2
    assert "stiffness" in str(found.uncertainty)
    none = dpe.estimate(cloth, frames=20, uncertainty="off")
    assert none.covariance.shape == (0, 0) and np.isnan(none.standard_deviations).all()


def test_progress_and_history(cloth):
    seen = []
    cloth.stiffness = 15.0
    found = dpe.estimate(cloth, frames=15, settings="nG", init="uniform:2",
                         horizon="full", progress=seen.append)
    assert [i.cost for i in seen] == [i.cost for i in found.history]
    assert len(seen) >= found.iterations > 3
    assert seen[0].rms > 10 * seen[-1].rms
    assert found.history[-1].seconds <= found.seconds


def test_progress_can_stop_the_fit(cloth):
    stopped = dpe.estimate(cloth, frames=15, settings="nG", init="uniform:2",
                           progress=lambda i: i.iteration == 2)
    assert stopped.termination == "interrupted" and not stopped.converged
    assert stopped.history[-1].iteration == 2
    assert np.isfinite(stopped.parameters).all()
    assert stopped.trajectory.positions.shape == (15, 16, 3)


def test_an_exception_in_progress_comes_through_with_the_best_so_far(cloth):
    class Mine(Exception):
        pass

    def progress(iteration):
        if iteration.iteration == 3:
            raise Mine("enough")

    with pytest.raises(Mine, match="enough") as caught:
        dpe.estimate(cloth, frames=15, settings="nG", init="uniform:2",
                     progress=progress)
    result = caught.value.result
    assert result.termination == "interrupted"
    assert result.rms < result.initial_rms


INTERRUPTED = """
import os, signal, sys, time
import dpe
scene = dpe.Scene.load(sys.argv[1])
told = []
def progress(iteration):
    told.append(iteration.rms)
    if told[-1] < told[0] and min(told[:-1]) == told[0]:
        print("ready", flush=True)
try:
    dpe.estimate(scene, settings="LL", init="uniform:9", noise_sigma=0.02, horizon="full",
                 max_iterations=100000, frames=60, progress=progress)
except KeyboardInterrupt as stop:
    r = stop.result
    print(time.process_time())
    print("stopped", r.termination, r.rms < r.initial_rms, len(r.parameters), flush=True)
"""


def processor_time(pid):
    with open(f"/proc/{pid}/stat") as stat:
        fields = stat.read().rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


@pytest.mark.skipif(not os.path.exists("/proc/self/stat"), reason="needs /proc")
def test_ctrl_c_stops_a_fit_within_a_second_with_the_best_so_far():
    process = subprocess.Popen(
        [sys.executable, "-c", INTERRUPTED, DATA / "corners.txt"],
        stdout=subprocess.PIPE, text=True)
    assert process.stdout.readline() == "ready\n"
    time.sleep(np.random.default_rng().uniform(0.1, 1.0))
    # Processor time: the machine may be busy with other things.
    before = processor_time(process.pid)
    process.send_signal(signal.SIGINT)
    after = float(process.stdout.readline())
    line = process.stdout.readline()
    process.wait()
    assert line == f"stopped interrupted True {140 + 726}\n"
    assert after - before < 1.0


def test_saving_writes_what_the_program_writes(tmp_path, run_program):
    path = tmp_path / "cloth.txt"
    small_cloth(5, 5, frames=15).save(path)
    run_program("estimate_cloth", f"--scene={path}", f"--output_dir={tmp_path / 'a'}")
    files = dpe.estimate(path).save(tmp_path / "b")
    assert sorted(os.listdir(tmp_path / "a")) == sorted(os.listdir(tmp_path / "b"))
    assert len(files) == 3
    for name in os.listdir(tmp_path / "a"):
        if name != "report.json":
            assert (tmp_path / "a" / name).read_bytes() == (
                tmp_path / "b" / name).read_bytes()


def test_checkpoints(tmp_path):
    scene = small_cloth(5, 5, frames=15, settings="nG")
    scene.stiffness = 15.0
    options = dict(init="uniform:2", checkpoint=tmp_path / "fit.json")
    stopped = dpe.estimate(scene, **options, max_iterations=2, horizon="full")
    assert stopped.termination == "max_iterations" and stopped.iterations == 2
    resumed = dpe.estimate(scene, **options, horizon="full",
                           resume=tmp_path / "fit.json")
    assert resumed.converged and resumed.iterations > 2
    assert resumed.history[0].iteration >= 2
    assert resumed.parameters == pytest.approx([15.0], rel=1e-6)


@pytest.mark.parametrize("options, error, message", [
    (dict(solver="newton"), dpe.SceneError, "solver.*newton.*lbfgs"),
    (dict(settings="nn"), dpe.SceneError, "nothing is estimated"),
    (dict(threads=0), ValueError, "threads.*at least 1"),
    (dict(loss_scale="wide"), TypeError, "loss_scale"),
    (dict(init=np.ones(3)), ValueError, "3"),
    (dict(speed=3), TypeError, "speed"),
    (dict(prior="stiffness:triangular:1,2"), dpe.SceneError, "prior.*triangular"),
    (dict(init="uniform:-2"), dpe.SceneError, "init"),
    (dict(rest_shape="uv", target=np.zeros((10, 16, 3))), ValueError, "rest_shape"),
    (dict(target=np.zeros((10, 15, 3))), ValueError, "15 vertices"),
    (dict(target="nowhere.csv"), dpe.SceneError, "nowhere.csv"),
])
def test_bad_options_are_named(options, error, message, cloth):
    target = options.pop("target", None)
    with pytest.raises(error, match=message):
        dpe.estimate(cloth, target, **options)


def test_inverse_dynamics(cloth):
    motion = dpe.simulate(cloth, 30)
    wrong = cloth.copy()
    wrong.stiffness = 1.0
    found = dpe.inverse_dynamics(wrong, motion.positions)
    assert found.ok
    np.testing.assert_allclose(found.parameters, cloth.parameters, rtol=1e-6)
    gap = motion.positions.copy()
    gap[3, 9] = np.nan
    with pytest.raises(dpe.SceneError, match="observed"):
        dpe.inverse_dynamics(wrong, gap)
