"""Every command that a page shows is one that the program knows, with options that it has."""

import importlib
import importlib.util
import re
import shlex
import tomllib

import pytest
from written import TOP, commands

from mjsim.commands.undulator import COMMANDS
from mjsim.files.command_line.options import SceneOptions, tables_of
from mjsim.files.scene_tables.tables import build

MAKEFILE = (TOP / "Makefile").read_text()
EXTRAS = tomllib.loads((TOP / "pyproject.toml").read_text())["project"]["optional-dependencies"]
PARTS = ("...", "COMMAND", "FOLDER", "FILE", "PART", "VERSION")  # for which a reader puts words
INSTALLED_FIRST = ("mjviser",)  # by the command before it
OURS = ("studies", "zoo", "mjsim", "benchmarks")


class ParsedError(Exception):
    """Options of a command, read as the command reads them, before it does anything."""


def parsed(words, monkeypatch):
    """Options of an `undulator` command."""
    name, *rest = words
    assert name in COMMANDS, f"there is no command {name}"
    module = importlib.import_module(f"mjsim.commands.{COMMANDS[name][0]}")
    parse = module.parse

    def stop(*given, **named):
        raise ParsedError(parse(*given, **named))

    with monkeypatch.context() as patch:
        patch.setattr(module, "parse", stop)
        with pytest.raises(ParsedError) as stopped:
            module.main(rest)
    return stopped.value.args[0]


def check_undulator(words, monkeypatch):
    if words[:1] in ([], ["--version"], ["--help"]) or "--help" in words:
        return
    options = parsed(words, monkeypatch)
    if isinstance(options, SceneOptions) and len(words) > 1:
        for tables in tables_of(options):
            if tables["numerics"].get("body") == "auto":
                tables["numerics"].pop("body")
            build(tables)


def check_python(words, monkeypatch):
    if words[0] == "-m":
        name, *_ = words = words[1:]
        if name.split(".")[0] not in OURS:
            module = name in INSTALLED_FIRST or importlib.util.find_spec(name)
            assert module, f"there is no module {name}"
            return
        place = TOP / name.replace(".", "/")
        files = [*place.glob("__main__.py"), *place.parent.glob(f"{place.name}.py")]
        assert files, f"there is no module {name}"
    else:
        files = [TOP / words[0]]
        assert files[0].is_file()
    text = "".join(file.read_text() for file in files)
    for word in words[1:]:
        if word.startswith("--"):
            name = word.lstrip("-").partition("=")[0]
            assert re.search(rf"--{name}\b|\b{name.replace('-', '_')}:", text), word
        elif words[0] == "zoo":
            assert (TOP / "zoo" / word).is_dir(), word


def check_make(words, monkeypatch):
    for word in words:
        name, _, value = word.partition("=")
        pattern = rf"\$\({name}\)" if value else rf"^{re.escape(name)}:"
        assert re.search(pattern, MAKEFILE, re.M), f"make has no {word}"


def check_pip(words, monkeypatch):
    assert words[0] == "install"
    for word in words[1:]:
        named = re.search(r"\[(.*)\]", word)
        assert not named or set(named[1].split(",")) <= set(EXTRAS), word


def check_dask(words, monkeypatch):
    options = {"scheduler": set(), "worker": {"--nworkers"}}
    assert {word for word in words if word.startswith("--")} <= options[words[0]]


def check_bash(words, monkeypatch):
    assert (TOP / words[0]).is_file()


KNOWN = {"undulator": check_undulator, "python": check_python, "python3": check_python,
         "make": check_make, "pip": check_pip, "dask": check_dask, "bash": check_bash}  # fmt: skip

STAND_INS = {  # files that a reader has
    "my.toml": "[robot]\nlength = '110 mm'\nmass = '14 g'\n",
    "cloth.toml": "[ground]\nsurface = 'measured'\nfriction = 0.4\ntip_friction = 0.3\n"
    "[numerics]\nfriction = 'coulomb'\n",
    "pressures.csv": "time [s], p1 [kPa], p2 [kPa], p3 [kPa]\n0,0,0,0\n2,40,0,0\n4,0,0,0\n",
    "commands.csv": "time [s], p1 [kPa], p2 [kPa], p3 [kPa]\n0,0,0,0\n2,40,0,0\n4,0,0,0\n",
    "curve.csv": "pressure [kPa], angle [deg]\n0,0\n25,30\n50,65\n",
}


@pytest.fixture
def reader(tmp_path, monkeypatch):
    """A folder of a reader: a clone, with files that the pages write or take."""
    for name, text in STAND_INS.items():
        (tmp_path / name).write_text(text)
    (tmp_path / "tripod.toml").write_text(tripod())
    for name in ("examples", "models", "docs", "zoo"):
        (tmp_path / name).symlink_to(TOP / name)
    monkeypatch.chdir(tmp_path)


def tripod():
    """The robot of three legs of the page on limbs."""
    page = (TOP / "docs" / "quadruped.md").read_text("utf-8")
    return re.search(r"`tripod.toml`:\n\n```toml\n(.*?)```", page, re.S)[1]


@pytest.mark.usefixtures("reader", "forgets")
def test_every_command_of_a_page_is_read_by_its_program(monkeypatch):
    shown = {part: where for where, line in commands() for part in line.split(" && ")}
    assert len(shown) > 100
    seen, wrong = set(), []
    for line, where in shown.items():
        words = shlex.split(line.partition(" > ")[0], comments=True)
        words[0] = re.sub(r"^\.\w+/bin/", "", words[0])
        if words[0].startswith("scripts/"):
            words.insert(0, "bash")
        cut = next((i for i, word in enumerate(words) if word in PARTS), len(words))
        short, words = cut < len(words), tuple(words[:cut])
        if words in seen or (short and words[0] == "undulator"):
            continue
        seen.add(words)
        try:
            KNOWN[words[0]](list(words[1:]), monkeypatch)
        except (Exception, SystemExit) as error:
            wrong.append(f"{where} shows `{line}`: {error!r}")
    assert not wrong, "\n".join(wrong)
