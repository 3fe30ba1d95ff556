"""Draw which package imports which, from the code itself: `make architecture`."""

import ast
import graphlib
from pathlib import Path

from matplotlib.figure import Figure

TOP = Path(__file__).resolve().parent.parent
PACKAGES = ("analytic", "mjsim", "studies")
_BELOW = tuple(f"analytic.{name}" for name in  # plain data, and what serves it
               ("checks", "fields", "lazy", "progress", "registry", "shapes", "units"))  # fmt: skip
_LABEL = {"analytic": "prediction", "mjsim": "commands"}


def package_of(module: str) -> str:
    """The package that a module is drawn as."""
    if module in _BELOW:
        return "analytic.scene"
    parts = module.split(".")
    if parts[0] == "studies":
        return "studies"
    if (TOP / "/".join(parts[:2])).is_dir():
        return ".".join(parts[:2])
    return "analytic" if parts[0] == "analytic" else "mjsim.commands"


def imports() -> set[tuple[str, str]]:
    """Pairs of modules, importer first, those inside functions included."""
    pairs = set()
    for path in (path for package in PACKAGES for path in (TOP / package).rglob("*.py")):
        module = ".".join(path.relative_to(TOP).with_suffix("").parts).removesuffix(".__init__")
        if module in PACKAGES:
            continue  # names that are imported when they are first used
        tree = ast.parse(path.read_text(encoding="utf-8"))
        tree.body = [node for node in tree.body if not _for_types_only(node)]
        for node in ast.walk(tree):
            if isinstance(node, ast.ImportFrom) and node.module:
                names = [node.module, *(f"{node.module}.{alias.name}" for alias in node.names)]
                known = [name for name in names if (TOP / name.replace(".", "/")).is_dir()
                         or (TOP / (name.replace(".", "/") + ".py")).is_file()]  # fmt: skip
                targets = known[-1:] or names[:1]
                pairs |= {(module, t) for t in targets if t.split(".")[0] in PACKAGES}
    return pairs


def _for_types_only(node: ast.stmt) -> bool:
    return isinstance(node, ast.If) and ast.unparse(node.test) == "TYPE_CHECKING"


def arrows() -> set[tuple[str, str]]:
    """Pairs of packages, importer first."""
    pairs = {(package_of(one), package_of(two)) for one, two in imports()}
    return {(one, two) for one, two in pairs if one != two}


def layers(pairs: set[tuple[str, str]]) -> dict[str, int]:
    """How many packages at most lie below each."""
    below: dict[str, set[str]] = {}
    for one, two in pairs:
        below.setdefault(one, set()).add(two)
        below.setdefault(two, set())
    depth: dict[str, int] = {}
    for name in graphlib.TopologicalSorter(below).static_order():
        depth[name] = 1 + max((depth[other] for other in below[name]), default=-1)
    return depth


def direct(pairs: set[tuple[str, str]]) -> set[tuple[str, str]]:
    """Pairs that do not follow from others (the transitive reduction)."""
    depth = layers(pairs)
    reach: dict[str, set[str]] = {name: set() for name in depth}
    for name in sorted(depth, key=lambda name: depth[name]):
        for one, two in pairs:
            if one == name:
                reach[name] |= {two} | reach[two]
    return {
        (one, two) for one, two in pairs
        if not any((one, other) in pairs and two in reach[other] for other in depth)
    }  # fmt: skip


def draw() -> Figure:
    """What each package builds on, left of it; what follows from other arrows is left out."""
    pairs = arrows()
    depth = layers(pairs)
    rows: dict[int, list[str]] = {}
    for name in sorted(depth):
        rows.setdefault(depth[name], []).append(name)
    place = {
        name: (1.5 * column, len(names) * (0.5 - (i + 0.5) / len(names)) + 0.15 * (column % 2))
        for column, names in rows.items() for i, name in enumerate(names)
    }  # fmt: skip
    figure = Figure(figsize=(11, 3.6), dpi=110)
    axes = figure.add_axes((0, 0, 1, 1))
    axes.set(xlim=(-0.7, 1.5 * max(rows) + 0.7), ylim=(-2.2, 2.2))
    axes.axis("off")
    for one, two in sorted(direct(pairs)):
        line = {"arrowstyle": "-|>", "color": "0.45", "shrinkA": 28, "shrinkB": 32, "lw": 1.0}
        axes.annotate("", place[two], place[one], arrowprops=line)
    for name, where in place.items():
        text = _LABEL.get(name, name.removeprefix("mjsim.").removeprefix("analytic."))
        shade = "#dbe9f4" if name.startswith("analytic") else "#f6e7d8"
        axes.text(*where, text, ha="center", va="center", fontsize=10, zorder=2,
                  bbox={"boxstyle": "round,pad=0.5", "fc": shade, "ec": "0.4"})  # fmt: skip
    return figure


if __name__ == "__main__":
    draw().savefig(TOP / "docs" / "architecture.png")
