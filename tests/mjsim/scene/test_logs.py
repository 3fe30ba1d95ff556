"""Logs as loggers write them: the walk of each is that of the gait which it recorded."""

import datetime
import logging
from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from analytic import GAITS, SURFACES, Gait
from analytic.scene.robot import PSI
from mjsim import measure, reference, simulate
from mjsim.commands.run import main
from mjsim.files.gaits.measured import Series, as_gait, read_series
from mjsim.files.gaits.mergers import merged
from mjsim.files.scene_tables.tables import build
from mjsim.scene import Numerics

PEAK = 7 * PSI
WAVE = GAITS["wave"]
HEADS = ("time [s]", "p1 [kPa]", "p2 [kPa]", "p3 [kPa]")
COARSE = Numerics(links=12, timestep=0.01)


def clean(time, gait=WAVE):
    """Pressures of the gait at times, of its end too [Pa]."""
    return PEAK * gait.fractions(np.minimum(time, gait.period * (1 - 1e-12)))


def noisy(pressure, size, seed=1):
    return pressure + np.random.default_rng(seed).normal(0, size * PEAK, pressure.shape)


def written(path, time, pressure, heads=HEADS, size=1e3, clock=1.0, mark=","):
    rows = (mark.join(f"{v:.7g}" for v in (t / clock, *(p / size)))
            for t, p in zip(time, pressure, strict=True))  # fmt: skip
    path.write_text("\n".join([mark.join(heads), *rows]))
    return path


def irregular():
    gaps = np.exp(np.random.default_rng(2).uniform(np.log(1.3e-4), np.log(0.157), 1_000))
    time = np.cumsum(gaps)
    return np.concatenate([[0.0], time[time < WAVE.period], [WAVE.period]])


def even(rate):
    return np.arange(0, WAVE.period + 0.5 / rate, 1 / rate)


def smooth_noise(time, size):
    """Noise of a sensor whose time constant is many samples."""
    white = np.random.default_rng(3).normal(0, 1, (len(time) + 200, 3))
    kernel = np.exp(-np.arange(100) / 20.0)
    kernel /= np.linalg.norm(kernel)
    shaped = [np.convolve(column, kernel, "same")[100:-100] for column in white.T]
    return size * PEAK * np.stack(shaped, axis=1)


def logs():
    """Kinds of logs: heads, times as written [s], pressures as written [Pa], sizes of the units."""
    usual = even(100)
    step, ticks = PEAK / 100, even(1000)
    repeated = usual.copy()
    repeated[1::7] = repeated[:-1:7][: len(repeated[1::7])]
    hum = 0.01 * PEAK * np.sin(2 * np.pi * 50 * ticks)[:, None]
    rounded = step * np.round(noisy(clean(even(500)), 0.002) / step)
    return {
        "100 Hz": (HEADS, usual, noisy(clean(usual), 0.01)),
        "1 kHz": (HEADS, ticks, noisy(clean(ticks), 0.01)),
        "5 kHz": (HEADS, even(5_000), noisy(clean(even(5_000)), 0.02)),
        "loud": (HEADS, ticks, noisy(clean(ticks), 0.05)),
        "blanks": (("t_s", "p1_kPa", "p2_kPa", "p3_kPa"), usual, noisy(clean(usual), 0.01), 1e3,
                   1.0, " "),
        "smoothed": (HEADS, even(2_000), clean(even(2_000)) + smooth_noise(even(2_000), 0.01)),
        "hum of the mains": (HEADS, ticks, noisy(clean(ticks), 0.002) + hum),
        "eight bits": (HEADS, even(500), rounded),
        "irregular": (HEADS, irregular(), noisy(clean(irregular()), 0.01)),
        "repeated times": (HEADS, repeated, noisy(clean(usual), 0.01)),
        "slow clock": (HEADS, np.floor(ticks / 0.05) * 0.05, noisy(clean(ticks), 0.01)),
        "psig, ms": (("Time (in ms)", "P1 psig", "P2 psig", "P3 psig"), usual,
                     noisy(clean(usual), 0.01), PSI, 1e-3),
        "kgf/cm2": (("t (s)", "p1 (kgf/cm2)", "p2 (kgf/cm2)", "p3 (kgf/cm2)"), usual,
                    noisy(clean(usual), 0.01), 98066.5),
        "psia": (("time [s]", "p1 [psia]", "p2 [psia]", "p3 [psia]"), usual,
                 noisy(clean(usual) + 99.2e3, 0.01), PSI),
        "absolute without a word": (HEADS, usual, noisy(clean(usual) + 101.3e3, 0.01)),
        "from right to left": (("time [s]", "p3 [kPa]", "p2 [kPa]", "p1 [kPa]"), usual,
                               noisy(clean(usual), 0.01)[:, ::-1]),
        "semicolons": (HEADS, usual, noisy(clean(usual), 0.01), 1e3, 1.0, ";"),
    }  # fmt: skip


