"""The gaits of two to four states that go farthest: `python -m zoo.terresoro_iv.best`.

Farthest from where they began after 60 transitions (27 s), which gaits that turn are not. Of the
12,160 cycles those alike by quarter turns are one, which leaves the measured transitions four
values of it.
"""

from collections.abc import Iterator
from itertools import permutations

import numpy as np

from studies import Array
from zoo.terresoro_iv.model import (
    LIMBS,
    Law,
    Numbers,
    by_friction,
    cycle,
    fitted,
    gaits,
    jackknife,
    together,
    transitions,
)

TRANSITIONS, SECONDS = 60, 0.45
STATES = tuple(format(number, "04b") for number in range(2**LIMBS))
_SHOWN = 4


def shifted(states: tuple[str, ...], limbs: int) -> tuple[str, ...]:
    """States with the limbs renumbered by so many quarter turns."""
    return tuple(state[limbs:] + state[:limbs] for state in states)


def first(states: tuple[str, ...]) -> tuple[str, ...]:
    """The same cycle from its first state in order."""
    start = states.index(min(states))
    return states[start:] + states[:start]


def cycles() -> Iterator[tuple[str, ...]]:
    """One of each four that are alike by quarter turns."""
    for count in (2, 3, 4):
        for states in permutations(STATES, count):
            if states[0] == min(states) and states == min(
                first(shifted(states, limbs)) for limbs in range(LIMBS)
            ):
                yield states


def reach(states: tuple[str, ...], law: Law) -> float:
    """Distance after TRANSITIONS [cm]."""
    distance, turn = cycle(states, law)
    times, half = TRANSITIONS // len(states), np.radians(turn) / 2
    if abs(np.sin(half)) < 1e-9:
        return float(times * distance)
    return float(distance * abs(np.sin(times * half) / np.sin(half)))


def tabled(law: Law) -> Law:
    """The same law with all transitions worked out once."""
    pairs, _ = transitions()
    return together(pairs, law(pairs))


def main() -> None:
    """Print the farthest gaits by both minima, and what measured transitions say of them."""
    every = list(cycles())
    measured = together(*transitions())
    by_measured = {one: _copies(one, measured) for one in every}
    farthest = max(every, key=lambda one: float(by_measured[one].mean()))
    print(f"{len(every)} gaits; farthest by measured transitions: {_line(farthest, by_measured)}")
    for minimum in (0, 1):
        best, left_out = fitted(minimum)
        laws = [tabled(by_friction(Numbers(*row))) for row in (best, *left_out)]
        far = np.array([[reach(one, law) for one in every] for law in laws])
        error = jackknife(far[1:])
        order = np.argsort(-far[0])
        wins = np.bincount(far[1:].argmax(axis=1), minlength=len(every))
        ranks = np.corrcoef(far[0], [by_measured[one].mean() for one in every])[0, 1]
        print(f"minimum {minimum + 1}: correlation with the measured transitions {ranks:.2f}")
        for k in order[:_SHOWN]:
            print(f"    {far[0, k]:.1f} ± {error[k]:.1f} cm, first in {wins[k]} of {len(left_out)} "
                  f"fits; " + _line(every[k], by_measured))  # fmt: skip
        for gait in gaits():
            print(f"    {gait.name}: {reach(gait.states, laws[0]):.1f} cm")
    for gait in gaits():
        turn, distance = np.radians(gait.mean[2]) / 2, np.hypot(*gait.mean[:2])
        times = TRANSITIONS // len(gait.states)
        print(f"{gait.name} as measured: {distance * abs(np.sin(times * turn) / np.sin(turn)):.1f}")


def _copies(states: tuple[str, ...], law: Law) -> Array:
    """Reaches of the four gaits that are alike [cm]."""
    return np.array([reach(shifted(states, limbs), law) for limbs in range(LIMBS)])


def _line(states: tuple[str, ...], by_measured: dict[tuple[str, ...], Array]) -> str:
    there = by_measured[states]
    low, high = there.min(), there.max()
    return f"{' '.join(states)} (measured transitions {there.mean():.1f}, {low:.1f} to {high:.1f})"


if __name__ == "__main__":
    main()
