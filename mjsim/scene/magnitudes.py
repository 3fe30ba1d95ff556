"""Questions after magnitudes that no robot of this kind has, such as 3 m of thickness for 3 mm.

The bounds go by ratios, so that a robot may be of any size: a strip is slender, as heavy as a body
is, and bends under its pressure. They lie an order of magnitude or more beyond robots that were
built; all are chosen. Those of grounds and times: mjsim.scene.surroundings.
"""

import math
from collections.abc import Collection, Iterator
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from analytic.scene import pneunet
from analytic.scene.feet import drops
from analytic.scene.limbs import AnyRobot, LimbedRobot, limbs_of
from analytic.scene.robot import GRAVITY, PSI, Robot

_OVER_LENGTH = {"thickness": (1e-4, 0.5), "width": (1e-3, 30.0), "chamber_height": (0.0, 1.0)}
_DENSE = (10.0, 1e5)  # kg/m^3, mass over the volume of the strain-limiting layer alone
_STIFF = (1e2, 1e12)  # Pa; gels to diamond
_BENT = 5e-3  # rad, by which the whole strip bends at its peak pressure at least
_STIFFENED = 100.0  # times its rigidity without pressure, at the peak
_LADEN = 100.0  # times its own mass, that a robot carries
_PROUD = 0.25  # of its length, that a foot drops below its underside: as high as it arches
_HELD = 20.0  # times its weight, that friction of constant bound holds it by
_SLOWEST = 1e-3  # of its length in a second, at which damping holds it so; chosen
_ROUNDING = 1e-6  # of a pressure in a file
_DECADE = math.log(10.0)
_BENDS = ("peak_pressure", "chamber_height")  # fields of which a meant one must bend the strip
_BENDING = ("peak_pressure", "modulus", "thickness", "chamber_height", "chamber_fraction")

Units = tuple[tuple[str, float], ...]  # names and sizes

LENGTHS = (("mm", 1e-3), ("um", 1e-6), ("cm", 1e-2))
_FORCES = (("mN", 1e-3), ("uN", 1e-6))
_MASSES = (("g", 1e-3), ("mg", 1e-6))
_UP = (1e3, 1e6)  # factors that a value may be too small by
_PRESSURES = (("kPa", 1e3), ("psi", PSI), ("MPa", 1e6), ("bar", 1e5))


def check_robot(robot: AnyRobot, given: Collection[str] = (), gravity: float = GRAVITY) -> None:
    """Refuse a robot of which a magnitude is none, with what may be meant.

    Args:
        robot: its limbs.
        given: names of what was given, of which one is named rather than what follows from it.
        gravity: under which it has its weight [m/s^2].

    Raises:
        ValueError: there is one.
    """
    for limb in limbs_of(robot):
        where = f"limb {limb.name!r}: " if isinstance(robot, LimbedRobot) else ""
        message = _wrong(limb.strip, given, gravity)
        if message:
            raise ValueError(f"{where}{message}")
        _check_measured(limb.strip, robot.peak_pressure, where)
    _check_payload(robot)
    _check_feet(robot)
    _check_bounds(robot)
    _check_damping(robot)
    if isinstance(robot, Robot) and pneunet.turn_number(robot) < _BENT:
        raise ValueError(_unbent(robot, given))


def _check_payload(robot: AnyRobot) -> None:
    """Refuse a payload that no robot of this mass could carry."""
    bare = robot.weight / GRAVITY - robot.payload_mass
    heaviest = max(
        (payload.mass for limb in limbs_of(robot) for payload in limb.strip.payload), default=0.0
    )
    if heaviest <= _LADEN * bare:
        return
    near = [words for words, scale in readings(heaviest, _MASSES) if heaviest * scale <= bare]
    raise ValueError(f"payload: mass must be one that a robot of {bare:.3g} kg carries, got "
                     f"{heaviest:g} kg{asked(near[:1])}")  # fmt: skip


def _check_feet(robot: AnyRobot) -> None:
    """Refuse a foot that a strip would stand on as on a stilt."""
    for limb in limbs_of(robot):
        drop, most = max(drops(limb.strip.feet)), _PROUD * limb.strip.length
        if drop <= most:
            continue
        near = [words for words, scale in readings(drop, LENGTHS) if drop * scale <= most]
        raise ValueError(f"feet: drop must be at most a quarter of the length, {most:.2g} m, got "
                         f"{drop:g} m{asked(near[:1])}")  # fmt: skip


