"""Ground: what it looks like and what carries the strip."""
