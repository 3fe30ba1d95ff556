"""Soft robots on frictional ground, by many engines: speed at a given error of the distance.

    python -m benchmarks.engines            # every engine that is installed, and the figure
    python -m benchmarks.engines --help

docs/benchmark.md has the specification and the results.
"""
