"""The smallest model whose answer is sure within a tolerance, and why it is that one.

Models are asked in the order of their cost, and none after the first that is sure: the modes, the
reference, MuJoCo. Each has an error of its own. Of the modes it is a bound: the contacts that they
assume (analytic.uncertainty.modes_error), small slopes, and the bending by friction that they leave
out; of the reference what half of its links and states change; of MuJoCo the change between its two
finest walks. Quasi-static models do not know inertia: they answer where the gait accelerates the
robot by less than FAST of gravity, below which walks of random scenes did not depend on it, and
where what moves is braked: no contacts resist one way alone, and no tether pulls. What hangs on
bounds that are nearly alike, which momentum decides as well, is in the reference's error.
"""

import math
import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any, NamedTuple

from analytic.locomotion import direction
from analytic.prediction import Prediction
from analytic.scene.surface import Surface
from analytic.uncertainty import bending_by_friction, modes_error, small_slopes
from mjsim.files.text_table import Column, text_table
from mjsim.results.cautions import NEARLY, tied
from mjsim.results.coasting import unbraked
from mjsim.results.measures import measure
from mjsim.results.prediction import (
    HALF,
    displacement,
    error_bars,
    prediction,
    reference,
    reference_name,
)
from mjsim.scene import Numerics, Scene
from mjsim.scene.auto import check_tolerance
from mjsim.simulation.checked import allowed, walk_checked
from mjsim.simulation.second_walks import FAST, swiftness

MODES, MUJOCO = "modes", "MuJoCo"


class Tried(NamedTuple):
    """One model's answer.

    Attributes:
        model: its name.
        displacement: per cycle over L, NaN without one.
        error: of it over L, NaN if it is not known.
        why: what the error is made of, or why there is no answer.
        seconds: that it took.
    """

    model: str
    displacement: float
    error: float
    why: str
    seconds: float

    def is_sure(self, tolerance: float) -> bool:
        """Tell whether its error is within a tolerance, relative or 0.001 L."""
        return math.isfinite(self.displacement) and self.error <= allowed(
            self.displacement, tolerance
        )


@dataclass(frozen=True)
class Answer:
    """Models that were tried, the last one sure if any is.

    Attributes:
        tried: answers of the models, cheapest first.
        sure: whether the last one is within the tolerance.
    """

    tried: tuple[Tried, ...]
    sure: bool


def smallest_sure(
    scene: Scene, tolerance: float, numerics: Numerics | None = None,
    asks: Callable[[str], None] | None = None,
) -> Answer:  # fmt: skip
    """Answer of the smallest model that is sure.

    Args:
        scene: what walks.
        tolerance: of its displacement per cycle, relative, or 0.001 L.
        numerics: whose links a reference of limbs takes.
        asks: called with the name of each model before that is asked.

    Raises:
        ValueError: no tolerance that was measured.
    """
    check_tolerance(tolerance)
    tried: list[Tried] = []
    for model, ask in _models(scene, tolerance, numerics):
        if asks:
            asks(model)
        began = time.perf_counter()
        try:
            shift, error, why = ask()
        except ValueError as refusal:  # the model does not know what the scene asks for
            shift, error, why = math.nan, math.nan, str(refusal)
        tried.append(Tried(model, shift, error, why, time.perf_counter() - began))
        if tried[-1].is_sure(tolerance):
            return Answer(tuple(tried), True)
    return Answer(tuple(tried), False)


Ask = Callable[[], tuple[float, float, str]]


def _models(scene: Scene, tolerance: float, numerics: Numerics | None) -> Iterator[tuple[str, Ask]]:
    """Names of models and what asks them, cheapest first."""
    fast, free = swiftness(scene), unbraked(scene)
    for model, ask in (
        (MODES, lambda: _modes(scene)),
        (reference_name(scene), lambda: _reference(scene, numerics)),
    ):
        if model != MODES or not scene.in_space:
            if free:
                ask = partial(_momentum, free)
            yield model, (lambda: _inertia(fast)) if fast > FAST else ask
    yield MUJOCO, lambda: _mujoco(scene, tolerance, numerics)


