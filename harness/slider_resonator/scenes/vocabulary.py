"""The vocabulary of scene files: every quantity with its unit, meaning and references, as data.

How a quantity is measured in an FMU is in `slider_resonator.checks.measuring`, what a reference
gives for it in `slider_resonator.checks.expecting`.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
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
    One that `needs_constants` is for constant inputs and parameters, one that `needs_beside` for a
    scene with a second instance.
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
    needs_beside: bool = False

    @property
    def relative_to_peak(self) -> bool:
        """Whether a deviation is a share of the reference's peak."""
        return self.kind == "signal" and not self.in_periods


def _number(unit: str, meaning: str, *references: str, exact: bool = False) -> Quantity:
    """Return a quantity of the steady motion, which needs no run."""
    return Quantity("number", unit, meaning, references, exact=exact, needs_constants=True)


def _word(meaning: str) -> Quantity:
    return Quantity("word", "", meaning, exact=True, needs_constants=True)


def _count(meaning: str, *, needs_run: bool = True, needs_beside: bool = False) -> Quantity:
    """Return a count of faults: of values that differ, or of calls that go wrong."""
    return Quantity(
        "number", "1", meaning, needs_run=needs_run, exact=True, needs_beside=needs_beside
    )


def _number_of_run(unit: str, meaning: str, *references: str, exact: bool = False) -> Quantity:
    return Quantity("number", unit, meaning, references, needs_run=True, exact=exact)


def _signal(unit: str, meaning: str, *references: str, exact: bool = False) -> Quantity:
    """Return a signal without tubes."""
    return Quantity("signal", unit, meaning, references, needs_run=True, exact=exact)


def _output(unit: str, meaning: str, *averaged: str) -> Quantity:
    """Return an output of the FMU that is compared at each communication point."""
    references = (*RESOLVED, *averaged)
    return Quantity("signal", unit, meaning, references, needs_run=True, tube_references=RESOLVED)


def _prediction(unit: str, meaning: str) -> Quantity:
    return Quantity("signal", unit, meaning, ("averaged",), needs_run=True)


_PREDICTING = ("located_events", "closed_form", "averaged")

