"""A body of one's own: body chain with a payload on its middle link.

For commands: undulator run --plugin examples/own_body.py --body laden
"""

import mujoco

from mjsim import Numerics, Scene, measure, simulate
from mjsim.model.bodies.chain import Chain
from mjsim.scene import registry


class Laden(Chain):
    """One module against a small protocol, mjsim.model.bodies.body.Body; here most is inherited."""

    name = "laden"
    payload = 0.002  # kg

    def spec(self, scene: Scene, numerics: Numerics) -> mujoco.MjSpec:
        spec = super().spec(scene, numerics)
        spec.body(f"link_{numerics.links // 2}").mass += self.payload
        return spec


registry.register(Laden())


def main() -> dict[str, float]:
    shifts = {}
    for body in ("chain", "laden"):
        numbers = measure(simulate(Scene(body=body)))
        assert numbers is not None
        shifts[body] = numbers.displacement
        print(f"{body:<8}{numbers.displacement:+.4f} L, {numbers.amplitude:.3f} L high")
    return shifts


if __name__ == "__main__":
    main()
