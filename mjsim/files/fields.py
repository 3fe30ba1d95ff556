"""What stands below each field of a dataclass: its documentation, and in it its unit."""

import ast
import inspect
import re
import textwrap
from collections.abc import Mapping
from functools import cache

_CITATION = re.compile(r"[A-Z][a-z]+\d\d$")


@cache
def field_docs(kind: type) -> Mapping[str, str]:
    """What stands below each field of a dataclass as its documentation."""
    (tree,) = ast.parse(textwrap.dedent(inspect.getsource(kind))).body
    assert isinstance(tree, ast.ClassDef)
    docs: dict[str, str] = {}
    for one, two in zip(tree.body, tree.body[1:], strict=False):
        if (
            isinstance(one, ast.AnnAssign)
            and isinstance(one.target, ast.Name)
            and isinstance(two, ast.Expr)
            and isinstance(two.value, ast.Constant)
            and isinstance(two.value.value, str)
        ):
            docs[one.target.id] = " ".join(two.value.value.split())
    return docs


def units(kind: type) -> Mapping[str, str]:
    """The unit of each field that says one in its documentation: [m], [Pa s/m], [1]."""
    found = {}
    for name, text in field_docs(kind).items():
        words = [word for word in re.findall(r"\[([^\]]+)\]", text) if not _CITATION.match(word)]
        if words:
            found[name] = words[0]
    return found
