"""The vocabulary of scene files: every quantity with its unit, meaning and references, as data.

How a quantity is measured in an FMU is in `slider_resonator.checks.measuring`, what a reference
gives for it in `slider_resonator.checks.expecting`.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import partial
from typing import Literal

Kind = Literal["number", "word", "signal"]

MAX_TUBE = 0.25
"""Upper bound of a tube, in drive periods: at 0.5 it would contain a signal of opposite sign."""

RESOLVED = ("located_events", "bristle_state")
"""References with the fast motion, known at any time; `bristle_state` is for LuGre friction."""

REFERENCES: Mapping[str, str] = {
    "located_events": "The device of `fidelity` 1 or 2 with Coulomb friction, at `fidelity` 0 that "
    "of 2, by Taylor series between located events. Steady velocity and blocking force: by "
    "shooting, with either friction law.",
    "bristle_state": "The same with LuGre friction, the bristle as an integrated state.",
    "averaged": "Averaged theory of first order, with an error of the order of 1 / Omega: any "
    "frequency ratio, either friction law, with lift-off.",
    "closed_form": "Closed forms of the paper. Steady motion: constant inputs, `frequency_ratio` "
    "1, a closed contact, Coulomb friction. Ripple and beat: any ratio.",
}
"""Every reference, with what it is and when it applies."""


@dataclass(frozen=True)
class Quantity:
    """A number, word or signal that a scene can expect.

    `references` are the names of those that it can be compared with, `tube_references` those that
    can have a tube. An `exact` quantity, a count or a word, needs no tolerance. A signal
    `in_periods` is compared by its deviation in drive periods, any other as a share of its peak.
    One that `needs_constants` is for constant inputs and parameters.
    """

    kind: Kind
    unit: str
    meaning: str
    references: tuple[str, ...] = ()
    needs_run: bool = False
    exact: bool = False
    tube_references: tuple[str, ...] = ()
    in_periods: bool = False
    needs_constants: bool = False


_steady = partial(Quantity, "number", needs_constants=True)
_word = partial(Quantity, "word", "", exact=True, needs_constants=True)
_of_run = partial(Quantity, "number", needs_run=True)
_signal = partial(Quantity, "signal", needs_run=True)
_PREDICTING = ("located_events", "closed_form", "averaged")
_BY_ANY = (*RESOLVED, "averaged")
_output = partial(_signal, references=_BY_ANY, tube_references=RESOLVED)
"""An output of the FMU that is compared at each communication point."""

_FAULTS_OF_RUN: Mapping[str, str] = {
    "reset_differences": "outputs that differ after a reset from those of a new instance",
    "restored_differences": "outputs that differ after a state is restored, whatever was done "
    "meanwhile, and derivatives of outputs that differ from short steps",
    "transferred_differences": "outputs that differ in another instance with a serialised state",
    "beside_differences": "outputs that differ while an instance of another device steps in turn",
    "overwritten_differences": "outputs that differ where each value is set after another one",
    "separate_differences": "outputs that differ where each value is set by a call of its own",
    "reading_differences": "outputs that differ where everything is read between the calls",
    "rate_differences": "outputs that differ where derivatives of inputs are set in another order, "
    "or only at the corners of lines",
    "other_device_differences": "outputs that differ after runs of devices with another parameter",
    "refusal_faults": "values and calls that are not refused by name, without a trace in the run",
}
"""Counts of values that differ, or of calls that go wrong, in a run."""
_FAULTS: Mapping[str, str] = {
    "start_faults": "variables without their described start, or that do not keep what is set",
    "description_faults": "differences of the model description from the interface",
    "dependency_faults": "outputs on which a variable acts that is not among their dependencies",
    "device_faults": "devices without a meaning that are not refused by name",
    "experiment_faults": "sums of steps, tolerances and start times that change the motion",
    "host_faults": "wrong answers about the FMU itself: versions, instances that must not be made, "
    "disturb each other or stay in memory, logging, event mode, what it changes in its process",
    "state_faults": "states that are got again, damaged, outlive a process or a run or are "
    "freed, and wrong then or still in memory",
}
"""The same without a run."""

QUANTITIES: Mapping[str, Quantity] = {
    "steady_velocity": _steady(
        "m/s", "mean velocity of the steady motion, by shooting", _PREDICTING
    ),
    "steady_status": _word("outcome of the search for steady motion"),
    "steady_periods": _steady("1", "drive periods simulated for it", exact=True),
    "blocking_force": _steady(
        "N", "load under which the mean velocity is zero, by shooting", _PREDICTING
    ),
    "blocking_status": _word("outcome of the search for the blocking force"),
    "blocking_periods": _steady("1", "drive periods simulated for it", exact=True),
    "predicted_velocity": _steady("m/s", "the FMU's output steady_velocity", _PREDICTING),
    "predicted_blocking_force": _steady("N", "the FMU's output blocking_force", _PREDICTING),
    "predicted_velocity_in_run": _signal(
        "m/s", "the FMU's output steady_velocity over time", ("averaged",)
    ),
    "predicted_blocking_force_in_run": _signal(
        "N", "the FMU's output blocking_force over time", ("averaged",)
    ),
    "final_predicted_velocity": _of_run(
        "m/s",
        "the FMU's output steady_velocity at the end of the run",
        ("located_events", "averaged"),
    ),
    "final_predicted_blocking_force": _of_run(
        "N", "the FMU's output blocking_force at the end of the run", ("located_events", "averaged")
    ),
    "prediction_valid": _of_run(
        "1", "the FMU's output prediction_valid at the end of the run", ("averaged",), exact=True
    ),
    "position": _output("m", "slider position"),
    "velocity": _output("m/s", "slider velocity"),
    "resonator_displacement": _output("m", "relative displacement"),
    "resonator_velocity": _output("m/s", "relative velocity"),
    "normal_force": _output("N", "normal force of a face"),
    "friction_force": _output("N", "friction force of all faces"),
    "contact_mode": _signal("1", "share of points in another contact mode", _BY_ANY, exact=True),
    "slow_displacement": _signal(
        "m", "position averaged over a drive period", ("located_events", "averaged")
    ),
    "mean_velocity": _of_run(
        "m/s", "mean velocity over the last whole drive period of the run", _BY_ANY
    ),
    "mean_velocity_in_run": _signal(
        "m/s",
        "mean velocity over the last whole drive period before each point, first since the start",
        _BY_ANY,
    ),
    "last_step_velocity": _of_run("m/s", "distance of the last step of the run over its duration"),
    "slow_motion_error": _of_run("m/s", "the FMU's output slow_motion_error at the end of the run"),
    "error_over_estimate": _of_run(
        "1",
        "largest error of the mean velocity over a drive period against the FMU's own fidelity 2, "
        "over the slow_motion_error at the same point",
    ),
    "stick_fraction": _of_run(
        "1", "share of the last whole drive period of the run spent sticking", RESOLVED
    ),
    "stick_fraction_in_run": _signal(
        "1",
        "share of the last whole drive period before each point spent sticking, first since the "
        "start",
        _BY_ANY,
    ),
    "friction_power": _of_run(
        "W",
        "friction force times velocity, mean over the last whole drive period of the run",
        RESOLVED,
    ),
    "reversals": _of_run("1", "reversals of sliding during the run", RESOLVED, exact=True),
    "reversals_in_run": _signal(
        "1", "share of points with another number of reversals so far", _BY_ANY, exact=True
    ),
    "event_times": _signal(
        "drive periods",
        "time of the last event before each point of the run",
        _BY_ANY,
        in_periods=True,
    ),
    "last_event_time": _of_run("s", "time of the last event of the run", RESOLVED),
    "ripple_amplitude": _of_run(
        "m", "amplitude of the fast oscillation of the position", ("closed_form",)
    ),
    "ripple_frequency": _of_run("Hz", "dominant frequency of the velocity", ("closed_form",)),
    "beat_frequency": _of_run(
        "Hz",
        "dominant frequency of the mean velocity in the later half of the run",
        ("closed_form",),
    ),
    **{name: _of_run("1", meaning, exact=True) for name, meaning in _FAULTS_OF_RUN.items()},
    **{name: Quantity("number", "1", meaning, exact=True) for name, meaning in _FAULTS.items()},
}
"""Every quantity by the name that scene files use."""
