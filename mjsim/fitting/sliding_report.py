"""Tilt and pull tests of a ground in words and numbers: table, notes, tables of a scene."""

import math
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any, NamedTuple

from analytic.scene.robot import Robot
from analytic.scene.surface import SURFACES
from mjsim.files.scene_tables.typed import Table
from mjsim.files.text_table import Column, text_table
from mjsim.fitting.sliding_bounds import BOTH, LAWS, NAMES, Quantity, Sample, Verdict
from mjsim.fitting.sliding_slopes import Estimate
from mjsim.fitting.sliding_tests import STATES, WAYS

_UNITS = {"constant": {"side": "Pa", "tip": "N"}, "coulomb": {"side": "", "tip": ""}}
_SHORT = {"constant": "bound", "coulomb": "coefficient"}
_PRESSED = {"side": (1.0, "Pa"), "tip": (1e3, "mN a tip")}
_OTHER_LOAD = 1.5  # from which factor on a load is another than that of the readings; chosen
_ALIKE = 1e-6  # of a number: half of an interval that is of no width
_DIGITS = ".6g"  # of numbers in files
_LAWS = {"constant": "a constant bound", "coulomb": "mu N", BOTH: "the sum of both"}


class Ground(NamedTuple):
    """The surface that tests tell of.

    Attributes:
        law: of friction, which the data support; empty where they do not tell.
        fields: of the surface, by name.
        used: quantities that they are of.
        table: [ground] of a scene.
    """

    law: str
    fields: dict[str, float]
    used: tuple[Quantity, ...]
    table: Table


def ground_of(
    tested: Sequence[Sample], quantities: Sequence[Quantity], name: str, nap: str, state: str = ""
) -> Ground:
    """The surface of quantities.

    Args:
        tested: samples.
        quantities: theirs.
        name: of the surface.
        nap: whose ahead it is, robot or ground.
        state: begins or slides; of each contact begins if empty, or slides if that alone was
            tested.

    Raises:
        ValueError: there is no quantity, a contact was tested back or across and not ahead, the
            state was not tested, or the name is a known surface's.
    """
    if not quantities:
        raise ValueError(
            "mass, area or tips must be given: without them a force tells neither a coefficient "
            "nor a bound"
        )
    if name in SURFACES:
        raise ValueError(f"name must be none of {', '.join(SURFACES)}, which are known surfaces")
    contacts = dict.fromkeys(quantity.contact for quantity in quantities)
    used = []
    for contact in contacts:
        ours = [quantity for quantity in quantities if quantity.contact == contact]
        states = [s for s in ([state] if state else STATES) if s in {q.state for q in ours}]
        if not states:
            raise ValueError(f"state must be that of a reading of {contact}s, got {state!r}")
        used += [quantity for quantity in ours if quantity.state == states[0]]
    for quantity in used:
        kind = (quantity.contact, quantity.law)
        if not any((q.contact, q.law, q.way) == (*kind, "ahead") for q in used):
            raise ValueError(
                f"{NAMES[kind]} must be measured ahead, from which other ways differ; "
                f"got {quantity.way} alone"
            )
    law = _law(tested, used)
    kept = tuple(quantity for quantity in used if not law or quantity.law == law)
    fields = {q.name: float(format(q.estimate.value, _DIGITS)) for q in kept}
    if not any(fields.values()):
        raise ValueError("angle or force must be above 0 in some readings, got 0 in all of them")
    directed = any(quantity.way != "ahead" for quantity in kept)
    told = {"nap": nap} if directed else {}
    return Ground(law, fields, kept, {"surface": name, **fields, **told})


def _law(tested: Iterable[Sample], used: Sequence[Quantity]) -> str:
    states = {(quantity.contact, quantity.state) for quantity in used}
    laws = {sample.verdict.law for sample in tested
            if sample.verdict and (sample.contact, sample.state) in states} - {""}  # fmt: skip
    measured = {quantity.law for quantity in used}
    if laws == {BOTH}:
        return ""
    if len(laws) == 1:
        return laws.pop()
    return measured.pop() if not laws and len(measured) == 1 else ""


