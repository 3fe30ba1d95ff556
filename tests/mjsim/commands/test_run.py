"""The command's contract: output, exit codes, bad input."""

import json
import re
import subprocess
import sys
from pathlib import Path

import pytest

from analytic import SURFACES
from mjsim.commands import replay, run
from mjsim.files.command_line import cli
from mjsim.pictures import gl

pytestmark = pytest.mark.usefixtures("coarse")

CONTRACT = {
    "surface": str, "gait": str, "body": str, "friction": str, "cycles": int, "links": int,
    "timestep_s": float, "displacement_over_L": float, "direction": str,
    "displacement_m": float, "speed_m_per_s": float,
    "predicted_displacement_over_L": float, "predicted_direction": str, "amplitude_over_L": float,
    "sim_time_s": float, "wall_time_s": float, "realtime_factor": float, "status": str,
}  # fmt: skip


def call(*words, out):
    return run.main([*words, "--no-video", "--links", "6", "--out", str(out)])


def test_json_is_one_object_with_the_contract_s_keys(tmp_path, capsys):
    assert call("--surface", "gelatin", "--json", out=tmp_path) == 0
    said = capsys.readouterr()
    row = json.loads(said.out)
    assert said.err == ""
    assert {key: type(row[key]) for key in CONTRACT} == CONTRACT
    assert row["direction"] == row["predicted_direction"] == "backward"
    assert row["sim_time_s"] / row["wall_time_s"] == pytest.approx(row["realtime_factor"])
    assert row["provenance"]["numerics"]["links"] == 6
    assert re.fullmatch(r"gelatin-[0-9a-f]{8}\.nc", Path(row["trajectory"]).name)  # 6 links


def test_all_surfaces_come_in_one_object(tmp_path, capsys):
    assert call("--surface", "all", "--json", out=tmp_path) == 0
    rows = json.loads(capsys.readouterr().out)["runs"]
    assert [row["surface"] for row in rows] == list(SURFACES)


def test_the_table_names_direction_displacement_and_prediction(tmp_path, capsys):
    assert call("--reverse", "--cycles", "2", out=tmp_path) == 0
    head, line, files = capsys.readouterr().out.strip().splitlines()
    assert "elastica" in head
    assert line.split()[:2] == ["felt", "backward"]
    assert line.endswith("ok")
    assert re.fullmatch(r"felt-wave-reversed-[0-9a-f]{8}\.nc", Path(files).name)


BAD = [
    (["--surface", "ice"], "'ice'", "felt, polyethylene, gelatin"),
    (["--gait", "gallop"], "'gallop'", "wave, full-wave, pulse"),
    (["--pressure", "-3"], "-3", "positive"),
    (["--pressure", "1e9"], "1e+09", "below 128881 Pa"),
    (["--pressure", "nan"], "nan", "positive"),
    (["--links", "5"], "5", "6 to 384"),
    (["--links", "24.5"], "'24.5'", "whole number"),
    (["--timestep", "0"], "0.0", "positive"),
    (["--timestep", "nan"], "nan", "positive"),
    (["--timestep", "1"], "1.0", "at most 0.1 s"),
    (["--timestep", "soon"], "'soon'", "number"),
    (["--cycles", "0"], "0", "at least 1"),
    (["--cycles", "1.5"], "'1.5'", "whole number"),
    (["--robot.length", "-0.1"], "-0.1", "positive"),
    (["--robot.length", "long"], "'long'", "number"),
    (["--surface", "felt", "--surface.tip-force", "1"], "'felt'", "not both"),
    (["--surface.friction", "0.5"], "custom", "tip_force"),
    (["--robot.mass", "0.02", "--robot.weight-per-length", "1"], "1.0", "not both"),
    (["--gait.stages", "00,10"], "(0.0, 0.0)", "close"),
    (["--gait.stages", "0x,10"], "'0x,10'", "0 and 1"),
    (["--gait.ramp-time", "0.0004"], "0.0001 s", "ramp"),
    (["--slope", "90"], "90 degrees", "less steep"),
    (["--numerics.integrator", "euler"], "'euler'", "Euler"),
    (["--friction", "wet"], "'wet'", "constant"),
    (["--body", "snake"], "'snake'", "chain"),
    (["--flavour", "x"], "--flavour", "--help"),
    (["--cycles"], "--cycles", "--help"),
]


