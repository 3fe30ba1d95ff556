"""Robots, gaits and surfaces are checked when they are made; the package stands alone."""

import subprocess
import sys

import numpy as np
import pytest
from hypothesis import given
from strategies import gaits

from analytic import GAITS, SURFACES, Gait, Robot, Surface
from analytic.friction.laws import friction_number, neutral_ratio
from analytic.scene import pneunet
from analytic.scene.surface import SHEAR_STRENGTH, TIP_FORCE


@pytest.mark.parametrize(
    ("field", "value"),
    [("length", 0.0), ("width", -1.0), ("modulus", np.inf), ("thickness", np.nan),
     ("chamber_fraction", 1.1), ("weight_per_length", 0), ("peak_pressure", "7 apples")],
)  # fmt: skip
def test_a_robot_names_the_field_that_is_wrong(field, value):
    with pytest.raises(ValueError, match=field):
        Robot(**{field: value})


def test_a_robot_cannot_be_changed():
    with pytest.raises(AttributeError):
        Robot().length = 1.0


@pytest.mark.parametrize(
    "stages",
    [((0, 0, 0),), ((0, 0, 0), (1, 0), (0, 0, 0)), ((0, 0, 0), (2, 0, 0), (0, 0, 0)),
     ((0, 0, 0), (1, 0, 0))],
)  # fmt: skip
def test_a_gait_that_is_no_closed_cycle_is_refused(stages):
    with pytest.raises(ValueError, match="stages must"):
        Gait("bad", stages)


@pytest.mark.parametrize("time", [0.0, -1.0, np.nan, np.inf])
def test_a_ramp_takes_a_positive_time(time):
    with pytest.raises(ValueError, match="ramp_time"):
        Gait("bad", GAITS["wave"].stages, ramp_time=time)


@given(gaits)
def test_pressures_pass_through_every_stage_on_straight_ramps(gait):
    p = gait.pressures(8)
    assert p.shape == (8 * gait.ramps + 1, 3)
    assert np.allclose(p[::8], gait.stages)
    assert np.allclose(np.diff(p, n=2, axis=0).reshape(-1, 3)[0:6], 0, atol=1e-12)
    assert np.allclose(gait.reversed().pressures(8), p[::-1], atol=1e-12)


@given(gaits)
def test_fractions_in_time_are_the_pressures_in_states(gait):
    time = np.linspace(0, 2 * gait.period, 2 * gait.ramps * 8 + 1)
    assert np.allclose(gait.fractions(time), gait.pressures(8, cycles=2), atol=1e-9)
    assert np.allclose(gait.fractions(np.array([-1.0])), gait.stages[0])


def test_states_per_ramp_must_be_positive():
    with pytest.raises(ValueError, match="states_per_ramp"):
        GAITS["wave"].pressures(0)


@pytest.mark.parametrize(
    ("field", "value"),
    [("tip_force", -1.0), ("shear_strength", np.nan), ("friction", "wet"), ("tip_friction", True)],
)
def test_a_surface_resists_or_does_not_but_never_drives(field, value):
    with pytest.raises(ValueError, match=field):
        Surface("bad", **{field: value})


def test_the_three_surfaces_are_the_paper_s():
    """{V_t, tau} in units of V0 and of V0 over a third of the default robot (section 2.2)."""
    pairs = {name: (surface.tip_force / TIP_FORCE, surface.shear_strength / SHEAR_STRENGTH)
             for name, surface in SURFACES.items()}  # fmt: skip
    assert pairs == {"felt": (0, 1), "polyethylene": (0.5, 1), "gelatin": (1, 0)}
    assert neutral_ratio(SURFACES["polyethylene"], Robot()) == pytest.approx(1 / 6)
    rigidity = pneunet.base_rigidity(Robot())
    for surface in SURFACES.values():
        assert friction_number(surface, Robot(), rigidity) == pytest.approx(1.5, rel=0.01)


def test_analytic_imports_numpy_and_scipy_only():
    code = (
        "import sys, analytic; "
        "print(*[m for m in ('mujoco', 'dm_control', 'mjsim', 'xarray', 'matplotlib') "
        "if m in sys.modules])"
    )
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert run.stdout.strip() == ""
