"""The way that one actuator on directional feet goes, by the elastica."""

from dataclasses import replace
from pathlib import Path

import matplotlib as mpl
import numpy as np
from matplotlib.figure import Figure

from analytic.locomotion import STANDSTILL
from mjsim import build, read_tables, reference
from studies.drawing import FONT, save
from zoo.comparison import Predicted, Row, shade

SCENE = Path(__file__).with_name("scene.toml")
RATIOS = (1 / 3, 0.5, 0.7, 0.95, 1.0, 1.05, 1.4, 2.0, 3.0)  # of friction back over ahead, drawn


def distance(back_over_ahead: float | None = None) -> float:
    """Distance per cycle over L of the scene, or of feet with another ratio of their frictions."""
    scene, _ = build(read_tables(SCENE))
    if back_over_ahead is not None:
        feet = tuple(replace(foot, grip_back=back_over_ahead * foot.grip)
                     for foot in scene.strip.feet)  # fmt: skip
        scene = replace(scene, robot=replace(scene.strip, feet=feet))
    return float(reference(scene).displacement[0])


def predicted() -> dict[str, Predicted]:
    """The direction over the feet: 1 the way that they slide easily, -1 against it, 0 none."""
    far = distance()
    return {
        "breathing on directional feet": Predicted(float(np.sign(far) * (abs(far) > STANDSTILL)))
    }


def draw(rows: list[Row], path: Path) -> None:
    """Draw the distance over the ratio of the feet's frictions, and what is claimed of it."""
    with mpl.rc_context(FONT):
        figure = Figure(figsize=(4.8, 3.4), layout="constrained", dpi=110)
        axes = figure.subplots()
        axes.semilogx(RATIOS, [distance(ratio) for ratio in RATIOS], "o-", color="C1",
                      label="predicted, assumed numbers")  # fmt: skip
        axes.set_ylim(-0.45, 0.45)
        shade(axes, 1.0, RATIOS[-1], rows[0].measured)
        ticks = [1 / 3, 0.5, 0.7, 1.0, 1.4, 2.0, 3.0]
        axes.set_xticks(ticks, [f"{ratio:.2g}" for ratio in ticks])
        axes.minorticks_off()
        axes.set_xlabel("friction of the feet back over ahead")
        axes.set_ylabel("distance per cycle over L, ahead positive")
        axes.text(1.1, 0.25, "claimed: ahead, by feet\nthat slide ahead easily", fontsize=8,
                  va="top")  # fmt: skip
        axes.legend(fontsize=8, frameon=False, loc="lower right")
        save(figure, path)
