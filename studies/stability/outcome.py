"""How one simulated walk came out, by written criteria.

Outcomes: accurate, within NEAR of the reference's displacement; drifting, finite but farther off;
wrong, the opposite way by more than a standstill; toppled, an end left the ground; diverged;
finished, where there is no reference to be near to.
"""

import math
from dataclasses import replace

from analytic import SURFACES, direction
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
    """Walk a scene and say which of OUTCOMES it was.

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
    opposite = {direction(numbers.displacement, 1.0), direction(reference, 1.0)}
    return "wrong direction" if opposite == {"forward", "backward"} else "drifting"


def tried(
    body: str,
    integrator: str,
    links: int,
    timestep: float,
    stiffness: float = 1.0,
    cycles: int = 1,
) -> str:
    """The outcome of the default gait on gelatin, of a strip so many times as stiff.

    A walk whose first cycle is not accurate does not go on.

    Stiffness scales the modulus, the pressure and the weight, but not the mass: the shapes stay,
    and with them the reference, while the strip's frequencies rise with its square root.
    """
    numerics = Setting(body, links, timestep, integrator).numerics()
    scene = replace(stiffened(stiffness), body=body)
    first = outcome(scene, numerics, exact(WALK, GROUND))
    if first != "accurate" or cycles == 1:
        return first
    return outcome(replace(scene, cycles=cycles), numerics, exact(WALK, GROUND))


def stiffened(stiffness: float) -> Scene:
    """The benchmark scene on GROUND with a strip so many times as stiff, of the same mass."""
    scene = Scene()
    base = scene.strip
    robot = replace(
        base,
        modulus=stiffness * base.modulus,
        peak_pressure=stiffness * base.peak_pressure,
        weight_per_length=stiffness * base.weight_per_length,
    )
    return replace(scene, robot=robot, ground=SURFACES[GROUND], gravity=stiffness * scene.gravity)
