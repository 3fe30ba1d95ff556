"""The page of a run, opened in a browser without a network; and what the command refuses."""

import re
import shutil

import pytest
from walks import coarsen, walk

from mjsim.commands import report, run

CHROMIUM = shutil.which("chromium")


def commanded(words):
    return report.main([str(word) for word in words])


@pytest.fixture(scope="module")
def coarse_references():
    with pytest.MonkeyPatch.context() as patch:
        coarsen(patch)
        yield


@pytest.fixture(scope="module")
def saved(tmp_path_factory, coarse_references):
    folder = tmp_path_factory.mktemp("runs")
    words = ["--surface", "gelatin", "--no-video", "--links", "12", "--timestep", "0.01",
             "--gait.ramp-time", "0.5"]  # fmt: skip
    assert run.main([*words, "--out", str(folder)]) == 0
    (path,) = folder.glob("*.nc")
    return path


@pytest.fixture(scope="module")
def written(saved):
    out = saved.parent / "page.html"
    assert commanded([saved, "--out", out, "--no-video"]) == 0
    return out


@pytest.fixture(scope="module")
def with_video(saved):
    out = saved.parent / "film.html"
    assert commanded([saved, "--out", out]) == 0
    return out


def test_the_page_holds_numbers_scene_and_origin(written):
    text = written.read_text("utf-8")
    assert "walks backward" in text
    assert re.search(r"-0\.03\d\d", text)
    assert "[robot]" in text
    assert "&quot;mujoco&quot;" in text
    assert text.count("plotly.js v") == 1  # its script, once


def test_the_page_tells_what_is_not_known(saved, tmp_path):
    words = [saved, "--out", tmp_path / "page.html", "--no-video"]
    assert commanded([*words, "--uncertain", "robot.modulus=5%"]) == 0
    text = (tmp_path / "page.html").read_text("utf-8")
    assert "Known: robot.modulus within 5 %." in text
    assert re.search(r"-0\.03\d\d to -0\.03\d\d L \(95 %\)", text)


def test_what_is_not_known_is_of_fields(saved, tmp_path, capsys):
    with pytest.raises(SystemExit) as stop:
        commanded([saved, "--out", tmp_path / "page.html", "--uncertain", "robot.colour=5%"])
    assert stop.value.code == 2
    assert "key 'colour' of [robot] is unknown" in capsys.readouterr().err


def test_nothing_in_it_is_fetched(written):
    body = re.sub(r"<script>.*?</script>", "", written.read_text("utf-8"), flags=re.DOTALL)
    assert not re.findall(r"(?:src|href)='(?!data:)[^']*'", body)
    assert "http" not in body


@pytest.mark.skipif(CHROMIUM is None, reason="chromium is not installed")
@pytest.mark.parametrize(("scheme", "size"), [("light", (1000, 900)), ("dark", (390, 844))])
@pytest.mark.slow
def test_a_browser_shows_charts_and_plays_the_video_without_a_complaint(with_video, scheme, size):
    playwright = pytest.importorskip("playwright.sync_api")
    flags = ["--no-sandbox", "--disable-gpu", "--disable-background-networking"]
    with playwright.sync_playwright() as play:
        browser = play.chromium.launch(executable_path=CHROMIUM, args=flags)
        context = browser.new_context(
            viewport={"width": size[0], "height": size[1]}, color_scheme=scheme
        )
        tab = context.new_page()
        said, asked = [], []
        tab.on("console", lambda message: said.append(message.text))
        tab.on("pageerror", lambda error: said.append(str(error)))
        tab.on("request", lambda request: asked.append(request.url))
        tab.goto(with_video.as_uri())
        tab.wait_for_function("document.querySelectorAll('.main-svg').length >= 4")
        drawn = tab.locator(".js-plotly-plot .scatterlayer .trace path.js-line").count()
        played = tab.evaluate(
            """async () => {
                const video = document.querySelector("video");
                await video.play();
                await new Promise(done => setTimeout(done, 1000));
                return [video.currentTime, video.videoWidth];
            }"""
        )
        shape = "document.querySelector('.scatterlayer path.js-line').getAttribute('d')"
        before = tab.evaluate(shape)
        tab.locator(".slider-rail-touch-rect").first.scroll_into_view_if_needed()
        place = tab.locator(".slider-rail-touch-rect").first.bounding_box()
        tab.mouse.click(place["x"] + 0.2 * place["width"], place["y"] + 0.5 * place["height"])
        tab.wait_for_timeout(500)
        after = tab.evaluate(shape)
        wide = tab.evaluate("document.documentElement.scrollWidth")
        paper = tab.evaluate("getComputedStyle(document.body).backgroundColor")
        browser.close()
    assert said == []
    assert [url for url in asked if not url.startswith(("data:", "blob:"))] == [with_video.as_uri()]
    assert drawn >= 8
    assert played[0] > 0.3
    assert played[1] == 1280
    assert before != after  # the slider moves the strip
    assert wide <= size[0]
    assert (min(map(int, re.findall(r"\d+", paper)[:3])) > 200) == (scheme == "light")


@pytest.mark.slow
def test_a_failed_run_is_told_as_such(tmp_path):
    pytest.importorskip("plotly")
    from dataclasses import replace

    from mjsim.results.status import Status

    fallen = replace(walk("gelatin").up_to(800), status=Status.TOPPLED)
    fallen.save(tmp_path / "fallen.nc")
    assert commanded([tmp_path / "fallen.nc", "--no-video", "--out", tmp_path / "p.html"]) == 0
    text = (tmp_path / "p.html").read_text("utf-8")
    assert "toppled, so there is no distance" in text


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["no.nc"], "cannot read a trajectory from 'no.nc'"),
        (["no.nc"], "no such file"),
        (["."], "Is a directory"),
        ([__file__], "no whole file of undulator run"),
        ([], "trajectories"),
        (["no.nc", "--out", "page.pdf"], "out must end in .html, got 'page.pdf'"),
    ],
)
def test_bad_input_is_one_line_and_leaves_no_page(words, said, capsys, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    with pytest.raises(SystemExit) as stop:
        commanded(words)
    printed = capsys.readouterr().err
    assert stop.value.code == 2
    assert said in printed
    assert len(printed.strip().splitlines()) == 1
    assert not list(tmp_path.iterdir())
