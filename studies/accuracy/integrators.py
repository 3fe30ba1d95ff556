"""MuJoCo's integrators, each with its best contact settings.

`python -m studies.accuracy.integrators` searches them and prints the table. So that none is
judged by settings that suit another, the contacts of each are searched at each time step: how soft
they are, how soft under a steep end, and how flat an end must be to lie on its side.
"""

import itertools
import math
import sys
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cache
from pathlib import Path
from typing import cast

from analytic import SURFACES
from mjsim.files.cli import bar, fail, parse
from mjsim.files.files import check_folder
from mjsim.results.measures import measure
from mjsim.results.provenance import signature
from mjsim.scene import INTEGRATORS, Numerics, Scene
from mjsim.scene.numerics import Integrator
from mjsim.simulation.simulation import simulate
from studies import workers
from studies.accuracy.rows import HERE, append, read

PROGRAM = "python -m studies.accuracy.integrators"
TABLE = HERE / "docs" / "integrators.csv"
TIMESTEPS = (0.02, 0.01, 0.005, 0.002, 0.001, 0.0005, 0.0002)
GOAL = 0.05  # relative error on displacement, on the worse of the two grounds
GROUNDS = ("felt", "gelatin")
LINKS = 12
_CONTACT_TIMES = (0.5, 2.0, 3.0, 5.0, 10.0, 20.0)  # [timestep]; below 2 for discrete alone
_STEEP = (1.0, 2.0, 4.0)  # [contact time]
_SIDE_ANGLES = (1e-3, 3e-3)  # rad
_HOPELESS = 0.5  # error on the first ground that spares the second


@dataclass(frozen=True)
class Best:
    """The best settings found of an integrator at a time step [s].

    Attributes:
        integrator, timestep: of MuJoCo.
        contact_time, steep_contact_time, side_angle: see Numerics; NaN if none walks.
        error: relative on displacement, the worse of felt and gelatin; inf if none walks.
        usual: the same by the settings that Numerics picks.
        tried: how many settings were.
        failed: of them that did not come to the end of the cycle on felt.
        versions, commit: of what it was found with.
    """

    integrator: str
    timestep: float
    contact_time: float = math.nan
    steep_contact_time: float = math.nan
    side_angle: float = math.nan
    error: float = math.inf
    usual: float = math.inf
    tried: int = 0
    failed: int = 0
    versions: str = ""
    commit: str = ""

    @property
    def key(self) -> tuple[str, float]:
        """What tells it from others."""
        return self.integrator, self.timestep

    def done(self) -> "Best":
        """The same, searched."""
        best = replace(self, usual=error(self._numerics())[0])
        tried = failed = 0
        for contact, steep, angle in self._settings():
            numerics = replace(self._numerics(), contact_time=contact,
                               steep_contact_time=contact * steep, side_angle=angle)  # fmt: skip
            found, walked = error(numerics)
            tried, failed = tried + 1, failed + (not walked)
            if found < best.error:
                best = replace(best, contact_time=contact, steep_contact_time=contact * steep,
                               side_angle=angle, error=found)  # fmt: skip
        return replace(best, tried=tried, failed=failed)

    def _numerics(self) -> Numerics:
        return Numerics(LINKS, self.timestep, cast(Integrator, self.integrator))

    def _settings(self) -> Iterator[tuple[float, float, float]]:
        for contact, steep, angle in itertools.product(_CONTACT_TIMES, _STEEP, _SIDE_ANGLES):
            if contact >= 2 or self.integrator == "discrete":
                yield contact, steep, angle


def error(numerics: Numerics) -> tuple[float, bool]:
    """Worst relative error of the displacement over the grounds, and whether the first walk ended.

    Against the same scene with 48 links at 1 ms, so that inertia is in both.
    """
    worst = 0.0
    for name in GROUNDS:
        numbers = measure(simulate(Scene(ground=SURFACES[name]), numerics))
        if numbers is None:
            return math.inf, name != GROUNDS[0]
        worst = max(worst, abs(numbers.displacement / _exact(name) - 1))
        if worst > _HOPELESS:
            break
    return worst, True


@cache
def _exact(name: str) -> float:
    numbers = measure(simulate(Scene(ground=SURFACES[name]), Numerics(48, 0.001)))
    assert numbers is not None
    return numbers.displacement


@dataclass(frozen=True)
class Options:
    """Search the best contact settings of each of MuJoCo's integrators at each time step.

    One cycle of the default gait on felt and gelatin, 12 links. Rows are appended to a table, and a
    run that was stopped goes on where it was. Exit code 0: done; 2: bad input.

    Example: python -m studies.accuracy.integrators --rows /tmp/integrators.csv
    """

    rows: Path = TABLE
    """the table, CSV"""


def table(rows: Sequence[Best]) -> str:
    """Errors by integrator and step, as Markdown, and from which step each is within the goal."""
    steps = sorted({row.timestep for row in rows}, reverse=True)
    heads = [f"{1e3 * dt:g} ms" for dt in steps]
    lines = [f"| integrator | {' | '.join(heads)} | within {GOAL:.0%} |",
             "|---" * (len(steps) + 2) + "|"]  # fmt: skip
    for name in dict.fromkeys(row.integrator for row in rows):
        mine = {row.timestep: row for row in rows if row.integrator == name}
        fine = [dt for dt in steps if all(mine[d].error <= GOAL for d in steps if d <= dt)]
        cells = [_cell(mine[dt].error) for dt in steps]
        lines.append(f"| {name} | {' | '.join(cells)} | {_from(fine)} |")
    return "\n".join(lines)


def _cell(value: float) -> str:
    return "fails" if math.isinf(value) else f"{100 * value:.2g} %"


def _from(steps: Sequence[float]) -> str:
    return f"from {1e3 * max(steps):g} ms on" if steps else "at none"


def main(argv: Sequence[str] | None = None) -> int:
    """Run the command; returns its exit code."""
    options = parse(Options, PROGRAM, argv)
    try:
        check_folder(options.rows.parent)
        known = read(options.rows, Best)
    except (ValueError, OSError) as problem:
        fail(PROGRAM, str(problem))
    seen = {row.key for row in known}
    todo = [Best(name, dt) for name in INTEGRATORS for dt in TIMESTEPS]
    todo = [row for row in todo if row.key not in seen]
    with workers.pool() as pool, bar("searching", len(todo)) as advance:
        found = (replace(row, **signature()) for row in pool.map(Best.done, todo))
        for row in append(found, options.rows):
            known.append(row)
            advance(1)
    print(table(known))
    return 0


if __name__ == "__main__":
    sys.exit(main())
