"""A robot of 90 mm as its owner measured it, on felt: how far, which way, how sure."""

from mjsim import SURFACES, Robot, Scene, measure, predict, simulate


def main() -> float:
    robot = Robot(
        length=0.090,  # m
        width=0.025,
        mass=0.012,  # kg, weighed
        rigidity=2.0e-4,  # N m^2, from how far it sags as a cantilever
        curvature_per_pressure=9.0e-4,  # 1/(m Pa), from photographs at a few pressures
        rigidity_per_pressure=5.0e-10,  # N m^2/Pa
        peak_pressure=40e3,  # Pa
    )
    scene = Scene(robot, ground=SURFACES["felt"])
    walk = simulate(scene)
    numbers = measure(walk)
    assert numbers is not None, walk.status
    expected = predict(robot, scene.gait, scene.ground).locomotion.per_cycle
    print(f"{numbers.direction}: {1e3 * numbers.displacement * robot.length:+.2f} mm a cycle")
    print(f"the quasi-static theory says {1e3 * expected:+.2f} mm")
    print(f"inertia explains {1e3 * numbers.unexplained * robot.length:+.2f} mm of the difference")
    return numbers.displacement


if __name__ == "__main__":
    main()
