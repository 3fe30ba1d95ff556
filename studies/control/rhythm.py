"""A baseline to beat: rhythms of a few numbers, trained by the cross-entropy method.

Each chamber follows a sine, cut to pressures that a chamber can have: one period, one phase per
chamber, one gain and one bias. The cross-entropy method (Rubinstein 1999) draws such rhythms from
a normal distribution, keeps the best, and fits the distribution to them.
"""

from typing import Any, NamedTuple

import numpy as np

from studies import Array

_ELITE = 0.2  # part of a generation that is kept
_SMOOTH = 0.2  # part of the old spread that is kept
_PERIODS = (2.0, 10.0)  # s, the shortest and the longest


class Trained(NamedTuple):
    """Result of a training.

    Attributes:
        rhythm: the best one's numbers, see `press`, (S + 2,).
        reward: mean of the best of each generation, (G,) [L per episode].
    """

    rhythm: Array
    reward: Array


def press(rhythms: Array, time: float, segments: int) -> Array:
    """Pressures over the peak at a time [s], (B, S) of rhythms (B, S + 2).

    A rhythm is the place of its period between 2 and 10 s on a logarithmic scale, phases of the
    chambers after the first in cycles, the logarithm of its gain, and its bias.
    """
    low, high = _PERIODS
    period = low * (high / low) ** np.clip(rhythms[:, :1], 0.0, 1.0)
    phases = np.concatenate([np.zeros((len(rhythms), 1)), rhythms[:, 1:segments]], axis=1)
    gain, bias = np.exp(rhythms[:, segments : segments + 1]), rhythms[:, segments + 1 :]
    return np.clip(0.5 + gain * (np.sin(2 * np.pi * (time / period - phases)) + bias), 0.0, 1.0)


def rewards(envs: Any, rhythms: Array, seed: int) -> Array:
    """Sum of the rewards of one episode for each rhythm, (B,).

    Args:
        envs: a WalkVectorEnv of as many robots as there are rhythms.
        rhythms: (B, S + 2).
        seed: of the episode.
    """
    settings = envs.settings
    envs.reset(seed=seed)
    total, alive = np.zeros(len(rhythms)), np.ones(len(rhythms), dtype=bool)
    for step in range(settings.length):
        actions = press(rhythms, step * settings.control_period, settings.chambers)
        _, reward, fallen, _, _ = envs.step(actions.astype(np.float32))
        total += np.where(alive, reward, 0.0)
        alive &= ~fallen
    return total


def train(envs: Any, generations: int, seed: int) -> Trained:
    """Find a rhythm by the cross-entropy method.

    Args:
        envs: a WalkVectorEnv, a robot for each draw of a generation.
        generations: number of them.
        seed: of the random numbers.
    """
    rng, segments = np.random.default_rng(seed), envs.settings.chambers
    mean = np.zeros(segments + 2)
    mean[0] = 0.5
    spread = np.concatenate([[0.3], np.full(segments - 1, 0.5), [0.5, 0.5]])
    keep = max(2, round(_ELITE * envs.num_envs))
    best, greatest, means = mean, -np.inf, []
    for generation in range(generations):
        rhythms = mean + spread * rng.standard_normal((envs.num_envs, len(mean)))
        sums = rewards(envs, rhythms, seed + generation)
        order = np.argsort(sums)[::-1]
        if sums[order[0]] > greatest:
            best, greatest = rhythms[order[0]], sums[order[0]]
        elite = rhythms[order[:keep]]
        mean = elite.mean(axis=0)
        spread = _SMOOTH * spread + (1 - _SMOOTH) * elite.std(axis=0)
        means.append(float(sums[order[:keep]].mean()))
    return Trained(best, np.array(means))
