"""A simulation as a function that JAX differentiates (reverse mode), also under jit.

    simulate = make_simulate(simulator, frames)
    positions = simulate(parameters)

parameters: float64 array (parameters,), SI units, in the order of
simulator.parameter_blocks; positions: m, (frames, vertices, 3). JAX has to be told to
use float64: jax.config.update("jax_enable_x64", True).
"""

import jax
import numpy as np


def make_simulate(simulator, frames):
    vertices = len(simulator.scene.mass)
    size = len(simulator.parameters)
    states = jax.ShapeDtypeStruct((frames, vertices, 3), np.float64)
    unknowns = jax.ShapeDtypeStruct((size,), np.float64)

    def run(parameters):
        return np.array(simulator.run(np.asarray(parameters), frames).positions)

    def pull_back(parameters, dl_dx):
        rollout = simulator.run(np.asarray(parameters), frames)
        return rollout.gradient(np.asarray(dl_dx))

    @jax.custom_vjp
    def simulate(parameters):
        return jax.pure_callback(run, states, parameters)

    def forward(parameters):
        return simulate(parameters), parameters

    def backward(parameters, dl_dx):
        return (jax.pure_callback(pull_back, unknowns, parameters, dl_dx),)

    simulate.defvjp(forward, backward)
    return simulate
