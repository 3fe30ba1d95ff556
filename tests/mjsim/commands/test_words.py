"""Messages name the option that was typed, and ask for what may be meant."""

import pytest

from analytic.units import in_unit
from mjsim import Gait, Numerics, Robot, Scene, Surface, Valves, as_tables, simulate
from mjsim.commands.run import main
from mjsim.files.csv_table import head_of
from mjsim.files.scene_tables.quantities import check_field
from mjsim.files.scene_tables.tables import build
from mjsim.files.text_table import Column
from mjsim.scene import resolved
from mjsim.sweeps.export import with_unit
from mjsim.sweeps.plan import make_plan
from mjsim.sweeps.rows import Job, rows_of


def message(capsys, words):
    with pytest.raises(SystemExit) as stop:
        main([*words, "--no-video"])
    error = capsys.readouterr().err
    assert stop.value.code == 2
    assert error.count("\n") == 1
    return error


SLOW_PERIOD = [
    "--gait.lag",
    "0.2",
    "--gait.duty",
    "0.4",
    "--gait.ramp",
    "0.2",
    "--gait.period",
    "1e4",
]


@pytest.mark.parametrize(
    ("words", "option", "why"),
    [
        (["--surface.static-ratio", "2"], "--surface.stribeck-speed", "above 0"),
        (["--surface.tip-force", "3mN", "--surface.stribeck-speed", "1mm/s"],
         "--surface.stribeck-speed", "given static_ratio"),
        (["--surface.tip-force", "3mN", "--surface.adhesion-reach", "1mm"],
         "--surface.adhesion-reach", "given adhesion"),
    ],
)  # fmt: skip
def test_a_key_that_needs_another_is_refused_by_the_name_of_its_option(capsys, words, option, why):
    error = message(capsys, words)
    assert f" {option} " in error
    assert why in error
    assert "[" not in error


@pytest.mark.parametrize(
    ("words", "meant"),
    [
        (["--robot.lenght", "0.1"], "--robot.length"),
        (["--lenght=0.1"], "--robot.length"),
        (["--surface.shear", "3"], "--surface.shear-strength"),
        (["--timstep", "0.01"], "--timestep"),
        (["--ground", "felt"], "--surface"),
        (["--gait", "wav"], "wave"),
        (["--surface", "gelatine"], "gelatin"),
        (["--robot", "qadruped"], "quadruped"),
        (["--numerics.integrator", "euler"], "Euler"),
        (["--robot.length", "110 milimeter"], "millimeter"),
        (["--robot.thickness", "3"], "3 mm"),
        (["--robot.mass", "14"], "14 g"),
        (["--robot.length", "110"], "110 mm"),
        (["--robot.width", "40"], "40 mm"),
        (["--robot.modulus", "1.8"], "1.8 MPa"),
        (["--pressure", "40"], "40 kPa"),
        (["--pressure", "7"], "7 psi or 7 kPa"),
        (["--robot", "quadruped", "--robot.modulus", "1.8"], "1.8 MPa"),
        (["--robot.mass", "14mg"], "14 g"),
        (["--robot.thickness", "4um"], "4 mm"),
        (["--robot.width", "40um"], "40 mm"),
        (["--robot.length", "110um"], "110 mm"),
        (["--robot.chamber-height", "4um"], "4 mm"),
        (["--surface.tip-force", "34"], "34 mN"),
        (["--surface.tip-force", "34 nN"], "0.034 N"),
        (["--surface.shear-strength", "13000"], "13000 mPa"),
        (["--friction", "coulomb", "--surface.friction", "60"], "60 %"),
        (["--surface.tip-force", "0.03", "--surface.viscosity", "1e-5"], "10 Pa s/m"),
        (["--surface.tip-force", "0.03", "--surface.adhesion", "50000"], "50000 uJ/m^2"),
        (["--gait.ramp-time", "2000"], "2000 ms"),
        (["--gait.ramp-time", "2e-6"], "2 s"),
        (
            SLOW_PERIOD,
            "2000 ms",
        ),
        (["--lag", "200"], "200 ms"),
        (["--valves.dead-time", "50000"], "50000 us"),
        (["--roughness", "0.1", "--contacts", "all"], "0.1 um"),
    ],
)
def test_what_may_be_meant_is_asked(capsys, words, meant):
    assert f"did you mean {meant}" in message(capsys, words)


