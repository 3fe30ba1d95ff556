"""Settle the heavy clamped strip in other engines, and append what was measured to the chart.

All: the same load, the same rigidity, the first element centred on the wall. Drake and PyBullet:
equal rigid links on hinges, springs and dampers at the hinges as in our planar chain; Drake's are
implicit gains of actuators, PyBullet's explicit torques with implicit joint damping, as SoMo has
them. PyElastica: a Cosserat rod; its damper acts on velocities, not on strain rates.
"""

import math
import sys
import time as clock
from dataclasses import replace
from importlib import metadata
from pathlib import Path

import numpy as np

TOP = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(TOP))

from analytic import pneunet  # noqa: E402
from mjsim.accuracy.heavy import DAMPING, DURATION, Setting, exact, row, strip  # noqa: E402
from mjsim.accuracy.rows import MEASURED, append, read  # noqa: E402
from mjsim.accuracy.timing import repeated  # noqa: E402
from mjsim.provenance import machine, origin  # noqa: E402

GRAVITY = 9.81
FAR = 0.1  # of the tip from its place, over L, that is no settled strip
ROBOT = strip()
D0, L, W = pneunet.base_rigidity(ROBOT), ROBOT.length, ROBOT.weight_per_length
NAMES = {"Drake": "drake", "PyElastica": "pyelastica", "PyBullet": "pybullet"}


def link(n):
    return L / (n - 0.5)


def drake(n, timestep):
    from pydrake.math import RigidTransform
    from pydrake.multibody.plant import AddMultibodyPlantSceneGraph, DiscreteContactApproximation
    from pydrake.multibody.tree import (
        PdControllerGains,
        RevoluteJoint,
        SpatialInertia,
        UnitInertia,
    )  # fmt: skip
    from pydrake.systems.analysis import Simulator
    from pydrake.systems.framework import DiagramBuilder

    h, builder = link(n), DiagramBuilder()
    plant, _ = AddMultibodyPlantSceneGraph(builder, timestep)
    plant.set_discrete_contact_approximation(DiscreteContactApproximation.kSap)
    mass = W / GRAVITY * h
    about_end = UnitInertia.ThinRod(h, [1, 0, 0]).ShiftFromCenterOfMass([h / 2, 0, 0])
    inertia = SpatialInertia(mass, [h / 2, 0, 0], about_end)
    parent = plant.world_body()
    for i in range(n):
        body = plant.AddRigidBody(f"link_{i}", inertia)
        if i == 0:
            plant.WeldFrames(plant.world_frame(), body.body_frame(), RigidTransform([-h / 2, 0, 0]))
        else:
            joint = plant.AddJoint(
                RevoluteJoint(
                    f"hinge_{i}",
                    plant.AddFrame(_frame(parent, h)),
                    body.body_frame(),
                    [0, 1, 0],
                    damping=0.0,
                )
            )
            actuator = plant.AddJointActuator(f"spring_{i}", joint)
            actuator.set_controller_gains(PdControllerGains(p=D0 / h, d=DAMPING * D0 / h))
        parent = body
    plant.mutable_gravity_field().set_gravity_vector([0, 0, -GRAVITY])
    plant.Finalize()
    diagram = builder.Build()

    def go():
        simulator = Simulator(diagram)
        context = simulator.get_mutable_context()
        mine = plant.GetMyMutableContextFromRoot(context)
        plant.get_desired_state_input_port(plant.GetModelInstanceByName("DefaultModelInstance")
                                           ).FixValue(mine, np.zeros(2 * (n - 1)))  # fmt: skip
        simulator.Initialize()
        started = clock.perf_counter()
        simulator.AdvanceTo(DURATION)
        took = clock.perf_counter() - started
        return plant.EvalBodyPoseInWorld(mine, parent).multiply([h, 0, 0]), took

    (tip, _), timing = repeated(go, DURATION, lambda result: result[1])
    return (tip[0] / L, tip[2] / L), timing


def _frame(body, h):
    from pydrake.math import RigidTransform
    from pydrake.multibody.tree import FixedOffsetFrame

    return FixedOffsetFrame(f"end_{body.name()}", body.body_frame(), RigidTransform([h, 0, 0]))


def elastica(n, timestep):
    import elastica as ea

    h = link(n)
    radius = ROBOT.thickness / 2

    class System(ea.BaseSystemCollection, ea.Constraints, ea.Forcing, ea.Damping):
        pass

    def go():
        system = System()
        rod = ea.CosseratRod.straight_rod(
            n, np.array([-h / 2, 0.0, 0.0]), np.array([1.0, 0, 0]), np.array([0.0, 1.0, 0]),
            n * h, radius, W / GRAVITY / (np.pi * radius**2),
            youngs_modulus=D0 / (np.pi * radius**4 / 4),
            shear_modulus=D0 / (np.pi * radius**4 / 4) / 3,
        )  # fmt: skip
        system.append(rod)
        system.constrain(rod).using(
            ea.OneEndFixedBC, constrained_position_idx=(0,), constrained_director_idx=(0,)
        )
        system.add_forcing_to(rod).using(ea.GravityForces, acc_gravity=np.array([0, 0, -GRAVITY]))
        system.dampen(rod).using(ea.AnalyticalLinearDamper, uniform_damping_constant=8.0,
                                 time_step=timestep)  # fmt: skip
        system.finalize()
        stepper, steps = ea.PositionVerlet(), round(DURATION / timestep)
        started, now = clock.perf_counter(), 0.0
        for _ in range(steps):
            now = stepper.step(system, now, timestep)
        return rod.position_collection[:, -1], clock.perf_counter() - started

    (tip, _), timing = repeated(go, DURATION, lambda result: result[1])
    return (tip[0] / L, tip[2] / L), timing


