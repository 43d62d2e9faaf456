"""Derivatives: against differences, against each other, and as scipy wants them."""

import numpy as np
import pytest
from scipy import optimize

import dpe
from conftest import small_cloth

KINDS = ["nL", "LL", "GG", "Rn"]


def loss_of(scene, frames):
    """A loss with positions and velocities in it, and its gradient, as functions of p."""
    simulator = dpe.Simulator(scene)
    random = np.random.default_rng(3)
    n = len(scene.mass)
    target = simulator.run(frames=frames).positions + 0.05 * random.standard_normal(
        (frames, n, 3))
    weight = random.standard_normal((frames, n, 3))

    def fun(p):
        rollout = simulator.run(p, frames)
        return (0.5 * ((rollout.positions - target) ** 2).sum()
                + (weight * rollout.velocities).sum())

    def jac(p):
        rollout = simulator.run(p, frames)
        return rollout.gradient(rollout.positions - target, weight)

    return fun, jac


@pytest.mark.parametrize("settings", KINDS)
def test_gradient_passes_scipy_s_check_grad(settings):
    """check_grad takes one absolute step for all parameters, which suits none if they
    are kilogrammes and N/m; so the loss is a function of p / p0, about 1 each. Its
    forward differences are wrong by half the step times the curvature: with the best
    step they are good to 1e-6 of the gradient."""
    scene = small_cloth(settings=settings)
    fun, jac = loss_of(scene, 8)
    p0 = scene.parameters
    scaled = (lambda s: fun(s * p0)), (lambda s: jac(s * p0) * p0)
    start = np.full(len(p0), 1.1)
    norm = np.linalg.norm(scaled[1](start))
    assert norm > 1e-2
    error = min(optimize.check_grad(*scaled, start, epsilon=h) / norm
                for h in (1e-6, 1e-7, 1e-8))
    assert error < 1e-6, error


def test_check_grad_finds_a_wrong_gradient():
    scene = small_cloth(settings="GG")
    fun, jac = loss_of(scene, 8)
    p0 = scene.parameters
    wrong = lambda s: jac(s * p0) * p0 * [1.0, 1.00001]
    start = np.full(2, 1.1)
    error = optimize.check_grad(lambda s: fun(s * p0), wrong, start, epsilon=1e-7)
    assert error > 1e-6 * np.linalg.norm(wrong(start))


def test_gradient_of_everything_agrees_with_central_differences():
    scene = small_cloth(settings="LL")
    scene.estimate_damping = scene.estimate_drag = scene.estimate_wind = True
    scene.estimate_initial_velocity = scene.estimate_initial_position = True
    fun, jac = loss_of(scene, 6)
    p = scene.parameters * 1.02
    direction = np.random.default_rng(5).standard_normal(len(p)) * np.maximum(
        np.abs(p), 0.1)
    h = 1e-5
    numeric = (fun(p + h * direction) - fun(p - h * direction)) / (2 * h)
    assert jac(p) @ direction == pytest.approx(numeric, rel=1e-7)


def test_tangent_adjoint_and_jacobian_agree(cloth):
    frames, at, vertices = 9, [1, 4, -1], [2, 5, 7, 11]
    rollout = dpe.Simulator(cloth).run(frames=frames)
    jacobian = rollout.jacobian(at, vertices)
    parameters = len(cloth.parameters)
    assert jacobian.shape == (3, 4, 3, parameters)
    for method in ("tangent", "adjoint"):
        other = rollout.jacobian(at, vertices, method=method)
        np.testing.assert_allclose(other, jacobian, rtol=1e-9, atol=1e-14)
    dp = np.random.default_rng(2).standard_normal(parameters)
    dx, dv = rollout.jvp(dp)
    assert dx.shape == dv.shape == (frames, 16, 3)
    np.testing.assert_allclose(jacobian @ dp, dx[at][:, vertices], rtol=1e-9, atol=1e-13)
    speeds = rollout.jacobian(at, vertices, velocities=True)
    np.testing.assert_allclose(speeds @ dp, dv[at][:, vertices], rtol=1e-9, atol=1e-12)
    weights = np.random.default_rng(4).standard_normal((frames, 16, 3))
    assert rollout.gradient(weights) @ dp == pytest.approx((weights * dx).sum(), rel=1e-9)
    assert rollout.gradient(None, weights) @ dp == pytest.approx(
        (weights * dv).sum(), rel=1e-9)


