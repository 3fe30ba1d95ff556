"""Results of a walk: trajectory, measures, record, files, plots."""
