"""A reset gives back the model as compiled, whatever was changed in it."""

import numpy as np
import pytest

from analytic.scene.limbs import quadruped
from analytic.scene.robot import Robot
from mjsim.model.bodies.chain import Chain
from mjsim.model.builder import compile_model
from mjsim.scene import Numerics, Scene, registry
from mjsim.simulation.simulation import Simulation


class Damped(Chain):
    """Chain, with hinges that are damped more, by a factor that `bind` puts on what it finds."""

    name = "damped"

    def bind(self, model, data, scene, numerics):
        model.dof_damping[3:] *= 3.0
        model.opt.gravity[0] += 0.01
        model.stat.extent *= 2.0
        return super().bind(model, data, scene, numerics)


def numbers_of(model):
    arrays = [getattr(model, name) for name in dir(model) if not name.startswith("_")]
    return [array.copy() for array in arrays if isinstance(array, np.ndarray)]


def test_a_body_that_scales_the_model_walks_alike_each_time(forgets):
    registry.register(Damped())
    scene, numerics = Scene(body="damped"), Numerics(links=6)
    compiled = compile_model(scene, numerics.resolved(scene.body, scene.friction))
    simulation = Simulation(scene, numerics)
    one, two = simulation.run(), simulation.run()
    assert np.array_equal(one.coordinates, two.coordinates)
    model = simulation.model
    assert model.dof_damping == pytest.approx(np.r_[np.ones(3), 3 * np.ones(6)]
                                              * compiled.dof_damping)  # fmt: skip
    assert model.opt.gravity[0] == compiled.opt.gravity[0] + 0.01
    assert model.stat.extent == 2.0 * compiled.stat.extent


@pytest.mark.parametrize(("robot", "links"), [(Robot(), 6), (quadruped(), 2)])
def test_a_reset_restores_all_of_the_model_in_place(robot, links):
    simulation = Simulation(Scene(robot, settle_time=0.1), Numerics(links=links))
    model, data = simulation.model, simulation.data
    simulation.reset()
    usual, state = numbers_of(model), data.qpos.copy()
    view = model.dof_armature[2:4]
    for name in ("dof_armature", "body_mass", "geom_friction", "jnt_axis", "tendon_stiffness"):
        getattr(model, name)[:] += 0.5
    model.opt.timestep, model.opt.iterations, model.vis.map.znear = 0.5, 1, 0.5
    simulation.reset()
    assert simulation.model is model
    assert simulation.data is data
    assert all(np.array_equal(a, b) for a, b in zip(numbers_of(model), usual, strict=True))
    assert model.opt.timestep == simulation.numerics.timestep
    assert (model.opt.iterations, model.vis.map.znear) != (1, 0.5)
    assert np.array_equal(data.qpos, state)
    view[:] = 7.0
    assert (model.dof_armature[2:4] == 7.0).all()
