"""Residuals of one's own: called right, checked, minimised by scipy."""

import numpy as np
import pytest
from scipy import optimize, sparse

import dpe
from conftest import small_cloth

FRAMES = 16


def centre_cost(frame, positions, velocities, weight=50.0):
    """Where the centre of the cloth is, and how fast one vertex moves."""
    target = positions[frame].mean(axis=0)
    target_speed = (velocities[frame, 5] ** 2).sum()

    def evaluate(states, derivatives):
        (state,) = states
        n = len(state.positions)
        r = np.concatenate([
            weight * (state.positions.mean(axis=0) - target),
            [0.1 * ((state.velocities[5] ** 2).sum() - target_speed)],
        ])
        if not derivatives:
            return r
        dx = np.zeros((4, n, 3))
        dv = np.zeros((4, n, 3))
        for c in range(3):
            dx[c, :, c] = weight / n
        dv[3, 5] = 0.2 * state.velocities[5]
        return r, [dx], [dv]

    return dpe.TrajectoryCost(4, [(0, frame)], evaluate)


@pytest.fixture
def scene():
    scene = small_cloth(settings="nG", frames=FRAMES)
    scene.stiffness = 20.0
    scene.estimate_damping = True
    scene.damping = 0.3
    return scene


@pytest.fixture
def problem(scene):
    motion = dpe.simulate(scene)
    costs = [centre_cost(f, motion.positions, motion.velocities)
             for f in range(1, FRAMES)]
    return dpe.ResidualProblem(scene, costs)


def test_check_cost_accepts_a_right_derivative(scene):
    cost = centre_cost(4, np.ones((5, 16, 3)), np.ones((5, 16, 3)))
    assert cost.num_residuals == 4 and cost.states == [(0, 4)]
    dpe.check_cost(cost, dpe.simulate(scene))


def test_check_cost_finds_a_wrong_derivative(scene):
    def evaluate(states, derivatives):
        r = states[0].positions[3] ** 2
        dx = np.zeros((3, 16, 3))
        dx[range(3), 3, range(3)] = 2.001 * states[0].positions[3]
        return (r, [dx]) if derivatives else r

    with pytest.raises(ValueError, match="vertex 3"):
        dpe.check_cost(dpe.TrajectoryCost(3, [(0, 4)], evaluate), dpe.simulate(scene))


def test_dense_flat_and_sparse_derivatives_are_the_same(scene):
    values = np.random.default_rng(1).standard_normal((2, 16, 3))
    values[:, ::2] = 0.0
    shapes = [values, values.reshape(2, 48), sparse.csr_matrix(values.reshape(2, 48)),
              sparse.coo_matrix(values.reshape(2, 48))]

    def cost(dx):
        def evaluate(states, derivatives):
            r = np.tensordot(values, states[1].positions, 2)
            return (r, [None, dx]) if derivatives else r
        return dpe.TrajectoryCost(2, [(0, 2), (0, 5)], evaluate)

    problems = [dpe.ResidualProblem(scene, [cost(dx)]) for dx in shapes]
    jacobians = [p.jacobian(p.start) for p in problems]
    assert np.abs(jacobians[0]).max() > 0
    for jacobian in jacobians[1:]:
        np.testing.assert_allclose(jacobian, jacobians[0], rtol=1e-12)


def test_derivatives_agree_with_differences(problem):
    q = problem.start + [0.1, -0.2]
    jacobian = problem.jacobian(q)
    assert jacobian.shape == (4 * (FRAMES - 1), 2)
    numeric = optimize.approx_fprime(q, problem.residuals, 1e-7)
    np.testing.assert_allclose(jacobian, numeric, atol=1e-5 * np.abs(jacobian).max())
    r = problem.residuals(q)
    assert problem.cost(q) == pytest.approx(0.5 * r @ r, rel=1e-12)
    np.testing.assert_allclose(problem.gradient(q), jacobian.T @ r, rtol=1e-9)
    error = optimize.check_grad(problem.cost, problem.gradient, q, epsilon=1e-7)
    assert error < 1e-6 * np.linalg.norm(problem.gradient(q))


