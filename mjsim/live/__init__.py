"""A scene played live: by its gait or by hand."""
