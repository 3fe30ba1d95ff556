"""The quadruped below a ceiling, by height and pressure: `python -m studies.gaps FILE.png`.

By MuJoCo, one cycle of the wave at 2 s a ramp, on felt and on gelatin; prints the tables of
docs/quadruped.md and the pressures up to which it passes below 19 mm without touching.
"""

import sys
from dataclasses import replace
from pathlib import Path

import matplotlib.pyplot as plt

from analytic.scene.limbs import quadruped
from analytic.scene.quadruped_gaits import undulation
from analytic.scene.robot import PSI
from analytic.scene.surface import SURFACES
from mjsim.results.measures import measure
from mjsim.results.trajectory import Trajectory
from mjsim.scene import Scene
from mjsim.simulation.simulation import simulate
from studies.drawing import FONT, save

GROUNDS = ("felt", "gelatin")
PRESSURES = (3.0, 4.0, 4.5, 5.0, 5.5, 6.0, 7.0)  # psi
CEILINGS = ((22.0, 0.0), (20.6, 0.0), (19.0, 0.0), (19.0, 0.5), (16.0, 0.0), None)  # mm, mu
GAP = 19.0  # mm; 3/4 inch
_HALVINGS = 7  # of the range of pressures, down to 0.03 psi


def walked(surface: str, psi: float, ceiling: tuple[float, float] | None) -> Trajectory:
    """Walk of one cycle at a peak pressure [psi] below a ceiling: height [mm], coefficient."""
    robot = replace(quadruped(), peak_pressure=psi * PSI)
    height, friction = (1e-3 * ceiling[0], ceiling[1]) if ceiling else (None, 0.0)
    return simulate(Scene(robot, undulation("wave"), SURFACES[surface], ceiling=height,
                          ceiling_friction=friction))  # fmt: skip


def touch(walk: Trajectory) -> float:
    """Part of the cycle in which a walk touches its ceiling [1]."""
    pushed = walk.ceiling_force[walk.start :]
    return float((pushed > 0).mean()) if len(pushed) else 0.0


def passes(surface: str) -> float:
    """Highest peak pressure at which it does not touch a ceiling at GAP [psi]."""
    low, high = PRESSURES[0], PRESSURES[-1]
    for _ in range(_HALVINGS):
        middle = 0.5 * (low + high)
        if touch(walked(surface, middle, (GAP, 0.0))):
            high = middle
        else:
            low = middle
    return low


def main() -> None:
    """Walk all, print the tables, and draw them into the file that is named."""
    plt.rcParams.update(FONT)
    figure, axes = plt.subplots(1, 2, figsize=(8.6, 3.4), layout="constrained")
    for panel, surface in zip(axes, GROUNDS, strict=True):
        print(f"\n| {surface}, psi |", " | ".join(f"{psi:g}" for psi in PRESSURES), "|")
        print("|---" * (len(PRESSURES) + 1) + "|")
        for number, ceiling in enumerate(CEILINGS):
            walks = [walked(surface, psi, ceiling) for psi in PRESSURES]
            shifts = [measures.displacement if (measures := measure(walk)) else float("nan")
                      for walk in walks]  # fmt: skip
            touches = [touch(walk) for walk in walks]
            name = f"{ceiling[0]:g} mm" if ceiling else "free"
            name += f", mu {ceiling[1]:g}" if ceiling and ceiling[1] else ""
            cells = [f"{shift:+.4f}" + (f" ({part:.0%})" if part else "")
                     for shift, part in zip(shifts, touches, strict=True)]  # fmt: skip
            print(f"| {name} |", " | ".join(cells), "|", flush=True)
            colour = f"C{number}" if ceiling else "black"
            panel.plot(PRESSURES, shifts, "-", color=colour, label=name, linewidth=1.3)
            for psi, shift, part in zip(PRESSURES, shifts, touches, strict=True):
                panel.plot(psi, shift, "o", color=colour, markersize=4.5,
                           markerfacecolor="white" if part else colour)  # fmt: skip
        print(f"{surface}: below {GAP:g} mm without touching up to {passes(surface):.2f} psi")
        panel.set_title(surface)
        panel.set_xlabel("peak pressure [psi]")
        panel.axhline(0, color="0.7", linewidth=0.8, zorder=0)
    axes[0].set_ylabel("distance per cycle over length")
    axes[0].legend(title="ceiling at; open: touched", frameon=False, fontsize=8)
    save(figure, Path(sys.argv[1]), dpi=110, format="png")


if __name__ == "__main__":
    main()
