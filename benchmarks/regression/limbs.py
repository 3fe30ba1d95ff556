"""The scenes of limbs whose numbers a redesign keeps: tables of scene files, in SI units."""

import itertools
from collections.abc import Iterator
from typing import Any

import numpy as np

Case = dict[str, Any]

V0, TAU0, MU0 = 0.034, 0.034 * 3 / (0.040 * 0.130), 0.37  # the paper's bounds, and a coefficient
SURFACES = {"felt": (0.0, 1.0), "polyethylene": (0.5, 1.0), "gelatin": (1.0, 0.0)}
QUADRUPED = ("torso", "rear-left", "rear-right", "front-left", "front-right")
# what a number is known to lack, and what will change it
TWIST = "limbs of silicone twist as easily as they bend, and these do not"
LINKS = "not converged in hinges and steps"
TIES = "limbs in a line whose ends resist alike go otherwise than the strip, in both models"


def ground(tip: float, side: float, **other: float) -> Case:
    """Bounds over the paper's, and the coefficients that go with them."""
    return {"tip_force": tip * V0, "shear_strength": side * TAU0,
            "tip_friction": tip * MU0, "friction": side * MU0, **other}  # fmt: skip


def case(
    robot: Case,
    gait: Case,
    where: Case | str,
    ramp: float = 4.0,
    friction: str = "constant",
    awaits: tuple[str, ...] = (),
    theory: bool = True,
    hinges: int = 4,
    timestep: float = 0.02,
    twists: int = 0,
    **numerics: Any,
) -> Case:
    """One scene, and what its numbers are known to lack."""
    here = ground(*SURFACES[where]) if isinstance(where, str) else where
    return {
        "tables": {"robot": robot, "gait": {"ramp_time": ramp, **gait}, "ground": here,
                   "numerics": {"friction": friction, "timestep": timestep, "twists": twists,
                                **numerics}},
        "hinges": hinges, "awaits": awaits, "theory": theory,
    }  # fmt: skip


def limb(name: str, length: float, width: float, mass: float, *place: Any) -> Case:
    """A limb: the one that carries it, at which end, angle in plan [deg] and offset [m]."""
    keys = ("on", "at", "angle_deg", "offset")
    return {"name": name, "length": length, "width": width, "mass": mass,
            **dict(zip(keys, place, strict=False))}  # fmt: skip


def stages(*words: str) -> Case:
    """A gait of stages, a digit a limb."""
    return {"stages": [[float(digit) for digit in word] for word in words]}


def star(count: int, first: float = 0.0) -> Case:
    """A short trunk with limbs all round one of its ends."""
    trunk = limb("trunk", 0.02, 0.02, 0.002)
    turn = 360 / count
    legs = [limb(f"leg-{i}", 0.05, 0.015, 0.005, "trunk", "end", first + turn * i)
            for i in range(count)]  # fmt: skip
    return {"limbs": [trunk, *legs]}


def pairs(count: int, torso: float = 0.012) -> Case:
    """Torsos in a chain, a pair of legs at the first end and at each joint."""
    limbs = [limb("torso-1", 0.045, 0.032, torso)]
    for i in range(2, count):
        limbs.append(limb(f"torso-{i}", 0.045, 0.032, torso, f"torso-{i - 1}", "end", 0.0))
    for i in range(count):
        at = ("torso-1", "begin") if i == 0 else (f"torso-{i}", "end")
        for side, angle in (("left", 20.0), ("right", -20.0)):
            angle = 180.0 - angle if i == 0 else angle if i == count - 1 else 4 * angle
            offset = 0.009 if side == "left" else -0.009
            limbs.append(limb(f"{side}-{i + 1}", 0.048, 0.0135, 0.0056, *at, angle, offset))
    return {"limbs": limbs}


STRIP = {"limbs": [limb("torso", 0.13 / 3, 0.04, 0.00625),
                   limb("rear", 0.13 / 3, 0.04, 0.00625, "torso", "begin", 180.0),
                   limb("front", 0.13 / 3, 0.04, 0.00625, "torso", "end", 0.0)]}  # fmt: skip
