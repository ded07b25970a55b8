from __future__ import annotations

from pathlib import Path

import pytest

from harness.bench import bench
from harness.errors import HarnessError


@pytest.mark.slow
def test_the_fmu_is_cheaper_and_more_exact_than_the_paper_s_method(python_fmu: Path) -> None:
    benchmark = bench(python_fmu, repeats=1)
    by_name = {cost.method: cost for cost in benchmark.costs}
    fmu = by_name["FMU, steps of 10 periods"]
    assert fmu.velocity_error is not None
    assert fmu.velocity_error < 1e-9
    assert fmu.reversals == 1999, "two reversals in each of 1000 periods but the first"
    for cost in benchmark.costs:
        assert cost.fastest <= cost.microseconds <= cost.slowest
        if cost.method.startswith("DOP853 on sgn"):
            assert cost.velocity_error is not None
            assert cost.velocity_error > 1000.0 * fmu.velocity_error
            assert cost.microseconds > fmu.microseconds


def test_a_missing_referee_is_said_in_words(
    python_fmu: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def missing(*_: object, **__: object) -> None:
        raise ModuleNotFoundError("the Taylor reference needs heyoka")

    monkeypatch.setattr("harness.references.taylor.simulate", missing)
    with pytest.raises(HarnessError, match="needs heyoka"):
        bench(python_fmu, repeats=1)
