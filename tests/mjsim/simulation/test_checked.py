"""Numerics that check themselves keep their word on scenes that nobody measured."""

import itertools
from dataclasses import replace

import pytest

from analytic import GAITS, SURFACES, Gait, Robot
from mjsim.scene import Numerics, Scene
from mjsim.scene.auto import Rung, rungs
from mjsim.simulation.checked import ladder, walk_checked
from mjsim.simulation.measures import measure
from mjsim.simulation.simulation import simulate
from mjsim.studies.accuracy.benchmark_cases import GROUNDS, WALK, exact, scene_of

HIGH = Scene(Robot(peak_pressure=60e3), ground=SURFACES["felt"])
UNEVEN = Scene(Robot(segments=(1.0, 2.0, 3.0)), ground=SURFACES["gelatin"])
FAST = Scene(gait=replace(GAITS["wave"], ramp_time=0.3), ground=SURFACES["felt"])
FOUR = Scene(
    Robot(segments=(1.0,) * 4),
    Gait("four", ((0,) * 4, (1, 0, 0, 0), (1, 1, 0, 0), (0, 0, 1, 1), (0, 0, 0, 1), (0,) * 4)),
    SURFACES["polyethylene"],
)


@pytest.mark.parametrize(
    "scene", [HIGH, UNEVEN, FAST, FOUR], ids=["high", "uneven", "fast", "four"]
)
def test_the_distance_is_that_of_fine_numerics_within_the_tolerance(scene):
    found = walk_checked(scene, 0.02)
    fine = measure(simulate(scene, Numerics(links=48, timestep=0.001))).displacement
    assert found.agreed
    assert measure(found.walk).displacement == pytest.approx(fine, rel=0.02, abs=0.001)


def test_a_robot_that_falls_is_said_to_fall_by_two_fine_walks():
    heavy = Scene(Robot(weight_per_length=2.0, chamber_height=4.1e-3, peak_pressure=80e3))
    found = walk_checked(heavy, 0.02)
    assert found.walk.status == "toppled"
    assert found.agreed
    assert found.tried[-1].timestep <= 0.005


def test_each_walk_is_finer_than_the_one_before_and_steps_follow_the_ramps():
    for scene in (HIGH, FAST, FOUR):
        steps = list(ladder(scene, 0.02))
        assert len(steps) > 2
        for one, two in itertools.pairwise(steps):
            assert two.links >= one.links
            assert two.timestep <= one.timestep
        assert steps[0].timestep <= min(scene.gait.ramp_times) / 40 + 1e-12
    assert all(numerics.links % 4 == 0 for numerics in ladder(FOUR, 0.02))


@pytest.mark.parametrize("contacts", ["ends", "all"])
def test_a_looser_tolerance_never_costs_more(contacts):
    links = [rungs(contacts, tolerance)[0].links_per_segment for tolerance in (0.005, 0.02, 0.1)]
    assert links == sorted(links, reverse=True)


def test_what_is_too_often_wrong_is_never_accepted(tmp_path):
    """It may be the first of a pair, but not the second."""
    table = tmp_path / "auto.csv"
    lines = [",".join(Rung._fields), "ends,4,0.02,20,1,0.9,0.9,500",
             "ends,6,0.01,20,1,0.94,0.9,300", "ends,8,0.005,20,1,0.95,0.9,100",
             "ends,12,0.002,20,1,1,0.9,20"]  # fmt: skip
    table.write_text("\n".join(lines))
    assert [rung.links_per_segment for rung in rungs("ends", 0.02, table)] == [6, 8, 12]
    assert [rung.links_per_segment for rung in rungs("ends", 0.1, table)] == [4, 6, 8, 12]
    assert [rung.links_per_segment for rung in rungs("ends", 0.005, table)] == [8, 12]


@pytest.mark.slow
@pytest.mark.parametrize("tolerance", [0.1, 0.02])
@pytest.mark.parametrize("ground", GROUNDS[WALK])
def test_auto_meets_its_tolerance_on_the_benchmark_scene(ground, tolerance):
    found = walk_checked(scene_of(WALK, ground), tolerance)
    assert measure(found.walk).displacement == pytest.approx(exact(WALK, ground), rel=tolerance)
