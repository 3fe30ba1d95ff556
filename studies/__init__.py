"""Charts, maps and figures, and what only examples use: built on the product, not part of it."""
