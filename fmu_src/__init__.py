"""Sources of the FMUs and everything that is generated into them."""

__version__ = "0.1.0"
