"""Processes that studies share their walks among."""

import logging
import multiprocessing
import os
from concurrent.futures import ProcessPoolExecutor


def pool() -> ProcessPoolExecutor:
    """One process a core, in which divergence is an outcome and not a warning."""
    context = multiprocessing.get_context("forkserver")
    return ProcessPoolExecutor(os.cpu_count(), mp_context=context, initializer=_quiet)


def _quiet() -> None:
    logging.getLogger("absl").setLevel(logging.ERROR)
