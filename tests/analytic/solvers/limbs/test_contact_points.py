"""Points of a contact that resists by load: those of Gauss's rule for what pushes."""

from importlib import import_module
from pathlib import Path

import numpy as np
import pytest

from analytic import Surface
from analytic.scene.limbs import quadruped
from analytic.scene.quadruped_gaits import undulation
from analytic.solvers.limbs.contact_points import of_area, of_load
from analytic.solvers.limbs.contacts import Contacts
from analytic.solvers.limbs.kinematics import Tree
from analytic.solvers.limbs.statics import Statics
from analytic.solvers.limbs.walk import walk
from mjsim.results.measures import measure
from mjsim.scene import Numerics, Scene
from mjsim.simulation.simulation import simulate

LENGTH, MU = 0.1357, 0.37
ROUGH = Surface("rough", friction=MU, tip_friction=MU)


def test_two_points_have_the_first_four_moments_of_any_pushes():
    rng = np.random.default_rng(0)
    for _ in range(100):
        places, pushes = rng.random(7), rng.random(7)
        at, share = of_load(places.tolist(), pushes.tolist(), 1.0)
        for order in range(4):
            expected = pushes @ places**order / pushes.sum()
            assert np.dot(share, np.power(at, order)) == pytest.approx(expected, rel=1e-12)


def test_even_pushes_have_the_points_of_an_area():
    places = (np.arange(2000) + 0.5) / 2000
    at, share = of_load((3.0 + 2.0 * places).tolist(), [0.1] * 2000, 10.0)
    assert at == pytest.approx(of_area(3.0, 2.0), rel=1e-6)
    assert share == pytest.approx((0.5, 0.5), rel=1e-9)


def test_a_push_at_one_place_has_both_points_there():
    assert of_load([0.0, 1.0, 2.0], [0.0, 3.0, 0.0], 2.0) == ((1.0, 1.0), (0.5, 0.5))


def rests():
    """States of the quadruped whose rear legs are pressed and whose torso is rising."""
    robot = quadruped()
    statics = Statics(Tree(robot, 6, 0))
    rest = statics.flat()
    for part in np.linspace(0.25, 1.0, 4):
        pressures = robot.peak_pressure * np.array([part, 1.0, 1.0, 0.0, 0.0])
        rest = statics.equilibrium(pressures, rest)
        yield statics.tree, rest, pressures


def test_by_load_a_side_turns_about_where_its_vertices_push_by_their_mean_distance():
    sides = 0
    for tree, rest, pressures in rests():
        finder, half = Contacts(tree, "coulomb"), len(rest.force) // 2
        force = rest.force[:half] + rest.force[half:]
        contacts = finder.find(rest, pressures)
        limbs = [contact.limb for contact in contacts]
        for contact in contacts:
            if not contact.length or limbs.count(contact.limb) > 1:
                continue
            sides += 1
            vertices = tree.vertices[contact.limb]
            place, push = tree.arclength[vertices], force[vertices]
            assert contact.load == pytest.approx(push.sum(), rel=1e-6)
            assert contact.middle == pytest.approx(place @ push / push.sum(), rel=1e-6)
            assert sum(contact.shares) == pytest.approx(1.0, rel=1e-12)
            width = tree.robot.limbs[contact.limb].strip.width
            across = width * ((np.arange(400) + 0.5) / 400 - 0.5)
            arms = np.hypot((np.array(contact.at) - contact.middle)[:, None], across).mean(axis=1)
            assert finder.radius(contact) == pytest.approx(np.dot(contact.shares, arms), rel=1e-4)
    assert sides >= 4


@pytest.mark.slow
def test_by_load_the_quadruped_goes_as_far_as_node_by_node_in_theory_and_in_mujoco(monkeypatch):
    monkeypatch.syspath_prepend(Path(__file__).parents[4] / "benchmarks" / "peers")
    model = import_module("friction_by_area")
    rig = model.Model(model.quadruped(), MU, MU, coulomb=True, elements=8, wide=False)
    far = rig.walk(model.wave(), 10)[0][0] / LENGTH
    robot, gait = quadruped(), undulation("wave")
    theory = walk(robot, gait, ROUGH, 10, 6, law="coulomb", twists=0).displacement[0] / LENGTH
    scene = Scene(robot, gait, ROUGH, friction="coulomb")
    there = measure(simulate(scene, Numerics(4, 0.02, twists=0))).displacement
    assert theory == pytest.approx(far, rel=0.06)
    assert there == pytest.approx(far, rel=0.06)
