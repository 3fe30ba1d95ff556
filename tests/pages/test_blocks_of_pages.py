"""Every block of code on a page is one that runs, or that the program reads."""

import contextlib
import io
import json
import sqlite3
import tomllib

import pytest
from written import PAGES, TOP, blocks, prose

from mjsim.commands import run
from mjsim.files.scene_tables.tables import build, read_tables
from mjsim.sweeps.plan import read_plan

LANGUAGES = {"sh", "python", "toml", "text"}
UNFINISHED = ("[project",)  # tables of other programs


def test_every_block_names_its_language_and_none_is_set_off_by_indentation():
    assert {block.language for block in blocks()} <= LANGUAGES
    for page in PAGES:
        above = ""
        for line in prose(page).splitlines():
            assert not (line.startswith("    ") and not above and line.strip()), (page.name, line)
            above = line.strip()


def test_every_table_of_a_page_is_read_as_a_scene_or_a_plan(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "curve.csv").write_text("pressure [kPa], angle [deg]\n0,0\n25,30\n50,65\n")
    (tmp_path / "my.toml").write_text("")
    path = tmp_path / "page.toml"
    for block in blocks("toml"):
        path.write_text(block.text)
        assert tomllib.loads(block.text), block
        if block.text.startswith("model ="):
            read_plan(path)
        elif not block.text.startswith(UNFINISHED):
            build(read_tables(path), str(block))


@pytest.mark.parametrize("block", blocks("python"), ids=str)
def test_every_python_block_of_a_page_runs(block, tmp_path, monkeypatch):
    if "gymnasium" in block.text:
        pytest.importorskip("gymnasium")
    if "mjsim.env.load" in block.text:
        pytest.importorskip("mjsim.env.dm_binding", exc_type=ImportError)
    monkeypatch.chdir(tmp_path)
    (tmp_path / "my.toml").write_text("[ground]\nsurface = 'gelatin'\n")
    with contextlib.closing(sqlite3.connect("sweep.sqlite")) as table:
        table.execute("create table scenes (status text)")
    code = block.text.replace("num_envs=64", "num_envs=2")
    with contextlib.redirect_stdout(io.StringIO()):
        exec(compile(code, str(block), "exec"), {"__name__": "page"})


def test_every_page_begins_with_its_heading_and_shows_a_picture():
    without = {"CHANGELOG.md", "CODE_OF_CONDUCT.md", "CONTRIBUTING.md", "SUPPORT.md"}
    for page in PAGES:
        text = page.read_text("utf-8")
        assert text.startswith("# "), page
        if page.parent.name in ("docs", "zoo") or page.parent.parent.name == "zoo":
            assert "![" in text, page.relative_to(TOP)
    assert {page.name for page in PAGES} >= without


def test_the_readme_fits_on_a_hundred_lines():
    assert len((TOP / "README.md").read_text("utf-8").splitlines()) <= 100


def test_the_page_on_columns_explains_every_key_of_a_run(capsys, tmp_path, coarse):
    words = ["--surface", "gelatin", "--links", "6", "--timestep", "0.05", "--no-video", "--json"]
    run.main([*words, "--out", str(tmp_path)])
    page = (TOP / "docs" / "output.md").read_text("utf-8")
    assert not [key for key in json.loads(capsys.readouterr().out) if f"`{key}`" not in page]
