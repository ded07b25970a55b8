from __future__ import annotations

from io import StringIO
from pathlib import Path

import pytest
from rich.console import Console

from slider_resonator.output.json_output import to_json
from studies.mutants import listing
from studies.mutants.enumerate_source import source_mutants
from studies.mutants.listing import run_as_plain, summary
from studies.mutants.page import write_mutants
from studies.mutants.verdict import (
    EQUIVALENT,
    NOT_REACHED,
    REJECTED,
    SURVIVED,
    MutantVerdict,
    MutationRun,
)
from tests.harness.known_provenance import PROVENANCE
from tests.html_pages import Page

MUTANTS = source_mutants("a.py", "p/a.py", "def f(a, b):\n    return a < b * 2.0 + 1\n")
STATUSES = (REJECTED, REJECTED, REJECTED, SURVIVED, EQUIVALENT, NOT_REACHED)


@pytest.fixture
def run() -> MutationRun:
    pairs = zip(MUTANTS, STATUSES, strict=False)
    verdicts = [
        MutantVerdict(m, s, "because", *(("stuck", "velocity") if s == REJECTED else ()))
        for m, s in pairs
    ]
    return MutationRun("my.fmu", 100, 39, tuple(verdicts), 2.0)


def test_the_rate_counts_only_what_changes_a_result(run: MutationRun) -> None:
    assert run.rate == 0.75
    assert "rejected 3 of the 4 mutants that change a result: 75.00%" in summary(run)
    assert MutationRun("my.fmu", 1, 0, (), 0.0).rate is None


def test_counts_by_kind_and_what_rejects(run: MutationRun) -> None:
    assert run.tally("file")["a.py"] == run.counts
    assert sum(sum(counts.values()) for counts in run.tally("kind").values()) == len(run.verdicts)
    assert run.rejections() == [("stuck: velocity", 3)]


def test_plain_data_can_be_written_as_json(run: MutationRun) -> None:
    plain = run_as_plain(run)
    assert plain["counts"] == run.counts
    assert plain["mutants"][0]["diff"].startswith("--- a.py")
    assert to_json(plain)


def test_lines_of_the_terminal_fit_and_an_empty_table_is_left_out(
    run: MutationRun, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(listing, "terminal_width", lambda: 60)

    def printed(one: MutationRun) -> str:
        text = StringIO()
        listing.print_run(Console(file=text, width=60), one)
        return text.getvalue()

    lines = printed(run).splitlines()
    assert max(map(len, lines)) <= 60
    (at,) = (i for i, line in enumerate(lines) if line.startswith("equivalent "))
    assert lines[at + 1].startswith(" " * lines[at].index("1")), "under the text, not its label"
    assert "rejected first by" in printed(run)
    none = printed(MutationRun("my.fmu", 5, 1, tuple(run.having(SURVIVED)), 1.0))
    assert "rejected first by" not in none
    assert "1 probe," in none


def test_the_page_shows_each_survivor_with_diff_and_reason(
    run: MutationRun, tmp_path: Path
) -> None:
    write_mutants(tmp_path / "page.html", run, PROVENANCE)
    page = (tmp_path / "page.html").read_text()
    (survivor,) = run.having(SURVIVED)
    assert f"<details open><summary>{survivor.mutant.name}".replace("> b", "&gt; b") in page
    assert page.count("because") == 3, "rejected ones are counted, not listed"
    assert 'class="pass">+    return' in page
    assert Page(page).loaded == ["data:,"], "the page needs nothing beside it"
