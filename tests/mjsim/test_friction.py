"""The bounds that the simulation applies are those of the theory's friction law."""

from types import SimpleNamespace

import mujoco
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from strategies import surfaces
from walks import walk

from analytic import Robot
from analytic.chain import node_positions
from analytic.contact import PASSIVE
from analytic.friction import left_slip_fraction, sliding_resistance
from mjsim.friction.contact_length import Sides
from mjsim.friction.laws import ConstantLaw
from mjsim.mjcf.builder import compile_model
from mjsim.scene import Numerics, Scene


class PADS:
    """As much of a model as tells that the first pad is the first geom, and alone at its node."""

    geom_bodyid, body_geomadr, body_geomnum = (0,), (0,), (1,)

    @staticmethod
    def geom(which):
        return SimpleNamespace(id=0, name="robot_pad_0")


lengths = st.floats(0.0, 0.4).map(lambda part: part * Scene().robot.length)


@given(surfaces, lengths, lengths)
def test_bounds_are_the_sliding_resistances_of_the_contacts(surface, one, other):
    scene = Scene(surface=surface)
    left, right, both, share = ConstantLaw(scene).hold(one, other)
    hold = sliding_resistance(scene.robot, surface, np.array([one, other])) * scene.force_scale
    if hold[0] == hold[1]:
        assert (left, right, both) == (0, 0, scene.force_scale)
    else:
        assert [left, right] == pytest.approx(hold.tolist())
        assert both == 0
    assert share == left_slip_fraction(hold[0], hold[1])


def ground(links, left, right, push=0.03):
    """Contacts, as MuJoCo gives them, of a strip that touches over two lengths from its ends [m].

    The weight of each length and a push where it lifts off, as two forces with the same resultant.
    """
    robot, radius = Scene().robot, Numerics().pad_radius
    nodes = node_positions(robot, links)
    z = np.full(links + 2, radius + 1e-3)
    z[links // 2] += 1e-3
    force = np.zeros(links + 2)
    for length, inward in ((left, slice(None)), (right, slice(None, None, -1))):
        total = robot.weight_per_length * length + push
        moment = robot.weight_per_length * length**2 / 2 + push * length
        z[inward][[0, 5]] = radius - 1e-7
        force[inward][5] = moment / nodes[5]
        force[inward][0] = total - moment / nodes[5]
    position = np.column_stack([0 * z, 0 * z, z])
    rows = np.concatenate([[9.9], force[z < radius]])  # one row of friction before the contacts
    return SimpleNamespace(geom_xpos=position, efc_force=rows, ne=0, nf=1)


@given(lengths, lengths, st.sampled_from([12, 24, 48]))
def test_the_length_of_a_side_follows_from_its_forces_between_pads_too(left, right, links):
    sides = Sides(Scene(), Numerics(links=links), PADS, ground(links, left, right))
    least = node_positions(Scene().robot, links)[1]
    wanted = max(left, least), max(right, least)
    assert sides.lengths(True, True) == pytest.approx(wanted, rel=1e-9)
    assert sides.lengths(True, False) == pytest.approx((wanted[0], 0.0), rel=1e-9)
    assert sides.lengths(False, True) == pytest.approx((0.0, wanted[1]), rel=1e-9)


def test_a_strip_wholly_on_the_ground_is_two_equal_sides():
    flat = SimpleNamespace(geom_xpos=np.zeros((26, 3)), efc_force=np.zeros(26), ne=0, nf=0)
    half = Scene().robot.length / 2
    assert Sides(Scene(), Numerics(), PADS, flat).lengths(True, True) == (half, half)


def test_contacts_are_those_of_the_pads_below_their_radius_in_order():
    """What Sides counts on instead of asking for the geoms of the contacts."""
    scene, numerics = Scene(), Numerics()
    result = walk("felt")
    model = compile_model(scene, numerics)
    data = mujoco.MjData(model)
    first = model.geom("robot_pad_0").id
    for step in range(0, len(result.time), 7):
        data.qpos[:] = result.coordinates[step]
        mujoco.mj_forward(model, data)
        low = data.geom_xpos[first:, 2][: numerics.links + 2] < numerics.pad_radius
        assert (data.contact.geom2 - first).tolist() == np.flatnonzero(low).tolist()
        assert len(data.efc_force) == data.nf + data.ncon


def test_an_inflated_end_is_a_tip_and_so_is_a_steep_one():
    result = walk("felt")
    slope = result.coordinates[:, 2]
    before = slice(0, -1)
    inflated = result.pressure[:, 0] > PASSIVE * Robot().peak_pressure
    assert (result.contact_left[inflated] == 0).all()
    steep = np.concatenate([[False], slope[before] > Numerics().side_angle])
    assert (result.contact_left[steep] == 0).all()
    flat = np.concatenate([[True], slope[before] <= Numerics().side_angle]) & ~inflated
    assert (result.contact_left[flat] > 0).all()
