from __future__ import annotations

from types import SimpleNamespace
from typing import cast

import pytest
from fmpy.fmi1 import FMICallException

from slider_resonator.checks.conduct.refusals import Trial
from slider_resonator.fmu.instance import Instance


@pytest.mark.parametrize(
    ("function", "number", "status"),
    [
        ("fmi2DoStep", 2, "fmi2Discard"),
        ("fmi3DoStep", 2, "fmi3Discard"),
        ("fmi2DoStep", 4, "fmi2Fatal"),
    ],
)
def test_a_status_that_ends_a_run_is_a_fault_by_the_name_of_its_version(
    function: str, number: int, status: str
) -> None:
    fmu = SimpleNamespace(variables={}, runs_without_python=True)
    instance = SimpleNamespace(messages=[], fmu=fmu, read=lambda names: {})
    trial = Trial(cast(Instance, instance), [])

    def refused() -> None:
        raise FMICallException(function=function, status=number)

    trial.refuses("a step", refused)
    assert trial.faults == [f"a step gives {status}, at which hosts end a run"]