def _check_bounds(robot: AnyRobot) -> None:
    """Refuse bounds of a tether or a foot, whatever its load, that are none for its weight."""
    most = _HELD * robot.weight
    for limb in limbs_of(robot):
        tether = limb.strip.tether
        bounds = [("tether: drag", tether.drag if tether else 0.0),
                  *(("feet: hold", foot.hold) for foot in limb.strip.feet)]  # fmt: skip
        for name, bound in bounds:
            if bound <= most:
                continue
            near = [words for words, scale in readings(bound, _FORCES) if bound * scale <= most]
            raise ValueError(f"{name} must be one for a robot of {robot.weight:.2g} N, got "
                             f"{bound:g} N{asked(near[:1])}")  # fmt: skip


def _check_damping(robot: AnyRobot) -> None:
    """Refuse damping of a foot that no motion of a robot of this weight would overcome."""
    most = _HELD * robot.weight / (_SLOWEST * robot.length)
    for limb in limbs_of(robot):
        for foot in limb.strip.feet:
            if foot.damping > most:
                raise ValueError(
                    f"feet: damping must be one for a robot of {robot.weight:.2g} N, at most "
                    f"{most:.2g} N s/m, got {foot.damping:g} N s/m"
                )


def _check_measured(strip: Robot, peak_pressure: float, where: str) -> None:
    """Refuse a peak pressure beyond those at which an actuator was measured."""
    highest = min((curve.highest for curve in strip.actuators if curve), default=math.inf)
    if peak_pressure > highest * (1 + _ROUNDING):
        raise ValueError(f"{where}peak_pressure must be at most {highest:.6g} Pa, up to which the "
                         f"actuator was measured, got {peak_pressure:g}")  # fmt: skip


def fullest(strip: Robot, peak_pressure: float, stages: NDArray[np.float64]) -> float:
    """Part of a strip that is at the peak, at most, in stages of (N, S) fractions of it [1].

    A segment counts by how much its actuator bends beside the one that bends most.
    """
    bends = np.array([float(curve.curvature_at(peak_pressure)) if curve else 1.0
                      for curve in strip.actuators])  # fmt: skip
    parts = bends / bends.max() if bends.any() else bends
    return float((np.abs(stages) @ (parts * np.diff(strip.borders))).max())


def check_turn(
    strip: Robot, peak_pressure: float, fullest: float, gait: str, what: str = "this strip"
) -> None:
    """Refuse pressures at which a strip closes into a circle.

    Args:
        strip: its length, modulus, chambers.
        peak_pressure: of the robot that it is, or is a limb of [Pa].
        fullest: part of the strip that is at the peak, at most, in the gait's stages [1].
        gait: name of the gait.
        what: closes.

    Raises:
        ValueError: it does.
    """
    if strip.actuator is not None:
        _check_curves(strip, peak_pressure, fullest, gait, what)
        return
    turn = pneunet.curvature_per_pressure(strip) * peak_pressure * strip.length * fullest
    if turn < 2 * math.pi:
        return
    limit, hint = 2 * math.pi / turn * peak_pressure, ""
    if limit < 0.1 * peak_pressure:
        hint = (f"; is its length {strip.length:g} m, its modulus {strip.modulus:g} Pa, "
                f"its thickness {strip.thickness:g} m?")  # fmt: skip
    raise ValueError(
        f"peak_pressure must be below {limit:.6g} Pa, where gait {gait} would close {what} into a "
        f"circle, got {peak_pressure:g}{hint}"
    )


def _check_curves(strip: Robot, peak: float, fullest: float, gait: str, what: str) -> None:
    """See check_turn, for measured curves; the widest of them counts where they differ."""
    curvature = max(float(curve.curvature_at(peak)) for curve in strip.actuators if curve)
    turn = curvature * strip.length * fullest
    if turn >= 2 * math.pi:
        raise ValueError(
            f"peak_pressure must be less, as the actuator bends by {curvature:.4g} 1/m there and "
            f"gait {gait} would close {what} into a circle, got {peak:g} Pa"
        )