@cache
def distance(ground):
    scene, _ = build({"ground": {"surface": ground}})
    return measure(simulate(scene, COARSE)).displacement


@pytest.mark.parametrize("kind", logs())
def test_a_log_walks_as_far_as_the_gait_that_it_recorded(tmp_path, kind):
    path = written(tmp_path / "log.csv", *logs()[kind][1:3], logs()[kind][0], *logs()[kind][3:])
    scene, _ = build({"gait": {"file": str(path)}, "numerics": {"timestep": 0.01}})
    times = np.linspace(0, WAVE.period, 500)
    off = scene.robot.peak_pressure * scene.gait.fractions(times) - clean(times)
    assert np.sqrt(np.mean(off**2)) < 0.006 * PEAK
    assert scene.gait.ramps <= 7
    assert measure(simulate(scene, COARSE)).displacement == pytest.approx(
        distance("felt"), abs=4e-4
    )


@pytest.mark.parametrize(("noise", "seed"), [(0.05, s) for s in range(8)] + [(0.1, 1), (0.1, 3)])
def test_corners_smaller_than_the_noise_of_a_sample_are_found(noise, seed):
    rng = np.random.default_rng(seed)
    stages = rng.choice([0.0, 0.1, 0.25, 0.5, 0.75, 1.0], (rng.integers(4, 9), 3))
    stages[0], stages[1, 0] = 0.0, 1.0
    ramps = rng.uniform(0.4, 2.5, len(stages) - 1)
    truth = Gait("it", tuple(map(tuple, stages.tolist())), tuple(ramps.tolist()), repeats=False)
    time = np.arange(0, truth.period, 0.01)
    gait, highest = as_gait("it", Series(time, noisy(clean(time, truth), noise, 100 + seed)))
    assert gait.ramps == truth.ramps
    along = np.linspace(0, gait.period, 1_000, endpoint=False)
    off = highest * gait.fractions(along) - clean(along, truth)
    # a corner's value is the mean of many samples
    assert np.abs(off).max() < 0.6 * noise * PEAK


def test_a_straight_ramp_has_no_corners_whatever_the_noise():
    for seed in range(5):
        time = even(100)
        pressure = PEAK * np.stack([time, 0 * time, time.max() - time], axis=1) / time.max()
        gait, _ = as_gait("it", Series(time, noisy(pressure, 0.05, seed)))
        assert gait.ramps == 1


@pytest.mark.slow
def test_a_log_of_30_khz_walks_as_far_as_the_gait(tmp_path):
    time = even(30_000)
    path = written(tmp_path / "log.csv", time, noisy(clean(time), 0.03))
    scene, _ = build({"gait": {"file": str(path)}})
    assert scene.gait.ramps == WAVE.ramps
    for ground in ("felt", "gelatin"):
        walk = simulate(replace(scene, ground=SURFACES[ground]), COARSE)
        assert measure(walk).displacement == pytest.approx(distance(ground), abs=4e-4)


def held(rate=None):
    """Stages that are held for 2 s each and entered within a sample, or as two rows at one time."""
    stages = np.array(WAVE.stages)
    if rate is None:
        time = np.repeat(2.0 * np.arange(len(stages) + 1), 2)[1:-1]
        return time, PEAK * np.repeat(stages, 2, axis=0)
    time = np.arange(0, 12, 1 / rate)
    return time, noisy(PEAK * stages[(time / 2).astype(int)], 0.005)


@pytest.mark.parametrize("rate", [None, 100, 1000])
def test_steps_become_ramps_that_are_followed_along_the_same_path(tmp_path, rate, caplog):
    path = written(tmp_path / "log.csv", *held(rate))
    scene, numerics = build({"gait": {"file": str(path)}, "ground": {"surface": "gelatin"}})
    assert min(scene.gait.ramp_times) >= 4 * 0.005
    plain, _ = build({"ground": {"surface": "gelatin"}})
    assert reference(scene, numerics).displacement[0] == pytest.approx(
        reference(plain, Numerics()).displacement[0], abs=2e-4
    )
    if rate != 100:  # whose steps of 10 ms are seen as such
        assert "closer than 0.02 s" in caplog.text


