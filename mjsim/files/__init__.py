"""Files, tables, units and command lines, and the scenes that are made of them."""
