"""Ground that changes along x, in MuJoCo beside the theory, from files, and in pictures."""

import json
from dataclasses import replace

import numpy as np
import pytest
from conftest import BACKEND
from walks import refusal

from analytic import GAITS, SURFACES, Patches, predict
from mjsim.commands import run
from mjsim.files.scene_tables.tables import build, read_tables
from mjsim.results.provenance import provenance
from mjsim.results.trajectory import load
from mjsim.scene import Scene
from mjsim.simulation.simulation import simulate

FELT, GELATIN = SURFACES["felt"], SURFACES["gelatin"]
SLOW = replace(GAITS["wave"], ramp_time=4.0)
GROUNDS = {
    "from felt onto gelatin": Patches("felt-gelatin", (0.15,), (FELT, GELATIN)),
    "standing on both": Patches("gelatin-felt", (0.10,), (GELATIN, FELT)),
    "three": Patches("three", (0.05, 0.18), (FELT, SURFACES["polyethylene"], GELATIN)),
}
TOML = """
[[ground.patches]]
surface = "felt"
[[ground.patches]]
from = 0.137
tip_force = 0.034
"""


@pytest.mark.parametrize("name", list(GROUNDS))
@pytest.mark.slow
def test_where_it_goes_and_stalls_is_the_theory_s_within_2_percent_of_the_length(name):
    scene = Scene(gait=SLOW, ground=GROUNDS[name], cycles=8)
    walk = simulate(scene)
    ends = np.searchsorted(walk.time, scene.gait.period * np.arange(1, 9) - 1e-9)
    x = walk.line[np.minimum(ends, len(walk.time) - 1), 0, 0] / scene.robot.length
    theory = predict(scene.robot, SLOW, scene.ground, cycles=8)
    rests = np.flatnonzero((theory.pressures == 0).all(axis=1))[1:]
    assert x == pytest.approx(theory.locomotion.left[rests] / scene.robot.length, abs=0.02)


def test_under_coulomb_friction_pads_have_the_coefficient_of_their_place():
    """All felt but under the right end: that end holds as a tip on gelatin does."""
    scene = Scene(gait=SLOW, ground=Patches("strip", (0.12,), (FELT, GELATIN)), friction="coulomb")
    walk, felt = simulate(scene), simulate(replace(scene, ground=FELT))
    assert walk.status == felt.status == "ok"
    assert abs(walk.line[-1, 0, 0] - felt.line[-1, 0, 0]) > 0.01 * scene.robot.length


def test_patches_are_read_from_a_file_and_come_back_from_a_saved_walk(tmp_path):
    path = tmp_path / "scene.toml"
    path.write_text(TOML)
    scene, _ = build(read_tables(path))
    assert scene.ground.borders == (0.137,)
    assert scene.ground.at(0.0) == FELT
    assert scene.ground.at(0.2).tip_force == 0.034
    walk = simulate(scene)
    walk.save(tmp_path / "walk.nc", provenance(walk.scene, walk.numerics))
    assert load(tmp_path / "walk.nc").scene == scene


@pytest.mark.parametrize(
    ("text", "named"),
    [('[ground]\nsurface = "felt"\n[[ground.patches]]\nsurface = "felt"\n', "not both"),
     (TOML.replace("from = 0.137\n", ""), "from"), (TOML.replace("0.137", "'far'"), "far"),
     (TOML.replace("tip_force", "tip"), "'tip'"), ('[ground]\npatches = 3\n', "3")],
)  # fmt: skip
def test_bad_patches_get_one_line(tmp_path, capsys, text, named):
    path = tmp_path / "scene.toml"
    path.write_text(text)
    said = refusal(["--scene", str(path), "--no-video", "--out", str(tmp_path / "out")], capsys)
    assert named in said


@pytest.mark.slow
def test_the_command_walks_over_patches(tmp_path, capsys):
    path = tmp_path / "scene.toml"
    path.write_text(TOML)
    words = ["--scene", str(path), "--cycles", "3", "--links", "12", "--json", "--no-video"]
    assert run.main([*words, "--out", str(tmp_path)]) == 0
    row = json.loads(capsys.readouterr().out)
    assert row["surface"] == "felt-custom"
    assert row["error_over_L"] == pytest.approx(0, abs=0.002)


@pytest.mark.skipif(BACKEND is None, reason="no OpenGL backend on this machine")
def test_each_patch_is_drawn_where_it_is():
    from mjsim.pictures.render import Camera

    walk = simulate(Scene(ground=Patches("both", (0.065,), (FELT, GELATIN)), settle_time=0.01))
    with Camera(walk, 640, 360) as camera:
        frame = camera.frame(0).astype(int)
    below = frame[270:290]  # before the ruler
    left, right = below[:, :200].mean(axis=(0, 1)), below[:, -200:].mean(axis=(0, 1))
    assert left[1] > left[0]  # green felt
    assert right[0] > right[1] + 30  # amber gelatin
