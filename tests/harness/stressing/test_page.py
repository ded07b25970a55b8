from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from slider_resonator.device.model import Model
from slider_resonator.stressing.case import RANDOM, name_of
from slider_resonator.stressing.page import write_stress_page
from slider_resonator.stressing.run import StressResult
from slider_resonator.stressing.verdict import (
    FAILED,
    NO_REFERENCE,
    PASSED,
    REFERENCE,
    REFUSED,
    SENSITIVE,
    BoundCheck,
    Verdict,
)
from tests.harness.known_provenance import PROVENANCE
from tests.html_pages import Page, without_spans

RESOLVED, SLOW = name_of(Model(2, 0)), name_of(Model(0, 1, 2))
CHECKS = (BoundCheck("momentum", 1e-3), BoundCheck(REFERENCE, 0.5))
FAR = (BoundCheck(REFERENCE, float("inf"), "velocity off"),)
VERDICTS = (
    Verdict("q & r", "1e3", RESOLVED, PASSED, "", CHECKS, 1e-6, 1e-6),
    Verdict("q & r", "1e6", RESOLVED, FAILED, "it <flies>"),
    Verdict("q & r", "1e6", SLOW, REFUSED, "load refused"),
    Verdict(RANDOM, "seed 3, case 4", SLOW, SENSITIVE, "the reference departs", FAR),
    Verdict(RANDOM, "seed 3, case 5", SLOW, NO_REFERENCE, "gave up"),
)
RESULT = StressResult("some place/my.fmu", VERDICTS, 3.0)


def text_of(tmp_path: Path, *results: StressResult) -> str:
    page = tmp_path / "index.html"
    write_stress_page(page, results, PROVENANCE)
    found = Page.read(page)
    assert "provenance" in found.ids
    assert found.loaded == ["data:,"]
    return page.read_text(encoding="utf-8")


def test_each_case_of_an_axis_is_in_its_grid_with_its_checks(tmp_path: Path) -> None:
    text = text_of(tmp_path, RESULT)
    assert "reference: 0.5 of what is allowed\nmomentum: 0.001 of what is allowed" in text
    assert '">F</td>' in text
    assert '">r</td>' in text
    assert text.count("<td></td>") == 1, "the case that the axis does not have"
    assert "q &amp; r" in text
    assert "3 cases checked by momentum, reference; nearest to its bound: reference, 0.5" in text


def test_an_interrupted_run_without_failures_is_incomplete_and_has_not_failed(
    tmp_path: Path,
) -> None:
    so_far = replace(RESULT, verdicts=VERDICTS[::2], not_run=1)
    text = without_spans(text_of(tmp_path, so_far))
    assert "incomplete</td>" in text
    assert "FAIL" not in text
    assert "1 not run: incomplete" in text
    failed = without_spans(text_of(tmp_path, replace(RESULT, not_run=1)))
    assert "FAIL</td>" in failed, "a failure stands, whatever the rest would have been"


def test_cases_that_did_not_pass_are_listed_with_their_command(tmp_path: Path) -> None:
    text = text_of(tmp_path, RESULT)
    assert "it &lt;flies&gt;" in text
    assert "it <flies>" not in text
    assert without_spans(text).count("--case ") == 4
    expected = (
        "slider-resonator stress 'some place/my.fmu' --case 'q & r: 1e6: Coulomb, fidelity 2'"
    )
    assert VERDICTS[1].command(RESULT.fmu) == expected


def test_failed_cases_are_open_and_the_others_folded(tmp_path: Path) -> None:
    text = text_of(tmp_path, RESULT)
    assert '<details id="failed-my.fmu" open><summary><h3>Failed</h3> 1 case' in text
    assert '<details id="refused-by-name-my.fmu"><summary><h3>Refused by name</h3> 1 case' in text


def test_a_case_without_a_deviation_is_drawn_without_a_height(tmp_path: Path) -> None:
    text = text_of(tmp_path, RESULT)
    assert '"x":[2.0],"y":[null]' in text
    assert '"x":[3.0,4.0,5.0],"y":[null,1000000.0,null]' in text


def test_a_result_of_which_nothing_ran_has_a_page(tmp_path: Path) -> None:
    assert "not run" in text_of(tmp_path, StressResult("my.fmu", (), 0.0, 5))
