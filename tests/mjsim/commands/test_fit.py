"""The command fit: data in, a scene with intervals out."""

import json
import tomllib

import numpy as np
import pytest
from matplotlib.image import imread

from mjsim.commands import fit
from mjsim.files.tables import build

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
    found = json.loads(capsys.readouterr().out)
    assert code == 0
    (one,) = found["parameters"]
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


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ([], "data must be one CSV file at least"),
        (["nowhere.csv", "--free", "robot.modulus"], "'nowhere.csv' cannot be read"),
        (["RUNS"], "free must name fields"),
        (["RUNS", "--free", "robot.modulus", "--surface", "all"], "surface must be one"),
        (["RUNS", "--free", "robot.modulus", "--bounds", "robot.modulus=3..4"], "its bounds"),
        (["RUNS", "--free", "robot.modulus", "--model", "guess"], "--model"),
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