def _wrong(strip: Robot, given: Collection[str], gravity: float) -> str | None:
    """Message about a magnitude that is none."""
    name = _disproportion(strip)
    if name:
        subject = max((name, "length"), key=lambda field: _strange(strip, field))
        other = "length" if subject == name else name
        value = getattr(strip, subject)
        return (f"{subject} must be that of a robot of this kind, got {value:g} m beside a {other} "
                f"of {getattr(strip, other):g} m{_meant(strip, subject, LENGTHS)}")  # fmt: skip
    if not _STIFF[0] <= strip.modulus <= _STIFF[1]:
        name = "rigidity" if "rigidity" in given else "modulus"
        return (f"{name} must be that of a soft body, got a modulus of {strip.modulus:g} Pa"
                f"{_meant(strip, 'modulus', _PRESSURES) if name == 'modulus' else ''}")  # fmt: skip
    density = _density(strip, min(gravity, GRAVITY))  # a small weight may be that of little gravity
    if density < _DENSE[0] or _density(strip, GRAVITY) > _DENSE[1]:
        name = "weight_per_length" if "weight_per_length" in given else "mass"
        mass = strip.weight / GRAVITY - strip.payload_mass
        near = [words for words, scale in readings(mass, _MASSES)
                if _DENSE[0] <= _density(strip, GRAVITY) * scale <= _DENSE[1]]  # fmt: skip
        return (f"{name} must be that of a robot of this kind, got {mass:g} kg, "
                f"{_density(strip, GRAVITY):.2g} kg/m^3 of its layer{asked(near[:1])}")  # fmt: skip
    stiffened = pneunet.rigidity_per_pressure(strip) * strip.peak_pressure
    if stiffened > _STIFFENED * pneunet.base_rigidity(strip) and strip.rigidity_per_pressure:
        return (f"rigidity_per_pressure must be that of a robot of this kind, got "
                f"{strip.rigidity_per_pressure:g} N m^2/Pa, which makes it "
                f"{stiffened / pneunet.base_rigidity(strip):.2g} times as stiff")  # fmt: skip
    return None


def _unbent(robot: Robot, given: Collection[str]) -> str:
    """Message about a strip that its pressure does not bend."""
    turn = f"bends all of it by {math.degrees(pneunet.turn_number(robot)):.2g} degrees"
    if robot.actuator is not None:
        return f"actuator must be such that the strip bends: {robot.peak_pressure:g} Pa {turn}"
    name = max(_BENDING, key=lambda field: _strange(robot, field))
    if robot.curvature_per_pressure is not None:  # in place of what follows from the others
        curved = robot.curvature_per_pressure / pneunet.curvature_per_pressure(Robot())
        name = ("curvature_per_pressure" if abs(math.log(curved)) > _strange(robot, _BENDING[0])
                else _BENDING[0])  # fmt: skip
    value = getattr(robot, name)
    if name == "modulus":
        name = "rigidity" if "rigidity" in given else name
        return (f"{name} must be such that the strip bends, got a modulus of {value:g} Pa: "
                f"{robot.peak_pressure:g} Pa {turn}")  # fmt: skip
    if name == "peak_pressure":
        return (f"{name} must be such that the strip bends, got {value:g} Pa, which {turn}"
                f"{_meant(robot, name, _PRESSURES)}")  # fmt: skip
    units = LENGTHS if name in _OVER_LENGTH else ()
    asked = _meant(robot, name, units) if units else ""
    return (f"{name} must be such that the strip bends, got {value:g}{' m' if units else ''}: "
            f"{robot.peak_pressure:g} Pa {turn}{asked}")  # fmt: skip


def _disproportion(strip: Robot) -> str:
    """Name of a field that is out of proportion to the length, or nothing."""
    for name, (least, most) in _OVER_LENGTH.items():
        if not least <= getattr(strip, name) / strip.length <= most:
            return name
    return ""


def _strange(strip: Robot, name: str) -> float:
    """Distance of a field from the default robot's, as a logarithm."""
    return abs(math.log(getattr(strip, name) / getattr(Robot, name)))


def _density(strip: Robot, gravity: float) -> float:
    """Mass over the volume of the strain-limiting layer, under a gravity [kg/m^3]."""
    return strip.weight_per_length / (gravity * strip.width * strip.thickness)


def readings(value: float, units: Units) -> Iterator[tuple[str, float]]:
    """Ways in which a value in SI may have been meant, in words, and by what factor they change it.

    In a smaller or a larger unit of those given, or in the first of them by a thousand too small.
    """
    for unit, size in units:
        yield f"{value:g} {unit}", size
    unit, size = units[0]
    for factor in (factor for factor in _UP if factor not in dict(units).values()):
        yield f"{value * factor / size:g} {unit}", factor


def _meant(strip: Robot, name: str, units: Units) -> str:
    """Question after the value in the units with which the robot would be most usual."""
    fitting = []
    for words, factor in readings(getattr(strip, name), units):
        other = replace(strip, **{name: getattr(strip, name) * factor})
        bends = name not in _BENDS or _BENT <= pneunet.turn_number(other) < 2 * math.pi
        nearer = _strange(other, name) < _strange(strip, name)
        if bends and nearer and name != _disproportion(other):
            fitting.append((_strange(other, name), words))
    fitting.sort()
    near = [words for far, words in fitting if far < fitting[0][0] + _DECADE]
    return asked(near[:2])


def asked(readings: list[str]) -> str:
    """Question after what may be meant, or nothing."""
    return f"; did you mean {' or '.join(readings)}?" if readings else ""
