"""Ten wheels at equal radius on a carousel, each driven at its own speed: how fast the whole goes.

Of an even number of contacts every speed between the two middle ones dissipates alike, and a median
is half-way by convention: the first prediction is how far those speeds lie outside of the two
middle ones, at most over random speeds, beside the spread of the speeds. The second is a walk: ten
limbs whose tips are drawn in by pairs alike, how far the third pair's slip, beside the spread of
all tips.
"""

from dataclasses import replace
from functools import cache
from pathlib import Path

import matplotlib as mpl
import numpy as np
from matplotlib.figure import Figure

from analytic.friction.dissipation import least_dissipation
from mjsim import build, read_tables, simulate
from studies import Array
from studies.drawing import FONT, save
from zoo.comparison import CLAIMED, Predicted, Row

SCENE = Path(__file__).with_name("scene.toml")
WHEELS, DRAWS, DRAWN = 10, 2000, 40


def speed(wheels: np.ndarray) -> float:
    """Speed of the whole where each wheel's contact is driven at a speed under equal loads."""
    # a contact that the drive moves back by its speed stands still if the whole goes ahead by it
    return least_dissipation(np.ones(len(wheels)), -wheels)


def draws() -> Array:
    """Random speeds of the wheels, rising, (DRAWS, WHEELS)."""
    return np.sort(np.random.default_rng(0).normal(size=(DRAWS, WHEELS)), axis=1)


@cache
def slips(finer: int = 1) -> tuple[Array, Array, Array]:
    """Walk of the scene: times (T,) [s], ways of its tips (T, WHEELS) and of its hub (T,) [mm].

    Args:
        finer: times as many links per limb.

    Raises:
        ArithmeticError: the walk failed.
    """
    scene, numerics = build(read_tables(SCENE))
    walk = simulate(scene, replace(numerics, links=finer * numerics.links))
    if walk.status != "ok":
        raise ArithmeticError(f"the ten limbs' walk ended with {walk.status}")
    along = 1e3 * (walk.position[walk.start :, :, :, 0] - walk.position[walk.start, :, :, 0])
    return walk.time[walk.start :], along[:, 1:, -1], along[:, 0, 0]


def predicted() -> dict[str, Predicted]:
    """Distances of the speed from the middle speeds, over the spread."""
    worst = max(max(wheels[WHEELS // 2 - 1] - (found := speed(wheels)), found - wheels[WHEELS // 2])
                for wheels in draws())  # fmt: skip
    tips = slips()[1][-1]
    middle = np.abs(tips[WHEELS // 2 - 1 : WHEELS // 2 + 1]).max()
    return {
        "speed less the median": Predicted(float(max(0, worst))),
        "slip of the middle pair of ten limbs": Predicted(float(middle / np.ptp(tips))),
    }


def draw(rows: list[Row], path: Path) -> None:
    """Draw speeds beside the two middle ones, and the ways of ten limbs' tips."""
    time, tips, hub = slips()
    with mpl.rc_context(FONT):
        figure = Figure(figsize=(8.4, 3.5), layout="constrained", dpi=110)
        wheels, limbs = figure.subplots(1, 2)
        some = draws()[:DRAWN]
        some = some[np.argsort(np.median(some, axis=1))]
        for k, row in enumerate(some):
            wheels.plot([k] * WHEELS, row, ".", ms=2, color="0.75", zorder=0)
            wheels.plot([k, k], row[WHEELS // 2 - 1 : WHEELS // 2 + 1], color=CLAIMED, lw=3,
                        label=None if k else "stated: between the two middle wheels")  # fmt: skip
        wheels.plot([speed(row) for row in some], ".", ms=4, color="C1",
                    label="predicted: least dissipation")  # fmt: skip
        wheels.set_ylim(-2, 2.6)
        wheels.set_xlabel("draw of ten speeds, by its median")
        wheels.set_ylabel("speed over its spread")
        pairs = WHEELS // 2
        for pair in range(pairs):
            wide = 2.5 if pair == pairs // 2 else 1.2
            limbs.plot(time, tips[:, 2 * pair], color=f"C{pair}", lw=wide,
                       label=f"tips of pair {pair + 1}")  # fmt: skip
        limbs.plot(time, hub, "k--", lw=1, label="hub")
        limbs.axhline(0, color=CLAIMED, lw=5, alpha=0.4, zorder=0, label="stated, of pair 3")
        limbs.set_ylim(-1.2, 2.4)
        limbs.set_xlabel("time in which the limbs curl [s]")
        limbs.set_ylabel("way over the ground [mm]")
        for axes in (wheels, limbs):
            axes.legend(fontsize=7.5, frameon=False)
        save(figure, path)
