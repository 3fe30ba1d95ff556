"""Narrowing of what is known by one more measurement: the information matrix."""

from typing import NamedTuple

import numpy as np

from studies import Array


class Measurement(NamedTuple):
    """A measurement that could be made.

    Attributes:
        name: in words, with its accuracy.
        slope: of what it would show by what is not known, (F,).
        error: its standard error.
    """

    name: str
    slope: Array
    error: float


def narrowed(covariance: Array, slope: Array, error: float) -> Array:
    """Covariance of what is not known after one more measurement.

    Args:
        covariance: before, (F, F).
        slope: of what is measured by the numbers, (F,).
        error: standard error of the measurement.
    """
    gain = covariance @ slope
    return np.asarray(covariance - np.outer(gain, gain) / (slope @ gain + error**2))


def errors(covariance: Array, slopes: Array) -> Array:
    """Standard errors of K values whose slopes by the numbers are (K, F), (K,)."""
    return np.asarray(np.sqrt(np.einsum("ij,jk,ik->i", slopes, covariance, slopes)))
