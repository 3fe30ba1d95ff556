"""Drake: rigid links, springs and dampers of hinges as implicit gains of actuators, SAP contact.

Rest angles are a trajectory that Drake follows, with no Python in the loop. Of stiffness 1e3, 1e4
and 1e6 N/m, relaxation times of 0 to 0.1 s and its four contact approximations these were the most
accurate on the strip: SAP's error falls with the time step, Lagged needs 1 ms as well, Similar and
TAMSI do not walk.
"""

import logging

import numpy as np
from pydrake.geometry import AddContactMaterial, HalfSpace, ProximityProperties, Sphere
from pydrake.math import RigidTransform, RollPitchYaw
from pydrake.multibody.plant import (
    AddMultibodyPlantSceneGraph,
    CoulombFriction,
    DiscreteContactApproximation,
)
from pydrake.multibody.tree import (
    FixedOffsetFrame,
    PdControllerGains,
    PlanarJoint,
    RevoluteJoint,
    SpatialInertia,
    UnitInertia,
)
from pydrake.systems.analysis import Simulator
from pydrake.systems.framework import DiagramBuilder
from pydrake.systems.primitives import TrajectorySource
from pydrake.trajectories import PiecewisePolynomial

from benchmarks.engines.specification import GRAVITY, WAIT, Task, links, rest_angles
from benchmarks.engines.walked import Walked, stopwatch

PAD = 1e-5  # radius [m]
STIFFNESS = 1e4  # of a contact [N/m]
logging.getLogger("drake").setLevel(logging.ERROR)


def walk(task: Task, elements: int, timestep: float, worlds: int = 1) -> Walked:
    """One world after the other."""
    diagram, plant, first = _built(task, elements, timestep)
    distances, cpu, wall = [], 0.0, 0.0
    for _ in range(worlds):
        simulator = Simulator(diagram)
        simulator.Initialize()
        mine = plant.GetMyMutableContextFromRoot(simulator.get_mutable_context())
        spent = stopwatch()
        simulator.AdvanceTo(WAIT)
        begin = plant.EvalBodyPoseInWorld(mine, first).translation()[0]
        simulator.AdvanceTo(task.duration)
        took = spent()
        end = plant.EvalBodyPoseInWorld(mine, first).translation()[0]
        distances.append((end - begin) / task.length)
        cpu, wall = cpu + took[0], wall + took[1]
    return Walked(np.array(distances), round(task.duration / timestep), cpu, wall)


def _built(task: Task, elements: int, timestep: float):
    """The diagram, its plant and the first link."""
    builder = DiagramBuilder()
    plant, _ = AddMultibodyPlantSceneGraph(builder, timestep)
    plant.set_discrete_contact_approximation(DiscreteContactApproximation.kSap)
    plant.RegisterCollisionGeometry(
        plant.world_body(),
        RigidTransform(),
        HalfSpace(),
        "ground",
        _material(max(task.friction, task.friction_between), timestep),
    )
    chain, bodies = links(task, elements), []
    for number, link in enumerate(chain):
        l, w = link.length, link.width  # noqa: E741
        plate = UnitInertia(w**2 / 12, l**2 / 12, (w**2 + l**2) / 12)
        body = plant.AddRigidBody(f"link_{number}", SpatialInertia(
            link.mass, [l / 2, 0, 0], plate.ShiftFromCenterOfMass([-l / 2, 0, 0])))  # fmt: skip
        place = RigidTransform(RollPitchYaw(0, 0, link.angle), [*link.place, 0])
        if link.stiffness:
            frame = plant.AddFrame(
                FixedOffsetFrame(f"end_{number}", bodies[link.parent].body_frame(), place)
            )
            hinge = RevoluteJoint(f"hinge_{number}", frame, body.body_frame(), [0, -1, 0], 0.0)
            motor = plant.AddJointActuator(f"spring_{number}", plant.AddJoint(hinge))
            gains = PdControllerGains(p=link.stiffness, d=task.damping * link.stiffness)
            motor.set_controller_gains(gains)
        elif link.parent >= 0:
            plant.WeldFrames(bodies[link.parent].body_frame(), body.body_frame(), place)
        elif task.in_plane:
            upright = RigidTransform(RollPitchYaw(np.pi / 2, 0, 0), [0, 0, PAD])  # x, z and pitch
            ground = plant.AddFrame(FixedOffsetFrame("plane", plant.world_frame(), upright))
            turned = RigidTransform(RollPitchYaw(np.pi / 2, 0, 0), np.zeros(3))
            plane = plant.AddFrame(FixedOffsetFrame("turned", body.body_frame(), turned))
            plant.AddJoint(PlanarJoint("free", ground, plane, [0, 0, 0]))
        else:
            plant.SetDefaultFloatingBaseBodyPose(body, RigidTransform([0, 0, PAD]))
        for k, (x, y, grip) in enumerate(link.pads):
            plant.RegisterCollisionGeometry(body, RigidTransform([x, y, 0]), Sphere(PAD),
                                            f"pad_{k}", _material(grip, timestep))  # fmt: skip
        bodies.append(body)
    plant.mutable_gravity_field().set_gravity_vector([0, 0, -GRAVITY])
    plant.Finalize()
    rest = rest_angles(task, chain, task.knots)
    states = np.concatenate([rest, np.zeros_like(rest)], axis=1).T
    path = PiecewisePolynomial.FirstOrderHold(task.knots, states)
    source = builder.AddSystem(TrajectorySource(path))
    instance = plant.GetModelInstanceByName("DefaultModelInstance")
    builder.Connect(source.get_output_port(), plant.get_desired_state_input_port(instance))
    return builder.Build(), plant, bodies[0]


def _material(mu: float, timestep: float) -> ProximityProperties:
    properties = ProximityProperties()
    AddContactMaterial(dissipation=0.0, point_stiffness=STIFFNESS,
                       friction=CoulombFriction(mu, mu), properties=properties)  # fmt: skip
    properties.AddProperty("material", "relaxation_time", timestep)
    return properties
