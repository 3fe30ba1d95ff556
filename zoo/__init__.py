"""Robots that others built and measured, beside what the models say of them: `python -m zoo`."""
