"""Solvers of the quasi-static shapes, from modes to elastica, and of trees of limbs."""
