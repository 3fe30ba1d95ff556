"""Eight segments, two waves: where a long robot lies between its ends, friction there decides."""

from analytic import SURFACES, Elastica, Friction, Gait, Robot, displacements
from analytic.traction import motion


def main() -> dict[str, float]:
    robot = Robot(length=0.347, weight_per_length=2.0, segments=(1.0,) * 8)
    # stage k inflates segment j where (j - k) mod 4 is 0 or 1
    stages = tuple(tuple(float((j - k) % 4 in (0, 1)) for j in range(8)) for k in range(9))
    path = Gait("two waves", stages).pressures(50) * robot.peak_pressure
    felt, ends, everywhere = SURFACES["felt"], Friction(), Friction(contacts="all")
    shapes = Elastica(links=144).solve(robot, path, felt, ends)
    print(f"up to {motion(shapes, felt, everywhere).most} contacts at a time")
    shifts = {}
    for name, surface in SURFACES.items():
        for where, friction in (("ends", ends), ("all", everywhere)):
            shift = displacements(shapes, surface, friction=friction).per_cycle / robot.length
            shifts[f"{name} {where}"] = shift
            print(f"{name:<14}friction at {where:<6}{shift:+.4f} L")
    return shifts


if __name__ == "__main__":
    main()
