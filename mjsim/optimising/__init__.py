"""Search for the best gait: variables, objective, search and confirmation."""
