"""Gaits as a bench runs them: valve times, the supply's limit, the worst of what is not known."""

import csv
import itertools
from dataclasses import replace

import numpy as np
import pytest

from analytic import GAITS, SURFACES, Robot, predict
from analytic.scene.gait import Gait
from mjsim.commands import optimise
from mjsim.files.scene_tables.tables import merged
from mjsim.optimising.objective import Objective
from mjsim.optimising.valve_times import valve_times, within_supply, write
from mjsim.scene import Scene
from mjsim.scene.valves import Valves

PEAK = Robot().peak_pressure


def test_valves_that_are_told_these_times_give_the_gait_back(tmp_path):
    """Chambers that fill and vent at even rates, from the file alone."""
    gait = replace(GAITS["wave"], ramp_time=(1.0, 2.0, 1.0, 0.5, 3.0))
    write(gait, Robot(), tmp_path / "valves.csv")
    rows = list(csv.DictReader((tmp_path / "valves.csv").read_text("utf-8").splitlines()))
    time = np.linspace(0, gait.period, 301)
    fractions = np.stack(
        [np.interp(time, np.concatenate([[0], np.cumsum(gait.ramp_times)]), column)
         for column in np.array(gait.stages).T], axis=1,
    )  # fmt: skip
    for chamber, column in zip(Robot().chambers, fractions.T, strict=True):
        of_chamber = [row for row in rows if row["chamber"] == chamber]
        ends = [float(row[key]) for row in of_chamber for key in ("begin [s]", "end [s]")]
        levels = [float(row[key]) for row in of_chamber for key in ("from [kPa]", "to [kPa]")]
        assert np.interp(time, ends, levels) == pytest.approx(1e-3 * PEAK * column, rel=1e-5)
        assert all((row["valve"] == "fill") == (float(row["to [kPa]"]) > float(row["from [kPa]"]))
                   for row in of_chamber)  # fmt: skip


def test_a_ramp_over_two_stages_is_one_opening_of_the_valve():
    gait = Gait("slow", ((0, 0), (0.5, 1), (1, 0), (0, 0)), ramp_time=1.0)
    rows = valve_times(gait, Robot(segments=(1, 1)))
    assert [(row.valve, row.begin_s, row.end_s) for row in rows if row.chamber == "1"] == [
        ("fill", 0.0, 2.0), ("vent", 2.0, 3.0),
    ]  # fmt: skip


@pytest.mark.parametrize("limit", [1e3, 1e4, 1e6])
def test_no_chamber_changes_faster_than_the_supply_lets_it(limit):
    valves = Valves(flow_limit=(limit, 2 * limit, 3 * limit))
    gait = within_supply(GAITS["wave"], Robot(), valves)
    rates = (
        PEAK * np.abs(np.diff(np.array(gait.stages), axis=0)) / np.array(gait.ramp_times)[:, None]
    )
    assert (rates <= np.array([1, 2, 3]) * limit * (1 + 1e-12)).all()
    assert np.array(gait.ramp_times).min() >= min(GAITS["wave"].ramp_times)
    assert (gait is GAITS["wave"]) == (limit == 1e6)


def test_the_worst_of_what_is_not_known_counts():
    """Predictions of every combination, one by one."""
    base = merged({"ground": {"surface": "gelatin"}})
    others = optimise._corners("surface.tip_force=20%,robot.modulus=10%", [base])
    gelatin = SURFACES["gelatin"]
    objective = Objective(Scene(), (gelatin,), model="lifted", backward=True, others=others)
    each = [
        predict(
            Robot(modulus=part * Robot().modulus), GAITS["wave"],
            replace(gelatin, tip_force=other * gelatin.tip_force), "lifted", 10,
        )
        for part, other in itertools.product((0.9, 1.0, 1.1), (0.8, 1.0, 1.2))
    ]  # fmt: skip
    worst = min(-walk.locomotion.per_cycle for walk in each) / Robot().length
    assert objective(GAITS["wave"]) == pytest.approx(worst, rel=1e-4)  # less flagged states


@pytest.mark.parametrize(
    ("text", "words"),
    [
        (
            "robot.modulus=1%,robot.length=1%,robot.width=1%,surface.tip_force=1%",
            "at most 3 fields",
        ),
        ("valves.fill_time=5%", "must be fields of robot and surface in a search"),
    ],
)  # fmt: skip
def test_what_no_search_can_be_sure_of_is_refused(text, words):
    with pytest.raises(ValueError, match=words):
        optimise._corners(text, [merged({"ground": {"surface": "gelatin"}})])