@pytest.mark.parametrize(
    ("words", "begins"),
    [
        (["--pressure", "100psi"], "--pressure must be below"),
        (["--robot.peak-pressure", "100psi"], "--robot.peak-pressure must be below"),
        (["--links", "5"], "--links must be"),
        (["--numerics.links", "x"], "--numerics.links must be a whole number"),
        (["--lag=-1"], "--lag must be"),
        (["--slope", "95"], "--slope must be"),
        (["--gait.ramp-time", "0"], "--gait.ramp-time must be"),
        (["--surface.friction", "-1"], "--surface.friction must be"),
        (["--gait.cycle", "3"], "--gait.cycle is for"),
        (["--robot.payload", "0.5 mass=-5g"], "--robot.payload, number 1: mass of a payload must"),
        (["--robot.payload", "0.5 mass=5kg"], "--robot.payload: mass must be one that"),
        (["--robot.tether", "0 drag=-1mN"], "--robot.tether: drag of a tether must"),
        (["--robot.feet", "0..1.2 grip=2"], "--robot.feet, number 1: end of a foot must"),
        (["--robot.payload", "0.5 mass=5g mass=6g"], "--robot.payload: key 'mass' stands twice"),
        (["--robot.tether", "0 drag=5"], "--robot.tether: drag must be one for a robot of"),
        (["--robot.feet", "0..0.1"], "--robot.feet, number 1: a foot must say what it does: give"),
        (["--robot.feet", "0..0.1 hold=50"], "--robot.feet: hold must be one for a robot of"),
        (["--robot.feet", "0..0 drop=1m"], "--robot.feet: drop must be at most"),
    ],
)
def test_an_error_begins_with_the_option_that_was_typed(capsys, words, begins):
    assert message(capsys, words).startswith(f"undulator run: error: {begins}")


def test_an_error_in_a_file_names_table_and_key(tmp_path, capsys):
    path = tmp_path / "scene.toml"
    path.write_text("[robot]\nthickness = 3\n")
    assert "[robot] thickness" in message(capsys, ["--scene", str(path), "--links", "12"])
    path.write_text("[robot]\nlenght = 3\n")
    assert "did you mean length" in message(capsys, ["--scene", str(path)])


@pytest.mark.parametrize(
    ("words", "named"),
    [
        (["--robot.mass", "14mg"], "--robot.mass"),
        (["--robot.weight-per-length", "1e-3"], "--robot.weight-per-length"),
        (["--robot.curvature-per-pressure", "1e-9"], "--robot.curvature-per-pressure"),
        (
            SLOW_PERIOD,
            "--gait.period",
        ),
        (["--roughness", "1um"], "--roughness"),
        (["--robot", "quadruped", "--roughness", "1um"], "--roughness"),
    ],
)
def test_a_magnitude_that_is_none_is_told_by_the_option_that_gave_it(capsys, words, named):
    assert message(capsys, words).startswith(f"undulator run: error: {named} ")


def test_a_light_robot_under_little_gravity_is_a_robot():
    light = Robot(weight_per_length=1e-3)
    with pytest.raises(ValueError, match="mass must be"):
        Scene(light)
    assert Scene(light, gravity=0.01).robot == light


@pytest.mark.parametrize(
    ("value", "text"), [(3e-5, "<0.0001"), (0.0, "0.0000"), (5.1e-5, "0.0001"), (None, "-")]
)
def test_an_error_below_the_digits_that_are_written_is_not_written_as_none(value, text):
    assert Column("±", "it", ".4f", error=True).cell({"it": value}) == text


def test_coefficients_alone_name_the_option_that_makes_them_act(capsys):
    assert "--friction coulomb" in message(capsys, ["--surface.friction", "0.6"])


def patched(begin):
    patches = [{"surface": "felt"}, {"surface": "gelatin", "from": begin}]
    return build({"ground": {"patches": patches}})


def test_a_patch_out_of_reach_is_asked_back_and_one_far_ahead_is_none():
    with pytest.raises(ValueError, match="did you mean 115 mm"):
        patched(115)
    far, plain = (simulate(scene, Numerics(links=12, timestep=0.02))
                  for scene in (patched(1.5)[0], Scene()))  # fmt: skip
    assert far.line[-1, 0, 0] == pytest.approx(plain.line[-1, 0, 0], abs=1e-9)


def test_robots_of_any_size_are_robots():
    for size in (1e-3, 1e2):
        base = Robot()
        robot = Robot(length=size * base.length, width=size * base.width,
                      thickness=size * base.thickness, chamber_height=size * base.chamber_height,
                      weight_per_length=size**2 * base.weight_per_length)  # fmt: skip
        assert Scene(robot=robot).robot == robot


