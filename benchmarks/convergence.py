"""Print what the planar model's error is made of: `make numbers`.

First the error's budget: each parameter changed alone from the default to where it should no longer
matter, and what that changes, in displacement over L. Then each over its range. The sum of felt and
gelatin, exact opposites in theory, is given over their size.
"""

from dataclasses import fields, replace

import numpy as np

from analytic import SOLVERS, SURFACES, Friction, Surface, predict
from mjsim.results.measures import measure
from mjsim.results.trajectory import Trajectory
from mjsim.scene import Numerics, Scene
from mjsim.simulation.simulation import simulate

DEFAULT = Scene()
SCENE_PARAMETERS = {field.name for field in fields(Scene)}
BUDGET: dict[str, dict[str, float]] = {
    "gait four times as slow": {"ramp_time": 8.0},
    "time step a fifth": {"timestep": 0.002},
    "links four times": {"links": 96},
    "contacts twice as soft": {"contact_time": 1.0},
    "steep ends as firm as others": {"steep_contact_time": 0.5},
    "side below 0.3 mrad, not 1": {"side_angle": 3e-4},
    "joint damping a fifth": {"damping_time": 0.001},
    "all of them (contacts left)": {
        "ramp_time": 8.0, "timestep": 0.002, "links": 48, "side_angle": 3e-4, "damping_time": 0.001,
    },
}  # fmt: skip


def walk(surface: Surface, changes: dict[str, float]) -> Trajectory:
    settings = dict(changes)
    scene = replace(DEFAULT, ground=surface)
    if "ramp_time" in settings:
        scene = replace(scene, gait=replace(scene.gait, ramp_time=settings.pop("ramp_time")))
    if "strength" in settings:
        factor = settings.pop("strength")
        ground = replace(surface, tip_force=factor * surface.tip_force,
                         shear_strength=factor * surface.shear_strength)  # fmt: skip
        scene = replace(scene, ground=ground)
    scene_settings = {name: settings.pop(name) for name in SCENE_PARAMETERS & settings.keys()}
    return simulate(replace(scene, **scene_settings), replace(Numerics(), **settings))  # type: ignore[arg-type]


def displacement(surface: Surface, changes: dict[str, float]) -> float:
    numbers = measure(walk(surface, changes))
    return numbers.displacement if numbers else float("nan")


def theory(surface: Surface, tension: float = 1.0) -> float:
    """Displacement over L by the elastica, the strip bent by so much of the friction."""
    robot, friction = DEFAULT.robot, Friction(tension=tension)
    walk = predict(robot, DEFAULT.gait, surface, states_per_ramp=100, friction=friction)
    return walk.locomotion.per_cycle / robot.length


def budget() -> None:
    surfaces = SURFACES.values()
    default = np.array([displacement(surface, {}) for surface in surfaces])
    exact = np.array([theory(surface) for surface in surfaces])
    weak = np.array([theory(surface, 0.0) for surface in surfaces])

    def row(label: str, values: np.ndarray) -> None:
        print(f"{label:<42}{''.join(f'{value:>+14.5f}' for value in values)}", flush=True)

    print(f"{'displacement/L':<42}{''.join(f'{surface.name:>14}' for surface in surfaces)}")
    row("elastica, friction weak", weak)
    row("elastica, bent by friction", exact)
    row("MuJoCo, default", default)
    row("error", default - exact)
    print("what a change of one parameter does to it")
    for label, changes in BUDGET.items():
        shift = np.array([displacement(surface, changes) for surface in surfaces])
        row(f"  {label}", shift - default)
        if len(changes) > 1:
            row("error left then", shift - exact)
    print()


def line(label: str, **changes: float) -> None:
    cells, shifts, speed = [], {}, []
    for name, surface in SURFACES.items():
        result = walk(surface, changes)
        numbers = measure(result)
        shifts[name] = numbers.displacement if numbers else float("nan")
        cells.append(f"{shifts[name]:>+14.4f}" if numbers else f"{result.status:>14}")
        speed.append(len(result.time) * result.numerics.timestep / result.wall_time)
    odd = (shifts["felt"] + shifts["gelatin"]) / shifts["felt"]
    print(f"{label:<28}{''.join(cells)}{100 * odd:>+9.1f} %{max(speed):>9.0f} x", flush=True)


def main() -> None:
    budget()
    print(f"{'displacement/L':<28}{''.join(f'{name:>14}' for name in SURFACES)}"
          f"{'F + G':>11}{'speed':>11}")  # fmt: skip
    for solver in SOLVERS:
        walks = [predict(DEFAULT.robot, DEFAULT.gait, s, solver) for s in SURFACES.values()]
        values = [walk.locomotion.per_cycle / DEFAULT.robot.length for walk in walks]
        print(f"{solver:<28}{''.join(f'{value:>+14.4f}' for value in values)}")
    line("default")
    for links in (6, 10, 12, 20, 24, 48, 96):
        line(f"links {links}", links=links)
    for timestep in (0.001, 0.002, 0.005, 0.02, 0.05):
        line(f"timestep {1e3 * timestep:g} ms", timestep=timestep)
    line("12 links, timestep 20 ms", links=12, timestep=0.02)
    for ramp in (1.0, 4.0, 8.0, 16.0):
        line(f"ramp {ramp:g} s", ramp_time=ramp)
    for phi in (0.03, 0.1, 0.3, 0.7, 1.5, 3.0):
        line(f"friction {phi:g} times as strong", strength=phi)
    for angle in (3e-4, 3e-3, 1e-2):
        line(f"side angle {angle:g}", side_angle=angle)
    for damping in (1e-3, 2e-2):
        line(f"damping time {damping:g} s", damping_time=damping)
    for softness in (0.35, 1.0, 2.0, 5.0):
        line(f"contact time {softness:g} steps", contact_time=softness)


if __name__ == "__main__":
    main()
