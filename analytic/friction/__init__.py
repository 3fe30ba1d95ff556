"""Friction: laws, contacts, and which of them slide by least dissipation ([Majidi13], section 2.2)."""