def test_python_takes_names_and_values_with_units():
    robot = Robot(length="110 mm", mass="14 g", peak_pressure="6 kPa", modulus="0.25 MPa")
    assert robot.length == pytest.approx(0.11)
    assert robot.weight_per_length == pytest.approx(0.014 * 9.81 / 0.11)
    scene = Scene(robot, ground="felt", gait="pulse", slope="5 deg", settle_time="300 ms")
    assert scene.ground.shear_strength > 0
    assert scene.gait.segments == 3
    assert scene.slope == pytest.approx(0.0872664626)
    assert Surface(tip_force="30 mN").tip_force == pytest.approx(0.03)
    assert Valves(vent_time=("200 ms", 1)).vent_time == (0.2, 1.0)
    assert Numerics(timestep="2 ms").timestep == pytest.approx(2e-3)
    assert Gait("it", ((0,), (1,), (0,)), ("1 s", "500 ms")).period == pytest.approx(1.5)
    limbs = Scene("quadruped", "crawl", "gelatin")
    assert len(limbs.robot.limbs) == 5
    assert build(as_tables(scene, resolved(scene)))[0] == scene


@pytest.mark.parametrize(
    ("make", "named"),
    [
        (lambda: check_field("modulus"), "did you mean robot.modulus"),
        (lambda: check_field("robo.modulus"), "did you mean robot.modulus"),
        (lambda: check_field("robot.modulos"), "did you mean modulus"),
        (lambda: make_plan({"grdi": {}}), "did you mean grid"),
        (lambda: Scene(ground="fel"), "did you mean felt"),
        (lambda: Scene(gait="wav"), "did you mean wave"),
        (lambda: Scene("strp"), "did you mean strip"),
        (lambda: Robot(length="110 psi"), "length must be a number of m"),
        (lambda: Robot(peak_pressure="20 psia"), "over the ambient"),
    ],
)
def test_python_refuses_in_the_same_words(make, named):
    with pytest.raises(ValueError, match=named):
        make()


def test_a_walk_is_a_table_along_time():
    walk = simulate(Scene(), Numerics(links=12, timestep=0.02))
    table = walk.to_pandas()
    assert table.index.name == "time"
    assert table["x"].to_numpy() == pytest.approx(walk.line[:, 0, 0])
    assert table["pressure_left"].max() == pytest.approx(walk.scene.robot.peak_pressure)
    assert table.attrs["units"]["pressure_left"] == "Pa"


def test_modes_whose_bound_is_small_are_ok_and_others_are_not():
    ok, bad = (rows_of(Job({}, "modes", [(0, {"robot.weight_per_length": weight})]))[0]
               for weight in (Robot.weight_per_length, 10.0))  # fmt: skip
    assert ok["status"] == "ok"
    assert ok["uncertainty_over_L"] < 1e-3
    assert bad["uncertainty_over_L"] > 1e-3
    assert "both_flat" in bad["status"]


def test_heads_say_a_unit_once():
    assert with_unit("speed_m_per_s", "m/s") == "speed_m_per_s"
    assert with_unit("robot.length", "m") == "robot.length [m]"
    assert with_unit("displacement_over_L", "1") == "displacement_over_L"


@pytest.mark.parametrize(
    ("text", "pascal"),
    [("1 kgf/cm2", 98066.5), ("7 psig", 48263.301), ("2 PSI", 13789.515), ("3 KPA", 3e3),
     ("4 bar(g)", 4e5), ("2 kPa gauge", 2e3), ("1 N/mm²", 1e6), ("760 mmHg", 101325.0)],
)  # fmt: skip
def test_pressures_are_spelled_in_many_ways(text, pascal):
    assert in_unit("it", text, "Pa") == pytest.approx(pascal, rel=1e-5)


@pytest.mark.parametrize(
    ("head", "name", "unit", "absolute"),
    [("Time (in ms)", "Time", "ms", None), ("p1 / kPa", "p1", "kPa", None),
     ("p1, psig", "p1", "psi", False), ("p1_psia", "p1", "psi", True),
     ("P 1 (bar a)", "P 1", "bar", True), ("p1 [kPa(g)]", "p1", "kPa", False),
     ("Pressure (gauge) [kPa]", "Pressure (gauge)", "kPa", None), ("p_l", "p_l", "", None),
     ("valve_1", "valve_1", "", None), ("x@0.25 [mm]", "x@0.25", "mm", None)],
)  # fmt: skip
def test_heads_of_columns_are_names_and_units(head, name, unit, absolute):
    assert head_of(head) == (name, unit, absolute)


@pytest.mark.parametrize(
    ("word", "meant"), [("walk.toml", "--scene walk.toml"), ("log.CSV", "--gait log.CSV")]
)
def test_a_file_without_its_option_is_answered_with_it(capsys, word, meant):
    with pytest.raises(SystemExit) as stop:
        main([word, "--no-video"])
    assert stop.value.code == 2
    assert f"got {word!r}; did you mean {meant}?" in capsys.readouterr().err