def test_least_squares_recovers_the_parameters(scene, problem):
    truth = problem.parameters(problem.start)
    start = problem.coordinates(truth * [0.5, 2.0])
    before = problem.num_rollouts
    found = optimize.least_squares(problem.residuals, start, problem.jacobian,
                                   xtol=1e-14, ftol=1e-14, gtol=1e-14)
    np.testing.assert_allclose(problem.parameters(found.x), truth, rtol=1e-5)
    assert problem.scene(found.x).damping == pytest.approx(0.3, rel=1e-5)
    # One rollout per point, whether residuals or the Jacobian are asked for there.
    assert problem.num_rollouts - before <= found.nfev + found.njev


def test_one_point_is_one_rollout(problem):
    q = problem.start
    for _ in range(3):
        problem.residuals(q), problem.jacobian(q), problem.cost(q), problem.gradient(q)
    assert problem.num_rollouts == 1


def test_position_costs_give_what_estimate_minimises(scene):
    target = dpe.simulate(scene).positions.copy()
    wrong = scene.copy()
    wrong.stiffness = 9.0
    found = dpe.estimate(wrong, target, init="scene", horizon="full", max_iterations=0)
    problem = dpe.ResidualProblem(wrong, dpe.position_costs(wrong, target))
    assert problem.cost(problem.start) == pytest.approx(found.initial_cost, rel=1e-12)
    solved = optimize.least_squares(problem.residuals, problem.start, problem.jacobian)
    np.testing.assert_allclose(problem.parameters(solved.x), [20.0, 0.3], rtol=1e-4)


def test_own_and_position_costs_together(scene):
    motion = dpe.simulate(scene)
    costs = dpe.position_costs(scene, motion, sigma=0.01)
    costs.append(centre_cost(3, motion.positions, motion.velocities))
    problem = dpe.ResidualProblem(scene, costs, threads=2,
                                  prior="stiffness:lognormal:40,1")
    r = problem.residuals(problem.start)
    assert problem.cost(problem.start) == pytest.approx(
        0.5 * r @ r + 0.5 * np.log(20 / 40) ** 2, rel=1e-9)


def test_what_a_residual_raises_comes_through(scene):
    class Mine(Exception):
        pass

    def evaluate(states, derivatives):
        raise Mine("here")

    problem = dpe.ResidualProblem(scene, [dpe.TrajectoryCost(1, [(0, 2)], evaluate)])
    for i, method in enumerate([problem.residuals, problem.jacobian, problem.cost,
                                problem.gradient]):
        with pytest.raises(Mine, match="here"):
            method(problem.start + 0.01 * i)


@pytest.mark.parametrize("answer, message", [
    (np.zeros(3), "return"),
    ((np.zeros(2), [None]), r"residuals has shape \(2,\)"),
    ((np.zeros(3), [None, None]), "2 entries"),
    ((np.zeros(3), [np.zeros((3, 15, 3))]), r"dr_dx has shape \(3, 15, 3\)"),
    ((np.zeros(3), [sparse.eye(3, 45)]), r"dr_dx has shape \(3, 45\)"),
])
def test_a_wrong_answer_is_named(answer, message, scene):
    evaluate = lambda states, derivatives: answer if derivatives else np.zeros(3)
    problem = dpe.ResidualProblem(scene, [dpe.TrajectoryCost(3, [(0, 2)], evaluate)])
    problem.residuals(problem.start)
    with pytest.raises(ValueError, match=message):
        problem.jacobian(problem.start)


def test_a_point_that_cannot_be_evaluated_is_infinite(scene):
    evaluate = lambda states, derivatives: None
    problem = dpe.ResidualProblem(scene, [dpe.TrajectoryCost(3, [(0, 2)], evaluate)])
    assert np.isinf(problem.residuals(problem.start)).all()
    assert problem.cost(problem.start) == np.inf and problem.message
    with pytest.raises(dpe.SimulationError):
        problem.jacobian(problem.start)


def test_states_that_are_not_simulated_are_refused(scene):
    with pytest.raises(dpe.SceneError):
        dpe.ResidualProblem(scene, [dpe.TrajectoryCost(1, [(3, 2)], lambda s, d: 0)])