QUANTITIES: Mapping[str, Quantity] = {
    "steady_velocity": _number(
        "m/s",
        "mean velocity of the steady motion, by shooting",
        *("located_events", "closed_form", "averaged"),
    ),
    "steady_status": _word("outcome of the search for steady motion"),
    "steady_periods": _number("1", "drive periods simulated for it", exact=True),
    "blocking_force": _number(
        "N",
        "load under which the mean velocity is zero, by shooting",
        *("located_events", "closed_form", "averaged"),
    ),
    "blocking_status": _word("outcome of the search for the blocking force"),
    "blocking_periods": _number("1", "drive periods simulated for it", exact=True),
    "predicted_velocity": _number("m/s", "the FMU's output steady_velocity", *_PREDICTING),
    "predicted_blocking_force": _number("N", "the FMU's output blocking_force", *_PREDICTING),
    "predicted_velocity_in_run": _prediction("m/s", "the FMU's output steady_velocity over time"),
    "predicted_blocking_force_in_run": _prediction(
        "N", "the FMU's output blocking_force over time"
    ),
    "final_predicted_velocity": _number_of_run(
        "m/s",
        "the FMU's output steady_velocity at the end of the run",
        *("located_events", "averaged"),
    ),
    "final_predicted_blocking_force": _number_of_run(
        "N",
        "the FMU's output blocking_force at the end of the run",
        *("located_events", "averaged"),
    ),
    "prediction_valid": _number_of_run(
        "1", "the FMU's output prediction_valid at the end of the run", "averaged", exact=True
    ),
    "position": _output("m", "slider position", "averaged"),
    "velocity": _output("m/s", "slider velocity", "averaged"),
    "resonator_displacement": _output("m", "relative displacement", "averaged"),
    "resonator_velocity": _output("m/s", "relative velocity", "averaged"),
    "normal_force": _output("N", "normal force of a face", "averaged"),
    "friction_force": _output("N", "friction force of all faces", "averaged"),
    "contact_mode": Quantity(
        "signal",
        "1",
        "share of points in another contact mode",
        (*RESOLVED, "averaged"),
        needs_run=True,
        exact=True,
    ),
    "slow_displacement": Quantity(
        "signal",
        "m",
        "position averaged over a drive period",
        ("located_events", "averaged"),
        needs_run=True,
    ),
    "mean_velocity": _number_of_run(
        "m/s",
        "mean velocity over the last whole drive period of the run",
        *(*RESOLVED, "averaged"),
    ),
    "mean_velocity_in_run": _signal(
        "m/s",
        "mean velocity over the last whole drive period before each point, first since the start",
        *(*RESOLVED, "averaged"),
    ),
    "last_step_velocity": _number_of_run(
        "m/s", "distance of the last step of the run over its duration"
    ),
    "slow_motion_error": _number_of_run(
        "m/s", "the FMU's output slow_motion_error at the end of the run"
    ),
    "error_over_estimate": _number_of_run(
        "1",
        "largest error of the mean velocity over a drive period against the FMU's own fidelity 2, "
        "over the slow_motion_error at the same point",
    ),
    "stick_fraction": _number_of_run(
        "1", "share of the last whole drive period of the run spent sticking", *RESOLVED
    ),
    "stick_fraction_in_run": _signal(
        "1",
        "share of the last whole drive period before each point spent sticking, first since the "
        "start",
        *(*RESOLVED, "averaged"),
    ),
    "friction_power": _number_of_run(
        "W",
        "friction force times velocity, mean over the last whole drive period of the run",
        *RESOLVED,
    ),
    "reversals": _number_of_run("1", "reversals of sliding during the run", *RESOLVED, exact=True),
    "reversals_in_run": _signal(
        "1",
        "share of points with another number of reversals so far",
        *(*RESOLVED, "averaged"),
        exact=True,
    ),
    "event_times": Quantity(
        "signal",
        "drive periods",
        "time of the last event before each point of the run",
        (*RESOLVED, "averaged"),
        needs_run=True,
        in_periods=True,
    ),
    "last_event_time": _number_of_run("s", "time of the last event of the run", *RESOLVED),
    "ripple_amplitude": _number_of_run(
        "m", "amplitude of the fast oscillation of the position", "closed_form"
    ),
    "ripple_frequency": _number_of_run("Hz", "dominant frequency of the velocity", "closed_form"),
    "beat_frequency": _number_of_run(
        "Hz",
        "dominant frequency of the mean velocity in the later half of the run",
        "closed_form",
    ),
    "reset_differences": _count(
        "outputs of the run that differ between a new instance and one that is reset"
    ),
    "restored_differences": _count(
        "outputs of the run that differ after a state is restored, whatever was done meanwhile, "
        "and derivatives of outputs that differ from short steps"
    ),
    "transferred_differences": _count(
        "outputs of the run that differ in another instance that takes over a serialised state"
    ),
    "beside_differences": _count(
        "outputs that differ while two instances step in turn, from those of each alone",
        needs_beside=True,
    ),
    "overwritten_differences": _count(
        "outputs of the run that differ where other and refused values are set before each value"
    ),
    "separate_differences": _count(
        "outputs of the run that differ where each value that changes is set by a call of its own"
    ),
    "reading_differences": _count(
        "outputs of the run that differ where everything is read again between the calls"
    ),
    "rate_differences": _count(
        "outputs of the run that differ where derivatives of inputs are set in another order, or "
        "only at the corners of lines"
    ),
    "other_device_differences": _count(
        "outputs of the run that differ after runs of devices that differ in one parameter"
    ),
    "refusal_faults": _count(
        "values and calls that must be refused, by name and without a trace in the run, and are not"
    ),
    "start_faults": _count(
        "variables without their described start, or that do not keep what is set", needs_run=False
    ),
    "description_faults": _count(
        "differences of the model description from the interface", needs_run=False
    ),
    "dependency_faults": _count(
        "outputs on which a variable acts that is not among their dependencies", needs_run=False
    ),
    "device_faults": _count(
        "devices without a meaning that are not refused by name, at the start and in a run",
        needs_run=False,
    ),
    "experiment_faults": _count(
        "experiments with sums of steps and tolerances that are refused or change the motion",
        needs_run=False,
    ),
    "host_faults": _count(
        "wrong answers about the FMU itself: versions, instances that must not be made or stay in "
        "memory, logging, event mode",
        needs_run=False,
    ),
    "state_faults": _count(
        "states that are got again, damaged or freed, and wrong then or still in memory",
        needs_run=False,
    ),
}
"""Every quantity by the name that scene files use."""
