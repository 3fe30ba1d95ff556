"""The two friction laws, as what is done before each step and who is said to slide.

The paper's (section 2.2): each end is held along x by a dry friction of its own bound, V0 V_t or
V0 tau lambda / L_segment, and the physics lets the weaker one slide. Where both bounds are equal
that would leave undecided who slides: the paper's answer, both alike, is a dry friction on the mean
position of the ends, of bound V0 and in place of both.

Coulomb's: mu N at every pad, by MuJoCo's own contacts; nothing is left to do but to look.
"""

from collections.abc import Callable
from typing import NamedTuple

import mujoco

from analytic import Surface
from mjsim.bodies.parts import TENDONS, contact, pad_friction
from mjsim.friction.contact_length import Sides, pads_of
from mjsim.scene import Numerics, Scene

Adapt = Callable[[float, float, bool, bool], None]
Slopes = Callable[[], tuple[float, float]]
# bounds of the friction along x on the left end, on the right end and on their mean position [N],
# and the part of a change of separation that the left end will take up
Hold = tuple[float, float, float, float]


_TIPS = (0.0, 0.0)  # side contact of two tips


class Held(NamedTuple):
    """What a step begins with: lengths of side contact of the ends, 0 for a tip [m], and the part
    of a change of separation that the left end takes up.
    """

    left: float
    right: float
    left_slip_fraction: float


class ConstantLaw:
    """Constant bounds at tips, by area on sides, sharing on ties on level ground.

    On a slope the weight decides a tie, and who takes up a change is seen as it moves.
    """

    def __init__(self, scene: Scene) -> None:
        surface: Surface = scene.surface
        self._both, self._level = scene.force_scale, scene.slope == 0
        self._tip = scene.force_scale * surface.tip
        self._area = scene.force_scale * surface.area / scene.robot.segment_length

    def hold(self, contact_left: float, contact_right: float) -> Hold:
        """What holds ends with these lengths of side contact, 0 for a tip [m]."""
        left = self._area * contact_left if contact_left else self._tip
        right = self._area * contact_right if contact_right else self._tip
        if left == right and self._level:
            return 0.0, 0.0, self._both, 0.5
        return left, right, 0.0, 0.0 if left > right else 1.0


def friction(
    scene: Scene,
    numerics: Numerics,
    model: mujoco.MjModel,
    data: mujoco.MjData,
    slopes: Slopes,
    passive: list[tuple[bool, bool]],
) -> Callable[[int], Held]:
    """The law of a scene, to be called with the number of each step before it is done.

    Args:
        scene, numerics: what is simulated.
        model, data: as compiled; the law sets the ends' softness and bounds.
        slopes: of the two ends, positive where the strip rises inwards [rad].
        passive: for each step whether the left and the right segment are without pressure.
    """
    sides, flat = Sides(scene, numerics, model, data), numerics.side_angle
    by_slope = _roughness if scene.friction == "coulomb" else _softness
    adapt = by_slope(scene, numerics, model)
    left, right, both = (model.tendon(f"robot/{name}").id for name in TENDONS)

    def look(step: int) -> tuple[float, float]:
        slope_left, slope_right = slopes()
        may_left, may_right = passive[step]
        side_left = may_left and slope_left <= flat
        side_right = may_right and slope_right <= flat
        adapt(slope_left, slope_right, side_left, side_right)
        return sides.lengths(side_left, side_right) if side_left or side_right else _TIPS

    rate = data.ten_velocity

    def moving(lengths: tuple[float, float]) -> Held:
        one, other = abs(rate.item(left)), abs(rate.item(right))
        return Held(*lengths, 1.0 if one > other else 0.0)

    if scene.friction == "coulomb":
        return lambda step: moving(look(step))

    law, bounds, level = ConstantLaw(scene), model.tendon_frictionloss, scene.slope == 0
    lengths, held = (-1.0, -1.0), Held(0.0, 0.0, 0.5)

    def paper(step: int) -> Held:
        nonlocal lengths, held
        now = look(step)
        if now != lengths:
            lengths = now
            bounds[left], bounds[right], bounds[both], share = law.hold(*now)
            held = Held(*now, share)
        return held if level else moving(now)

    return paper


def _softness(scene: Scene, numerics: Numerics, model: mujoco.MjModel) -> Adapt:
    """Makes the contact of an end softer while it stands steep, and firm again."""
    softness, ends = model.geom_solref, _end_pads(numerics, model)
    firm, soft = contact(scene, numerics)[1][0], numerics.steep_contact_time * numerics.timestep
    steep, before = numerics.steep_angle, (False, False)

    def soften(slope_left: float, slope_right: float, *_: bool) -> None:
        nonlocal before
        now = (slope_left > steep, slope_right > steep)
        if now != before:
            for end, is_steep in zip(ends, now, strict=True):
                softness[end, 0] = soft if is_steep else firm
            before = now

    return soften


def _roughness(scene: Scene, numerics: Numerics, model: mujoco.MjModel) -> Adapt:
    """Gives the outermost pads the friction of a tip, or of a side while the end lies on it."""
    friction, ends = model.geom_friction, _end_pads(numerics, model)
    tip, side = (pad_friction(scene, at_end)[0] for at_end in (True, False))
    before = (False, False)

    def roughen(slope_left: float, slope_right: float, *now: bool) -> None:
        nonlocal before
        if now != before:
            for end, on_side in zip(ends, now, strict=True):
                friction[end, 0] = side if on_side else tip
            before = now  # type: ignore[assignment]

    return roughen


def _end_pads(numerics: Numerics, model: mujoco.MjModel) -> list[list[int]]:
    return [pads_of(model, node) for node in (0, numerics.links + 1)]
