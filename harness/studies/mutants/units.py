"""Mutants of the model description: units that differ from those of the values."""

from __future__ import annotations

import re
from collections.abc import Iterator

from studies.mutants.archive import DESCRIPTION
from studies.mutants.mutant import Mutant

_DEFINED = re.compile(r'<Unit name="([^"]+)"')
_VARIABLE = re.compile(r'<ScalarVariable name="(\w+)"[^>]*>\s*<Real( unit="([^"]+)")')
_BASE = re.compile(r'<Unit name="([^"]+)">\s*<BaseUnit([^>]*?)\s*/>')
_EXPONENT = re.compile(r'(\w+)="(-?\d+)"')
_DISPLAY = re.compile(r'<DisplayUnit name="([^"]+)" factor="([^"]+)"')

_Change = tuple[int, int, str, str]
"""Begin and end of the replaced text, the new text, and a description."""


def unit_mutants(text: str) -> list[Mutant]:
    """Return the mutants of a model description: wrong units of variables, wrong definitions."""
    found = []
    for begin, end, new, change in (*_of_variables(text), *_of_definitions(text)):
        line = text.count("\n", 0, begin) + 1
        column = begin - text.rfind("\n", 0, begin)
        mutated = text[:begin] + new + text[end:]
        file = DESCRIPTION
        found.append(Mutant(file, file, line, column, "unit", change, text, mutated))
    return sorted(found, key=lambda m: (m.line, m.column, m.change))


def _of_variables(text: str) -> Iterator[_Change]:
    units = _DEFINED.findall(text)
    for match in _VARIABLE.finditer(text):
        name, attribute, unit = match.groups()
        other = units[(units.index(unit) + 1) % len(units)]
        begin, end = match.span(2)
        yield begin, end, f' unit="{other}"', f"unit of {name} becomes {other}"
        if unit != "1":  # without any it is 1
            without = attribute.replace(f' unit="{unit}"', "")
            yield begin, end, without, f"unit of {name} is left out"


def _of_definitions(text: str) -> Iterator[_Change]:
    for match in _BASE.finditer(text):
        unit, begin = match.group(1), match.start(2)
        yield match.end(2), match.end(2), ' factor="1000.0"', f"unit {unit} gets factor 1000"
        for exponent in _EXPONENT.finditer(match.group(2)):
            base, power = exponent.group(1), int(exponent.group(2))
            if base == "rad":  # to the SI it is 1, whatever its exponent
                continue
            start, end = begin + exponent.start(2), begin + exponent.end(2)
            yield start, end, str(power + 1), f"unit {unit}: {base}^{power} becomes ^{power + 1}"
    for match in _DISPLAY.finditer(text):
        display, factor = match.group(1), float(match.group(2))
        change = f"display unit {display}: factor is 1 % too large"
        yield match.start(2), match.end(2), repr(1.01 * factor), change
