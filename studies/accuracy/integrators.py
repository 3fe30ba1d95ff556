"""MuJoCo's integrators, each with its best contacts: `python -m studies.accuracy.integrators`.

So that none is judged by settings that suit another, the contacts of each are searched at each time
step: how soft they are, how soft under a steep end, and how flat an end must be to lie on its side.
"""

import itertools
import math
import sys
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cache
from pathlib import Path
from typing import Any, cast

import numpy as np
import pandas as pd  # type: ignore[import-untyped]

from analytic import SURFACES
from mjsim.files.command_line.cli import fail, parse
from mjsim.files.files import check_folder
from mjsim.results.measures import measure
from mjsim.scene import INTEGRATORS, Numerics, Scene
from mjsim.scene.numerics import Integrator
from mjsim.simulation.simulation import simulate
from studies.table import DOCS, complete, read

PROGRAM = "python -m studies.accuracy.integrators"
TABLE = DOCS / "integrators.csv"
TIMESTEPS = (0.02, 0.01, 0.005, 0.002, 0.001, 0.0005, 0.0002)
GOAL = 0.05  # relative error on displacement, on the worse of the two grounds
GROUNDS = ("felt", "gelatin")
LINKS = 12
_CONTACT_TIMES = (0.5, 2.0, 3.0, 5.0, 10.0, 20.0)  # [timestep]; below 2 for discrete alone
_STEEP = (1.0, 2.0, 4.0)  # [contact time]
_SIDE_ANGLES = (1e-3, 3e-3)  # rad
_HOPELESS = 0.5  # error on the first ground that spares the second


def best_contacts(integrator: str, timestep: float) -> dict[str, Any]:
    """Best contact settings of an integrator at a time step [s].

    Returns:
        contact_time, steep_contact_time, side_angle: see Numerics; NaN if none walks.
        error: relative on displacement, the worse of felt and gelatin; inf if none walks.
        usual: the same by the settings that Numerics picks.
        tried: number of settings.
        failed: number of them that did not come to the end of the cycle on felt.
    """
    usual = Numerics(LINKS, timestep, cast(Integrator, integrator))
    contacts: list[dict[str, Any]] = [
        {"contact_time": time, "steep_contact_time": time * steep, "side_angle": angle}
        for time, steep, angle in itertools.product(_CONTACT_TIMES, _STEEP, _SIDE_ANGLES)
        if time >= 2 or integrator == "discrete"
    ]
    errors, walked = zip(*(error(replace(usual, **contact)) for contact in contacts), strict=True)
    best = contacts[int(np.argmin(errors))]
    if math.isinf(min(errors)):
        best = dict.fromkeys(best, math.nan)
    return {**best, "error": min(errors), "usual": error(usual)[0], "tried": len(contacts),
            "failed": walked.count(False)}  # fmt: skip


def error(numerics: Numerics) -> tuple[float, bool]:
    """Worst relative error of the displacement over the grounds; True if the first walk ended.

    Against the same scene with 48 links at 1 ms, so that inertia is in both.
    """
    worst = 0.0
    for name in GROUNDS:
        displacement = _displacement(name, numerics)
        if math.isnan(displacement):
            return math.inf, name != GROUNDS[0]
        worst = max(worst, abs(displacement / _displacement(name, Numerics(48, 0.001)) - 1))
        if worst > _HOPELESS:
            break
    return worst, True


@cache
def _displacement(ground: str, numerics: Numerics) -> float:
    """Displacement per cycle over L; NaN where the walk failed."""
    numbers = measure(simulate(Scene(ground=SURFACES[ground]), numerics))
    return numbers.displacement if numbers else math.nan


@dataclass(frozen=True)
class Options:
    """Search the best contact settings of each of MuJoCo's integrators at each time step.

    One cycle of the default gait on felt and gelatin, 12 links. Rows are appended to a table, and a
    run that was stopped goes on where it was. Exit code 0: done; 2: bad input.

    Example: python -m studies.accuracy.integrators --rows /tmp/integrators.csv
    """

    rows: Path = TABLE
    """the table, CSV"""


def table(rows: pd.DataFrame) -> str:
    """Errors by integrator and step, as Markdown, and from which step each is within the goal."""
    errors = rows.pivot(index="integrator", columns="timestep", values="error").iloc[:, ::-1]
    heads = [f"{1e3 * dt:g} ms" for dt in errors]
    lines = [f"| integrator | {' | '.join(heads)} | within {GOAL:.0%} |",
             "|---" * (len(heads) + 2) + "|"]  # fmt: skip
    for name in rows["integrator"].unique():
        row = errors.loc[name]
        cells = ["fails" if math.isinf(value) else f"{100 * value:.2g} %" for value in row]
        within = row.index[(row <= GOAL)[::-1].cummin()[::-1]]
        start = f"from {1e3 * within[0]:g} ms on" if len(within) else "at none"
        lines.append(f"| {name} | {' | '.join(cells)} | {start} |")
    return "\n".join(lines)


def main(argv: Sequence[str] | None = None) -> int:
    """Run the command; returns its exit code."""
    options = parse(Options, PROGRAM, argv)
    try:
        check_folder(options.rows.parent)
        read(options.rows, best_contacts)
    except (ValueError, OSError) as problem:
        fail(PROGRAM, str(problem))
    grid = itertools.product(INTEGRATORS, TIMESTEPS)
    print(table(complete(options.rows, best_contacts, grid)))
    return 0


if __name__ == "__main__":
    sys.exit(main())
