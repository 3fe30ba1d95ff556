"""Contents of the pages of the repository:blocks of code, commands within the text, links."""

import re
from dataclasses import dataclass
from pathlib import Path

TOP = Path(__file__).resolve().parents[2]
_PATTERNS = ("*.md", "docs/*.md", "zoo/README.md", "zoo/*/README.md", "models/README.md",
             "studies/data/README.md", "site/README.md")  # fmt: skip
PAGES = sorted(path for pattern in _PATTERNS for path in TOP.glob(pattern))
_FENCE = re.compile(r"^```(\w*)\n(.*?)^```$", re.M | re.S)
_INLINE = re.compile(r"`((?:undulator|python|make|pip install|bash) [^`]+|scripts/[^`]+)`")


@dataclass(frozen=True)
class Block:
    """A fenced block of a page."""

    page: Path
    line: int
    language: str
    text: str

    def __str__(self) -> str:
        return f"{self.page.relative_to(TOP)}:{self.line}"


def blocks(*languages: str) -> list[Block]:
    """Blocks of all pages in these languages."""
    every = []
    for page in PAGES:
        text = page.read_text("utf-8")
        for match in _FENCE.finditer(text):
            line = text[: match.start()].count("\n") + 1
            every.append(Block(page, line, match[1], match[2]))
    return [block for block in every if not languages or block.language in languages]


def prose(page: Path) -> str:
    """Text of a page without its blocks."""
    return _FENCE.sub("", page.read_text("utf-8"))


def commands() -> list[tuple[str, str]]:
    """Each command that a page shows, and where, in blocks and within the text."""
    shown = []
    for block in blocks("sh"):
        for line in block.text.replace("\\\n", " ").splitlines():
            shown.append((str(block), line))
    for page in PAGES:
        if page.name != "CHANGELOG.md":  # which tells of what was
            name = str(page.relative_to(TOP))
            shown += [(name, " ".join(text.split())) for text in _INLINE.findall(prose(page))]
    return [(where, line) for where, line in shown if line.split("#")[0].strip()]
