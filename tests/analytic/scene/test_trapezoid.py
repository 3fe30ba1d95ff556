"""Gaits by lag, duty and ramp: the named gaits are members, and each segment's pressure is one."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from analytic import GAITS
from analytic.scene.trapezoid import trapezoid

MEMBERS = {"wave": (1 / 5, 2 / 5, 1 / 5), "full-wave": (1 / 6, 1 / 2, 1 / 6),
           "pulse": (1 / 4, 1 / 4, 1 / 4)}  # fmt: skip


@pytest.mark.parametrize("name", list(MEMBERS))
def test_the_named_gaits_are_members(name):
    gait = GAITS[name]
    member = trapezoid(*MEMBERS[name], period=gait.period)
    assert np.allclose(member.stages, gait.stages, atol=1e-7)
    assert np.allclose(member.ramp_times, gait.ramp_times)


@st.composite
def members(draw):
    duty = draw(st.floats(0.1, 0.9))
    ramp = draw(st.floats(0.05, 1.0)) * min(duty, 1 - duty)
    return draw(st.floats(-0.9, 0.9)), duty, ramp, draw(st.integers(1, 6))


@given(members(), st.floats(0.0, 1.0))
def test_each_segment_s_pressure_is_the_trapezoid_at_its_phase(member, at):
    lag, duty, ramp, segments = member
    gait = trapezoid(lag, duty, ramp, segments, period=7.0)
    since = np.array([(at - lag * j) % 1.0 for j in range(segments)])
    exact = np.clip(np.minimum(since, duty + ramp - since) / ramp, 0, 1)
    assert np.allclose(gait.fractions(np.array([7.0 * at]))[0], exact, atol=1e-6)


@given(members())
def test_a_segment_is_inflated_for_its_duty(member):
    lag, duty, ramp, segments = member
    gait = trapezoid(lag, duty, ramp, segments)
    mean = np.diff(gait.times(1)) @ (0.5 * np.add(gait.stages[1:], gait.stages[:-1])) / gait.period
    assert np.allclose(mean, duty, atol=1e-6)


@pytest.mark.parametrize(
    ("values", "named"),
    [((1.0, 0.5, 0.2), "lag"), ((0.2, 1.0, 0.2), "duty"), ((0.2, 0.5, 0.6), "at most 0.5"),
     ((0.2, 0.5, 0.0), "ramp"), ((0.2, "half", 0.1), "duty")],
)  # fmt: skip
def test_values_out_of_range_are_named(values, named):
    with pytest.raises(ValueError, match=named):
        trapezoid(*values)
