"""The benchmark of LuGre friction on the built FMU: errors, and who is exact enough."""

from __future__ import annotations

from pathlib import Path

import pytest

from slider_resonator.fmu.instance import instantiate
from slider_resonator.fmu.opening import open_fmu
from slider_resonator.studies.benchmark.lugre import EQUAL_ERROR, Case, measure_lugre


@pytest.mark.slow
def test_costs_are_compared_at_equal_error(native_fmu: Path) -> None:
    case = Case(1e5, fmu_periods=20, periods=20, state_periods=2, cvode_periods=1)
    with open_fmu(native_fmu) as fmu, instantiate(fmu) as instance:
        benchmark = measure_lugre({"native": instance}, case, 1, lambda name, share: None)
    errors = {cost.method: cost.velocity_error or 0.0 for cost in benchmark.costs}
    compared = [r.method for r in benchmark.ratios] + [r.against for r in benchmark.ratios]
    assert any(name.startswith("heyoka, bristle from path") for name in compared)
    assert any(name.startswith("heyoka, bristle as state") for name in compared)
    for name in compared:
        assert errors[name] <= EQUAL_ERROR or name in {
            cost.method for cost in benchmark.most_exact_of_the_others
        }
