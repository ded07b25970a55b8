"""Parameters and inputs of the slider by name: a struct in C, a data class in Python."""

from __future__ import annotations

from collections.abc import Sequence

from fmu_src.generators.origin import origin
from fmu_src.python.slider_component.variable import Variable

_TABLE = "python/slider_component/variables.py"

_C = """\
/* Parameters and inputs by the names of the interface (SI units).
 *
 * {origin} */
#ifndef SLIDER_PARAMETERS_H
#define SLIDER_PARAMETERS_H

typedef struct {{
{parameters}
}} Device;

/* `phase` is kept in [-pi, pi]. */
typedef struct {{
{inputs}
}} Inputs;

#endif
"""

_PYTHON = '''\
"""Parameters and inputs by the names of the interface (SI units).

{origin}
"""

from __future__ import annotations

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


def c_parameters(variables: Sequence[Variable]) -> str:
    """Return the text of parameters.h."""
    return _C.format(
        origin=origin(_TABLE),
        parameters="\n".join(_c_field(v) for v in variables if v.causality == "parameter"),
        inputs="\n".join(_c_field(v) for v in variables if v.causality == "input"),
    )


def python_parameters(variables: Sequence[Variable]) -> str:
    """Return the text of parameters.py."""
    return _PYTHON.format(
        origin=origin(_TABLE, ""),
        parameters="\n".join(_python_field(v) for v in variables if v.causality == "parameter"),
        inputs="\n".join(_python_field(v) for v in variables if v.causality == "input"),
    )


def _c_field(variable: Variable) -> str:
    kind = "int" if variable.type == "Integer" else "double"
    return f"    {kind} {variable.name};"


def _python_field(variable: Variable) -> str:
    kind = int if variable.type == "Integer" else float
    return f"    {variable.name}: {kind.__name__} = {kind(variable.start or 0)!r}"