def table(quantities: Sequence[Quantity]) -> str:
    """A row per quantity, and below it one per test where there are several."""
    columns = (
        Column("quantity", "name"), Column("sliding", "state"), Column("test", "test"),
        Column("value", "value", ".4g"), Column("unit", "unit"),
        Column("95 % interval", "interval"),
        Column("readings", "count", "d"), Column("load", "load"),
    )  # fmt: skip
    rows = []
    for quantity in quantities:
        unit = _UNITS[quantity.law][quantity.contact]
        several = len(quantity.tests) > 1
        first = {"name": quantity.name, "state": quantity.state, "unit": unit,
                 "test": "all" if several else next(iter(quantity.tests)),
                 "value": quantity.estimate.value, "count": sum(quantity.counts.values()),
                 "interval": _interval(quantity), "load": _load(quantity)}  # fmt: skip
        rows.append(first)
        for test, estimate in quantity.tests.items() if several else ():
            rows.append({"name": " ", "state": " ", "test": test, "value": estimate.value,
                         "unit": unit,
                         "interval": "" if quantity.missed else _limits(*estimate.interval),
                         "count": quantity.counts[test], "load": " "})  # fmt: skip
    return text_table(columns, rows)


def _interval(quantity: Quantity) -> str:
    return "withheld" if quantity.missed else _limits(quantity.low, quantity.high)


def _limits(low: float, high: float) -> str:
    return "" if math.isnan(low + high) else f"{max(low, 0.0):.4g} .. {high:.4g}"


def _load(quantity: Quantity) -> str:
    low, high = quantity.pressed
    if not math.isfinite(low + high):
        return ""
    factor, unit = _PRESSED[quantity.contact]
    ends = dict.fromkeys(f"{factor * end:.3g}" for end in (low, high))
    return f"{' .. '.join(ends)} {unit}"


def notes(tested: Sequence[Sample], quantities: Sequence[Quantity], ground: Ground) -> list[str]:
    """Notes on what the numbers do not say by themselves, a sentence each."""
    lines = [line for sample in tested for line in _verdict(sample)]
    if not any(sample.verdict for sample in tested):
        lines.append(
            "loads do not differ, or readings are too few: whether friction is a constant bound or "
            "mu N is not told"
        )
    if any(quantity.missed for quantity in quantities):
        lines.append("withheld: a mean over loads on which it depends says nothing about others")
    for quantity in quantities:
        name = f"{quantity.name} ({quantity.state})"
        if quantity.apart:
            lines.append(
                f"{name}: tests differ beyond their scatter, so that one of them has an error of "
                "its own; the interval spans both"
            )
        if all(math.isnan(test.error) for test in quantity.tests.values()):
            lines.append(f"{name}: one reading has no interval; repeat it")
        elif quantity.estimate.half_width <= _ALIKE * quantity.estimate.value:
            lines.append(f"{name}: repeats are all alike: the interval is of no width, the "
                         "resolution is not in it")  # fmt: skip
    return [*lines, *_missing(quantities, ground), *_at_rest(quantities)]


def loads(robot: Robot, ground: Ground) -> list[str]:
    """Lines on bounds that were measured at other loads than a strip's, where that may matter."""
    if ground.law:
        return []
    presses = {"side": robot.weight_per_length / robot.width, "tip": 0.5 * robot.weight}
    lines = []
    for quantity in ground.used:
        low, high = quantity.pressed
        load = presses[quantity.contact]
        if quantity.law == "constant" and not low / _OTHER_LOAD < load < high * _OTHER_LOAD:
            told = "" if math.isnan(low) else f", readings are at {_load(quantity)}"
            factor, unit = _PRESSED[quantity.contact]
            lines.append(f"{quantity.name}: the robot presses {factor * load:.3g} {unit}{told}: a "
                         "bound at its load is not known")  # fmt: skip
    return lines


def _verdict(sample: Sample) -> list[str]:
    verdict = sample.verdict
    if verdict is None:
        return []
    where = f"{sample.contact}, {sample.way}, {sample.state}, {sample.test}"
    misses = ", ".join(f"{_LAWS[law]} by {f'{100 * miss:.2g}' if miss > _ALIKE else '0'} %"
                       for law, miss in verdict.misses.items())  # fmt: skip
    words = {"": "either law may be right", BOTH: f"neither law alone, but {_sum(sample, verdict)}"}
    said = words.get(verdict.law) or f"the data support {_LAWS[verdict.law]}"
    return [f"{where}: {said} (misses: {misses} of the resistance)"]


