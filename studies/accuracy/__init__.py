"""How accurate and how fast each method is: measured rows, their figures, and what they decide."""
