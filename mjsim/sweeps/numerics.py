"""Links and time step for a whole sweep, picked on its base scene."""

from mjsim.files.tables import build
from mjsim.results.measures import measure
from mjsim.scene import Numerics
from mjsim.simulation.checked import allowed, closeness, ladder
from mjsim.simulation.simulation import simulate
from mjsim.sweeps.plan import Plan


def picked(plan: Plan) -> tuple[Numerics, Numerics]:
    """The coarsest numerics that the next finer ones confirm, and these.

    Raises:
        ValueError: none do, or the scene cannot be simulated.
    """
    scene, _ = build(plan.base)
    assert plan.tolerance is not None
    before = None
    for numerics in ladder(scene):
        walk = simulate(scene, numerics)
        step = walk.numerics.timestep
        now = measure(walk)
        if before is not None and now is not None:
            change = abs(now.displacement - before[1])
            if change <= closeness(step) * allowed(now.displacement, plan.tolerance):
                return before[0], numerics
        before = None if now is None else (numerics, now.displacement)
    raise ValueError(
        f"no links and time step are sure to {plan.tolerance:g} on the base scene: take model "
        "auto, or give numerics.links and numerics.timestep in place of a tolerance"
    )
