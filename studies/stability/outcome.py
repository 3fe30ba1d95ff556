"""The outcome of one simulated walk, by written criteria.

Outcomes: accurate, within NEAR of the reference's displacement; drifting, finite but farther off;
wrong, the opposite way by more than a standstill; toppled, an end left the ground; diverged;
finished, where there is no reference to be near to.
"""

import math
from dataclasses import replace

from analytic import SURFACES, Robot, direction
from mjsim.results.measures import measure
from mjsim.results.status import Status
from mjsim.scene import Numerics, Scene
from mjsim.simulation.simulation import simulate
from studies.accuracy.benchmark_cases import WALK, exact
from studies.accuracy.setting import Setting

OUTCOMES = ("accurate", "drifting", "wrong direction", "toppled", "diverged", "finished")
NEAR = 0.05  # relative error of an accurate displacement; chosen
GROUND = "gelatin"


def outcome(scene: Scene, numerics: Numerics, reference: float) -> str:
    """Walk a scene; returns one of OUTCOMES.

    Args:
        scene, numerics: the walk.
        reference: the displacement per cycle over L that it should have, NaN if there is none.
    """
    walk = simulate(scene, numerics)
    numbers = measure(walk)
    if walk.status is Status.UNSETTLED:
        return "drifting"
    if numbers is None:
        return "diverged" if walk.status is Status.DIVERGED else "toppled"
    if math.isnan(reference):
        return "finished"
    if abs(numbers.displacement / reference - 1) <= NEAR:
        return "accurate"
    directions = {direction(numbers.displacement, 1.0), direction(reference, 1.0)}
    return "wrong direction" if directions == {"forward", "backward"} else "drifting"


def walked(
    body: str, integrator: str, links: int, timestep: float, stiffness: float = 1.0, cycles: int = 1
) -> dict[str, str]:
    """Outcome of the default gait on gelatin, of a strip so many times as stiff.

    A walk whose first cycle is not accurate does not go on.
    """
    numerics = Setting(body, links, timestep, integrator).numerics()
    scene, reference = replace(stiffened(stiffness), body=body), exact(WALK, GROUND)
    name = outcome(scene, numerics, reference)
    if name == "accurate" and cycles > 1:
        name = outcome(replace(scene, cycles=cycles), numerics, reference)
    return {"outcome": name}


def stiffened(stiffness: float) -> Scene:
    """The benchmark scene on GROUND with a strip so many times as stiff, of the same mass.

    Stiffness scales the modulus, the pressure and the weight, but not the mass: the shapes stay,
    and with them the reference, while the strip's frequencies rise with its square root.
    """
    base = Robot()
    scaled = {name: stiffness * getattr(base, name)
              for name in ("modulus", "peak_pressure", "weight_per_length")}  # fmt: skip
    return Scene(replace(base, **scaled), ground=SURFACES[GROUND],
                 gravity=stiffness * Scene.gravity)  # fmt: skip
