from __future__ import annotations

from pathlib import Path
from xml.etree import ElementTree as ET

from slider_resonator.checks.reports.junit import write_junit
from tests.harness.verdicts import BAD, BROKEN, GOOD


def test_each_check_is_a_test_case(tmp_path: Path) -> None:
    path = tmp_path / "report.xml"
    write_junit(path, [GOOD, BAD, BROKEN])
    root = ET.parse(path).getroot()
    counts = [[s.get(n) for n in ("name", "tests", "failures", "errors")] for s in root]
    assert counts == [
        ["good.fmu", "1", "0", "0"],
        ["bad.fmu", "3", "2", "0"],
        ["broken.fmu", "3", "1", "1"],
    ]
    assert [root.get(name) for name in ("tests", "failures", "errors")] == ["7", "3", "1"]
    for suite in root:
        assert suite.get("tests") == str(len(suite.findall("testcase")))
    names = [(case.get("classname"), case.get("name")) for case in root[1]]
    assert ("phase_sweep", "steady_velocity against located_events at phase 0.4") in names
    assert "from 0.0125 s on" in str(root[1].findall("testcase/failure")[1].get("message"))


def test_output_of_an_fmu_cannot_break_the_file(tmp_path: Path) -> None:
    path = tmp_path / "report.xml"
    write_junit(path, [BROKEN])
    (error,) = ET.parse(path).getroot().iter("error")
    assert error.get("message") == "the FMU crashed in fmi2DoStep: \ufffd | <b>"
