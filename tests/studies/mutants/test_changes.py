from __future__ import annotations

from collections import Counter

import pytest

from fmu_src.building.c_sources import slider_sources
from slider_resonator.errors import HarnessError
from studies.mutants.changes import Change, hand_written_faults, harmless_variants

FAULTS, VARIANTS = hand_written_faults(), harmless_variants()
NO_FAULTS = {
    *("component/parameter_values.c", "component/variables.c"),
    *("fmi/fmi2_version.c", "device/budget.c"),
}
"""Sources that are generated, only name, or only choose between texts."""


@pytest.fixture(scope="module")
def sources() -> dict[str, str]:
    return slider_sources()


def test_each_change_fits_the_sources(sources: dict[str, str]) -> None:
    for change in (*FAULTS, *VARIANTS):
        assert change.applied(sources) != sources[change.file]
        assert change.meaning


def test_names_are_unique_and_faults_are_in_each_file(sources: dict[str, str]) -> None:
    names = Counter(change.name for change in (*FAULTS, *VARIANTS))
    assert [name for name, count in names.items() if count > 1] == []
    units = {name for name in sources if name.endswith(".c")} - NO_FAULTS
    assert units - {change.file for change in FAULTS} == set()


def test_a_text_that_is_gone_or_ambiguous_is_refused_by_name() -> None:
    change = Change("some_fault", "a.c", "x", "y", "nothing")
    with pytest.raises(HarnessError, match=r"some_fault: 'x' occurs 0 times in a\.c; must be once"):
        change.applied({"a.c": "z"})
    with pytest.raises(HarnessError, match=r"some_fault: 'x' occurs 2 times"):
        change.applied({"a.c": "x x"})
    with pytest.raises(HarnessError, match=r"some_fault: a\.c is not among the C sources"):
        change.applied({})
