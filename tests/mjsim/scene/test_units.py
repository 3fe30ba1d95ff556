import pytest

from analytic.fields import units
from mjsim.commands.run import main
from mjsim.files.scene_tables.tables import build
from mjsim.files.units import in_unit
from mjsim.scene import Numerics, Scene


# NIST SP 811, appendix B.8: exact or to seven digits
@pytest.mark.parametrize(
    ("written", "unit", "value"),
    [("1 psi", "Pa", 6894.757), ("1 bar", "Pa", 1e5), ("1 inch", "m", 0.0254),
     ("1gf", "N", 9.80665e-3), ("12 g", "kg", 0.012), ("1 atm", "Pa", 101325.0),
     ("0.09", "m", 0.09), ("-3e-2 m", "m", -0.03),
     ("50 %", "1", 0.5), ("1 mN m^2/kPa", "N m^2/Pa", 1e-6), ("180 deg", "rad", 3.14159265)],
)  # fmt: skip
def test_units_are_those_of_the_si_brochure(written, unit, value):
    assert in_unit("it", written, unit) == pytest.approx(value, rel=1e-6)


@pytest.mark.parametrize("written", ["", "x", "7 psi", "3 m m", "__import__('os') m", "9**9**9 m",
                                     "3 furlongs/s", "m", "3 m; 4 m"])  # fmt: skip
def test_what_is_no_length_is_named(written):
    with pytest.raises(ValueError, match="length must be a number of m") as caught:
        in_unit("length", written, "m")
    assert repr(written) in str(caught.value)


def test_a_scene_with_units_is_the_scene_in_si():
    written = {"robot": {"length": "90 mm", "mass": "12 g", "peak_pressure": "0.4 bar"},
               "gait": {"ramp_time": ["1500 ms", "2 s", 1, "1 s", "1 s"]},
               "ground": {"tip_force": "1.5 gf", "shear_strength": "10 Pa", "slope_deg": "1 mrad"},
               "numerics": {"timestep": "5 ms", "contact_time": 1}}  # fmt: skip
    plain = {"robot": {"length": 0.09, "mass": 0.012, "peak_pressure": 4e4},
             "gait": {"ramp_time": [1.5, 2.0, 1.0, 1.0, 1.0]},
             "ground": {"tip_force": 1.5 * 9.80665e-3, "shear_strength": 10.0,
                        "slope_deg": 0.057295779513},
             "numerics": {"timestep": 5e-3, "contact_time": 1.0}}  # fmt: skip
    (one, fine), (two, same) = build(written), build(plain)
    assert one.robot.length == pytest.approx(two.robot.length)
    assert one.robot.weight_per_length == pytest.approx(two.robot.weight_per_length)
    assert one.robot.peak_pressure == pytest.approx(two.robot.peak_pressure)
    assert one.gait.ramp_times == pytest.approx(two.gait.ramp_times)
    assert one.ground.tip_force == pytest.approx(two.ground.tip_force)
    assert one.slope == pytest.approx(two.slope)
    assert fine == same


def test_every_number_of_a_scene_says_its_unit_or_has_none():
    assert units(Numerics)["timestep"] == "s"
    assert units(Scene)["gravity"] == "m/s^2"


@pytest.mark.parametrize(("option", "value"), [("--robot.length", "7 psi"), ("--pressure", "90 mm"),
                                               ("--numerics.contact-time", "1 ms")])  # fmt: skip
def test_a_unit_of_another_kind_is_bad_input(option, value, capsys):
    with pytest.raises(SystemExit) as stop:
        main([option, value, "--no-video"])
    assert stop.value.code == 2
    error = capsys.readouterr().err
    assert value in error
    assert error.count("\n") == 1
