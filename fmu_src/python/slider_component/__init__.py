"""Slider with an embedded resonator on a friction surface: the component, without FMI.

Standard library only, relative imports only: the package is renamed when it is put into an FMU.
"""
