"""Texts of the refusals that both twins give: what is refused, its value, what it must be.

The C functions in refusal_texts.h are generated from these. So each returns one f-string that shows
each of its arguments once: `float` and `object` with !r, `str` and `int` without.
"""

from __future__ import annotations


def out_of_bounds(name: str, value: object, requirement: str) -> str:
    """Refuse a value that the table of variables excludes."""
    return f"{name} = {value!r} refused: must be {requirement}"


def output_set(name: str, value: object) -> str:
    """Refuse an output that the host sets."""
    return f"{name} = {value!r} refused: it is an output and cannot be set"


def fixed_while_running(name: str, value: object) -> str:
    """Refuse a fixed parameter that the host sets too late."""
    return f"{name} = {value!r} refused: it is fixed and can be set only before initialization ends"


def unknown_reference(reference: int, first: int, last: int) -> str:
    """Refuse a value reference that no variable has."""
    return f"valueReference = {reference} refused: must be from {first} to {last}"


def wrong_type(name: str, reference: int, own: str, requested: str) -> str:
    """Refuse a variable read or set as another type than its own."""
    return f"{name} (valueReference = {reference}) refused: its type is {own}, not {requested}"


def wrong_state(call: str, state: str, required: str) -> str:
    """Refuse a call that the state of the instance excludes."""
    return f"{call} refused in state '{state}': the state must be '{required}'"


def bad_start_time(start_time: float) -> str:
    """Refuse a start time that is not finite."""
    return f"startTime = {start_time!r} refused: must be a finite number"


def bad_stop_time(stop_time: float, start_time: float) -> str:
    """Refuse a stop time before the start time."""
    return f"stopTime = {stop_time!r} refused: must be at least startTime = {start_time!r}"


def bad_tolerance(tolerance: float) -> str:
    """Refuse a tolerance of an experiment that is not above 0."""
    return f"tolerance = {tolerance!r} refused: must be a finite number above 0"


def bad_step_size(step_size: float) -> str:
    """Refuse a step that is not finite or does not advance."""
    return f"doStep: communicationStepSize = {step_size!r} refused: must be a finite number above 0"


def bad_step_start(time: float, now: float) -> str:
    """Refuse a step that does not continue from the present time."""
    return f"doStep: currentCommunicationPoint = {time!r} refused: must be the present time {now!r}"


def step_beyond_stop(step_size: float, stop_time: float) -> str:
    """Refuse a step beyond the stop time."""
    return (
        f"doStep: communicationStepSize = {step_size!r} refused: the step must end by stopTime = "
        f"{stop_time!r}"
    )


def too_many_turns(step_size: float, frequency: float, max_turns: int) -> str:
    """Refuse a step over more oscillations than its work is bounded by."""
    return (
        f"doStep: communicationStepSize = {step_size!r} refused: the fastest oscillation has "
        f"{frequency!r} rad/s; the step must be at most {max_turns} turns of it"
    )


def too_much_work(step_size: float, max_count: int, what: str, exponent: int) -> str:
    """Refuse a step that takes too much work, where one of 10^exponent s takes less."""
    return (
        f"doStep: communicationStepSize = {step_size!r} refused: it takes more work than "
        f"{max_count} {what}; must be at most 1e{exponent} s"
    )


def too_much_work_at_once(step_size: float, max_count: int, what: str) -> str:
    """Refuse a step that takes too much work however short it is."""
    return (
        f"doStep: communicationStepSize = {step_size!r} refused: it takes more work than "
        f"{max_count} {what}, however short it is; the forces must be changed"
    )


def infinite_motion(step_size: float) -> str:
    """Refuse a step in which the motion leaves the range of floating point numbers."""
    return (
        f"doStep: communicationStepSize = {step_size!r} refused: the motion leaves the range of "
        "floating point numbers; forces, frequencies or steps must be smaller"
    )


def extreme_value(name: str, value: object, start: object) -> str:
    """Refuse a value that with the others leaves the range of floating point numbers."""
    return (
        f"{name} = {value!r} refused: together with the other values it leaves the range of "
        f"floating point numbers; must be nearer to {start!r}"
    )


def infinite_output(name: str, value: float) -> str:
    """Refuse to return an output that leaves the range of floating point numbers."""
    return (
        f"{name} = {value!r} refused: the output leaves the range of floating point numbers; "
        "values, inputs and state must be smaller"
    )


def unbounded_resonance(damping_ratio: float, drive_frequency: float) -> str:
    """Refuse an undamped resonator where its steady motion is unbounded."""
    return (
        f"damping_ratio = {damping_ratio!r} refused: without damping the steady force of the "
        f"resonator is unbounded at drive_frequency = {drive_frequency!r}; there it must be above 0"
    )


def drive_too_slow(frequency_deviation: float, drive_frequency: float, requirement: str) -> str:
    """Refuse a deviation that makes the drive slower than a device may be."""
    return (
        f"frequency_deviation = {frequency_deviation!r} refused: it makes drive_frequency "
        f"{drive_frequency!r}; that must be {requirement}"
    )


def lugre_without_friction(friction_coefficient: float) -> str:
    """Refuse a friction coefficient of 0 with LuGre friction, where (8) has no meaning."""
    return (
        f"friction_coefficient = {friction_coefficient!r} refused: with LuGre friction it must be "
        "a finite number above 0"
    )


def infinite_in_state(name: str, value: object) -> str:
    """Refuse a number in an FMU state that is not finite."""
    return f"FMU state refused: {name} = {value!r}; must be a finite number"


def out_of_range_in_state(name: str, value: object, minimum: int, maximum: int) -> str:
    """Refuse an integer in an FMU state that is not in its range, or a fraction."""
    return f"FMU state refused: {name} = {value!r}; must be an integer from {minimum} to {maximum}"


def phase_in_state(name: str, value: object) -> str:
    """Refuse a phase in an FMU state that is not within a turn."""
    return f"FMU state refused: {name} = {value!r}; must be a phase from 0 to 2 pi"


def state_without_motion() -> str:
    """Refuse an FMU state after initialization that holds no motion."""
    return "FMU state refused: it holds no motion; must be one after initialization"
