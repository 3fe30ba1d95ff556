"""Numbers of a surface from tilt and pull tests, with 95 % intervals.

The resistance of a sample is that of one of two laws: a bound, tau A of a side and V_t of each tip,
or mu N. Each number is a least-squares slope: of resistance over area, number of tips, or normal
load. Of a tilt, resistance and load are parts of the weight, m g sin(angle) and m g cos(angle), and
all is over the weight, so that readings of different masses count alike. Where loads differ, the
sum of both laws is fitted as well and tells which of the two is needed. Scatter is of one size, as
that of a balance, or in proportion to the resistance, as friction's own, whichever is likelier.
"""

import math
from collections.abc import Iterable, Sequence
from itertools import groupby
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.special import fdtrc, stdtr

from mjsim.fitting.sliding_slopes import (
    Estimate,
    best,
    least,
    scatters,
    slopes,
)
from mjsim.fitting.sliding_tests import STATES, TESTS, WAYS, Reading

Array = NDArray[np.float64]

LAWS = ("constant", "coulomb")
BOTH = "both"
NAMES = {("side", "constant"): "shear_strength", ("side", "coulomb"): "friction",
         ("tip", "constant"): "tip_force", ("tip", "coulomb"): "tip_friction"}  # fmt: skip
"""Field of a surface by contact and law."""
_CHANCE = 0.01  # below which data are said to refuse a law, or two tests to differ; chosen
_SPREAD = 1.2  # of the load over the size, from which on it tells the laws apart; chosen
_LEAST = 2  # degrees of freedom of a fit of both laws


class Verdict(NamedTuple):
    """Law that readings under several loads support.

    Attributes:
        law: constant, coulomb, both (neither alone), or empty where either may be.
        misses: residual of each law, and of both together, over the resistance: rms.
        bound: tau or V_t, beside a coefficient.
        coefficient: mu, beside a bound.
    """

    law: str
    misses: dict[str, float]
    bound: Estimate
    coefficient: Estimate


class Sample(NamedTuple):
    """Readings of one kind.

    Attributes:
        contact: side or tip.
        way: ahead, back or across.
        state: begins or slides.
        test: tilt or pull.
        readings: of this kind.
        estimates: by law, those that the readings give.
        verdict: None where loads do not differ.
    """

    contact: str
    way: str
    state: str
    test: str
    readings: tuple[Reading, ...]
    estimates: dict[str, Estimate]
    verdict: Verdict | None


class Quantity(NamedTuple):
    """A field of a surface.

    Attributes:
        contact, way, state: of its samples.
        law: under which it acts.
        estimate: of all tests, each counting alike.
        low, high: 95 % interval, NaN where there is none.
        tests: estimate of each.
        counts: readings of each test.
        pressed: least and largest load over the size, Pa on a side and N on a tip; NaN where a load
            is not given.
        apart: whether the tests differ beyond their scatter; the interval spans both then.
        missed: whether the data refuse its law; there is no interval then.
    """

    contact: str
    way: str
    state: str
    law: str
    estimate: Estimate
    low: float
    high: float
    tests: dict[str, Estimate]
    counts: dict[str, int]
    pressed: tuple[float, float]
    apart: bool
    missed: bool

    @property
    def name(self) -> str:
        """Field of a surface."""
        base = NAMES[self.contact, self.law]
        return base if self.way == "ahead" else f"{base}_{self.way}"


def samples(readings: Iterable[Reading]) -> list[Sample]:
    """Samples of readings, with what each tells."""

    def kind(reading: Reading) -> tuple[int, int, int, int]:
        return (("side", "tip").index(reading.contact), WAYS.index(reading.way),
                STATES.index(reading.state), TESTS.index(reading.test))  # fmt: skip

    groups = [tuple(group) for _, group in groupby(sorted(readings, key=kind), key=kind)]
    # of several samples each is less likely to refuse by chance, so that all together are as one
    return [_sample(group, _CHANCE / len(groups)) for group in groups]


def _sample(readings: tuple[Reading, ...], chance: float) -> Sample:
    first = readings[0]
    terms = np.array([reading.terms for reading in readings])
    whole = np.isfinite(terms).all(axis=1)
    several = _tell_apart([r for r, complete in zip(readings, whole, strict=True) if complete])
    sizes = scatters(terms[whole, 1:], terms[whole, 0]) if several else []
    estimates = {}
    for column, law in enumerate(LAWS, start=1):
        rows = terms[np.isfinite(terms[:, column])][:, [0, column]]
        if len(rows):
            scatter = (
                sizes if sizes and len(rows) == whole.sum() else scatters(rows[:, 1:], rows[:, 0])
            )
            (estimates[law],) = best(rows[:, 1:], rows[:, 0], scatter)
    verdict = _verdict(terms[whole], sizes, chance) if several else None
    return Sample(first.contact, first.way, first.state, first.test, readings, estimates, verdict)


