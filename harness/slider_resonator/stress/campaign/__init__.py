"""Random devices and schedules in an FMU, against the references."""