def _sum(sample: Sample, verdict: Verdict) -> str:
    kind = sample.contact
    bound, mu = NAMES[kind, "constant"], NAMES[kind, "coulomb"]
    unit = _UNITS["constant"][kind]
    return (f"{bound} {_plus_minus(verdict.bound)} {unit} and {mu} "
            f"{_plus_minus(verdict.coefficient)} together")  # fmt: skip


def _plus_minus(estimate: Estimate) -> str:
    return f"{estimate.value:.3g} +- {estimate.half_width:.2g}"


def _missing(quantities: Sequence[Quantity], ground: Ground) -> list[str]:
    pairs = {(quantity.contact, quantity.law) for quantity in ground.used}
    contacts = {quantity.contact for quantity in quantities}
    needed = {"constant": "mass and area are", "coulomb": "their mass is"}
    lines = [f"{each}s give no {_SHORT[law]}, for which {needed[law]} needed: the file does not "
             f"say how they resist under --friction {law}"
             for each in ("side", "tip") for law in ([ground.law] if ground.law else LAWS)
             if each in contacts and (each, law) not in pairs]  # fmt: skip
    if "tip" not in contacts and ground.law != "coulomb":
        lines.append("tips were not tested: they resist by nothing in the file, as on felt")
    if "tip" not in contacts and ground.law == "coulomb":
        lines.append("tips were not tested: they have the coefficient of sides in the file")
    if "side" not in contacts:
        lines.append("sides were not tested: they resist by nothing in the file, as on gelatin")
    ways = {
        contact: {q.way for q in ground.used if q.contact == contact}
        for contact, _ in sorted(pairs)
    }
    for each, tried in ways.items():
        if others := [way for way in WAYS if way in set().union(*ways.values()) - tried]:
            lines.append(f"{each}s were not tested {' and '.join(others)}: what the file says of "
                         "them ahead is taken there")  # fmt: skip
    return lines


def _at_rest(quantities: Sequence[Quantity]) -> list[str]:
    """Friction at rest over that of sliding, where both were tested."""
    by = {(quantity.name, quantity.state): quantity.estimate.value for quantity in quantities}
    return [
        f"{name}: {value / by[name, 'slides']:.3g} times as much at rest as in sliding; "
        "static_ratio takes that, with a stribeck_speed that these tests do not give"
        for (name, state), value in by.items()
        if state == "begins" and by.get((name, "slides"), 0.0) > 0
    ]


def film_command(ground: Ground, path: Path, law: str) -> str:
    """The command that fits a film of two cycles, beside what these tests say.

    Args:
        ground: of the tests.
        path: of its file.
        law: of friction in the file.
    """
    along = [quantity for quantity in ground.used if quantity.way != "across"]  # as a film shows
    certain = [q for q in along if q.law == law and q.estimate.value > 0]
    free = ["robot.modulus", *(f"surface.{quantity.name}" for quantity in certain)]
    priors = [f"surface.{q.name}={q.estimate.value:.4g}+-{q.estimate.error:.2g}" for q in certain
              if q.estimate.error > 0 and not (q.apart or q.missed)]  # fmt: skip
    prior = f" --prior {','.join(priors)}" if priors else ""
    return f"undulator fit track.csv --scene {path} --cycles 2 --free {','.join(free)}{prior}"


def record_of(tested: Sequence[Sample], quantities: Sequence[Quantity]) -> dict[str, Any]:
    """Fields of the JSON object, in SI units."""
    return {
        "quantities": [
            {"name": q.name, "sliding": q.state, "unit": _UNITS[q.law][q.contact] or "1",
             "value": q.estimate.value, "low_95": q.low, "high_95": q.high,
             "standard_error": q.estimate.error, "degrees_of_freedom": q.estimate.freedom,
             "readings": q.counts, "by_test": {t: e.value for t, e in q.tests.items()},
             "load_over_size": q.pressed, "tests_differ": q.apart, "law_refused": q.missed}
            for q in quantities
        ],
        "laws": [
            {"contact": s.contact, "way": s.way, "sliding": s.state, "test": s.test,
             "law": s.verdict.law or None, "misses": s.verdict.misses,
             "bound": s.verdict.bound._asdict(), "coefficient": s.verdict.coefficient._asdict()}
            for s in tested if s.verdict
        ],
    }  # fmt: skip
