"""Robots of limbs on ground that rises, by MuJoCo."""

import math

import pytest

from analytic.scene.limbs import quadruped
from analytic.scene.quadruped_gaits import undulation
from mjsim.commands import export
from mjsim.commands.run import main
from mjsim.results.measures import measure
from mjsim.results.prediction import reference
from mjsim.scene import Scene
from mjsim.simulation.simulation import simulate


def climbing(degrees, uphill):
    return Scene(
        quadruped(), undulation("wave"), "polyethylene",
        slope=math.radians(degrees), uphill=math.radians(uphill),
    )  # fmt: skip


@pytest.mark.slow
@pytest.mark.parametrize("uphill", [0.0, 180.0])
def test_on_a_slope_it_goes_as_far_as_by_its_reference(uphill):
    scene = climbing(1.0, uphill)
    level = reference(climbing(0.0, 0.0)).displacement[0]
    ahead = reference(scene).displacement[0]
    assert abs(ahead - level) > 0.008
    assert measure(simulate(scene)).displacement == pytest.approx(ahead, abs=0.003)


@pytest.mark.slow
def test_where_no_bound_holds_its_weight_it_slid_and_says_so(tmp_path, capsys):
    options = ["--robot", "quadruped", "--surface", "polyethylene", "--slope", "6",
               "--gait.ramp-time", "0.5"]  # fmt: skip
    assert main([*options, "--no-video", "--out", str(tmp_path)]) == 0
    assert "slid" in capsys.readouterr().out
    assert simulate(climbing(6.0, 90.0)).status == "slid"


@pytest.mark.parametrize(
    ("options", "words"),
    [
        (["--uphill", "30"], "uphill must be an angle, and 0 for a strip"),
        (["--robot", "quadruped", "--slope", "95"], "slope must be less steep than 90 degrees"),
    ],
)
def test_slopes_that_mean_nothing_are_refused(options, words, capsys):
    with pytest.raises(SystemExit) as stop:
        main([*options, "--no-video"])
    assert stop.value.code == 2
    assert words in capsys.readouterr().err


def test_a_file_on_a_slope_names_it_and_tells_no_distance(tmp_path, capsys):
    options = ["--robot", "quadruped", "--slope", "25deg", "--uphill", "90deg"]
    assert export.main([*options, "--out", str(tmp_path)]) == 0
    (path,) = tmp_path.glob("*.xml")
    words = "rises by 25 degrees towards 90 degrees from +x; not measured"
    assert words in path.read_text()
    assert words in capsys.readouterr().err


def test_environments_pay_for_no_slide():
    pytest.importorskip("gymnasium")
    from mjsim.env.gym import WalkEnv

    with pytest.raises(ValueError, match="slope of an environment must be 0, got 5 degrees"):
        WalkEnv(base={"robot": {"name": "quadruped"}, "ground": {"slope_deg": 5.0}})
