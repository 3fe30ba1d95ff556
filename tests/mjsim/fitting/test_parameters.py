"""What is free in a fit."""

import math
import re

import pytest

from analytic import SURFACES
from mjsim.files.scene_tables.tables import build
from mjsim.fitting.parameters import parameters, with_values

BASE = {"ground": {"tip_force": 0.02, "shear_strength": 10.0}}


def test_parameters_start_at_the_scene_with_bounds_a_factor_of_100_away():
    (one,) = parameters(BASE, "surface.tip_force")
    assert (one.start, one.low, one.high) == pytest.approx((0.02, 2e-4, 2.0))
    assert one.unit == "N"


def test_starts_bounds_and_priors_carry_units():
    (one,) = parameters(
        BASE, "robot.modulus", "robot.modulus=2MPa", "robot.modulus=1MPa..3MPa",
        "robot.modulus=2.1MPa+-0.1MPa",
    )  # fmt: skip
    assert (one.start, one.low, one.high) == (2e6, 1e6, 3e6)
    assert one.prior == pytest.approx((2.1e6, 1e5))


def test_values_go_where_their_names_say():
    scene, _ = build(with_values(BASE, {"robot.modulus": 3e6, "surface.tip_force": 0.05}))
    assert scene.robot.modulus == 3e6
    assert (scene.ground.tip_force, scene.ground.shear_strength) == (0.05, 10.0)


def test_a_slope_alone_leaves_the_ground_the_default_one():
    scene, _ = build(with_values({"ground": {"slope_deg": 2.0}}, {"surface.tip_force": 0.05}))
    assert scene.slope == pytest.approx(math.radians(2.0))
    assert scene.ground.tip_force == 0.05
    assert scene.ground.shear_strength == SURFACES["felt"].shear_strength


def test_a_surfaces_parameter_changes_runs_on_it_alone():
    values = {"gelatin.tip_force": 0.05}
    wet, _ = build(with_values(BASE, values, surface="gelatin"))
    assert wet.ground.tip_force == 0.05
    assert wet.ground.shear_strength == SURFACES["gelatin"].shear_strength
    felt, _ = build(with_values(BASE, values, surface="felt"))
    assert felt.ground == SURFACES["felt"]


@pytest.mark.parametrize(
    ("free", "more", "words"),
    [
        ("", {}, "free must name fields"),
        ("robot", {}, "such as robot.modulus"),
        ("robot.segments", {}, "is no number"),
        ("robot.modulus,robot.modulus", {}, "each field once"),
        ("robot.colour", {}, "key 'colour'"),
        ("felt.colour", {}, "key 'colour'"),
        ("gait.lag", {}, "robot, valves, surface"),
        ("valves.fill_time", {}, "give it a start"),
        ("robot.modulus", {"start": "robot.width=1"}, "name=value of robot.modulus"),
        ("robot.modulus", {"start": "robot.modulus=2 kg"}, "one with its unit"),
        ("robot.modulus", {"bounds": "robot.modulus=1..2"}, "within its bounds"),
        ("robot.modulus", {"bounds": "robot.modulus=5"}, "two numbers with .. between"),
        ("robot.modulus", {"prior": "robot.modulus=5+-0"}, "prior of robot.modulus"),
    ],
)
def test_what_cannot_be_free_is_said(free, more, words):
    with pytest.raises(ValueError, match=re.escape(words)):
        parameters(BASE, free, **more)
