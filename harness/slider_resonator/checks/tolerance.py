"""The allowed deviation of a result from its reference."""

from __future__ import annotations

from dataclasses import dataclass

from slider_resonator.checks.natural_scale import smallest_reference
from slider_resonator.device.device import Device
from slider_resonator.scenes.expect_table import ExpectTable


@dataclass(frozen=True)
class Tolerance:
    """Allowed deviation: `absolute + relative * |reference|`, in the unit of the quantity.

    Without an `absolute`, be it 0, a reference counts as no smaller than a share of its natural
    scale. For a signal `relative` is a share of the reference's peak, and `absolute` beside it is
    for a reference near zero. `tube` is the half width of a tube in drive periods; of a quantity
    measured in drive periods it is the tolerance.
    """

    absolute: float | None = None
    relative: float = 0.0
    tube: float | None = None

    @classmethod
    def of(cls, expect: ExpectTable) -> Tolerance:
        """Return the tolerance that a scene file gives."""
        given = "absolute" in expect.model_fields_set
        return cls(expect.absolute if given else None, expect.relative, expect.tube)

    def smallest_reference(self, quantity: str, device: Device) -> float:
        """Return the minimum size of a reference, in the quantity's unit."""
        return smallest_reference(quantity, device) if self.absolute is None else 0.0
