"""The one table of the controller's FMU variables: names, units, bounds and starts."""

from __future__ import annotations

from functools import partial

from fmu_src.python.slider_component.variables import Variable

_input = partial(Variable, type="Real", causality="input", variability="continuous")
_tunable = partial(Variable, type="Real", causality="parameter", variability="tunable")
_fixed = partial(Variable, type="Real", causality="parameter", variability="fixed")
_output = partial(Variable, type="Real", causality="output", variability="discrete")

VARIABLES: tuple[Variable, ...] = (
    _input(
        "velocity_reference",
        "Mean velocity that the slider shall have",
        start=0.0,
        unit="m/s",
        display_unit="mm/s",
        nominal=0.1,
    ),
    _input(
        "measured_velocity",
        "Mean velocity that the slider has; to be connected with its mean_velocity",
        start=0.0,
        unit="m/s",
        display_unit="mm/s",
        nominal=0.1,
    ),
    _tunable(
        "proportional_gain",
        "Effort per velocity error",
        start=100.0,
        unit="s/m",
        minimum=0.0,
        maximum=1e12,
        nominal=100.0,
    ),
    _tunable(
        "integral_gain",
        "Rate of effort per velocity error",
        start=400.0,
        unit="1/m",
        minimum=0.0,
        maximum=1e12,
        nominal=100.0,
    ),
    _tunable(
        "effort_limit",
        "Largest magnitude of the effort; 1 is all that the device can give",
        start=1.0,
        unit="1",
        minimum=0.0,
        maximum=1.0,
        nominal=1.0,
    ),
    _tunable(
        "force_phase",
        "Phase theta1 (33) of the force on the slider; the start is that of table 1",
        start=0.733313,
        unit="rad",
        display_unit="deg",
        nominal=1.0,
    ),
    _fixed(
        "sample_time",
        "Time between two samples of the inputs",
        start=0.01,
        unit="s",
        display_unit="ms",
        minimum=1e-9,
        maximum=1e6,
        nominal=0.01,
    ),
    _output(
        "phase",
        "Phase for the slider: asin(effort) - force_phase, where its velocity grows with the phase",
        unit="rad",
        display_unit="deg",
        nominal=1.0,
    ),
    _output(
        "effort",
        "Share of the largest mean force, sin(phase + force_phase)",
        unit="1",
        minimum=-1.0,
        maximum=1.0,
        nominal=1.0,
    ),
)

INITIAL_DEPENDENCIES: dict[str, tuple[str, ...]] = {"phase": ("force_phase",), "effort": ()}
"""What each output depends on during initialization: no sample has been taken then."""
