"""The table of the controller's variables: names, units, bounds and start values."""

from functools import partial

from fmu_src.python.slider_component.variable import Variable

_input = partial(Variable, type="Real", causality="input", variability="continuous")
_tunable = partial(Variable, type="Real", causality="parameter", variability="tunable")
_fixed = partial(Variable, type="Real", causality="parameter", variability="fixed")
_output = partial(Variable, type="Real", causality="output", variability="discrete")

VARIABLES: tuple[Variable, ...] = (
    _input(
        "velocity_reference",
        "Reference of the slider's mean velocity",
        start=0.0,
        unit="m/s",
        display_unit="mm/s",
        nominal=0.1,
    ),
    _input(
        "measured_velocity",
        "Mean velocity of the slider; connect it to the slider's mean_velocity",
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
        "Largest magnitude of the effort; 1 is the limit of the device",
        start=1.0,
        unit="1",
        minimum=0.0,
        maximum=1.0,
        nominal=1.0,
    ),
    _tunable(
        "force_phase",
        "Phase theta1 (33) of the force on the slider; the start value is for table 1",
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
        "Phase for the slider, asin(effort) - force_phase: its velocity grows with this phase",
        unit="rad",
        display_unit="deg",
        nominal=1.0,
        # No sample yet: the effort is 0.
        depends_initially_on=("force_phase",),
    ),
    _output(
        "effort",
        "Fraction of the largest mean force, sin(phase + force_phase)",
        unit="1",
        minimum=-1.0,
        maximum=1.0,
        nominal=1.0,
    ),
    # The samples hold phase and effort between steps, so this output alone depends on the inputs
    # directly. FMI Library, where no output names a dependency, takes all to depend on all.
    _output(
        "velocity_error",
        "velocity_reference - measured_velocity, of the present inputs",
        variability="continuous",
        unit="m/s",
        display_unit="mm/s",
        nominal=0.1,
        depends_on=("velocity_reference", "measured_velocity"),
        depends_initially_on=("velocity_reference", "measured_velocity"),
    ),
)
