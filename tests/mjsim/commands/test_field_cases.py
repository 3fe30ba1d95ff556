"""Inputs that failed in the field: each stands for a kind of fault."""

import json
import os
import re
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from walks import HEAVIER, refusal

from analytic import GAITS, SURFACES, Friction, Gait, Robot, Surface, predict
from analytic.solvers.elastica.cantilever import solve_cantilever
from mjsim.commands import replay, run
from mjsim.files import files
from mjsim.files.command_line import cli
from mjsim.results.judge import slid
from mjsim.results.measures import measure, slid_over_length
from mjsim.results.provenance import provenance
from mjsim.results.record import reference
from mjsim.results.status import Status
from mjsim.scene import Numerics, Scene
from mjsim.simulation.batch import Refused, rollout, simulate_all
from mjsim.simulation.simulation import simulate


def call(words, capsys, code=0):
    assert run.main([*map(str, words), "--no-video"]) == code
    return capsys.readouterr()


def row_of(words, tmp_path, capsys, code=0):
    said = call([*words, "--json", "--out", tmp_path], capsys, code).out

    def no_constant(name):
        raise AssertionError(f"{name} is no JSON")

    return json.loads(said, parse_constant=no_constant)


def test_a_rollout_is_judged_by_all_its_states_and_not_the_last():
    scenes = [
        Scene(replace(HEAVIER, peak_pressure=p), ground=SURFACES["gelatin"], friction="coulomb",
              actuation="actuators")
        for p in np.linspace(74e3, 88e3, 6)
    ]  # fmt: skip
    for scene, walk in zip(scenes, rollout(scenes), strict=True):
        assert walk.status == simulate(scene).status == Status.TOPPLED
        assert walk.time[-1] < scene.gait.period


@pytest.mark.slow
def test_the_prediction_of_chambers_that_lag_is_per_cycle(tmp_path, capsys):
    words = ["--lag", "0.2", "--links", "12"]
    one = row_of([*words, "--cycles", "1"], tmp_path, capsys)
    three = row_of([*words, "--cycles", "3"], tmp_path, capsys)
    for key in ("predicted_displacement_over_L", "displacement_over_L"):
        assert three[key] == pytest.approx(one[key], abs=0.001)


@pytest.mark.parametrize("words", [["--pressure", "60000"], ["--segments", "1,2,3"]])
@pytest.mark.slow
def test_what_auto_picked_is_not_called_a_robot_that_fell(tmp_path, capsys, words):
    row = row_of(["--body", "auto", *words], tmp_path, capsys)
    assert row["status"] == "ok"
    assert row["error_over_L"] == pytest.approx(0, abs=0.004)
    assert any("auto" in note for note in row["prediction_notes"])


def test_a_gait_that_starts_inflated_goes_as_far_in_its_first_cycle_as_later():
    stages = ((1, 1, 1), (0, 1, 1), (0, 0, 1), (1, 1, 1))
    scene = Scene(gait=Gait("inflated", stages, 4.0), ground=SURFACES["gelatin"], cycles=3)
    walk = simulate(scene)
    assert walk.status is Status.OK
    ends = [int(np.searchsorted(walk.time, t)) for t in (0.0, 12.0, 24.0)]
    x = np.append(walk.line[ends, 0, 0], walk.line[-1, 0, 0])
    cycles = np.diff(x) / scene.robot.length
    # later ones begin with the tension that the one before left in the strip
    assert cycles[1] == pytest.approx(cycles[2], abs=1e-6)
    assert cycles[0] == pytest.approx(cycles[1], abs=2.5e-3)
    theory = predict(
        scene.robot, scene.gait, scene.ground, friction=Friction(tension=1.0), cycles=2
    )
    assert cycles[1] == pytest.approx(theory.locomotion.per_cycle / scene.robot.length, abs=2e-4)


def test_a_strip_that_is_not_at_rest_when_it_begins_has_no_distance(monkeypatch):
    """Hardly any time to settle after a fast rise."""
    monkeypatch.setattr("mjsim.scene.scene._GENTLE", 0.05)
    stages = ((1, 1, 0), (0, 1, 1), (1, 1, 0))
    scene = Scene(gait=Gait("thrown", stages, 0.05), settle_time=0.005)
    walk = simulate(scene, Numerics(timestep=0.005))
    assert walk.status is Status.UNSETTLED
    assert measure(walk) is None


def test_ramps_of_fewer_steps_than_can_be_seen_are_refused(tmp_path, capsys):
    words = ["--gait.ramp-time", "0.002", "--timestep", "0.005", "--no-video"]
    said = refusal([*words, "--out", str(tmp_path)], capsys)
    assert "0.0005 s" in said
    assert "got 0.005 s" in said


