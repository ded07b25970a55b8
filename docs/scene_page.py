"""Write docs/scenes.md: every key, unit, rule and quantity of scene files, from the schema.

python docs/scene_page.py [PAGE]
"""

import sys
from collections.abc import Mapping, Sequence
from itertools import groupby
from pathlib import Path
from typing import Any

from pydantic import BaseModel
from pydantic.fields import FieldInfo

from slider_resonator.device.interface import PARAMETERS, TUNABLES, VARIABLES
from slider_resonator.scenes.expansion import bundles
from slider_resonator.scenes.key_table import PARAMETER_MEANINGS, KeyTable
from slider_resonator.scenes.needs import AllowedTable, NeedTable
from slider_resonator.scenes.schema import (
    ExpectTable,
    InputsTable,
    InputTable,
    RunTable,
    SceneTable,
    SweepTable,
    TuningTable,
)
from slider_resonator.scenes.toml_file import toml_value
from slider_resonator.scenes.vocabulary import QUANTITIES, REFERENCES, Quantity

TABLES: dict[str, type[KeyTable]] = {
    "The top of the file": SceneTable,
    "[inputs]": InputsTable,
    "Values over time": InputTable,
    "[tuning]": TuningTable,
    "[run]": RunTable,
    "[[expect]]": ExpectTable,
    "[sweep]": SweepTable,
    "[need]": NeedTable,
    "The accuracy of a need": AllowedTable,
}
"""The tables of a scene file, by their headings on the page."""

_INTRODUCTION = """\
# Scene files

<!-- Written by `python docs/scene_page.py` from the schema; do not edit. -->

A scene is a TOML file: the device, the inputs over time, the length of the run, and what must hold.

```sh
slider-resonator scenes --template > my_step.toml        # a commented scene to start from
slider-resonator scenes --check my_step.toml             # is it valid? nothing is run
slider-resonator validate --scene my_step.toml           # run it and compare
slider-resonator scenes --show table_1                   # the text of a built-in scene
slider-resonator run my_steps.toml#my_fast_step          # one scene of a file of several
slider-resonator scenes --schema > scene.schema.json     # JSON schema for editors
```

An editor with a TOML language server completes and checks the keys, if the first line of a scene is
`#:schema ./scene.schema.json`.
"""
_AT_THE_TOP = """\
A mistake is reported in one line with file, key and remedy:

```text
my_step.toml: run.stop_tme: unknown key 'stop_tme'; did you mean 'stop_time'? (must be one of ...)
```
"""


def scene_page() -> str:
    """Return the page as Markdown, with a newline at the end."""
    parts = [_INTRODUCTION]
    for heading, model in TABLES.items():
        parts.append(_section(heading, model))
        if model is SceneTable:
            parts += [_AT_THE_TOP, _device_section()]
    parts += [
        "## Bundles of expectations\n",
        'A scene takes them by name: `expect_bundles = ["motion"]`.\n',
        _table(
            ("bundle", "what it expects"),
            [(_code(name), bundle["meaning"]) for name, bundle in bundles().items()],
        ),
        _table(("bundle", "quantities", "against", "within"), _bundles()),
        "## Quantities\n",
        "What an expectation can compare. One that needs *constants* is for constant "
        "inputs and parameters, without [tuning].\n",
        _table(("quantity", "kind", "unit", "meaning", "needs", "references"), _quantities()),
        "## References\n",
        _table(
            ("reference", "what it is, and when it applies"),
            [(_code(name), meaning) for name, meaning in REFERENCES.items()],
        ),
        "A reference that does not apply to a scene is an error of that scene (exit code 2), "
        "not a failed check.\n",
        "## A scene with every key\n",
        "It is valid, and passes. A line that begins with `# or:` can replace the one above it.\n",
        f"```toml\n{beside('every_key.toml').rstrip()}\n```\n",
        "The file `recorded.csv` beside it:\n",
        f"```text\n{beside('recorded.csv').rstrip()}\n```\n",
    ]
    return "\n".join(parts)


def beside(name: str) -> str:
    """Return the text of a file beside this one."""
    return Path(__file__).with_name(name).read_text(encoding="utf-8")


