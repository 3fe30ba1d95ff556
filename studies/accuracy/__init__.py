"""Accuracy and cost of each method: measured rows, their figures and tables."""
