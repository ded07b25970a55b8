"""Saving the state of an instance, and taking it over into another one."""

from dataclasses import dataclass
from typing import Any

from slider_resonator.fmu.instance import Instance


@dataclass(frozen=True)
class SavedState:
    """A state of an instance at a time (s); must be freed with `free` before the instance is."""

    instance: Instance
    time: float
    handle: Any

    @classmethod
    def of(cls, instance: Instance) -> "SavedState":
        """Save the present state; NotApplicable where the FMU does not offer that."""
        instance.fmu.require("canGetAndSetFMUstate")
        return cls(instance, instance.time, instance.slave.getFMUstate())

    def restore(self) -> None:
        """Bring the instance back into this state."""
        self.instance.slave.setFMUstate(self.handle)
        self.instance.time = self.time

    def transfer(self, other: Instance) -> None:
        """Bring another instance into this state, in serialised form.

        Raises NotApplicable where the FMU does not offer that.
        """
        self.instance.fmu.require("canSerializeFMUstate")
        content = self.instance.slave.serializeFMUstate(self.handle)
        handle = other.slave.deSerializeFMUstate(content)
        try:
            other.slave.setFMUstate(handle)
        finally:
            other.slave.freeFMUstate(handle)
        other.resumed(self.time)

    def free(self) -> None:
        """Free the memory of the state."""
        self.instance.slave.freeFMUstate(self.handle)