@pytest.mark.slow
def test_a_robot_described_by_six_segments_walks_as_by_three(tmp_path, capsys):
    doubled = ",".join("".join(2 * f for f in stage) for stage in
                       ("000", "100", "110", "011", "001", "000"))  # fmt: skip
    words = ["--surface", "polyethylene", "--links", "24"]
    three = row_of(words, tmp_path, capsys)
    six = row_of([*words, "--segments", "1,1,1,1,1,1", "--gait.stages", doubled], tmp_path, capsys)
    assert six["predicted_displacement_over_L"] == pytest.approx(
        three["predicted_displacement_over_L"],
        abs=1e-8,  # so far changes of contacts are located
    )
    # where sticking ends is a matter of rounding
    assert six["displacement_over_L"] == pytest.approx(three["displacement_over_L"], abs=1e-4)


@pytest.mark.slow
def test_what_is_no_number_is_null_in_strict_json(tmp_path, capsys):
    words = ["--surface", "gelatin", "--friction", "coulomb", "--pressure", "100000"]
    row = row_of(words, tmp_path, capsys, code=cli.FAILED)
    assert row["predicted_displacement_over_L"] is None
    assert row["prediction_undecided_over_L"] is None


@pytest.mark.slow
def test_different_scenes_have_different_files_and_the_same_scene_its_own(tmp_path, capsys):
    for pressure in (20000, 35000, 48000, 20000):
        call(["--pressure", pressure, "--out", tmp_path], capsys)
    assert len(list(tmp_path.iterdir())) == 3
    call(["--surface", "gelatin", "--out", tmp_path], capsys)
    assert (tmp_path / "gelatin.nc").is_file()


