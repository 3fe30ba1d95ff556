"""Questions after magnitudes that no ground, ceiling or gait of a robot of this kind has.

Bounds of friction that do not hang on the load go by the greater of the robot's weight and of the
force that bends it; the others lie an order of magnitude or more beyond what is measured of
surfaces, pneumatics and valves. All are chosen; 0, which is none, is always one.
"""

import math
from collections.abc import Iterable

from analytic.checks import not_negative, positive
from analytic.fields import units
from analytic.friction.laws import ROUGHNESS
from analytic.scene import pneunet
from analytic.scene.gait import Gait
from analytic.scene.ground import Patches, surfaces_of
from analytic.scene.limbs import AnyRobot, LimbedRobot, limbs_of
from analytic.scene.surface import RESISTANCES, Ground, Surface
from mjsim.scene.magnitudes import LENGTHS, asked, readings
from mjsim.scene.valves import Valves

_FAR = 100.0  # L; with one more for each cycle, beyond where any robot of this kind comes
_BESIDE = (1e-5, 1e2)  # bounds of friction over the robot's weight, or the force that bends it
_OF_SURFACES = {  # in SI
    "friction": (1e-6, 50.0), "tip_friction": (1e-6, 50.0), "viscosity": (1e-4, 1e8),
    "static_ratio": (1.0, 100.0), "stribeck_speed": (1e-7, 10.0), "adhesion": (1e-6, 1e4),
}  # fmt: skip
_ROUGH = (1e-10, 1e-2)  # m, and over the length
_REACH = (1e-9, 0.5)  # of adhesion: m, and over the length
_RAMP = (1e-4, 1e3)  # s, of the longest one
_LAG = (1e-6, 1e2)  # s, of valves and chambers
_SETTLED = (0.0, 1e3)  # s


def check_ground(ground: Ground, robot: AnyRobot, cycles: int) -> None:
    """Refuse a patch that a robot cannot come to, or a surface that none of its kind walks on.

    Args:
        ground: with its surfaces, of which patches have borders.
        robot: what is to walk on it.
        cycles: that it walks.

    Raises:
        ValueError: there is one; the message says what may be meant.
    """
    reach = (_FAR + cycles) * robot.length
    for border in ground.borders if isinstance(ground, Patches) else ():
        if abs(border) > reach:
            near = [words for words, size in readings(border, LENGTHS)
                    if abs(border * size) <= 10 * robot.length]  # fmt: skip
            raise ValueError(
                f"from must be where a robot {robot.length:g} m long may come, got a patch from "
                f"{border:g} m{asked(near[:1])}"
            )
    for surface in surfaces_of(ground):
        _check_surface(surface, robot)


def _check_surface(surface: Surface, robot: AnyRobot) -> None:
    """Refuse a surface of which a magnitude is none."""
    limbs = [limb.strip for limb in limbs_of(robot)]
    area = sum(strip.width * strip.length for strip in limbs)
    weight = sum(strip.weight for strip in limbs)
    force = max(weight, *(pneunet.base_rigidity(strip) / strip.length**2 for strip in limbs))
    of_ground = f"that of a ground for a robot of {weight:.2g} N"
    limits = {**_OF_SURFACES, "tip_force": (force * _BESIDE[0], force * _BESIDE[1]),
             "shear_strength": (force / area * _BESIDE[0], force / area * _BESIDE[1])}  # fmt: skip
    for name in (*RESISTANCES, "static_ratio", "stribeck_speed", "adhesion"):
        base = name.removesuffix("_back").removesuffix("_across")
        what = of_ground if base in ("tip_force", "shear_strength") else "that of a ground"
        _check(name, (getattr(surface, name) or 0.0,), limits[base], what, units(Surface)[name])
    if surface.adhesion:
        bounds = _REACH[0], _REACH[1] * robot.length
        _check("adhesion_reach", (surface.adhesion_reach,), bounds, "that of a ground", "m")


