"""Processes that begin clean, whatever threads and OpenGL this one has."""

import multiprocessing
from multiprocessing.context import BaseContext


def clean_start(*modules: str) -> BaseContext:
    """For a pool: by a server that imports modules once for all; on Windows, which has none, anew.

    Args:
        modules: names of what every process will use.
    """
    if "forkserver" not in multiprocessing.get_all_start_methods():
        return multiprocessing.get_context("spawn")
    context = multiprocessing.get_context("forkserver")
    if modules:
        context.set_forkserver_preload(list(modules))
    return context
