"""Which model, friction law, tolerance and communication step a scene needs, and no more."""

from slider_resonator.choosing.choice import Choice
from slider_resonator.choosing.choosing import choose

__all__ = ["Choice", "choose"]
