"""Every model on the same scenes in one table: `undulator compare`."""

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, fields, replace
from typing import Any

import numpy as np

from analytic.locomotion import direction
from analytic.scene.gait import GAITS
from analytic.scene.limbs import ORDER, AnyRobot, LimbedRobot
from analytic.scene.quadruped_gaits import QUADRUPED_GAITS
from analytic.scene.robot import Robot
from analytic.scene.surface import SURFACES
from analytic.solvers.models import SOLVERS
from analytic.uncertainty import modes_error
from mjsim.files.command_line.cli import ALL, bar, choose, fail, parse, say, strict_json
from mjsim.files.command_line.dataclass_options import given
from mjsim.files.command_line.options import SceneOptions, tables_of
from mjsim.files.gaits.gait_files import is_file
from mjsim.files.scene_tables.actuator_files import make_robot
from mjsim.files.scene_tables.keys import SIDES, WITH_ANY_SURFACE
from mjsim.files.scene_tables.limb_tables import build_robot, of_limbs
from mjsim.files.scene_tables.tables import Tables, build, merged, read_tables
from mjsim.files.scene_tables.typed import Table
from mjsim.files.text_table import Column, text_table
from mjsim.pictures import gl
from mjsim.results.coasting import coasting
from mjsim.results.prediction import (
    HALF,
    QUASI_STATIC,
    WEAK,
    displacement,
    error_bars,
    nap_error,
    prediction,
    reference,
    reference_name,
)
from mjsim.scene import Numerics, Scene, registry

PROGRAM = "undulator compare"
EXAMPLES = (
    "--surface felt,gelatin --gait wave --model modes,elastica,chain",
    "--robot quadruped --surface gelatin --gait wave",
    "--scene my.toml --slope 2",
)


@dataclass(frozen=True)
class Options(SceneOptions):
    """Compare the quasi-static models and MuJoCo on one cycle of each gait on each surface.

    Prints one row per model; docs/output.md explains models and columns. Exit code 0: done, also
    where a model has no answer (its status says why); 2: bad input.
    """

    surface: str = ALL
    """felt, polyethylene, gelatin, several with commas between; all: those three, or the ground
    that a scene or options describe"""
    gait: str = ALL
    """wave, full-wave, pulse, of the quadruped spin and crawl too, several with commas between;
    all: those, or the gait that a scene or options describe; or one file, as of undulator run"""
    model: str = ALL
    """modes, lifted, obstacle, elastica, chain, cable, rod, a body of a plugin, several with commas
    between, or all; of a robot of limbs quasi-static and chain"""
    reverse: bool = False
    """run the gaits backwards too"""
    json: bool = False
    """print one JSON object instead of the table"""


Row = dict[str, Any]  # one model on one scene; what does not exist is None
COLUMNS = (
    Column("surface", "surface"), Column("gait", "gait"), Column("model", "model"),
    Column("direction", "direction"), Column("Δ/L", "displacement_over_L", "+.4f"),
    Column("±", "uncertainty_over_L", ".4f", error=True),
    Column("- ref", "difference_over_L", "+.4f"),
    Column("turn °", "turn_deg", "+.2f"), Column("height/L", "amplitude_over_L", ".3f"),
    Column("status", "status"),
)  # fmt: skip


def models(robot: AnyRobot) -> tuple[str, ...]:
    """Names of all models of a robot, cheapest theory first, then MuJoCo."""
    if isinstance(robot, LimbedRobot):
        return (QUASI_STATIC, Scene.body)
    return (*SOLVERS, *registry.names())


def compare(scene: Scene, models: Sequence[str], numerics: Numerics | None = None) -> list[Row]:
    """Rows of the models asked for, each beside the reference.

    Args:
        scene: what walks; its body is replaced.
        models: names, see `models`.
        numerics: of MuJoCo; chosen for the robot where not given.
    """
    exact = _reference(scene, numerics)
    rows = []
    for model in models:
        try:
            if model == reference_name(scene):
                row = exact
            elif model in SOLVERS:
                row = _weak(scene, model)
            else:
                row = _simulated(replace(scene, body=model), numerics)
        except ValueError as error:
            row = _row(None, None, None, f"refused: {error}")
        shift, zero = row["displacement_over_L"], exact["displacement_over_L"]
        comparable = shift is not None and zero is not None
        row = {
            "surface": scene.ground.name, "gait": scene.gait.name, "model": model, **row,
            "difference_over_L": shift - zero if comparable else None,
            "direction": None if shift is None
            else direction(shift, 1.0, row["uncertainty_over_L"] or 0.0),
        }  # fmt: skip
        rows.append(row)
    return rows


def _reference(scene: Scene, numerics: Numerics | None) -> Row:
    fine = reference(scene, numerics)
    ahead = float(fine.displacement[0])
    if not math.isfinite(ahead):
        return _row(None, None, None, "+".join(fine.flags))
    bar, _ = error_bars(scene, fine, reference(scene, numerics, HALF))
    return _row(ahead, bar, fine.height / scene.robot.length,
                ("+".join(fine.flags) or "ok") + _left_out(scene),
                math.degrees(fine.turn) if scene.in_space else None)  # fmt: skip


