"""Devices without a meaning, which an FMU must refuse before or in a run, and the same with one."""

from collections.abc import Iterator, Mapping
from contextlib import suppress
from functools import partial
from math import isfinite, sqrt

from fmpy.fmi1 import FMICallException

from slider_resonator.checks.conduct.findings import is_refused, outputs_after
from slider_resonator.checks.conduct.refusals import Trial
from slider_resonator.checks.fmu_side import FmuSide
from slider_resonator.device.interface import VARIABLES
from slider_resonator.fmu.instance import Instance

Values = Mapping[str, float]
"""Parameters and inputs by name."""

STEP = 1e-3
"""Size of a step, s."""


MEANINGLESS: Mapping[str, tuple[Values, Values]] = {
    "LuGre friction without friction": ({"friction_law": 1.0}, {"friction_coefficient": 0.0}),
    "the steady force of an undamped resonator at resonance": (
        {"fidelity": 1.0, "damping_ratio": 0.0, "resonator_frequency": 3500.0 / sqrt(1.1)},
        {"drive_frequency": 3500.0},
    ),
    "a drive beyond floating point numbers": ({"fidelity": 1.0}, {"base_amplitude": 1e308}),
}
"""Devices that must be refused, each with one value that can be set in a run: its cause."""
EXTREMES: tuple[Values, ...] = (
    {"fidelity": 1.0, "friction_law": 1.0, "initial_resonator_velocity": 1e308},
    {"fidelity": 1.0, "normal_amplitude": 1e300, "frequency_ratio": 1e200},
    {
        "fidelity": 1.0,
        "drive_frequency": 3.5,
        "resonator_frequency": 9.0,
        "initial_position": 1.7e308,
        "initial_velocity": 1e308,
    },
)
"""Devices at the ends of floating point numbers: refused, or of finite outputs."""


def device_faults(fmu: FmuSide) -> Iterator[str]:
    """Start each device, and turn a good one into it in a run; both must be refused by name.

    Extreme devices may be refused, but what is accepted has finite outputs.
    """
    instance = fmu.instance
    for what, (device, cause) in MEANINGLESS.items():
        trial = Trial(instance)
        start = partial(_start, instance, {**device, **cause})
        trial.refuses(what, start, (*device, *cause))
        yield from trial.faults or _in_a_run(instance, what, device, cause)
    for device in EXTREMES:
        values = ", ".join(f"{name} = {value:g}" for name, value in device.items())
        instance.set_up()
        with suppress(FMICallException):
            instance.set(device)
            instance.call("fmi2EnterInitializationMode")
            instance.begin()
            yield from _infinite(instance, values)
            instance.step_by(0.2)  # which takes the last of them beyond
            yield from _infinite(instance, values)
            if is_refused(instance.read, ["position", "velocity"]):
                yield f"a step is accepted but its motion cannot be read: {values}"


def _start(instance: Instance, device: Values) -> None:
    instance.initialise(device)
    instance.begin()
    instance.step_by(STEP)


def _infinite(instance: Instance, values: str) -> Iterator[str]:
    """Yield the outputs that are not finite; they may be refused."""
    for name in instance.fmu.outputs:
        with suppress(FMICallException):
            value = instance.value(name)
            if not isfinite(value):
                yield f"{name} is {value!r} with {values}"


def _in_a_run(instance: Instance, what: str, device: Values, cause: Values) -> list[str]:
    """Turn a good device into the bad one; the run must then go on as if nothing was tried."""
    good = {name: VARIABLES[name].start or 0.0 for name in cause}
    if good == cause:  # a device may be that near to resonance
        good = {name: (1.0 + 1e-8) * value for name, value in good.items()}
    trial = Trial(instance)
    trial.watch(*instance.fmu.outputs)
    _start(instance, {**device, **good})
    expected = outputs_after(instance, STEP)
    _start(instance, {**device, **good})
    trial.refuses(f"{what} in a run", partial(instance.set, cause), (*device, *cause))
    if not trial.faults and outputs_after(instance, STEP) != expected:
        trial.faults.append(f"a run goes on differently after {what} is refused in it")
    return trial.faults
