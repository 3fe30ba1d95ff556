import numpy as np
import pytest

from analytic.scene import pneunet
from mjsim import Robot, Scene, as_tables, as_toml, build, measure, read_tables, simulate
from mjsim.files.scene_tables.actuator_files import make_robot
from mjsim.results.prediction import reference
from mjsim.results.provenance import configuration, provenance
from mjsim.scene.numerics import Numerics

POINTS = "pressure [kPa], angle [deg]\n0, 0\n10, 4\n20, 11\n30, 21\n40, 34\n50, 50\n"


def curve(folder, text=POINTS, name="curve.csv"):
    path = folder / name
    path.write_text(text)
    return str(path)


def test_points_are_the_curve_of_a_free_segment(tmp_path):
    robot = make_robot({"actuator": curve(tmp_path), "segments": (2.0, 1.0, 1.0)})
    turned = pneunet.natural_curvature(robot, [20e3, 50e3]) * 0.5 * robot.length
    np.testing.assert_allclose(np.degrees(turned), [11, 50])
    with_length = POINTS.replace("\n", ", 25\n").replace("[deg], 25", "[deg], length [mm]")
    robot = make_robot({"actuator": curve(tmp_path, with_length)})
    assert pneunet.natural_curvature(robot, 50e3) == pytest.approx(np.radians(50) / 0.025)
    by_curvature = "p [kPa], curvature [1/m], rigidity [N m^2]\n0,0,4e-4\n60,12,5e-4\n"
    robot = make_robot({"actuator": curve(tmp_path, by_curvature)})
    assert pneunet.natural_curvature(robot, 30e3) == pytest.approx(6.0)
    assert pneunet.rigidity(robot, 30e3) == pytest.approx(4.5e-4)


def test_gaps_absolute_pressures_and_points_of_a_fall_are_read(tmp_path):
    rows = "100, 50\n90, 34\n80, 21\n,\n70, 11\n60,\n60, 4\n50, 0\n"
    file = curve(tmp_path, "pressure [kPa abs], angle [deg]\n" + rows)
    robot, plain = (make_robot({"actuator": each}) for each in (file, curve(tmp_path, name="up")))
    at = np.linspace(0, 50e3, 40)
    np.testing.assert_allclose(*(pneunet.natural_curvature(r, at) for r in (robot, plain)))


def test_a_log_of_rising_and_falling_pressure_is_fitted(tmp_path):
    rng = np.random.default_rng(0)
    p = np.concatenate([np.linspace(0, 50, 80), np.linspace(50, 0, 80)])
    state, angle = 0.0, []
    for x in p:
        state = min(max(state, x - 10), x)
        angle.append(-(x - 0.4 * (x - state)) + rng.normal(0, 0.1))  # bends to the other side
    rows = "".join(f"{i},{x},{a}\n" for i, (x, a) in enumerate(zip(p, angle, strict=True)))
    robot = make_robot({"actuator": curve(tmp_path, "time [s],p [kPa],theta [deg]\n" + rows)})
    assert robot.actuator.play == pytest.approx((10e3,), rel=0.05)
    assert robot.actuator.share == pytest.approx((0.4,), rel=0.05)


def test_scenes_with_curves_are_written_and_read_whole(tmp_path):
    file = curve(tmp_path)
    tables = {"robot": {"actuator": [file, file, {"pressure": [0, "50 kPa"], "curvature": [0, 18],
                                                  "play": [4e3], "share": [0.2]}]}}  # fmt: skip
    scene, numerics = build(tables)
    path = tmp_path / "whole.toml"
    path.write_text(as_toml(as_tables(scene, numerics)))
    assert build(read_tables(path))[0] == scene
    import json

    stored = json.loads(json.dumps(provenance(scene, numerics)))
    assert configuration(stored)[0] == scene


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (POINTS.replace("50, 50", "49, 80\n48.9, 99"),
         r"must be a function of the pressure, but it is 80 deg at 49 kPa and 99 deg at 48\.9 kPa"),
        (POINTS.replace("0, 0", "0, 3"),
         "0 without pressure, got 3 deg: undulator fit .* --zero angle"),
        (POINTS.replace("angle [deg]", "force [N]"), "columns must be pressure and angle or"),
        (POINTS.replace("[kPa]", ""), "must name its unit"),
        ("pressure [kPa], angle [deg]\n50, 50\n", "needs 2 rows"),
    ],
)  # fmt: skip
def test_what_is_no_curve_is_refused_with_the_reason(tmp_path, text, message):
    file = curve(tmp_path, text)
    with pytest.raises(ValueError, match=f"actuator must be a curve, got '{file}': .*{message}"):
        make_robot({"actuator": file})


def test_pressures_beyond_the_measured_ones_are_refused(tmp_path):
    with pytest.raises(ValueError, match="peak_pressure must be at most 50000 Pa, up to which"):
        build({"robot": {"actuator": curve(tmp_path), "peak_pressure": "60 kPa"}})


def test_a_measured_robot_walks_alike_in_theory_and_in_mujoco(tmp_path):
    hysteresis = {"play": [4e3], "share": [0.3]}
    points = {"pressure": [0, 1e4, 2e4, 3e4, 4e4, 5e4], "curvature": [0, 3, 8, 14, 21, 28]}
    robot = make_robot({"actuator": points | hysteresis})
    scene = Scene(robot, ground="gelatin")
    theory = reference(scene).displacement[0]
    plain = reference(Scene(make_robot({"actuator": points}), ground="gelatin")).displacement[0]
    walk = simulate(scene, Numerics(timestep=0.01))
    assert walk.status == "ok"
    assert measure(walk).displacement == pytest.approx(theory, rel=0.02)
    assert abs(theory / plain - 1) > 0.05  # hysteresis counts
    assert Robot() != robot
