"""Gaits from files: staged pressures, and what a sensor recorded."""
