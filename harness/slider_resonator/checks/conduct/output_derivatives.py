"""First derivatives of outputs, where an FMU offers them, against two short steps."""

from collections.abc import Iterator, Mapping, Sequence
from ctypes import byref, c_double, c_int
from math import tau

from fmpy.fmi2 import (
    FMU2Slave,
    fmi2DoStepStatus,
    fmi2LastSuccessfulTime,
    fmi2OK,
    fmi2Terminated,
    fmi2ValueReference,
    fmi2Warning,
)

from slider_resonator.fmu.fmi3_slave import Fmi3Slave
from slider_resonator.fmu.instance import Instance, SavedState

OUTPUTS = (
    *("position", "velocity", "resonator_displacement", "resonator_velocity"),
    *("normal_force", "friction_force"),
)
"""Outputs that are smooth between events."""
OF_STATE = ("position", "velocity", "resonator_displacement", "resonator_velocity")
"""Outputs of which an FMU that offers derivatives must have one."""
SLOW = "mean_velocity"
"""An output that is smooth, and slow, where motion is averaged to first order."""
COUNTS = ("reversals", "last_event_time")
"""Outputs that change at each event. The contact mode also changes without one, where a slider at
rest on bristles sets out."""
HELD = (SLOW, "stick_fraction", "contact_mode", *COUNTS)
"""Outputs that are held for a time, in which their derivative is 0."""
SHORT = 1e-6
"""A step, in drive periods; quotients are of second order, over two."""
ALLOWED = 1e-3
"""Share of a derivative, or of the output's change over a radian of the drive, that a quotient may
differ by: far more than the third derivative adds over the steps."""
SMALL = 1e-3
"""Share of the peak of an output, over a radian of the drive, in whose units its derivative may be
off by `ALLOWED`: what rounding leaves of an output next to zero is far less."""
ROUNDED = 1e-12
"""Share of a slow output, over a step, in whose units its derivative may be off by `ALLOWED`."""


def derivative_faults(
    instance: Instance, state: SavedState, frequency: float, peaks: Mapping[str, float]
) -> Sequence[str]:
    """Compare derivatives of outputs with quotients over short steps; the state is restored.

    Nothing is compared over an event. `frequency` is that of the drive, rad/s, `peaks` are those of
    the outputs in a run.
    """
    slave = instance.slave
    offered = instance.fmu.offers.maxOutputDerivativeOrder or 0
    if isinstance(slave, Fmi3Slave) or offered < 1:
        return []
    step = SHORT * tau / frequency
    order = "averaging_order"
    first_order = order not in instance.fmu.variables or instance.value(order) == 1.0
    averaged = first_order and instance.value("fidelity") == 0.0
    outputs = (*OUTPUTS, SLOW) if averaged else OUTPUTS
    held = [name for name in HELD if name not in outputs]
    reported = {
        name: _derivative(slave, instance.fmu.reference(name)) for name in (*outputs, *held)
    }
    rows = [instance.read((*outputs, *HELD))]
    for _ in range(2):
        instance.step_by(step)
        rows.append(instance.read((*outputs, *HELD)))
    state.restore()
    if any(row[name] != rows[0][name] for row in rows for name in COUNTS):
        return []
    faults = [
        f"the derivative of {name} is {reported[name]!r} while it is held"
        for name in held
        if reported[name] and all(row[name] == rows[0][name] for row in rows)
    ]
    for name in outputs:
        derivative = reported[name]
        first, middle, last = (row[name] for row in rows)
        quotient = (4.0 * (middle - first) - (last - first)) / (2.0 * step)
        natural = ROUNDED / step if name == SLOW else SMALL * frequency
        scale = 0.0 if name == SLOW else frequency * abs(last)
        size = max(abs(quotient), abs(middle - first) / step, scale, natural * peaks[name])
        if derivative is None and name in OF_STATE:
            faults.append(f"the derivative of {name} is refused, though derivatives are offered")
        elif derivative is not None and not abs(derivative - quotient) <= ALLOWED * size:
            faults.append(f"the derivative of {name} is {derivative!r}, it grows by {quotient!r}")
    return faults


def read_derivatives(instance: Instance) -> None:
    """Read the derivatives of outputs, where there are any."""
    if isinstance(instance.slave, FMU2Slave):
        for name in OUTPUTS:
            _derivative(instance.slave, instance.fmu.reference(name))


def _derivative(slave: FMU2Slave, reference: int) -> float | None:
    """Return the first derivative of an output, None where the FMU has none."""
    value, order = c_double(), c_int(1)
    status = slave.dll.fmi2GetRealOutputDerivatives(
        slave.component, byref(fmi2ValueReference(reference)), 1, byref(order), byref(value)
    )
    return value.value if status == fmi2OK else None


RESOLUTION = 1e-9
"""Share of the time (s) up to which two times are the same."""


def status_faults(instance: Instance, *, refused: bool = False) -> Iterator[str]:
    """Yield what is wrong with the answers to status calls after a good step, or a `refused` one.

    An FMU need not answer them, and FMI 3.0 does not have them.
    """
    after = "a refused" if refused else "a good"
    slave = instance.slave
    if isinstance(slave, Fmi3Slave):
        return
    dll, component = slave.dll, slave.component
    reached, ended, status = c_double(), c_int(), c_int()
    if dll.fmi2GetRealStatus(component, fmi2LastSuccessfulTime, byref(reached)) == fmi2OK:
        apart = abs(reached.value - instance.time)
        if not apart <= RESOLUTION * max(1.0, abs(instance.time)):
            yield (
                f"the last successful time is {reached.value!r} s after {after} step, must be "
                f"{instance.time!r} s"
            )
    asked = dll.fmi2GetBooleanStatus(component, fmi2Terminated, byref(ended))
    if asked == fmi2OK and ended.value:
        yield f"the FMU wants to end the run after {after} step"
    answered = dll.fmi2GetStatus(component, fmi2DoStepStatus, byref(status)) == fmi2OK
    if answered and not refused and status.value > fmi2Warning:
        yield f"fmi2GetStatus gives {status.value} after a good step"
