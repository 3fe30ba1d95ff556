"""Contact lengths and loads are read from the forces of the contacts, whatever their order."""

from types import SimpleNamespace

import mujoco
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from walks import walk

from analytic import SURFACES, Robot
from analytic.friction.contact_length import PASSIVE
from analytic.scene.chain import node_positions
from analytic.scene.surface import from_ratios
from mjsim.friction.contact_length import ContactForces
from mjsim.model.builder import compile_model
from mjsim.model.pads import pads_by_node
from mjsim.scene import Numerics, Scene, registry

SCENE = Scene()
parts = st.floats(0.0, 0.4).map(lambda part: part * SCENE.robot.length)


def resolved(links=24, friction="constant", **more):
    return Numerics(links=links, **more).resolved("chain", friction)


MODELS = {n: compile_model(SCENE, resolved(n)) for n in (12, 24, 48)}


def touching(links, left, right, order, push=0.03):
    """Contacts of a strip that touches over two lengths from its ends [m], in any order.

    The weight of each length and a push where it lifts off, as two forces with the same resultant.
    """
    robot, radius = SCENE.robot, resolved().pad_radius
    model = MODELS[links]
    nodes, pads = node_positions(robot, links), pads_by_node(model)[:, 0]
    z = np.zeros(model.ngeom)
    z[pads] = radius + 1e-3
    z[pads[links // 2]] += 1e-3
    force = {}
    for length, inward in ((left, slice(None)), (right, slice(None, None, -1))):
        total = robot.weight_per_length * length + push
        moment = robot.weight_per_length * length**2 / 2 + push * length
        outer, inner = pads[inward][[0, 5]]
        z[[outer, inner]] = radius - 1e-7
        force[inner] = moment / nodes[5]
        force[outer] = total - moment / nodes[5]
    geoms = np.array(sorted(force, key=lambda geom: order[geom % len(order)]))
    rows = np.random.default_rng(len(geoms)).permutation(len(geoms)) + 3  # after three of friction
    efc = np.full(3 + len(geoms), 9.9)
    efc[rows] = [force[geom] for geom in geoms]
    contact = SimpleNamespace(geom2=geoms, efc_address=rows)
    place = np.column_stack([0 * z, 0 * z, z])
    data = SimpleNamespace(geom_xpos=place, efc_force=efc, contact=contact)
    return ContactForces(SCENE, resolved(links), model, data)


@given(parts, parts, st.sampled_from(list(MODELS)), st.permutations(range(7)))
def test_the_length_of_a_side_follows_from_its_forces_between_pads_too(left, right, links, order):
    forces = touching(links, left, right, order)
    least = node_positions(SCENE.robot, links)[1]
    wanted = max(left, least), max(right, least)
    assert forces.lengths(True, True) == pytest.approx(wanted, rel=1e-9)
    assert forces.lengths(True, False) == pytest.approx((wanted[0], 0.0), rel=1e-9)
    assert forces.lengths(False, True) == pytest.approx((0.0, wanted[1]), rel=1e-9)
    weight = SCENE.robot.weight_per_length
    assert forces.loads() == pytest.approx((weight * left + 0.03, weight * right + 0.03))


def test_a_strip_wholly_on_the_ground_is_two_equal_sides():
    flat = SimpleNamespace(geom_xpos=np.zeros((MODELS[24].ngeom, 3)))
    half = SCENE.robot.length / 2
    assert ContactForces(SCENE, resolved(), MODELS[24], flat).lengths(True, True) == (half, half)


@pytest.mark.parametrize("cone", ["elliptic", "pyramidal"])
@pytest.mark.parametrize("body", registry.names())
def test_loads_of_a_strip_on_its_two_ends_add_up_to_its_weight(body, cone):
    """Of any body and under either cone: the normal's row, or all edges of a pyramid."""
    scene = Scene(ground=from_ratios("rough", 1.0, 1.0), friction="coulomb", body=body)
    numerics = Numerics(links=6, cone=cone).resolved(body, "coulomb")
    model = compile_model(scene, numerics)
    data = mujoco.MjData(model)
    joints = registry.find(body).bind(model, data, scene, numerics)
    forces = ContactForces(scene, numerics, model, data)
    pressures = np.outer(np.minimum(np.arange(800) / 400, 1.0), np.full(3, 3e4))
    seen = []
    for load in joints.loads(pressures, pressures[0], pressures):
        joints.apply(load)
        mujoco.mj_step(model, data)
        seen.append(forces.loads())
    left, right = np.mean(seen[500:], axis=0)  # pyramids shake
    assert left + right == pytest.approx(scene.robot.weight, rel=0.01)
    assert left == pytest.approx(right, rel=0.05)


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


@pytest.mark.parametrize("surface", list(SURFACES))
def test_the_bounds_in_the_model_are_those_of_the_law(surface):
    """V_t at a tip, tau q lambda on a side; where they tie, the mean of the ends is held too."""
    from mjsim.simulation.simulation import Simulation

    simulation = Simulation(Scene(ground=SURFACES[surface]))
    ground, width, seen = SURFACES[surface], Robot().width, set()
    for time in np.arange(0.005, 4.0, 0.005):
        seen_now = simulation.step(
            Robot().peak_pressure * SCENE.gait.fractions(np.array([time]))[0]
        )
        lengths = seen_now.contact_left, seen_now.contact_right
        left, right = (ground.shear_strength * width * x if x else ground.tip_force
                       for x in lengths)  # fmt: skip
        bounds = simulation.model.tendon_frictionloss[:3]
        if left == right:
            assert bounds[:2].tolist() == [max(left, 0), max(right, 0)]
            assert bounds[2] > 0
        else:
            assert bounds.tolist() == pytest.approx([left, right, 0.0])
        seen.add(left == right)
    assert seen == {True, False}
