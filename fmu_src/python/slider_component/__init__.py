"""Slider with an embedded resonator on a friction surface: the Python FMU.

Standard library and relative imports only: the build renames the package for each FMU.
"""
