"""Plots of a walk: axes in, the same axes out, and what is drawn."""

import numpy as np
import pytest
from matplotlib.figure import Figure
from walks import walk

from mjsim.results.plots import touches


@pytest.mark.parametrize("name", ["shapes", "track", "contacts"])
def test_axes_go_in_and_come_out(name):
    ax = Figure().subplots()
    assert getattr(walk("gelatin").plot, name)(ax) is ax
    assert ax.get_title() == "gelatin"


def test_without_axes_some_are_made():
    import matplotlib.pyplot as plt

    with plt.rc_context({"backend": "agg"}):
        ax = walk("gelatin").plot.track()
        plt.close(ax.figure)
    assert ax.get_xlabel() == "time [s]"


def test_the_track_ends_where_the_walk_does():
    result = walk("gelatin")
    left = result.plot.track(Figure().subplots()).lines[0].get_ydata()
    x = result.line[:, 0, 0]
    assert left[-1] == pytest.approx(1e3 * (x[-1] - x[result.start]))


def test_shapes_are_drawn_at_the_times_asked_for_and_dark_where_inflated():
    result = walk("gelatin")
    ax = result.plot.shapes(Figure().subplots(), times=[0.0, 4.0])
    lines = [line for line in ax.lines if line.get_lw() == 4]
    assert len(lines) == 2 * 3
    brightness = [np.mean(line.get_color()) for line in lines]
    pressure = result.pressure[np.searchsorted(result.time, 4.0)]
    assert np.argmin(brightness) - 3 in np.flatnonzero(pressure == pressure.max())
    assert min(brightness[:3]) > max(0.7, min(brightness[3:]))


@pytest.mark.parametrize("times", [[], [99.0], [float("nan")]])
def test_times_outside_the_walk_are_refused(times):
    with pytest.raises(ValueError, match="times must be from"):
        walk("gelatin").plot.shapes(Figure().subplots(), times=times)


def test_forces_and_heights_agree_about_what_touches():
    with_forces, without = walk("gelatin", forces=True), walk("gelatin")
    assert (touches(with_forces) == touches(without)).mean() > 0.97


def test_the_text_of_a_walk_is_short_and_says_how_it_ended():
    text = repr(walk("gelatin"))
    assert len(text) < 200
    assert "gelatin" in text
    assert "status ok" in text
    assert "-0.03" in text
