"""Parts of every body's MJCF: options, contact pads, sites of the ends, friction tendons.

Under bounds of their own, the friction of the two ends is carried by spatial tendons to a far fixed
site: `left` and `right` along each end, and `both` along their mean; see mjsim.friction. Where it
acts between the ends too there is one for each node, and `both` is the mean of those in contact.
Under Coulomb friction it is MuJoCo's own contact friction, and the tendons only measure, or carry
what feet hold by besides. Where the
ground resists otherwise back than ahead each has a spring besides, so long that it pulls alike
wherever the robot is: see mjsim.friction.lean.
"""

from collections.abc import Sequence
from pathlib import Path

import mujoco
import numpy as np

from analytic.friction.contacts import of_tether
from analytic.friction.grip import Grip
from analytic.friction.laws import LAWS
from analytic.scene import pneunet
from analytic.scene.chain import link_lengths, node_positions
from analytic.scene.feet import drops
from analytic.scene.robot import Robot
from mjsim.scene import Resolved, Scene

PALE, DARK = (0.86, 0.82, 0.72), (0.16, 0.17, 0.20)  # passive and inflated, as in Figure 4
FAR = 100.0  # m; a line to a point this far is horizontal to 1 part in 1e6
_FARTHER = 1e4  # m; a walk of 0.1 m changes the distance to there by 1e-6 m
NO_BOUND = 1e-12  # N; without any bound a tendon would get no row to be given one
TENDONS = ("left", "right", "both")
TETHER = "tether"
TOUCH = 1e-6  # how deep the robot starts in the ground, over L: a contact at 0 is not seen; chosen
PREFIX = "robot_"  # of the strip's names once it is on its ground
TEMPLATE = Path(__file__).with_name("strip.xml")

Place = tuple[float, float, float]
Node = tuple[mujoco.MjsBody, Place]  # body, and place in its frame [m]
ORIGIN: Place = (0.0, 0.0, 0.0)


def template() -> mujoco.MjSpec:
    """Defaults of the strip."""
    return mujoco.MjSpec.from_file(str(TEMPLATE))


def start_height(length: float, numerics: Resolved) -> float:
    """Height of a neutral line that lies a little in the ground, by its length [m]."""
    return numerics.pad_radius - TOUCH * length


def refuse_chain_only(body: str, scene: Scene) -> None:
    """Raise ValueError where a scene asks for what only body chain does."""
    if scene.actuation == "actuators" or scene.chamber == "sealed":
        raise ValueError(
            "actuation actuators and chamber sealed are for body chain; got "
            f"body {body}, actuation {scene.actuation}, chamber {scene.chamber}"
        )


def set_options(spec: mujoco.MjSpec, scene: Scene, numerics: Resolved) -> None:
    """Time step, integrator, gravity and, under Coulomb friction, cones."""
    spec.option.timestep = numerics.timestep
    spec.option.integrator = getattr(mujoco.mjtIntegrator, f"mjINT_{numerics.integrator.upper()}")
    along, aside = scene.incline.downhill
    down = -scene.incline.normal
    spec.option.gravity = [0.0 + scene.gravity * part for part in (along, aside, down)]
    if scene.friction == "coulomb":
        spec.option.cone = getattr(mujoco.mjtCone, f"mjCONE_{numerics.cone.upper()}")
        spec.option.impratio = numerics.impratio


def contact_softness(scene: Scene, numerics: Resolved) -> tuple[Sequence[float], Sequence[float]]:
    """solref and solimp of the pads' contacts.

    Frictionless ones are as stiff as the discrete integrator allows. With friction MuJoCo's convex
    contact lifts a pad that slides by v off the ground by about mu v times its damping over its
    stiffness; a pad that is lifted off loses its load for a step and falls. So those are given
    little damping, and stiffen over a depth greater than that.
    """
    time = numerics.contact_time * numerics.timestep
    if scene.friction == "coulomb":
        return softness_with_friction(time, numerics.contact_depth)
    return (time, 1.0), (0.999, 0.999, 0.001)


def softness_with_friction(time: float, depth: float) -> tuple[Sequence[float], Sequence[float]]:
    """solref and solimp of contacts with friction, by their time [s] and depth [m]."""
    return (-0.125 / time**2, -0.5 / time), (0.9, 0.999, depth)


def add_pads(
    body: mujoco.MjsBody, scene: Scene, numerics: Resolved, node: int, places: Sequence[Place]
) -> None:
    """Contact pads of one node, side by side at places in its body's frame [m]."""
    coulomb = scene.friction == "coulomb"
    below = {0: drops(scene.strip.feet)[0], numerics.links + 1: drops(scene.strip.feet)[1]}
    for i, (x, y, z) in enumerate(places):
        place = x, y, z - below.get(node, 0.0)
        pad = add_pad(body, f"pad_{node}" + (f"_{i}" if i else ""), place, numerics)
        pad.condim = 3 if coulomb else 1
        pad.solref[:], pad.solimp[:3] = contact_softness(scene, numerics)
        stick(pad, scene, numerics, scene.strip, node, len(places))
        if coulomb:
            pad.friction[:] = pad_friction(scene, node in (0, numerics.links + 1)), 0.0, 0.0


