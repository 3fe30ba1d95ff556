"""Draw which package imports which, from the code itself: `make architecture`."""

import ast
import graphlib
from pathlib import Path

from matplotlib.figure import Figure

TOP = Path(__file__).resolve().parent.parent
PACKAGES = ("analytic", "mjsim", "studies")
_BELOW = tuple(f"analytic.{name}" for name in  # plain data, and what serves it
               ("checks", "fields", "lazy", "progress", "registry", "shapes", "units"))  # fmt: skip
_PACKAGES = {
    "analytic": "theory",
    "mjsim": "MuJoCo, files, commands",
    "studies": "not in the wheel",
}
_SHADES = {"analytic": "#cfe3f3", "mjsim": "#f6e0c8", "studies": "#e3e3e3"}
_ROWS = {  # from the top, so that no arrow crosses a box; 3 if it is not here
    **dict.fromkeys(("analytic.scene", "analytic.friction", "analytic.solvers",
                     "analytic.gradient", "analytic"), 1.0),
    "analytic.fitting": 2.0, "mjsim.sweeps": 1.5, "mjsim.optimising": 2.5, "mjsim.pictures": 3.5,
    "mjsim.fitting": 4.5, "mjsim.commands": 2.0, "mjsim.env": 3.5, "studies": 5.5,
    "mjsim.uncertainty": 4.5,
}  # fmt: skip
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
                modules = [name for name in names if (TOP / name.replace(".", "/")).is_dir()
                         or (TOP / (name.replace(".", "/") + ".py")).is_file()]  # fmt: skip
                targets = modules[-1:] or names[:1]
                pairs |= {(module, t) for t in targets if t.split(".")[0] in PACKAGES}
    return pairs


def _for_types_only(node: ast.stmt) -> bool:
    return isinstance(node, ast.If) and ast.unparse(node.test) == "TYPE_CHECKING"


def arrows() -> set[tuple[str, str]]:
    """Pairs of packages, importer first."""
    pairs = {(package_of(one), package_of(two)) for one, two in imports()}
    return {(one, two) for one, two in pairs if one != two}


def layers(pairs: set[tuple[str, str]]) -> dict[str, int]:
    """Greatest number of packages below each."""
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
    """Packages that each one builds on, left of it; what follows from other arrows is left out."""
    pairs = arrows()
    depth = layers(pairs)
    place = {name: (1.5 * column, -_ROWS.get(name, 3.0)) for name, column in depth.items()}
    figure = Figure(figsize=(12.5, 4.4), dpi=110)
    axes = figure.add_axes((0, 0, 1, 1))
    axes.set(xlim=(-0.8, 1.5 * max(depth.values()) + 0.8), ylim=(-6.0, 1.0))
    axes.axis("off")
    axes.set_title("A package imports what its arrows lead to, and what that imports: "
                   "nothing leads back", y=0.92, fontsize=11)  # fmt: skip
    boxes = {}
    for name, where in place.items():
        text = _LABEL.get(name, name.removeprefix("mjsim.").removeprefix("analytic."))
        boxes[name] = axes.text(
            *where, text, ha="center", va="center", fontsize=10, zorder=2,
            bbox={"boxstyle": "round,pad=0.4", "fc": _SHADES[name.split(".")[0]], "ec": "0.4"},
        )  # fmt: skip
    for one, two in sorted(direct(pairs)):
        begin, end = (boxes[name].get_bbox_patch() for name in (one, two))
        line = {"arrowstyle": "-|>", "color": "0.35", "lw": 1.1, "zorder": 1, "shrinkA": 1,
                "shrinkB": 1, "patchA": begin, "patchB": end}  # fmt: skip
        axes.annotate("", place[two], place[one], arrowprops=line)
    for number, (package, told) in enumerate(_PACKAGES.items()):
        shade = {"boxstyle": "round,pad=0.3", "fc": _SHADES[package], "ec": "none"}
        axes.text(-0.6, -4.6 - 0.5 * number, f"{package}: {told}", va="center", fontsize=9.5,
                  bbox=shade)  # fmt: skip
    return figure


if __name__ == "__main__":
    draw().savefig(TOP / "docs" / "architecture.png")
