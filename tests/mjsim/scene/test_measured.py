"""Pressures from a sensor: what was recorded walks as what was commanded."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from analytic import GAITS, Gait
from analytic.scene.robot import PSI
from mjsim.commands.run import main
from mjsim.files.gaits.measured import Series, as_gait, read_series
from mjsim.files.scene_tables.tables import build, merged
from mjsim.results.record import record
from mjsim.scene import Numerics
from mjsim.simulation.simulation import simulate

PEAK = 7 * PSI


def recorded(gait, samples, noise, seed=0, until=1.0):
    """Samples at uneven times, with white noise [Pa]."""
    rng = np.random.default_rng(seed)
    end = until * gait.period
    time = np.sort(np.append([0.0, end], rng.uniform(0, end, samples - 2)))
    pressure = PEAK * gait.fractions(np.minimum(time, gait.period * (1 - 1e-12)))
    return Series(time, pressure + rng.normal(0, noise, pressure.shape))


def written(path, series, unit="kPa", size=1e3, mark=","):
    heads = mark.join(["time [s]", *(f"p{i} [{unit}]" for i in range(series.pressure.shape[1]))])
    rows = (mark.join(f"{v:.6f}" for v in [t, *(p / size)])
            for t, p in zip(series.time, series.pressure, strict=True))  # fmt: skip
    path.write_text("\n".join([heads, *rows]))
    return path


@pytest.mark.parametrize("ground", ["felt", "gelatin"])
@pytest.mark.slow
def test_a_noisy_record_of_a_gait_walks_as_the_gait(tmp_path, ground):
    path = written(tmp_path / "walk.csv", recorded(GAITS["wave"], 200, 300.0))
    scene, _ = build({"gait": {"file": str(path)}, "ground": {"surface": ground}})
    plain, _ = build({"ground": {"surface": ground}})
    row, expected = (record(simulate(s, Numerics(links=12, timestep=0.02))) for s in (scene, plain))
    for name in ("displacement_over_L", "predicted_displacement_over_L"):
        assert row[name] == pytest.approx(expected[name], abs=5e-4)


def test_bars_between_cells_or_around_them_are_read_as_commas_are(tmp_path):
    rows = [(0, "0", "0", "0"), (2, "20.5", "0", "0"), (4, "0", "20", "0"), (6, "0", "0", "0")]
    table = [("time [s]", "p1 [kPa]", "p2 [kPa]", "p3 [kPa]"), *rows]
    lines = {
        "commas": [",".join(map(str, row)) for row in table],
        "bars": ["|".join(map(str, row)) for row in table],
        "framed": [f"| {' | '.join(map(str, row))} |" for row in table],
    }
    lines["framed"].insert(1, "|---|:--:|---|---:|")
    read = {}
    for name, text in lines.items():
        (tmp_path / name).write_text("\n".join(text))
        read[name] = read_series(tmp_path / name, ("left", "middle", "right"))
    for name in ("bars", "framed"):
        assert np.array_equal(read[name].time, [0, 2, 4, 6])
        assert np.array_equal(read[name].pressure, read["commas"].pressure)
    assert read["bars"].pressure[1, 0] == 20_500


@pytest.mark.parametrize("samples", [200, 2_000, 20_000])
def test_ramps_grow_with_what_changes_and_not_with_the_samples(samples):
    gait, _ = as_gait("it", recorded(GAITS["wave"], samples, 300.0))
    assert 5 <= gait.ramps <= 12
    states, _ = gait.path(50)
    assert len(states) < 1.3 * 5 * 50


@settings(max_examples=30, deadline=None)
@given(st.lists(st.tuples(*[st.sampled_from([0.0, 0.25, 0.6, 1.0])] * 3), min_size=2, max_size=7),
       st.integers(0, 99))  # fmt: skip
def test_ramps_stay_within_the_noise_of_what_was_recorded(stages, seed):
    if not np.any(stages):
        return
    truth = Gait("it", tuple(stages), 1.0, repeats=False)
    noise = 200.0
    gait, highest = as_gait("it", recorded(truth, 150 * truth.ramps, noise, seed))
    time = np.linspace(0, truth.period, 400)
    off = highest * gait.fractions(time) - PEAK * truth.fractions(time)
    assert np.abs(off).max() < max(8 * noise, 0.02 * PEAK)
    assert np.sqrt(np.mean(off**2)) < 2 * noise


def test_without_noise_the_corners_are_the_stages():
    gait = GAITS["wave"]
    time = np.linspace(0, 10, 101)
    recorded, highest = as_gait(
        "it", Series(time, PEAK * gait.fractions(np.minimum(time, 9.999999)))
    )
    assert highest == pytest.approx(PEAK, rel=1e-6)
    assert recorded.ramp_times == pytest.approx(gait.ramp_times, rel=1e-3)
    assert np.array(recorded.stages) == pytest.approx(np.array(gait.stages), abs=1e-5)


@pytest.mark.parametrize(
    ("unit", "size", "mark"),
    [("Pa", 1.0, ","), ("kPa", 1e3, "\t"), ("psi", PSI, ";"), ("bar", 1e5, ",")],
)
def test_units_of_pressure_are_told_by_the_heads(tmp_path, unit, size, mark):
    series = recorded(GAITS["pulse"], 50, 0.0)
    read = read_series(written(tmp_path / "p.csv", series, unit, size, mark))
    assert read.time == pytest.approx(series.time, abs=1e-5)
    assert read.pressure == pytest.approx(series.pressure, abs=1.0)


def test_columns_that_name_chambers_may_be_in_any_order_and_others_are_refused(tmp_path):
    path = tmp_path / "p.csv"
    path.write_text("time [s],right [Pa],left [Pa],middle [Pa]\n0,3,1,2\n1,6,4,5\n")
    read = read_series(path, ("left", "middle", "right"))
    assert read.pressure.tolist() == [[1, 2, 3], [4, 5, 6]]
    path.write_text("time [s],right [Pa],left [Pa],centre [Pa]\n0,3,1,2\n1,6,4,5\n")
    with pytest.raises(ValueError, match="columns must be left, middle, right; got right, left, c"):
        read_series(path, ("left", "middle", "right"))


def test_decimal_commas_comments_and_time_in_ms_are_read(tmp_path):
    path = tmp_path / "p.csv"
    path.write_bytes(b"\xef\xbb\xbf# a sensor\r\nt_ms;p1_kPa\r\n1000;0,5\r\n\r\n1500;1,5\r\n")
    read = read_series(path)
    assert read.time.tolist() == [0.0, 0.5]
    assert read.pressure.ravel().tolist() == [500.0, 1500.0]


@pytest.mark.parametrize(
    ("text", "pressures"),
    [
        ("time [s]  p1 [kPa]  p2 [kPa]\n 0   1   2\n 1   3   4\n", (1e3, 2e3)),
        ("t_s p1_kPa p2_kPa\n0 0,5 2\n1 3 4\n", (500, 2e3)),
        ("Time in s   p1 in kPa   p2 in kPa\n0 1 2\n1 3 4\n", (1e3, 2e3)),
        ('"Time (s)" "left (kPa)" "right (kPa)"\n0 1 2\n1 3 4\n', (1e3, 2e3)),
        ("t p1 p2\ns kPa Pa\n0 1 2\n1 3 4\n", (1e3, 2)),
        ("# by numpy.savetxt\n# t_s p1_kPa p2_kPa\n0 1 2\n1 3 4\n", (1e3, 2e3)),
        ("# t [s], p1 [kPa], p2 [kPa]\n0,1,2\n1,3,4\n", (1e3, 2e3)),
        ("t_s,p1_kPa,p2_kPa\n0,1,2,\n1,3,4,\n", (1e3, 2e3)),
    ],
)
def test_cells_may_be_separated_by_blanks_and_heads_be_a_comment(tmp_path, text, pressures):
    path = tmp_path / "p.txt"
    path.write_text(text)
    read = read_series(path)
    assert read.time.tolist() == [0, 1]
    assert read.pressure[0] == pytest.approx(pressures)


@pytest.mark.parametrize(("begins", "until"), [(0.0, 0.62), (1.4, 1.0), (2.9, 0.8)])
def test_records_that_start_inflated_or_do_not_close_agree_with_theory(tmp_path, begins, until):
    gait = GAITS["wave"]
    time = np.linspace(begins, until * gait.period - 1e-9, 150)
    series = Series(time - begins, PEAK * gait.fractions(time))
    path = written(tmp_path / "part.csv", series)
    scene, numerics = build({"gait": {"file": str(path)}, "ground": {"surface": "gelatin"}})
    row = record(simulate(scene, numerics))
    assert row["status"] == "ok"
    assert row["error_over_L"] == pytest.approx(0, abs=8e-4)


@pytest.mark.parametrize(
    ("text", "named"),
    [
        ("", "empty"),
        ("time [s]", "one per segment"),
        ("time [s],p1\n0,1\n1,2", "'p1'"),
        ("time,p1 [kPa]\n0,1\n1,2", "'time'"),
        ("time [s],p1 [mm]\n0,1\n1,2", "'p1 [mm]'"),
        ("time [s],p1 [kPa]\n0,1", "two samples"),
        ("time [s],p1 [kPa]\n0,1\n0,2", "line 3"),
        ("time [s],p1 [kPa]\n0,1\n1,x", "'x'"),
        ("time [s],p1 [kPa]\n0,1\n1,nan", "'nan'"),
        ("time [s],p1 [kPa]\n0,1\n1,2,3", "line 3"),
        ("time [s],p1 [kPa]\n0,0\n1,0\n2,0", "noise"),
        ('time [s],p1 [kPa]\n0,"1\n1,2', "line 2: a quotation mark"),
        ("# a log of today\n0 1\n1 2", "first line of names"),
        ("t_s p1_kPa\n0 1\n1 2 3", "line 3: needs 2 numbers, got 3"),
        ("time [s],p1 [kPa]\n0,0\n1,1\n2,0", "1 chambers"),
    ],
)
def test_a_bad_record_gets_one_line(tmp_path, capsys, text, named):
    path = tmp_path / "bad.csv"
    path.write_text(text)
    with pytest.raises(SystemExit) as stop:
        main(["--gait", str(path), "--no-video", "--out", str(tmp_path / "out")])
    said = capsys.readouterr().err
    assert stop.value.code == 2
    assert named in said
    assert said.count("\n") == 1


def test_a_record_is_walked_once(tmp_path, capsys):
    path = written(tmp_path / "p.csv", recorded(GAITS["wave"], 100, 0.0, until=0.5))
    with pytest.raises(SystemExit):
        main(["--gait", str(path), "--cycles", "2", "--no-video", "--out", str(tmp_path)])
    assert "does not repeat" in capsys.readouterr().err


def test_a_peak_beside_a_record_is_the_robot_s_and_never_scales_it(tmp_path):
    path = tmp_path / "log.csv"
    rows = ["t [s],a [kPa],b [kPa],c [kPa]", "0,0,0,0", "2,20,0,0", "4,20,20,0", "6,0,0,0"]
    path.write_text("\n".join(rows))
    tables = {"gait": {"file": str(path)}}
    alone, _ = build(merged(tables))
    beside, _ = build(merged(tables, {"robot": {"peak_pressure": "40 kPa"}}))
    assert alone.robot.peak_pressure == pytest.approx(20e3)
    assert beside.robot.peak_pressure == pytest.approx(40e3)
    for scene in (alone, beside):
        at = scene.robot.peak_pressure * scene.gait.fractions(np.array([1.0, 4.0]))
        assert at == pytest.approx(np.array([[10e3, 0, 0], [20e3, 20e3, 0]]), abs=150)
    with pytest.raises(ValueError, match="at least the highest measured pressure, 20000 Pa"):
        build(merged(tables, {"robot": {"peak_pressure": "3 kPa"}}))
