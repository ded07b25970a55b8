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
from collections.abc import Callable
from dataclasses import dataclass

from fmu_src.generators.c_header import c_header
from fmu_src.python.slider_component import refusal_texts

_C_TYPES = {
    "str": "const char *",
    "object": "const char *",
    "float": "double ",
    "int": "long long ",
}
_MARK = re.compile("\0([^\0]+)\0")


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
    functions = filter(inspect.isfunction, vars(refusal_texts).values())
    own = [f for f in functions if f.__module__ == refusal_texts.__name__]
    return c_header(
        "refusal_texts",
        "Refusals that the twins share: each function writes its text and returns false.",
        "python/slider_component/refusal_texts.py",
        '#include "refusal.h"\n' + "".join(map(c_function, own)),
    )


def c_function(text: Callable[..., str]) -> str:
    """Return the C function for a text; ValueError for a text that C could not show."""
    kinds = {name: str(p.annotation) for name, p in inspect.signature(text).parameters.items()}
    shown = text(**{name: _Placeholder(name, kind) for name, kind in kinds.items()})
    form, order = _format(shown, kinds)
    numbers = [name for name in order if kinds[name] == "float"]
    parameters = ["Refusal *refusal", *(f"{_C_TYPES[kind]}{name}" for name, kind in kinds.items())]
    arguments = [f"number_text({name}, {name}_text)" if name in numbers else name for name in order]
    lines = ["refusal", json.dumps(form), *([", ".join(arguments)] if arguments else [])]
    call = ",\n                  ".join(lines)
    return (
        f"\n/* {inspect.getdoc(text)} */\n"
        f"static inline bool refuse_{text.__name__}({', '.join(parameters)}) {{\n"
        + "".join(f"    char {name}_text[NUMBER_SIZE];\n" for name in numbers)
        + f"    return refuse({call});\n}}\n"
    )


def _format(shown: str, kinds: dict[str, str]) -> tuple[str, list[str]]:
    """Return C's format for a text with placeholders, and their names in its order."""
    order = _MARK.findall(shown)
    if sorted(order) != sorted(kinds):
        raise ValueError(f"{shown!r} must show each of its arguments once")
    doubled = shown.replace("%", "%%")
    return _MARK.sub(lambda m: "%lld" if kinds[m[1]] == "int" else "%s", doubled), order
