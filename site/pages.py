"""Pages of the repository gathered into one folder, at their own places, for the generator."""

import base64
import json
import posixpath
import re
import shutil
from collections.abc import Iterable, Iterator
from pathlib import Path

TOP = Path(__file__).resolve().parent.parent
PAGES = ("docs/*.md", "zoo/README.md", "zoo/*/README.md", "models/README.md", "CHANGELOG.md",
         "CONTRIBUTING.md", "CODE_OF_CONDUCT.md", "SUPPORT.md", "studies/data/README.md",
         "studies/data/*/README.md")  # fmt: skip
SHOWN = {".py": "python", ".toml": "toml"}  # files that become pages, and their language
LINK = re.compile(r"(!?)\[([^\]]*)\]\(([^)\s#:]+)(#[^)\s]*)?\)")
LIVE = ('<p><strong><a href="live/index.html">Drive the robot in your browser</a></strong>: '
        "nothing to install.</p>\n")  # fmt: skip


def gather(stage: Path, live: bool) -> None:
    """Write all pages, and the files that they show, below a folder.

    Args:
        stage: the folder, made anew.
        live: whether the live page will stand beside them, so that the home page links to it.
    """
    shutil.rmtree(stage, ignore_errors=True)
    shutil.copytree(TOP / "site" / "static", stage / "_static")
    home = (TOP / "site" / "home.md").read_text("utf-8")
    _write(stage, "index.md", home.replace("<!-- live -->\n", LIVE if live else ""))
    shutil.copy(TOP / "site" / "reference.md", stage / "reference.md")
    listing = {"examples": "Examples", "docs/tutorials": "Tutorials"}
    for folder, title in listing.items():
        names = sorted(path.name for path in (TOP / folder).iterdir()
                       if path.suffix in (*SHOWN, ".ipynb"))  # fmt: skip
        lines = [f"- [{_title(TOP / folder / name)}]({name})" for name in names]
        text = f"# {title}\n\nEach one is run by a test.\n\n" + "\n".join(lines) + "\n"
        _write(stage, f"{folder}/README.md", text + _below(names))
    for path in (path for pattern in PAGES for path in sorted(TOP.glob(pattern))):
        _write(stage, path.relative_to(TOP).as_posix(), path.read_text("utf-8"))
    with (stage / "zoo" / "README.md").open("a", encoding="utf-8") as page:
        page.write(_below(f"{path.parent.name}/README.md" for path in (TOP / "zoo").glob("*/*.md")))


def _below(names: Iterable[str]) -> str:
    """Pages that the navigation shows below another one."""
    pages = "\n".join(sorted(name.removesuffix(".ipynb") for name in names))
    return f"\n```{{toctree}}\n:hidden:\n\n{pages}\n```\n"


def _title(path: Path) -> str:
    """First words of a script's docstring, or the heading of a notebook."""
    text = path.read_text("utf-8")
    if path.suffix == ".ipynb":
        return re.sub(r"^#+ ", "", json.loads(text)["cells"][0]["source"][0]).strip()
    title = re.match(r'"""(.*?)[.:\n"]', text) or re.match(r"# *(.*?)[.:\n]", text)
    return title[1] if title else path.name


def _write(stage: Path, name: str, text: str) -> None:
    """Write a page, and what it links to, once."""
    target = stage / name
    if target.exists():
        return
    target.parent.mkdir(parents=True, exist_ok=True)
    target.touch()  # it may link to itself by way of another page
    target.write_text(LINK.sub(lambda link: _link(stage, name, link), text), "utf-8")


def _link(stage: Path, page: str, link: re.Match[str]) -> str:
    """Link where all pages are gathered; its target is written too."""
    mark, words, target, anchor = link[1], link[2], link[3], link[4] or ""
    path = posixpath.normpath(posixpath.join(posixpath.dirname(page), target))
    source = TOP / path
    if path == "README.md":
        path = "index.md"
    elif source.is_dir():
        path += "/README.md"
        if not (stage / path).exists() and (TOP / path).is_file():
            _write(stage, path, (TOP / path).read_text("utf-8"))
    elif source.suffix == ".md":
        if source.is_file():
            _write(stage, path, source.read_text("utf-8"))
    elif source.suffix == ".ipynb":
        path = path.removesuffix(".ipynb") + ".md"
        _write(stage, path, "".join(notebook(source, stage / path)))
    elif source.suffix in SHOWN:
        code = source.read_text("utf-8")
        language = SHOWN[source.suffix]
        _write(stage, f"{path}.md", f"# {path}\n\n````{language}\n{code}````\n")
        path += ".md"
    elif source.is_file():
        (stage / path).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(source, stage / path)
    if source.suffix == ".mp4" and page == "docs/gallery.md":
        return _video(stage, path, words)
    return f"{mark}[{words}]({posixpath.relpath(path, posixpath.dirname(page) or '.')}{anchor})"


def _video(stage: Path, path: str, words: str) -> str:
    """A player of a film, below the words that link to it elsewhere."""
    (stage / "_static" / "films").mkdir(exist_ok=True)
    shutil.copy(TOP / path, stage / "_static" / "films")
    place = f"../_static/films/{posixpath.basename(path)}"
    return (f'<video controls muted loop playsinline preload="metadata" src="{place}"></video>'
            f"<br>{words}")  # fmt: skip


def notebook(path: Path, page: Path) -> Iterator[str]:
    """Markdown of an executed notebook; its pictures are written beside the page."""
    cells = json.loads(path.read_text("utf-8"))["cells"]
    for number, cell in enumerate(cells):
        source = "".join(cell["source"])
        if cell["cell_type"] == "markdown":
            yield f"{source}\n\n"
            continue
        yield f"```python\n{source}\n```\n\n"
        for place, output in enumerate(cell["outputs"]):
            data = output.get("data", {})
            if "image/png" in data:
                name = f"{path.stem}-{number}-{place}.png"
                page.parent.mkdir(parents=True, exist_ok=True)
                (page.parent / name).write_bytes(base64.b64decode(data["image/png"]))
                (page.parent / name).touch()
                yield f"![What cell {number} draws]({name})\n\n"
            elif text := "".join(output.get("text", data.get("text/plain", []))):
                yield f"```text\n{text.rstrip()}\n```\n\n"