def test_mergers_keep_the_path_and_change_it_by_no_more_than_they_say():
    rng, done = np.random.default_rng(5), 0
    for _ in range(40):
        time = np.cumsum(rng.choice([1e-3, 4e-3, 0.3, 0.5], 12))
        pressure = PEAK * rng.choice([0.0, 0.01, 0.5, 1.0], (12, 3))
        try:
            corners = merged(time, pressure, 0.02, 0.005 * PEAK)
        except ValueError:
            continue
        done += 1
        assert np.diff(corners.time).min() >= 0.02
        assert corners.moved <= 0.05
        along = np.linspace(corners.time[0], corners.time[-1], 20_000)
        path = np.stack([np.interp(along, corners.time, column) for column in corners.pressure.T])
        for corner in pressure:
            nearest = np.abs(path.T - corner).max(axis=1).min()
            assert nearest <= corners.changed + 0.006 * PEAK
    assert done > 20


def test_changes_faster_than_can_be_followed_are_refused():
    time = np.arange(0, 1, 5e-3)
    with pytest.raises(ValueError, match="take a smaller timestep"):
        merged(time, PEAK * (np.arange(200) % 2)[:, None], 0.02, 100.0)


def test_other_columns_are_named_and_do_not_count(tmp_path, caplog):
    time = even(20)
    table = np.column_stack([np.arange(len(time)), 80e3 + 0 * time, clean(time)[:, 1], time * 1e3,
                             clean(time)[:, [0, 2]], 21e3 + 0 * time])  # fmt: skip
    heads = ("sample", "supply (kPa)", "p2_kPa", "time_s", "p1_kPa", "p3_kPa", "Temp [C]")
    path = tmp_path / "log.csv"
    rows = [",".join(f"{v / 1e3:.6f}" for v in row) for row in table]
    path.write_text("\n".join([",".join(heads), *rows]))
    read = read_series(path, ("left", "middle", "right"))
    assert read.pressure == pytest.approx(clean(time), abs=1.0)
    assert "'sample', 'supply (kPa)', 'Temp [C]'" in caplog.text
    chosen = read_series(path, ("left", "middle", "right"), ("p3", "supply", "p1 [psi]"))
    assert chosen.pressure[:, 0] == pytest.approx(clean(time)[:, 2], abs=1.0)
    assert chosen.pressure[:, 1] == pytest.approx(80e3)
    assert chosen.pressure[:, 2] == pytest.approx(clean(time)[:, 0] * PSI / 1e3, abs=10.0)


@pytest.mark.parametrize(
    ("heads", "order"),
    [
        ("t_s,p3_Pa,p2_Pa,p1_Pa", (3, 2, 1)),
        ("t_s,P_0 [Pa],P_1 [Pa],P_2 [Pa]", (1, 2, 3)),
        ("t_s,pressure right [Pa],Left chamber [Pa],p_middle [Pa]", (2, 3, 1)),
        ("t_s,c [Pa],b [Pa],a [Pa]", (3, 2, 1)),
        ("t_s,p2_cmd [Pa],p1_cmd [Pa],p3_cmd [Pa]", (2, 1, 3)),
        ("t_s,p1_set [Pa],p3_meas [Pa],p2_meas [Pa],p1_meas [Pa]", (4, 3, 2)),
        ("t_s,p_l [Pa],p_m [Pa],p_r [Pa]", (1, 2, 3)),
        ("t_s,rear [Pa],torso [Pa],front [Pa]", (1, 2, 3)),
        ("t_s,p3 in Pa,p1 in Pa,p2 in Pa", (2, 3, 1)),
        ("t_s,p3 / Pa,p1 / Pa,p2 / Pa", (2, 3, 1)),
    ],
)
def test_chambers_are_told_by_names_numbers_letters_or_order(tmp_path, heads, order):
    path = tmp_path / "log.csv"
    row = ",".join(str(number) for number in range(1, heads.count(",") + 1))
    path.write_text(f"{heads}\n0,{row}\n1,{row}\n")
    read = read_series(path, ("left", "middle", "right"))
    assert read.pressure[0].tolist() == list(order)


@pytest.mark.parametrize(
    ("heads", "named"),
    [
        ("t [s],p1_set [kPa],p1_raw [kPa],p2_raw [kPa],p3_raw [kPa]", "--columns"),
        ("t [s],p1 [kPa],left [kPa],middle [kPa],right [kPa],p1 [kPa]", None),
        ("t [s],left [kPa],left [psi],middle [kPa],right [kPa]", "the same chamber"),
        ("t [s],in [kPa],out [kPa],tank [kPa],valve [kPa]", "--columns"),
        ("t [s],p1 [kPa],p2,p3", "'p2' must name its unit"),
    ],
)
def test_columns_that_are_not_clear_are_asked_for(tmp_path, heads, named):
    path = tmp_path / "log.csv"
    zeros = ",".join("1" for _ in heads.split(",")[1:])
    path.write_text(f"{heads}\n0,{zeros}\n1,{zeros}\n")
    if named is None:
        assert read_series(path, ("left", "middle", "right")).pressure.shape == (2, 3)
        return
    with pytest.raises(ValueError, match=named):
        read_series(path, ("left", "middle", "right"))


