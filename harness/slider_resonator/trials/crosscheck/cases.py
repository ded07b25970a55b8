"""The runs that importing tools are to repeat: an FMU, its inputs, its outputs.

Start values cannot be given in a cross-check, so each case is the device of table 1 under inputs of
its own. It lasts few drive periods: importers compare within a tube of a fiftieth of the run, which
must stay shorter than a drive period to see anything.
"""

from __future__ import annotations

from dataclasses import dataclass

from slider_resonator.device.schedule import Schedule, Signal, constant, schedule, steps

STOP_TIME = 0.03
"""Seconds: 17 drive periods of table 1."""
STEP_SIZE = 1e-4
"""Seconds: 18 steps in a drive period; inputs change at multiples of it only."""

OUTPUTS = (
    *("position", "velocity", "mean_velocity", "resonator_displacement", "resonator_velocity"),
    *("normal_force", "friction_force", "reversals", "steady_velocity", "blocking_force"),
)
"""Ten outputs, as many as the rules recommend at most."""


@dataclass(frozen=True)
class Case:
    """A run that importers repeat; `name` is that of its folder and files."""

    name: str
    title: str
    schedule: Schedule


def _case(name: str, title: str, **signals: Signal) -> Case:
    return Case(name, title, schedule(STOP_TIME, STEP_SIZE, **signals))


CASES = (
    _case("SliderStart", "From rest, with constant inputs", phase=constant(0.4)),
    _case(
        "SliderLoad",
        "The load steps up, helps, and drags the slider back",
        load=steps([(0.0, 0.0), (0.006, 0.06), (0.014, -0.1), (0.022, 40.0)]),
    ),
    _case(
        "SliderPhase",
        "The phase turns, then the frequency of the normal load trebles",
        phase=steps([(0.0, 0.0), (0.008, 2.4), (0.016, -0.8)]),
        frequency_ratio=steps([(0.0, 1.0), (0.02, 3.0)]),
    ),
)
"""Three, the least that the rules ask for."""
