"""Where methods fail: maps of outcomes and predicted limits."""
