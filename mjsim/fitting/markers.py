"""Markers of a track beside each other: what no body can show, and what a wrong film shows."""

from collections.abc import Iterator, Mapping, Sequence
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from analytic.scene.limbs import limbs_of
from mjsim.files.scene_tables.tables import Tables, build
from mjsim.fitting.observations import Series
from mjsim.fitting.parameters import with_values
from mjsim.scene import Scene

Array = NDArray[np.float64]

_ENDS = {"left": 0.0, "right": 1.0}
_OFF = 0.02  # of a distance, from which on a scale is called wrong; chosen
_UNLIKE = 0.05  # of a period, likewise; chosen
_SAMPLES, _LONGEST = 400, 0.75  # of a film, and the part of it after which it may repeat; chosen
_ALIKE, _NEAR = 0.8, 0.1  # correlation of a film that repeats, and of its first repetition; chosen
_FAR = 1.05  # of the body between two markers, beyond which they cannot be apart; chosen


class Chord(NamedTuple):
    """Two markers of one walk, and how far the second is ahead of the first.

    Attributes:
        first, second: their series; the first is nearer to the left end.
        part: of the length that lies between them.
        time: at which both are seen, (n,) [s].
        ahead: of the second along x, (n,) [m].
        rows: numbers of the values in either series, (n,) each.
    """

    first: Series
    second: Series
    part: float
    time: Array
    ahead: Array
    rows: tuple[NDArray[np.intp], NDArray[np.intp]]

    @property
    def names(self) -> str:
        """Names of the file and of both markers."""
        return f"{self.first.name} and {self.second.name.partition(': ')[2]}"


def chords(series: Sequence[Series]) -> Iterator[Chord]:
    """Neighbouring markers along x of each walk."""
    walks: dict[int | None, list[tuple[float, Series]]] = {}
    for each in series:
        if each.quantity in ("left", "right", "x"):
            place = _ENDS.get(each.quantity, each.place)
            walks.setdefault(each.offset, []).append((place, each))
    for markers in walks.values():
        markers.sort(key=lambda marker: marker[0])
        for (near, first), (far, second) in pairwise(markers):
            time, one, two = np.intersect1d(first.at, second.at, return_indices=True)
            if len(time) and far > near:
                yield Chord(first, second, far - near, time, second.value[two] - first.value[one],
                            (one, two))  # fmt: skip


def check_places(series: Sequence[Series], base: Tables, start: Mapping[str, float]) -> None:
    """Check that markers are in their order and no farther apart than the body between them.

    Args:
        series: measurements.
        base: tables of the scene.
        start: values at which fields are when the fit begins; where a length is one of them,
            nothing is checked.

    Raises:
        ValueError: in most rows of a track they are not.
    """
    if any(name.rpartition(".")[2] == "length" for name in start):
        return
    for chord in chords(series):
        scene = _scene(base, start, chord)
        between = chord.part * limbs_of(scene.robot)[0].strip.length
        ahead = float(np.median(chord.ahead))
        if abs(ahead) > _FAR * between:
            raise ValueError(
                f"{chord.names} are {1e3 * abs(ahead):.4g} mm apart in most rows, and the body "
                f"between them is {1e3 * between:.4g} mm long: look at the unit, or the size of a "
                "pixel"
            )
        if ahead < 0 and not scene.in_space:
            raise ValueError(
                f"{chord.names} are in the wrong order in most rows: x must grow from left to right"
            )


def _scene(base: Tables, values: Mapping[str, float], chord: Chord) -> Scene:
    run = chord.first.runs[0]
    return build(with_values(base, values, dict(run.fields), run.surface))[0]


def film(
    series: Sequence[Series], model: Sequence[Array], base: Tables, values: Mapping[str, float]
) -> list[str]:
    """Notes on what may be wrong with a film that a model cannot follow: its scale, or its clock.

    Args:
        series: measurements.
        model: of each, where the model misses them.
        base: tables of the scene.
        values: of fields in the model.
    """
    modelled = {id(one): values for one, values in zip(series, model, strict=True)}
    walks: dict[int | None, list[Chord]] = {}
    for chord in chords(series):
        walks.setdefault(chord.first.offset, []).append(chord)
    lines = []
    for pairs in walks.values():
        name = pairs[0].first.name.partition(":")[0]
        period = _scene(base, values, pairs[0]).gait.period
        seen = 1e3 * sum(chord.ahead[0] for chord in pairs)
        expected = 1e3 * sum(
            modelled[id(chord.second)][chord.rows[1][0]]
            - modelled[id(chord.first)][chord.rows[0][0]]
            for chord in pairs
        )
        if seen > 0 and abs(expected / seen - 1) > _OFF:
            lines.append(
                f"{name}: the outer markers begin {seen:.4g} mm apart, and the model's "
                f"{expected:.4g} mm: is a pixel {expected / seen:.3g} times as large?"
            )
        again = _repeats(pairs)
        if again and abs(again / period - 1) > _UNLIKE:
            lines.append(
                f"{name}: the markers' distances repeat after {again:.2g} s, and the gait after "
                f"{period:.2g} s: are the pictures per second right?"
            )
    return lines


def _repeats(pairs: Sequence[Chord]) -> float | None:
    """Time after which distances of markers are as they were [s]; None if none is clear."""
    begin, end = max(c.time[0] for c in pairs), min(c.time[-1] for c in pairs)
    time = np.linspace(begin, end, _SAMPLES)
    each = [np.interp(time, chord.time, chord.ahead) for chord in pairs]
    lags = np.arange(1, int(_LONGEST * _SAMPLES))
    alike = np.array([np.mean([_alike(one[lag:], one[:-lag]) for one in each]) for lag in lags])
    apart = np.flatnonzero(alike < 0)
    if not apart.size or alike[apart[0] :].max() < _ALIKE:
        return None
    later = alike[apart[0] :]
    peaks = np.flatnonzero(later > later.max() - _NEAR) + apart[0]
    first = peaks[: np.append(np.flatnonzero(np.diff(peaks) > 1), len(peaks) - 1)[0] + 1]
    return float(time[lags[first[np.argmax(alike[first])]]] - begin)


def _alike(one: Array, other: Array) -> float:
    """Correlation, 0 where one of them does not move."""
    return float(np.corrcoef(one, other)[0, 1]) if np.ptp(one) and np.ptp(other) else 0.0
