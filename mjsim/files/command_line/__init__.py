"""Command lines: options from dataclasses and scenes, messages of one line, Ctrl-C."""
