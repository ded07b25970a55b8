"""What is printed and written of scenes and verdicts, against the files in the folder `screens`."""

import io
from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path

import pytest
from rich.console import Console

from slider_resonator.checks.compare import Check
from slider_resonator.checks.reports import for_ci
from slider_resonator.checks.reports.terminal import MAX_SCENES, print_validation
from slider_resonator.checks.validate import NotApplied, Validation
from slider_resonator.checks.verdict import CALLED, measure_of, sentence, title
from slider_resonator.commands.reports import print_run_failures
from slider_resonator.commands.scenes import quantities_table, scenes_table
from slider_resonator.output.console import LOG_WIDTH
from slider_resonator.output.table import Table
from slider_resonator.output.terminal import rendered
from slider_resonator.scenes.vocabulary import QUANTITIES, REFERENCES
from tests.harness.golden import assert_as_before
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
    WORD,
)

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


def screen(show: Callable[[Console], None], width: int) -> str:
    console = Console(
        file=io.StringIO(), width=width, force_terminal=True, color_system=None, highlight=False
    )
    show(console)
    assert isinstance(console.file, io.StringIO)
    return "".join(f"{line.rstrip()}\n" for line in console.file.getvalue().splitlines())


def shown(table: Table) -> Callable[[Console], None]:
    return lambda console: console.print(rendered(table))


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
    for_ci.write_json(paths[0], validations)
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
