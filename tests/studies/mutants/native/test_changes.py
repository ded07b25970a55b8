from __future__ import annotations

from collections import Counter

import pytest

from fmu_src.building.c_sources import slider_sources
from slider_resonator.errors import HarnessError
from studies.mutants.native.changes import (
    Change,
    hand_written_faults,
    harmless_variants,
)

FAULTS, VARIANTS = hand_written_faults(), harmless_variants()
SHELL = {
    *("fmi/fmi2_functions.c", "fmi/fmi2_model_exchange.c", "fmi/fmi2_state.c", "fmi/fmi2_steps.c"),
    "fmi/fmi2_derivatives.c",
    *(
        "fmi/fmi2_values.c",
        "fmi/fmi2_version.c",
        "fmi/instance.c",
        "fmi/state_access.c",
        "base/refusal.c",
        "device/budget.c",
    ),
    *("component/state_bytes.c", "component/values.c", "component/experiment.c"),
}
"""Sources without physics, and those that the build generates."""
FORWARDING = {
    "friction/friction_laws.c",
    "component/motions.c",
    "slide.c",
    "device/held.c",
    "component/parameter_values.c",
    "component/variables.c",
}
"""Sources that only choose between others, or are generated."""


@pytest.fixture(scope="module")
def sources() -> dict[str, str]:
    return slider_sources()


@pytest.mark.parametrize("change", [*FAULTS, *VARIANTS], ids=lambda change: change.name)
def test_each_change_fits_the_sources(change: Change, sources: dict[str, str]) -> None:
    assert change.applied(sources) != sources[change.file]
    assert change.meaning


def test_names_are_unique_and_there_are_enough() -> None:
    names = Counter(change.name for change in (*FAULTS, *VARIANTS))
    assert [name for name, count in names.items() if count > 1] == []
    assert len(FAULTS) >= 60
    assert len(VARIANTS) >= 8


def test_faults_are_in_every_module_with_physics(sources: dict[str, str]) -> None:
    modules = {name for name in sources if name.endswith(".c")} - SHELL - FORWARDING
    assert modules - {change.file for change in FAULTS} == set()


def test_a_text_that_is_gone_or_ambiguous_is_refused_by_name() -> None:
    change = Change("some_fault", "a.c", "x", "y", "nothing")
    with pytest.raises(HarnessError, match=r"some_fault: 'x' occurs 0 times in a\.c; must be once"):
        change.applied({"a.c": "z"})
    with pytest.raises(HarnessError, match=r"some_fault: 'x' occurs 2 times"):
        change.applied({"a.c": "x x"})
    with pytest.raises(HarnessError, match=r"some_fault: a\.c is not among the C sources"):
        change.applied({})