def _section(heading: str, model: type[KeyTable]) -> str:
    rows = [_row(name, field) for name, field in model.model_fields.items()]
    table = _table(("key", "unit", "default", "meaning", "example"), rows)
    rules = [f"- {rule}" for rule in model.rules]
    summary = (model.__doc__ or "").splitlines()[0]
    return "\n".join([f"## {heading}\n", f"{summary}\n", table, *rules, *([""] if rules else [])])


def _row(name: str, field: FieldInfo) -> tuple[str, ...]:
    extra: Any = field.json_schema_extra or {}
    (example,) = field.examples or [None]
    shown = _code(f"{name} = {toml_value(example)}")
    unit = str(extra.get("unit", ""))
    return _code(name), unit, _default(name, field), field.description or "", shown


def _default(name: str, field: FieldInfo) -> str:
    default = field.default
    if field.is_required():
        return "must be given"
    if name in InputsTable.model_fields:
        return _code(toml_value(VARIABLES[name].start))
    if default is None or isinstance(default, BaseModel) or default in ("", (), {}):
        return ""
    return _code(toml_value(default))


def _device_section() -> str:
    rows = [
        (
            _code(name),
            VARIABLES[name].unit,
            _bounds(name),
            _code(f"{VARIABLES[name].start:g}"),
            PARAMETER_MEANINGS[name] + (" (tunable)" if name in TUNABLES else ""),
        )
        for name in PARAMETERS
    ]
    table = _table(("key", "unit", "must be", "default", "meaning"), rows)
    return "\n".join(
        [
            "## [device]\n",
            "The parameters of the FMU; the defaults are the device of table 1. The tunable ones "
            "can change in a run, in [tuning]. Values out of bounds are refused. A device "
            'file may be named instead, above the first heading: `device = "mine.toml"`, or an '
            'example of `slider-resonator device`: `device = "stick_slip"`.\n',
            table,
        ]
    )


def _bounds(name: str) -> str:
    variable = VARIABLES[name]
    low, high = variable.minimum, variable.maximum
    if low is None or high is None:
        return "" if low is None else f"at least {low:g}"
    return f"{low:g} to {high:g}"


def _quantities() -> list[tuple[str, ...]]:
    return [
        (
            _code(name),
            quantity.kind,
            quantity.unit,
            quantity.meaning,
            _needs(quantity),
            ", ".join(map(_code, quantity.references)),
        )
        for name, quantity in QUANTITIES.items()
    ]


def _needs(quantity: Quantity) -> str:
    needs = {"constants": quantity.needs_constants, "[run]": quantity.needs_run}
    return ", ".join(name for name, needed in needs.items() if needed)


def _bundles() -> list[tuple[str, ...]]:
    """Return a row for the quantities of a bundle that have one reference and bound."""
    rows: list[tuple[str, ...]] = []
    for name, bundle in bundles().items():
        for (against, within), expects in groupby(bundle["expect"], _bound):
            quantities = ", ".join(_code(expect["quantity"]) for expect in expects)
            rows.append((_code(name), quantities, against, within))
    return rows


def _bound(expect: Mapping[str, Any]) -> tuple[str, str]:
    """Return reference or value of an expectation, and the tolerance."""
    kinds = ("value", "at_most", "at_least")
    values = [f"{kind} {expect[kind]:g}" for kind in kinds if kind in expect]
    bounds = ("absolute", "relative", "tube")
    within = [f"{kind} {expect[kind]:g}" for kind in bounds if kind in expect]
    return _code(expect["reference"]) if "reference" in expect else values[0], ", ".join(within)


def _table(headings: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    lines = [headings, ["---"] * len(headings), *rows]
    escaped = ([cell.replace("|", "\\|") for cell in cells] for cells in lines)
    return "\n".join(f"| {' | '.join(cells)} |" for cells in escaped) + "\n"


def _code(text: str) -> str:
    return f"`{text}`"


if __name__ == "__main__":
    page = Path(sys.argv[1]) if len(sys.argv) > 1 else Path(__file__).with_name("scenes.md")
    page.write_text(scene_page(), encoding="utf-8")