def test_the_functions_are_the_methods(cloth):
    weights = np.random.default_rng(4).standard_normal((7, 16, 3))
    p = 1.3 * cloth.parameters
    rollout = dpe.Simulator(cloth).run(p, 7)
    assert (dpe.gradient(cloth, weights, parameters=p) == rollout.gradient(weights)).all()
    assert (dpe.jvp(cloth, p, 7, parameters=p)[0] == rollout.jvp(p)[0]).all()
    assert (dpe.jacobian(cloth, 7, at_frames=[6], parameters=p)
            == rollout.jacobian([6])).all()


def test_rollouts_may_be_differentiated_in_any_order(cloth):
    simulator = dpe.Simulator(cloth)
    weights = np.ones((10, 16, 3))
    first = simulator.run()
    expected = first.gradient(weights)
    simulator.run(2 * cloth.parameters)
    assert (first.gradient(weights) == expected).all()
    second = simulator.run(3 * cloth.parameters)
    assert (first.gradient(weights) == expected).all()
    assert (second.gradient(weights) != expected).any()


def test_a_small_memory_limit_changes_nothing(cloth):
    weights = np.ones((10, 16, 3))
    least = dpe.Simulator(cloth, memory_limit=0).run()
    most = dpe.Simulator(cloth).run()
    assert least.kept_bytes < most.kept_bytes
    assert (least.gradient(weights) == most.gradient(weights)).all()


def test_several_objects(cloth):
    cloth.add(small_cloth(5, 3).objects[0])
    cloth.settings = "nL,GG"
    rollout = dpe.Simulator(cloth).run(frames=6)
    weights = [None, np.ones((6, 15, 3))]
    gradient = rollout.gradient(weights)
    first = cloth.parameter_blocks[0]
    assert (gradient[first.slice] == 0).all()
    assert (gradient[first.size:] != 0).all()
    dx, _ = rollout.jvp(np.ones(len(gradient)))
    assert dx[0].shape == (6, 16, 3) and dx[1].shape == (6, 15, 3)
    assert rollout.jacobian([5], object=1).shape == (1, 15, 3, len(gradient))


def test_shapes_that_do_not_fit_are_named(cloth):
    rollout = dpe.Simulator(cloth).run()
    with pytest.raises(ValueError, match=r"dl_dx has shape \(9, 16, 3\).*\(10, 16, 3\)"):
        rollout.gradient(np.zeros((9, 16, 3)))
    with pytest.raises(ValueError, match="dp has shape"):
        rollout.jvp(np.zeros(3))
    with pytest.raises(IndexError, match="vertices: 16"):
        rollout.jacobian([1], [16])
    with pytest.raises(ValueError, match="tangent"):
        rollout.jacobian(method="magic")


def test_nothing_unknown_is_an_error(cloth):
    cloth.settings = "nn"
    with pytest.raises(dpe.SceneError, match="nothing is unknown"):
        dpe.gradient(cloth, np.zeros((10, 16, 3)))


def test_scipy_recovers_two_parameters():
    scene = small_cloth(settings="nG")
    scene.stiffness = 20.0
    scene.damping = 0.3
    scene.estimate_damping = True
    frames = 20
    target = dpe.simulate(scene, frames).positions
    simulator = dpe.Simulator(scene)
    truth = scene.parameters

    def fun(q):
        rollout = simulator.run(np.exp(q), frames)
        error = 100 * (rollout.positions - target)
        return 0.5 * (error**2).sum(), 100 * rollout.gradient(error) * np.exp(q)

    found = optimize.minimize(fun, np.log(truth * [0.6, 2.0]), jac=True,
                              method="L-BFGS-B", options={"ftol": 1e-16})
    np.testing.assert_allclose(np.exp(found.x), truth, rtol=1e-5)
