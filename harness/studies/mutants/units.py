"""Mutants of the model description: units that differ from those of the values."""

import re

from studies.mutants.archive import DESCRIPTION
from studies.mutants.mutant import Mutant

_UNIT = re.compile(r'<Real unit="([^"]+)"')
_DEFINED = re.compile(r'<Unit name="([^"]+)"')
_EXPONENT = re.compile(r' (?:kg|m|s)="(-?\d+)"')
_FACTOR = re.compile(r'<DisplayUnit name="[^"]+" factor="([^"]+)"')


def unit_mutants(text: str) -> list[Mutant]:
    """Return the mutants of a model description: wrong units of variables, wrong definitions."""
    units = _DEFINED.findall(text)
    found = []
    for pattern in (_UNIT, _EXPONENT, _FACTOR):
        for match in pattern.finditer(text):
            old, (begin, end) = match.group(1), match.span(1)
            if pattern is _UNIT:
                new = units[(units.index(old) + 1) % len(units)]
            else:
                new = str(int(old) + 1) if pattern is _EXPONENT else repr(1.01 * float(old))
            line, column = text.count("\n", 0, begin) + 1, begin - text.rfind("\n", 0, begin)
            change = f"{match.group()} becomes {new}"
            mutated = text[:begin] + new + text[end:]
            found.append(
                Mutant(DESCRIPTION, DESCRIPTION, line, column, "unit", change, text, mutated)
            )
    return sorted(found, key=lambda m: (m.line, m.column))
