"""MuJoCo models of robots of pneumatic limbs, checked against `analytic`.

What a user needs, imported when it is first used:

    from mjsim import SURFACES, Scene, measure, reference, simulate

    scene = Scene(ground=SURFACES["gelatin"])
    walk = simulate(scene)
    print(walk.status, measure(walk).displacement, reference(scene).displacement[0])
"""

from __future__ import annotations

from analytic.lazy import lazily

TYPE_CHECKING = False  # see analytic.lazy
if TYPE_CHECKING:
    from typing import Any

_attribute, __dir__, __all__ = lazily(
    __name__,
    {
        "analytic.friction.laws": ("Friction",),
        "analytic.prediction": ("predict",),
        "analytic.scene.actuator": ("Actuator",),
        "analytic.scene.feet": ("Foot",),
        "analytic.scene.gait": ("GAITS", "Gait"),
        "analytic.scene.ground": ("Patches",),
        "analytic.scene.limbs": ("Limb", "LimbedRobot", "quadruped"),
        "analytic.scene.payload": ("Payload",),
        "analytic.scene.quadruped_gaits": ("QUADRUPED_GAITS", "undulation"),
        "analytic.scene.robot": ("Robot",),
        "analytic.scene.surface": ("SURFACES", "Ground", "Surface"),
        "analytic.scene.tether": ("Tether",),
        "mjsim.uncertainty.sensitivity": ("sensitivity",),
        "mjsim.env.settings": ("Settings",),
        "mjsim.files.scene_tables.tables": ("build", "read_tables"),
        "mjsim.files.scene_tables.written": ("as_tables", "as_toml"),
        "mjsim.fitting.estimate": ("Estimate", "estimate"),
        "mjsim.fitting.observations": ("read_observations",),
        "mjsim.fitting.parameters": ("Parameter", "parameters"),
        "mjsim.fitting.walks": ("Predictor",),
        "mjsim.model.standalone.strips": ("standalone_spec",),
        "mjsim.optimising.objective": ("Objective",),
        "mjsim.optimising.search": ("search",),
        "mjsim.pictures.recording": ("film",),
        "mjsim.results.measures": ("Measures", "measure"),
        "mjsim.results.prediction": ("Reference", "reference"),
        "mjsim.results.record": ("record",),
        "mjsim.results.status": ("Status",),
        "mjsim.results.trajectory": ("Trajectory", "load"),
        "mjsim.scene.numerics": ("Numerics",),
        "mjsim.scene.scene": ("Scene",),
        "mjsim.scene.valves": ("Valves",),
        "mjsim.simulation.batch": ("rollout", "simulate_all"),
        "mjsim.simulation.side_by_side.simulate": ("simulate_batch",),
        "mjsim.simulation.checked": ("Checked", "walk_checked"),
        "mjsim.simulation.observation": ("Observation", "Policy"),
        "mjsim.simulation.simulation": ("Simulation", "simulate"),
        "mjsim.sweeps.plan": ("Plan", "read_plan"),
        "mjsim.sweeps.store": ("Store",),
        "mjsim.uncertainty.fields": ("read_spreads",),
        "mjsim.uncertainty.interval": ("distance_interval",),
    },
)


def __getattr__(name: str) -> Any:
    if name == "__version__":
        from importlib.metadata import version

        return version("undulator")
    return _attribute(name)
