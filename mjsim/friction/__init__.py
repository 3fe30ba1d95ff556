"""Friction laws in MuJoCo, and the contact lengths that they depend on."""
