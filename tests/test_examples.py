"""Every example runs as it stands, and says what its text promises."""

import importlib.util
import json
import re
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from analytic import Robot, Surface, predict
from analytic.friction.laws import Friction
from analytic.scene.gait import GAITS
from analytic.scene.quadruped_gaits import undulation

FOLDER = Path(__file__).resolve().parent.parent / "examples"


pytestmark = pytest.mark.usefixtures("forgets")


def module_of(name):
    spec = importlib.util.spec_from_file_location(name, FOLDER / f"{name}.py")
    module = importlib.util.module_from_spec(spec)
    sys.modules[name] = module  # by which other processes find its functions
    spec.loader.exec_module(module)
    return module


def example(name):
    return module_of(name).main


def test_a_robot_of_ones_own_walks_forward_on_felt():
    assert example("own_robot")() > 0.005


@pytest.mark.slow
def test_measured_actuators_walk_alike_in_theory_and_mujoco():
    shifts = example("measured_actuators")()
    assert shifts["MuJoCo"] == pytest.approx(shifts["theory"], rel=0.02)
    assert abs(shifts["affine law, theory"] / shifts["theory"] - 1) > 0.05


def test_a_ground_of_ones_own_lies_between_felt_and_gelatin():
    shifts = example("own_ground")()
    assert shifts["gelatin"] < shifts["table"] < shifts["felt"]


def test_a_gait_of_ones_own_goes_the_other_way_reversed():
    shifts = example("own_gait")()
    for surface in ("felt", "gelatin"):
        there, back = (shifts[f"{way} {surface}"] for way in ("middle-first",
                                                             "middle-first-reversed"))  # fmt: skip
        assert there == pytest.approx(-back, abs=0.004)


def test_a_body_of_ones_own_bends_lower_under_its_load():
    shifts = example("own_body")()
    assert shifts["laden"] != pytest.approx(shifts["chain"], abs=1e-4)


def test_a_law_of_ones_own_agrees_in_theory_and_mujoco():
    assert max(map(abs, example("own_law")().values())) < 0.002


@pytest.mark.slow
def test_a_controller_brings_the_robot_back():
    assert abs(example("controller")()) < 0.001


def test_mujoco_alone_walks_backward_on_gelatin():
    assert example("mujoco_loop")() == pytest.approx(-0.035, abs=0.003)


def test_dm_control_walks_backward_on_gelatin():
    pytest.importorskip("mjsim.env.dm_binding", exc_type=ImportError)
    assert example("dm_control_physics")() < -0.005


def test_a_saved_walk_is_plotted(tmp_path):
    assert example("plot_trajectory")(tmp_path).stat().st_size > 5000


def test_theory_alone_finds_the_neutral_surface_at_polyethylene():
    assert example("theory_alone")() == pytest.approx(0.5, abs=0.01)


@pytest.mark.slow
def test_strong_friction_turns_the_robot_round_as_theory_says():
    rows = example("strong_friction")(count=2, strongest=60.0)
    gaps = [abs(theory - simulated) for _, theory, simulated in rows]
    assert all(gap < 0.001 for gap in gaps[:-1])
    assert gaps[-1] < 0.003  # friction lets go at once there, and momentum counts
    assert rows[-1][2] < -0.01 < rows[0][2]


@pytest.mark.slow
def test_a_crossing_stalls_where_theory_says():
    walked, theory = example("crossing")()
    assert walked == pytest.approx(theory, abs=0.02 * 0.13)


@pytest.mark.slow
def test_a_long_robot_goes_otherwise_with_friction_between_its_ends_in_both_models():
    shifts = example("long_robot")(links=24)
    for part in ("60 % of the pressure", "full pressure"):
        for name in ("felt", "polyethylene", "gelatin"):
            theory, simulated = (shifts[f"{part}, {name}, {kind}"] for kind in ("all", "MuJoCo"))
            assert simulated == pytest.approx(theory, rel=0.05, abs=0.001)
            assert abs(theory - shifts[f"{part}, {name}, ends"]) > 5 * abs(theory - simulated)


@pytest.mark.slow
def test_wet_ground_turns_a_slow_robot_round():
    far = example("wet_ground")(count=2)
    wet = far["film, and tips that hold"]
    assert wet[0] > 0.005 > -0.03 > wet[1]
    assert far["MuJoCo"] == pytest.approx(wet, abs=0.002)
    for name in ("dry felt", "dry gelatin"):
        assert far[name][0] == far[name][1]


@pytest.mark.slow
def test_a_robot_goes_farther_on_sticky_ground():
    far = example("sticky_ground")()
    for pairs in far.values():
        (weak, walked), (strong, found_there) = pairs
        assert abs(strong) > 1.2 * abs(weak)
        assert walked == pytest.approx(weak, rel=0.03)
        assert found_there == pytest.approx(strong, rel=0.06)