TWO_LEGS = {
    "limbs": [
        limb("torso", 0.06, 0.02, 0.006),
        limb("left", 0.05, 0.0135, 0.005, "torso", "end", 40.0, 0.004),
        limb("right", 0.05, 0.0135, 0.005, "torso", "end", -40.0, -0.004),
    ]
}
BRANCHED = {"limbs": [limb("trunk", 0.06, 0.03, 0.008),
                      limb("arm", 0.05, 0.02, 0.005, "trunk", "end", 30.0),
                      limb("hand", 0.04, 0.015, 0.003, "arm", "end", -20.0),
                      limb("tail", 0.06, 0.02, 0.006, "trunk", "begin", 170.0)]}  # fmt: skip
ONE = {"limbs": [limb("solo", 0.13, 0.04, 0.018)]}
NAMED = {"name": "quadruped"}


def of_named() -> Iterator[tuple[str, Case]]:
    """The quadruped: gaits, laws, sides unlike, wet and patched ground, speeds, failures."""
    for name in ("wave", "full-wave", "pulse"):
        for where in SURFACES:
            yield f"{name} {where}", case(NAMED, {"name": name}, where, awaits=(TWIST,))
    for where in SURFACES:
        yield f"wave-reversed {where}", case(NAMED, {"reverse": True}, where, awaits=(TWIST,))
        for left in (0.7, 0.4):
            yield f"left {left} {where}", case(NAMED, {"left": left}, where, awaits=(TWIST,))
        yield f"spin {where}", case(NAMED, {"name": "spin"}, where, awaits=(TWIST,), theory=False)
        yield f"crawl {where}", case(NAMED, {"name": "crawl"}, where, awaits=(TWIST,),
                                     theory=where != "felt")  # fmt: skip
        there = ground(0.4, 0.8) if where == "felt" else where
        yield f"coulomb {where}", case(NAMED, {"right": 0.8}, there, friction="coulomb",
                                       awaits=(TWIST,))  # fmt: skip
    for where, left in itertools.product(SURFACES, (1.0, 0.7)):
        yield f"twisting left {left:g} {where}", case(NAMED, {"left": left}, where, twists=2)
    yield "twisting coulomb", case(NAMED, {"right": 0.8}, ground(0.4, 0.8), friction="coulomb",
                                   twists=2)  # fmt: skip
    for viscosity in (100.0, 3000.0):
        wet = ground(0.5, 1.0, viscosity=viscosity)
        yield f"wet {viscosity:g}", case(NAMED, {"left": 0.8}, wet, awaits=(TWIST,))
        film = {"viscosity": viscosity}
        yield f"film {viscosity:g}", case(NAMED, {}, film, awaits=(TWIST,))
    felt, gelatin = (ground(*SURFACES[name]) for name in ("felt", "gelatin"))
    for name, patches in {
        "felt gelatin": [felt, {"from": 0.06, **gelatin}],
        "gelatin felt": [gelatin, {"from": 0.03, **felt}],
        "felt wet": [felt, {"from": 0.05, **felt, "viscosity": 500.0}],
    }.items():
        yield f"patches {name}", case(NAMED, {"left": 0.9}, {"patches": patches}, awaits=(TWIST,))
    for ramp in (0.5, 1.0, 16.0):
        yield f"ramp {ramp:g} s", case(NAMED, {"left": 0.8}, "gelatin", ramp, awaits=(TWIST,),
                                       theory=False, timestep=0.01)  # fmt: skip
    yield "two cycles", case(NAMED, {"left": 0.8}, "felt", cycles=2, awaits=(TWIST,), theory=False)
    yield "light", case(NAMED, {}, "gelatin", gravity=3.0, awaits=(TWIST,), theory=False)
    soft = {**NAMED, "modulus": 1.2e6, "peak_pressure": 30e3}
    yield "soft", case(soft, {}, "gelatin", awaits=(TWIST,))
    yield "step too long", case(NAMED, {}, "felt", timestep=0.1, theory=False)
    yield "twelve hinges", case(NAMED, {}, "felt", hinges=12, timestep=0.01, theory=False,
                                awaits=(TWIST,))  # fmt: skip


