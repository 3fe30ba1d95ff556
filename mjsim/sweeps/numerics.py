"""Choice of links and time step for a whole sweep, on its base scene."""

from mjsim.files.tables import build
from mjsim.results.measures import measure
from mjsim.scene import Numerics
from mjsim.simulation.checked import allowed, closeness, refinements
from mjsim.simulation.simulation import simulate
from mjsim.sweeps.plan import Plan


def picked(plan: Plan) -> tuple[Numerics, Numerics]:
    """Coarsest numerics that the next finer ones confirm, and those finer ones.

    Raises:
        ValueError: none do, or the scene cannot be simulated.
    """
    scene, given = build(plan.base)
    assert plan.tolerance is not None
    previous = None
    for numerics in refinements(scene, given.twists):
        walk = simulate(scene, numerics)
        measures = measure(walk)
        if previous is not None and measures is not None:
            shift = measures.displacement
            if abs(shift - previous[1]) <= closeness(walk.numerics.timestep) * allowed(
                shift, plan.tolerance
            ):
                return previous[0], numerics
        previous = None if measures is None else (numerics, measures.displacement)
    raise ValueError(
        f"no links and time step are sure to {plan.tolerance:g} on the base scene: take model "
        "auto, or give numerics.links and numerics.timestep in place of a tolerance"
    )
