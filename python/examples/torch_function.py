"""A simulation as a function that PyTorch differentiates.

    positions = simulate(parameters, simulator, frames)

parameters: float64 tensor (parameters,), SI units, in the order of
simulator.parameter_blocks; positions: m, (frames, vertices, 3). On the CPU.
"""

import torch


class Simulate(torch.autograd.Function):
    @staticmethod
    def forward(ctx, parameters, simulator, frames):
        ctx.rollout = simulator.run(parameters.detach().numpy(), frames)
        # A copy: the rollout's own array is read-only, and PyTorch wants to own its data.
        return torch.from_numpy(ctx.rollout.positions.copy())

    @staticmethod
    def backward(ctx, dl_dx):
        gradient = ctx.rollout.gradient(dl_dx.numpy())
        return torch.from_numpy(gradient), None, None


def simulate(parameters, simulator, frames):
    return Simulate.apply(parameters, simulator, frames)
