"""Constants that are written in both twins, beside the code that uses them, have one value."""

from __future__ import annotations

import ast
import importlib
import re
from collections.abc import Iterator
from dataclasses import dataclass

import pytest

from fmu_src.sources import C_SOURCES, PACKAGE

OTHER_NAMES = {
    "TABLE_DEGREE": "DEGREE",
    "TAYLOR_ORDER": "ORDER",
}
"""C constant -> Python constant, where the names differ."""

MODULES_ONLY_IN_C = {
    *("bending_kernels", "bending_outlook", "bending_panel", "gauss_nodes"),
    "elementary",
}
"""Panels of bending bristles, which the Python twin follows by series, and functions that it takes
from Python."""

ONLY_IN_C = {
    # Sizes of arrays and buffers, formats of bytes and texts.
    *("CHECKS", "EDGES", "FORCINGS", "SINE_TERMS", "TABLES", "TABLE_NODES", "TAYLOR_TERMS"),
    *("ASKED_BYTES", "CURVE_PANELS", "UNKNOWNS"),
    *("NUMBER_SIZE", "REFUSAL_SIZE", "MAX_DIGITS", "MIN_PLAIN_EXPONENT", "MAX_PLAIN_EXPONENT"),
    *("STATE_HEADER_SIZE", "STATE_NUMBER_SIZE", "STATE_CHECKSUM_SIZE"),
    # Of FMI 3.0, for which there is only the native build.
    "TIME_REFERENCE",
    # Of inputs that vary, which pythonfmu cannot offer.
    *("INPUT_COUNT", "SERIES_ROUNDING", "MAX_BLOCK_LEGS", "MAX_SLOW_PHASES"),
    *(
        "SAME_INPUT",
        "LOADING",
        "MIN_APPROACH",
        "GRAZING_BAND",
        "GROWING",
    ),
    # Part of Python: math.pi, math.tau, None for no zero.
    *("PI", "TAU", "NO_ZERO"),
    # Literals of the Python twin.
    *("LEAD_PARTS", "SLOWEST"),
    # Faster ways to the same zeros and series than those of the Python twin.
    *("MAX_BISECTIONS", "MAX_USES", "NEGLIGIBLE", "PAST_TURNS", "SMALL_TURN", "SMALLEST"),
    *("FIRST_TERMS", "MAX_SHRINKS", "MUCH_SMALLER", "NEGLIGIBLE_MOTION"),
    *("MAX_REFINEMENTS", "SHORTEST_STEP"),
}
"""C constants without a twin."""

_DEFINE = re.compile(r"^#define (\w+) ([-+(]?[0-9PE(][^\n]*)$", re.MULTILINE)
_ENUM = re.compile(r"^enum \{([^}]*)\}", re.MULTILINE)
_ENTRY = re.compile(r"(\w+) = ([^,]+)")


@dataclass(frozen=True)
class Constant:
    """A number with a name, in a module of one twin."""

    module: str
    name: str
    value: float


def _of_c() -> Iterator[Constant]:
    known: dict[str, float] = {}
    for path in sorted(C_SOURCES.glob("*.[ch]"), key=lambda p: (p.suffix == ".c", p.name)):
        if path.name == "snapshot.c" or path.stem in MODULES_ONLY_IN_C:
            continue
        text = re.sub(r"/\*.*?\*/", "", path.read_text(), flags=re.DOTALL)
        entries = [e for body in _ENUM.findall(text) for e in _ENTRY.findall(body)]
        entries = [(name, expression) for name, expression in entries if "sizeof" not in expression]
        for name, expression in [*_DEFINE.findall(text), *entries]:
            known[name] = _value(expression, known)
            yield Constant(path.stem, name, known[name])


def _value(expression: str, known: dict[str, float]) -> float:
    if re.fullmatch(r"0x[0-9a-f.]+p[-+]?\d+", expression):
        return float.fromhex(expression)
    value: float = eval(expression.replace("(double)", ""), {"__builtins__": {}}, known)
    return value


def _of_python() -> Iterator[Constant]:
    for path in sorted(PACKAGE.glob("*.py")):
        names = {
            node.id
            for statement in ast.parse(path.read_text()).body
            if isinstance(statement, ast.Assign)
            for node in ast.walk(statement.targets[0])
            if isinstance(node, ast.Name)
        }
        if any(name.isupper() for name in names) and path.stem != "slave":
            module = importlib.import_module(f"fmu_src.python.slider_component.{path.stem}")
            for name in sorted(names):
                value = getattr(module, name)
                if name.isupper() and isinstance(value, int | float):
                    yield Constant(path.stem, name, value)


C, PYTHON = list(_of_c()), list(_of_python())


@pytest.mark.parametrize(
    "constant",
    [c for c in C if c.name not in ONLY_IN_C],
    ids=lambda c: f"{c.module}.{c.name}",
)
def test_the_twins_have_the_same_value(constant: Constant) -> None:
    name = OTHER_NAMES.get(constant.name, constant.name)
    twins = [c for c in PYTHON if c.name == name]
    twins = [c for c in twins if c.module == constant.module] or twins
    assert len(twins) == 1, f"{constant.name} is not one constant of the Python twin: {twins}"
    assert twins[0].value == constant.value


def test_phases_are_rounded_alike() -> None:
    """In C to a number of parts, in Python to a number of decimals."""
    (parts,) = (c.value for c in C if c.name == "LEAD_PARTS")
    (digits,) = (c.value for c in PYTHON if c.name == "LEAD_DIGITS")
    assert parts == 10.0**digits


def test_the_list_of_constants_without_a_twin_is_current() -> None:
    assert {c.name for c in C} >= ONLY_IN_C
    assert {path.stem for path in C_SOURCES.glob("*.c")} >= MODULES_ONLY_IN_C
