"""The page of a walk: one HTML file with words, numbers, video and charts."""
