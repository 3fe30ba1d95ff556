"""Charts say what they show: names beside lines, the cheapest method, units, which way is ahead."""

from contextlib import nullcontext
from dataclasses import asdict, replace
from types import SimpleNamespace
from typing import get_args

import numpy as np
import pandas as pd
import pytest
from matplotlib.figure import Figure

from analytic.scene.gait import GAITS
from mjsim.fitting import picture as fit_picture
from mjsim.optimising import picture
from mjsim.optimising.objective import Aim
from mjsim.optimising.search import Generation
from studies import limbs
from studies.accuracy import figure
from studies.accuracy.rows import Row
from studies.labels import name_lines
from studies.table import read


def test_names_lie_within_the_panel_and_on_no_other_name():
    drawn = Figure(layout="constrained")
    axes = drawn.subplots()
    lines = {f"method {i}": (np.array([1.0, 2.0]), np.array([1.0, 2.0]) + 0.1 * i, f"C{i}")
             for i in range(5)}  # fmt: skip
    for x, y, colour in lines.values():
        axes.plot(x, y, color=colour)
    name_lines(axes, lines)
    boxes = [text.get_window_extent() for text in axes.texts]
    assert [text.get_text() for text in axes.texts] == list(lines)
    inside = axes.get_window_extent()
    for i, box in enumerate(boxes):
        assert inside.contains(box.x0, box.y0)
        assert inside.contains(box.x1, box.y1)
        assert not any(box.overlaps(other) for other in boxes[:i])


def rows_of(**costs):
    row = Row("walk", "felt", "chain", "discrete", "", 0.0, 24, 0.01, 0.04, 0.04, 1e-3, 2e-3, 2e-3,
              2e-3, "ok", "a machine", "mujoco=3.17.0", "abc")  # fmt: skip
    return pd.DataFrame([asdict(replace(row, method=method.replace("_", " "), cost=cost))
                         for method, cost in costs.items()])  # fmt: skip


def test_the_title_names_the_cheapest_method_and_what_others_cost():
    rows = rows_of(chain=2e-3, rod=5e-3, Drake=3.0)
    first, others = figure.message(rows)
    assert "0.5% of the exact answer chain costs least" in first
    assert others == "Times its cost: rod 2.5, Drake 1,500"
    rows["error"] = 0.1
    assert figure.message(rows) == ("No method comes within 0.5%",)


def test_the_recorded_walks_of_the_quadruped_draw_its_charts():
    points = read(limbs.WALKS, limbs.walked)
    drake = limbs.read_drake(limbs.DRAKE)
    grid = list(limbs.grid(drake["left"].unique().tolist()))
    names = ["surface", "law", "left", "step", "elements", "states"]
    assert set(grid) == set(points[names].itertuples(index=False, name=None))
    for chart in (limbs.draw_turns(points), limbs.draw_cost(points),
                  limbs.draw_peers(points, drake)):  # fmt: skip
        assert chart.get_suptitle()
    table = limbs.errors(points)
    assert len(table) == len(limbs.STEPS) * len(limbs.ELEMENTS) * 6
    assert not table["error"].isna().any()


@pytest.mark.parametrize("aim", get_args(Aim))
def test_the_picture_of_a_search_tells_its_objective_with_its_unit(tmp_path, aim):
    assert picture.AXES[aim].endswith("]")
    gait = GAITS["wave"]
    picture.draw(gait, gait, [Generation(16, gait, 0.01, 0.0)], tmp_path / "best.png", aim,
                 ("left", "middle", "right"))  # fmt: skip
    assert (tmp_path / "best.png").stat().st_size > 1000


def test_an_outlier_does_not_flatten_the_picture_of_a_fit(tmp_path, monkeypatch):
    """One of 100 points is off by a metre, of which the others lie within 10 mm."""
    at = np.linspace(0.0, 10.0, 100)
    value = 5e-3 * np.sin(at)
    value[50] = 1.0
    series = SimpleNamespace(name="track: left", quantity="left", abscissa="time", unit="m",
                             noise="position", at=at, value=value)  # fmt: skip
    model = 5e-3 * np.sin(at)
    estimate = SimpleNamespace(
        series=(series,), model=(model,), noise={"position": 1e-4}, level=lambda _: 0.0,
        residuals=lambda: (value - model,),
    )  # fmt: skip
    shown = []
    monkeypatch.setattr(Figure, "savefig", lambda figure, path: shown.append(figure))
    monkeypatch.setattr(fit_picture, "whole", lambda path: nullcontext(path))
    fit_picture.draw(estimate, tmp_path / "fit.png")
    top, _ = shown[0].axes
    assert np.ptp(top.get_ylim()) < 15  # mm
    assert "over 5 times the noise off" in [
        text.get_text() for text in top.get_legend().get_texts()
    ]
