"""Limbs that curl up: a closed form, the strip's numbers, and sides exchanged."""

from dataclasses import replace

import numpy as np
import pytest

from analytic import SURFACES, Elastica, Friction, Gait, Robot, predict
from analytic.scene import pneunet
from analytic.scene.limbs import Limb, LimbedRobot, as_strip, quadruped
from analytic.scene.quadruped_gaits import undulation
from analytic.solvers.limbs.contacts import Contacts
from analytic.solvers.limbs.walk import shapes, walk

STRIP, QUADRUPED = Robot(), quadruped()
SIDES = np.array([0.5, -0.6, 0.8, -0.4, 0.0])  # torso, rear left and right, front left and right
GAITS = {  # rear, middle, front
    "arch and curl": [[0, 0, 0], [0.6, 0, 0], [0.6, -0.3, 0], [0, -0.3, 0.6], [0, 0, 0.6],
                      [0, 0, 0]],
    "middle down": [[0, 0, 0], [0, -0.5, 0], [0.6, -0.5, 0], [0.6, 0, 0], [0, 0, 0]],
    "ends up": [[0, 0, 0], [-0.4, 0, 0], [-0.4, 0.6, 0], [-0.4, 0.6, -0.4], [0, 0.6, -0.4],
                [0, 0, -0.4], [0, 0, 0]],
}  # fmt: skip


def test_an_end_that_curls_up_lifts_off_as_a_beam_does():
    """Flat, it carries the moment D kappa, and so does the weight w a^2 / 2 of what is in the air;

    the end rises by D kappa^2 / 2 w.
    """
    strip = replace(STRIP, segments=(1.0,))
    kappa = 2.0
    pressure = -kappa / pneunet.curvature_per_pressure(strip)
    robot = LimbedRobot((Limb("solo", strip),))
    tree, rests = shapes(robot, np.linspace(0, pressure, 9)[:, None], 48)
    stiffness = float(pneunet.rigidity(strip, pressure))
    lifted = (2 * stiffness * kappa / strip.weight_per_length) ** 0.5
    (contact,) = Contacts(tree).find(rests[-1], np.array([pressure]))
    rise = rests[-1].nodes[[0, len(tree.arclength) // 2 - 1], 2]
    assert rise == pytest.approx(stiffness * kappa**2 / (2 * strip.weight_per_length), rel=0.03)
    assert contact.length == pytest.approx(strip.length - 2 * lifted, rel=0.03)
    assert contact.middle == pytest.approx(0.5 * strip.length)


@pytest.mark.parametrize(
    ("gait", "ground", "weight"),
    [
        ("arch and curl", "polyethylene", 1.416),
        *(pytest.param(gait, ground, weight, marks=pytest.mark.slow)
          for gait in GAITS for ground in SURFACES for weight in (1.416, 4.0)
          if (gait, ground, weight) != ("arch and curl", "polyethylene", 1.416)),
    ],
)  # fmt: skip
def test_a_strip_as_a_tree_goes_as_far_as_the_strip_s_elastica(gait, ground, weight):
    strip, stages = replace(STRIP, weight_per_length=weight), np.array(GAITS[gait])
    friction = Friction(tension=1.0, contacts="all")
    one, tree = (
        Gait("both-ways", tuple(map(tuple, rows.tolist())))
        for rows in (stages, stages[:, [1, 0, 2]])
    )
    theory = predict(strip, one, SURFACES[ground], Elastica(18), 20, friction=friction)
    path = walk(as_strip(strip), tree, SURFACES[ground], 20)
    expected = theory.locomotion.per_cycle
    assert path.converged
    assert path.displacement[0] == pytest.approx(expected, abs=2.5e-4 * strip.length)


@pytest.mark.slow
def test_sides_that_change_places_turn_it_the_other_way():
    pressures = QUADRUPED.peak_pressure * np.linspace(0, 1, 4)[:, None] * SIDES
    paths = [
        walk(QUADRUPED, undulation("wave"), SURFACES["polyethylene"], elements=4, path=rows)
        for rows in (pressures, pressures[:, [0, 2, 1, 4, 3]])
    ]
    turns = [path.turn for path in paths]
    assert abs(turns[0]) > 1e-3
    assert turns[1] == pytest.approx(-turns[0], rel=1e-3)
    mirrored = paths[0].displacement * [1, -1]
    assert paths[1].displacement == pytest.approx(mirrored, abs=1e-6)
