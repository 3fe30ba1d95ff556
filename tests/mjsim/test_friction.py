"""The bounds that the simulation applies are those of the theory's friction law."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from strategies import surfaces

from analytic.chain import node_positions
from analytic.friction import left_share, sliding_resistance
from mjsim.config import Numerics, Scene
from mjsim.friction import PaperLaw

slopes = st.floats(-0.01, 1.0)
PASSIVE = np.zeros(3)


def ground(links, left, right, push=0.03):
    """Heights and forces of a strip that touches over lengths left and right from its ends [m].

    The weight of each length and a push where it lifts off, as two forces with the same resultant.
    """
    robot = Scene().robot
    nodes = node_positions(robot, links)
    z = np.full(links + 2, 1e-3)
    force = np.zeros(links + 2)
    for length, inward in ((left, slice(None)), (right, slice(None, None, -1))):
        z[inward][:2] = -1e-7
        total = robot.weight_per_length * length + push
        moment = robot.weight_per_length * length**2 / 2 + push * length
        force[inward][5] = moment / nodes[5]
        force[inward][0] = total - moment / nodes[5]
    z[links // 2] = 2e-3
    return z, force


lengths = st.floats(0.0, 0.4).map(lambda part: part * Scene().robot.length)


@given(surfaces, slopes, slopes, lengths, lengths)
def test_bounds_are_the_sliding_resistances_of_the_contacts(surface, left, right, one, other):
    scene = Scene(surface=surface)
    ends = PaperLaw(scene, Numerics()).ends(left, right, *ground(24, one, other), PASSIVE)
    contacts = np.array([ends.contact_left, ends.contact_right])
    hold = sliding_resistance(scene.robot, surface, contacts) * scene.force_scale
    if hold[0] == hold[1]:
        assert (ends.bound_left, ends.bound_right) == (0, 0)
        assert ends.bound_both == scene.force_scale
    else:
        assert [ends.bound_left, ends.bound_right] == pytest.approx(hold.tolist())
        assert ends.bound_both == 0
    assert ends.left_share == left_share(hold[0], hold[1])


@given(lengths, lengths, st.sampled_from([12, 24, 48]))
def test_the_length_of_a_side_follows_from_its_forces_between_pads_too(left, right, links):
    height, force = ground(links, left, right)
    ends = PaperLaw(Scene(), Numerics(links=links)).ends(0.0, 0.0, height, force, PASSIVE)
    least = node_positions(Scene().robot, links)[1]
    assert ends.contact_left == pytest.approx(max(left, least), rel=1e-9)
    assert ends.contact_right == pytest.approx(max(right, least), rel=1e-9)


@pytest.mark.parametrize("links", [12, 24, 48, 96])
def test_an_end_is_a_tip_by_its_angle_whatever_the_links(links):
    law = PaperLaw(Scene(), Numerics(links=links))
    angle = Numerics().side_angle
    touching = ground(links, 0.01, 0.01)
    assert law.ends(1.01 * angle, 1.0, *touching, PASSIVE).contact_left == 0
    assert law.ends(0.99 * angle, 1.0, *touching, PASSIVE).contact_left > 0


def test_a_strip_wholly_on_the_ground_is_two_equal_sides():
    ends = PaperLaw(Scene(), Numerics()).ends(0.0, 0.0, np.zeros(26), np.zeros(26), PASSIVE)
    assert ends.contact_left == ends.contact_right == Scene().robot.length / 2
    assert ends.left_share == 0.5


def test_an_inflated_end_is_a_tip_however_flat_it_looks():
    law = PaperLaw(Scene(), Numerics())
    inflated = np.array([1.0, 0.0, 0.0])
    ends = law.ends(0.0, 0.0, *ground(24, 0.02, 0.02), inflated)
    assert ends.contact_left == 0
    assert ends.contact_right > 0
