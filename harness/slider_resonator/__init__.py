"""The harness: runs slider-resonator FMUs and compares them with independent references.

Any FMI 2.0 co-simulation FMU with the interface of `slider_resonator.device.interface` can be run.
It is compared with the models in `slider_resonator.references`, which share no code with any FMU.
"""

__version__ = "0.1.0"
