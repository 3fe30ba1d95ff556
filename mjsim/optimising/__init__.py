"""Search for the best gait: its variables, what it is judged by, the search, its confirmation."""
