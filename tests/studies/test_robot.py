"""The page that derives the robot holds the numbers that follow from the code's."""

from pathlib import Path

import pytest

from analytic.scene.limbs import quadruped
from analytic.scene.robot import Robot
from studies.robot import main, rows

PAGE = (Path(__file__).parents[2] / "docs" / "robot.md").read_text("utf-8")


def test_the_page_has_the_table_that_is_printed(capsys):
    main()
    assert "135.7 mm long, 343 mN" in capsys.readouterr().out
    for row in rows():
        assert row in PAGE


def test_the_page_has_the_numbers_of_the_default_robots():
    strip, robot = Robot(), quadruped()
    leg = robot.limbs[1].strip
    for words in (
        f"w = {strip.weight_per_length:g} N/m", f"{1e3 * strip.chamber_height:g} mm",
        f"{1e-6 * strip.modulus:g} MPa", f"{1e3 * strip.weight:.0f} mN",
        f"{1e3 * robot.length:.1f} mm", f"{1e3 * robot.weight:.0f} mN",
        f"torso {1e3 * robot.limbs[0].strip.length:.1f} mm, legs {1e3 * leg.length:.1f} mm",
        f"{1e-3 * robot.peak_pressure:.1f} kPa",
    ):  # fmt: skip
        assert words in PAGE


def test_the_mesh_by_equation_3_needs_a_modulus_that_no_silicone_has():
    thickness, height, part, length = 1.0e-3, 3.8e-3, 0.15, 0.1357
    angle = 3.53 * length / Robot.length  # as curved as the strip
    modulus = 6 * height**2 * part * Robot.peak_pressure * length / (thickness**3 * angle)
    assert modulus == pytest.approx(23e6, rel=0.02)
    assert "23 MPa" in PAGE
