"""The table of variables in C: variables.h and variables.c of the slider and of its controller."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence

from fmu_src.generators.origin import origin
from fmu_src.python.slider_component.variable import Variable

_HEADER = """\
/* The table of FMU variables.
 *
 * {origin} */
#ifndef SLIDER_VARIABLES_H
#define SLIDER_VARIABLES_H

#include <stdbool.h>
{include}
/* Value references: below SETTABLE_COUNT those of inputs and parameters, then those of outputs. */
enum {{
{references}
    SETTABLE_COUNT = {settable},
    VARIABLE_COUNT = {count}
}};

/* `minimum` and `maximum` are inclusive, and infinite for none; `start` is 0 for outputs. */
typedef struct {{
    const char *name;
    bool integer, fixed;
    double start, minimum, maximum;
    const char *requirement; /* what a value must be, in words */
}} Variable;

extern const Variable VARIABLES[VARIABLE_COUNT];
{declarations}
#endif
"""

_SOURCE = """\
/* The table of FMU variables.
 *
 * {origin} */
#include "variables.h"

#include <float.h>

const Variable VARIABLES[VARIABLE_COUNT] = {{
{rows}
}};
{definitions}"""

_DECLARATIONS = """
/* Parameters and inputs from all values that can be set, by reference. */
Device device_of(const double values[SETTABLE_COUNT]);
Inputs inputs_of(const double values[SETTABLE_COUNT]);
"""

_DEFINITIONS = """
Device device_of(const double values[SETTABLE_COUNT]) {{
    Device device;
{device}
    return device;
}}

Inputs inputs_of(const double values[SETTABLE_COUNT]) {{
    Inputs inputs;
{inputs}
    return inputs;
}}
"""


def c_table(variables: Sequence[Variable]) -> Mapping[str, str]:
    """Return file name -> text of the slider's table in C.

    Raises ValueError for an output before an input or parameter: in C the references of what can be
    set also count its values.
    """
    definitions = _DEFINITIONS.format(
        device="\n".join(_copied("device", v) for v in variables if v.causality == "parameter"),
        inputs="\n".join(_copied("inputs", v) for v in variables if v.causality == "input"),
    )
    return _files(
        variables,
        "python/slider_component/variables.py",
        include='\n#include "device.h"\n',
        declarations=_DECLARATIONS,
        definitions=definitions,
    )


def c_controller_table(variables: Sequence[Variable]) -> Mapping[str, str]:
    """Return file name -> text of the controller's table in C. Raises ValueError as `c_table`."""
    return _files(variables, "controller/variables.py")


def _files(
    variables: Sequence[Variable],
    table: str,
    *,
    include: str = "",
    declarations: str = "",
    definitions: str = "",
) -> Mapping[str, str]:
    settable = [v for v in variables if v.causality != "output"]
    if settable != list(variables[: len(settable)]):
        raise ValueError("the table of variables is refused: outputs must come last")
    header = _HEADER.format(
        origin=origin(table),
        include=include,
        references="\n".join(f"    {_reference(v)} = {i}," for i, v in enumerate(variables)),
        settable=len(settable),
        count=len(variables),
        declarations=declarations,
    )
    rows = "\n".join(map(_row, variables))
    source = _SOURCE.format(origin=origin(table), rows=rows, definitions=definitions)
    return {"variables.h": header, "variables.c": source}


def _reference(variable: Variable) -> str:
    return f"VR_{variable.name.upper()}"


def _row(variable: Variable) -> str:
    numbers = ", ".join(
        (
            _number(variable.start, "0.0"),
            _number(variable.minimum, "-DBL_MAX"),
            _number(variable.maximum, "DBL_MAX"),
        )
    )
    integer, fixed = variable.type == "Integer", variable.variability == "fixed"
    return (
        f"    {{{json.dumps(variable.name)}, {str(integer).lower()}, {str(fixed).lower()}, "
        f"{numbers},\n     {json.dumps(variable.requirement)}}},"
    )


def _number(value: float | None, absent: str) -> str:
    # repr gives the shortest text that reads back as the same number.
    return absent if value is None else repr(float(value))


def _copied(target: str, variable: Variable) -> str:
    cast = "(int)" if variable.type == "Integer" else ""
    return f"    {target}.{variable.name} = {cast}values[{_reference(variable)}];"
