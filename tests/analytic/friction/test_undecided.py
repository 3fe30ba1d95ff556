"""How far bounds of all contacts leave the motion open."""

from analytic import GAITS, SURFACES, Friction, Gait, Patches, Robot, solve_elastica
from analytic.friction.motion import undecided_motion
from analytic.scene.surface import from_ratios

ROBOT, ALL = Robot(), Friction(contacts="all")
LONG = Robot(length=8 / 3 * 0.13, weight_per_length=2.0, chamber_height=4.1e-3, segments=(1.0,) * 8)


STAGES = tuple(tuple(float((j - k) % 4 in (0, 1)) for j in range(8)) for k in range(9))


def test_where_none_of_many_contacts_resists_the_motion_is_open_on_patches_too():
    path = LONG.peak_pressure * Gait("waves", STAGES).pressures(4)
    shapes = solve_elastica(LONG, path, 48)
    felt, gelatin = SURFACES["felt"], SURFACES["gelatin"]
    amount = undecided_motion(shapes, felt, ALL)
    assert amount > 0.05 * LONG.length
    assert undecided_motion(shapes, Patches("two", (0.1,), (felt, felt)), ALL) == amount
    assert undecided_motion(shapes, gelatin, ALL) < 0.2 * amount
    assert undecided_motion(shapes, from_ratios("weak", 1e-3, 1.0), ALL) == 0.0


def test_two_ends_that_resist_alike_are_decided_by_the_paper_s_rule():
    shapes = solve_elastica(ROBOT, ROBOT.peak_pressure * GAITS["wave"].pressures(6))
    assert undecided_motion(shapes, SURFACES["felt"], ALL) == 0.0
