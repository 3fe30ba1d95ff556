"""The figures: made from data they write, drawn again from it, and what their captions claim."""

from dataclasses import replace

import matplotlib.image
import numpy as np
import pytest
from walks import HEAVIER

from analytic import GAITS, SURFACES, Mode, Robot, predict
from analytic.scene import pneunet
from mjsim.files.command_line import cli
from studies.paper import amplitude, contact
from studies.paper.__main__ import FIGURES, main, make, page


def blank(picture):
    return matplotlib.image.imread(picture)[..., :3].std() < 0.05


def test_a_figure_is_made_from_data_and_drawn_again_from_it(tmp_path, capsys):
    assert main(["--figure", "figure6", "--out", str(tmp_path)]) == 0
    picture = tmp_path / "figure6.png"
    assert capsys.readouterr().out.strip() == str(picture)
    assert not blank(picture)
    before = matplotlib.image.imread(picture)
    picture.unlink()
    assert main(["--figure", "figure6", "--out", str(tmp_path), "--redraw"]) == 0
    assert np.array_equal(before, matplotlib.image.imread(picture))
    names = sorted(path.name for path in tmp_path.iterdir())
    assert names == ["figure6.nc", "figure6.png", "figures.md"]


@pytest.mark.slow
@pytest.mark.parametrize("name", ["figure4", "figure6"])  # the others take long
def test_every_figure_can_be_made(tmp_path, name):
    assert not blank(make(name, tmp_path))


def test_every_caption_says_what_agrees_with_the_paper_and_what_does_not():
    for name in FIGURES:
        text = page([name])
        assert f"({name}.png)" in text
        assert "Agrees with the paper" in text
        assert "Differs" in text


def test_modes_iii_and_iv_lie_below_the_ground_and_the_others_do_not():
    data = contact.make()
    depth = {str(m): float(data["modes"].sel(mode=m, axis="y").min()) for m in data["mode"].values}
    assert depth["iii"] < -1e-4
    assert depth["iv"] < -1e-4
    assert all(depth[m] > -1e-9 for m in ("i", "ii", "v", "vi"))
    assert set(contact._STATES) == set(Mode) - {Mode.TIP, Mode.FLAT, Mode.BOTH}


@pytest.mark.parametrize("gamma", [4.0, 8.1])
@pytest.mark.slow
def test_with_fine_increments_the_distance_has_no_peak_over_amplitude(gamma):
    shifts = []
    for pressure in np.linspace(25e3, 62e3, 12):
        robot = pneunet.with_load(Robot(), gamma)
        robot = replace(robot, peak_pressure=pressure)
        walk = predict(robot, GAITS["wave"], SURFACES["felt"])
        shifts.append(walk.locomotion.per_cycle / robot.length)
    assert (np.diff(shifts) > -0.0003).all()  # a plateau at most


def test_with_three_increments_a_ramp_it_falls_past_a_quarter_of_the_length():
    shifts, heights = [], []
    for pressure in np.linspace(40e3, 55e3, 31):
        robot = replace(HEAVIER, peak_pressure=pressure)
        states = GAITS["wave"].pressures(3) * pressure
        shapes = amplitude.solve_modes(robot, states)
        shifts.append(amplitude.coarse_displacement(shapes))
        heights.append(shapes.amplitude.max() / robot.length)
    top = int(np.argmin(np.diff(shifts)))
    assert np.diff(shifts)[top] < -0.02
    assert heights[top] == pytest.approx(0.27, abs=0.02)


@pytest.mark.parametrize(
    ("words", "named"),
    [(["--figure", "figure7"], "figure4, figure5, peak, figure6, regime"),
     (["--redraw", "--figure", "figure6"], "figure6.nc")],
)  # fmt: skip
def test_bad_input_gets_one_line_and_exit_2(tmp_path, capsys, words, named):
    with pytest.raises(SystemExit) as stop:
        main([*words, "--out", str(tmp_path / "out")])
    printed = capsys.readouterr()
    assert stop.value.code == cli.BAD_INPUT
    assert len(printed.err.strip().splitlines()) == 1
    assert named in printed.err
