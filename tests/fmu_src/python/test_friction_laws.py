"""Each value of `friction_law` has its law in both twins, and no other value has one."""

from __future__ import annotations

import re

import pytest

from fmu_src.python.slider_component.friction_laws import FRICTION_LAWS, friction_law_of
from fmu_src.python.slider_component.refusal import Refusal
from fmu_src.python.slider_component.values import BY_NAME
from fmu_src.sources import C_SOURCES


def test_the_table_has_a_row_for_each_value() -> None:
    bounds = BY_NAME["friction_law"]
    assert (bounds.minimum, bounds.maximum) == (0, len(FRICTION_LAWS) - 1)
    assert [friction_law_of(number) for number in range(len(FRICTION_LAWS))] == list(FRICTION_LAWS)


@pytest.mark.parametrize("number", [-1, len(FRICTION_LAWS)])
def test_a_number_without_a_law_is_refused(number: int) -> None:
    with pytest.raises(Refusal, match=rf"friction_law = {number} refused: no law"):
        friction_law_of(number)


def test_the_twins_have_the_same_laws_in_the_same_order() -> None:
    names = [law.check.__module__.rpartition(".")[2].upper() for law in FRICTION_LAWS]
    source = (C_SOURCES / "friction_laws.c").read_text()
    (table,) = re.findall(r"FRICTION_LAWS\[\] = \{(.*)\};", source)
    assert table.replace("&", "").split(", ") == names
