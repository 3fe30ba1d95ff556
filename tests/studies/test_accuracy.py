"""Accuracy against cost: the case has exact answers, rows come back whole, auto keeps its word."""

import json
import math
import subprocess
import sys
from dataclasses import replace

import mujoco
import pandas as pd
import pytest
from hypothesis import given
from hypothesis import strategies as st
from walks import refusal

from mjsim.commands import run
from mjsim.files.command_line import cli
from mjsim.scene import Scene
from mjsim.simulation.checked import refinements
from studies.accuracy import __main__ as chart
from studies.accuracy import cantilever_bodies, figure, heavy_cantilever, walking
from studies.accuracy.benchmark_cases import COULOMB, WALK
from studies.accuracy.rows import Row, append, read
from studies.accuracy.setting import Setting, setting_of


def test_the_exact_tip_is_the_published_one():
    assert heavy_cantilever.exact() == pytest.approx((0.32218, -0.88079), abs=5e-5)


@pytest.mark.parametrize("method", ["elastica", "chain", "cable", "stock cable"])
def test_a_settled_strip_is_of_second_order_in_its_elements(method):
    if method == cantilever_bodies.STOCK and mujoco.mj_version() >= 4_000_000:
        pytest.skip("MuJoCo 4 has no composite cable")
    errors = []
    for links in (6, 12, 24):
        timestep, integrator = (0.0, "") if method == "elastica" else (0.02, "discrete")
        row = cantilever_bodies.run(Setting(method, links, timestep, integrator))
        assert row.status == "ok"
        errors.append(row.error)
    assert errors[1] / errors[2] == pytest.approx(4, rel=0.15)
    assert errors[2] < 0.002


def test_the_planar_chain_settles_where_the_elastica_of_as_many_links_does():
    theory = cantilever_bodies.run(Setting("elastica", 24))
    for integrator in ("discrete", "implicitfast"):
        chain = cantilever_bodies.run(Setting("chain", 24, 0.01, integrator))
        assert chain.error == pytest.approx(theory.error, rel=1e-3)


def test_a_strip_that_cannot_settle_is_no_number():
    row = cantilever_bodies.run(Setting("chain", 24, 0.01, "RK4"))
    assert row.status == "diverged"
    assert math.isnan(row.error)


def some_row(**changes):
    row = Row("walk", "felt", "chain", "discrete", "", 0.0, 24, 0.01, 0.0411, 0.0418, 0.0157,
              2e-3, 2e-3, 2e-3, "ok", "a machine", "mujoco=3.17.0", "abc")  # fmt: skip
    return replace(row, **changes)


def test_rows_come_back_from_their_file_and_more_are_added(tmp_path):
    path = tmp_path / "rows.csv"
    rows = [some_row(), some_row(links=12, error=math.nan, status="toppled")]
    for row in rows:
        assert list(append([row], path)) == [row]
    back = read(path)
    assert back[0] == rows[0]
    assert back[1].status == "toppled"
    assert math.isnan(back[1].error)


def test_a_table_of_something_else_is_refused(tmp_path):
    path = tmp_path / "rows.csv"
    path.write_text("a,b\n1,2\n")
    with pytest.raises(ValueError, match="no table of rows"):
        read(path)
    with pytest.raises(SystemExit) as stop:
        chart.main(["--rows", str(path), "--out", str(tmp_path)])
    assert stop.value.code == cli.BAD_INPUT


points = st.lists(
    st.tuples(st.floats(1e-5, 1e2), st.floats(1e-6, 1e1), st.sampled_from(["ok", "diverged"]))
)


@given(points)
def test_nothing_is_both_cheaper_and_more_accurate_than_a_point_of_the_front(drawn):
    rows = pd.DataFrame(drawn, columns=["cost", "error", "status"])
    fine = list(rows[rows["status"] == "ok"].itertuples())
    front = list(figure.pareto(rows).itertuples())
    assert bool(front) == bool(fine)
    for row in front:
        assert not any(o.cost < row.cost and o.error < row.error for o in fine)
    for row in fine:
        assert any(f.cost <= row.cost and f.error <= row.error for f in front)


