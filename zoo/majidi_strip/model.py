"""Directions of the strip of [Majidi13] on its three grounds, by the elastica."""

from dataclasses import replace
from functools import cache
from pathlib import Path

import matplotlib as mpl
import numpy as np
from matplotlib.figure import Figure

from analytic import SURFACES
from analytic.locomotion import STANDSTILL
from mjsim import build, read_tables, reference
from studies.drawing import FONT, save
from zoo.comparison import CLAIMED, Predicted, Row, shade

SCENE = Path(__file__).with_name("scene.toml")


@cache
def distances() -> dict[str, float]:
    """Distance per cycle over L on each ground."""
    scene, _ = build(read_tables(SCENE))
    return {name: float(reference(replace(scene, ground=surface)).displacement[0])
            for name, surface in SURFACES.items()}  # fmt: skip


def predicted() -> dict[str, Predicted]:
    """The direction on each ground: 1 ahead, 0 none, -1 back."""
    return {name: Predicted(float(np.sign(far)) if abs(far) > STANDSTILL else 0.0)
            for name, far in distances().items()}  # fmt: skip


def draw(rows: list[Row], path: Path) -> None:
    """Draw the distance on each ground and what is claimed of it."""
    with mpl.rc_context(FONT):
        figure = Figure(figsize=(4.8, 3.2), layout="constrained", dpi=110)
        axes = figure.subplots()
        axes.set_ylim(-0.05, 0.05)
        for k, row in enumerate(rows):
            shade(axes, k - 0.4, k + 0.4, row.measured)
            axes.plot(k, distances()[row.quantity], "o", color="C1",
                      label="predicted" if not k else None)  # fmt: skip
        axes.fill_between([], [], color=CLAIMED, alpha=0.25, label="claimed")
        axes.set_xticks(range(len(rows)), [row.quantity for row in rows])
        axes.set_ylabel("distance per cycle over L")
        axes.legend(fontsize=8, frameon=False)
        save(figure, path)
