"""The gaits of two to four states that go farthest: `python -m zoo.terresoro_iv.best`.

Farthest from where they began after 60 transitions (27 s), which gaits that turn are not. Of the
12,160 cycles those alike by quarter turns are one, which leaves the measured transitions four
values of it. Gaits are taken as they go on and on, with what limbs remember.
"""

from collections.abc import Iterator, Sequence
from itertools import permutations

import numpy as np

from studies import Array
from zoo.terresoro_iv.forms import FORMS
from zoo.terresoro_iv.hub import LIMBS, Law, gaits, jackknife
from zoo.terresoro_iv.hub import together as known_transitions
from zoo.terresoro_iv.model import FORM, recut, recut_gaits, remembered, steady, together

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


def reach(steps: Array) -> float:
    """Distance after TRANSITIONS [cm], of a gait whose transitions move by steps, (T, 3)."""
    distance, turn = together(steps)
    times, half = TRANSITIONS // len(steps), np.radians(turn) / 2
    if abs(np.sin(half)) < 1e-9:
        return float(times * distance)
    return float(distance * abs(np.sin(times * half) / np.sin(half)))


def reaches(some: Sequence[tuple[str, ...]], values: Array, form: str = FORM) -> Array:
    """Distances of gaits after TRANSITIONS by a form of memory, (G,) [cm]."""
    pasts, afters = zip(*(steady(states) for states in some), strict=True)
    steps = FORMS[form].law(values, np.concatenate(pasts), np.concatenate(afters))
    ends = np.cumsum([len(states) for states in some])
    return np.array([reach(part) for part in np.split(steps, ends[:-1])])


def by_transitions(states: tuple[str, ...], law: Law) -> Array:
    """Distances of the four gaits that are alike, of transitions put together [cm]."""
    each = (shifted(states, limbs) for limbs in range(LIMBS))
    return np.array([reach(law(list(zip(s, (*s[1:], s[0]), strict=True)))) for s in each])


def main() -> None:
    """Print the farthest gaits, how sure they are, and what measured transitions say of them."""
    every, law = list(cycles()), known_transitions(*recut())
    put_together = {one: by_transitions(one, law) for one in every}
    farthest = max(every, key=lambda one: float(put_together[one].mean()))
    print(f"{len(every)} gaits; farthest by measured transitions: {_line(farthest, put_together)}")
    for form in (FORM, "no memory", "free flat contact"):
        values, left_out = remembered(form)
        far = np.array([reaches(every, row, form) for row in (values, *left_out)])
        error, order = jackknife(far[1:]), np.argsort(-far[0])
        wins = np.bincount(far[1:].argmax(axis=1), minlength=len(every))
        alike = np.corrcoef(far[0], [put_together[one].mean() for one in every])[0, 1]
        print(f"{form}: correlation with the measured transitions {alike:.2f}")
        for k in order[:_SHOWN]:
            print(f"    {far[0, k]:.1f} ± {error[k]:.1f} cm, first in {wins[k]} of {len(left_out)} "
                  f"fits; {_line(every[k], put_together)}")  # fmt: skip
        own = reaches([gait.states for gait in gaits()], values, form)
        names = (gait.name for gait in gaits())
        print("    " + ", ".join(f"{name} {x:.1f}" for name, x in zip(names, own, strict=True)))
    for gait in recut_gaits():
        steps = np.zeros((len(gait.states), 3))
        steps[0] = gait.mean
        print(f"{gait.name} as measured: {reach(steps):.1f} cm")


def _line(states: tuple[str, ...], put_together: dict[tuple[str, ...], Array]) -> str:
    there = put_together[states]
    low, high = there.min(), there.max()
    return f"{' '.join(states)} (measured transitions {there.mean():.1f}, {low:.1f} to {high:.1f})"


if __name__ == "__main__":
    main()