def of_others() -> Iterator[tuple[str, Case]]:
    """Robots of one to six legs, a strip, a heavy torso, a turned trunk, failures."""
    arch = stages("000", "010", "110", "101", "001", "000")
    for where in SURFACES:
        tied = () if where == "felt" else (TIES,)
        yield f"strip {where}", case(STRIP, arch, where, awaits=tied)
        yield (
            f"one {where}",
            case(ONE, stages("0", "1", "0"), where, theory=False, hinges=24, timestep=0.005),
        )  # a strip: it comes back
    yield "strip coulomb", case(STRIP, arch, ground(0.5, 1.0), friction="coulomb")
    heavy = {"limbs": [{**part, "mass": 0.017669045} for part in STRIP["limbs"]]}
    outer = stages("000", "010", "011", "001", "000")
    yield "strip on its middle", case(heavy, outer, "felt", 8.0)
    torso = {"limbs": pairs(2)["limbs"]}
    torso["limbs"][0] = {**torso["limbs"][0], "mass": 0.1}
    legs = stages("00000", "01100", "01111", "00011", "00000")
    for where in ("felt", "gelatin"):
        yield f"heavy torso {where}", case(torso, legs, where, 8.0, awaits=(TWIST,))
    kick = stages("000", "011", "111", "100", "000")
    for where in SURFACES:
        there = ground(0.0, 1.0) if where == "felt" else where
        yield f"two legs {where}", case(TWO_LEGS, kick, there, awaits=(TWIST,))
    yield "two legs coulomb", case(TWO_LEGS, kick, ground(0.0, 1.0), friction="coulomb",
                                   awaits=(TWIST,))  # fmt: skip
    three = stages("0000", "0100", "0110", "0011", "0001", "0000")
    for where in SURFACES:
        yield f"three legs {where}", case(star(3), three, where, hinges=6,
                                          awaits=(LINKS, TWIST))  # fmt: skip
    yield "three legs twisting", case(star(3), three, "gelatin", hinges=6, twists=3,
                                      awaits=(LINKS,))  # fmt: skip
    turned = star(3, 90.0)
    turned["limbs"][0] = {**turned["limbs"][0], "angle_deg": 90.0}
    yield "three legs turned", case(turned, three, "gelatin", hinges=6,
                                    awaits=(LINKS, TWIST))  # fmt: skip
    four = stages("00000", "01000", "01100", "00110", "00011", "00000")
    yield "star of four", case(star(4, 45.0), four, "gelatin", awaits=(TWIST,))
    six = stages("00000000", "00110000", "10111100", "01001111", "00000011", "00000000")
    for where in ("felt", "gelatin"):
        yield f"six legs {where}", case(pairs(3), six, where, awaits=(TWIST,), hinges=2)
    branched = stages("0000", "0001", "1001", "1100", "0110", "0000")
    for where in SURFACES:
        yield f"branched {where}", case(BRANCHED, branched, where, awaits=(TWIST,))
    tall = {**TWO_LEGS, "peak_pressure": 90e3}
    yield "kicks", case(tall, stages("000", "010", "000"), "felt", 0.5, theory=False)


def of_chance(count: int = 12) -> Iterator[tuple[str, Case]]:
    """Trees of two to five limbs at random, both laws."""
    rng = np.random.default_rng(11)
    for number in range(count):
        legs = int(rng.integers(1, 5))
        limbs = [limb("trunk", float(rng.uniform(0.03, 0.07)), float(rng.uniform(0.02, 0.04)),
                      float(rng.uniform(0.004, 0.012)))]  # fmt: skip
        for i in range(legs):
            at = "end" if rng.random() < 0.6 else "begin"
            angle = float(rng.uniform(-60, 60)) + (180.0 if at == "begin" else 0.0)
            limbs.append(limb(f"leg-{i}", float(rng.uniform(0.03, 0.06)), 0.015,
                              float(rng.uniform(0.003, 0.007)), "trunk", at, angle))  # fmt: skip
        rows = np.round(rng.uniform(0, 1, (3, legs + 1)) * (rng.random((3, legs + 1)) < 0.7), 2)
        flat = [0.0] * (legs + 1)
        gait = {"stages": [flat, *rows.tolist(), flat]}
        where = ground(round(float(rng.uniform(0, 1.5)), 3), round(float(rng.uniform(0.2, 1.5)), 3))
        law = "coulomb" if number % 3 == 2 else "constant"
        awaits = (TWIST, LINKS)
        yield f"random {number}", case({"limbs": limbs}, gait, where, friction=law, awaits=awaits)


def cases() -> Iterator[tuple[str, Case]]:
    """Names and scenes."""
    for family, scenes in (
        ("quadruped", of_named()),
        ("limbs", of_others()),
        ("limbs", of_chance()),
    ):
        for name, scene in scenes:
            yield f"{family} {name}", scene