@pytest.mark.parametrize(("words", "named", "valid"), BAD, ids=[" ".join(b[0]) for b in BAD])
def test_bad_input_gets_one_line_and_exit_2(tmp_path, capsys, words, named, valid):
    with pytest.raises(SystemExit) as stop:
        run.main([*words, "--no-video", "--out", str(tmp_path / "out")])
    said = capsys.readouterr()
    assert stop.value.code == cli.BAD_INPUT
    assert said.out == ""
    assert len(said.err.strip().splitlines()) == 1
    assert named in said.err
    assert valid in said.err
    assert not list(tmp_path.rglob("*.*"))


def test_a_folder_that_cannot_be_written_is_named_before_any_work(tmp_path, capsys):
    (tmp_path / "file").write_text("")
    with pytest.raises(SystemExit) as stop:
        call(out=tmp_path / "file" / "videos")
    assert stop.value.code == cli.BAD_INPUT
    assert str(tmp_path / "file" / "videos") in capsys.readouterr().err


def test_a_toppled_robot_exits_3_and_leaves_its_states(tmp_path, capsys):
    assert call("--surface", "felt", "--pressure", "100000", "--json", out=tmp_path) == cli.FAILED
    said = capsys.readouterr()
    row = json.loads(said.out)
    assert row["status"] == "toppled"
    assert row["displacement_over_L"] is None
    assert "toppled at t =" in said.err
    (path,) = tmp_path.iterdir()
    assert path.name.endswith("-failed.nc")
    assert str(path) in said.err


def test_help_teaches(capsys):
    with pytest.raises(SystemExit) as stop:
        run.main(["--help"])
    assert stop.value.code == 0
    said = capsys.readouterr().out
    assert "undulator run --surface gelatin" in said
    assert "[Pa]" in said


def test_without_opengl_the_run_goes_on_without_video(tmp_path, capsys, monkeypatch):
    monkeypatch.setattr(gl, "find_backend", lambda: None)
    assert run.main(["--links", "6", "--out", str(tmp_path)]) == 0
    said = capsys.readouterr()
    assert "libegl1" in said.err
    assert [path.suffix for path in tmp_path.iterdir()] == [".nc"]


def test_a_backend_without_library_is_found_out_not_trusted(monkeypatch):
    monkeypatch.setattr(gl, "renders", lambda name: name == "osmesa")
    monkeypatch.setenv(gl.VARIABLE, "egl")
    monkeypatch.setattr(gl, "_chosen", {})
    assert gl.find_backend() == "osmesa"
    monkeypatch.setattr(gl, "renders", lambda name: False)
    assert gl.find_backend() is None


def test_a_file_that_is_no_trajectory_cannot_be_replayed(tmp_path, capsys, monkeypatch):
    monkeypatch.setattr(gl, "find_backend", lambda: "egl")
    other = tmp_path / "other.nc"
    other.write_text("nothing")
    with pytest.raises(SystemExit) as stop:
        replay.main([str(other)])
    assert stop.value.code == cli.BAD_INPUT
    assert len(capsys.readouterr().err.strip().splitlines()) == 1


def test_the_command_runs_as_a_module_from_anywhere(tmp_path):
    result = subprocess.run(
        [sys.executable, "-m", "mjsim.run", "--no-video", "--links", "6", "--json"],
        cwd=tmp_path, capture_output=True, text=True, check=True,
    )  # fmt: skip
    assert json.loads(result.stdout)["status"] == "ok"
    assert len(list((tmp_path / "videos").glob("felt-*.nc"))) == 1
    assert result.stderr == ""


@pytest.mark.parametrize(
    ("words", "doing"),
    [(["--tolerance", "0.02"], "gelatin, by "),
     (["--body", "auto", "--no-video"], "simulating gelatin ever finer")],
)  # fmt: skip
def test_long_work_that_shows_no_bar_says_once_what_it_does(
    tmp_path, capsys, monkeypatch, words, doing
):
    monkeypatch.setattr(cli, "_LONG", 0.01)
    run.main([*words, "--surface", "gelatin", "--contacts", "all", "--out", str(tmp_path)])
    (line,) = capsys.readouterr().err.splitlines()
    assert line.startswith(f"undulator run: {doing}")
    assert line.endswith("it goes on, and may take minutes")


def test_quick_work_says_nothing(tmp_path, capsys):
    run.main(["--body", "auto", "--no-video", "--out", str(tmp_path)])
    assert capsys.readouterr().err == ""
