"""Tracks of a hub give back the numbers that they were made with, and the gaits."""

import numpy as np
import pytest
from scipy.io import savemat

from mjsim import build, read_tables
from zoo import from_tracks
from zoo.terresoro_iv import hub, model, scenes, tracks

TRUE = model.Lagged(8.0, 5.0, 0.8, 0.6, -0.3, 0.8, 0.2)
_MOVES = 9  # pictures in which a transition is done


def tour(random):
    """Numbers of states on a way through each transition once, with states renamed, 241."""
    return random.permutation(16)[[int(state, 2) for state in scenes.tour()]]


def bits(states):
    return np.array([[state >> shift & 1 for shift in (3, 2, 1, 0)] for state in states])


def film(path, motions, begin):
    """Write a track whose transitions begin at a picture and every 13.5 from it on."""
    frames = int(begin + tracks.FRAMES * (len(motions) + 4))
    place, heading = np.zeros((frames, 2)), np.zeros(frames)
    at, turn = np.zeros(2), 0.0
    for number, (*shift, angle) in enumerate(motions):
        first = round(begin + tracks.FRAMES * number)
        part = np.clip((np.arange(frames - first)) / _MOVES, 0, 1)
        step = hub.turned(np.array(shift), turn)
        place[first:] = at + part[:, None] * step
        heading[first:] = turn + part * np.radians(angle)
        at, turn = at + step, turn + np.radians(angle)
    table = np.zeros((frames, 48))
    c, s = np.cos(heading), np.sin(heading)
    rotation = np.zeros((frames, 3, 3))
    rotation[:, 0, 0], rotation[:, 1, 0], rotation[:, 0, 1], rotation[:, 1, 1] = c, s, -s, c
    rotation[:, 2, 2] = 1.0
    angles = np.pi / 4 * np.arange(8)  # of markers around the hub's middle
    table[0, :24] = np.column_stack([np.cos(angles), np.sin(angles), np.zeros(8)]).ravel()
    table[:, 36:45] = rotation.transpose(0, 2, 1).reshape(frames, 9)
    table[:, 45:47] = place / tracks.ORANGE.pixel
    savemat(path, {"all_pt": table})


@pytest.mark.slow
def test_tracks_give_back_the_numbers_and_the_gaits_that_made_them(tmp_path, capsys, monkeypatch):
    random = np.random.default_rng(4)
    orders = [tour(random) for _ in tracks.ORANGE.first]
    savemat(tmp_path / "state_order_2.mat", {"state_order_2": np.array(orders) + 1})
    for number, order in zip(tracks.ORANGE.first, orders, strict=True):
        states = bits(order)
        past = np.array([states[np.maximum(np.arange(k - 8, k + 1), 0)] for k in range(240)])
        film(tmp_path / f"Euler {number}.mat", model.motions(TRUE, past, states[1:]),
             tracks.ORANGE.first[number] + tracks.FRAMES - 1.5)  # fmt: skip
    for gait in hub.gaits():
        first, count = tracks.GAITS[gait.name]
        motions = np.tile(model.motions(TRUE, *model.steady(gait.states)), (tracks.CYCLES + 1, 1))
        later = tracks.FRAMES * (1 + tracks.AGAIN.get(gait.name, 0))
        film(tmp_path / f"Gait {gait.name}.mat", motions[: count * tracks.CYCLES + 1],
             first + later - 1.5)  # fmt: skip
    values, covariance = from_tracks.fitted(tmp_path)
    monkeypatch.setattr(from_tracks, "fitted", lambda _: (values, covariance))
    told = from_tracks.main(tmp_path, tmp_path / "out")
    assert values == pytest.approx(np.array(TRUE), rel=0.02)
    assert np.sqrt(np.diag(covariance)).max() < 0.1
    for row in from_tracks.beside(tmp_path, values, covariance):
        assert row.predicted == pytest.approx(row.measured, rel=0.02, abs=0.02)
    assert [name for name, _ in told][::2] == [f"gait {name}, distance" for name in "ABCDE"]
    assert "part of a curl that lacks" in capsys.readouterr().out
    page = (tmp_path / "out" / "page.html").read_text("utf-8")
    assert build(read_tables(tmp_path / "out" / "gait_A.toml"))[0].in_space
    assert page.count("<tr>") == 7 + 10 + 6 + 3  # and heads
    assert "http" not in page.split("base64")[0]


def test_a_folder_without_the_tracks_ends_in_one_line(tmp_path, capsys):
    with pytest.raises(SystemExit) as end:
        from_tracks.main(tmp_path, tmp_path / "out")
    assert end.value.code == 2
    said = capsys.readouterr().err
    assert "has no track 'state_order_2.mat'" in said
    assert said.count("\n") == 1
