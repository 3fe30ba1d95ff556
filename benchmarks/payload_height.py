"""Distance in MuJoCo by the height of a payload's middle over the middle line, which is left out.

    python benchmarks/payload_height.py

The moment of its weight about the line, and its inertia, are put into the links by hand.
"""

from typing import Any

from analytic import SURFACES, Payload, Robot
from analytic.scene.chain import payload_moments
from mjsim import Scene, measure, simulate
from mjsim.model.bodies import chain

HEIGHTS = (0.0, 0.01, 0.02)  # m
PLACES = (0.1, 0.5, 0.9)
_plain = chain.add_links


def raised(height: float) -> Any:
    """The function that makes the links, with payloads at a height."""

    def add_links(parent: Any, strip: Robot, scene: Scene, numerics: Any, *others: Any) -> Any:
        nodes = _plain(parent, strip, scene, numerics, *others)
        for (body, _), moments in zip(nodes, payload_moments(strip, numerics.links), strict=False):
            carried = float(moments @ (1, 2, 1))
            part = carried / body.mass
            body.ipos[2] = part * height
            body.inertia = body.inertia + carried * (1 - part) * height**2
        return nodes

    return add_links


def main() -> None:
    print("place  surface        " + "".join(f"{1e3 * height:>8g} mm" for height in HEIGHTS))
    for place in PLACES:
        for surface in SURFACES:
            scene = Scene(Robot(payload=[Payload("5 g", place)]), ground=surface)
            shifts = []
            for height in HEIGHTS:
                chain.add_links = raised(height)
                shifts.append(measure(simulate(scene)).displacement)
            chain.add_links = _plain
            print(f"{place:<6g} {surface:14}" + "".join(f"{shift:+11.4f}" for shift in shifts))


if __name__ == "__main__":
    main()
