"""The component between numerics and FMI: values by name, lifecycle, steps, outputs."""

import cmath
from collections.abc import Mapping
from contextlib import suppress
from dataclasses import asdict, astuple, replace
from math import inf, isfinite, log10, nan, remainder, tau, ulp
from typing import Any

from . import refusal_texts as texts
from .averaged import Averaged
from .constants import MAX_TURNS, PYTHON_SLOWDOWN, STOP_TIME_SLACK, TIME_SLACK
from .device import Device, System
from .leap import Leaping
from .moment import Moment
from .outputs import OUTPUTS, Motion
from .parameters import Inputs
from .prediction import theory_range
from .resolved import Resolved
from .snapshot import FORMAT, Lifecycle, State, from_plain
from .values import BY_NAME, SETTABLE, Refusal, checked


class Component:
    """A slider-resonator: set, step and read it by the names of the interface.

    A method that raises Refusal leaves the component as it was.
    """

    def __init__(self) -> None:
        self._state = State()
        self._prepared: Motion | None = None

    def setup_experiment(
        self, start_time: float, stop_time: float | None = None, tolerance: float | None = None
    ) -> None:
        """Set start and stop time [s]; a stop time of None is open.

        The tolerance is checked and not used: that of LuGre friction is a parameter.
        """
        state = self._required("setupExperiment", Lifecycle.INSTANTIATED)
        if not isfinite(start_time):
            raise Refusal(texts.BAD_START_TIME, start_time=start_time)
        stop = inf if stop_time is None else stop_time
        if not stop >= start_time:
            raise Refusal(texts.BAD_STOP_TIME, stop_time=stop, start_time=start_time)
        if tolerance is not None and not (isfinite(tolerance) and tolerance > 0.0):
            raise Refusal(texts.BAD_TOLERANCE, tolerance=tolerance)
        state.time, state.stop_time = float(start_time), float(stop)

    def enter_initialization(self) -> None:
        """Begin initialization mode."""
        state = self._required("enterInitializationMode", Lifecycle.INSTANTIATED)
        state.lifecycle = Lifecycle.INITIALIZATION

    def exit_initialization(self) -> None:
        """Fix the parameters and the first moment."""
        state = self._required("exitInitializationMode", Lifecycle.INITIALIZATION)
        state.moment = self._present()
        state.lifecycle = Lifecycle.STEP_COMPLETE

    def terminate(self) -> None:
        """End the simulation; outputs stay readable."""
        self._required("terminate", Lifecycle.STEP_COMPLETE).lifecycle = Lifecycle.TERMINATED

    def set(self, new: Mapping[str, object]) -> None:
        """Set inputs and parameters by name: all of them or, if one is refused, none."""
        state = self._state
        if state.lifecycle == Lifecycle.TERMINATED:
            self._required(f"setting {', '.join(new)}", Lifecycle.STEP_COMPLETE)
        running = state.lifecycle == Lifecycle.STEP_COMPLETE
        values = dict(state.values)
        for name, value in new.items():
            variable = BY_NAME[name]
            if variable.causality == "output":
                raise Refusal(texts.OUTPUT_SET, name=name, value=repr(value))
            if variable.variability == "fixed" and running:
                raise Refusal(texts.FIXED_WHILE_RUNNING, name=name, value=repr(value))
            values[name] = checked(variable, value)
        if values != state.values:
            self._prepared = _prepare(values) if running else None
            state.values = values

    def get(self, *names: str) -> list[float]:
        """Return values of any variables; outputs from initialization mode on."""
        values = self._state.values
        return [values[name] if name in values else self._output(name) for name in names]

    def step(self, time: float, step_size: float) -> bool:
        """Advance from the present `time` [s] by `step_size` > 0 [s], inputs held; return True."""
        state = self._required("doStep", Lifecycle.STEP_COMPLETE)
        if not (isfinite(step_size) and step_size > 0.0):
            raise Refusal(texts.BAD_STEP_SIZE, step_size=step_size)
        # Hosts sum up time themselves, so theirs may differ from this one by rounding.
        slack = TIME_SLACK * step_size + 4.0 * ulp(state.time)
        if not abs(time - state.time) <= slack:
            raise Refusal(texts.BAD_STEP_START, time=time, now=state.time)
        end = time + step_size
        if end > state.stop_time + slack + STOP_TIME_SLACK * abs(state.stop_time):
            stop = state.stop_time
            raise Refusal(texts.STEP_BEYOND_STOP, step_size=step_size, stop_time=stop)
        frequency, max_turns = self._motion.system.fastest, MAX_TURNS // PYTHON_SLOWDOWN
        if state.values["fidelity"] > 0 and step_size * frequency > tau * max_turns:
            limits = {"frequency": frequency, "max_turns": max_turns}
            raise Refusal(texts.TOO_MANY_TURNS, step_size=step_size, **limits)
        with suppress(ArithmeticError, ValueError):
            now = self._motion.advance(self._present(), step_size)
            numbers = now.position, now.velocity, now.displacement, now.rate, now.psi, now.theta
            if all(map(isfinite, numbers)):
                now.time = state.time = end
                state.moment = now
                return True
        raise Refusal(texts.INFINITE_MOTION, step_size=step_size)

    def snapshot(self) -> dict[str, Any]:
        """Return the complete state, of plain numbers and names."""
        return {"format": FORMAT, **asdict(self._state)}

    def restore(self, plain: Mapping[str, Any]) -> None:
        """Restore a snapshot, of this or another instance. Raises Refusal for anything else."""
        state = from_plain(plain)
        self._prepared = None if state.moment is None else _prepare(state.values)
        self._state = state

    def _required(self, call: str, required: Lifecycle) -> State:
        """Return the state. Raises Refusal for a call in any state of life but `required`."""
        state = self._state.lifecycle
        if state != required:
            raise Refusal(texts.WRONG_STATE, call=call, state=state, required=required)
        return self._state

    @property
    def _motion(self) -> Motion:
        self._prepared = self._prepared or _prepare(self._state.values)
        return self._prepared

    def _present(self) -> Moment:
        now = self._state.moment
        if now is None:
            now = self._motion.start()
            now.time = now.last_event_time = self._state.time
        return now

    def _output(self, name: str) -> float:
        """Return an output. Raises Refusal for one that is not a finite number."""
        if self._state.lifecycle == Lifecycle.INSTANTIATED:
            self._required(f"reading {name}", Lifecycle.INITIALIZATION)
        motion, now, value = self._motion, self._present(), nan
        with suppress(ArithmeticError, ValueError):
            value = OUTPUTS[name](motion, now)
        if not isfinite(value):
            raise Refusal(texts.INFINITE_OUTPUT, name=name, value=value)
        return value


