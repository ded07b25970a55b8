"""The velocity controller, a second FMU that closes a loop around the slider."""
