"""A plan is every combination of its list, grid and samples, in an order that never changes."""

import itertools

import numpy as np
import pytest

from analytic.scene.surface import SURFACES, Surface
from mjsim.sweeps.plan import EXAMPLE, make_plan, read_plan

FULL = {
    "scene": {"numerics": {"cycles": 2}},
    "list": [{"robot.length": "90 mm", "robot.mass": "12 g"}, {"robot.length": 0.1,
                                                               "robot.mass": 0.02}],
    "grid": {"ground.surface": ["felt", "gelatin"],
             "gait.ramp_time": {"from": "500 ms", "to": 2.0, "count": 4}},
    "latin_hypercube": {"samples": 5, "seed": 3, "robot.width": ["20 mm", "60 mm"],
                        "robot.modulus": {"from": "1 MPa", "to": "4 MPa", "log": True}},
}  # fmt: skip


def test_a_plan_is_every_combination_once_with_numbers_in_si():
    plan = make_plan(FULL)
    points = [plan.point(i) for i in range(len(plan))]
    assert len(points) == 2 * 2 * 4 * 5
    met = {(p["robot.length"], p["ground.surface"], p["gait.ramp_time"]) for p in points}
    wanted = itertools.product((0.09, 0.1), ("felt", "gelatin"), (0.5, 1.0, 1.5, 2.0))
    assert met == set(wanted)
    assert {p["robot.mass"] for p in points if p["robot.length"] == 0.09} == {0.012}
    assert len({tuple(p.values()) for p in points}) == len(points)


def test_a_latin_hypercube_has_one_sample_in_each_part_of_each_range():
    cube = FULL["latin_hypercube"] | {"samples": 50}
    plan = make_plan({"latin_hypercube": cube})
    width = np.array([plan.point(i)["robot.width"] for i in range(50)])
    modulus = np.array([plan.point(i)["robot.modulus"] for i in range(50)])
    assert sorted((50 * (width - 0.02) / 0.04).astype(int)) == list(range(50))
    assert sorted((50 * np.log(modulus / 1e6) / np.log(4)).astype(int)) == list(range(50))


def test_the_same_plan_has_the_same_scenes_and_digest_and_another_one_another():
    one, two = make_plan(FULL), make_plan(FULL)
    assert one.digest == two.digest
    assert [one.point(i) for i in range(80)] == [two.point(i) for i in range(80)]
    other = make_plan(FULL | {"latin_hypercube": FULL["latin_hypercube"] | {"seed": 4}})
    assert other.digest != one.digest
    assert other.point(0) != one.point(0)


def test_scenes_are_built_from_the_base_and_their_fields():
    scene, _ = make_plan(FULL).scene(0)
    assert scene.cycles == 2
    assert scene.robot.length == 0.09
    assert scene.ground is SURFACES["felt"]
    changed = make_plan({"grid": {"ground.surface": ["felt"], "ground.tip_force": ["5 mN"]}})
    scene, _ = changed.scene(0)
    assert scene.ground.tip_force == 0.005
    assert scene.ground.shear_strength == SURFACES["felt"].shear_strength


def test_a_ground_of_given_properties_keeps_them_when_other_fields_change():
    base = {"ground": {"tip_force": 0.1}}
    scene, _ = make_plan({"scene": base, "grid": {"robot.length": [0.1]}}).scene(0)
    assert scene.ground == Surface(tip_force=0.1)


def test_the_example_is_a_plan(tmp_path):
    path = tmp_path / "plan.toml"
    path.write_text(EXAMPLE)
    assert len(read_plan(path)) == 300


GRID = {"robot.length": [0.1]}


@pytest.mark.parametrize(
    ("content", "words"),
    [
        ({}, "needs a [grid]"),
        ({"grid": GRID, "model": "drake"}, "model must be one of mujoco, auto"),
        ({"grid": GRID, "tolerance": 2.0}, "tolerance must lie between"),
        ({"grid": GRID, "tolerance": 0.02, "model": "modes"}, "tolerance is of models mujoco"),
        ({"grid": GRID, "bent": True}, "bent must be true or false, and is of model elastica"),
        ({"grid": {"robot.colour": ["red"]}}, "key 'colour' of [robot] is unknown"),
        ({"grid": {"colour": ["red"]}}, "field 'colour' is unknown"),
        ({"grid": {"robot.length": ["90 kg"]}}, "robot.length must be a number of m"),
        ({"grid": {"robot.length": 0.1}}, "robot.length must be a list or from, to and count"),
        ({"grid": {"robot.length": {"from": 0, "to": 1, "count": 0}}}, "count of robot.length"),
        ({"grid": {"robot.length": {"from": 0, "to": 1, "count": 2, "log": True}}}, "above 0"),
        ({"grid": GRID, "list": [GRID]}, "robot.length must be in one of list, grid"),
        ({"list": [{"robot.length": 0.1}, {"robot.width": 0.1}]}, "every row must have the same"),
        ({"latin_hypercube": {"robot.length": [0.1, 0.2]}}, "samples must be a whole number"),
        ({"latin_hypercube": {"samples": 3}}, "needs a field"),
        ({"grid": {"robot.length": {"from": 0.1, "to": 1, "count": 10**9}}}, "count of robot"),
        ({"grid": GRID, "scene": {"robot": {"length": -1}}}, "length must be a positive"),
        ({"grid": GRID, "scenes": 3}, "key must be one of"),
    ],
)
def test_a_bad_plan_is_refused_in_one_line_that_names_what(content, words):
    with pytest.raises(ValueError, match=r"^[^\n]+$") as error:
        make_plan(content)
    assert words in str(error.value)
