"""A C function for each text of a refusal that the twins share, from the Python function.

The Python function is called with placeholders, which stand in its text where the arguments of
C's format go. By their annotations: a `float` becomes a double, shown with the fewest digits that
read back as the same number, as repr does; an `int` becomes a long long; a `str`, or an `object`
that Python shows with repr, becomes a text.
"""

from __future__ import annotations

import inspect
import json
import re
import textwrap
from collections.abc import Callable, Sequence
from dataclasses import dataclass

from fmu_src.generators.origin import origin
from fmu_src.python.slider_component import refusal_texts

_SOURCE = "python/slider_component/refusal_texts.py"

_FILE = """\
/* Refusals that the twins share: each function writes its text and returns false.
 *
 * {origin} */
#ifndef SLIDER_REFUSAL_TEXTS_H
#define SLIDER_REFUSAL_TEXTS_H

#include "refusal.h"
{functions}
#endif
"""

_C_TYPES = {
    "str": "const char *",
    "object": "const char *",
    "float": "double ",
    "int": "long long ",
}
_MARK = re.compile("\0([^\0]+)\0")
_WIDTH = 100


@dataclass(frozen=True)
class _Placeholder:
    """An argument that shows as its name between two marks, and only in the form C can show."""

    name: str
    kind: str

    def __repr__(self) -> str:
        return self._shown(self.kind in ("float", "object"))

    def __str__(self) -> str:
        return self._shown(self.kind in ("str", "int"))

    def _shown(self, right: bool) -> str:
        if not right:
            raise ValueError(f"{self.name}: {self.kind} must be shown in the other way (!r or not)")
        return f"\0{self.name}\0"


def c_refusal_texts() -> str:
    """Return the text of refusal_texts.h."""
    return _FILE.format(origin=origin(_SOURCE), functions="".join(map(c_function, _texts())))


def _texts() -> list[Callable[..., str]]:
    functions = filter(inspect.isfunction, vars(refusal_texts).values())
    return [function for function in functions if function.__module__ == refusal_texts.__name__]


def c_function(text: Callable[..., str]) -> str:
    """Return the C function for a text; ValueError for a text that C could not show."""
    kinds = {name: str(p.annotation) for name, p in inspect.signature(text).parameters.items()}
    shown = text(**{name: _Placeholder(name, kind) for name, kind in kinds.items()})
    form, order = _format(shown, kinds)
    numbers = [name for name in order if kinds[name] == "float"]
    parameters = ["Refusal *refusal", *(f"{_C_TYPES[kind]}{name}" for name, kind in kinds.items())]
    arguments = [f"number_text({name}, {name}_text)" if name in numbers else name for name in order]
    return "\n".join(
        (
            f"\n/* {inspect.getdoc(text)} */",
            _listed(f"static inline bool refuse_{text.__name__}(", parameters, ") {"),
            *(f"    char {name}_text[NUMBER_SIZE];" for name in numbers),
            _call("    return refuse(", form, arguments),
            "}\n",
        )
    )


def _call(start: str, form: str, arguments: Sequence[str]) -> str:
    whole = f"{start}{', '.join(('refusal', json.dumps(form), *arguments))});"
    if len(whole) <= _WIDTH:
        return whole
    indent = " " * len(start)
    pieces = textwrap.wrap(f"{form} ", _WIDTH - len(start) - 3, drop_whitespace=False)
    pieces[-1] = pieces[-1].removesuffix(" ")
    quoted = f"\n{indent}".join(map(json.dumps, pieces))
    rest = f",\n{_listed(indent, arguments, ');')}" if arguments else ");"
    return f"{start}refusal,\n{indent}{quoted}{rest}"


def _listed(start: str, items: Sequence[str], end: str) -> str:
    """Return the items between `start` and `end`, further lines indented as far as the first."""
    whole = ", ".join(item.replace(" ", "\0") for item in items) + end.replace(" ", "\0")
    lines = textwrap.wrap(whole, _WIDTH, initial_indent=start, subsequent_indent=" " * len(start))
    return "\n".join(lines).replace("\0", " ")


def _format(shown: str, kinds: dict[str, str]) -> tuple[str, list[str]]:
    """Return C's format for a text with placeholders, and their names in its order."""
    order = _MARK.findall(shown)
    if sorted(order) != sorted(kinds):
        raise ValueError(f"{shown!r} must show each of its arguments once")
    doubled = shown.replace("%", "%%")
    return _MARK.sub(lambda m: "%lld" if kinds[m[1]] == "int" else "%s", doubled), order
