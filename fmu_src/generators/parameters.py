"""Parameters and inputs of the slider by name: structs in C, data classes in Python."""

from collections.abc import Mapping, Sequence

from fmu_src.generators.c_header import c_header, generated_from
from fmu_src.python.slider_component.variable import Variable

_TABLE = "python/slider_component/variables.py"

_DECLARATIONS = """\
typedef struct {{
{parameters}
}} Device;

/* `phase` is kept in [-pi, pi]. */
typedef struct {{
{inputs}
}} Inputs;
"""

_FUNCTIONS = """\
#include "../device/parameters.h"

/* Parameters and inputs from all values that can be set, by reference. */
Device device_of(const double values[]);
Inputs inputs_of(const double values[]);
"""

_DEFINITIONS = """\
/* {origin} */
#include "parameter_values.h"

#include "variables.h"

Device device_of(const double values[]) {{
    return (Device){{
{parameters}
    }};
}}

Inputs inputs_of(const double values[]) {{
    return (Inputs){{
{inputs}
    }};
}}
"""

_PYTHON = '''\
"""Parameters and inputs by the names of the interface (SI units).

{origin}
Then run `python -m fmu_src.generate`.
"""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Parameters:
    """All parameters; the defaults are the start values."""

{parameters}


@dataclass(frozen=True, slots=True)
class Inputs:
    """All inputs; the defaults are the start values. `phase` is kept in [-pi, pi]."""

{inputs}
'''


def c_parameters(variables: Sequence[Variable]) -> Mapping[str, str]:
    """Return parameters.h, parameter_values.h and parameter_values.c: file name -> text."""
    about = "Parameters and inputs by the names of the interface (SI units)."
    declarations = _filled(_DECLARATIONS, variables, "    {c_type} {name};")
    definitions = _filled(_DEFINITIONS, variables, "        .{name} = {cast}values[VR_{upper}],")
    return {
        "device/parameters.h": c_header(about, _TABLE, declarations),
        "component/parameter_values.h": c_header(
            "Parameters and inputs from values.", _TABLE, _FUNCTIONS
        ),
        "component/parameter_values.c": definitions,
    }


def python_parameters(variables: Sequence[Variable]) -> str:
    """Return the text of parameters.py."""
    return _filled(_PYTHON, variables, "    {name}: {type} = {start!r}")


def _filled(template: str, variables: Sequence[Variable], line: str) -> str:
    """Return `template` with one `line` per parameter and per input."""
    lines: dict[str, list[str]] = {"parameter": [], "input": [], "output": []}
    for v in variables:
        integer = v.type == "Integer"
        number = int if integer else float
        lines[v.causality].append(
            line.format(
                name=v.name,
                upper=v.name.upper(),
                type=number.__name__,
                c_type="int" if integer else "double",
                cast="(int)" if integer else "",
                start=number(v.start or 0),
            )
        )
    return template.format(
        origin=generated_from(_TABLE),
        parameters="\n".join(lines["parameter"]),
        inputs="\n".join(lines["input"]),
    )
