"""The table of variables of an FMU in C."""

import json
from collections.abc import Mapping, Sequence

from fmu_src.generators.c_header import c_header, generated_from
from fmu_src.python.slider_component.variable import Variable

_HEADER = """\
#include <stdbool.h>

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
"""

_SOURCE = """\
/* {origin} */
#include "variables.h"

#include <float.h>

const Variable VARIABLES[VARIABLE_COUNT] = {{
{rows}
}};
"""


def c_table(variables: Sequence[Variable], table: str) -> Mapping[str, str]:
    """Return variables.h and variables.c (file name -> text); `table` is the path of their source.

    Raises ValueError for an output before an input or parameter: in C the references of what can be
    set also count its values.
    """
    settable = [v for v in variables if v.causality != "output"]
    if settable != list(variables[: len(settable)]):
        raise ValueError("the table of variables is refused: outputs must come last")
    header = _HEADER.format(
        references="\n".join(f"    VR_{v.name.upper()} = {i}," for i, v in enumerate(variables)),
        settable=len(settable),
        count=len(variables),
    )
    rows = "\n".join(map(_row, variables))
    return {
        "component/variables.h": c_header("The table of FMU variables.", table, header),
        "component/variables.c": _SOURCE.format(origin=generated_from(table), rows=rows),
    }


def _row(variable: Variable) -> str:
    cells = (
        json.dumps(variable.name),
        json.dumps(variable.type == "Integer"),
        json.dumps(variable.variability == "fixed"),
        _number(variable.start, "0.0"),
        _number(variable.minimum, "-DBL_MAX"),
        _number(variable.maximum, "DBL_MAX"),
    )
    return f"    {{{', '.join(cells)},\n     {json.dumps(variable.requirement)}}},"


def _number(value: float | None, absent: str) -> str:
    # repr gives the shortest text that reads back as the same number.
    return absent if value is None else repr(float(value))