def _inertia(fast: float) -> tuple[float, float, str]:
    return math.nan, math.nan, (
        f"it knows no inertia, and the gait accelerates the robot by {fast:.2g} of gravity, "
        f"more than {FAST:g}"
    )  # fmt: skip


def _momentum(why: str) -> tuple[float, float, str]:
    return math.nan, math.nan, f"it knows no momentum, and {why}"


def _modes(scene: Scene) -> tuple[float, float, str]:
    ground = scene.ground
    if not isinstance(ground, Surface) or scene.between or scene.slope or not scene.valves.ideal:
        raise ValueError("it is for friction at the two ends on level, uniform ground")
    walk = prediction(scene, MODES)
    parts = {
        "assumed contacts": modes_error(walk),
        "small slopes": small_slopes(walk),
        "bending by friction": bending_by_friction(walk, ground, scene.friction),
    }
    length = scene.strip.length
    why = ", ".join(f"{name} {part / length:.4f} L" for name, part in parts.items())
    return displacement(scene, walk), sum(parts.values()) / length, why


def _reference(scene: Scene, numerics: Numerics | None) -> tuple[float, float, str]:
    if not scene.valves.ideal:
        raise ValueError("it takes the gait's pressures for those behind the valves")
    fine = reference(scene, numerics)
    bar, _ = error_bars(scene, fine, reference(scene, numerics, HALF))
    flags = ", ".join(flag.replace("_", " ") for flag in fine.flags)
    if bar is None or flags:
        return float(fine.displacement[0]), math.nan, flags or "it has no distance"
    if not isinstance(fine.walk, Prediction):
        return float(fine.displacement[0]), bar, "links and states"
    hangs = tied(scene, fine.walk, NEARLY)  # which momentum decides as well
    why = "links and states" + f", bounds within {NEARLY:.0%} of each other" * (hangs > bar)
    return float(fine.displacement[0]), bar + hangs, why


def _mujoco(scene: Scene, tolerance: float, numerics: Numerics | None) -> tuple[float, float, str]:
    checked = walk_checked(scene, tolerance, twists=numerics.twists if numerics else None)
    measures, finest = measure(checked.walk), checked.tried[-1]
    why = f"{finest.links} links at {finest.timestep:g} s beside those before"
    if measures is None:
        return math.nan, math.nan, f"{checked.walk.status} by {why}"
    return measures.displacement, checked.error if checked.agreed else math.nan, why


def record(scene: Scene, answer: Answer) -> dict[str, Any]:
    """Plain data of an answer; what does not exist is None."""
    final = answer.tried[-1]
    finite = math.isfinite(final.displacement)
    return {
        "surface": scene.ground.name, "gait": scene.gait.name,
        "direction": direction(final.displacement, 1.0, final.error) if answer.sure else None,
        "displacement_over_L": final.displacement if finite else None,
        "uncertainty_over_L": final.error if math.isfinite(final.error) else None,
        "model": final.model, "sure": answer.sure, "why": final.why,
        "seconds": sum(tried.seconds for tried in answer.tried),
        "passed_over": [
            {"model": tried.model, "uncertainty_over_L": tried.error
             if math.isfinite(tried.error) else None, "why": tried.why, "seconds": tried.seconds}
            for tried in answer.tried[:-1]
        ],
    }  # fmt: skip


def table(rows: Sequence[dict[str, Any]]) -> str:
    """Table of a line per scene, and why the cheaper models do not do."""
    columns = (
        Column("surface", "surface"), Column("direction", "direction"),
        Column("Δ/L", "displacement_over_L", "+.4f"),
        Column("±", "uncertainty_over_L", ".4f", error=True), Column("by", "model"),
        Column("seconds", "seconds", ".2f"), Column("± is of", "why"),
    )  # fmt: skip
    lines = [text_table(columns, rows)]
    for row in rows:
        if not row["sure"]:
            lines.append(f"{row['surface']}: no model is sure within the tolerance")
        for other in row["passed_over"]:
            bar = other["uncertainty_over_L"]
            words = "" if bar is None else f"± {bar:.4f} L is too much: "
            lines.append(f"{row['surface']}: not {other['model']}: {words}{other['why']}")
    return "\n".join(lines)
