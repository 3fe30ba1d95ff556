"""An inchworm of five piezo strips that curl both ways, beside a simulator that others published.

Its constants and gait are those of sfers (Zheng and others, Princeton; model_parameters.py,
inchworm_envs.py), whose rerun in PyBullet goes -0.5 to -1.1 mm a cycle with this gait and +0.9 to
+1.1 mm with the mirrored one. Voltage stands where pressure does, and is switched, not ramped.
"""

from mjsim import Gait, Numerics, Robot, Scene, Surface, measure, simulate

VOLTS = 1500.0
ROBOT = Robot(
    length=0.5,
    width=0.020,
    rigidity=5.04e-3,  # N m^2
    weight_per_length=0.471,  # N/m
    curvature_per_pressure=3.63e-3,  # 1/(m V)
    rigidity_per_pressure=1e-15,  # a piezo strip does not stiffen
    peak_pressure=VOLTS,
    segments=(1.0,) * 5,
)
UP, DOWN = 1.0, -520.0 / VOLTS  # arching, and curling up
STAGES = ((0, 0, 0, 0, 0), (0, DOWN, UP, DOWN, 0), (DOWN, DOWN, UP, DOWN, 0), (DOWN, 0, 0, 0, 0),
          (0, 0, 0, 0, 0))  # fmt: skip
PERIOD, SWITCH = 1.0, 0.02  # s


def switched(stages: tuple[tuple[float, ...], ...]) -> Gait:
    """Each stage held for its part of the period, all but instantly reached."""
    rows, times = [stages[0]], []
    for stage in stages[1:]:
        rows += [stage, stage]
        times += [SWITCH, PERIOD / (len(stages) - 1) - SWITCH]
    return Gait("switched", tuple(rows), tuple(times))


def main(links: int = 50) -> dict[str, float]:
    """Millimetres a cycle."""
    ground, far = Surface("plastic", friction=2.5), {}
    mirrored = tuple(stage[::-1] for stage in STAGES)
    for name, stages in (("forward", STAGES), ("backward", mirrored)):
        scene = Scene(ROBOT, switched(stages), ground, cycles=3, friction="coulomb",
                      chamber="constant-pressure")  # fmt: skip
        numbers = measure(simulate(scene, Numerics(links=links, timestep=0.002)))
        assert numbers is not None
        far[name] = 1e3 * numbers.displacement * ROBOT.length
        print(f"{name:<9}{far[name]:+.2f} mm a cycle, {1e3 * numbers.amplitude * ROBOT.length:.0f} "
              "mm high")  # fmt: skip
    return far


if __name__ == "__main__":
    main()
