from __future__ import annotations

import re
from collections.abc import Mapping
from pathlib import Path

import pytest

from fmu_src.c_header import C_SOURCES, CONTROLLER_SOURCES, c_table, controller_table
from fmu_src.python.slider_component.variables import VARIABLES


@pytest.mark.parametrize("name", c_table())
@pytest.mark.parametrize(
    ("folder", "table"), [(C_SOURCES, c_table()), (CONTROLLER_SOURCES, controller_table())]
)
def test_the_generated_file_is_current(folder: Path, table: Mapping[str, str], name: str) -> None:
    assert (folder / name).read_text() == table[name], (
        f"{folder / name} is old: `python -m fmu_src.c_header` writes it anew"
    )


def test_references_are_positions_in_the_table() -> None:
    found = re.findall(r"VR_(\w+) = (\d+),", c_table()["variables.h"])
    assert found == [(v.name.upper(), str(i)) for i, v in enumerate(VARIABLES)]


def test_bounds_read_back_exactly() -> None:
    rows = re.findall(
        r'\{"(\w+)", (true|false), (true|false), (\S+), (\S+), (\S+),\s+"', c_table()["variables.c"]
    )
    assert [r[0] for r in rows] == [v.name for v in VARIABLES]
    for variable, (_, integer, fixed, start, minimum, maximum) in zip(VARIABLES, rows, strict=True):
        assert integer == str(variable.type == "Integer").lower(), variable.name
        assert fixed == str(variable.variability == "fixed").lower(), variable.name
        assert float(start) == (variable.start or 0.0), variable.name
        for text, bound, absent in (
            (minimum, variable.minimum, "-INFINITY"),
            (maximum, variable.maximum, "INFINITY"),
        ):
            assert (text == absent) == (bound is None), variable.name
            assert bound is None or float(text) == bound, variable.name


def test_outputs_have_to_stand_last() -> None:
    with pytest.raises(ValueError, match="outputs have to stand behind the rest"):
        c_table(tuple(reversed(VARIABLES)))
