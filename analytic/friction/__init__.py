"""Friction: laws, contacts, and who slides by least dissipation ([Majidi13], section 2.2)."""
