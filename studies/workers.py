"""Processes that studies share their walks among."""

import logging
import os
from concurrent.futures import ProcessPoolExecutor

from mjsim.files.processes import clean_start


def pool() -> ProcessPoolExecutor:
    """One process a core, in which divergence is an outcome and not a warning."""
    return ProcessPoolExecutor(os.cpu_count(), mp_context=clean_start(), initializer=_quiet)


def _quiet() -> None:
    logging.getLogger("absl").setLevel(logging.ERROR)
