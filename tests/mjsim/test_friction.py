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


def heights(links, left, right):
    """Pads that touch from each end inwards, as many as asked for; the others are up."""
    z = np.full(links + 2, 1e-3)
    z[:left] = z[len(z) - right :] = -1e-7
    return z


@given(surfaces, slopes, slopes, st.integers(1, 10), st.integers(1, 10))
def test_bounds_are_the_sliding_resistances_of_the_contacts(surface, left, right, n_left, n_right):
    scene = Scene(surface=surface)
    ends = PaperLaw(scene, Numerics()).ends(left, right, heights(24, n_left, n_right), PASSIVE)
    lengths = np.array([ends.contact_left, ends.contact_right])
    hold = sliding_resistance(scene.robot, surface, lengths) * scene.force_scale
    if hold[0] == hold[1]:
        assert (ends.bound_left, ends.bound_right) == (0, 0)
        assert ends.bound_both == scene.force_scale
    else:
        assert [ends.bound_left, ends.bound_right] == pytest.approx(hold.tolist())
        assert ends.bound_both == 0
    assert ends.left_share == left_share(hold[0], hold[1])


@pytest.mark.parametrize("links", [6, 12, 24, 48, 96])
def test_an_end_is_a_tip_by_its_angle_whatever_the_links(links):
    law = PaperLaw(Scene(), Numerics(links=links))
    angle = Numerics().side_angle
    touching = heights(links, 2, 2)
    assert law.ends(1.01 * angle, 1.0, touching, PASSIVE).contact_left == 0
    assert law.ends(0.99 * angle, 1.0, touching, PASSIVE).contact_left > 0


def test_a_side_reaches_as_far_as_the_pads_touch():
    nodes = node_positions(Scene().robot.length, 24)
    ends = PaperLaw(Scene(), Numerics()).ends(0.0, 1.0, heights(24, 7, 1), PASSIVE)
    assert ends.contact_left == pytest.approx(nodes[6])
    ends = PaperLaw(Scene(), Numerics()).ends(1.0, 0.0, heights(24, 1, 4), PASSIVE)
    assert ends.contact_right == pytest.approx(nodes[3])


def test_a_strip_wholly_on_the_ground_is_two_equal_sides():
    ends = PaperLaw(Scene(), Numerics()).ends(0.0, 0.0, np.zeros(26), PASSIVE)
    assert ends.contact_left == ends.contact_right == Scene().robot.length / 2
    assert ends.left_share == 0.5


def test_an_inflated_end_is_a_tip_however_flat_it_looks():
    law = PaperLaw(Scene(), Numerics())
    ends = law.ends(0.0, 0.0, heights(24, 7, 7), np.array([1.0, 0.0, 0.0]))
    assert ends.contact_left == 0
    assert ends.contact_right > 0
