"""Generators of what the twins share, one per file or pair of files."""
