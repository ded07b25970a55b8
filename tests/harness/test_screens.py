"""What is printed and written of scenes and verdicts: screens, reports, pages.

They are compared with the files in the folder `screens`.
"""

import hashlib
import json
import re
from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path
from xml.etree import ElementTree as ET

import numpy as np
import pytest
from rich.console import Console

import slider_resonator
from slider_resonator.checks.compare import Check, Curves
from slider_resonator.checks.reports import for_ci, html_report
from slider_resonator.checks.reports.html_report import MAX_UNFOLDED, write_html
from slider_resonator.checks.reports.terminal import MAX_SCENES, print_validation
from slider_resonator.checks.validate import NotApplied, Validation
from slider_resonator.checks.verdict import CALLED, measure_of, sentence, title
from slider_resonator.commands.reports import Reports, print_run_failures
from slider_resonator.commands.scenes import quantities_table, scenes_table
from slider_resonator.errors import HarnessError
from slider_resonator.fmu.provenance import identity_of
from slider_resonator.output.console import LOG_WIDTH
from slider_resonator.output.table import Table
from slider_resonator.output.terminal import show_table
from slider_resonator.scenes.vocabulary import QUANTITIES, REFERENCES
from tests.harness.golden import assert_as_before, assert_page_as_before, screen
from tests.harness.known_provenance import PROVENANCE
from tests.harness.scene_text import built_in, scene_of
from tests.harness.verdicts import (
    BAD,
    BOUND,
    BROKEN,
    CRASH,
    GOOD,
    LACKING,
    NONE,
    PASSED,
    SIGNAL,
    SLOWER,
    TIMES,
    WORD,
)
from tests.html_pages import Page

TABLE_1 = replace(PASSED, scene="table_1", at={}, against="located_events")
THEORY = replace(
    TABLE_1, against="closed_form", reference=0.1267305, deviation=6.4e-5, allowed=2.5e-4
)
FORCE = replace(
    TABLE_1, scene="blocking_force", quantity="blocking_force", unit="N", at={"phase": 0}
)
LONG = replace(
    TABLE_1, scene="table_1_high_frequency", quantity="predicted_blocking_force_in_run", unit="N"
)
CHECKS = (TABLE_1, THEORY, FORCE, LONG, replace(WORD, scene="pushed_at_rest"), NONE)
FARTHEST = replace(PASSED, deviation=1.2e-10, allowed=1.3e-07, at={"phase": 2.4083})
WIDEST = (
    replace(WORD, scene="table_1_high_frequency", fmu="load_above_friction", passed=True),
    replace(FARTHEST, quantity="predicted_blocking_force", unit="N", fmu=-1.2345678e-05),
    replace(FARTHEST, quantity="resonator_displacement", unit="m", fmu=0.00012345678),
)
HOSTILE = (replace(PASSED, fmu="\x1b[2Jstuck", passed=False), BOUND)
OF_FORCE = replace(PASSED, quantity="blocking_force", unit="N")
NOISE = replace(OF_FORCE, scene="scene_0", fmu=-0.0, reference=-1.7e-14)
FAR = replace(PASSED, deviation=1e-3, passed=False)
FARTHER = replace(OF_FORCE, deviation=1e-2, passed=False)
NEAR_ZERO = replace(SIGNAL, reference=0.0, scale=2e-6)
MODE = replace(SIGNAL, quantity="contact_mode", unit="1", deviation=0.25, allowed=0.0)
NO_REFERENCE = replace(SLOWER, reference=None, deviation=None, allowed=None)
NOTHING = Validation("old.fmu", (), 0.1, not_applied=(NotApplied("a", "position", "b", {}),))
RAMPS = tuple(NotApplied(f"ramp_{i}", "position", "needs ramps", {}) for i in range(5))


def numbered(count: int, *checks: Check) -> list[Check]:
    return [replace(one, scene=f"scene_{n}") for n in range(count) for one in checks]


def shown(table: Table) -> Callable[[Console], None]:
    return lambda console: show_table(console, table)


def validated(
    checks: Sequence[Check], *, details: bool = False, fmu: str = "dist/my.fmu"
) -> Callable[[Console], None]:
    return judged(Validation(fmu, tuple(checks), 1.5), details=details)


def judged(validation: Validation, *, details: bool = False) -> Callable[[Console], None]:
    return lambda console: print_validation(console, validation, details=details)


def some_scenes() -> Table:
    run = "[run]\nstop_time = 0.1\nstep_size = 0.01\n"
    sweep = "[sweep]\nvariable = 'load'\nvalues = [0, 1]\n"
    scenes = [scene_of(run), scene_of(sweep), scene_of(run)]
    names = ("table_1", "serialised_averaged_lugre_state", "pushed_at_rest")
    titles = (
        "The device of table 1",
        "A serialised state of averaged motion with LuGre friction goes on in another instance",
        "Pushed at rest",
    )
    return scenes_table(
        [replace(s, name=n, title=t) for s, n, t in zip(scenes, names, titles, strict=True)]
    )


