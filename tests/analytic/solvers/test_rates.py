"""Ground that resists by speed: viscous films and boundary lubrication."""

from dataclasses import replace

import numpy as np
import pytest

from analytic import GAITS, SURFACES, Friction, Robot, Surface, predict

BENT = Friction(tension=1.0)
FILM = Surface("film", viscosity=2000.0)
WET = Surface("wet", tip_force=0.010, viscosity=2000.0)


def travel(ground, ramp_time, gait="wave"):
    timed = replace(GAITS[gait], ramp_time=ramp_time)
    return predict(Robot(), timed, ground, friction=BENT).locomotion.per_cycle / Robot().length


def test_friction_is_static_at_rest_and_kinetic_beyond_the_stribeck_speed():
    slick = Surface("slick", tip_force=1.0, static_ratio=1.8, stribeck_speed=0.01)
    assert slick.at_speed(0.0) == pytest.approx(1.8)
    assert slick.at_speed(np.array([-0.01, 0.01])) == pytest.approx(1 + 0.8 / np.e)
    assert slick.at_speed(0.1) == pytest.approx(1.0)


@pytest.mark.slow
def test_a_film_alone_walks_as_felt_does_however_fast():
    """Only sides hold, and what they hold is only asked to be more than nothing."""
    felt = predict(Robot(), GAITS["wave"], SURFACES["felt"]).locomotion.per_cycle / Robot().length
    faint = replace(FILM, viscosity=1.0)
    assert travel(faint, 2.0) == pytest.approx(felt, abs=5e-4)
    for ramp in (0.5, 8.0):
        assert travel(FILM, ramp) == pytest.approx(travel(faint, 2.0), abs=1e-3)


@pytest.mark.slow
def test_wet_ground_is_gelatin_to_a_slow_gait_and_felt_to_a_fast_one():
    slow, fast = travel(WET, 200.0), travel(WET, 0.002)
    gelatin = replace(SURFACES["gelatin"], tip_force=WET.tip_force)
    assert slow == pytest.approx(travel(gelatin, 2.0), abs=1e-3)
    assert fast == pytest.approx(travel(SURFACES["felt"], 2.0), abs=4e-3)


def test_coulomb_friction_is_static_where_nothing_is_fast_and_kinetic_where_nothing_is_slow():
    law = Friction("coulomb", tension=1.0)
    plain = Surface("plain", friction=0.2, tip_friction=0.12)
    slow = replace(plain, static_ratio=2.0, stribeck_speed=1e3)  # than anything that slides
    light = replace(Robot(), peak_pressure=0.5 * Robot().peak_pressure)
    static, kinetic, rest = (
        predict(light, GAITS["pulse"], ground, "elastica", 6, law).locomotion.per_cycle
        for ground in (plain.scaled(2.0), plain, slow)
    )
    assert rest == pytest.approx(static, abs=1e-6 * light.length)
    assert abs(static - kinetic) > 10 * abs(rest - static)


@pytest.mark.parametrize("ground", [SURFACES["polyethylene"], SURFACES["gelatin"]],
                         ids=lambda ground: ground.name)  # fmt: skip
@pytest.mark.slow
def test_dry_ground_does_not_ask_how_fast(ground):
    assert travel(ground, 0.5) == travel(ground, 50.0)


@pytest.mark.slow
def test_speed_times_viscosity_is_all_that_counts():
    thick = replace(WET, viscosity=2 * WET.viscosity)
    assert travel(WET, 0.5) == pytest.approx(travel(thick, 1.0), abs=1e-9)


@pytest.mark.parametrize(
    ("values", "named"),
    [({"static_ratio": 0.5}, "static_ratio"), ({"static_ratio": 2.0}, "stribeck_speed"),
     ({"viscosity": -1.0}, "viscosity")],
)  # fmt: skip
def test_bad_values_are_named(values, named):
    with pytest.raises(ValueError, match=named):
        Surface("bad", tip_force=1.0, **values)


def test_ground_that_resists_by_speed_needs_times_and_friction_that_bends():
    with pytest.raises(ValueError, match="by speed"):
        predict(Robot(), GAITS["wave"], WET)
    with pytest.raises(ValueError, match="its times"):
        predict(Robot(), GAITS["wave"], WET, friction=BENT, path=np.zeros((3, 3)))