def add_pad(body: mujoco.MjsBody, name: str, place: Place, numerics: Resolved) -> mujoco.MjsGeom:
    """Add a massless sphere that touches the ground, without friction."""
    pad = body.add_geom(name=name)
    pad.type, pad.pos = mujoco.mjtGeom.mjGEOM_SPHERE, place
    pad.size[0], pad.mass, pad.group = numerics.pad_radius, 0.0, 3
    pad.contype, pad.conaffinity, pad.priority, pad.condim = 1, 0, 1, 1
    return pad


def stick(
    pad: mujoco.MjsGeom, scene: Scene, numerics: Resolved, strip: Robot, node: int, count: int
) -> None:
    """Let adhesive ground pull at one of so many pads of a node of a strip, or of a limb."""
    surface = scene.ground.at(0.0)
    if not surface.adhesion:
        return
    # half of the links beside it
    lengths = np.concatenate([[0.0], link_lengths(strip, numerics.links), [0.0]])
    share = 0.5 * float(lengths[node] + lengths[node + 1])
    pad.adhesion, pad.gap = surface.press(strip.width) * share / count, surface.adhesion_reach


def pad_friction(scene: Scene, at_end: bool) -> float:
    """Coefficient of sliding friction of a pad for Coulomb friction, at x = 0."""
    surface = scene.ground.at(0.0)
    return float(surface.tip_friction if at_end else surface.friction)  # type: ignore[arg-type]


def add_ends(spec: mujoco.MjSpec, scene: Scene, nodes: Sequence[Node]) -> None:
    """Sites at the two ends and the tendons to a far one; at every node if friction acts there.

    Args:
        spec: the strip.
        scene: tells the law.
        nodes: of the strip, left first.
    """
    names = ["end_left", *(f"node_{node}" for node in range(1, len(nodes) - 1)), "end_right"]
    constant = scene.friction != "coulomb"
    tendons = tendon_names(len(nodes))
    grip = Grip(scene.strip, LAWS[scene.friction])
    everywhere = scene.between or (not constant and not grip.is_round(scene.ground))
    bound = NO_BOUND if constant or grip.holds else 0.0
    for name, (body, place) in zip(names, nodes, strict=True):
        if everywhere or name.startswith("end"):
            body.add_site(name=name, pos=place, size=[6e-4] * 3, group=4)
    spec.worldbody.add_site(name="far", pos=(-FAR, 0.0, 0.0), group=4)
    for end in (0, -1):
        _tie(spec, tendons[end], "far", [names[end]], bound)
    mean = names if everywhere and constant else [names[0], names[-1]]
    _tie(spec, TENDONS[2], "far", mean, bound if constant else 0.0)
    if everywhere:
        for name, tendon in zip(names[1:-1], tendons[1:-1], strict=True):
            _tie(spec, tendon, "far", [name], bound)
    _add_tether(spec, scene, nodes)


def _add_tether(spec: mujoco.MjSpec, scene: Scene, nodes: Sequence[Node]) -> None:
    """Tie the place of a tether to the far site by its drag and its spring, if it has one."""
    for contact in of_tether(scene.strip, node_positions(scene.strip, len(nodes) - 2)):
        tether, tied = scene.strip.tether, friction_tendon(spec, TETHER, contact.drag or 0.0)
        assert tether
        for node, share in zip(contact.nodes, contact.share, strict=True):
            body, place = nodes[node]
            name = f"{TETHER}_{node}"
            body.add_site(name=name, pos=place, size=[6e-4] * 3, group=4)
            tied.wrap_pulley(1.0 / share)
            tied.wrap_site("far")
            tied.wrap_site(name)
        tied.width, tied.stiffness[0] = 2e-4, tether.stiffness
        tied.springlength = [FAR + tether.at * scene.strip.length] * 2


def tendon_names(nodes: int) -> list[str]:
    """Names of the tendons that carry the friction of each node, left first."""
    left, right, _ = TENDONS
    return [left, *(f"friction_{node}" for node in range(1, nodes - 1)), right]


def hold_sideways(spec: mujoco.MjSpec, scene: Scene, numerics: Resolved) -> None:
    """Add bounds across the walk of a body in space, where friction's are of the plane only.

    They keep each end on the heading that nothing turns it from.
    """
    if scene.friction == "coulomb":
        return
    spec.worldbody.add_site(name="aside", pos=(0.0, -_FARTHER, 0.0), group=4)
    sites = [site.name for site in spec.sites if site.name.startswith(("end_", "node_"))]
    for site in sites:
        _tie(spec, f"aside_{site}", "aside", (site,), tie_force(scene, numerics))


def tie_force(scene: Scene, numerics: Resolved) -> float:
    """Bound of the friction that resists motion which no law decides [N]."""
    return numerics.tie_bound * pneunet.base_rigidity(scene.strip) / scene.strip.length**2


def _tie(spec: mujoco.MjSpec, name: str, to: str, sites: Sequence[str], bound: float) -> None:
    tendon = friction_tendon(spec, name, bound)
    tendon.width = 2e-4
    for site in sites:
        tendon.wrap_pulley(1.0)
        tendon.wrap_site(to)
        tendon.wrap_site(site)


def friction_tendon(spec: mujoco.MjSpec, name: str, bound: float) -> mujoco.MjsTendon:
    """Add a tendon, of nothing yet, whose dry friction nearly does not creep; bound in N."""
    tendon = spec.add_tendon(name=name, frictionloss=bound, group=4)
    tendon.solref_friction[:] = 0.001, 1.0
    tendon.solimp_friction[:3] = 0.9999, 0.9999, 0.001
    return tendon
