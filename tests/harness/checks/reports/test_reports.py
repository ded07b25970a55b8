"""The page of a validation, and what all reports say."""

import hashlib
import json
import re
from dataclasses import replace
from pathlib import Path
from xml.etree import ElementTree as ET

import numpy as np
import pytest

import slider_resonator
from slider_resonator.checks.compare import Curves
from slider_resonator.checks.reports import html_report
from slider_resonator.checks.reports.html_report import MAX_UNFOLDED, write_html
from slider_resonator.checks.validate import Validation
from slider_resonator.commands.reports import Reports
from slider_resonator.errors import HarnessError
from slider_resonator.fmu.provenance import identity_of
from tests.harness.golden import assert_as_before, assert_page_as_before
from tests.harness.known_provenance import PROVENANCE
from tests.harness.verdicts import BAD, BROKEN, GOOD, LACKING, PASSED, SIGNAL, SLOWER, TIMES
from tests.html_pages import Page


def page(folder: Path, *validations: Validation) -> tuple[str, Page]:
    path = folder / "report.html"
    write_html(path, validations)
    text = path.read_text(encoding="utf-8")
    return text, Page(text)


def test_deviations_are_drawn(tmp_path: Path) -> None:
    _, read = page(tmp_path, BAD)
    plots = [one for one in read.plots if one["title"].startswith("position")]
    points = [len(one["series"][0]["x"]) for one in plots]
    assert points == [len(TIMES), 25 + 64], "the whole run and the part at the first deviation"
    assert plots[1]["title"].endswith("from 0.0125 s on")


def test_of_many_scenes_those_that_fail_are_unfolded(tmp_path: Path) -> None:
    good = [replace(PASSED, scene=f"scene_{number}") for number in range(MAX_UNFOLDED)]
    text, tags = page(tmp_path, Validation("bad.fmu", (*good, SLOWER), 1.0))
    assert re.findall(r'<details id="([^"]*)" open>', text) == ["scene-0-3"]
    assert tags.tags.count("details") == 4
    assert "<h3>phase_sweep</h3> 1 of 1 check failed" in text
    few, _ = page(tmp_path, Validation("good.fmu", tuple(good), 1.0))
    assert few.count('" open>') == MAX_UNFOLDED


def test_a_start_far_outside_does_not_set_the_axis_and_is_named(tmp_path: Path) -> None:
    times = np.linspace(0.0, 1.0, 101)
    velocity = 0.1 * (1.0 - np.exp(-5.0 * times))
    velocity[1:3] = 2.0, -1.0
    signal = replace(SIGNAL, quantity="mean_velocity_in_run", unit="m/s")
    overview = Curves(signal, times, velocity, velocity)
    passed = replace(SIGNAL, passed=True)
    text, read = page(tmp_path, Validation("good.fmu", (passed,), 1.0, overviews=(overview,)))
    low, high = read.plots[0]["y"]["range"]
    assert -0.02 < low < 0.0
    assert 0.1 < high < 0.12
    assert "start beyond the axis: -1 to 2" in text


def test_plots_show_the_fmu_on_the_reference_over_time_or_the_sweep(tmp_path: Path) -> None:
    times = np.array([0.0, 0.1, 0.2])
    overview = Curves(SIGNAL, times, 1.0 + times, 1.0 + 2.0 * times)
    passed = replace(SIGNAL, passed=True, first_time=None, worst_time=None)
    other = replace(PASSED, against="closed_form", reference=0.2)
    validation = Validation("a.fmu", (passed, SLOWER, other, PASSED), 1.0, overviews=(overview,))
    lines = [
        f"{plot['title']}: {plot['y']['label']} over {plot['x']['label']}\n"
        + "".join(f"  {one['label']}: {one['x']} {one['y']}\n" for one in plot["series"])
        for plot in page(tmp_path, validation)[1].plots
    ]
    assert_as_before("report_plots.txt", "".join(lines))


def test_page_of_every_kind_of_verdict(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Scenes that pass, fail, do not apply, could not be run, or have a hostile name."""
    monkeypatch.setattr(html_report, "provenance_of_all", lambda _: PROVENANCE)
    hostile = replace(GOOD, checks=(replace(PASSED, scene="<script>"), SLOWER))
    page(tmp_path, GOOD, BAD, hostile, LACKING, BROKEN)
    assert_page_as_before("report.html", tmp_path / "report.html")


def test_an_error_before_any_fmu_is_in_every_report(tmp_path: Path) -> None:
    junit, html, written, summary = (
        tmp_path / name for name in ("report.xml", "report.html", "report.json", "summary.md")
    )
    Reports("A title", junit, html, written, summary).write([], "my.fmu: corrupt")
    (error,) = ET.parse(junit).getroot().iter("error")
    assert error.get("message") == "my.fmu: corrupt"
    for page in (html, summary):
        assert "Could not run: my.fmu: corrupt" in page.read_text(encoding="utf-8")
    expected = {"schema_version": 1, "passed": False, "error": "my.fmu: corrupt"}
    document = json.loads(written.read_text())
    assert document.pop("provenance")["fmus"] == []
    assert document == expected
    paths = [tmp_path / name for name in ("a.xml", "a.html", "a.json", "none/summary.md")]
    with pytest.raises(HarnessError, match=r"GITHUB_STEP_SUMMARY .*cannot be written"):
        Reports("A title", *paths).write([], "my.fmu: corrupt")
    assert all(path.is_file() for path in paths[:-1]), "though the summary cannot be"


def test_every_report_says_what_it_judged(tmp_path: Path) -> None:
    fmu = tmp_path / "a.fmu"
    fmu.write_bytes(b"no archive, but a file")
    digest = hashlib.sha256(fmu.read_bytes()).hexdigest()
    judged = replace(GOOD, fmu=str(fmu), identity=identity_of(fmu))
    fmu.write_bytes(b"another file since")
    files = [tmp_path / name for name in ("report.xml", "report.html", "report.json", "summary.md")]
    Reports("A title", *files).write([judged])
    for file in files:
        text = file.read_text(encoding="utf-8")
        assert text.count(digest) == 1, file.name
        for name in ("fmpy", "harness", "platform"):
            assert name in text, file.name
        assert slider_resonator.__version__ in text, file.name
