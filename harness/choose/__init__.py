"""Which model, friction law, tolerance and communication step a scene needs, and no more."""

from harness.choose.choice import Choice
from harness.choose.choosing import choose

__all__ = ["Choice", "choose"]
