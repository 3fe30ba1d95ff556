"""Documentation of the fields of a dataclass, the text below each, and the unit in it."""

import ast
import inspect
import re
import sys
from collections.abc import Mapping
from functools import cache
from itertools import pairwise

_CITATION = re.compile(r"[A-Z][a-z]+\d\d$")


@cache
def field_docs(kind: type) -> Mapping[str, str]:
    """Text below each field of a dataclass, its documentation, in one line."""
    module = ast.parse(inspect.getsource(sys.modules[kind.__module__]))
    classes = {node.name: node for node in module.body if isinstance(node, ast.ClassDef)}
    docs: dict[str, str] = {}
    for statements in pairwise(classes[kind.__name__].body):
        match statements:
            case (
                ast.AnnAssign(target=ast.Name(id=name)),
                ast.Expr(value=ast.Constant(value=str(text))),
            ):
                docs[name] = " ".join(text.split())
    return docs


def units(kind: type) -> Mapping[str, str]:
    """Unit of each field that has one in its documentation: [m], [Pa s/m], [1]."""
    brackets = {name: re.findall(r"\[([^\]]+)\]", text) for name, text in field_docs(kind).items()}
    texts = {name: [w for w in words if not _CITATION.match(w)] for name, words in brackets.items()}
    return {name: words[0] for name, words in texts.items() if words}
