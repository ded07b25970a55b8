"""Faulty native FMUs: faults written by hand into the C sources, and harmless variants."""
