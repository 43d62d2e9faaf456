"""The examples do what they say."""

import os
import pathlib
import sys

import numpy as np
import pytest

import dpe
from conftest import small_cloth

EXAMPLES = pathlib.Path(os.environ["DPE_SOURCE_DIR"]) / "python" / "examples"
sys.path.insert(0, str(EXAMPLES))


def assert_is_a_picture(path):
    image = pytest.importorskip("matplotlib.image").imread(path)
    assert image.shape[0] > 300 and image.shape[1] > 400
    assert 0.02 < (image[..., :3].min(axis=2) < 0.9).mean() < 0.6


def test_recover_from_markers(tmp_path):
    pytest.importorskip("matplotlib", reason="needs Matplotlib")
    import recover_from_markers

    off = recover_from_markers.main(tmp_path / "picture.png")
    # Five normal numbers: beyond 4 once in 3000 times, and the seed is fixed.
    assert np.abs(off).max() < 4
    assert_is_a_picture(tmp_path / "picture.png")


def test_speed_accuracy(tmp_path):
    pytest.importorskip("matplotlib", reason="needs Matplotlib")
    import speed_accuracy

    speed_accuracy.main(tmp_path / "picture.png", frames=3)
    assert_is_a_picture(tmp_path / "picture.png")


def test_speed_accuracy_is_thirty_lines():
    text = (EXAMPLES / "speed_accuracy.py").read_text().split('"""')[2]
    code = [line for line in text.splitlines() if line.strip()]
    assert len(code) <= 34


def test_torch_function():
    torch = pytest.importorskip("torch", reason="needs PyTorch")
    import torch_function

    scene = small_cloth(settings="GG")
    simulator = dpe.Simulator(scene)
    p = torch.tensor(scene.parameters, requires_grad=True)
    weights = torch.from_numpy(np.random.default_rng(1).standard_normal((6, 16, 3)))
    loss = (weights * torch_function.simulate(p, simulator, 6) ** 2).sum()
    loss.backward()
    x = dpe.simulate(scene, 6).positions
    expected = dpe.gradient(scene, 2 * weights.numpy() * x)
    np.testing.assert_allclose(p.grad.numpy(), expected, rtol=1e-12)


def test_jax_function():
    jax = pytest.importorskip("jax", reason="needs JAX")
    import jax_function

    jax.config.update("jax_enable_x64", True)
    scene = small_cloth(settings="GG")
    simulate = jax_function.make_simulate(dpe.Simulator(scene), 6)
    weights = np.random.default_rng(1).standard_normal((6, 16, 3))
    loss = lambda p: (weights * simulate(p) ** 2).sum()
    x = dpe.simulate(scene, 6).positions
    expected = dpe.gradient(scene, 2 * weights * x)
    for gradient in (jax.grad(loss), jax.jit(jax.grad(loss))):
        np.testing.assert_allclose(gradient(scene.parameters), expected, rtol=1e-12)
