"""What a walk was: trajectory, measures, record, files, plots."""
