"""`undulator fit --free robot.actuator`: curves, hysteresis and zeros of a robot's actuators."""

import json
import tomllib

import numpy as np
import pytest

from mjsim import build, read_tables
from mjsim.commands import fit


def log(path, scale=1.0, zero=0.0, count=40, heads="time [s],pressure [kPa],angle [deg]"):
    p = np.concatenate([np.linspace(0, 50, count), np.linspace(50, 0, count)])
    state, acting = 0.0, []
    for each in p:
        state = min(max(state, each - 8), each)
        acting.append(0.7 * each + 0.3 * state)
    angle = scale * (1.4 * np.array(acting) - 0.006 * np.array(acting) ** 2)
    angle += np.random.default_rng(0).normal(0, 0.2, len(p)) + zero
    np.savetxt(path, np.stack([np.arange(len(p)), p, angle], axis=1), "%.3f", ",", header=heads,
               comments="")  # fmt: skip
    return str(path)


def test_a_bench_gives_curve_hysteresis_and_zero_and_what_the_affine_law_misses(tmp_path, capsys):
    file = log(tmp_path / "bench.csv", zero=3.0)
    words = [file, "--free", "robot.actuator", "--zero", "angle", "--out", str(tmp_path)]
    assert fit.main([*words, "--json"]) == 0
    (actuator,) = json.loads(capsys.readouterr().out)["actuators"]
    numbers = {number["name"]: number for number in actuator["numbers"]}
    true = {"slope at rest": np.radians(1.4e-3), "play 1": 8e3, "share 1": 0.3,
            "zero of bench.csv": np.radians(3.0)}  # fmt: skip
    for name, value in true.items():
        assert numbers[name]["low_95"] <= value <= numbers[name]["high_95"]
    assert actuator["rms"] == pytest.approx(np.radians(0.2), rel=0.2)
    assert actuator["affine_largest"] > 5 * actuator["rms"]
    scene, _ = build(read_tables(tmp_path / "fit.toml"))
    (curve, *_) = scene.robot.actuators
    length = scene.robot.length / 3
    turned = np.degrees(float(curve.curvature_at(40e3)) * length)
    assert turned == pytest.approx(1.4 * 40 - 0.006 * 40**2, abs=0.3)
    assert (tmp_path / "fit.png").stat().st_size > 10_000


def test_files_of_one_robot_differ_by_so_much_or_are_one_per_chamber(tmp_path, capsys):
    files = [log(tmp_path / f"{name}.csv", scale, count=20) for name, scale in
             (("left", 1.0), ("middle", 1.1), ("right", 0.9))]  # fmt: skip
    words = [*files, "--free", "robot.actuator", "--out", str(tmp_path)]
    assert fit.main(words) == 0
    printed = capsys.readouterr().out
    assert "they bend left.csv 1, middle.csv 1.1, right.csv 0.9 times" in printed
    assert "the affine law misses" in printed
    assert fit.main([*words, "--by-chamber"]) == 0
    tables = tomllib.loads((tmp_path / "fit.toml").read_text())
    tops = [curve["curvature"][-1] for curve in tables["robot"]["actuator"]]
    assert np.array(tops) / tops[0] == pytest.approx([1, 1.1, 0.9], abs=0.02)


def test_a_bench_that_stops_below_the_peak_sets_the_peak(tmp_path, capsys):
    path = tmp_path / "low.csv"
    path.write_text("p [kPa],curvature [1/m]\n0,0\n10,3\n20,8\n30,15\n")
    assert fit.main([str(path), "--free", "robot.actuator", "--out", str(tmp_path)]) == 0
    assert "peak_pressure is set to 30 kPa" in capsys.readouterr().out
    assert build(read_tables(tmp_path / "fit.toml"))[0].robot.peak_pressure == 30e3


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["--free", "robot.actuator,robot.modulus"], "robot.actuator must be fitted alone"),
        (["--free", "robot.modulus", "--by-chamber"], "--by-chamber is for free robot.actuator"),
        (["--free", "robot.actuator", "--by-chamber"], "--by-chamber is for one file per segment"),
        (["--free", "robot.actuator", "--prior", "robot.modulus=2"], "--prior is for fields that"),
        (["--free", "robot.actuator", "--robot", "quadruped"], "angle needs a column length [mm]"),
    ],
)
def test_what_cannot_be_fitted_is_refused_in_one_line(tmp_path, capsys, words, message):
    file = log(tmp_path / "bench.csv")
    with pytest.raises(SystemExit) as stop:
        fit.main([file, *words, "--out", str(tmp_path)])
    assert stop.value.code == 2
    assert message in capsys.readouterr().err