def test_the_committed_rows_say_where_they_are_from_and_hold_every_method():
    rows = read()
    assert {"chain", "cable", "rod", "stock cable", "modes", "elastica"} <= {
        row.method for row in rows
    }
    assert all(row.machine and "=" in row.versions and row.commit for row in rows)
    assert len({row.key for row in rows}) == len(rows)
    assert all((row.status == "ok") == math.isfinite(row.error) for row in rows)


@pytest.mark.parametrize("case", [WALK, COULOMB])
@pytest.mark.slow
def test_the_error_of_a_slow_walk_is_of_second_order_in_the_links(case):
    """Against the elastica that the same friction bends: nothing is left but the numerics."""
    errors = []
    for links in (6, 12, 24):
        cone = ("elliptic", 1000.0) if case == COULOMB else ()
        row = walking.run(case, "gelatin", Setting("chain", links, 0.005, "discrete", *cone))
        errors.append(row.error)
    assert errors[0] / errors[1] > 3
    assert errors[1] < 0.011
    assert errors[2] < 0.004


def test_nothing_is_both_cheaper_and_more_accurate_than_the_default():
    """On the worse of both grounds, but for scatter: how its error changes with its time step."""
    rows = [row for row in read() if row.case == WALK]
    names = [setting_of(row) for row in rows if row.scene == "felt" and row.status == "ok"]
    both = {name: [row for row in rows if setting_of(row) == name] for name in names}
    error = {name: max(row.error for row in walks) for name, walks in both.items()}
    cost = {name: max(row.cost for row in walks) for name, walks in both.items()}
    usual = next(setting_of(row) for row in rows if figure.is_default(row))
    assert error[usual] < 0.002
    like = [error[name] for name in names
            if (name.method, name.integrator, name.links) == ("chain", "discrete", usual.links)
            and name.timestep <= 2 * usual.timestep]  # fmt: skip
    scatter = max(like) - min(like)
    assert scatter < 0.005
    better = [name for name in names if cost[name] < cost[usual]]
    assert better
    assert all(error[name] > error[usual] - scatter for name in better)


def test_engines_that_share_no_code_agree_with_the_elastica_on_the_distance():
    best: dict[str, float] = {}
    for row in read():
        if row.case == COULOMB and row.status == "ok":
            best[row.method] = min(best.get(row.method, math.inf), row.error)
    assert max(best[name] for name in ("chain", "cable", "Drake", "PyElastica")) < 0.01


@pytest.mark.slow
def test_the_command_picks_a_body(tmp_path, capsys):
    words = ["--body", "auto", "--tolerance", "0.05", "--json", "--no-video"]
    assert run.main([*words, "--surface", "gelatin", "--out", str(tmp_path)]) == 0
    row, choice = json.loads(capsys.readouterr().out), next(refinements(Scene()))
    assert row["body"] == "chain"
    assert row["links"] >= choice.links
    assert row["timestep_s"] < choice.timestep  # the second of two that agree
    (note,) = row["prediction_notes"]
    assert float(note.split("within ")[1].split()[0]) < 0.05 * abs(row["displacement_over_L"])
    assert abs(row["error_over_L"]) < 0.05 * abs(row["predicted_displacement_over_L"])


@pytest.mark.parametrize(
    ("words", "named"),
    [(["--body", "chain", "--tolerance", "0.1"], "chain"),
     (["--body", "auto", "--links", "12"], "links"),
     (["--body", "auto", "--tolerance", "1e-9"], "1e-09"),
     (["--body", "auto", "--tolerance", "nan"], "nan"),
     (["--body", "auto", "--friction", "coulomb"], "coulomb")],
)  # fmt: skip
def test_what_auto_cannot_do_gets_one_line(tmp_path, capsys, words, named):
    assert named in refusal([*words, "--no-video", "--out", str(tmp_path)], capsys)


@pytest.mark.slow
def test_the_quick_chart_is_made_and_goes_on_where_it_was(tmp_path, capsys):
    words = ["--quick", "--case", "walk", "--out", str(tmp_path)]
    words += ["--rows", str(tmp_path / "rows.csv")]
    # as a program, whose workers import what measures from a module of its own
    subprocess.run([sys.executable, "-m", "studies.accuracy", *words], check=True)
    first = (tmp_path / "rows.csv").read_text()
    assert chart.main(words) == 0
    assert (tmp_path / "rows.csv").read_text() == first
    assert "walk.png" in [path.name for path in tmp_path.iterdir()]
    assert "elastica" in capsys.readouterr().out
