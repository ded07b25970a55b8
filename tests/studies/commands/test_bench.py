from __future__ import annotations

import json
from pathlib import Path

import pytest

from studies.commands import bench
from studies.hosts.step_cost import LONG_STEP, ONE_PERIOD, StepCost
from tests.harness.calling import call, refused
from tests.harness.public_json import assert_public_keys


def test_costs_are_printed_and_returned_as_json(
    native_fmu: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    costs = (
        StepCost("resolved Coulomb, 1 ms", 4, 1.03, 1.01, 1.25),
        StepCost(ONE_PERIOD, 0, 0.7, 0.6, 0.9),
        StepCost(LONG_STEP, 0, 55.0, 50.0, 70.0),
    )
    monkeypatch.setattr(bench, "measure_steps", lambda *_: costs)
    text = call("bench", native_fmu).stdout
    assert "resolved Coulomb, 1 ms" in text
    assert "1.01-1.25" in text
    assert "1.20 times" in text
    printed = call("bench", native_fmu, "--json").stdout
    assert_public_keys("bench", printed)
    assert json.loads(printed)["c_host"][0] == vars(costs[0])


def test_an_fmu_that_needs_python_is_refused(python_fmu: Path) -> None:
    assert "needs a Python interpreter" in refused("bench", python_fmu)
