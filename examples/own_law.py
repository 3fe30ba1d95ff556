"""A friction law of one's own, in theory and in MuJoCo: sides hold by the root of their area.

For commands: undulator run --plugin examples/own_law.py --friction rooted
"""

from typing import Any

from analytic.friction.laws import Friction, register
from mjsim import SURFACES, Scene, Surface, measure, predict, simulate


class Rooted:
    """See analytic.friction.laws.TractionLaw; floats and arrays come alike."""

    name, needs_load = "rooted", False
    unit = 1e-3  # m^2

    def bound(self, surface: Surface, width: float, contact: Any, load: Any) -> Any:
        on_side = 1.0 * (contact > 0)
        side = surface.shear_strength * (self.unit * width * contact) ** 0.5
        return on_side * side + (1.0 - on_side) * surface.tip_force

    def acts_on(self, surface: Surface) -> bool:
        return surface.tip_force > 0 or surface.shear_strength > 0


register(Rooted())


def main() -> dict[str, float]:
    shifts = {}
    for law in ("constant", "rooted"):
        scene = Scene(ground=SURFACES["polyethylene"], friction=law)
        theory = predict(scene.robot, scene.gait, scene.ground, friction=Friction(law))
        expected = theory.locomotion.per_cycle / scene.robot.length
        numbers = measure(simulate(scene))
        assert numbers is not None
        shifts[law] = numbers.displacement - expected
        print(f"{law:<10}MuJoCo {numbers.displacement:+.4f} L, theory {expected:+.4f} L")
    return shifts


if __name__ == "__main__":
    main()
