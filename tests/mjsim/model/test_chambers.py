"""Chambers follow their valves: by closed forms, and as they walk."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from analytic import SURFACES
from mjsim.commands.run import main
from mjsim.model.chambers import ChamberPressures
from mjsim.results.measures import measure
from mjsim.results.record import record
from mjsim.scene import Numerics, Scene, Valves
from mjsim.simulation.simulation import simulate

DT, PEAK = 0.01, 5e4
BASE = Scene(ground=SURFACES["gelatin"])
UNLIKE = Valves(fill_time=(0.1, 0.2, 0.3), vent_time=0.4, dead_time=0.1, flow_limit=8e4)


def follow(valves, commands):
    commands = np.asarray(commands, dtype=float)
    return ChamberPressures(valves, commands.shape[1], DT).follow(commands)


def test_filling_and_venting_are_exponentials_of_their_own():
    commands = np.concatenate([np.full((300, 2), PEAK), np.zeros((300, 2))])
    pressures = follow(Valves(fill_time=(0.1, 0.3), vent_time=(0.5, 0.2)), commands)
    time = DT * np.arange(1, 301)
    for segment, (fill, vent) in enumerate([(0.1, 0.5), (0.3, 0.2)]):
        assert pressures[:300, segment] == pytest.approx(
            PEAK * (1 - np.exp(-time / fill)), rel=1e-9
        )
        full = pressures[299, segment]
        assert pressures[300:, segment] == pytest.approx(full * np.exp(-time / vent), rel=1e-9)


def test_dead_time_only_delays():
    commands = np.random.default_rng(0).uniform(0, PEAK, (200, 2))
    late = follow(Valves(0.1, dead_time=(0.0, 0.25)), commands)
    prompt = follow(Valves(0.1), commands)
    assert np.array_equal(late[:, 0], prompt[:, 0])
    assert np.array_equal(late[25:, 1], prompt[:-25, 1])
    assert not late[:25, 1].any()


def test_a_flow_limit_makes_a_straight_ramp():
    pressures = follow(Valves(flow_limit=2e5), np.full((50, 1), PEAK))
    time = DT * np.arange(1, 51)
    assert pressures[:, 0] == pytest.approx(np.minimum(2e5 * time, PEAK), rel=1e-9)


@settings(max_examples=25, deadline=None)
@given(st.lists(st.integers(1, 60), min_size=1, max_size=6), st.integers(0, 9))
def test_what_follows_does_not_depend_on_how_commands_are_cut(cuts, seed):
    commands = np.random.default_rng(seed).uniform(0, PEAK, (sum(cuts), 3))
    whole, parts = ChamberPressures(UNLIKE, 3, DT), ChamberPressures(UNLIKE, 3, DT)
    pieces = np.split(commands, np.cumsum(cuts)[:-1])
    pressures = np.concatenate([parts.follow(piece) for piece in pieces])
    assert np.array_equal(pressures, whole.follow(commands))


@pytest.mark.slow
def test_valves_that_do_more_than_lag_agree_with_the_theory_along_their_pressures():
    row = record(simulate(replace(BASE, valves=UNLIKE)))
    assert row["status"] == "ok"
    assert row["error_over_L"] == pytest.approx(0, abs=6e-4)


@pytest.mark.parametrize("chamber", ["linearized", "constant-pressure"])
def test_actuators_take_pressures_of_any_valve(chamber):
    scene = replace(BASE, valves=UNLIKE, chamber=chamber)
    walks = [measure(simulate(replace(scene, actuation=a), Numerics(links=12)))
             for a in ("rest-angles", "actuators")]  # fmt: skip
    assert walks[0].displacement == pytest.approx(walks[1].displacement, abs=1e-6)


@pytest.mark.parametrize(
    ("words", "named"),
    [(["--valves.fill-time", "-1"], "-1"), (["--valves.vent-time", "1,2"], "vent-time"),
     (["--valves.flow-limit", "0"], "flow-limit"), (["--valves.dead-time", "3 kPa"], "'3 kPa'"),
     (["--valves.dead-time", "x"], "'x'")],
)  # fmt: skip
def test_bad_valves_get_one_line(tmp_path, capsys, words, named):
    with pytest.raises(SystemExit) as stop:
        main([*words, "--no-video", "--out", str(tmp_path)])
    assert stop.value.code == 2
    assert named in capsys.readouterr().err
