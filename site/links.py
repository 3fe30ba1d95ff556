"""Dead links, and requests to other hosts, in a folder of HTML pages."""

from functools import cache
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit

LOADED = {"img": "src", "script": "src", "link": "href", "video": "src", "source": "src",
          "iframe": "src"}  # fmt: skip  # what a browser asks for by itself


class _Page(HTMLParser):
    """Links of a page, files it loads, and the places in it that can be linked to."""

    def __init__(self) -> None:
        super().__init__()
        self.links: list[str] = []
        self.loaded: list[str] = []
        self.places: set[str] = {"", "top"}

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        values = {name: value or "" for name, value in attrs}
        self.places |= {values[name] for name in ("id", "name") if name in values}
        if tag == "a" and "href" in values:
            self.links.append(values["href"])
        elif tag in LOADED and LOADED[tag] in values:
            self.loaded.append(values[LOADED[tag]])


@cache
def _page(path: Path) -> _Page:
    page = _Page()
    page.feed(path.read_text("utf-8"))
    return page


def faults(folder: Path) -> list[str]:
    """One line for each link that leads nowhere, and for each file loaded from another host."""
    lines = []
    for path in sorted(folder.rglob("*.html")):
        page, name = _page(path.resolve()), path.relative_to(folder)
        lines += [f"{name} loads {url}" for url in page.loaded
                  if urlsplit(url).netloc or urlsplit(url).scheme in ("http", "https")]  # fmt: skip
        for url in {*page.links, *page.loaded}:
            parts = urlsplit(url)
            if parts.scheme or parts.netloc:
                continue
            target = path.parent / unquote(parts.path) if parts.path else path
            target = (target / "index.html" if target.is_dir() else target).resolve()
            if not target.is_file():
                lines.append(f"{name} links to {url}, which is not there")
            elif target.suffix == ".html" and unquote(parts.fragment) not in _page(target).places:
                lines.append(f"{name} links to {url}, which has no such place")
    return lines
