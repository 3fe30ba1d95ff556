"""Drake: rigid links on hinges, their springs and dampers the implicit gains of actuators.

On the ground pads as small as points, Drake's own compliant contact and friction. Of stiffness 1e3,
1e4 and 1e6 N/m, relaxation times of 0 to 0.1 s and its four contact approximations, these were the
most accurate: SAP's error falls with the time step, Lagged needs 1 ms as well, Similar and TAMSI do
not walk. Rest angles are a trajectory that Drake follows: no Python in the loop.
"""

import logging

import numpy as np
from common import (
    DAMPING,
    DURATION,
    GRAVITY,
    Walked,
    heavy_links,
    knots,
    repeated,
    stopwatch,
    strip,
)
from pydrake.geometry import AddContactMaterial, HalfSpace, ProximityProperties, Sphere
from pydrake.math import RigidTransform, RotationMatrix
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

from analytic.scene import pneunet
from analytic.scene.chain import joint_springs, link_lengths
from mjsim.scene import Numerics

PACKAGE, INTEGRATOR = "drake", "SAP"
PAD = 1e-5  # radius [m]
STIFFNESS = 1e4  # N/m
logging.getLogger("drake").setLevel(logging.ERROR)


def settle(links, timestep):
    """Tip (x, y) over L of the heavy clamped strip, and the time it took."""
    robot, h = strip(), heavy_links(links)
    spring = pneunet.base_rigidity(robot) / h
    builder, plant = new_plant(timestep)
    world = plant.world_frame()
    tip_body, _ = _chain(plant, robot, [h] * links, [spring] * (links - 1), DAMPING,
                     lambda body: plant.WeldFrames(
                         world, body.body_frame(), RigidTransform([-h / 2, 0, 0])))  # fmt: skip
    finalize(plant)
    times = np.array([0.0, DURATION])
    diagram = follow(builder, plant, times, np.zeros((2, links - 1)))

    def go():
        simulator, mine = start(diagram, plant)
        spent = stopwatch()
        simulator.AdvanceTo(DURATION)
        return plant.EvalBodyPoseInWorld(mine, tip_body).multiply([h, 0, 0]), spent()

    (tip, _), timing = repeated(go, DURATION, lambda result: result[1])
    return (tip[0] / robot.length, tip[2] / robot.length), timing


def walk(scene, links, timestep):
    """One cycle of a scene under Coulomb's law."""
    robot = scene.robot
    lengths = link_lengths(robot, links)
    springs, _ = joint_springs(robot, links, np.zeros((1, 3)), scene.chamber)
    builder, plant = new_plant(timestep)
    tilt = RotationMatrix.MakeXRotation(np.pi / 2)  # its plane is x-z

    def free(body):
        at = plant.AddFrame(FixedOffsetFrame(
            "start", plant.world_frame(), RigidTransform(tilt, [0, 0, PAD])))  # fmt: skip
        end = plant.AddFrame(
            FixedOffsetFrame("end", body.body_frame(), RigidTransform(tilt, [0, 0, 0]))
        )
        plant.AddJoint(PlanarJoint("base", at, end))

    tip_body, bodies = _chain(plant, robot, lengths, springs[0], Numerics.damping_time, free)
    tip, side = scene.ground.tip_friction, scene.ground.friction
    add_ground(plant, max(tip, side), timestep)
    for i, body in enumerate(bodies):
        add_pad(plant, body, 0.0, tip if i == 0 else side, timestep)
    add_pad(plant, tip_body, lengths[-1], tip, timestep)
    finalize(plant)
    times, rest = knots(scene, lambda p: joint_springs(robot, links, p, scene.chamber)[1])
    diagram = follow(builder, plant, times, rest)

    def go():
        simulator, mine = start(diagram, plant)
        spent = stopwatch()
        simulator.AdvanceTo(scene.settle_time)
        begin = plant.GetPositions(mine)[0]
        simulator.AdvanceTo(scene.duration)
        took = spent()
        x, z = plant.GetPositions(mine)[:2]
        right = plant.EvalBodyPoseInWorld(mine, tip_body).multiply([lengths[-1], 0, 0])
        return Walked((x - begin) / robot.length, max(abs(z), abs(right[2])) / robot.length, took)

    walked_strip, timing = repeated(go, scene.duration, lambda walked: walked.spent)
    return walked_strip, timing


def new_plant(timestep):
    builder = DiagramBuilder()
    plant, _ = AddMultibodyPlantSceneGraph(builder, timestep)
    plant.set_discrete_contact_approximation(DiscreteContactApproximation.kSap)
    return builder, plant


def _chain(plant, robot, lengths, springs, damping_time, hold):
    """Links along +x on hinges that turn x to z; `hold` fixes the first. The last, and all."""
    bodies = []
    for i, h in enumerate(lengths):
        mass = robot.weight_per_length / GRAVITY * h
        about_end = UnitInertia.ThinRod(h, [1, 0, 0]).ShiftFromCenterOfMass([h / 2, 0, 0])
        body = plant.AddRigidBody(f"link_{i}", SpatialInertia(mass, [h / 2, 0, 0], about_end))
        if i == 0:
            hold(body)
        else:
            end = RigidTransform([lengths[i - 1], 0, 0])
            frame = plant.AddFrame(FixedOffsetFrame(f"end_{i}", bodies[-1].body_frame(), end))
            joint = plant.AddJoint(
                RevoluteJoint(f"hinge_{i}", frame, body.body_frame(), [0, -1, 0], damping=0.0)
            )
            gains = PdControllerGains(p=springs[i - 1], d=damping_time * springs[i - 1])
            plant.AddJointActuator(f"spring_{i}", joint).set_controller_gains(gains)
        bodies.append(body)
    return bodies[-1], bodies


def finalize(plant):
    plant.mutable_gravity_field().set_gravity_vector([0, 0, -GRAVITY])
    plant.Finalize()


def follow(builder, plant, times, rest):
    """The whole, its hinges driven to rest angles (T, N) at times (T,)."""
    states = np.concatenate([rest, np.zeros_like(rest)], axis=1).T
    source = builder.AddSystem(TrajectorySource(PiecewisePolynomial.FirstOrderHold(times, states)))
    instance = plant.GetModelInstanceByName("DefaultModelInstance")
    builder.Connect(source.get_output_port(), plant.get_desired_state_input_port(instance))
    return builder.Build()


def start(diagram, plant):
    """Its simulator and the plant's context in it."""
    simulator = Simulator(diagram)
    simulator.Initialize()
    return simulator, plant.GetMyMutableContextFromRoot(simulator.get_mutable_context())


def _material(mu, timestep):
    properties = ProximityProperties()
    AddContactMaterial(dissipation=0.0, point_stiffness=STIFFNESS,
                       friction=CoulombFriction(mu, mu), properties=properties)  # fmt: skip
    properties.AddProperty("material", "relaxation_time", timestep)
    return properties


def add_ground(plant, mu, timestep):
    """Level ground of a coefficient of friction."""
    plant.RegisterCollisionGeometry(
        plant.world_body(), RigidTransform(), HalfSpace(), "ground", _material(mu, timestep)
    )


def add_pad(plant, body, x, mu, timestep, y=0.0):
    """A pad so far along a link, and beside its middle line."""
    plant.RegisterCollisionGeometry(
        body, RigidTransform([x, y, 0]), Sphere(PAD), f"pad_{x:g}_{y:g}", _material(mu, timestep)
    )