def _prepare(values: Mapping[str, Any]) -> Motion:
    """The motion under all values. Raises Refusal for values under which there is none."""
    inputs = Inputs(**{v.name: values[v.name] for v in SETTABLE if v.causality == "input"})
    device = Device(**{v.name: values[v.name] for v in SETTABLE if v.causality == "parameter"})
    device = _driven(device, inputs)
    with suppress(ArithmeticError):
        motion = motion_of(device, replace(inputs, phase=remainder(inputs.phase, tau)))
        system = motion.system
        numbers = [*vars(system).values(), *astuple(system.slip), *astuple(system.stick)]
        numbers = [x for x in numbers if isinstance(x, (float, complex))]
        finite = all(map(cmath.isfinite, [*numbers, *theory_range(device)]))
        if finite and system.mass_fraction < 1.0:  # beside it, the slider's mass counts
            return motion
    # Together the values leave the range of floating point numbers. The text names the one that is
    # the most decades away from its start value.
    furthest = max(
        (v for v in SETTABLE if values[v.name]),
        key=lambda v: abs(log10(abs(values[v.name])) - log10(v.start or 1.0)),
    )
    shown = {"value": repr(values[furthest.name]), "start": repr(furthest.start)}
    raise Refusal(texts.EXTREME_VALUE, name=furthest.name, **shown)


def _driven(device: Device, inputs: Inputs) -> Device:
    """The device with the deviations of its drive. Raises Refusal for too slow a drive."""
    deviation, amplitude = inputs.frequency_deviation, 1.0 + inputs.amplitude_deviation
    variable, w = BY_NAME["drive_frequency"], device.drive_frequency * (1.0 + deviation)
    if variable.minimum is not None and w < variable.minimum:
        shown = {"drive_frequency": w, "requirement": variable.requirement}
        raise Refusal(texts.DRIVE_TOO_SLOW, frequency_deviation=deviation, **shown)
    base, direct = device.base_amplitude * amplitude, device.tangential_force * amplitude
    return replace(device, base_amplitude=base, tangential_force=direct, drive_frequency=w)


def motion_of(device: Device, inputs: Inputs) -> Motion:
    """The motion of a device under held inputs.

    Raises Refusal for LuGre friction without friction, where (8) divides by mu, and where undamped
    resonance leaves no steady vibration that fidelity 1 or averages of first order need.
    """
    if device.friction_law == 1 and device.friction_coefficient == 0.0:
        raise Refusal(texts.LUGRE_WITHOUT_FRICTION, friction_coefficient=0.0)
    if device.fidelity == 0 and device.averaging_order == 2:
        return Leaping(System(replace(device, fidelity=2), inputs))
    system = System(device, inputs)
    return Resolved(system) if device.fidelity > 0 else Averaged(system)
