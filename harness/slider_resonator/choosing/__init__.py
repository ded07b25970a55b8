"""Which model, friction law, tolerance and communication step a scene needs, and no more."""
