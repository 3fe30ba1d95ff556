"""Pictures, videos, pages and the live viewer."""