@pytest.mark.slow
def test_the_piezo_inchworm_goes_as_in_the_simulator_that_others_published():
    """-0.5 to -1.1 mm a cycle there, +0.9 to +1.1 mm with the mirrored gait.

    Half the difference of both ways, since here as there they are not quite mirror images.
    """
    far = example("piezo_inchworm")()
    assert far["forward"] < -0.4 < 0.3 < far["backward"]
    assert 0.5 < 0.5 * (far["backward"] - far["forward"]) < 1.1


@pytest.mark.slow
def test_many_walks_go_farther_with_more_pressure():
    assert (np.diff(example("many_walks")()) > 0).all()


@pytest.mark.slow
def test_a_fit_gives_back_the_robot_that_made_its_track():
    off = example("fitted_robot")()
    assert abs(off["robot.modulus"]) < 0.01
    assert max(map(abs, off.values())) < 0.05


def test_speeds_give_back_the_groups_that_made_them_and_what_runs_left_out_do(monkeypatch):
    """From the closed form of a table that is smooth, since the fit reads any."""
    of = module_of("inchworm_speeds")
    axes = np.log(of.LOADS), of.TURNS, np.log(of.FRICTIONS)
    load, turn, friction = np.meshgrid(*axes, indexing="ij")
    far = 0.02 * turn**2 - 0.05 * load * turn / (1 + np.exp(friction))
    table = {"wave": of.RegularGridInterpolator(axes, far)}
    rng = np.random.default_rng(0)
    names, measured = np.array(["cork", "felt"]), np.array([0.5, 1.5])
    which = np.tile([0, 1], 60)
    runs = of.Runs(rng.uniform(60, 250, 120), rng.uniform(0.1, 0.5, 120), np.zeros(120),
                   names[which], measured[which])  # fmt: skip
    true = np.array([np.log(6.0), np.log(1.6), np.log(90.0), 0.2, -0.2, -0.3, 0.3])
    speed = of.speeds(table["wave"], ("cork", "felt"), true, runs)
    runs = runs._replace(speed=speed + rng.normal(0, 0.05, 120))
    fitted = of.fit(table, runs.of(slice(0, 80)))
    assert fitted.noise == pytest.approx(0.05, rel=0.2)
    assert (np.abs(fitted.values - true) < 3 * np.sqrt(np.diag(fitted.covariance))).all()
    value, wide = of.predictions(table, fitted, runs.of(slice(80, None)))
    assert np.mean(np.abs(value - runs.speed[80:]) < wide) >= 0.9


@pytest.mark.slow
def test_the_table_of_an_inchworm_is_read_by_its_command(tmp_path, monkeypatch, capsys):
    of = module_of("inchworm_speeds")
    monkeypatch.setattr(of, "LOADS", np.array([3.0, 9.0]))
    monkeypatch.setattr(of, "TURNS", np.array([0.0, 2.0, 4.0]))
    monkeypatch.setattr(of, "FRICTIONS", np.array([0.2, 2.0]))
    lines = [f"{p},{f},{p * f / 20},{m},{mu}" for p in (50, 150) for f in (0.1, 0.3)
             for m, mu in (("cork", 0.5), ("felt", 1.0))]  # fmt: skip
    head = "pressure,frequency,speed,material,friction_coefficient\n"
    (tmp_path / "runs.csv").write_text(head + "\n".join(lines))
    (tmp_path / "more.csv").write_text(f"{head}120,0.2,,felt,1.0\n120,0.2,,ice,0.1\n")
    of.main([str(tmp_path / "runs.csv"), "--out", str(tmp_path / "out"), "--predict",
             str(tmp_path / "more.csv")], gaits=("wave",))  # fmt: skip
    printed = capsys.readouterr().out.splitlines()
    assert [line.split(",")[0] for line in printed[-2:]] == ["felt", "ice"]
    assert (tmp_path / "out" / "inchworm.png").stat().st_size > 5000


def test_gaits_are_searched_one_leg_at_a_time_and_mirrored_to_turn_on_the_spot(monkeypatch):
    of = module_of("quadruped_gaits")
    crawls = of.crawls()
    assert len({gait.stages for gait in crawls}) == len(crawls) == 12 * 8  # less mirror images
    for gait in crawls:
        legs = np.array(gait.stages)[:, 1:]
        assert legs.sum(axis=1).max() == 1  # never two at a time
        assert (legs.max(axis=0) == 1).all()
    monkeypatch.setattr(of, "walked", lambda gait, surface: (float("nan"), -len(gait.name)))
    best_gaits = of.main(("felt",))
    assert best_gaits["felt", "turns"][0].name.startswith("spin-full-wave")
    assert np.isnan(best_gaits["felt", "crawls"][1])


