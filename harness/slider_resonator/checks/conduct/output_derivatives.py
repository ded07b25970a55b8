"""First derivatives of outputs, where an FMU offers them, against two short steps."""

from __future__ import annotations

from collections.abc import Sequence
from ctypes import byref, c_double, c_int

from fmpy.fmi2 import FMU2Slave, fmi2OK, fmi2ValueReference

from slider_resonator.fmu.fmi3_slave import Fmi3Slave
from slider_resonator.fmu.instance import Instance
from slider_resonator.fmu.saved_state import SavedState

OUTPUTS = ("position", "velocity", "resonator_displacement", "resonator_velocity", "normal_force")
"""Outputs that are smooth between events."""
COUNTS = ("contact_mode", "reversals", "last_event_time")
"""Outputs that tell of an event."""
SHORT = 1e-6
"""A step, in drive periods; quotients are of second order, over two."""
ALLOWED = 1e-3
"""Share of a derivative, or of the output's change over a radian of the drive, that a quotient may
differ by: far more than the third derivative adds over the steps."""


def derivative_faults(instance: Instance, state: SavedState, frequency: float) -> Sequence[str]:
    """Compare derivatives of outputs with quotients over short steps; the state is restored.

    Nothing is compared over an event. `frequency` is that of the drive, rad/s.
    """
    slave = instance.slave
    offered = instance.fmu.description.coSimulation.maxOutputDerivativeOrder or 0
    if isinstance(slave, Fmi3Slave) or offered < 1:
        return []
    step = SHORT * 6.283185307179586 / frequency
    references = {name: instance.fmu.variables[name].valueReference for name in OUTPUTS}
    told = {name: _derivative(slave, reference) for name, reference in references.items()}
    rows = [instance.read((*OUTPUTS, *COUNTS))]
    for _ in range(2):
        instance.step_by(step)
        rows.append(instance.read((*OUTPUTS, *COUNTS)))
    state.restore()
    if any(row[name] != rows[0][name] for row in rows for name in COUNTS):
        return []
    faults = []
    for name, derivative in told.items():
        first, middle, last = (row[name] for row in rows)
        quotient = (4.0 * (middle - first) - (last - first)) / (2.0 * step)
        size = max(abs(quotient), abs(middle - first) / step, frequency * abs(last))
        if derivative is not None and not abs(derivative - quotient) <= ALLOWED * size:
            faults.append(f"the derivative of {name} is {derivative!r}, it grows by {quotient!r}")
    return faults


def _derivative(slave: FMU2Slave, reference: int) -> float | None:
    """Return the first derivative of an output, None where the FMU has none."""
    value, order = c_double(), c_int(1)
    status = slave.dll.fmi2GetRealOutputDerivatives(
        slave.component, byref(fmi2ValueReference(reference)), 1, byref(order), byref(value)
    )
    return value.value if status == fmi2OK else None