def bullet(n, timestep):
    import pybullet as p

    h = link(n)
    mass = W / GRAVITY * h
    client = p.connect(p.DIRECT)
    p.setGravity(0, 0, -GRAVITY)
    p.setTimeStep(timestep)
    count = n - 1
    zero, unit = [0, 0, 0], [0, 0, 0, 1]
    body = p.createMultiBody(
        mass, -1, -1, [-h / 2, 0, 0], unit,
        linkMasses=[mass] * count, linkCollisionShapeIndices=[-1] * count,
        linkVisualShapeIndices=[-1] * count,
        linkPositions=[[h, 0, 0]] * count, linkOrientations=[unit] * count,
        linkInertialFramePositions=[[h / 2, 0, 0]] * count,
        linkInertialFrameOrientations=[unit] * count, linkParentIndices=list(range(count)),
        linkJointTypes=[p.JOINT_REVOLUTE] * count, linkJointAxis=[[0, 1, 0]] * count,
        baseInertialFramePosition=zero,
    )  # fmt: skip
    p.createConstraint(body, -1, -1, -1, p.JOINT_FIXED, zero, zero, [-h / 2, 0, 0])
    p.resetBasePositionAndOrientation(body, [-h / 2, 0, 0], unit)
    p.changeDynamics(body, -1, mass=0)
    joints = list(range(count))
    for j in joints:
        inertia = [1e-9, mass * h**2 / 12, mass * h**2 / 12]
        p.changeDynamics(body, j, linearDamping=0, angularDamping=0,
                         jointDamping=DAMPING * D0 / h, localInertiaDiagonal=inertia)  # fmt: skip
    p.setJointMotorControlArray(body, joints, p.VELOCITY_CONTROL, forces=[0.0] * count)

    def go():
        for j in joints:
            p.resetJointState(body, j, 0.0, 0.0)
        started = clock.perf_counter()
        for _ in range(round(DURATION / timestep)):
            angles = np.array([s[0] for s in p.getJointStates(body, joints)])
            p.setJointMotorControlArray(body, joints, p.TORQUE_CONTROL,
                                        forces=(-D0 / h * angles).tolist())  # fmt: skip
            p.stepSimulation()
        took = clock.perf_counter() - started
        state = p.getLinkState(body, count - 1, computeForwardKinematics=True)
        turn = np.array(p.getMatrixFromQuaternion(state[5])).reshape(3, 3)
        return np.array(state[4]) + turn @ [h, 0, 0], took

    (tip, _), timing = repeated(go, DURATION, lambda result: result[1])
    p.disconnect(client)
    return (tip[0] / L, tip[2] / L), timing


GRIDS = {
    "Drake": (drake, "SAP", (6, 12, 24, 48), (0.05, 0.02, 0.01, 0.005, 0.002)),
    "PyElastica": (elastica, "Verlet", (6, 12, 24, 48), (1e-4, 5e-5, 2e-5)),
    "PyBullet": (bullet, "explicit", (6, 12), (2e-3, 5e-4, 1e-4)),
}


def rows(seen):
    for name, (run, integrator, links, timesteps) in GRIDS.items():
        made = f"{NAMES[name]}={metadata.version(NAMES[name])} numpy={np.__version__}"
        for n in links:
            for timestep in timesteps:
                setting = Setting(name, n, timestep, integrator)
                if setting.key in seen:
                    continue
                tip, timing = run(n, timestep)
                found = row(setting, tip, timing, status(tip))
                print(found.method, n, timestep, f"{found.error:.2g}", f"{found.cost:.3g}",
                      found.status, flush=True)  # fmt: skip
                yield _signed(found, made)


def status(tip):
    """A tip that is nowhere, or not near where gravity takes it, is no result."""
    if not (np.isfinite(tip).all() and np.abs(tip).sum() < 2):
        return "diverged"
    return "ok" if math.dist(tip, exact()) < FAR else "drifting"


def _signed(found, versions):
    return replace(found, machine=machine(), versions=versions, commit=origin()["commit"] or "")


if __name__ == "__main__":
    path = Path(sys.argv[1]) if len(sys.argv) > 1 else MEASURED
    for _ in append(rows({known.key for known in read(path)}), path):
        pass