def _weak(scene: Scene, model: str) -> Row:
    """Row of a solver of strips for weak friction."""
    walk = prediction(scene, model)
    shift, length = displacement(scene, walk), scene.robot.length
    finite = bool(np.isfinite(shift))
    bar = modes_error(walk) / length + (nap_error(scene, shift) if finite else 0.0)
    flags = "+".join(flag.name.lower() for flag in walk.flags if flag.name) or "ok"
    return _row(
        shift if finite else None,
        bar if math.isfinite(bar) and bar > 0 else None,
        float(walk.shapes.amplitude.max()) / length if finite else None,
        f"{flags}, {WEAK}{_left_out(scene)}",
    )


def _left_out(scene: Scene) -> str:
    """Words for the status of a theory: it takes the gait's pressures as the chambers', and knows
    no momentum.
    """
    return ("" if scene.valves.ideal else ", ideal valves") + ", coasts" * bool(coasting(scene))


def _simulated(scene: Scene, numerics: Numerics | None) -> Row:
    from mjsim.results.measures import measure
    from mjsim.simulation.simulation import simulate

    walk = simulate(scene, numerics)
    numbers = measure(walk)
    if numbers is None:
        return _row(None, None, None, str(walk.status))
    bar = abs(numbers.unexplained)
    return _row(numbers.displacement, None if math.isnan(bar) else bar, numbers.amplitude,
                str(walk.status),
                math.degrees(numbers.turn) if scene.in_space else None)  # fmt: skip


def _row(
    shift: float | None, bar: float | None, height: float | None, status: str,
    turn: float | None = None,
) -> Row:  # fmt: skip
    return {"displacement_over_L": shift, "uncertainty_over_L": bar, "turn_deg": turn,
            "amplitude_over_L": height, "status": status}  # fmt: skip


def table(rows: Sequence[Row]) -> str:
    """The rows as text, a blank line between scenes."""
    lines: list[Row] = []
    for row in rows:
        if lines and (lines[-1]["surface"], lines[-1]["gait"]) != (row["surface"], row["gait"]):
            lines.append({})
        lines.append(row)
    turns = any(row["turn_deg"] is not None for row in rows)
    return text_table([c for c in COLUMNS if turns or c.key != "turn_deg"], lines)


def main(argv: Sequence[str] | None = None) -> int:
    """Run the command; returns its exit code."""
    options = parse(Options, PROGRAM, argv, EXAMPLES)
    gl.prepare()
    try:
        cases = [build(tables) for tables in _tables(options)]
        chosen = choose("model", options.model, models(cases[0][0].robot))
    except ValueError as error:
        fail(PROGRAM, str(error))
    rows: list[Row] = []
    done, stopped = 0, False
    try:
        with bar("comparing", len(cases)) as advance:
            for scene, numerics in cases:
                rows += compare(scene, chosen, numerics)
                done += 1
                advance(1)
    except KeyboardInterrupt:
        if not rows:
            raise
        stopped = True
    if options.json:
        say(strict_json({"reference": reference_name(cases[0][0]), "rows": rows}))
    else:
        say(table(rows))
    if stopped:
        raise KeyboardInterrupt(f"{done} of {len(cases)} scenes were compared")
    return 0


def _tables(options: Options) -> list[Tables]:
    """Tables of every scene: gait by gait, each on all surfaces."""
    body = given(options.numerics_).get("body")
    if body is not None:
        raise ValueError(f"body must be given as --model, got {body!r}")
    from_file = is_file(options.gait)
    shared = {item.name: getattr(options, item.name) for item in fields(SceneOptions)}
    shared |= {"surface": None, "gait": options.gait if from_file else None, "reverse": False}
    (base,) = tables_of(SceneOptions(**shared))
    table = base["robot"]
    chambers = (build_robot(table) if of_limbs(table) else make_robot(table)).chambers
    gaits = {**GAITS, **QUADRUPED_GAITS} if chambers == ORDER else GAITS
    named = gaits if chambers in (ORDER, Robot().chambers) else {}
    scene = read_tables(options.scene) if options.scene else {}
    own_gait, own_ground = (
        bool(scene.get(name)) or not base[name].keys() <= {*kept}
        for name, kept in (("gait", ("ramp_time", *SIDES)), ("ground", WITH_ANY_SURFACE))
    )
    layers = [
        merged({"gait": gait}, {"ground": ground}, {"gait": {"reverse": True} if backward else {}})
        for gait in _choice("gait", ALL if from_file else options.gait, named, own_gait, "name")
        for backward in (False, *([True] if options.reverse else []))
        for ground in _choice("surface", options.surface, SURFACES, own_ground, "surface")
    ]
    return [merged(base, layer) for layer in layers]


def _choice(option: str, text: str, valid: Iterable[str], stated: bool, key: str) -> list[Table]:
    """Tables of what is named; for all of it, the scene's own alone if it has one."""
    if text == ALL and (stated or not valid):
        return [{}]
    return [{key: name} for name in choose(option, text, valid)]
