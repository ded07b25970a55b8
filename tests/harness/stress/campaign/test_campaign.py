from __future__ import annotations

from collections import Counter
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from slider_resonator.arrays import Array
from slider_resonator.checks.leap_error import CENTRE, CENTRE_VELOCITY
from slider_resonator.fmu.opening import Fmu
from slider_resonator.output.json_output import to_json
from slider_resonator.output.progress import no_progress
from slider_resonator.stress.campaign.campaign_run import Campaign, run_campaign
from slider_resonator.stress.campaign.expected import expected
from slider_resonator.stress.campaign.listing import as_plain, sentences
from slider_resonator.stress.campaign.random_case import MODELS, random_case
from slider_resonator.stress.campaign.second_order import of_second_order
from slider_resonator.stress.campaign.verdict import (
    FAILED,
    NO_REFERENCE,
    PASSED,
    REFUSED,
    CaseVerdict,
    judge,
)
from tests.fmus import both_fmus
from tests.harness.faulty_fmus import without_later_variables
from tests.harness.public_json import assert_public_keys

CASES = 2 * len(MODELS)
"""Two of each model, in about four seconds."""
CENTRE_SIGNALS = {"velocity": CENTRE_VELOCITY, "position": CENTRE}
"""What averages of second order are compared by."""


@both_fmus
def test_the_first_cases_pass(fmu: Fmu) -> None:
    reported: list[tuple[str, float]] = []
    cases = [random_case(7, number) for number in range(CASES)]
    campaign = run_campaign(fmu.path, cases, lambda label, share: reported.append((label, share)))
    assert campaign.passed, sentences(campaign)
    assert [share for _, share in reported] == sorted(share for _, share in reported)
    assert len(reported) == CASES
    assert reported[-1][0].startswith(f"{CASES} of {CASES}: ")
    assert all(verdict.found <= 1.0 for verdict in campaign.verdicts)


def test_an_fmu_without_second_order_runs_the_other_cases(native_fmu: Path, tmp_path: Path) -> None:
    older = without_later_variables(native_fmu, tmp_path / "older.fmu")
    cases = [random_case(7, number) for number in (0, 6, 7)]
    assert [case.second_order for case in cases] == [False, True, True]
    campaign = run_campaign(older, cases, no_progress)
    assert campaign.passed, sentences(campaign)
    assert [one.number for one in campaign.verdicts] == [0]


def test_a_case_depends_on_seed_and_number_alone() -> None:
    one, same, other = random_case(3, 8), random_case(3, 8), random_case(4, 8)
    assert one.parameters == same.parameters
    assert np.array_equal(one.schedule.times, same.schedule.times)
    assert one.parameters != other.parameters


def test_cases_cover_what_they_should() -> None:
    cases = [random_case(0, number) for number in range(600)]
    assert Counter(case.model for case in cases).most_common()[-1][1] == 600 // len(MODELS)
    drives = [case.device.drive_frequency for case in cases]
    assert max(drives) / min(drives) > 1e3
    tuned = {name for case in cases for name in case.schedule.tuning}
    assert len(tuned) == 6
    assert any(case.device.normal_amplitude > case.device.normal_preload for case in cases)
    assert any(case.schedule.start_time for case in cases)
    steps = [np.diff(case.schedule.times) for case in cases]
    assert all((size > 0.0).all() for size in steps)
    assert sum(len(size) > 1 and np.ptp(size) > 1e-3 * size.max() for size in steps) > 300


@pytest.mark.parametrize("number", range(len(MODELS)))
def test_an_error_above_the_bound_fails(number: int) -> None:
    case = random_case(7, number)
    wanted = expected(case)
    record: dict[str, Array] = {name: signal.copy() for name, signal in wanted.signals.items()}
    allowed_deviations = dict(wanted.allowed)
    if case.second_order:
        widened = of_second_order(case, wanted).allowed
        allowed_deviations = {
            "velocity": widened[CENTRE_VELOCITY],
            "position": widened[CENTRE],
        }
    assert judge(case, record).verdict == PASSED
    for name, allowed in allowed_deviations.items():
        off = record | {name: record[name] + 0.5 * allowed}
        assert judge(case, off).found == pytest.approx(0.5, rel=0.01), name
        off[name] = record[name] + 1e4 * allowed
        verdict = judge(case, off)
        assert verdict.verdict == FAILED, name
        compared = CENTRE_SIGNALS[name] if case.second_order else name
        assert verdict.signal == compared
        off[name] = np.full_like(record[name], np.nan)
        assert judge(case, off).verdict == FAILED


def test_a_device_without_reference_is_not_judged() -> None:
    case = random_case(7, 2)
    parameters = dict(case.parameters) | {"damping_ratio": 0.0, "resonator_mass": 0.0}
    w = parameters["drive_frequency"] = parameters["resonator_frequency"]
    schedule = replace(case.schedule, tuning={})
    still = replace(case, parameters=parameters, schedule=schedule)
    assert w > 0.0
    assert judge(still, {}).verdict == NO_REFERENCE


def test_campaigns_in_words_and_as_data() -> None:
    good = CaseVerdict(0, "Coulomb, fidelity 2", PASSED, 0.2, "position")
    bad = CaseVerdict(1, "Coulomb, fidelity 1", FAILED, 7.0, "velocity", "velocity off")
    refused = CaseVerdict(2, "Coulomb, fidelity 1", REFUSED, reason="load refused")
    campaign = Campaign("a.fmu", 5, (good, bad, refused), 1.0)
    assert not campaign.passed
    assert not Campaign("a.fmu", 5, (good,), 1.0, not_run=1).passed
    assert not Campaign("a.fmu", 5, (good, refused, refused), 1.0).passed
    assert Campaign("a.fmu", 5, (good, refused), 1.0).passed
    text = sentences(campaign, [random_case(5, 1)])
    assert "seed 5, 3 cases: 1 passed, 1 failed, 1 refused" in text
    assert "failed: case 1 (Coulomb, fidelity 1): velocity off" in text
    assert "drive_frequency = " in text
    plain = as_plain([campaign])
    assert plain["passed"] is False
    fmu = {"fmu": "", "guid": "", "sha256": "", "version": "", "generation_tool": ""}
    provenance = dict.fromkeys(("harness", "fmpy", "python", "platform", "cpu", "date"), "")
    assert_public_keys("campaign", to_json({"provenance": {"fmus": [fmu], **provenance}, **plain}))
