"""What is made of a walk: mechanics, files, plots."""
