"""Sources of the FMUs, and the code that generates and builds them."""

__version__ = "0.2.0"
