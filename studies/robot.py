"""Numbers that follow from those of the robots: `python -m studies.robot`, see docs/robot.md.

A row per number: its formula, and its value for the strip of [Majidi13] and for the quadruped's
torso and legs.
"""

import math
from collections.abc import Callable

from analytic.scene import pneunet
from analytic.scene.limbs import MASS, quadruped
from analytic.scene.robot import GRAVITY, Robot
from analytic.scene.surface import REFERENCE_AREA, TIP_FORCE

Number = Callable[[Robot], float]


def _stroke(strip: Robot) -> float:
    """Shortening of the chord of a strip, all at peak pressure [m]."""
    angle = pneunet.turn_number(strip)
    return strip.length * (1.0 - math.sin(0.5 * angle) / (0.5 * angle))


ROWS: tuple[tuple[str, str, Number, float], ...] = (
    ("D0 [1e-4 N m²]", "E q t³/12, under (1)", pneunet.base_rigidity, 1e4),
    ("alpha [1e-4 /(m Pa)]", "6 H² c/(E t³ x), after (9)", pneunet.curvature_per_pressure, 1e4),
    ("eta [1e-10 N m²/Pa]", "c H³ q/(4 x), after (9)", pneunet.rigidity_per_pressure, 1e10),
    ("D_p/D0 at the peak", "1 + eta p/D0, (9)",
     lambda s: float(pneunet.rigidity(s, s.peak_pressure)) / pneunet.base_rigidity(s), 1.0),
    ("GJ/D0", "E/3 times the torsion constant of q by t",
     lambda s: pneunet.torsional_rigidity(s) / pneunet.base_rigidity(s), 1.0),
    ("bends by [rad]", "kappa L = alpha p L, (3)", pneunet.turn_number, 1.0),
    ("shortens by [mm]", "L (1 - sin(kappa L/2)/(kappa L/2))", _stroke, 1e3),
    ("weight [mN]", "w L", lambda s: s.weight, 1e3),
    ("Gamma", "w L³/D0, Appendix A", pneunet.load_number, 1.0),
    ("Phi", "V0 L²/D0", lambda s: TIP_FORCE * s.length**2 / pneunet.base_rigidity(s), 1.0),
    ("height, flat [mm]", "t + H", lambda s: s.flat_height, 1e3),
    ("side over tip", "tau q L/V0", lambda s: s.width * s.length / REFERENCE_AREA, 1.0),
)  # fmt: skip


def rows() -> list[str]:
    """Lines of the table."""
    robot = quadruped()
    strips = (Robot(), robot.limbs[0].strip, robot.limbs[1].strip)
    lines = ["| number | formula | strip | torso | leg |", "|---|---|---|---|---|"]
    for name, formula, number, unit in ROWS:
        cells = " | ".join(f"{unit * float(number(strip)):.3g}" for strip in strips)
        lines.append(f"| {name} | {formula} | {cells} |")
    return lines


def main() -> None:
    """Print the table, and the whole quadruped's weight and length."""
    robot = quadruped()
    print("\n".join(rows()))
    print(f"\nquadruped: {1e3 * robot.length:.1f} mm long, {1e3 * robot.weight:.0f} mN "
          f"({MASS} kg at {GRAVITY} m/s²)")  # fmt: skip


if __name__ == "__main__":
    main()
