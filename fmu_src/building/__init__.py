"""Building the FMUs: what goes in, how it is compiled, and how it is packed."""
