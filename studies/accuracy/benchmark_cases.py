"""Cases of walking and the displacements that they should have; needs no MuJoCo.

The default gait of the default robot, under Coulomb friction of a heavier one, on level ground. The
ramps are so slow that the quasi-static reference is what a method should give: its numerical error
is measured, and not the effect of inertia at 2 s per ramp.
"""

from dataclasses import replace
from functools import cache

from analytic import SURFACES, Elastica, Friction, Robot, predict
from analytic.scene.surface import SHEAR_STRENGTH, TIP_FORCE
from mjsim.scene import Scene
from studies.accuracy.rows import Row, row
from studies.accuracy.setting import Setting
from studies.accuracy.timing import Timing

# of the case that other engines were measured on: kept, so that their rows compare
HEAVIER = replace(Robot(), weight_per_length=2.0, chamber_height=4.1e-3)
# an end that carries half its weight resists by V0
FRICTION = TIP_FORCE / (0.5 * HEAVIER.weight)
WALK, COULOMB = "walk", "coulomb"
GROUNDS = {WALK: ("felt", "gelatin"), COULOMB: ("gelatin",)}  # Coulomb's law leaves felt undecided
FAR = 0.5  # relative error of a displacement that is none; chosen
_RAMP = 16.0  # s; chosen, inertia is below 0.1 % by then, and below 0.4 % under Coulomb's law


def scene_of(case: str, ground: str, body: str = "chain") -> Scene:
    """Scene of a case on a ground: constant bounds, or a law that other engines know as well.

    That is Coulomb's, with chambers at constant pressure: the rest curvature alone follows them.
    """
    named = SURFACES[ground]
    tip, side = named.tip_force / TIP_FORCE, named.shear_strength / SHEAR_STRENGTH
    surface = replace(named, tip_friction=tip * FRICTION, friction=side * FRICTION)
    scene = Scene(ground=surface, body=body, gait=replace(Scene.gait, ramp_time=_RAMP))
    if case != COULOMB:
        return scene
    return replace(scene, robot=HEAVIER, friction="coulomb", chamber="constant-pressure")


def friction_of(case: str) -> Friction:
    """Friction of the reference: it bends the strip as strongly as in the simulation."""
    return Friction("coulomb" if case == COULOMB else "constant", 1.0)


@cache
def exact(case: str, ground: str) -> float:
    """Displacement per cycle over L of the elastica, of four times the usual links."""
    scene = scene_of(case, ground)
    walk = predict(scene.strip, scene.gait, scene.ground, Elastica(240, scene.chamber),
                   states_per_ramp=25, friction=friction_of(case))  # fmt: skip
    return walk.locomotion.per_cycle / scene.strip.length


def walked(
    case: str, ground: str, setting: Setting, value: float, timing: Timing, status: str
) -> Row:
    """The row of a displacement per cycle over L; one that is FAR off is no walk of this gait."""
    reference = exact(case, ground)
    if status == "ok" and abs(value / reference - 1) > FAR:
        status = "drifting"
    return row(case, ground, setting, value, reference, timing, status)
