"""The command fit: data in, a scene with intervals out."""

import json
import tomllib

import numpy as np
import pytest
from matplotlib.image import imread

from mjsim.commands import fit
from mjsim.files.scene_tables.tables import build

HEAD = "surface,robot.peak_pressure [kPa],displacement [mm],height [mm]\n"


@pytest.fixture
def runs(tmp_path):
    """Rows of five runs, computed with a modulus of 2 MPa."""
    lines = []
    from mjsim.fitting.walks import by_mujoco
    from mjsim.scene import Numerics, Scene

    for pressure in (30e3, 35e3, 40e3, 45e3, 50e3):
        scene, _ = build({"robot": {"modulus": 2e6, "peak_pressure": pressure},
                          "ground": {"surface": "gelatin"}})  # fmt: skip
        assert isinstance(scene, Scene)
        motion = by_mujoco(scene, Numerics(links=12, timestep=0.02), (0.0, 1.0))
        lines.append(f"gelatin,{pressure / 1e3},{1e3 * motion.displacement},{1e3 * motion.height}")
    path = tmp_path / "runs.csv"
    path.write_text(HEAD + "\n".join(lines) + "\n")
    return path


@pytest.mark.slow
def test_runs_give_back_the_modulus_they_were_made_with_and_a_scene_that_walks(
    runs, tmp_path, capsys
):
    out = tmp_path / "fitted"
    code = fit.main([str(runs), "--free", "robot.modulus", "--links", "12", "--timestep", "0.02",
                     "--out", str(out), "--json"])  # fmt: skip
    record = json.loads(capsys.readouterr().out)
    assert code == 0
    (one,) = record["parameters"]
    assert one["value"] == pytest.approx(2e6, rel=1e-3)
    assert one["low_95"] <= one["value"] <= one["high_95"]
    scene, numerics = build(tomllib.loads((out / "fit.toml").read_text()))
    assert scene.robot.modulus == pytest.approx(one["value"])
    assert numerics.links == 12
    assert imread(out / "fit.png").std() > 0.05


def test_what_the_data_leave_open_is_said_and_the_exit_code_is_3(tmp_path, capsys):
    pressure = np.linspace(5, 50, 12)
    rows = "\n".join(f"{p},{2.4e-4 * p * 1e3 * 0.05 * 57.3},50" for p in pressure)
    path = tmp_path / "bend.csv"
    path.write_text(f"pressure [kPa],angle [deg],length [mm]\n{rows}\n")
    code = fit.main([str(path), "--free", "robot.modulus,robot.thickness", "--out", str(tmp_path)])
    printed = capsys.readouterr().out
    assert code == 3
    assert "the data do not determine robot.modulus robot.thickness^-0.33" in printed


def test_a_law_that_misses_the_data_withholds_intervals_with_exit_code_3(tmp_path, capsys):
    pressure = np.linspace(1, 50, 40)
    path = tmp_path / "soft_start.csv"
    rows = "".join(f"{p},{0.02 * p**2}\n" for p in pressure)
    path.write_text("pressure [kPa],angle [deg]\n" + rows)
    code = fit.main([str(path), "--free", "robot.modulus", "--out", str(tmp_path), "--json"])
    record = json.loads(capsys.readouterr().out)
    assert code == 3
    (one,) = record["parameters"]
    assert (one["interval"], one["low_95"], one["high_95"]) == ("withheld", None, None)
    assert "the model misses something" in record["notes"][0]


def test_the_log_of_a_bench_gives_its_zero_and_a_scene_that_may_not_walk(tmp_path, capsys):
    """Nine degrees a kPa from 2 kPa on: the default gait's 48 kPa would close the strip."""
    path = tmp_path / "log.csv"
    rows = "".join(f"{p / 10},{p},{9 * (p - 2)},21\n" for p in range(2, 23))
    path.write_text("time [s],pressure [kPa],angle [deg],room [degC]\n" + rows)
    code = fit.main([str(path), "--free", "robot.modulus", "--zero", "pressure", "--out",
                     str(tmp_path)])  # fmt: skip
    printed = capsys.readouterr().out
    assert code == 0
    assert "2.793e+05" in printed
    assert "zero of pressure in log.csv: 2 kPa" in printed
    assert "columns that are not read: room [degC]" in printed
    assert "the fitted scene does not walk as it is: peak_pressure must be below" in printed
    tables = tomllib.loads((tmp_path / "fit.toml").read_text())
    assert tables["robot"]["modulus"] == pytest.approx(2.793e5, rel=1e-3)


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ([], "data must be one CSV file at least"),
        (["nowhere.csv", "--free", "robot.modulus"], "'nowhere.csv' cannot be read"),
        (["RUNS"], "free must name fields"),
        (["RUNS", "--free", "robot.modulus", "--surface", "all"], "surface must be one"),
        (["RUNS", "--free", "robot.modulus", "--bounds", "robot.modulus=3..4"], "its bounds"),
        (["RUNS", "--free", "robot.modulus", "--model", "guess"], "--model"),
        (["RUNS", "--free", "robot.modulus", "--zero", "angle"], "zero is of files of pressure"),
    ],
)
def test_bad_input_is_one_line_and_exit_code_2(runs, tmp_path, capsys, arguments, words):
    arguments = [str(runs) if word == "RUNS" else word for word in arguments]
    with pytest.raises(SystemExit) as stop:
        fit.main([*arguments, "--out", str(tmp_path / "out")])
    printed = capsys.readouterr()
    assert stop.value.code == 2
    assert printed.out == ""
    assert len(printed.err.splitlines()) == 1
    assert words in printed.err
