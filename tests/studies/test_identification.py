"""The default robot is the one of the paper's two statements."""

import re
from dataclasses import replace

import pytest

from analytic import GAITS, SURFACES, Elastica, Robot, predict
from analytic.scene import pneunet
from studies.identification import identify, main, statements


def test_the_default_robot_meets_both_statements():
    """[Majidi13]: no displacement on polyethylene, at an amplitude of a quarter of the length."""
    does = statements(Robot())
    assert abs(does.displacement) < 0.001
    assert does.amplitude == pytest.approx(0.250, abs=0.002)


@pytest.mark.parametrize(("surface", "sign"), [("felt", 1), ("gelatin", -1)])
def test_it_then_walks_forward_on_felt_and_backward_on_gelatin(surface, sign):
    walk = predict(Robot(), GAITS["wave"], SURFACES[surface], Elastica(links=120), 100)
    assert walk.locomotion.per_cycle / Robot().length == pytest.approx(0.034 * sign, abs=0.001)


@pytest.mark.slow
def test_another_start_finds_the_same_robot_to_the_last_digit_but_one():
    robot = identify(replace(Robot(), weight_per_length=1.6, chamber_height=4.0e-3))
    assert robot.weight_per_length == pytest.approx(Robot.weight_per_length, rel=2e-3)
    assert robot.chamber_height == pytest.approx(Robot.chamber_height, rel=2e-3)
    assert pneunet.load_number(robot) == pytest.approx(8.1, abs=0.05)
    assert pneunet.turn_number(robot) == pytest.approx(3.53, abs=0.02)


@pytest.mark.slow
def test_one_command_prints_it(capsys):
    assert main() == 0
    printed = capsys.readouterr().out
    weight, height = map(float, re.findall(r"w = (\S+) N/m, H = (\S+) m", printed)[0])
    assert weight == pytest.approx(Robot().weight_per_length, abs=0.0011)  # as printed
    assert height == pytest.approx(Robot().chamber_height, abs=1.1e-6)
    assert "Gamma = 8.10" in printed
