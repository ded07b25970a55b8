from __future__ import annotations

from types import SimpleNamespace
from typing import cast

import pytest
from fmpy.fmi1 import FMICallException

from slider_resonator.checks.conduct.refusals import Trial
from slider_resonator.fmu.instance import Instance


@pytest.mark.parametrize(
    ("function", "status"), [("fmi2DoStep", "fmi2Discard"), ("fmi3DoStep", "fmi3Discard")]
)
def test_a_discarded_call_is_a_fault_by_the_name_of_its_version(function: str, status: str) -> None:
    fmu = SimpleNamespace(variables={})
    instance = SimpleNamespace(messages=[], fmu=fmu, read=lambda names: {})
    trial = Trial(cast(Instance, instance), [])

    def discarded() -> None:
        raise FMICallException(function=function, status=2)

    trial.refuses("a step", discarded)
    assert trial.faults == [f"a step gives {status}, at which hosts end a run"]
