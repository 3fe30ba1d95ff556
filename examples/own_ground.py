"""A ground that was measured, in SI, and where it lies between felt and gelatin."""

from analytic.friction.laws import neutral_ratio
from mjsim import SURFACES, Robot, Scene, Surface, measure, simulate


def main() -> dict[str, float]:
    # a tip was pulled with 20 mN before it slid; a flat strip of 40 cm^2 with 60 mN
    table = Surface("table", tip_force=0.020, shear_strength=0.060 / 40e-4)
    shifts = {}
    for surface in (*SURFACES.values(), table):
        numbers = measure(simulate(Scene(ground=surface)))
        assert numbers is not None
        shifts[surface.name] = numbers.displacement
        ratio = neutral_ratio(surface, Robot())
        print(f"{surface.name:<14} V_t / (tau q L) = {ratio:<6.3g} {numbers.displacement:+.4f} L")
    return shifts


if __name__ == "__main__":
    main()
