"""Walks of many scenes by few models: the results of `simulate`, for half its CPU time.

Scenes that cannot be stepped in a batch are walked by `simulate`; see
mjsim.simulation.side_by_side.layout.refusal.
"""

import time as clock
from collections.abc import Hashable, Sequence

import numpy as np
from numpy.typing import NDArray

from analytic.scene.chain import link_lengths
from mjsim.model.bodies.parts import TOUCH
from mjsim.results.judge import judge
from mjsim.results.status import Status
from mjsim.results.trajectory import Trajectory
from mjsim.scene import Numerics, Resolved, Scene, resolved
from mjsim.simulation.batch import Refused
from mjsim.simulation.schedule import check_steps, walking
from mjsim.simulation.side_by_side.layout import layout, refusal
from mjsim.simulation.side_by_side.strips import Block, StripBatch
from mjsim.simulation.simulation import simulate

Array = NDArray[np.float64]

BATCH_SIZE = 64  # scenes at a time; chosen: more gain little, and need memory
_BLOCK = 256  # steps that are prepared at once


def simulate_batch(
    scenes: Sequence[Scene], numerics: Numerics | None = None, threads: int = 1
) -> list[Trajectory | Refused]:
    """One walk per scene, in order; scenes of one layout are stepped together.

    Args:
        scenes: the walks.
        numerics: for all of them; chosen for each if None.
        threads: of MuJoCo; for many cores processes are better, see undulator sweep.

    Returns:
        One trajectory per scene, or why there is none.
    """
    walks: dict[int, Trajectory | Refused] = {}
    alike: dict[Hashable, list[int]] = {}
    for i, scene in enumerate(scenes):
        complete = resolved(scene, numerics)
        try:
            check_steps(scene, complete)
            if refusal(scene, complete):
                walks[i] = simulate(scene, numerics)
            else:
                alike.setdefault((complete, layout(scene, complete)), []).append(i)
        except ValueError as error:
            walks[i] = Refused(scene, str(error))
    for group in alike.values():
        for begin in range(0, len(group), BATCH_SIZE):
            some = group[begin : begin + BATCH_SIZE]
            batch = _batch([scenes[i] for i in some], numerics, threads)
            walks |= dict(zip(some, batch, strict=True))
    return [walks[i] for i in range(len(scenes))]


def _batch(
    scenes: Sequence[Scene], numerics: Numerics | None, threads: int
) -> list[Trajectory | Refused]:
    try:
        strips = StripBatch(scenes, resolved(scenes[0], numerics), threads)
    except ValueError as error:
        if len(scenes) > 1:  # one that MuJoCo refuses must not spoil the others
            return [walk for s in scenes for walk in _batch([s], numerics, threads)]
        return [Refused(scenes[0], str(error))]
    started, worked = clock.perf_counter(), clock.process_time()
    every = np.arange(len(scenes))
    blocks = strips.reset(every)
    settled = strips.settled
    valves = [walking(scene, strips.numerics, scene.gait) for scene in scenes]
    lengths = np.array([len(commands) for commands in valves])
    begin = 0
    while (rows := np.flatnonzero((lengths > begin) & settled & ~strips.stopped)).size:
        end = min(begin + _BLOCK, int(lengths[rows].min()))
        blocks.append(strips.play(np.array([valves[row][begin:end] for row in rows]), rows))
        begin = end
    wall = (clock.perf_counter() - started) / len(scenes)
    cpu = (clock.process_time() - worked) / len(scenes)
    return [
        # a strip that takes long to come to rest has more steps before the first cycle
        _trajectory(strips, row, blocks, wall, cpu)
        if settled[row] or strips.stopped[row]
        else simulate(scenes[row], numerics)
        for row in range(len(scenes))
    ]


def _trajectory(
    strips: StripBatch, row: int, blocks: Sequence[Block], wall: float, cpu: float
) -> Trajectory:
    parts = []
    for block in blocks:
        (at,) = np.flatnonzero(block.rows == row)[:1] if row in block.rows else (None,)
        if at is not None:
            parts.append((block, at, slice(block.steps[at])))
    scene, numerics = strips.scenes[row], strips.numerics
    before = sum(block.pressure.shape[1] for block in blocks[:2])
    coordinates = np.concatenate([block.coordinates[at, steps] for block, at, steps in parts])
    contact = np.concatenate([block.contact[at, steps] for block, at, steps in parts])
    first = 1 - before
    walk = Trajectory(
        scene=scene,
        numerics=numerics,
        status=Status.OK,
        time=numerics.timestep * np.arange(first, first + len(coordinates), dtype=float),
        pressure=np.concatenate([block.pressure[at, steps] for block, at, steps in parts]),
        coordinates=coordinates,
        position=planar_nodes(scene, numerics, coordinates)[:, None],
        contact_left=contact[:, 0],
        contact_right=contact[:, 1],
        left_slip_fraction=np.concatenate([b.left_slip[at, steps] for b, at, steps in parts]),
        drift=np.concatenate([block.drift[at, steps] for block, at, steps in parts]),
        wall_time=wall,
        cpu_time=cpu,
    )
    return judge(walk, stopped=bool(strips.stopped[row]))


def planar_nodes(scene: Scene, numerics: Resolved, coordinates: Array) -> Array:
    """Vertices of body chain's neutral line, z over flat rest, (T, N + 2, 3) [m].

    The kinematics of a chain in a plane, in closed form.
    """
    lengths = link_lengths(scene.strip, numerics.links)
    angles = np.cumsum(coordinates[:, 2:], axis=1)
    position = np.zeros((len(coordinates), len(lengths) + 1, 3))
    begin = coordinates[:, 0], coordinates[:, 1] - TOUCH * scene.strip.length
    for axis, start, part in zip((0, 2), begin, (np.cos, np.sin), strict=True):
        position[:, 0, axis] = start
        position[:, 1:, axis] = start[:, None] + np.cumsum(lengths * part(angles), axis=1)
    return position
