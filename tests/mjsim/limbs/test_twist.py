"""Limbs that twist, in MuJoCo: places, stiffness, walks of the reference, symmetry, refusals."""

import importlib
from dataclasses import replace
from pathlib import Path

import mujoco
import numpy as np
import pytest
from walks import turned, went

from analytic.scene.gait import GAITS
from analytic.scene.limbs import LENGTH, as_strip, quadruped
from analytic.scene.quadruped_gaits import undulation
from analytic.scene.robot import Robot
from analytic.scene.surface import SURFACES
from analytic.solvers.limbs.kinematics import WHOLE, Tree
from analytic.solvers.limbs.walk import walk as quasi_static
from mjsim.model.bodies.limbs import ROOT, hinge_prefix, twist_prefix
from mjsim.model.bodies.parts import PREFIX
from mjsim.model.builder import compile_model
from mjsim.model.pads import edges, pads_of
from mjsim.results.prediction import reference
from mjsim.results.status import Status
from mjsim.results.trajectory import load
from mjsim.scene import Numerics, Scene, resolved
from mjsim.simulation.simulation import simulate

BENCHMARKS = Path(__file__).parents[3] / "benchmarks"
NUMERICS = Numerics(timestep=0.04, links=4, twists=2)


def scene(surface="felt", ramp=8.0, **sides):
    gait = replace(undulation("wave", **sides), ramp_time=ramp)
    return Scene(quadruped(), gait=gait, ground=SURFACES[surface])


@pytest.mark.parametrize(("links", "twists"), [(2, 1), (6, 2), (6, 3)])
def test_vertices_in_mujoco_are_where_the_theory_has_them(links, twists):
    twisting = scene()
    numerics = resolved(twisting, Numerics(links=links, twists=twists))
    model, tree = compile_model(twisting, numerics), Tree(twisting.robot, links, twists)
    data, q = mujoco.MjData(model), np.random.default_rng(3).normal(0, 0.4, len(tree.parent))
    assert model.nv == len(q)
    for name, value in zip(ROOT, q[:WHOLE], strict=True):
        data.joint(PREFIX + name).qpos = value
    for name, joints in zip(twisting.robot.names, tree.joints, strict=True):
        for prefix, places in ((hinge_prefix(name), tree.hinge_places),
                               (twist_prefix(name), tree.twist_places)):  # fmt: skip
            for number, value in enumerate(q[joints][places], start=1):
                data.joint(f"{prefix}{number}").qpos = value
    mujoco.mj_kinematics(model, data)
    pads = data.geom_xpos[edges(pads_of(model, twisting))]
    lie_at = mujoco.MjData(model)
    mujoco.mj_kinematics(model, lie_at)
    lowered = lie_at.geom_xpos[edges(pads_of(model, twisting))][
        0, 2
    ]  # the trunk lies at this height
    assert pads - [0, 0, lowered] == pytest.approx(tree.pose(q).nodes, abs=1e-9)


def test_a_limb_in_mujoco_twists_by_its_length_over_gj():
    robot = quadruped(Robot(torsion=3e-4))
    twisting = replace(scene(), robot=robot)
    model = compile_model(twisting, resolved(twisting, Numerics(links=6, twists=3)))
    for limb in robot.limbs:
        joints = [model.joint(f"{twist_prefix(limb.name)}{i}").id for i in (1, 2, 3)]
        stiffness = model.jnt_stiffness.reshape(model.njnt, -1)[joints, 0]  # of powers, in MuJoCo 4
        assert (1 / stiffness).sum() == pytest.approx(limb.strip.length / 3e-4)
        damping = model.dof_damping.reshape(model.nv, -1)[model.jnt_dofadr[joints], 0]
        assert damping / stiffness == pytest.approx(Numerics().damping_time)


@pytest.mark.parametrize("name", ["felt", pytest.param("gelatin", marks=pytest.mark.slow)])
def test_limbs_that_twist_go_as_far_as_the_reference(name, tmp_path):
    walk = simulate(scene(name, left=0.7), NUMERICS)
    assert walk.status is Status.OK
    gait = undulation("wave", left=0.7)
    expected = quasi_static(quadruped(), gait, SURFACES[name], 8, 4, twists=2)
    off = np.hypot(*(went(walk) - expected.displacement))
    assert off < max(0.05 * abs(expected.displacement[0]), 0.002 * LENGTH)
    assert np.degrees(turned(walk)) == pytest.approx(np.degrees(expected.turn), abs=0.2)
    assert abs(np.degrees(expected.turn)) > 0.7  # a third of that if they do not twist
    walk.save(tmp_path / "walk.nc")
    again = load(tmp_path / "walk.nc")
    assert (again.coordinates == walk.coordinates).all()
    assert again.numerics == walk.numerics


def test_twisted_limbs_swapped_left_and_right_go_the_mirrored_way():
    one, two = (simulate(scene("gelatin", 4.0, **side), NUMERICS)
                for side in ({"left": 0.7}, {"right": 0.7}))  # fmt: skip
    assert turned(two) == pytest.approx(-turned(one), abs=np.radians(0.05))
    assert went(two) == pytest.approx(went(one) * [1, -1], abs=1e-3 * LENGTH)


@pytest.mark.slow
@pytest.mark.parametrize("twists", [0, 3])
def test_limbs_go_as_far_as_node_by_node_with_and_without_twist(twists, monkeypatch):
    monkeypatch.syspath_prepend(BENCHMARKS)
    nodewise = importlib.import_module("nodewise")
    case = nodewise.Case("gelatin", 1.0, bool(twists), False, False, elements=8, states=12)
    wave = Scene(quadruped(), ground=SURFACES["gelatin"])
    ahead = reference(wave, Numerics(twists=twists)).displacement[0]
    assert ahead == pytest.approx(nodewise.walk(case)[0], abs=1e-3)


@pytest.mark.slow
def test_limbs_that_hardly_twist_go_as_those_that_do_not():
    stiff = Robot(torsion=0.05)
    plain = reference(scene("gelatin"), Numerics(twists=0))
    stiffly = replace(scene("gelatin"), robot=quadruped(stiff))
    stiff_walk = reference(stiffly, Numerics(twists=2))
    assert stiff_walk.displacement[0] == pytest.approx(plain.displacement[0], abs=3e-4)


def test_limbs_twist_by_half_their_links_where_there_is_something_to_twist():
    for links in (2, 6, 8):
        assert resolved(scene(), Numerics(links=links)).twists == links // 2
    assert resolved(scene(), Numerics(twists=0)).twists == 0
    in_line = replace(scene(), robot=as_strip(Robot()), gait=GAITS["wave"])
    assert resolved(in_line).twists == 0
    assert resolved(replace(in_line, slope=0.02, uphill=0.5 * np.pi)).twists == 3
    assert resolved(Scene()).twists == 0


def test_twists_where_there_can_be_none_are_refused():
    with pytest.raises(ValueError, match="twists does nothing for a robot in the plane, got 2"):
        resolved(Scene(), Numerics(twists=2))
    with pytest.raises(ValueError, match="at most half the 4 links of a limb, got 3"):
        resolved(scene(), Numerics(links=4, twists=3))
    with pytest.raises(ValueError, match=r"twists must be a whole number of at least 0, got -1"):
        Numerics(twists=-1)
    given = replace(scene(), robot=quadruped(Robot(torsion=3e-4)))
    with pytest.raises(ValueError, match="torsion does nothing for limbs that do not twist"):
        resolved(given, Numerics(twists=0))
    with pytest.raises(ValueError, match="torsion does nothing for a strip in the plane"):
        resolved(Scene(Robot(torsion=3e-4)))