def check_roughness(roughness: float, robot: AnyRobot, between: bool) -> None:
    """Refuse a roughness that does nothing, or is none of a ground.

    Args:
        roughness: of skin and ground [m].
        robot: what walks.
        between: whether friction acts between its ends.

    Raises:
        ValueError: it is one.
    """
    not_negative("roughness", roughness, "m")
    limbs = isinstance(robot, LimbedRobot)
    if roughness != ROUGHNESS and (limbs or not between):
        where = "a robot of limbs" if limbs else "one whose contacts are its ends (see contacts)"
        raise ValueError(f"roughness is for friction between the ends of a strip and does nothing "
                         f"for {where}, got {roughness:g} m")  # fmt: skip
    bounds = _ROUGH[0], _ROUGH[1] * robot.length
    _check("roughness", (roughness,), bounds, "that of skin and ground", "m")


def check_times(gait: Gait, valves: Valves, settle_time: float, peak_pressure: float) -> None:
    """Refuse ramps, lags or a time at rest that no robot of this kind has.

    Args:
        gait: of which the longest ramp counts, as those that were measured may be short.
        valves: with their times, and a flow limit that fills a chamber in some time.
        settle_time: at rest [s].
        peak_pressure: of the robot [Pa].

    Raises:
        ValueError: there is one; the message says what may be meant.
    """
    of_robot = "that of a robot of this kind"
    _check("ramp_time", (max(gait.ramp_times),), _RAMP, of_robot, "s")
    for name in ("fill_time", "vent_time", "dead_time"):
        _check(name, _each(getattr(valves, name)), _LAG, of_robot, "s")
    fast, slow = peak_pressure / _LAG[0], peak_pressure / _RAMP[1]
    _check("flow_limit", _each(valves.flow_limit), (slow, fast), of_robot, "Pa/s")
    _check("settle_time", (settle_time,), _SETTLED, of_robot, "s")


def _each(value: float | tuple[float, ...] | None) -> tuple[float, ...]:
    """Numbers of a field that is one, several or none."""
    return value if isinstance(value, tuple) else () if value is None else (value,)


def _check(
    name: str, values: Iterable[float | None], bounds: Iterable[float], whose: str, unit: str
) -> None:
    """Refuse values out of their bounds, but 0."""
    least, most = bounds
    for value in values:
        if not value or least <= value <= most:
            continue
        smaller = (("%", 1e-2),) if unit == "1" else ((f"m{unit}", 1e-3), (f"u{unit}", 1e-6))
        middle = math.sqrt(max(least, 1e-9 * most) * most)
        near = [
            (abs(math.log(value * factor / middle)), words)
            for words, factor in readings(value, ((unit, 1.0), *smaller))
            if factor != 1 and least <= value * factor <= most and (unit != "1" or factor < 1)
        ]
        shown = f"{value:g}" if unit == "1" else f"{value:g} {unit}"
        raise ValueError(
            f"{name} must be {whose}, {_rounded(least)} to {_rounded(most)}, got {shown}"
            f"{asked([words for _, words in sorted(near)[:1]])}"
        )


def _rounded(bound: float) -> str:
    return f"{float(f'{bound:.2g}'):g}"


def check_ceiling(ceiling: float | None, friction: float, robot: AnyRobot) -> None:
    """Refuse a ceiling that a flat robot does not fit below, or that is no height.

    Args:
        ceiling: its height over the ground; None if there is none [m].
        friction: coefficient of its friction [1].
        robot: what is to pass below it.

    Raises:
        ValueError: it is one, or there is friction of none.
    """
    not_negative("ceiling_friction", friction)
    if ceiling is None:
        if friction:
            raise ValueError(f"ceiling_friction is for a ceiling, whose height must be given as "
                             f"ceiling, got {friction:g} alone")  # fmt: skip
        return
    positive("ceiling", ceiling, "m")
    flat = max(limb.strip.flat_height for limb in limbs_of(robot))
    if ceiling <= flat:
        raise ValueError(f"ceiling must be above {flat:.6g} m, the height of the flat robot, got "
                         f"{ceiling:g} m")  # fmt: skip
    if ceiling > _FAR * robot.length:
        near = [words for words, size in readings(ceiling, LENGTHS)
                if flat < ceiling * size <= robot.length]  # fmt: skip
        raise ValueError(f"ceiling must be near a robot {robot.length:g} m long, got "
                         f"{ceiling:g} m{asked(near[:1])}")  # fmt: skip
