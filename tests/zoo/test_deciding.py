"""What a measurement narrows: by the information matrix, brute force and walks that are known."""

import numpy as np
import pytest

from zoo import nearby
from zoo.__main__ import HERE
from zoo.deciding import errors, narrowed
from zoo.dielectric_inchworm import decide as dielectric
from zoo.nearby import Input, Quantity, Study, known, left, lines, measurements, spread
from zoo.piezo_inchworm import decide as piezo

STUDIES = {"piezo_inchworm": piezo.STUDY, "dielectric_inchworm": dielectric.STUDY}


@pytest.fixture(params=range(5))
def random(request):
    return np.random.default_rng(request.param)


def spread_of(random, count):
    root = random.normal(size=(count, count))
    return root @ root.T + 0.1 * np.eye(count)


def test_one_measurement_adds_its_information_to_that_of_the_prior(random):
    covariance, slope, error = spread_of(random, 4), random.normal(size=4), 0.3
    information = np.linalg.inv(covariance) + np.outer(slope, slope) / error**2
    assert narrowed(covariance, slope, error) == pytest.approx(np.linalg.inv(information))


def test_draws_that_agree_with_a_measurement_are_spread_as_it_leaves_them(random):
    covariance, slope, asked = spread_of(random, 3), random.normal(size=3), random.normal(size=3)
    error = 0.5
    draws = random.multivariate_normal(np.zeros(3), covariance, size=100_000)
    shown = draws @ slope + error * random.normal(size=len(draws))
    told = draws @ asked
    gain = np.cov(told, shown)
    spread_left = np.std(told - gain[0, 1] / gain[1, 1] * shown)
    (found,) = errors(narrowed(covariance, slope, error), asked[None])
    assert found == pytest.approx(spread_left, rel=0.02)


def test_one_more_measurement_never_widens_and_of_the_quantity_itself_leaves_its_own_error(random):
    covariance, asked = spread_of(random, 4), random.normal(size=(3, 4))
    for _ in range(5):
        after = narrowed(covariance, random.normal(size=4), random.uniform(0.01, 3))
        assert (errors(after, asked) <= errors(covariance, asked) + 1e-12).all()
        covariance = after
    (found,) = errors(narrowed(covariance, asked[0], 0.2), asked[:1])
    assert found <= 0.2


def test_lines_through_walks_are_those_that_made_them(random):
    study = Study([Input("a", 0.1, 0.01), Input("b", 0.5, 0.1)], [Quantity("p", "mm", 1.0)] * 2,
                  lambda factors: factors, None)  # fmt: skip
    slope, noise = random.normal(size=(2, 2)), np.array([[0.04, 0.01], [0.01, 0.09]])
    inputs = spread(study, 4096)
    assert inputs.std(axis=0) == pytest.approx([0.1, 0.5], rel=0.02)
    straight = 3.0 + inputs @ slope.T
    exact = lines(inputs, straight)
    assert exact.value == pytest.approx([3.0, 3.0])
    assert exact.slope[:, :2] == pytest.approx(slope)
    assert exact.missed == pytest.approx(np.zeros((2, 2)), abs=1e-12)
    bent = lines(inputs, straight + random.multivariate_normal([0, 0], noise, len(inputs)))
    assert bent.missed == pytest.approx(noise, abs=0.01)
    assert bent.slope[:, 2:] == pytest.approx(np.eye(2))


@pytest.mark.parametrize("name", STUDIES)
def test_no_measurement_of_a_robot_widens_and_its_own_leaves_no_more_than_its_error(name):
    study = STUDIES[name]
    found = lines(*nearby.walked(study))
    before = left(study, found)
    for one in measurements(study, found):
        assert (left(study, found, [one]) <= before + 1e-12).all()
        (after,) = errors(narrowed(known(study, found), one.slope, one.error), one.slope[None])
        assert after <= one.error


@pytest.mark.parametrize("name", STUDIES)
def test_the_page_of_a_robot_shows_what_its_walks_tell(name, capsys):
    study = STUDIES[name]
    nearby.tell(study, {})
    page = (study.table.parent / "README.md").read_text("utf-8")
    for line in capsys.readouterr().out.splitlines():
        assert line in page


def test_a_strip_of_twice_the_rigidity_and_twice_the_weight_walks_the_same():
    ones = np.ones(len(piezo.INPUTS))
    both = ones.copy()
    both[:2] = 2.0
    one, two = (piezo.walked(piezo.scene(factors)) for factors in (ones, both))
    assert two == pytest.approx(one, rel=1e-6)


def line_of(name):
    """What the zoo's page says would decide on a robot."""
    page = (HERE / "README.md").read_text("utf-8").partition("## What would decide")[2]
    (line,) = (line for line in page.splitlines() if f"({name}/README.md" in line)
    return line


def test_each_robot_that_has_one_says_in_a_line_of_the_zoo_what_would_decide():
    robots = [path.parent.name for path in HERE.glob("*/decide.py")]
    assert len(robots) >= 5
    for name in robots:
        assert f"zoo.{name}.decide" in line_of(name)


@pytest.mark.parametrize("name", STUDIES)
def test_the_line_of_the_zoo_is_of_the_measurement_that_narrows_most(name):
    study = STUDIES[name]
    found = lines(*nearby.walked(study))
    before = left(study, found)
    after = {one.name: left(study, found, [one]) for one in measurements(study, found)}
    best = min(after, key=lambda word: float(np.mean(after[word] / before)))
    said = line_of(name)
    assert best.replace(", ± ", " to ") in said
    assert f"{after[best][0]:.2g} of {before[0]:.2g}" in said
