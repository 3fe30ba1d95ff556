"""The quadruped in Drake, beside mjsim.tree and the quasi-static reference.

    .peers/bin/python benchmarks/peers/quadruped.py

Links, hinges, springs, gait and pads are those of mjsim.tree; friction is Drake's own at each pad,
of one coefficient everywhere, so that no rule of what is a tip enters. Writes a row a setting to
docs/quadruped_drake.csv, which studies.limbs draws: about ten minutes on one core.
"""

import csv
import sys
import time as clock
from dataclasses import replace
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parents[1])]

from common import GRAVITY, knots  # noqa: E402
from drake_chain import PAD, add_ground, add_pad, finalize, follow, new_plant, start  # noqa: E402
from pydrake.math import RigidTransform, RollPitchYaw  # noqa: E402
from pydrake.multibody.tree import (  # noqa: E402
    FixedOffsetFrame,
    PdControllerGains,
    RevoluteJoint,
    SpatialInertia,
    UnitInertia,
)

from analytic.scene.chain import joint_springs, link_lengths  # noqa: E402
from analytic.scene.limbs import LENGTH, quadruped  # noqa: E402
from analytic.scene.quadruped_gaits import undulation  # noqa: E402
from analytic.scene.surface import FRICTION  # noqa: E402
from mjsim.scene import Numerics, Scene  # noqa: E402

ELEMENTS, DOWN = 6, (0, -1, 0)  # hinges of a limb, and their axis: an end turns up
RAMP, DAMPING = 8.0, Numerics.damping_time  # s; of hinges over their stiffness
STEPS = (0.02, 0.01, 0.005, 0.002, 0.001, 0.0005)
TABLE = HERE.parents[1] / "docs" / "quadruped_drake.csv"


def built(scene, elements, timestep):
    """The diagram, its plant and the torso's first link."""
    robot = scene.robot
    builder, plant = new_plant(timestep)
    add_ground(plant, FRICTION, timestep)
    ends = {}
    for limb in robot.limbs:
        lengths = link_lengths(limb.strip, elements)
        stiffness, _ = joint_springs(limb.strip, elements, np.zeros((1, 1)))
        angle = limb.angle - (robot.limbs[robot.place(limb.on)].angle if limb.on else 0.0)
        before = None
        for k, length in enumerate(lengths.tolist()):
            mass, width = limb.strip.weight_per_length / GRAVITY * length, limb.strip.width
            # a plate about its beginning
            unit = UnitInertia(width**2 / 12, length**2 / 12, (width**2 + length**2) / 12)
            inertia = SpatialInertia(mass, [length / 2, 0, 0],
                                     unit.ShiftFromCenterOfMass([-length / 2, 0, 0]))  # fmt: skip
            body = plant.AddRigidBody(f"{limb.name}_{k}", inertia)
            if k:
                frame = plant.AddFrame(FixedOffsetFrame(
                    f"{limb.name}_end_{k}", before.body_frame(),
                    RigidTransform([lengths[k - 1], 0, 0])))  # fmt: skip
                hinge = RevoluteJoint(f"{limb.name}_hinge_{k}", frame, body.body_frame(), DOWN, 0.0)
                joint = plant.AddJoint(hinge)
                gains = PdControllerGains(p=stiffness[0, k - 1], d=DAMPING * stiffness[0, k - 1])
                plant.AddJointActuator(f"{limb.name}_{k}", joint).set_controller_gains(gains)
            elif limb.on:
                carrier, along = ends[limb.on][limb.at]
                plant.WeldFrames(
                    carrier.body_frame(), body.body_frame(),
                    RigidTransform(RollPitchYaw(0, 0, angle), [along, limb.offset, 0]))  # fmt: skip
            for x in (0.0, length) if k == elements else (0.0,):
                for side in (-0.5, 0.5):
                    add_pad(plant, body, x, FRICTION, timestep, side * width)
            if not k:
                first = body
            before = body
        ends[limb.name] = {"begin": (first, 0.0), "end": (before, lengths[-1])}
    torso = plant.GetBodyByName("torso_0")
    plant.SetDefaultFloatingBaseBodyPose(torso, RigidTransform([0, 0, PAD]))
    finalize(plant)

    def rest(pressures):
        return np.concatenate([joint_springs(limb.strip, elements, pressures[:, [i]])[1]
                               for i, limb in enumerate(robot.limbs)], axis=1)  # fmt: skip

    return follow(builder, plant, *knots(scene, rest)), plant, torso


def walked(gait, elements, timestep):
    """Displacement over L, ahead and to the left, turn in degrees, times real time."""
    scene = Scene(quadruped(), gait=gait)
    diagram, plant, torso = built(scene, elements, timestep)
    simulator, mine = start(diagram, plant)
    simulator.AdvanceTo(scene.settle_time)
    begin = plant.EvalBodyPoseInWorld(mine, torso)
    started = clock.process_time()
    simulator.AdvanceTo(scene.duration)
    spent = clock.process_time() - started
    moved = begin.inverse() @ plant.EvalBodyPoseInWorld(mine, torso)
    x, y, _ = moved.translation() / LENGTH
    yaw = RollPitchYaw(moved.rotation()).yaw_angle()
    return float(x), float(y), float(np.degrees(yaw)), gait.period / spent


def main():
    """Write the table."""
    with TABLE.open("w", newline="") as file:
        table = csv.writer(file)
        table.writerow(["left", "elements", "timestep_s", "ahead_L", "aside_L", "turn_deg",
                        "times_real_time"])  # fmt: skip
        for left in (1.0, 0.7):
            gait = replace(undulation("wave", left=left), ramp_time=RAMP)
            for timestep in STEPS:
                moves = walked(gait, ELEMENTS, timestep)
                row = [left, ELEMENTS, timestep, *(f"{value:.4g}" for value in moves)]
                table.writerow(row)
                file.flush()
                print(*row, flush=True)


if __name__ == "__main__":
    main()
