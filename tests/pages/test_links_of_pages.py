"""Links of the pages lead somewhere, in the repository and on the site that is built of it."""

import importlib.util
import re
import subprocess
import sys
from functools import cache

import pytest
from written import PAGES, TOP, prose

_LINK = re.compile(r"\]\(([^)\s:#]*)(?:#([^)\s]+))?\)|^\[[^\]]+\]: ([^\s:#]*)(?:#(\S+))?$", re.M)


@cache
def places(page):
    """Names of the headings of a page, as GitHub spells them."""
    names = []
    for heading in re.findall(r"^#+ (.*)$", prose(page), re.M):
        words = re.sub(r"[^\w\- ]", "", re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading).lower())
        names.append(words.replace(" ", "-"))
    return names


def test_links_of_the_pages_lead_to_files_and_headings():
    wrong = []
    for page in PAGES:
        for one, place, other, place_there in _LINK.findall(prose(page)):
            target = (page.parent / (one or other)) if one or other else page
            anchor = place or place_there
            if not target.exists():
                wrong.append((str(page.relative_to(TOP)), one or other))
            elif anchor and anchor not in places(target.resolve()):
                wrong.append((str(page.relative_to(TOP)), f"{one or other}#{anchor}"))
    assert not wrong


def test_pictures_of_the_pages_are_small():
    shown = {(page.parent / name).resolve() for page in PAGES
             for name in re.findall(r"!\[[^\]]*\]\(([^)\s]+)\)", prose(page))}  # fmt: skip
    for picture in shown:
        assert picture.stat().st_size < (500_000 if picture.suffix == ".gif" else 200_000), picture


def test_the_home_page_links_to_the_live_page_where_it_stands_beside(tmp_path):
    spec = importlib.util.spec_from_file_location("pages", TOP / "site" / "pages.py")
    pages = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(pages)
    for live in (True, False):
        pages.gather(tmp_path, live)
        assert ("live/index.html" in (tmp_path / "index.md").read_text("utf-8")) == live
    for name in ("docs/start.md", "docs/tutorials/own_strip.md", "examples/own_law.py.md"):
        assert (tmp_path / name).is_file()
    assert "<video" in (tmp_path / "docs" / "gallery.md").read_text("utf-8")


@pytest.mark.slow
def test_the_site_is_built_without_a_warning_a_dead_link_or_a_request_to_another_host(tmp_path):
    for module in ("sphinx", "myst_parser", "furo"):
        pytest.importorskip(module)
    pytest.importorskip("mjsim.env.dm_binding", exc_type=ImportError)  # of the reference
    done = subprocess.run(
        [sys.executable, "site/build.py", str(tmp_path / "site")],
        cwd=TOP, capture_output=True, text=True,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    site = tmp_path / "site"
    assert (site / "reference" / "mjsim" / "simulation" / "simulation.html").is_file()
    assert (site / "docs" / "start.html").is_file()
    # the check sees what it is there for
    (site / "moved.html").write_text((site / "docs" / "start.html").read_text("utf-8"), "utf-8")
    (site / "asks.html").write_text('<img src="https://example.org/a.png">')
    spec = importlib.util.spec_from_file_location("links", TOP / "site" / "links.py")
    links = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(links)
    faults = links.faults(site)
    assert any("is not there" in fault for fault in faults)
    assert "asks.html loads https://example.org/a.png" in faults
