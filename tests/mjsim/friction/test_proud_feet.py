"""Feet that stand proud of a strip's underside, in theory and MuJoCo."""

from dataclasses import replace

import mujoco
import numpy as np
import pytest

from analytic import (
    GAITS,
    SURFACES,
    Foot,
    Friction,
    Limb,
    LimbedRobot,
    Robot,
    predict,
    solve_elastica,
    solve_lifted,
    solve_modes,
    solve_obstacle,
)
from analytic.scene import pneunet
from mjsim.files.scene_tables.tables import build
from mjsim.files.scene_tables.written import as_tables
from mjsim.model.builder import compile_model
from mjsim.optimising.objective import Objective
from mjsim.results.measures import measure
from mjsim.results.prediction import reference
from mjsim.results.record import record
from mjsim.scene import Numerics, Scene, resolved
from mjsim.simulation.simulation import simulate

STRIP = Robot()
LENGTH, W, RIGIDITY = STRIP.length, STRIP.weight_per_length, pneunet.base_rigidity(STRIP)
SLOW = replace(GAITS["wave"], ramp_time=8.0)


def posts(drop, **values):
    return Robot(feet=[Foot(0, 0, drop=drop), Foot(1, 1, drop=drop)], **values)


@pytest.mark.parametrize("drop", [1e-4, 1e-3, 3e-3])
@pytest.mark.parametrize("end", [0.0, 1.0])
def test_a_post_carries_what_a_beam_that_it_lifts_weighs_on_it(drop, end):
    """Small slopes: d = w a^4 / 24 D over the lifted length a, and a push of w a / 2."""
    lifted = (24 * RIGIDITY * drop / W) ** 0.25
    strip = Robot(feet=[Foot(end, end, drop=drop)])
    shapes = solve_elastica(strip, [[0.0, 0, 0]], links=120)
    assert shapes.force[0, -int(end)] == pytest.approx(0.5 * W * lifted, rel=2e-3)
    assert shapes.contact_left[0] == 0.0 if end == 0 else shapes.contact_right[0] == 0.0


def test_a_post_carries_as_much_in_mujoco():
    scene = Scene(Robot(feet=[Foot(1, 1, drop=1e-3)]), ground="felt")
    walk = simulate(scene, Numerics(links=48), forces=True)
    push = 0.5 * W * (24 * RIGIDITY * 1e-3 / W) ** 0.25
    assert walk.forces.normal[walk.start, -1] == pytest.approx(push, rel=0.03)


def test_a_stiff_strip_on_two_posts_sags_as_a_beam_on_two_supports():
    strip = posts(1e-3, modulus=20 * STRIP.modulus, peak_pressure=20 * STRIP.peak_pressure)
    shapes = solve_elastica(strip, [[0.0, 0, 0]], links=60)
    middle = float(shapes.curve(np.array([0.5 * LENGTH]))[1][0, 0])
    assert 1e-3 - middle == pytest.approx(5 * W * LENGTH**4 / (384 * 20 * RIGIDITY), rel=1e-3)
    assert shapes.force[0, 0] == pytest.approx(0.5 * STRIP.weight, rel=1e-6)


@pytest.mark.parametrize("surface", list(SURFACES))
def test_on_posts_it_goes_as_far_as_the_theory_says(surface):
    """Its ends stay tips and it rests on its belly between them: it goes ahead on gelatin too."""
    scene = Scene(posts(1e-3), SLOW, surface)
    assert scene.between
    expected = reference(scene).displacement[0]
    assert expected > 0.005
    assert measure(simulate(scene)).displacement == pytest.approx(expected, rel=0.02)


def test_their_walks_are_recorded_and_searched_with_friction_where_they_rest():
    scene = Scene(posts(1e-3), ground="gelatin")
    assert record(simulate(scene))["status"] == "ok"
    assert Objective(scene, [SURFACES["gelatin"]], model="elastica").contacts == ("all",)


def test_neutral_lines_are_where_the_pads_are_not():
    scene = Scene(posts(2e-3), ground="felt")
    numerics = resolved(scene, Numerics(links=12))
    model = compile_model(scene, numerics)
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    first = model.geom("robot_pad_0").id
    assert data.geom_xpos[first, 2] == pytest.approx(numerics.pad_radius, abs=1e-6)
    walk = simulate(scene, numerics)
    assert np.hypot(*np.diff(walk.line[..., [0, 2]], axis=1)[:, 0].T) == pytest.approx(
        float(np.diff(walk.line[0, :2, 0])[0]), rel=0.05
    )
    assert walk.line[walk.start, [0, -1], 2] == pytest.approx(2e-3, abs=1e-5)


def test_they_are_written_as_they_are_read():
    scene = Scene(posts("0.5 mm"))
    assert scene.strip.feet[0].drop == 5e-4
    assert build(as_tables(scene, Numerics()))[0] == scene


def test_what_does_not_know_them_says_so():
    strip = posts(1e-3)
    for solve, what in ((solve_modes, "modes"), (solve_lifted, "modes"), (solve_obstacle, "small")):
        with pytest.raises(ValueError, match=f"drop of a foot must be 0 for .*{what}"):
            solve(strip, [STRIP.peak_pressure, 0, 0])
    with pytest.raises(ValueError, match="drop must be 0 for a foot with a length"):
        Foot(0, 0.1, drop=1e-3)
    with pytest.raises(ValueError, match=r"for friction at the ends alone, got 0\.001 m"):
        Scene(strip, contacts="ends")
    with pytest.raises(ValueError, match="for friction at the ends alone"):
        predict(strip, GAITS["wave"], SURFACES["felt"], friction=Friction(tension=1.0))
    with pytest.raises(ValueError, match="for adhesive ground"):
        Scene(strip, ground=replace(SURFACES["felt"], adhesion=0.05))
    with pytest.raises(ValueError, match="for friction by load"):
        Scene(strip, ground="felt", friction="coulomb")
    limbs = LimbedRobot((Limb("torso", strip), Limb("leg", STRIP, "torso")))
    with pytest.raises(ValueError, match="for a robot of limbs"):
        Scene(limbs, replace(GAITS["wave"], stages=((0,) * 6, (1,) * 6, (0,) * 6)))
