from __future__ import annotations

import json

from slider_resonator.checks.reports.json_report import validations_as_json
from tests.harness.verdicts import BAD, BROKEN, GOOD


def test_one_fmu_stands_alone_and_several_are_listed() -> None:
    alone = json.loads(validations_as_json([GOOD]))
    assert (alone["fmu"], alone["passed"], alone["exit_code"]) == ("good.fmu", True, 0)
    several = json.loads(validations_as_json([GOOD, BAD, BROKEN]))
    assert several["passed"] is False
    assert [fmu["exit_code"] for fmu in several["fmus"]] == [0, 1, 2]
    assert "crashed" in several["fmus"][2]["errors"][0]["reason"]


def test_a_check_is_reported_with_size_and_place() -> None:
    passed, _, signal = json.loads(validations_as_json([BAD]))["checks"]
    assert passed["verdict"] == "pass"
    assert signal["first_time"] == 0.0125
    assert signal["deviation"] == 3e-4
    assert "from 0.0125 s on" in signal["verdict"]
