"""Tendons of nodes that do not resist are left out of MuJoCo's work, and nothing else changes."""

import mujoco
import numpy as np
import pytest

from analytic import Robot
from analytic.scene.surface import SURFACES
from mjsim.friction.node_tendons import NodeTendons
from mjsim.model.bodies.parts import FAR
from mjsim.scene import Numerics, Scene
from mjsim.simulation.simulation import Simulation, simulate

COARSE = Numerics(links=12, timestep=0.01)


def scene(ground="gelatin"):
    return Scene(Robot(), ground=SURFACES[ground], contacts="all")


def test_the_rate_of_a_node_without_a_tendon_is_what_its_tendon_would_have():
    simulation = Simulation(scene(), COARSE)
    rng = np.random.default_rng(0)
    peak = simulation.scene.robot.peak_pressure
    simulation.play(np.cumsum(rng.uniform(0, 0.03, (40, 3)), axis=0) * peak)
    model, data = simulation.model, simulation.data
    data.qvel[:] = rng.normal(size=model.nv)
    rows = NodeTendons(model, data, COARSE.links + 2)
    mujoco.mj_forward(model, data)
    asked = np.array([rows.rate(tendon) for tendon in rows.of])
    places = [rows.x(tendon) for tendon in rows.of]
    rows.use(rows.of, [])
    mujoco.mj_forward(model, data)
    tilt = data.geom_xpos[:, 2].max() / FAR  # of the tendons, which end on the ground
    speeds = np.hypot(np.abs(data.qvel).sum() * simulation.scene.robot.length, data.qvel[1])
    assert np.abs(asked - data.ten_velocity[rows.of]).max() < tilt * speeds
    sites = data.site_xpos[model.wrap_objid[model.tendon_adr[rows.of] + 2]]
    _, aside, up = (sites - data.site("robot_far").xpos).T
    along = np.sqrt(data.ten_length[rows.of] ** 2 - aside**2 - up**2)
    assert np.array(places) + FAR == pytest.approx(along, abs=1e-12 * FAR)


@pytest.mark.parametrize("ground", SURFACES)
def test_a_walk_goes_the_same_way_with_all_tendons_worked_out(ground, monkeypatch):
    few = simulate(scene(ground), COARSE)
    use = NodeTendons.use
    monkeypatch.setattr(NodeTendons, "use", lambda rows, _, mean: use(rows, rows.of, mean))
    every = simulate(scene(ground), COARSE)
    assert np.abs(few.position - every.position).max() < 1e-9 * few.scene.robot.length
