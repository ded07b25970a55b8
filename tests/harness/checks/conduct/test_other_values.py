from __future__ import annotations

import pytest

from slider_resonator.checks.conduct.findings import other_value
from slider_resonator.device.interface import VARIABLES

SETTABLE = [variable for variable in VARIABLES.values() if variable.start is not None]


@pytest.mark.parametrize("variable", SETTABLE, ids=lambda v: v.name)
def test_another_value_is_within_the_bounds(variable) -> None:  # type: ignore[no-untyped-def]
    for value in (variable.start, variable.minimum, variable.maximum):
        if value is None:
            continue
        other = other_value(variable.name, value)
        assert other != value or value == variable.maximum != variable.start
        assert variable.minimum is None or other >= variable.minimum
        assert variable.maximum is None or other <= variable.maximum
