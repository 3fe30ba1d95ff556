"""Every model on the same scenes in one table: `undulator compare`."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from analytic.locomotion import direction
from analytic.prediction import REFERENCE, SOLVERS
from analytic.scene.gait import GAITS, Gait
from analytic.scene.robot import Robot
from analytic.scene.surface import SURFACES, Ground
from analytic.uncertainty import modes_error
from mjsim.files import plugins
from mjsim.files.cli import Plugins, bar, choose, fail, parse, say, strict_json
from mjsim.pictures import gl
from mjsim.results.prediction import HALF, WEAK, displacement, error_bar, prediction
from mjsim.scene import Scene, registry

PROGRAM = "undulator compare"


@dataclass(frozen=True)
class Options:
    """Compare the quasi-static solvers and MuJoCo on one cycle of each gait on each surface.

    The reference is elastica, bent by the friction of the ground as in MuJoCo; the other solvers
    know weak friction alone, which bends nothing, and their status says so. Columns: Δ/L,
    displacement of the left end per cycle over the length; +-, what is known of its error: of modes
    and lifted, what the contacts that they assume may be off exact contact, a bound; of elastica,
    what half the links and states change; of MuJoCo, the part that the anchor rule does not
    explain; - ref, difference from the reference; height/L, the greatest height; status, ok or what
    limits the answer. Lists are comma-separated. Exit code
    0: done, also where a model has no answer (its status says why); 2: bad input.

    Example: undulator compare --surface felt,gelatin --gait wave --model modes,planar
    """

    surface: str = "all"
    """felt, polyethylene, gelatin, or all"""
    gait: str = "all"
    """wave, full-wave, pulse, or all"""
    model: str = "all"
    """modes, lifted, obstacle, elastica, planar, cable, rod, or all; or a body of your own"""
    plugin: Plugins = ()
    reverse: bool = False
    """run the gaits backwards too"""
    pressure: float = Robot().peak_pressure
    """peak pressure of a segment [Pa]"""
    json: bool = False
    """print one JSON object instead of the table"""


class Row(NamedTuple):
    """One model on one scene; what does not exist is None."""

    surface: str
    gait: str
    model: str
    displacement_over_L: float | None  # noqa: N815 - the contract's name
    uncertainty_over_L: float | None  # noqa: N815
    difference_over_L: float | None  # noqa: N815
    direction: str | None
    amplitude_over_L: float | None  # noqa: N815
    status: str


def models() -> tuple[str, ...]:
    """Names of all, cheapest theory first, then MuJoCo."""
    return (*SOLVERS, *registry.names())


def compare(robot: Robot, gait: Gait, ground: Ground, models: Sequence[str]) -> list[Row]:
    """Rows of the models asked for, each beside the reference."""
    scene = Scene(robot, gait, ground)
    reference = _quasi_static(scene, REFERENCE)
    rows = []
    for model in models:
        if model == REFERENCE:
            row = reference
            if row.displacement_over_L is not None:
                bar = error_bar(scene, row.displacement_over_L, prediction(scene, finer=HALF))
                row = row._replace(uncertainty_over_L=bar)
        elif model in SOLVERS:
            row = _quasi_static(scene, model)
        else:
            row = _simulated(Scene(robot, gait, ground, body=model))
        exact, shift = reference.displacement_over_L, row.displacement_over_L
        if exact is not None and shift is not None:
            row = row._replace(difference_over_L=shift - exact)
        if shift is not None:
            way = direction(shift, 1.0, row.uncertainty_over_L or 0.0)
            row = row._replace(direction=way)
        rows.append(row)
    return rows


def _quasi_static(scene: Scene, model: str) -> Row:
    walk = prediction(scene, model)
    shift, length = displacement(scene, walk), scene.robot.length
    known, assumed = bool(np.isfinite(shift)), modes_error(walk) / length
    flags = "+".join(flag.name.lower() for flag in walk.flags if flag.name) or "ok"
    return Row(
        scene.ground.name,
        scene.gait.name,
        model,
        displacement_over_L=shift if known else None,
        uncertainty_over_L=assumed if math.isfinite(assumed) and assumed > 0 else None,
        difference_over_L=None,
        direction=None,
        amplitude_over_L=float(walk.shapes.amplitude.max()) / length if known else None,
        status=flags if model == REFERENCE else f"{flags}, {WEAK}",
    )


def _simulated(scene: Scene) -> Row:
    from mjsim.results.measures import measure
    from mjsim.simulation.simulation import simulate

    walk = simulate(scene)
    numbers = measure(walk)
    return Row(
        scene.ground.name,
        scene.gait.name,
        scene.body,
        displacement_over_L=numbers and numbers.displacement,
        uncertainty_over_L=numbers and abs(numbers.unexplained),
        difference_over_L=None,
        direction=None,
        amplitude_over_L=numbers and numbers.amplitude,
        status=str(walk.status),
    )


def table(rows: Sequence[Row]) -> str:
    """The rows as text, a blank line between scenes."""
    lines = [
        f"{'surface':<14}{'gait':<19}{'model':<10}{'direction':<11}{'Δ/L':>9}{'+-':>8}"
        f"{'- ref':>9}{'height/L':>10}  status"
    ]
    scene = None
    for row in rows:
        if scene not in (None, (row.surface, row.gait)):
            lines.append("")
        scene = (row.surface, row.gait)
        lines.append(
            f"{row.surface:<14}{row.gait:<19}{row.model:<10}{row.direction or '-':<11}"
            f"{_number(row.displacement_over_L, 9, '+.4f')}"
            f"{_number(row.uncertainty_over_L, 8, '.4f')}"
            f"{_number(row.difference_over_L, 9, '+.4f')}"
            f"{_number(row.amplitude_over_L, 10, '.3f')}  {row.status}"
        )
    return "\n".join(lines)


def _number(value: float | None, width: int, kind: str) -> str:
    return f"{'-' if value is None else format(value, kind):>{width}}"


def main(argv: Sequence[str] | None = None) -> int:
    """Run the command; returns its exit code."""
    options = parse(Options, PROGRAM, argv)
    gl.prepare()
    try:
        plugins.load(options.plugin)
        surfaces = choose("surface", options.surface, SURFACES)
        gaits = [GAITS[name] for name in choose("gait", options.gait, GAITS)]
        chosen = choose("model", options.model, models())
        robot = replace(Robot(), peak_pressure=options.pressure)
        for gait in gaits:
            Scene(robot, gait)  # says whether the pressure is absurd
    except ValueError as error:
        fail(PROGRAM, str(error))
    if options.reverse:
        gaits = [way for gait in gaits for way in (gait, gait.reversed())]
    rows: list[Row] = []
    with bar("comparing", len(surfaces) * len(gaits)) as advance:
        for gait in gaits:
            for name in surfaces:
                rows += compare(robot, gait, SURFACES[name], chosen)
                advance(1)
    if options.json:
        say(strict_json({"reference": REFERENCE, "rows": [row._asdict() for row in rows]}))
    else:
        say(table(rows))
    return 0
