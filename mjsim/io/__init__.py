"""Files, command lines, provenance."""
