"""Scenes as they are written are the scenes they were."""

import math
import tomllib

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from analytic import GAITS, SURFACES, Gait, Patches, Robot, Surface
from mjsim.files.scene_tables.tables import build
from mjsim.files.scene_tables.written import as_tables, as_toml
from mjsim.scene import Numerics, Scene, Valves

FELT = SURFACES["felt"]
OWN = Surface("mine", tip_force=0.02, shear_strength=12.0, viscosity=0.3)


@settings(max_examples=40, deadline=None)
@given(
    length=st.floats(0.05, 0.15),
    gait=st.sampled_from([*GAITS.values(), GAITS["wave"].reversed(),
                          Gait("seen", ((0, 0, 1), (0.5, 0, 0)), (1.5,), repeats=False)]),
    ground=st.sampled_from([*SURFACES.values(), OWN, Surface("felt", tip_force=1.0),
                            Patches("both", (0.1,), (FELT, OWN))]),
    valves=st.sampled_from([Valves(), Valves(fill_time=0.2, vent_time=(0.1, 0.2, 0.3))]),
    links=st.sampled_from([24, 12]),
)  # fmt: skip
def test_a_scene_is_read_as_it_was_written(length, gait, ground, valves, links):
    scene = Scene(Robot(length=length, mass=0.02), gait, ground, valves=valves)
    again, numerics = build(tomllib.loads(as_toml(as_tables(scene, Numerics(links=links)))))
    assert (again.robot, again.gait, again.valves) == (scene.robot, scene.gait, scene.valves)
    assert numerics == Numerics(links=links)
    if ground == SURFACES.get(ground.name) or ground == OWN:
        assert again == scene
    else:
        assert again.ground.at(0.0).tip_force == ground.at(0.0).tip_force


def test_a_slope_is_written_in_degrees_and_comments_stand_on_top():
    text = as_toml(as_tables(Scene(slope=math.radians(3)), Numerics()), ["fitted", "twice"])
    assert text.startswith("# fitted\n# twice\n")
    assert tomllib.loads(text)["ground"]["slope_deg"] == pytest.approx(3)
    assert "[1, 0, 0]" in text


def test_a_ground_that_tables_do_not_know_is_said():
    class Odd:
        name = "odd"
        surfaces = (FELT,)

        def at(self, x):
            return FELT

    with pytest.raises(ValueError, match="ground 'odd' cannot be written"):
        as_tables(Scene(ground=Odd()), Numerics())
