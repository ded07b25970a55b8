from __future__ import annotations

import json
from pathlib import Path

import pytest
from click.testing import CliRunner, Result

from slider_resonator.cli import main
from slider_resonator.commands import bench
from slider_resonator.trials.hosts.step_cost import StepCost


def call(*arguments: object) -> Result:
    return CliRunner().invoke(main, ["bench", *map(str, arguments)])


def test_costs_are_printed_and_returned_as_json(
    native_fmu: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    cost = StepCost("resolved Coulomb, 1 ms", 4, 1.03, 1.01, 1.25)
    monkeypatch.setattr(bench, "measure_steps", lambda *_: (cost,))
    text = call(native_fmu).stdout
    assert "resolved Coulomb, 1 ms" in text
    assert "1.01-1.25" in text
    (entry,) = json.loads(call(native_fmu, "--json").stdout)["c_host"]
    assert entry == vars(cost)


def test_an_fmu_that_needs_python_is_refused(python_fmu: Path) -> None:
    result = call(python_fmu)
    assert result.exit_code == 2
    assert "needs a Python interpreter" in result.stderr
