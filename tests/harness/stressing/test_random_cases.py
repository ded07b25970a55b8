from __future__ import annotations

from collections import Counter
from dataclasses import replace

import numpy as np
import pytest

from slider_resonator.fmu.instance import Instance
from slider_resonator.fmu.opening import Fmu
from slider_resonator.stressing import comparisons
from slider_resonator.stressing.observe import Observation, observe
from slider_resonator.stressing.random_cases import IN_TURN, random_case
from slider_resonator.stressing.run import judge, run_cases
from slider_resonator.stressing.verdict import FAILED, NO_REFERENCE, PASSED, SENSITIVE
from tests.fmus import both_fmus


@both_fmus
def test_the_first_cases_pass(fmu: Fmu) -> None:
    reported: list[tuple[str, float]] = []
    cases = [random_case(7, number) for number in range(2 * len(IN_TURN))]
    result = run_cases(fmu.path, cases, lambda label, share: reported.append((label, share)))
    assert result.passed, "\n".join(result.sentences())
    assert [share for _, share in reported] == sorted(share for _, share in reported)
    assert len(reported) == len(cases)
    assert reported[-1][0].startswith(f"{len(cases)} of {len(cases)}: ")
    assert {one.verdict for one in result.verdicts} == {PASSED}


def test_a_case_depends_on_seed_and_number_alone() -> None:
    one, same, other = random_case(3, 8), random_case(3, 8), random_case(4, 8)
    assert one == same
    assert one.parameters != other.parameters


def test_cases_cover_what_they_should() -> None:
    cases = [random_case(0, number) for number in range(600)]
    assert Counter(case.model for case in cases).most_common()[-1][1] == 600 // len(IN_TURN)
    drives = [case.device.drive_frequency for case in cases]
    assert max(drives) / min(drives) > 1e3
    assert len({name for case in cases for hold in case.holds for name, _ in hold.tuned}) == 6
    assert any(case.device.normal_amplitude > case.device.normal_preload for case in cases)
    assert any(case.start_time for case in cases)
    assert all((case.sizes > 0.0).all() for case in cases)
    assert (
        sum(len(one.sizes) > 1 and np.ptp(one.sizes) > 1e-3 * one.duration for one in cases) > 300
    )


@pytest.mark.parametrize("number", range(len(IN_TURN)))
def test_an_error_above_the_bound_fails(instance: Instance, number: int) -> None:
    case = random_case(7, number)
    seen = observe(instance, case)
    assert judge(case, seen).verdict == PASSED
    position = seen.outputs["position"]
    off = position + 1e-2 * max(float(np.abs(position).max()), 1e-9)
    verdict = judge(case, replace(seen, outputs={**seen.outputs, "position": off}))
    assert verdict.verdict == FAILED
    assert "reference: " in verdict.reason
    for name, signal in seen.outputs.items():
        no_number = {**seen.outputs, name: np.full_like(signal, np.nan)}
        assert judge(case, replace(seen, outputs=no_number)).verdict == FAILED


def test_a_motion_that_its_reference_leaves_as_fast_is_sensitive(
    instance: Instance, monkeypatch: pytest.MonkeyPatch
) -> None:
    case = random_case(7, 0)
    seen = observe(instance, case)
    wrong = replace(seen, outputs={name: 1.001 * one for name, one in seen.outputs.items()})
    assert judge(case, wrong).verdict == FAILED
    monkeypatch.setattr(comparisons, "CONDITIONING", 1e12)
    assert judge(case, wrong).verdict == SENSITIVE


def test_a_device_without_reference_is_not_judged() -> None:
    case = random_case(7, 2)
    w = case.device.drive_frequency
    undamped = {"damping_ratio": 0.0, "resonator_mass": 0.0, "resonator_frequency": w}
    still = replace(
        case,
        parameters={**case.parameters, **undamped},
        holds=tuple(replace(hold, tuned=()) for hold in case.holds),
    )
    assert judge(still, Observation()).verdict == NO_REFERENCE
