"""Scene files, the command and MJCF of robots of limbs."""

import json
import tomllib
from dataclasses import fields, replace
from pathlib import Path

import mujoco
import numpy as np
import pytest
import xarray as xr

from analytic.scene.limbs import quadruped
from analytic.scene.pneunet import base_rigidity
from analytic.scene.quadruped_gaits import undulation
from analytic.scene.surface import SURFACES, Surface
from mjsim.commands import run
from mjsim.files.scene_tables.limb_tables import build_robot
from mjsim.files.scene_tables.tables import build, merged, read_tables
from mjsim.model.standalone.strips import standalone_spec, write
from mjsim.results import record
from mjsim.results.file_names import file_name
from mjsim.scene import Numerics, Scene, resolved
from mjsim.scene.numerics import OF_THE_PLANE

FILE = Path(__file__).resolve().parents[3] / "examples" / "quadruped.toml"
FAST = ["--timestep", "0.04", "--gait.ramp-time", "1", "--links", "2", "--no-video"]


@pytest.mark.parametrize("slope", [0.0, 1.0])
def test_on_a_slope_the_motion_aside_stands_in_the_table(slope):
    row = {
        "robot": "torso, front left", "predicted_by": "quasi-static", "slope_deg": slope,
        "aside_over_L": -0.01234, "predicted_aside_over_L": -0.0222, "turn_deg": 1.0,
        "prediction_flags": [], "prediction_notes": [], "prediction_undecided_over_L": None,
        "displacement_by_cycle_over_L": None, "status": "ok",
    }  # fmt: skip
    heads, cells = record.table([row]).splitlines()
    assert [word in heads for word in ("turn", "aside/L")] == [True, bool(slope)]
    assert ["-0.0123" in cells, "-0.0222" in cells] == [bool(slope)] * 2


def test_the_quadruped_written_out_limb_by_limb_is_the_named_one():
    table = tomllib.loads(FILE.read_text())["robot"]
    written, named = build_robot(table), quadruped()
    assert written.names == named.names
    for one, two in zip(written.limbs, named.limbs, strict=True):
        assert (one.on, one.at) == (two.on, two.at)
        for value in ("length", "width", "weight_per_length"):
            assert getattr(one.strip, value) == pytest.approx(getattr(two.strip, value), rel=2e-3)
        assert (one.angle, one.offset) == pytest.approx((two.angle, two.offset), abs=1e-4)


def test_a_scene_file_gives_gait_ground_and_numerics():
    tables = merged(read_tables(FILE), {"ground": {"surface": "gelatin"},
                                        "numerics": {"links": 4}})  # fmt: skip
    scene, numerics = build(tables)
    assert scene.ground == SURFACES["gelatin"]
    assert numerics.links == 4
    assert scene.gait.segments == 5


@pytest.mark.usefixtures("coarse")
def test_json_has_both_numbers_and_the_file_opens(tmp_path, capsys):
    words = ["--robot", "quadruped", "--surface", "felt", "--limbs.left", "0.8", *FAST]
    assert run.main([*words, "--out", str(tmp_path), "--json"]) == 0
    row = json.loads(capsys.readouterr().out)
    assert row["status"] == "ok"
    assert row["predicted_by"] == "quasi-static"
    assert abs(row["displacement_over_L"] - row["predicted_displacement_over_L"]) < 0.05
    data = xr.open_dataset(row["trajectory"])
    assert data.yaw.attrs["units"] == "rad"
    assert float(np.degrees(data.yaw[-1])) == pytest.approx(row["turn_deg"], abs=0.05)


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["--robot", "hexapod"], "robot must be one of strip, quadruped; got 'hexapod'"),
        (["--robot", "quadruped", "--limbs.left", "2"], "left must be a part in [0, 1]"),
        (
            ["--robot", "quadruped", "--numerics.tie-bound", "2"],
            "tie_bound does nothing for a robot in space",
        ),
        (["--robot", "quadruped", "--body", "rod"], "cable and rod are of one strip"),
        (["--robot", "quadruped", "--robot.length", "1"], "length is the quadruped's own"),
        (["--robot", "quadruped", "--robot.rigidity", "3e-4"], "rigidity is the quadruped's own"),
        (
            ["--robot", "quadruped", "--robot.rigidity-per-pressure", "1e-9"],
            "rigidity_per_pressure is the quadruped's own",
        ),
        (["--robot", "quadruped", "--links", "3"], "must be even, got 3"),
        (["--robot", "quadruped", "--gait", "gallop"], "must be one of wave"),
        (
            ["--robot", "quadruped", "--body", "chain", "--tolerance", "0.1"],
            "tolerance is for body auto",
        ),
        (["--limbs.left", "0.5"], "key 'left' is unknown"),
    ],
)
def test_bad_input_is_one_line_and_exit_code_2(words, message, tmp_path, capsys):
    with pytest.raises(SystemExit) as stop:
        run.main([*words, "--out", str(tmp_path)])
    assert stop.value.code == 2
    error = capsys.readouterr().err
    assert message in error
    assert error.count("\n") == 1
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize(
    ("line", "message"),
    [
        ("peak_pressure = 3e3", "limb 1: peak_pressure is the whole robot's, in [robot]"),
    ],
)
def test_keys_that_a_limb_has_no_say_in_are_refused(line, message, tmp_path, capsys):
    file = tmp_path / "scene.toml"
    file.write_text(FILE.read_text().replace('name = "torso"', f'name = "torso"\n{line}'))
    with pytest.raises(SystemExit) as stop:
        run.main(["--scene", str(file), "--out", str(tmp_path / "out")])
    assert stop.value.code == 2
    assert message in capsys.readouterr().err


