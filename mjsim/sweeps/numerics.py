"""Choice of links and time step for a whole sweep, on its base scene."""

import math

from mjsim.files.scene_tables.tables import build
from mjsim.results.trajectory import Trajectory
from mjsim.scene import Numerics
from mjsim.simulation.checked import agreement, refinements
from mjsim.simulation.simulation import simulate
from mjsim.sweeps.plan import Plan


def picked(plan: Plan) -> tuple[Numerics, Numerics]:
    """Numerics by which body auto answers the base scene, and finer ones to confirm them on others.

    Raises:
        ValueError: no two walks agree, or the scene cannot be simulated.
    """
    scene, given = build(plan.base)
    assert plan.tolerance is not None
    before: tuple[Numerics, Trajectory] | None = None
    finer = refinements(scene, given.twists)
    for numerics in finer:
        walk = simulate(scene, numerics)
        if before is not None:
            error, agreed = agreement(before[1], walk, plan.tolerance)
            if agreed and math.isfinite(error):
                finest = next(finer, None)
                return (numerics, finest) if finest else (before[0], numerics)
        before = numerics, walk
    raise ValueError(
        f"no links and time step are sure to {plan.tolerance:g} on the base scene: take model "
        "auto, or give numerics.links and numerics.timestep in place of a tolerance"
    )
