"""dm_control's environment walks as Gymnasium's does, and keeps dm_env's rules."""

import sys
import unittest

import numpy as np
import pytest

import mjsim.env
from mjsim.env.gym import WalkEnv
from mjsim.env.settings import Names

pytest.importorskip("mjsim.env.dm_binding", exc_type=ImportError)
from dm_control.mujoco.wrapper.mjbindings import sizes
from dm_env import test_utils


class DmEnvsOwnTests(test_utils.EnvironmentTestMixin, unittest.TestCase):
    """dm_env's conformance tests."""

    def make_object_under_test(self):
        return mjsim.env.load("gelatin", "felt", seed=3, duration=1.0)


def test_dm_controls_environment_walks_as_gymnasiums():
    gym, dm = WalkEnv(surfaces=("gelatin",)), mjsim.env.load("gelatin")
    felt, _ = gym.reset(seed=0)
    seen = dm.reset().observation
    actions = np.random.default_rng(2).random((20, 3))
    for action in actions:
        np.testing.assert_allclose(np.concatenate(list(seen.values())), felt, atol=1e-6)
        felt, reward, *_ = gym.step(action)
        step = dm.step(action)
        seen = step.observation
        assert step.reward == pytest.approx(reward, abs=1e-9)
    assert tuple(seen) == Names._fields


def test_a_strip_that_falls_ends_its_episode_as_gymnasiums_does():
    base = {"robot": {"weight_per_length": 0.05}, "valves": {"fill_time": 0.0},
            "numerics": {"links": 12}}  # fmt: skip
    settings = {"base": base, "duration": 20.0, "contacts": "ends"}
    gym, dm = WalkEnv(surfaces=("felt",), **settings), mjsim.env.load("felt", **settings)
    gym.reset(seed=0), dm.reset()
    rng, fallen = np.random.default_rng(0), False
    while not fallen:
        action = np.round(rng.random(3))
        _, reward, fallen, late, _ = gym.step(action)
        step = dm.step(action)
        assert step.last() == (fallen or late)
    assert step.reward == reward == -1.0
    assert step.discount == 0.0


def test_one_line_tells_a_dm_control_that_does_not_know_the_mujoco_beside_it(monkeypatch):
    monkeypatch.delitem(sys.modules, "mjsim.env.dm", raising=False)
    monkeypatch.delitem(sys.modules, "mjsim.env.dm_binding", raising=False)
    monkeypatch.setitem(sizes.array_sizes["mjmodel"], "field_of_another_version", ("nq",))
    with pytest.raises(ImportError, match=r"does not know MuJoCo \d") as told:
        mjsim.env.load("gelatin")
    assert "\n" not in str(told.value)
