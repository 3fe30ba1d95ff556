"""Another order of the stages, with a time for each ramp."""

from mjsim import SURFACES, Gait, Scene, measure, simulate


def main() -> dict[str, float]:
    gait = Gait(
        "middle-first",
        stages=((0, 0, 0), (0, 1, 0), (1, 1, 0), (1, 0, 0), (0, 0, 0)),
        ramp_time=(1.0, 2.0, 2.0, 3.0),  # s
    )
    shifts = {}
    for name, surface in SURFACES.items():
        for way in (gait, gait.reversed()):
            numbers = measure(simulate(Scene(gait=way, ground=surface)))
            assert numbers is not None
            shifts[f"{way.name} {name}"] = numbers.displacement
            print(f"{way.name:<24}{name:<14}{numbers.displacement:+.4f} L, {numbers.direction}")
    return shifts


if __name__ == "__main__":
    main()
