"""Read the content of a file as a table of a schema: units, and errors with key and requirement."""

import re
from collections.abc import Mapping
from typing import Any, TypeVar, get_args

from pydantic import BaseModel, ValidationError
from pydantic.fields import FieldInfo
from pydantic_core import ErrorDetails

from slider_resonator.device.device import DEVIATIONS
from slider_resonator.device.interface import INPUTS, OUTPUTS, PARAMETERS, TUNABLES, VARIABLES
from slider_resonator.device.units import si_number
from slider_resonator.errors import SceneError, explained, unknown_name
from slider_resonator.scenes.expansion import with_bundles
from slider_resonator.scenes.key_table import HAS_UNIT, units_of
from slider_resonator.scenes.needs import NeedTable
from slider_resonator.scenes.schema import DeviceFileTable, RunTable, SceneTable
from slider_resonator.scenes.toml_file import toml_value
from slider_resonator.scenes.vocabulary import QUANTITIES

TableT = TypeVar("TableT", bound=BaseModel)


def table_from(table: type[TableT], content: Mapping[str, Any], source: str) -> TableT:
    """Return the content of a file as a table of a schema, texts with units in SI units.

    Raises SceneError with a line for each of the first ten mistakes: `source`, key path, value and
    requirement.
    """
    with explained(f"{source}: "):
        content = _in_si(content)
    try:
        return table.model_validate(content)
    except ValidationError as error:
        lines = [f"{source}: {_explanation(one, content, table)}" for one in error.errors()[:10]]
        raise SceneError("\n".join(lines)) from None


_UNITS: Mapping[str, str] = {
    **{name: v.unit for name, v in VARIABLES.items() if v.kind == "Real"},
    **{name: unit for name, unit in units_of(RunTable).items() if unit == "s"},
    **units_of(NeedTable),
    **dict.fromkeys(("rel", "relative"), "1"),
}
"""Keys of values, or of tables of values, and their units."""
_INHERITED = (
    *("constant", "steps", "ramp", "from", "to", "values"),
    *("abs", "absolute", "value", "at_most", "at_least"),
)
"""Keys of values whose unit is that of the table they are in."""


def _in_si(value: Any, path: str = "", unit: str = "") -> Any:
    """Return the content of a file, with numbers in SI units for its texts with a unit.

    `unit` is that of the values at a path, empty for what has none. What is no such text stays as
    it is, for the schema to refuse. Raises ValueError with key, value and requirement.
    """
    if path.endswith("device"):
        return value  # its schema reads units
    if isinstance(value, str):
        if re.fullmatch(r"need\.\w+", path):
            return value  # it must be a table
        is_number = unit and re.search(HAS_UNIT, value) and not value.lower().endswith(".csv")
        return si_number(path, value, unit) if is_number else value
    if isinstance(value, Mapping):
        about = QUANTITIES.get(str(value.get("quantity")))
        own = about.unit if about else _UNITS.get(str(value.get("variable")), "")
        own = own if own in _UNITS.values() else unit
        units = {**dict.fromkeys(_INHERITED, own), **_UNITS}
        return {
            key: _in_si(one, f"{path}.{key}".lstrip("."), units.get(key, ""))
            for key, one in value.items()
        }
    if not isinstance(value, list | tuple):
        return value
    # The first of a pair is a time.
    first = "s" if re.search(r"\.(steps|ramp)\[\d+\]$", path) else unit
    return [_in_si(one, f"{path}[{k + 1}]", unit if k else first) for k, one in enumerate(value)]


_REQUIREMENTS: Mapping[str, str] = {
    "bool_type": "must be true or false",
    "dict_type": "must be a table of keys and values",
    "model_type": "must be a table of keys and values",
    "string_pattern_mismatch": "must be a word of letters, digits, _ and -",
    "string_type": "must be a text in quotes",
    "tuple_type": "must be a list in brackets",
}
"""What a value must be, by the type of error, where pydantic speaks of Python."""


