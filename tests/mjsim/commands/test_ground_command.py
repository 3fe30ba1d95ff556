"""`undulator ground`: from a file of readings to a scene that walks."""

import json
import math
import tomllib
from pathlib import Path

import pytest

from mjsim.commands import fit, ground, run
from mjsim.files.command_line.cli import parse
from mjsim.files.scene_tables.tables import build, read_tables
from mjsim.fitting.parameters import parameters

TOP = Path(__file__).resolve().parents[3]
EXAMPLE = TOP / "examples" / "ground_tests.csv"


@pytest.fixture
def here(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    return tmp_path


def words_of(capsys, words, code=0):
    assert ground.main([*words, "--json"]) == code
    return json.loads(capsys.readouterr().out)


def test_the_example_gives_back_the_coefficients_that_made_it(here, capsys):
    record = words_of(capsys, [str(EXAMPLE)])
    made = {"friction": 0.42, "friction_back": 0.63, "friction_across": 0.55, "tip_friction": 0.30}
    by_name = {q["name"]: q for q in record["quantities"]}
    for name, truth in made.items():
        assert by_name[name]["low_95"] <= truth <= by_name[name]["high_95"]
        assert by_name[name]["high_95"] < 1.06 * by_name[name]["low_95"] + 0.02
    assert record["law"] == "coulomb"
    assert {law["law"] for law in record["laws"]} == {"coulomb"}
    scene, _ = build(read_tables(here / "ground.toml"))
    assert scene.friction == "coulomb"
    for name in made:
        assert getattr(scene.ground, name) == pytest.approx(by_name[name]["value"], rel=1e-5)


@pytest.mark.slow
def test_the_file_walks(here, capsys):
    assert ground.main([str(EXAMPLE)]) == 0
    assert run.main(["--scene", "ground.toml", "--no-video", "--json"]) == 0


def test_the_page_shows_what_the_example_prints(here, capsys):
    assert ground.main([str(EXAMPLE), "--out", "cloth.toml"]) == 0
    page = (TOP / "docs" / "own_ground.md").read_text()
    for line in capsys.readouterr().out.splitlines():
        assert line in page


def test_the_command_for_a_film_is_one_that_a_fit_takes(here, capsys):
    words = words_of(capsys, [str(EXAMPLE)])["film"].split()
    assert words[:2] == ["undulator", "fit"]
    options = parse(fit.Options, fit.PROGRAM, words[2:])
    free = parameters(read_tables(here / "ground.toml"), options.free, prior=options.prior)
    fields = {p.name.removeprefix("surface.") for p in free}
    assert fields == {"robot.modulus", "friction", "friction_back", "tip_friction"}
    assert all(p.prior for p in free if p.name != "robot.modulus")


def test_a_bound_either_way_and_across_is_written_as_such(here, capsys):
    path = here / "tests.csv"
    rows = [f"{angle},{way}" for way, angles in
            {"ahead": (20, 21, 19), "back": (31, 30, 29), "across": (25, 24, 26)}.items()
            for angle in angles]  # fmt: skip
    path.write_text("angle [deg],way\n" + "\n".join(rows))
    words = [str(path), "--mass", "5g", "--area", "20cm2", "--nap", "ground", "--name", "cloth"]
    record = words_of(capsys, words)
    assert record["law"] is None
    written = tomllib.loads((here / "ground.toml").read_text())
    assert written["ground"]["nap"] == "ground"
    assert written["ground"]["surface"] == "cloth"
    # 5 g on 20 cm2 under an angle of 20, 30 and 25 degrees
    bounds = [written["ground"][f"shear_strength{way}"] for way in ("", "_back", "_across")]
    assert bounds == pytest.approx([8.39, 12.26, 10.36], rel=2e-3)


def test_what_a_law_needs_and_the_readings_lack_is_said(here, capsys):
    path = here / "tests.csv"
    path.write_text("angle [deg],force [mN],tips\n30,,\n31,,\n,33,1\n,34,1\n")
    record = words_of(capsys, [str(path)])
    assert record["law"] is None
    assert record["ground"].keys() == {"friction", "tip_force"}
    for said in ("sides give no bound", "tips give no coefficient"):
        assert any(said in note for note in record["notes"])


def test_slides_and_begins_are_told_apart_and_one_of_them_is_written(here, capsys):
    path = here / "tests.csv"
    path.write_text("force [mN],state\n30,begins\n32,begins\n31,begins\n20,slides\n21,slides\n")
    record = words_of(capsys, [str(path), "--tips", "1"])
    assert record["ground"] == {"tip_force": pytest.approx(0.031)}
    assert any("1.51 times as much at rest" in note for note in record["notes"])
    record = words_of(capsys, [str(path), "--tips", "1", "--state", "slides", "--overwrite"])
    assert record["ground"] == {"tip_force": pytest.approx(0.0205)}


def test_a_law_that_neither_is_and_tests_that_differ_end_with_code_3(here, capsys):
    path = here / "tests.csv"
    rows = [f"{20 + 4 * mass + jitter},{mass}" for mass in (2, 5, 9) for jitter in (-0.3, 0, 0.3)]
    path.write_text("force [mN],mass [g]\n" + "\n".join(rows))
    record = words_of(capsys, [str(path), "--tips", "1"], 3)
    assert record["laws"][0]["law"] == "both"
    bound, mu = record["laws"][0]["bound"], record["laws"][0]["coefficient"]
    assert (bound["value"], mu["value"]) == pytest.approx((0.020, 4 / 9.81), rel=0.02)
    assert all(q["low_95"] is None for q in record["quantities"])
    path.write_text("angle [deg],force [mN]\n30,\n31,\n29,\n,60\n,61\n,59\n")
    record = words_of(capsys, [str(path), "--mass", "9g", "--overwrite"], 3)
    assert any("tests differ" in note for note in record["notes"])


def test_a_heavy_robot_has_a_ground_too(here, capsys):
    assert words_of(capsys, ["--force", "31,33,32N", "--tips", "2"])["ground"] == {
        "tip_force": pytest.approx(16.0)}  # fmt: skip


def test_a_scene_keeps_its_robot_and_its_slope_and_is_told_of_other_loads(here, capsys):
    (here / "my.toml").write_text(
        '[robot]\nmass = "12 g"\n[ground]\nsurface = "felt"\nslope_deg = 2\n'
        '[numerics]\nlinks = 12\nfriction = "coulomb"\n'
    )
    words = ["--force", "31,33,32mN", "--tips", "1", "--mass", "40g", "--scene", "my.toml"]
    record = words_of(capsys, words)
    scene, numerics = build(read_tables(here / "ground.toml"))
    assert (scene.robot.weight, numerics.links) == (pytest.approx(0.012 * 9.81), 12)
    assert math.degrees(scene.slope) == pytest.approx(2)
    assert (scene.ground.tip_force, scene.ground.shear_strength) == (pytest.approx(0.032), 0)
    assert any("58.9 mN a tip, readings are at 392 mN a tip" in note for note in record["notes"])
    assert "surface.tip_friction=" in record["film"]
    assert "tip_force" not in record["film"]


def test_a_file_that_is_there_is_not_written_over_in_silence(here, capsys):
    words = ["--force", "33,35,34mN", "--tips", "1"]
    (here / "ground.toml").write_text("mine")
    with pytest.raises(SystemExit) as stop:
        ground.main(words)
    assert stop.value.code == 2
    assert "--overwrite" in capsys.readouterr().err
    assert (here / "ground.toml").read_text() == "mine"
    assert ground.main([*words, "--overwrite"]) == 0
    assert [path.name for path in here.iterdir()] == ["ground.toml"]


@pytest.mark.parametrize(
    ("words", "said"),
    [
        ([], "data must be one CSV file at least"),
        (["nothing.csv"], "no such file"),
        (["--angle", "31,29"], "--angle must be with its unit, as 31deg"),
        (["--angle", "95deg"], "--angle must be from 0 to below 90 deg, got 95 deg"),
        (["--force", "33mN,30", "--tips", "1"], "--force must be with its unit, as 30mN"),
        (["--force", "33mN", "--mass", "12"], "--mass must be with its unit, as 12g"),
        (["--force", "33mN", "--mass", "12s"], "--mass must be a number of kg"),
        (["--force", "33mN"], "mass, area or tips must be given"),
        (["--force=-3mN", "--tips", "1"], "--force must be at least 0 N, got -0.003"),
        (["--force", "3mN", "--tips", "1.5"], "--tips must be a whole number"),
        (["--force", "3mN", "--tips", "2", "--area", "3cm2"], "a tip has no area"),
        (["--force", "3mN", "--width", "3cm"], "width and length must be given together"),
        (["--force", "3mN", "--mass", "3g", "--load", "3mN"], "mass or load must be given"),
        (["--force", "3mN", "--tips", "1", "--way", "back"], "tip_force must be measured ahead"),
        (["--force", "3mN", "--tips", "1", "--way", "up"], "ahead, back; got 'up'"),
        (["--force", "3mN", "--tips", "1", "--name", "felt"], "--name must be none of felt"),
        (["--force", "3mN", "--tips", "1", "--out", "x.txt"], "--out must end in .toml"),
        (["--force", "3mN", "--tips", "1", "--scene", "no.toml"], "scene 'no.toml' cannot be read"),
        (["--force", "0mN", "--tips", "1"], "must be above 0 in some readings"),
    ],
)
def test_bad_input_is_one_clear_line(here, capsys, words, said):
    with pytest.raises(SystemExit) as stop:
        ground.main(words)
    error = capsys.readouterr().err
    assert stop.value.code == 2
    assert error.count("\n") == 1
    assert said in error
    assert not list(here.iterdir())


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("angle\n30\n", "column 'angle' must name its unit, such as deg"),
        ("angle [deg],mass [g]\n30,12\n,12\n", "line 3: a reading must be an angle or a force"),
        (
            "angle [deg],force [N]\n30,12\n",
            "line 2: a reading must be an angle or a force, got both",
        ),
        ("angle [deg],way\n30,up\n", "line 2: way must be one of ahead, back, across; got 'up'"),
        ("angle [deg],state\n30,rest\n", "line 2: state must be one of begins, slides; got 'rest'"),
        ("angle [deg],mass [g]\n30,-12\n", "line 2: mass must be above 0 kg, got -0.012"),
        ("force [mN],tips,area [cm2]\n30,1,2\n", "line 2: tips or area must be given, not both"),
        ("time [s],mass [g]\n1,12\n", "needs a column of angles or forces"),
        ("angle [deg],angle [rad]\n1,1\n", "column 'angle' stands twice"),
        ("angle [deg],way\nx,\n", "line 2: angle [deg] must be a number, got 'x'"),
    ],
)
def test_bad_files_are_told_with_their_line(here, capsys, text, said):
    (here / "tests.csv").write_text(text)
    with pytest.raises(SystemExit) as stop:
        ground.main(["tests.csv"])
    error = capsys.readouterr().err
    assert stop.value.code == 2
    assert error.count("\n") == 1
    assert said in error
