"""First derivatives of outputs, where an FMU offers them, against two short steps."""

from collections.abc import Iterator, Mapping
from math import tau

from fmpy.fmi2 import (
    FMU2Slave,
    fmi2DoStepStatus,
    fmi2LastSuccessfulTime,
    fmi2Terminated,
    fmi2Warning,
)

from slider_resonator.checks.conduct.findings import answer_of
from slider_resonator.fmu.instance import Instance, SavedState

OF_STATE = ("position", "velocity", "resonator_displacement", "resonator_velocity")
"""Outputs of which an FMU that offers derivatives must have one."""
OUTPUTS = (*OF_STATE, "normal_force", "friction_force")
"""Outputs that are smooth between events."""
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


def derivative_faults(
    instance: Instance, state: SavedState, peaks: Mapping[str, float]
) -> Iterator[str]:
    """Compare derivatives of outputs with quotients over short steps; the state is restored.

    Nothing is compared over an event. `peaks` are those of the outputs in a run.
    """
    offered = instance.fmu.offers.maxOutputDerivativeOrder or 0
    if not isinstance(instance.slave, FMU2Slave) or offered < 1:
        return
    frequency = instance.value("drive_frequency")  # rad/s
    step = SHORT * tau / frequency
    first_order = not instance.fmu.has_orders or instance.value("averaging_order") == 1.0
    averaged = first_order and instance.value("fidelity") == 0.0
    outputs = (*OUTPUTS, SLOW) if averaged else OUTPUTS
    held = [name for name in HELD if name not in outputs]
    reported = {name: _derivative(instance, name) for name in (*outputs, *held)}
    rows = [instance.read((*outputs, *HELD))]
    for _ in range(2):
        instance.step_by(step)
        rows.append(instance.read((*outputs, *HELD)))
    state.restore()
    if any(row[name] != rows[0][name] for row in rows for name in COUNTS):
        return
    for name in held:
        if reported[name] and all(row[name] == rows[0][name] for row in rows):
            yield f"the derivative of {name} is {reported[name]!r} while it is held"
    for name in outputs:
        derivative = reported[name]
        first, middle, last = (row[name] for row in rows)
        quotient = (4.0 * (middle - first) - (last - first)) / (2.0 * step)
        # A slow output is rounded over a step; the scale of others is a radian of the drive.
        scale, natural = (0.0, 1e-12 / step) if name == SLOW else (frequency, SMALL * frequency)
        scales = scale * abs(last), natural * peaks[name]
        size = max(abs(quotient), abs(middle - first) / step, *scales)
        if derivative is None and name in OF_STATE:
            yield f"the derivative of {name} is refused, though derivatives are offered"
        elif derivative is not None and not abs(derivative - quotient) <= ALLOWED * size:
            yield f"the derivative of {name} is {derivative!r}, it grows by {quotient!r}"


def read_derivatives(instance: Instance) -> None:
    """Read the derivatives of outputs, where there are any."""
    if isinstance(instance.slave, FMU2Slave):
        for name in OUTPUTS:
            _derivative(instance, name)


def _derivative(instance: Instance, name: str) -> float | None:
    """Return the first derivative of an output, None where the FMU has none."""
    reference = instance.fmu.reference(name)
    found = answer_of(instance.slave.getRealOutputDerivatives, [reference], [1])
    del instance.messages[:]  # a refusal is no cause of what fails later
    return float(found[0]) if found else None


def status_faults(instance: Instance, *, refused: bool = False) -> Iterator[str]:
    """Yield what is wrong with the answers to status calls after a good step, or a `refused` one.

    An FMU need not answer them, and FMI 3.0 does not have them.
    """
    after, slave = "a refused" if refused else "a good", instance.slave
    if not isinstance(slave, FMU2Slave):
        return
    reached = answer_of(slave.getRealStatus, fmi2LastSuccessfulTime)
    now = instance.time
    if reached is not None and not abs(reached - now) <= 1e-9 * max(1.0, abs(now)):
        yield f"the last successful time is {reached!r} s after {after} step, must be {now!r} s"
    if answer_of(slave.getBooleanStatus, fmi2Terminated):
        yield f"the FMU wants to end the run after {after} step"
    status = answer_of(slave.getStatus, fmi2DoStepStatus)
    if status is not None and not refused and status > fmi2Warning:
        yield f"fmi2GetStatus gives {status} after a good step"
