"""Tethers of strips in MuJoCo."""

from dataclasses import replace

import pytest

from analytic import GAITS, SURFACES, Foot, Robot, Tether
from analytic.scene.gait import Gait
from analytic.scene.surface import Surface
from mjsim.files.command_line.options import SceneOptions, tables_of
from mjsim.files.scene_tables.tables import build
from mjsim.files.scene_tables.written import as_tables
from mjsim.results.measures import measure
from mjsim.results.prediction import reference
from mjsim.results.trajectory import load
from mjsim.scene import Numerics, Scene
from mjsim.simulation.side_by_side.layout import refusal
from mjsim.simulation.simulation import simulate

SLOW = replace(GAITS["wave"], ramp_time=8.0)
STRIP = Robot()


def tied(tether, ground, gait=SLOW, **more):
    return Scene(replace(STRIP, tether=tether), gait, SURFACES[ground], **more)


@pytest.mark.parametrize(("tether", "ground"), [
    (Tether(0.5, drag="1 mN"), "gelatin"),
    (Tether(0.0, drag="5 mN", mass="2 g"), "felt"),
    (Tether(1.0, drag="5 mN"), "gelatin"),
    (Tether(0.5, drag="1 mN"), "polyethylene"),
])  # fmt: skip
@pytest.mark.parametrize("law", ["constant", pytest.param("coulomb", marks=pytest.mark.slow)])
def test_it_goes_as_far_as_the_theory_says(tether, ground, law):
    scene = tied(tether, ground, friction=law)
    expected = reference(scene).displacement[0]
    assert abs(expected) > 0.01
    assert measure(simulate(scene)).displacement == pytest.approx(expected, rel=0.02)


@pytest.mark.parametrize("contacts", ["ends", "all"])
def test_a_drag_above_all_bounds_stops_it(contacts):
    scene = tied(Tether(0.4, drag=0.2), "gelatin", GAITS["wave"], contacts=contacts)
    walk = simulate(scene, Numerics(links=12))
    assert abs(measure(walk).displacement) < 2e-4


@pytest.mark.parametrize("contacts", ["ends", "all"])
def test_a_tether_at_an_end_is_a_foot_that_holds_there(contacts):
    ground = SURFACES["polyethylene"]
    robots = Robot(tether=Tether(0, drag=0.02)), Robot(feet=(Foot(0, 0, hold=0.02),))
    ways = [
        measure(simulate(Scene(robot, SLOW, ground, contacts=contacts))).displacement
        for robot in robots
    ]
    assert ways[0] == pytest.approx(ways[1], abs=5e-4)


def test_a_spring_stops_a_crawler_where_its_feet_hold_no_more():
    """Its left foot slides ahead while the right one holds back: b_R - a_L, over the stiffness."""
    arch = Gait("arch", ((0, 0, 0), (0.5, 0.5, 0.5), (0, 0, 0)), 16.0)
    feet = [Foot(end, end + 0.01, grip=0.5, grip_back=2.0) for end in (0.0, 0.99)]
    stops, ground = 0.1, Surface("rug", tip_force=0.01, shear_strength=100.0)
    tether = Tether(0.0, stiffness=0.015 / (stops * STRIP.length))
    scene = Scene(Robot(feet=feet, tether=tether), arch, ground, cycles=5)
    walk = simulate(scene, Numerics(links=24))
    left = walk.nodes()[0][:, 0] / STRIP.length
    assert left[-1] - left[0] == pytest.approx(stops, rel=0.02)
    expected = reference(scene)
    assert len(expected.by_cycle) == 5
    assert expected.by_cycle.sum() == pytest.approx(stops, rel=0.02)


@pytest.mark.parametrize("body", [pytest.param("cable", marks=pytest.mark.slow), "rod"])
def test_other_bodies_drag_it_too(body):
    scene = tied(Tether(0.37, drag=0.002), "gelatin", body=body)
    planar = measure(simulate(replace(scene, body="chain"))).displacement
    assert measure(simulate(scene)).displacement == pytest.approx(planar, abs=2e-3)


def test_it_is_written_as_it_is_read(tmp_path):
    scene = tied(Tether(0.2, drag=0.001, stiffness=0.3, mass=0.002), "felt", GAITS["wave"])
    assert build(as_tables(scene, Numerics()))[0] == scene
    walk = simulate(scene, Numerics(links=12, timestep=0.02))
    walk.save(tmp_path / "walk.nc")
    assert load(tmp_path / "walk.nc").scene == scene


def with_option(text):
    options = SceneOptions()
    return tables_of(replace(options, robot_=replace(options.robot_, tether=text)))[0]


def test_an_option_is_as_a_table():
    scene = build(with_option("0 drag=5mN stiffness=0.5 N/m mass=2 g"))[0]
    assert scene.strip.tether == Tether(0, 0.005, 0.5, 0.002)
    for wrong, words in (("drag=1mN", "robot.tether must be such as"), ("0", "drag, stiffness"),
                         ("0 drag=5mm", "drag must be a number of N"),
                         ("0 darg=5mN", "did you mean drag")):  # fmt: skip
        with pytest.raises(ValueError, match=words):
            build(with_option(wrong))


def test_batches_say_that_they_drag_none():
    assert "no tether" in refusal(tied(Tether(0, drag=0.01), "felt", GAITS["wave"]))
