"""Narrowing of a fit's covariance by one more measurement: its information matrix."""

import numpy as np

from studies import Array


def narrowed(covariance: Array, slope: Array, error: float) -> Array:
    """Covariance of fitted numbers after one more measurement.

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
