"""Contacts looked ahead along the path of what comes to the ground, to the end of a step.

A pad moves by J v dt + J' v dt^2 / 2 in a step of constant rates v. MuJoCo's contacts leave the
second part out, so that an end that swings leaves the ground for a step, or sinks in, with every
step: hops that the friction takes for slips. With the integrator discrete a contact of depth r and
time constant c dt asks for J v = -r / ((1 + c)^2 dt) at the end of the step; here it is given the
depth that makes it ask for J' v dt / 2 less.

MuJoCo's contacts also begin only with a pad that is in the ground. An end that comes down on its
side sinks in by a step's way, and is told from a tip two or three steps late, in which time it is
held as a tip. Here pads over the ground are contacts too: one at height h asks for J v = -h / dt,
and lands at the end of the step.
"""

import mujoco
import numpy as np

from analytic.scene.chain import link_lengths
from mjsim.model.ceiling import ceiling_of
from mjsim.model.pads import node_of_geom, pads_by_node
from mjsim.scene import Resolved, Scene

_PITCH = 2  # of the coordinates: before it x and z, after it the hinges
_LEAST = 1e-8  # m; paths less curved than this in a step are straight; chosen
_AHEAD = 0.004  # of L: height of pads from which on their landing is foreseen; chosen


class CurvedPaths:
    """Steps of a chain in the plane; see the module.

    Args:
        scene, numerics: what is simulated.
        model, data: as compiled.
    """

    def __init__(
        self, scene: Scene, numerics: Resolved, model: mujoco.MjModel, data: mujoco.MjData
    ) -> None:
        pads = pads_by_node(model)
        self._node: list[int] = node_of_geom(model, pads, other=-1).tolist()
        self._lengths = -np.asarray(link_lengths(scene.strip, numerics.links))
        self._rise, self._dt = np.zeros(len(pads)), numerics.timestep
        self._rates, self._angles = data.qvel[_PITCH:], data.qpos[_PITCH:]
        self._softness = model.geom_solref[:, 0]
        self._least = _LEAST / (0.5 * self._dt**2 * scene.strip.length)
        # contacts with friction stiffen with their depth; adhesion has a margin of its own
        self._landing = scene.friction != "coulomb" and not model.geom_gap[pads].any()
        if self._landing:
            model.geom_margin[pads] = _AHEAD * scene.strip.length

    def step(self, model: mujoco.MjModel, data: mujoco.MjData) -> None:
        """Do a time step."""
        rates = self._rates.cumsum()
        squares = rates * rates
        straight = squares.max() < self._least
        if not self._landing and (straight or not data.ncon):
            mujoco.mj_step(model, data)
            return
        mujoco.mj_step1(model, data)
        contact, depths, margins = data.contact, data.efc_pos, data.efc_margin
        pads = contact.geom2.tolist()
        if pads and not straight:
            # J' v of a node over dt: the links turn by constant rates
            (self._lengths * np.sin(self._angles.cumsum()) * squares).cumsum(out=self._rise[1:])
        # plain floats: numpy is slow on a few numbers
        for row, pad in zip(contact.efc_address.tolist(), pads, strict=True):
            node = self._node[pad]
            # in an adhesive gap, or at the ceiling, where paths are taken for straight
            if row < 0 or node < 0:
                continue
            # dt (1 + c), of the pads' time constants c dt
            reach, depth = self._softness.item(pad) + self._dt, depths.item(row)
            if self._landing:
                margins[row] = 0.0
                if depth > 0.0:
                    stretch = reach / self._dt
                    depth *= stretch * stretch
            if not straight:
                depth += 0.5 * reach * reach * self._rise.item(node)
            depths[row] = depth
        mujoco.mj_step2(model, data)


class CurvedPathsInSpace:
    """Steps of a robot of limbs; see the module. Where the pads come to is found by kinematics.

    Args:
        model, numerics: as compiled, and how it is discretised.
    """

    def __init__(self, model: mujoco.MjModel, numerics: Resolved) -> None:
        self._dt, self._ceiling = model.opt.timestep, ceiling_of(model)
        # ((1 + c) dt)^2 over dt^2
        self._stretch = (1.0 + numerics.contact_time) ** 2

    def step(self, model: mujoco.MjModel, data: mujoco.MjData) -> None:
        """Do a time step."""
        if not data.ncon:
            mujoco.mj_step(model, data)
            return
        before = data.qpos.copy()
        data.qpos += self._dt * data.qvel  # all joints are slides and hinges
        mujoco.mj_kinematics(model, data)
        ahead = data.geom_xpos[:, 2].copy()
        data.qpos[:] = before
        mujoco.mj_step1(model, data)
        contact = data.contact
        # at the ceiling paths are taken for straight
        acts = (contact.efc_address >= 0) & (contact.geom1 != self._ceiling)
        rows, pads = contact.efc_address[acts], contact.geom2[acts]
        straight = data.geom_xpos[pads, 2] + self._dt * data.efc_vel[rows]
        data.efc_pos[rows] += self._stretch * (ahead[pads] - straight)
        mujoco.mj_step2(model, data)


def curved_paths(
    scene: Scene, numerics: Resolved, model: mujoco.MjModel, data: mujoco.MjData
) -> CurvedPaths | CurvedPathsInSpace | None:
    """Steps along curved paths, or None where the numerics say straight ones."""
    if numerics.contact_path != "curved":
        return None
    if scene.in_space:
        return CurvedPathsInSpace(model, numerics)
    return CurvedPaths(scene, numerics, model, data)
