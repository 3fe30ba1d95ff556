"""Friction laws in MuJoCo, and the contact lengths they rest on."""
