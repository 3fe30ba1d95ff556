"""Friction: laws, contacts, and motion by least dissipation ([Majidi13], section 2.2)."""
