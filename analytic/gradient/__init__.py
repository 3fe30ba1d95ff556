"""Derivatives of the distance per cycle of a strip, by the implicit function theorem."""
