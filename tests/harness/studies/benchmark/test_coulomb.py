"""The benchmark of Coulomb friction on the built FMUs: errors and counts, never seconds."""

from __future__ import annotations

from pathlib import Path

import pytest

from slider_resonator.errors import HarnessError
from slider_resonator.fmu.instance import instantiate
from slider_resonator.fmu.opening import open_fmu
from slider_resonator.studies.benchmark.coulomb import COMPARED, fmu_name, measure_coulomb


@pytest.mark.slow
def test_the_fmu_is_more_exact_than_its_peers(native_fmu: Path) -> None:
    with open_fmu(native_fmu) as fmu, instantiate(fmu) as instance:
        benchmark = measure_coulomb({"native": instance}, 1, lambda name, share: None)
    by_name = {cost.method: cost for cost in benchmark.costs}
    ours = by_name[fmu_name("native", COMPARED)]
    assert ours.velocity_error is not None
    assert ours.velocity_error < 1e-10
    assert ours.reversals == 2 * ours.periods, "two reversals in each drive period"
    heyoka = by_name["heyoka at its fastest"]
    assert heyoka.velocity_error is not None
    assert heyoka.velocity_error < 1e-10, "the peer is compared at an error of 1e-10"
    for cost in benchmark.costs:
        if cost.method.startswith("DOP853 on sgn"):
            assert cost.velocity_error is not None
            assert cost.velocity_error > 1000.0 * ours.velocity_error
    assert {r.against for r in benchmark.ratios} == {ours.method}


def test_a_missing_referee_is_said_in_words(monkeypatch: pytest.MonkeyPatch) -> None:
    def missing(*_: object, **__: object) -> None:
        raise ModuleNotFoundError("the Taylor reference needs heyoka")

    monkeypatch.setattr("slider_resonator.references.resolved.taylor.simulate", missing)
    with pytest.raises(HarnessError, match="needs heyoka"):
        measure_coulomb({}, 1, lambda name, share: None)
