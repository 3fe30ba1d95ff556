"""What a per cent of each field of a scene does to its distance."""
