"""Scenes as tables of plain values, from TOML and options, and back."""