@pytest.mark.slow
def test_the_same_run_twice_at_once_leaves_one_whole_file(tmp_path):
    words = [sys.executable, "-m", "mjsim.run", "--no-video", "--links", "6", "--out",
             str(tmp_path)]  # fmt: skip
    runs = [subprocess.Popen(words, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
            for _ in range(3)]  # fmt: skip
    assert [process.wait() for process in runs] == [0, 0, 0]
    for process in runs:
        process.stdout.close()
        process.stderr.close()
    (path,) = tmp_path.iterdir()
    from mjsim.results.trajectory import load

    assert load(path).status is Status.OK


def test_a_full_disk_is_one_clear_line(tmp_path, capsys, monkeypatch):
    def full(path, content):
        raise OSError(28, "No space left on device", str(path))

    monkeypatch.setattr(Path, "write_bytes", full)
    assert "No space left" in refusal(["--no-video", "--out", str(tmp_path)], capsys)
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("out", ["x" * 300, "nul\0", "felt.nc/below"])
def test_a_folder_that_cannot_be_is_one_clear_line(tmp_path, capsys, out):
    (tmp_path / "felt.nc").write_text("")
    assert "out must be a folder" in refusal(["--no-video", "--out", f"{tmp_path}/{out}"], capsys)


def test_a_folder_in_the_place_of_the_file_is_one_clear_line(tmp_path, capsys):
    (tmp_path / "felt.nc").mkdir()
    assert "felt.nc" in refusal(["--no-video", "--out", str(tmp_path)], capsys)
    assert [path.name for path in tmp_path.iterdir()] == ["felt.nc"]


@pytest.mark.parametrize(
    "name", ["a/b", "", "x" * 300, "nul\0"], ids=["slash", "empty", "long", "nul"]
)
def test_names_that_no_file_can_have_are_refused(name):
    with pytest.raises(ValueError, match="name of a gait"):
        replace(GAITS["wave"], name=name)


@pytest.mark.parametrize(
    "environment",
    [{"MUJOCO_GL": "osmesa"}, {"MUJOCO_GL": "nonsense"}, {"PYOPENGL_PLATFORM": "osmesa"},
     {"PYTHONIOENCODING": "latin-1"}, {"PYTHONIOENCODING": "ascii"}],
    ids=str,
)  # fmt: skip
@pytest.mark.slow
def test_it_runs_whatever_the_environment_says(tmp_path, environment):
    words = [sys.executable, "-m", "mjsim.run", "--no-video", "--links", "6", "--out",
             str(tmp_path)]  # fmt: skip
    done = subprocess.run(words, env={**os.environ, **environment}, capture_output=True, check=True)
    assert b"felt" in done.stdout
    assert done.stderr == b""


def test_python_is_as_guarded_as_the_command_line():
    with pytest.raises(ValueError, match=r"cycles must be a whole number of at least 1, got 1\.5"):
        Scene(cycles=1.5)
    with pytest.raises(ValueError, match="cycles"):
        Scene(cycles=True)
    assert Numerics(links=np.int64(12)).links == 12
    assert Scene(cycles=np.int64(2)).cycles == 2
    assert Robot(length=np.float64(0.09)).length == 0.09
    small = Robot(length=np.float32(0.125), segments=np.ones(3, np.float32))
    scene = Scene(small, cycles=np.int64(2), ground=Surface("any", np.float32(0.5)))
    assert json.loads(json.dumps(provenance(scene, Numerics(timestep=np.float32(0.004)))))


@pytest.mark.parametrize("number", [5, 15, 30, 43])
@pytest.mark.slow
def test_the_prediction_is_bent_by_the_scene_s_own_friction_however_strong(number):
    """On polyethylene, where it turns the robot round: weak friction would say 0.000 L."""
    slow = replace(GAITS["wave"], ramp_time=8.0)
    ground = SURFACES["polyethylene"].scaled(number / 1.496)
    walk = simulate(Scene(gait=slow, ground=ground))
    exact = float(reference(walk).displacement[0])
    assert measure(walk).displacement == pytest.approx(exact, rel=0.02, abs=0.0015)


@pytest.mark.slow
def test_where_friction_lets_go_at_once_the_prediction_says_so(tmp_path, capsys):
    tip = 10 * 3.84e-4 / 0.13**2
    row = row_of(["--surface.tip-force", tip, "--gait.ramp-time", "8"], tmp_path, capsys)
    assert "JUMPED" in row["prediction_flags"]
    assert row["error_over_L"] == pytest.approx(0, abs=0.003)


@pytest.mark.usefixtures("coarse")
def test_a_strip_that_slides_down_says_how_far_and_why(tmp_path, capsys):
    row = row_of(["--slope", "1"], tmp_path, capsys)
    assert row["status"] == "slid"
    assert row["displacement_over_L"] is None
    assert row["slid_over_L"] > 0.02
    said = call(["--slope", "1", "--out", tmp_path], capsys).out
    assert "L downhill: its weight exceeds every friction bound" in said


def test_on_a_film_alone_it_slides_at_the_speed_of_the_film_for_as_long_as_its_cycles_last():
    robot, film = Robot(), Surface("film", viscosity=100.0)
    still = Gait("still", ((0.0,) * 3, (1e-6, 0.0, 0.0), (0.0,) * 3), 5.0)
    scene = Scene(robot, still, film, slope=np.deg2rad(5.0))
    speed = robot.weight_per_length * np.sin(scene.slope) / (film.viscosity * robot.width)
    distance = speed * still.period / robot.length
    assert slid_over_length(simulate(scene)) == pytest.approx(distance, rel=1e-3)


def test_under_coulomb_too_steep_a_slope_is_a_slide(tmp_path, capsys):
    walk = simulate(Scene(friction="coulomb", slope=np.deg2rad(25.0), ground=SURFACES["felt"]))
    assert walk.status is Status.SLID
    assert slid(walk) > 0.1
    assert slid_over_length(walk) is None  # its first cycle never began


def test_a_heavy_cantilever_is_followed_to_a_load_of_200():
    """Against the boundary value problem theta'' = load (1 - s) cos(theta)."""
    from scipy.integrate import simpson, solve_bvp

    from analytic.scene import pneunet

    s, state = np.linspace(0, 1, 801), np.zeros((2, 801))
    for load in np.geomspace(1, 200, 30):
        solution = solve_bvp(
            lambda s, u, load=load: np.array([u[1], -load * (1 - s) * np.cos(u[0])]),
            lambda a, b: np.array([a[0], b[1]]), s, state, tol=1e-8, max_nodes=100_000,
        )  # fmt: skip
        state = solution.sol(s)
    fine = np.linspace(0, 1, 20_001)
    exact = simpson(np.cos(solution.sol(fine)[0]), x=fine)
    robot = pneunet.with_load(Robot(), 200.0)
    x, _ = solve_cantilever(robot, np.zeros(3), links=240)
    assert x[-1] / robot.length == pytest.approx(float(exact), abs=2e-3)


@pytest.mark.slow
def test_one_bad_scene_of_many_is_a_row_with_its_message():
    scenes = [Scene(), Scene(body="rod", chamber="sealed"), Scene(ground=SURFACES["gelatin"])]
    one, two, three = simulate_all(scenes, Numerics(links=6))
    assert one.status == three.status == Status.OK
    assert isinstance(two, Refused)
    assert "for body chain" in two.message


@pytest.mark.slow
def test_without_a_main_guard_it_says_so_in_one_line(tmp_path):
    script = tmp_path / "script.py"
    script.write_text(
        "from mjsim import Scene, simulate_all\n"
        "try:\n    print(simulate_all([Scene()]))\n"
        "except RuntimeError as error:\n    print('said:', error)\n"
    )
    done = subprocess.run([sys.executable, str(script)], capture_output=True, text=True)
    assert "__main__" in done.stdout
    assert "Traceback" not in done.stdout


@pytest.mark.usefixtures("coarse")
def test_a_byte_order_mark_is_no_trouble(tmp_path, capsys):
    scene = tmp_path / "scene.toml"
    scene.write_bytes(b'\xef\xbb\xbf[ground]\nsurface = "gelatin"\n')
    assert row_of(["--scene", scene], tmp_path, capsys)["surface"] == "gelatin"


@pytest.mark.parametrize(
    ("words", "named"),
    [(["--robot.modulus", "1.8"], "modulus"), (["--slope", "90"], "90 degrees"),
     (["--timestep", "1e-9"], "steps"), (["--robot.length", "6.5"], "length"),],
)  # fmt: skip
def test_a_slip_of_the_unit_is_named_in_the_user_s_terms(tmp_path, capsys, words, named):
    assert named in refusal([*words, "--no-video", "--out", str(tmp_path)], capsys)


def test_a_robot_too_small_for_its_links_is_told_so_and_walks_with_fewer(tmp_path, capsys):
    """6.5 mm long, everything else to scale."""
    part = 0.05
    scale = {"length": 0.13, "width": 0.04, "thickness": 4e-3, "chamber-height": 3.928e-3,
             "weight-per-length": 1.416}  # fmt: skip
    words = [word for name, value in scale.items() for word in (f"--robot.{name}", value * part)]
    words += ["--surface.tip-force", 0.034 * part**2, "--out", tmp_path, "--no-video"]
    assert "take fewer links" in refusal([str(word) for word in words], capsys)


def test_a_file_with_an_unknown_field_is_refused_in_one_line(tmp_path, capsys, monkeypatch):
    walk = simulate(Scene(), Numerics(links=6))
    origin = provenance(walk.scene, walk.numerics)
    origin["numerics"]["warp"] = 9
    walk.save(tmp_path / "later.nc", origin)
    monkeypatch.setattr(replay.gl, "find_backend", lambda: "egl")
    with pytest.raises(SystemExit) as stop:
        replay.main([str(tmp_path / "later.nc")])
    assert stop.value.code == cli.BAD_INPUT
    assert "warp" in capsys.readouterr().err


def test_part_files_of_two_writers_never_meet(tmp_path):
    with files.whole(tmp_path / "a.txt") as one, files.whole(tmp_path / "a.txt") as two:
        assert one != two
        one.write_text("1")
        two.write_text("2")
    assert [path.name for path in tmp_path.iterdir()] == ["a.txt"]


STAGES = ",".join("".join("1" if (j - k) % 4 in (0, 1) else "0" for j in range(8))
                  for k in range(9))  # fmt: skip
LONG = ["--segments", ",".join("1" * 8), "--robot.length", "0.34667", "--pressure", "28958",
        "--gait.stages", STAGES, "--links", "48"]  # fmt: skip


@pytest.mark.slow
@pytest.mark.usefixtures("coarse")
def test_a_long_robot_whose_friction_is_at_its_ends_alone_is_told_of_the_ground_between(
    tmp_path, capsys
):
    row = row_of([*LONG, "--contacts", "ends"], tmp_path, capsys)
    (note,) = row["prediction_notes"]
    assert "friction acts at the two ends alone" in note
    assert not row_of([], tmp_path, capsys)["prediction_notes"]


@pytest.mark.slow
def test_and_else_it_acts_wherever_it_touches_in_both_models(tmp_path, capsys):
    row = row_of(LONG, tmp_path, capsys)
    gaps, links = row["prediction_notes"]
    assert "gaps of less than 1 um between the ends decide" in gaps
    assert row["unexplained_over_L"] == pytest.approx(0, abs=0.001)
    finer = re.fullmatch(r"links: (.*) L at 96 links", links)
    assert float(finer[1]) == pytest.approx(row["predicted_displacement_over_L"], abs=0.001)


@pytest.mark.slow
def test_patches_of_one_surface_are_that_surface_for_each_of_two_cycles(tmp_path, capsys):
    path = tmp_path / "scene.toml"
    path.write_text('[[ground.patches]]\nsurface = "felt"\n'
                    '[[ground.patches]]\nfrom = 0.1\nsurface = "felt"')  # fmt: skip
    one = row_of([], tmp_path, capsys)["predicted_displacement_over_L"]
    two = row_of(["--scene", path, "--cycles", "2"], tmp_path, capsys)
    assert two["predicted_displacement_over_L"] == pytest.approx(one, abs=1e-4)
