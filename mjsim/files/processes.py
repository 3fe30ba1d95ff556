"""Start of processes that inherit neither threads nor OpenGL."""

import multiprocessing
from multiprocessing.context import BaseContext


def clean_start(*modules: str) -> BaseContext:
    """Context of a pool: a server that imports modules once for all, or on Windows a new process.

    Args:
        modules: names of the modules that every process will use.
    """
    if "forkserver" not in multiprocessing.get_all_start_methods():
        return multiprocessing.get_context("spawn")
    context = multiprocessing.get_context("forkserver")
    if modules:
        context.set_forkserver_preload(list(modules))
    return context
