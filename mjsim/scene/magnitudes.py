"""Questions after magnitudes that no robot of this kind has, such as 3 m of thickness for 3 mm.

The bounds go by ratios, so that a robot may be of any size: a strip is slender, as heavy as a body
is, and bends under its pressure. They lie an order of magnitude or more beyond robots that were
built; all are chosen.
"""

import math
from collections.abc import Collection
from dataclasses import replace

from analytic.checks import not_negative, positive
from analytic.scene import pneunet
from analytic.scene.ground import Patches
from analytic.scene.limbs import AnyRobot, LimbedRobot, limbs_of
from analytic.scene.robot import GRAVITY, PSI, Robot
from analytic.scene.surface import Ground

_OVER_LENGTH = {"thickness": (1e-4, 0.5), "width": (1e-3, 30.0), "chamber_height": (0.0, 1.0)}
_DENSE = (0.0, 1e5)  # kg/m^3, mass over the volume of the strain-limiting layer alone
_STIFF = (1e2, 1e12)  # Pa; gels to diamond
_BENT = 5e-3  # rad, by which the whole strip bends at its peak pressure at least
_FAR = 100.0  # L; with one more for each cycle, beyond where any robot of this kind comes
_DECADE = math.log(10.0)

_LENGTHS = (("mm", 1e-3), ("um", 1e-6), ("cm", 1e-2))
_MASSES = (("g", 1e-3), ("mg", 1e-6))
_PRESSURES = (("kPa", 1e3), ("psi", PSI), ("MPa", 1e6), ("bar", 1e5))


def check_robot(robot: AnyRobot, given: Collection[str] = ()) -> None:
    """Refuse a robot of which a magnitude is none, with what may be meant.

    Args:
        robot: its limbs.
        given: names of what was given, of which one is named rather than what follows from it.

    Raises:
        ValueError: there is one.
    """
    for limb in limbs_of(robot):
        where = f"limb {limb.name!r}: " if isinstance(robot, LimbedRobot) else ""
        message = _wrong(limb.strip, given)
        if message:
            raise ValueError(f"{where}{message}")
    if isinstance(robot, Robot) and pneunet.turn_number(robot) < _BENT:
        raise ValueError(_unbent(robot, given))


def check_ground(ground: Ground, length: float, cycles: int) -> None:
    """Refuse a patch that a robot cannot come to, with what may be meant.

    Args:
        ground: of which patches have borders.
        length: of the robot, L [m].
        cycles: that it walks.

    Raises:
        ValueError: there is one.
    """
    reach = (_FAR + cycles) * length
    for border in ground.borders if isinstance(ground, Patches) else ():
        if abs(border) > reach:
            near = [(unit, border) for unit, size in _LENGTHS if abs(border * size) <= 10 * length]
            raise ValueError(
                f"from must be where a robot {length:g} m long may come, got a patch from "
                f"{border:g} m{_asked(near[:1])}"
            )


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
        near = [(unit, ceiling) for unit, size in _LENGTHS
                if flat < ceiling * size <= robot.length]  # fmt: skip
        raise ValueError(f"ceiling must be near a robot {robot.length:g} m long, got "
                         f"{ceiling:g} m{_asked(near[:1])}")  # fmt: skip


def _wrong(strip: Robot, given: Collection[str]) -> str | None:
    """Message about a magnitude that is none."""
    name = _disproportion(strip)
    if name:
        subject = max((name, "length"), key=lambda field: _strange(strip, field))
        other = "length" if subject == name else name
        value = getattr(strip, subject)
        return (f"{subject} must be that of a robot of this kind, got {value:g} m beside a {other} "
                f"of {getattr(strip, other):g} m{_meant(strip, subject, _LENGTHS)}")  # fmt: skip
    if not _STIFF[0] <= strip.modulus <= _STIFF[1]:
        name = "rigidity" if "rigidity" in given else "modulus"
        return (f"{name} must be that of a soft body, got a modulus of {strip.modulus:g} Pa"
                f"{_meant(strip, 'modulus', _PRESSURES)}")  # fmt: skip
    if not _DENSE[0] <= _density(strip) <= _DENSE[1]:
        name = "weight_per_length" if "weight_per_length" in given else "mass"
        mass = strip.weight / GRAVITY
        near = [(unit, mass) for unit, size in _MASSES
                if _DENSE[0] <= _density(strip) * size <= _DENSE[1]]  # fmt: skip
        return (f"{name} must be that of a robot of this kind, got {mass:g} kg, "
                f"{_density(strip):.2g} kg/m^3 of its layer{_asked(near[:1])}")  # fmt: skip
    return None


def _unbent(robot: Robot, given: Collection[str]) -> str:
    """Message about a strip that its pressure does not bend."""
    turn = f"bends all of it by {math.degrees(pneunet.turn_number(robot)):.2g} degrees"
    if _strange(robot, "modulus") > _strange(robot, "peak_pressure"):
        name = "rigidity" if "rigidity" in given else "modulus"
        return (f"{name} must be such that the strip bends, got a modulus of {robot.modulus:g} Pa: "
                f"{robot.peak_pressure:g} Pa {turn}")  # fmt: skip
    return (
        f"peak_pressure must be such that the strip bends, got {robot.peak_pressure:g} Pa, "
        f"which {turn}{_meant(robot, 'peak_pressure', _PRESSURES)}"
    )


def _disproportion(strip: Robot) -> str:
    """Name of a field that is out of proportion to the length, or nothing."""
    for name, (least, most) in _OVER_LENGTH.items():
        if not least <= getattr(strip, name) / strip.length <= most:
            return name
    return ""


def _strange(strip: Robot, name: str) -> float:
    """Distance of a field from the default robot's, as a logarithm."""
    return abs(math.log(getattr(strip, name) / getattr(Robot, name)))


def _density(strip: Robot) -> float:
    """Mass over the volume of the strain-limiting layer [kg/m^3]."""
    return strip.weight_per_length / (GRAVITY * strip.width * strip.thickness)


def _meant(strip: Robot, name: str, units: tuple[tuple[str, float], ...]) -> str:
    """Question after the value in the units with which the robot would be most usual."""
    value, fitting = getattr(strip, name), []
    for unit, size in units:
        other = replace(strip, **{name: value * size})
        bends = name != "peak_pressure" or _BENT <= pneunet.turn_number(other) < 2 * math.pi
        nearer = _strange(other, name) < _strange(strip, name)
        if bends and nearer and name != _disproportion(other):
            fitting.append((_strange(other, name), unit))
    fitting.sort()
    return _asked([(unit, value) for far, unit in fitting if far < fitting[0][0] + _DECADE][:2])


def _asked(values: list[tuple[str, float]]) -> str:
    words = " or ".join(f"{value:g} {unit}" for unit, value in values)
    return f"; did you mean {words}?" if words else ""