def _tell_apart(readings: Sequence[Reading]) -> bool:
    """Tell whether loads of readings over their sizes differ, and readings are enough."""
    ratios = [reading.load / reading.size for reading in readings]
    return len(ratios) >= 2 + _LEAST and max(ratios) >= _SPREAD * min(ratios)


def _verdict(terms: Array, sizes: Sequence[Array], chance: float) -> Verdict | None:
    """Law that readings support; None where nothing resists.

    Args:
        terms: resistance, size and load of each, (n, 3).
        sizes: of their scatter that are likely, the likeliest first.
        chance: of data like these below which a law is refused.
    """
    weighed = terms / sizes[0][:, None]
    resistance, columns = weighed[:, 0], weighed[:, 1:]
    square = float(np.mean(resistance**2))
    if not square:
        return None
    bound, coefficient = best(terms[:, 1:], terms[:, 0], sizes)
    rest = max(slopes(columns, resistance)[1], least(resistance))
    freedom = len(terms) - 2
    alone = {law: max(slopes(columns[:, [i]], resistance)[1], least(resistance))
             for i, law in enumerate(LAWS)}  # fmt: skip
    kept = [law for law in LAWS
            if fdtrc(1, freedom, freedom * (alone[law] / rest - 1)) >= chance]  # fmt: skip
    law = BOTH if not kept else kept[0] if len(kept) == 1 else ""
    misses = {law: math.sqrt(rest / (freedom + 1) / square) for law, rest in alone.items()}
    misses[BOTH] = math.sqrt(rest / freedom / square)
    return Verdict(law, misses, bound, coefficient)


def quantities(tested: Iterable[Sample]) -> list[Quantity]:
    """Fields of a surface from samples, which come in the order of `samples`."""
    result = []
    for _, group in groupby(tested, key=lambda sample: sample[:3]):
        kinds = list(group)
        for law in LAWS:
            telling = [sample for sample in kinds if law in sample.estimates]
            if telling:
                result.append(_quantity(law, telling))
    return result


def _quantity(law: str, telling: Sequence[Sample]) -> Quantity:
    tests = {sample.test: sample.estimates[law] for sample in telling}
    column = 1 + LAWS.index(law)
    counts = {s.test: sum(bool(np.isfinite(r.terms[column])) for r in s.readings) for s in telling}
    missed = any(s.verdict and s.verdict.law not in ("", law) for s in telling)
    whole = together(list(tests.values()))
    low, high = whole.interval
    apart = differ(list(tests.values()))
    if apart:
        low = min(estimate.interval[0] for estimate in tests.values())
        high = max(estimate.interval[1] for estimate in tests.values())
    if missed:
        low = high = math.nan
    pressed = [reading.pressed for sample in telling for reading in sample.readings]
    return Quantity(
        *telling[0][:3], law, whole, max(low, 0.0), high, tests, counts,
        (min(pressed), max(pressed)), apart, missed,
    )  # fmt: skip


def together(tests: Sequence[Estimate]) -> Estimate:
    """Mean of the estimates of tests, freedom after Welch and Satterthwaite.

    Tests count alike, whatever their scatter: what is wrong with a board is not wrong with a
    balance. Those of one reading count where there are no others.
    """
    sure = [test for test in tests if not math.isnan(test.error)] or list(tests)
    value = sum(test.value for test in sure) / len(sure)
    squares = [test.error**2 for test in sure]
    total = sum(squares)
    error = math.sqrt(total) / len(sure)
    return Estimate(value, error, _freedom(sure))


def _freedom(tests: Sequence[Estimate]) -> float:
    squares = [test.error**2 for test in tests]
    spread = sum(square**2 / max(test.freedom, 1) for square, test in zip(squares, tests,
                                                                         strict=True))  # fmt: skip
    return sum(squares) ** 2 / spread if spread > 0 else min(test.freedom for test in tests)


def differ(tests: Sequence[Estimate]) -> bool:
    """Tell whether two tests differ beyond chance, 1 %, by Welch's t test."""
    if len(tests) < 2 or any(math.isnan(test.error) for test in tests):
        return False
    one, two = tests
    error = math.hypot(one.error, two.error)
    if not error:
        return not math.isclose(one.value, two.value)
    p = 2 * stdtr(_freedom(tests), -abs(one.value - two.value) / error)
    return bool(p < _CHANCE)
