"""A session goes where a recorded walk goes, by its gait, by hand, and on other ground."""

import numpy as np
import pytest
from walks import walk

from analytic import SURFACES
from analytic.scene.surface import Surface
from mjsim.commands import view
from mjsim.pictures.live.session import Session
from mjsim.results.status import Status
from mjsim.scene import Numerics, Scene

NUMERICS = Numerics(links=12, timestep=0.02)


def session(surface="gelatin"):
    return Session(Scene(ground=SURFACES[surface]), NUMERICS)


def test_a_played_cycle_goes_as_far_as_a_recorded_one():
    played = session()
    played.advance(played.scene.gait.period)
    recorded = walk("gelatin", links=12, timestep=0.02)
    x = recorded.line[:, 0, 0]
    gone = (x[-1] - x[recorded.start]) / recorded.scene.robot.length
    assert played.displacement == pytest.approx(gone, abs=1e-4)
    assert played.seen.status is Status.OK


def test_the_gait_goes_on_over_and_over():
    played = session()
    period = played.scene.gait.period
    distances = []
    for _ in range(3):
        played.advance(period)
        distances.append(played.displacement)
    assert np.diff(distances) == pytest.approx(distances[0], rel=0.05)


def test_uneven_frames_add_up_to_whole_steps():
    played = session()
    for _ in range(60):
        played.advance(1 / 60)
    assert played.seen.time == pytest.approx(1.0, abs=1.01 * NUMERICS.timestep)


def test_by_hand_the_gait_stops_and_pressures_are_held():
    played = session()
    peak = played.scene.robot.peak_pressure
    played.command([peak, 0.0, 0.0])
    played.advance(2.0)
    assert not played.playing
    assert played.clock == 0.0
    assert played.seen.pressure == pytest.approx([peak, 0.0, 0.0])
    height = played.simulation.nodes()[:, 2].max()
    assert height > 0.02 * played.scene.robot.length


def test_a_restart_and_other_ground_begin_from_rest():
    played = session()
    played.advance(4.0)
    played.restart()
    assert played.displacement == 0.0
    assert played.playing
    played.move_to(SURFACES["felt"])
    played.advance(played.scene.gait.period)
    assert played.displacement > 0.02
    assert dict(played.words())["ground"] == "felt"


def test_a_session_keeps_no_history():
    played = session()
    played.advance(5.0)
    assert len(played.simulation.trajectory().time) == 1
    assert played.seen.time == pytest.approx(5.0)


def test_a_fall_is_told():
    played = Session(Scene(ground=Surface("steep", tip_force=0.034, shear_strength=0.0)), NUMERICS)
    played.command(np.full(3, 40 * played.scene.robot.peak_pressure))
    played.advance(3.0)
    assert played.seen.status is not Status.OK


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["--speed", "0"], "speed must be a positive number, got 0"),
        (["--seconds", "nan"], "seconds must be a positive number, got nan"),
        (["--surface", "all"], "surface must be one"),
        (["--surface", "mud"], "mud"),
    ],
)
def test_bad_input_is_one_line(words, said, capsys):
    with pytest.raises(SystemExit) as stop:
        view.main(words)
    printed = capsys.readouterr().err
    assert stop.value.code == 2
    assert said in printed
    assert len(printed.strip().splitlines()) == 1


def test_without_a_screen_one_line_says_so(monkeypatch, capsys):
    monkeypatch.delenv("DISPLAY", raising=False)
    monkeypatch.delenv("WAYLAND_DISPLAY", raising=False)
    assert view.main([]) == 3
    assert "xvfb-run" in capsys.readouterr().err