def test_limbs_may_each_have_a_rigidity_of_their_own():
    table = tomllib.loads(FILE.read_text())["robot"]
    for number, limb in enumerate(table["limbs"], start=1):
        limb["rigidity"] = 1e-4 * number
    robot = build_robot(table)
    rigidities = [base_rigidity(limb.strip) for limb in robot.limbs]
    assert rigidities == pytest.approx([1e-4, 2e-4, 3e-4, 4e-4, 5e-4])


@pytest.mark.parametrize("key", ["mass", "weight_per_length", "length", "width"])
def test_what_each_limb_has_of_its_own_is_not_taken_and_dropped(key):
    table = tomllib.loads(FILE.read_text())["robot"]
    with pytest.raises(ValueError, match=f"{key} would do nothing, as each limb has its own"):
        build_robot({key: 3.0, **table})
    del table["limbs"][1]["mass"]
    if key == "mass":
        assert build_robot({key: 0.003, **table}).limbs[1].strip.weight == pytest.approx(
            0.003 * 9.81
        )


def test_a_walk_under_a_coefficient_of_ones_own_is_kept_whatever_fails_after_it(
    tmp_path, capsys, monkeypatch
):
    def broken(walk):
        raise ValueError(f"no reference of a walk that is {walk.status}")

    monkeypatch.setattr(record, "record", broken)
    words = ["--robot", "quadruped", "--surface.friction", "0.6", "--friction", "coulomb", *FAST]
    with pytest.raises(SystemExit) as stop:
        run.main([*words, "--out", str(tmp_path)])
    assert stop.value.code == 2
    assert "no reference of a walk that is ok" in capsys.readouterr().err
    (path,) = tmp_path.iterdir()
    data = xr.open_dataset(path)
    assert float(data.time[-1]) == pytest.approx(5.0)
    assert abs(float(data.x[-1, 0, 0])) > 1e-3


def test_grounds_of_one_name_and_other_numbers_have_files_of_their_own():
    scenes = [Scene(quadruped(), ground=Surface("mine", shear_strength=t)) for t in (10.0, 20.0)]
    assert len({file_name(scene, resolved(scene)) for scene in scenes}) == 2
    usual = Scene(quadruped(), ground=SURFACES["gelatin"])
    assert file_name(usual, resolved(usual)) == "limbs-gelatin"


def walk_alone(surface):
    model = standalone_spec(Scene(quadruped(), ground=SURFACES[surface])).compile()
    data = mujoco.MjData(model)
    gait = replace(undulation("wave"), ramp_time=2.0)
    time = np.arange(-0.5, gait.period, model.opt.timestep)
    for row in quadruped().peak_pressure * gait.fractions(time):
        data.ctrl[:] = row
        mujoco.mj_step(model, data)
    return float(data.qpos[0])


def test_mjcf_with_a_slider_a_limb_walks_backward_on_gelatin_by_itself():
    assert walk_alone("gelatin") < -0.001


def test_it_stands_on_its_legs_in_the_viewer_file_and_mujoco_reads_it(tmp_path):
    write(Scene(quadruped()), tmp_path / "felt.xml")
    model = mujoco.MjModel.from_xml_path(str(tmp_path / "felt.xml"))
    assert [model.actuator(i).name for i in range(model.nu)] == list(quadruped().names)
    assert model.nskin == 5


def test_every_number_of_the_numerics_in_space_can_be_written_in_a_file(tmp_path):
    numerics = resolved(Scene(quadruped()))
    names = [item.name for item in fields(Numerics) if item.name not in OF_THE_PLANE]
    values = [f"{name} = {json.dumps(getattr(numerics, name))}" for name in names]
    path = tmp_path / "scene.toml"
    path.write_text("\n".join(['[robot]\nname = "quadruped"', "[numerics]", *values]))
    scene, written = build(read_tables(path))
    assert resolved(scene, written) == numerics
