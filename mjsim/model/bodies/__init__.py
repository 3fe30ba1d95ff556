"""Robots as MJCF: chain, cable, rod, limbs, and the parts that all have."""
