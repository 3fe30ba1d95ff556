"""Stability of the methods: maps of outcomes and predicted limits."""
