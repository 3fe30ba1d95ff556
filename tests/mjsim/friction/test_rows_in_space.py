"""Rows of friction of limbs move as MuJoCo's own Jacobians say."""

import mujoco
import numpy as np
import pytest

from analytic.scene.limbs import quadruped
from analytic.scene.quadruped_gaits import undulation
from analytic.scene.surface import SURFACES
from mjsim.friction.friction_rows import FrictionRows
from mjsim.model.bodies.limbs import ROWS
from mjsim.scene import Numerics, Scene
from mjsim.simulation.simulation import Simulation


def test_coefficients_of_rows_are_jacobians_of_points_and_of_turning(monkeypatch):
    """Of a tip at points beside its middle line, of a side at its middle, of limbs that twist."""
    errors, turned = [], set()
    resist = FrictionRows.resist

    def watch(self, *resistances):
        resist(self, *resistances)
        model, data = self._model, self._data
        place, turn = np.zeros((2, 3, model.nv))
        for number, body, (x, y, z), radius in zip(
            self.numbers, self.bodies, self._arms + self._centre, self._radii, strict=True
        ):
            mujoco.mj_jac(model, data, place, turn, np.array([x, y, z]), body)
            tendons, count = self._tendons[number], ROWS if radius else ROWS - 1
            if not model.tendon_num[tendons.rows[0]]:
                continue  # it does not resist
            rows = np.zeros((count, model.nv))
            rows[:, tendons.dofs] = model.wrap_prm.ravel()[tendons.coefficients[:count]]
            motions = np.stack([place[0], place[1], radius * turn[2]])
            directions = np.linalg.lstsq(motions.T, rows.T, rcond=None)[0]
            errors.append(np.abs(directions.T @ motions - rows).max())
            errors.append(np.abs(directions.T @ directions - np.eye(count)).max())
            turned.add(bool(radius))

    monkeypatch.setattr(FrictionRows, "resist", watch)
    scene = Scene(quadruped(), undulation("wave", left=0.7), SURFACES["polyethylene"], cycles=1)
    simulation = Simulation(scene, Numerics(timestep=0.02, links=4))
    simulation.play(scene.robot.peak_pressure * np.linspace(0, [0.9, 0.5, 0.8, 0.6, 0.3], 60))
    assert turned == {True, False}
    assert max(errors) == pytest.approx(0.0, abs=1e-9)