@pytest.mark.slow
def test_a_gait_then_its_mirror_image_backwards_turns_on_the_spot():
    of = module_of("quadruped_gaits")
    ahead, turn = of.walked(of.on_the_spot("wave", 0.3, of.RAMP), "gelatin")
    alone, half = of.walked(replace(undulation("wave", left=0.3), ramp_time=of.RAMP), "gelatin")
    assert turn == pytest.approx(2 * half, rel=0.05)
    assert abs(ahead) < 0.2 * abs(alone)


def test_every_example_is_tested():
    text = Path(__file__).read_text()
    for path in FOLDER.glob("*.py"):
        assert f'"{path.stem}"' in text


def numbers(text):
    return [float(word) for word in re.findall(r"[-+]?\d+\.\d+(?:e[-+]\d+)?", text)]


@pytest.mark.filterwarnings("ignore::DeprecationWarning")  # of the notebooks' own machinery
@pytest.mark.slow
@pytest.mark.parametrize("name", ["own_strip", "markers_to_fit", "two_grounds", "one_walk"])
def test_a_notebook_prints_what_it_shows(name):
    """Within a per cent or 0.001, but for how long a search took."""
    pytest.importorskip("nbclient")
    if name == "two_grounds":
        pytest.importorskip("cma")
    import notebooks

    assert len(notebooks.NOTEBOOKS) == 4
    path = next(path for path in notebooks.NOTEBOOKS if path.stem == name)
    shown = notebooks.printed(notebooks.nbformat.read(path, as_version=4))
    notebook = notebooks.run(path)
    times = re.compile(r"in \d+ s|[\d.]+ s$", re.M)
    shown, printed = (times.sub("", text) for text in (shown, notebooks.printed(notebook)))
    assert len(printed) > 100
    assert numbers(printed) == pytest.approx(numbers(shown), rel=0.01, abs=1e-3)
    pictures = [out for cell in notebook.cells for out in cell.get("outputs", [])
                if "image/png" in out.get("data", {})]  # fmt: skip
    assert pictures
    assert path.stat().st_size < 200_000


def test_over_the_seam_wave_and_controller_begin_alike_in_theory_and_mujoco():
    went = example("reversing")(cycles=3)
    assert went["MuJoCo, controller"] == pytest.approx(went["MuJoCo, wave alone"], abs=1e-6)
    assert went["controller"] == pytest.approx(went["MuJoCo, controller"], abs=0.01)


@pytest.mark.slow
def test_gradient_steps_find_a_gait_that_goes_half_as_far_again_in_a_few_walks():
    first, best, walks = example("steepest_gait")()
    assert best > 1.5 * first
    assert walks <= 15


@pytest.mark.slow
def test_markers_of_a_camera_give_back_the_strip_and_its_gaits(tmp_path):
    """The markers are of a strip of 2 MPa on tips of 34 mN and sides of 20 Pa, to 0.3 mm."""
    walks = example("from_a_video")(folder=tmp_path)
    parameters = json.loads((tmp_path / "fit.json").read_text())["parameters"]
    for parameter, true in zip(parameters, (2e6, 0.034, 20.0), strict=True):
        assert parameter["low_95"] < true < parameter["high_95"]
    ground = Surface("bench", tip_force=0.034, shear_strength=20.0)
    for gait, interval in walks:
        truth = predict(Robot(modulus=2e6), GAITS[gait], ground, friction=Friction(tension=1.0))
        told = truth.locomotion.per_cycle / 0.13
        assert interval["low_over_L"] < told < interval["high_over_L"]
    assert (tmp_path / "page.html").stat().st_size > 10_000


@pytest.mark.parametrize(
    ("text", "pixel", "words"),
    [
        (None, "0.25mm", "no such file"),
        ("", "0.25mm", "is empty"),
        ("frame,left [px],middle [px]\n", "0.25mm", "has no number to fit"),
        ("frame,middle [px]\n0,1\n", "0.25mm", "column 'middle' is unknown"),
        ("frame,left [px],right [px]\n0,0,a\n", "0.25mm", "must be a number, got 'a'"),
        ("frame,left [px],right [px]\n0,0,520\n9,5,520\n3,5,520\n", "0.25mm", "not go back"),
        ("frame,left [px],right [px]\n0,520,0\n", "0.25mm", "wrong order"),
        ("frame,left [px],right [px]\n0,0,520\n", "2.5mm", "look at the unit"),
        ("frame,left [px],right [px]\n0,0,520\n", "wide", "--pixel must be"),
        ("frame,left [px],right [px]\n0,0,520\n", "0.25mm", "data must be more than"),
    ],
)
def test_a_film_that_is_none_ends_in_one_line(tmp_path, capsys, text, pixel, words):
    markers = tmp_path / "markers.csv"
    if text is not None:
        markers.write_text(text)
    with pytest.raises(SystemExit) as end:
        example("from_a_video")(markers, pixel, tmp_path / "out")
    said = capsys.readouterr().err
    assert end.value.code == 2
    assert words in said
    assert said.count("\n") == 1