SHOWN = {
    "validate": validated(CHECKS),
    "validate_details": validated(CHECKS, details=True),
    "scenes": shown(some_scenes()),
}
LOGGED = {
    "longest_rows": validated(WIDEST),
    "hostile_fmu": validated(HOSTILE, fmu="\x1b[31m[old].fmu"),
    "ten_scenes": validated([*numbered(9, PASSED), NOISE, replace(NONE, scene="scene_9")]),
    "many_pass": validated([replace(NONE, scene="bad"), *numbered(285, PASSED)]),
    "many_fail": validated(numbered(285, FAR, FARTHER)),
    "lacking": judged(LACKING),
    "lacking_much": judged(replace(LACKING, not_applied=RAMPS)),
    "lacking_details": judged(replace(LACKING, not_applied=RAMPS), details=True),
}


@pytest.mark.parametrize("width", [60, 80])
@pytest.mark.parametrize("name", SHOWN)
def test_screen(name: str, width: int) -> None:
    assert_as_before(f"{name}_{width}.txt", screen(SHOWN[name], width))


@pytest.mark.parametrize("name", LOGGED)
def test_log(name: str) -> None:
    assert_as_before(f"{name}.txt", screen(LOGGED[name], LOG_WIDTH))


def test_sentences_of_verdicts() -> None:
    checks = (SLOWER, BOUND, SIGNAL, MODE, NONE, NO_REFERENCE, WORD, NEAR_ZERO)
    lines = [f"{title(one)}: {sentence(one)} [{measure_of(one)}]\n" for one in checks]
    assert_as_before("sentences.txt", "".join(lines))
    assert set(CALLED) == set(REFERENCES)


def test_failed_runs(capsys: pytest.CaptureFixture[str]) -> None:
    hostile = replace(CRASH, scene="", reason="crashed\x1b[2J\n::stop-commands::all", at={})
    print_run_failures("my.fmu", [CRASH, hostile])
    assert_as_before("failed_runs.txt", capsys.readouterr().err)


def test_files_for_programs(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """JSON, JUnit and the summary of a job: all verdicts, what does not apply, hostile text."""
    monkeypatch.setattr(for_ci, "provenance_of_all", lambda _: PROVENANCE)
    validations = [GOOD, BAD, LACKING, BROKEN, NOTHING]
    paths = [tmp_path / name for name in ("report.json", "report.xml", "report.md")]
    paths[2].write_text("# Before\n")
    paths[0].write_text(for_ci.validations_as_json(validations) + "\n")
    for_ci.write_junit(paths[1], validations)
    for_ci.append_summary(paths[2], validations)
    for path in paths:
        assert_as_before(path.name, path.read_text(encoding="utf-8"))
    for_ci.append_summary(tmp_path / "flood.md", [replace(BAD, checks=(SLOWER,) * 500)])
    flood = (tmp_path / "flood.md").read_text()
    assert "and 450 more" in flood
    assert flood.count("steady_velocity") == 50


@pytest.mark.parametrize("width", [60, 120])
def test_no_name_is_cut(width: int) -> None:
    words = screen(shown(scenes_table([*built_in().values()])), width).split()
    assert built_in().keys() <= set(words)
    words = screen(shown(quantities_table()), width).replace(",", " ").split()
    assert {*QUANTITIES, *(name for q in QUANTITIES.values() for name in q.references)} <= {*words}
    checks = [
        replace(TABLE_1, scene=f"{name}_scene", quantity=name, unit=quantity.unit)
        for name, quantity in QUANTITIES.items()
        if quantity.kind == "number"
    ]
    for start in range(0, len(checks), MAX_SCENES):
        some = checks[start : start + MAX_SCENES]
        for details in (False, True):
            words = screen(validated(some, details=details), width).replace(",", " ").split()
            assert {name for check in some for name in (check.scene, check.quantity)} <= {*words}


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


def test_plots_show_the_fmu_on_the_reference_over_time_or_the_sweep(tmp_path: Path) -> None:
    """A start far outside does not set the axis, and is named."""
    times = np.array([0.0, 0.1, 0.2])
    overview = Curves(SIGNAL, times, 1.0 + times, 1.0 + 2.0 * times)
    passed = replace(SIGNAL, passed=True, first_time=None, worst_time=None)
    begun, far = replace(passed, scene="begun"), np.array([2.0, -1.0, 0.5])
    start = Curves(begun, np.array([0.0, 0.01, 0.2]), far, far)
    other = replace(PASSED, against="closed_form", reference=0.2)
    checks = (passed, begun, SLOWER, other, PASSED)
    validation = Validation("a.fmu", checks, 1.0, overviews=(overview, start))
    lines = [
        f"{plot['title']}: {plot['y']['label']} over {plot['x']['label']}\n"
        + (f"  range {plot['y']['range']}\n" if plot["y"]["range"] else "")
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
