"""Forces, moments and energies of a walk against statics, the friction law and each other."""

from dataclasses import replace

import numpy as np
import pytest
from walks import walk

from analytic import GAITS, SURFACES, Robot
from analytic.scene.chain import link_lengths
from mjsim.model.bodies.parts import tie_force
from mjsim.results.mechanics import balance, bending, slip
from mjsim.scene import Scene
from mjsim.simulation.simulation import simulate

EVERY = [
    ("gelatin", "chain", "constant"), ("felt", "chain", "constant"),
    ("gelatin", "cable", "constant"), ("felt", "rod", "constant"), ("gelatin", "chain", "coulomb"),
]  # fmt: skip


def weights(result):
    robot = result.scene.robot
    return robot.weight_per_length * link_lengths(robot, result.numerics.links)


def recorded(surface, body="chain", friction="constant"):
    return walk(surface, body=body, friction=friction, forces=True)


@pytest.mark.parametrize(("surface", "body", "friction"), EVERY)
def test_the_ground_carries_the_weight(surface, body, friction):
    result = recorded(surface, body, friction)
    carried = result.forces.normal[result.start :].sum(axis=1)
    assert carried.mean() == pytest.approx(weights(result).sum(), rel=2e-3)


@pytest.mark.parametrize(("surface", "body", "friction"), EVERY)
def test_inner_moments_are_those_that_the_ground_and_the_weight_ask_for(surface, body, friction):
    result = recorded(surface, body, friction)
    x, z = result.nodes()
    middle, heavy = 0.5 * (x[:, 1:] + x[:, :-1]), weights(result)
    push, pull = result.forces
    moment = bending(result).moment
    rows = range(result.start, len(x), 29)
    off = []
    for hinge in range(moment.shape[1]):
        here = hinge + 1
        right = slice(here + 1, None)
        for k in rows:
            lever, lift = x[k, right] - x[k, here], z[k, right] - z[k, here]
            asked = heavy[here:] @ (middle[k, here:] - x[k, here])
            asked -= lever @ push[k, right] - lift @ pull[k, right]
            off.append(abs(asked - moment[k, hinge]))
    assert np.median(off) < 0.015 * np.abs(moment).max()


def test_an_anchor_does_not_slip_and_a_slipping_end_bears_its_bound():
    result = recorded("gelatin")
    tip = result.scene.ground.tip_force
    rows = np.arange(result.start + 1, len(result.time))
    left, right = result.forces.friction[rows][:, [0, -1]].T
    both_tips = (result.contact_left[rows] == 0) & (result.contact_right[rows] == 0)
    most = tip + tie_force(result.scene, result.numerics)  # which holds the mean of both
    assert np.abs(result.forces.friction).max() < most
    speed = slip(result)[rows]
    moving = both_tips & (np.abs(speed[:, 0]) > 1e-3)
    assert moving.any()
    pair = 0.5 * np.abs(left - right)[moving]  # what holds their mean is alike at both
    assert pair == pytest.approx(tip, rel=1e-3)
    lying = (result.contact_right[rows] > 0) & (result.contact_left[rows] == 0)
    assert lying.any()  # gelatin's side has no bound: the tip stays
    assert np.abs(right[lying]).max() < 1e-9
    assert np.nanmax(np.abs(speed[lying, 0])) < 2e-4


def test_under_coulomb_no_node_bears_more_than_mu_n():
    result = recorded("gelatin", friction="coulomb")
    push, pull = result.forces
    most = max(result.scene.ground.tip_friction, result.scene.ground.friction)
    assert (np.abs(pull) <= 1.001 * most * push + 1e-9).all()


def test_friction_everywhere_sums_to_nothing_on_level_ground():
    segments = (1 / 5,) * 5
    gait = replace(GAITS["wave"], name="hump", stages=((0, 0, 0, 0, 0), (1, 0, 1, 0, 1),
                                                       (0, 0, 0, 0, 0)))  # fmt: skip
    scene = Scene(Robot(segments=segments), gait, SURFACES["polyethylene"])
    result = simulate(scene, forces=True)
    assert scene.between
    pull = result.forces.friction[result.start :]
    total, each = np.abs(pull.sum(axis=1)), np.abs(pull).sum(axis=1)
    assert np.median(total[each > 0]) < 0.02 * each.max()


@pytest.mark.parametrize(("surface", "part"), [("gelatin", 0.02), ("polyethylene", 0.02)])
def test_energy_closes(surface, part):
    """What chambers do is stored or lost; a first-order step loses some itself."""
    result = recorded(surface)
    bent, balanced = bending(result), balance(result)
    stored = bent.energy + balanced.potential + balanced.kinetic
    lost = bent.damped + balanced.friction_loss
    left_over = bent.work - (stored - stored[0]) - lost
    exchanged = np.abs(np.diff(bent.work)).sum()
    assert np.abs(left_over).max() < part * exchanged
    losses = np.diff(balanced.friction_loss)
    assert -losses[losses < 0].sum() < 1e-4 * losses.sum()
    assert (np.diff(bent.damped) >= 0).all()


def test_tips_that_hold_a_flattening_strip_press_it_together():
    """Ends that slide apart are pushed inwards by the ground: tension is below 0 there."""
    result = recorded("gelatin")
    gap = np.diff(result.nodes()[0][:, [0, -1]], axis=1)[:, 0]
    both = (result.contact_left == 0) & (result.contact_right == 0)
    apart = np.flatnonzero(both[1:] & (np.diff(gap) > 5e-6)) + 1
    together = np.flatnonzero(both[1:] & (np.diff(gap) < -5e-6)) + 1
    tension = balance(result).tension
    middle = tension.shape[1] // 2
    assert len(apart) > 20
    assert len(together) > 20
    assert np.median(tension[apart, middle]) < 0 < np.median(tension[together, middle])


def test_without_recorded_forces_there_is_no_balance():
    result = walk("gelatin")
    assert balance(result) is None
    assert slip(result) is None
    assert result.up_to(3).forces is None
    assert recorded("gelatin").up_to(3).forces.normal.shape[0] == 3


def test_sealed_chambers_bend_by_their_own_law():
    numerics = walk("gelatin").numerics
    scene = replace(walk("gelatin").scene, chamber="sealed", robot=Robot(
        chamber_height=4.1e-3, chamber_fraction=0.5))  # fmt: skip
    result = simulate(scene, numerics, forces=True)
    assert np.abs(bending(result).moment[:, [0, -1]]).max() < 0.2 * np.abs(
        bending(result).moment).max()  # fmt: skip
