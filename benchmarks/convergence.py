"""Print how the distance depends on each knob of the planar model: `make numbers`.

One knob is turned at a time from the default; the quasi-static rungs stand at the top. The last
columns give the sum of felt and gelatin over their size, and the steps and speed.
"""

from dataclasses import replace

from analytic import RUNGS, SURFACES, Gait, predict
from mjsim.config import Numerics, Scene
from mjsim.measures import measure
from mjsim.simulate import simulate
from mjsim.trajectory import Trajectory

DEFAULT = Scene()


def walk(surface: str, **changes: float) -> Trajectory:
    scene = replace(DEFAULT, surface=SURFACES[surface])
    if "leg_time" in changes:
        gait = scene.gait
        scene = replace(scene, gait=Gait(gait.name, gait.stages, changes.pop("leg_time")))
    if "friction_number" in changes:
        scene = replace(scene, friction_number=changes.pop("friction_number"))
    return simulate(scene, replace(Numerics(), **changes))


def line(label: str, **changes: float) -> None:
    cells, found, speed = [], {}, []
    for surface in SURFACES:
        result = walk(surface, **dict(changes))
        numbers = measure(result)
        found[surface] = numbers.displacement if numbers else float("nan")
        cells.append(f"{found[surface]:>+14.4f}" if numbers else f"{result.status:>14}")
        speed.append(len(result.time) * result.numerics.timestep / result.wall_time)
    odd = (found["felt"] + found["gelatin"]) / found["felt"]
    print(f"{label:<24}{''.join(cells)}{100 * odd:>+9.1f} %{max(speed):>9.0f} x")


def main() -> None:
    print(f"{'displacement/L':<24}{''.join(f'{name:>14}' for name in SURFACES)}"
          f"{'F + G':>11}{'speed':>11}")  # fmt: skip
    for rung in RUNGS:
        walks = [predict(DEFAULT.robot, DEFAULT.gait, s, rung) for s in SURFACES.values()]
        theory = [walk.locomotion.per_cycle / DEFAULT.robot.length for walk in walks]
        print(f"{rung:<24}{''.join(f'{value:>+14.4f}' for value in theory)}")
    line("default")
    for links in (6, 10, 12, 20, 24, 48, 96):
        line(f"links {links}", links=links)
    for timestep in (0.001, 0.002, 0.005, 0.02, 0.05):
        line(f"timestep {1e3 * timestep:g} ms", timestep=timestep)
    for leg in (1.0, 4.0, 8.0, 16.0):
        line(f"leg {leg:g} s", leg_time=leg)
    for phi in (0.05, 0.2, 0.5, 2.0, 5.0):
        line(f"friction number {phi:g}", friction_number=phi)
    for angle in (3e-4, 3e-3, 1e-2):
        line(f"side angle {angle:g}", side_angle=angle)
    for damping in (1e-3, 2e-2):
        line(f"damping time {damping:g} s", damping_time=damping)


if __name__ == "__main__":
    main()
