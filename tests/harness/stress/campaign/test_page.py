from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from slider_resonator.stress.campaign.campaign_run import Campaign
from slider_resonator.stress.campaign.page import repeating, write_campaigns
from slider_resonator.stress.campaign.verdict import (
    FAILED,
    NO_REFERENCE,
    PASSED,
    REFUSED,
    SENSITIVE,
    CaseVerdict,
)
from tests.harness.known_provenance import PROVENANCE
from tests.html_pages import Page, without_spans

MODEL = "LuGre, fidelity 2"
VERDICTS = (
    CaseVerdict(0, MODEL, PASSED, 0.25, "velocity"),
    CaseVerdict(1, MODEL, FAILED, 40.0, "position", "position off by <b>4</b>"),
    CaseVerdict(2, MODEL, FAILED, float("inf"), "velocity", "velocity is not finite"),
    CaseVerdict(3, MODEL, FAILED, reason="crashed"),
    CaseVerdict(4, MODEL, REFUSED, reason="load = 1 refused"),
    CaseVerdict(5, MODEL, SENSITIVE, 2.0, "position", "the reference departs"),
    CaseVerdict(6, MODEL, NO_REFERENCE, reason="gave up"),
)
CAMPAIGN = Campaign("some place/my.fmu", 3, VERDICTS, 7.0)


def text_of(tmp_path: Path, *campaigns: Campaign) -> str:
    page = tmp_path / "campaign.html"
    write_campaigns(page, campaigns, PROVENANCE)
    found = Page.read(page)
    assert "provenance" in found.ids
    assert found.loaded == ["data:,"]
    return page.read_text(encoding="utf-8")


def test_cases_that_did_not_pass_are_listed_with_their_command(tmp_path: Path) -> None:
    text = text_of(tmp_path, CAMPAIGN)
    for one in VERDICTS[1:]:
        command = f"--seed 3 --case {one.number}</td>"
        assert command in without_spans(text), f"case {one.number} is not listed"
    assert "position off by &lt;b&gt;4&lt;/b&gt;" in text
    assert "<b>4" not in text


def test_an_interrupted_campaign_without_failures_is_incomplete(tmp_path: Path) -> None:
    so_far = Campaign("my.fmu", 3, VERDICTS[:1], 7.0, not_run=2)
    text = without_spans(text_of(tmp_path, so_far))
    assert "incomplete</td>" in text
    assert "FAIL" not in text
    failed = replace(so_far, verdicts=VERDICTS[:2])
    assert "FAIL</td>" in without_spans(text_of(tmp_path, failed))


def test_the_command_names_the_fmu_as_a_shell_reads_it() -> None:
    expected = "slider-resonator campaign 'some place/my.fmu' --seed 3 --case 4"
    assert repeating(CAMPAIGN, 4) == expected


@pytest.mark.parametrize("number", [2, 3, 4, 6])
def test_a_case_without_a_finite_error_is_drawn_without_a_height(
    tmp_path: Path, number: int
) -> None:
    chosen = Campaign("my.fmu", 1, (VERDICTS[0], VERDICTS[number]), 1.0)
    text = text_of(tmp_path, chosen)
    assert f'"x":[{float(number)}],"y":[null]' in text


def test_a_campaign_of_which_nothing_ran_has_a_page(tmp_path: Path) -> None:
    assert "not run" in text_of(tmp_path, Campaign("my.fmu", 1, (), 0.0, 5))
