"""What accuracy costs: every model and every peer on one scene, as work-precision data."""