def test_units_may_stand_in_a_line_of_their_own_and_heads_may_not_lack(tmp_path):
    path = tmp_path / "log.csv"
    path.write_text("Time,p2,p1,\nms,kPa,psig,\n0,1,2,\n500,1,2,\n")
    read = read_series(path, ("1", "2"))
    assert read.time.tolist() == [0.0, 0.5]
    assert read.pressure[0].tolist() == pytest.approx([2 * PSI, 1e3])
    path.write_text("0,1,2\n1,1,2\n")
    with pytest.raises(ValueError, match="first line of names"):
        read_series(path)


def test_dates_and_times_of_day_are_times(tmp_path):
    path = tmp_path / "log.csv"
    begin = datetime.datetime(2024, 2, 28, 23, 59, 59)
    for stamps in ([(begin + datetime.timedelta(seconds=s)).isoformat(" ") for s in (0, 0.25, 2)],
                   ["10:00:00", "10:00:00.25", "10:00:02"]):  # fmt: skip
        path.write_text("\n".join(["Timestamp,p1 [Pa]", *(f"{s},1" for s in stamps)]))
        assert read_series(path).time.tolist() == [0.0, 0.25, 2.0]


def three_cycles(path, seconds=30.4, period=WAVE.period):
    time = np.arange(0, seconds, 0.01)
    gait = Gait("it", WAVE.stages, period / WAVE.ramps)
    return written(path, time, noisy(PEAK * gait.fractions(time), 0.01, seed=7))


def test_a_log_of_three_cycles_counts_as_one_and_says_so(tmp_path, caplog):
    gait, _ = as_gait("it", read_series(three_cycles(tmp_path / "log.csv", period=9.3)))
    assert not gait.repeats
    assert "count as one cycle" in caplog.text
    assert "--cycle 9.3" in caplog.text


def test_a_cycle_is_cut_and_repeats(tmp_path, caplog):
    path = three_cycles(tmp_path / "log.csv")
    scene, _ = build({"gait": {"file": str(path), "cycle": "10 s"}, "numerics": {"cycles": 2}})
    assert scene.gait.repeats
    assert scene.gait.period == pytest.approx(10.0)
    assert scene.gait.stages[0] == scene.gait.stages[-1]
    assert "the last of 3 cycles" in caplog.text
    walk = measure(simulate(scene, COARSE))
    assert walk.by_cycle == pytest.approx([distance("felt")] * 2, abs=4e-4)


@pytest.mark.parametrize(
    ("cycle", "named"), [("9 s", "chamber"), ("40 s", "at most"), ("0 s", "0")]
)
def test_a_cycle_that_is_none_is_refused(tmp_path, cycle, named):
    path = three_cycles(tmp_path / "log.csv")
    with pytest.raises(ValueError, match=named):
        build({"gait": {"file": str(path), "cycle": cycle}})


def test_what_was_measured_in_chambers_is_not_filtered_again(tmp_path, caplog):
    time = even(20)
    path = written(tmp_path / "log.csv", time, clean(time))
    gait, valves = {"file": str(path)}, {"fill_time": 0.5}
    measured, _ = build({"gait": gait, "valves": valves})
    assert measured.valves.ideal
    assert "[valves] does not act" in caplog.text
    commanded, _ = build({"gait": {**gait, "commands": True}, "valves": valves})
    assert commanded.valves.fill_time == 0.5


@pytest.mark.parametrize(
    "name", ["UP.CSV", "log.csv", "gait.toml", "folder/log.txt", "walk.tsv", "log"]
)
def test_a_file_that_is_not_there_is_no_such_file(capsys, name):
    with pytest.raises(SystemExit) as stop:
        main(["--gait", name, "--no-video"])
    assert stop.value.code == 2
    assert "no such file" in capsys.readouterr().err


def test_files_of_any_ending_are_read_and_notes_are_lines_of_the_command(tmp_path, capsys):
    path = three_cycles(tmp_path / "LOG.TXT")
    words = ["--gait", str(path), "--no-video", "--out", str(tmp_path), "--links", "12"]
    assert main([*words, "--cycle", "10s", "--surface", "felt,gelatin"]) == 0
    printed = capsys.readouterr().err.splitlines()
    assert printed == ["undulator run: gait LOG: the last of 3 cycles of 10 s repeats"]
    assert logging.getLogger("mjsim").handlers
