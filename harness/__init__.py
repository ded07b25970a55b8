"""The harness: runs a slider-resonator FMU, and says with numbers whether it is right.

Any FMI 2.0 co-simulation FMU with the interface of `harness.interface` can be run. It is compared
with the models in `harness.references`, which share no code with any FMU.
"""
