"""Measurements that decide on a robot that nobody fitted: walks of scenes near the one known.

Logarithms of inputs are spread by their errors, those that a source states or, where it states
none, assumed ones. Straight lines through what walks show (least squares) are the slopes over that
spread: walks under friction have kinks, so that their slopes at one scene say little. What the
lines miss no input tells: it is not known either, and spread as the walks beside their lines are.
"""

import csv
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path
from typing import NamedTuple

import numpy as np
from scipy.linalg import block_diag
from scipy.special import ndtri
from scipy.stats import qmc

from studies import Array
from zoo.deciding import Measurement, errors, narrowed

_SEED = 36
_CENTRED = 0.5  # of a cell; so that no chance is 0


class Input(NamedTuple):
    """An input of a model.

    Attributes:
        name: in words.
        error: relative standard error of what is known of it.
        accuracy: relative standard error of a measurement of it.
    """

    name: str
    error: float
    accuracy: float


class Quantity(NamedTuple):
    """A quantity that walks show.

    Attributes:
        name: in words.
        unit: its unit.
        accuracy: standard error of a measurement of it; None if it is only predicted.
        predicted: whether the error of its prediction is asked for.
    """

    name: str
    unit: str
    accuracy: float | None
    predicted: bool = False


class Study(NamedTuple):
    """A robot near which scenes are walked.

    Attributes:
        inputs: what is not known, (F,).
        quantities: what walks show, (K,).
        walk: function from factors of the inputs, (F,), to the quantities, (K,); NaN where a walk
            failed.
        table: file of walks, see `walked`.
    """

    inputs: Sequence[Input]
    quantities: Sequence[Quantity]
    walk: Callable[[Array], Array]
    table: Path


class Lines(NamedTuple):
    """Straight lines through walks.

    Attributes:
        value: at the known scene, (K,).
        slope: by logarithms of inputs, and by what lines miss, (K, F + K).
        missed: covariance of what lines miss, (K, K).
    """

    value: Array
    slope: Array
    missed: Array


def spread(study: Study, count: int) -> Array:
    """Logarithms of factors of the inputs, (count, F): normal by their errors, evenly (Sobol)."""
    sobol = qmc.Sobol(len(study.inputs), scramble=True, seed=_SEED)
    chance = np.clip(sobol.random(count), _CENTRED / count, 1 - _CENTRED / count)
    return np.asarray(ndtri(chance) * [one.error for one in study.inputs])


def walk(study: Study, count: int) -> None:
    """Walk scenes near the known one, and write the table."""
    inputs = spread(study, count)
    with ProcessPoolExecutor() as pool:
        walks = list(pool.map(study.walk, np.exp(inputs)))
    with study.table.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow([*(one.name for one in study.inputs), *(q.name for q in study.quantities)])
        writer.writerows([[f"{x:.5g}" for x in (*np.exp(row), *shown)]
                          for row, shown in zip(inputs, walks, strict=True)])  # fmt: skip


def walked(study: Study) -> tuple[Array, Array]:
    """Logarithms of factors of inputs (N, F), and quantities (N, K), of walks that went well."""
    rows = np.genfromtxt(study.table, delimiter=",", skip_header=1)
    rows = rows[np.isfinite(rows).all(axis=1)]
    count = len(study.inputs)
    return np.log(rows[:, :count]), rows[:, count:]


def lines(inputs: Array, quantities: Array) -> Lines:
    """Straight lines through quantities (N, K) over inputs (N, F), by least squares."""
    columns = np.column_stack([np.ones(len(inputs)), inputs])
    coefficients, *_ = np.linalg.lstsq(columns, quantities, rcond=None)
    beside = quantities - columns @ coefficients
    missed = beside.T @ beside / (len(inputs) - columns.shape[1])
    return Lines(
        coefficients[0], np.column_stack([coefficients[1:].T, np.eye(len(missed))]), missed
    )


def measurements(study: Study, near: Lines) -> list[Measurement]:
    """Quantities that could be measured: each input, and each quantity that has an accuracy."""
    unit = np.eye(near.slope.shape[1])
    ones = [Measurement(f"{one.name}, ± {one.accuracy:.0%}", unit[k], one.accuracy)
            for k, one in enumerate(study.inputs)]  # fmt: skip
    return ones + [
        Measurement(f"{one.name}, ± {one.accuracy:g} {one.unit}", slope, one.accuracy)
        for one, slope in zip(study.quantities, near.slope, strict=True)
        if one.accuracy is not None
    ]


def known(study: Study, near: Lines) -> Array:
    """Covariance of logarithms of inputs and of what lines miss, (F + K, F + K)."""
    return block_diag(np.diag([one.error**2 for one in study.inputs]), near.missed)


def left(study: Study, near: Lines, measured: Sequence[Measurement] = ()) -> Array:
    """Standard errors of the predicted quantities after measurements, (P,)."""
    covariance = known(study, near)
    for one in measured:
        covariance = narrowed(covariance, one.slope, one.error)
    return errors(covariance, near.slope[[one.predicted for one in study.quantities]])


def tell(study: Study, others: Mapping[str, float]) -> None:
    """Print a row per measurement, those that tell most first; and where others say otherwise.

    Args:
        study: walks near a scene.
        others: what another model or a source says, by name of the quantity.
    """
    near = lines(*walked(study))
    asked = [k for k, one in enumerate(study.quantities) if one.predicted]
    before = left(study, near)
    print("| measurement | " + " | ".join(study.quantities[k].name for k in asked) + " |")
    print("|---" * (len(asked) + 1) + "|")
    rows = [("none", before), *sorted(
        ((one.name, left(study, near, [one])) for one in measurements(study, near)),
        key=lambda row: float(np.mean(row[1] / before)))]  # fmt: skip
    rows.append(("all inputs, exactly", np.sqrt(np.diag(near.missed))[asked]))
    for name, after in rows:
        cells = (f"{x:.2g} {study.quantities[k].unit}" for x, k in zip(after, asked, strict=True))
        print(f"| {name} | " + " | ".join(cells) + " |")
    unsure = errors(known(study, near), near.slope)
    for one, value, error in zip(study.quantities, near.value, unsure, strict=True):
        if one.name in others:
            other = others[one.name]
            print(f"{one.name}: {value:.3g} ± {error:.2g} {one.unit} for {other:.3g}, "
                  f"{abs(value - other) / error:.1f} errors apart")  # fmt: skip
