"""Parameters of a device from measurements: read, predict, estimate, report."""