PLACES: Mapping[str, str] = {
    **dict.fromkeys(OUTPUTS, "an output cannot be set"),
    **dict.fromkeys(PARAMETERS, "a parameter must be in [device]"),
    **dict.fromkeys(TUNABLES, "a tunable parameter must be in [device] or in [tuning]"),
    **dict.fromkeys((*INPUTS, *DEVIATIONS), "an input must be given by --set, or in [inputs]"),
    **dict.fromkeys(RunTable.model_fields, "must be in [run]"),
    **dict.fromkeys(SceneTable.model_fields, "must be above the first heading"),
}
"""The table to which a key belongs that was found in another table."""


AXIS = ("<values>", "<range>")
"""Tags of the two forms of an axis of a grid; like that of a constant input they are no keys."""


def _explanation(problem: ErrorDetails, content: Mapping[str, Any], top: type[BaseModel]) -> str:
    """Return key path, value and requirement of an error."""
    location = tuple(part for part in problem["loc"] if part not in ("constant", *AXIS))
    kind, value = problem["type"], problem["input"]
    wrong = problem["msg"].removeprefix("Value error, ")
    if not location:
        return wrong
    name, key = location[-1], _key_path(location, content)
    if wrong.startswith(f"{name} = "):
        return key.removesuffix(str(name)) + wrong
    fields = _fields_at(location, top)
    if kind == "extra_forbidden":
        if name in PLACES and top in (SceneTable, DeviceFileTable):
            return f"{key}: unknown key {name!r}; {PLACES[str(name)]}"
        return f"{key}: {unknown_name('key', str(name), map(str, fields))}"
    field = fields.get(name)
    example = toml_value(field.examples[0]) if field and field.examples else ""
    for over_time in {"steps", "ramp"} & {*location[:-1]}:
        pair = location[: location.index(over_time) + 2]
        return f"{_key_path(pair, content)}: must be a pair [time (s), value]"
    if kind == "missing":
        return f"{key}: is missing" + (f"; add {name} = {example}" if example else "")
    wrong = _REQUIREMENTS.get(kind, re.sub(r"^\w+ should", "must", wrong))
    wrong = re.sub(r"(items?) after validation", r"valid \1", wrong)
    if location == ("expect",):
        wrong = "must be a list of tables, each headed [[expect]]"
    elif kind == "model_type" and example:
        wrong = f"must be a table such as {example}"
    elif problem["loc"][-1] == "constant":
        wrong += ', or a table such as { steps = [[0, 0], [0.05, 0.04]] } or { csv = "load.csv" }'
    shown = "" if isinstance(value, dict) else f" = {value!r}"
    return f"{key}{shown}: {wrong}"


def _key_path(location: tuple[int | str, ...], content: Mapping[str, Any]) -> str:
    """Return the path of a key; an expectation goes by quantity and reference, if it has any."""
    parts = [f"[{part + 1}]" if isinstance(part, int) else f".{part}" for part in location]
    if len(location) > 1 and location[0] == "expect" and isinstance(location[1], int):
        expect = with_bundles(content)["expect"][location[1]]
        names = ("quantity", "reference") if isinstance(expect, Mapping) else ()
        known = [str(expect[key]) for key in names if key in expect]
        parts[1] = f"[{', '.join(known)}]" if known else parts[1]
    return "".join(parts).lstrip(".")


def _fields_at(location: tuple[int | str, ...], top: type[BaseModel]) -> dict[int | str, FieldInfo]:
    """Return the fields, by key, of the table that has the last key of a location."""
    model = top
    for part in location[:-1]:
        if part in model.model_fields:
            tables = _tables_in(model.model_fields[str(part)].annotation)
            if not tables:
                return {}  # below a mapping of names, such as [fixed] of a grid
            model = tables[-1]
    return {field.alias or name: field for name, field in model.model_fields.items()}


def _tables_in(annotation: Any) -> list[type[BaseModel]]:
    """Return the tables inside an annotation such as `RunTable | None`."""
    if isinstance(annotation, type) and issubclass(annotation, BaseModel):
        return [annotation]
    return [table for part in get_args(annotation) for table in _tables_in(part)]
