"""The stability matrix: the device at its extremes, run in an FMU and judged by physics."""
