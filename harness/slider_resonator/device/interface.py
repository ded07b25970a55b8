"""The interface that the harness requires of an FMU: every variable with all that is said of it.

Repeated here on purpose: an FMU whose own table is wrong must not agree with itself. A variable
that came after version `FIRST` of the interface may be missing; the FMU is judged on the rest.
"""

from collections.abc import Mapping
from functools import partial

from slider_resonator.device.device import DEVIATIONS, PARAMETER_TABLE
from slider_resonator.device.variable import FIRST, Causality, Variable
from slider_resonator.errors import unknown_name

_input = partial(Variable, causality="input", variability="continuous")
_deviation = partial(_input, unit="1", start=0.0, since="0.3.0", without=0.0)
_output = partial(Variable, causality="output", variability="continuous")
_count = partial(Variable, causality="output", variability="discrete")

_INPUTS = ("phase", "load", "frequency_ratio", *DEVIATIONS)


_ALL = (
    _input("phase", unit="rad", start=0.0, nominal=1.0),
    _input("load", unit="N", start=0.0, nominal=0.1),
    _input("frequency_ratio", unit="1", start=1.0, nominal=1.0),
    _deviation("amplitude_deviation", minimum=-1.0, nominal=0.1),
    _deviation("frequency_deviation", minimum=-0.99, nominal=0.01),
    *PARAMETER_TABLE,
    _output("position", unit="m", nominal=1e-3),
    _output("velocity", unit="m/s", nominal=0.1),
    _output("mean_velocity", unit="m/s", nominal=0.1),
    _output("resonator_displacement", unit="m", nominal=1e-3, depends_on=DEVIATIONS),
    _output("resonator_velocity", unit="m/s", nominal=1.0, depends_on=DEVIATIONS),
    _output("normal_force", unit="N", nominal=1.0, depends_on=("phase",)),
    _output("friction_force", unit="N", nominal=0.1, depends_on=_INPUTS),
    _count("contact_mode", unit="1", minimum=-1.0, maximum=2.0, depends_on=_INPUTS),
    _count("reversals", unit="1", minimum=0.0),
    _output("stick_fraction", unit="1", minimum=0.0, maximum=1.0, nominal=1.0),
    _count("last_event_time", unit="s"),
    _output("steady_velocity", unit="m/s", nominal=0.1, depends_on=_INPUTS),
    _output(
        "blocking_force",
        unit="N",
        nominal=0.1,
        depends_on=("phase", "frequency_ratio", *DEVIATIONS),
    ),
    _count("prediction_valid", unit="1", minimum=0.0, maximum=1.0, depends_on=None, since="0.2.0"),
    _output("slow_motion_error", unit="m/s", minimum=0.0, depends_on=None, since="0.2.0"),
    _output("friction_power", unit="W", nominal=0.01, depends_on=None, since="0.3.0"),
)

VARIABLES: Mapping[str, Variable] = {variable.name: variable for variable in _ALL}
"""Every variable by name."""


def _units(causality: Causality, *, later: bool) -> dict[str, str]:
    return {
        name: variable.unit
        for name, variable in VARIABLES.items()
        if variable.causality == causality and (later or variable.since == FIRST)
    }


INPUTS = _units("input", later=False)
"""Input name to unit, of those that every FMU has."""

INPUT_STARTS: Mapping[str, float] = {name: VARIABLES[name].start or 0.0 for name in INPUTS}
"""Default value of each input."""

PARAMETERS = _units("parameter", later=True)
"""Parameter name to unit."""

TUNABLES = tuple(name for name in PARAMETERS if VARIABLES[name].variability == "tunable")
"""Parameters that can be set in a run; all others are fixed when it begins."""

HELD = (*TUNABLES, *DEVIATIONS)
"""Tunable parameters, and inputs that are held over a step as these are."""

SETTABLE = _units("parameter", later=True) | _units("input", later=True)
"""Name of a parameter or input to unit."""

INTEGERS = frozenset(name for name in PARAMETERS if VARIABLES[name].kind == "Integer")
"""Parameters that are Integers; all others, and all inputs, are Real."""

OUTPUTS = _units("output", later=False)
"""Output name to unit, of those that every FMU has."""

ALL_OUTPUTS = _units("output", later=True)
"""The same of every output, also of those that FMUs of earlier versions lack."""


def settable_value(name: str, value: object) -> float:
    """Return a value of a parameter or input, a number or text, in its SI unit.

    Raises ValueError, with name, value and requirement, for one that the interface does not have.
    """
    if name not in SETTABLE:
        raise ValueError(unknown_name("parameter or input", name, SETTABLE))
    return float(VARIABLES[name].read(value))
