"""The scenes whose numbers a redesign keeps, in SI units, told without this project's classes."""

import math
from collections.abc import Iterator
from typing import Any

import numpy as np

Case = dict[str, Any]

ROBOT: dict[str, Any] = {
    "length": 0.130, "width": 0.040, "modulus": 1.8e6, "thickness": 4.0e-3,
    "chamber_height": 4.1e-3, "chamber_fraction": 0.7, "weight_per_length": 2.0,
    "peak_pressure": 7.0 * 6894.757293168, "segments": (1.0, 1.0, 1.0),
}  # fmt: skip
STAGES: dict[str, list[str]] = {
    "wave": ["000", "100", "110", "011", "001", "000"],
    "full-wave": ["000", "100", "110", "111", "011", "001", "000"],
    "pulse": ["000", "100", "010", "001", "000"],
    "two": ["00", "10", "11", "01", "00"],
    "four": ["0000", "1000", "1100", "0110", "0011", "0001", "0000"],
}
D0_OVER_L2 = ROBOT["modulus"] * ROBOT["width"] * ROBOT["thickness"] ** 3 / 12 / ROBOT["length"] ** 2
GROUNDS = {"felt": (0.0, 1.0), "polyethylene": (0.5, 1.0), "gelatin": (1.0, 0.0)}  # over V0


def case(
    model: str,
    ground: str | tuple[float, float],
    gait: str = "wave",
    ramp: float | tuple[float, ...] = 2.0,
    robot: dict[str, Any] | None = None,
    phi: float = 1.5,
    friction: str = "constant",
    chamber: str = "linearized",
    actuation: str = "springs",
    numerics: dict[str, Any] | None = None,
    **other: Any,
) -> Case:
    """One scene; the ground is {V_t, tau} over V0 = phi D0 / L^2, as the paper gives it."""
    backward = gait.endswith("-reversed")
    stages = [[float(c) for c in stage] for stage in STAGES[gait.removesuffix("-reversed")]]
    dimensions = {**ROBOT, **(robot or {})}
    d0 = dimensions["modulus"] * dimensions["width"] * dimensions["thickness"] ** 3 / 12
    v0 = phi * d0 / dimensions["length"] ** 2
    tip, side = GROUNDS[ground] if isinstance(ground, str) else ground
    area = dimensions["width"] * dimensions["length"] / len(dimensions["segments"])
    mu0 = v0 / (0.5 * dimensions["weight_per_length"] * dimensions["length"])
    return {
        "model": model, "robot": dimensions, "phi": phi, "friction": friction, "chamber": chamber,
        "stages": stages[::-1] if backward else stages, "ramp": ramp, "actuation": actuation,
        "ground": {"tip_force": tip * v0, "shear_strength": side * v0 / area,
                   "tip_friction": tip * mu0, "friction": side * mu0},
        "over_v0": [tip, side], "slope": 0.0, "lag": 0.0, "cycles": 1, "bends": False,
        "numerics": numerics or {}, **other,
    }  # fmt: skip


def cases() -> Iterator[tuple[str, Case]]:
    """Names and scenes: models, laws, chambers, slopes, segments, settings, failures, random."""
    for model in ("modes", "obstacle", "elastica", "planar"):
        for gait in ("wave", "full-wave-reversed", "pulse"):
            for ground in GROUNDS:
                yield f"{model} {gait} {ground}", case(model, ground, gait)
    for model in ("cable", "rod"):
        for ground in GROUNDS:
            yield f"{model} {ground}", case(model, ground, numerics={"links": 12})
    for chamber in ("sealed", "constant-pressure"):
        for model in ("elastica", "planar"):
            yield f"{model} {chamber}", case(model, "gelatin", chamber=chamber)
    for law in ("constant", "coulomb"):
        for chamber in ("linearized", "constant-pressure"):
            yield (
                f"actuators {law} {chamber}",
                case("planar", "gelatin", friction=law, chamber=chamber, actuation="actuators"),
            )
    for model in ("elastica", "planar", "cable", "rod"):
        for ground in ("polyethylene", "gelatin"):
            yield f"{model} coulomb {ground}", case(model, ground, friction="coulomb", ramp=4.0,
                                                    bends=True, numerics={"links": 12})  # fmt: skip
    for law in ("constant", "coulomb"):
        for model in ("elastica", "planar"):
            yield f"{model} slope {law}", case(model, "polyethylene", friction=law, ramp=4.0,
                                               slope=math.radians(2), bends=True)  # fmt: skip
    yield "elastica bent", case("elastica", "polyethylene", phi=5.0, bends=True)
    yield "planar slides downhill", case("planar", "felt", slope=math.radians(3))
    yield "planar lag", case("planar", "felt", lag=0.2)
    yield "planar lag actuators", case("planar", "felt", lag=0.2, actuation="actuators")
    yield "planar three cycles", case("planar", "gelatin", cycles=3)
    yield "planar toppled", case("planar", "felt", robot={"peak_pressure": 72e3})
    yield "elastica branch end", case("elastica", "felt", robot={"peak_pressure": 72e3})
    yield "planar Euler diverges", case("planar", "felt", numerics={"integrator": "Euler",
                                        "timestep": 0.02, "contact_time": 2.0})  # fmt: skip
    yield "planar Euler", case("planar", "gelatin", ramp=1.0, numerics={
        "integrator": "Euler", "timestep": 0.002, "links": 6, "contact_time": 2.5,
        "steep_contact_time": 10.0})  # fmt: skip
    yield "planar pyramidal", case("planar", "gelatin", friction="coulomb",
                                   numerics={"cone": "pyramidal", "links": 12})  # fmt: skip
    for links, timestep in ((12, 0.05), (10, 0.01), (48, 0.01)):
        yield (
            f"planar {links} {timestep}",
            case("planar", "gelatin", numerics={"links": links, "timestep": timestep}),
        )
    for gait, segments in (("two", (1.0, 1.0)), ("four", (1.0,) * 4), ("wave", (2.0, 1.0, 3.0))):
        for model in ("elastica", "planar"):
            yield (
                f"{model} {len(segments)} segments {gait}",
                case(model, "felt", gait, robot={"segments": segments}),
            )
    yield "planar uneven ramps", case("planar", "felt", ramp=(2.0, 1.0, 3.0, 2.0, 1.5))
    rng = np.random.default_rng(7)
    for i in range(8):
        gamma = float(np.exp(rng.uniform(np.log(4), np.log(40))))
        robot = {"weight_per_length": round(gamma * D0_OVER_L2 / ROBOT["length"], 6),
                 "peak_pressure": round(float(rng.uniform(15e3, 55e3)))}  # fmt: skip
        gait = str(rng.choice(["wave", "full-wave", "pulse", "wave-reversed"]))
        ground = (round(float(3 * rng.uniform(0, 1)), 3), 1.0)
        for model in ("elastica", "planar"):
            yield f"{model} random {i}", case(model, ground, gait, robot=robot, ramp=3.0)
