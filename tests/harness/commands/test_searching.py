from __future__ import annotations

import json

import pytest

from slider_resonator.commands.searching import tell
from slider_resonator.steady.search_result import SearchResult


def test_what_was_found_is_told_in_sentences(capsys: pytest.CaptureFixture[str]) -> None:
    outcome = SearchResult("steady", "stable", 0.5, 1, 40, 3, 1e-14, (0.9 + 0j, 0.1j), True)
    assert tell(outcome, "steady velocity", 0.25, "m/s", as_json=False) == 0
    said = capsys.readouterr().out.splitlines()
    assert said[0] == "steady velocity  0.25 m/s"
    assert said[1] == "status           steady: stable"
    assert said[2].startswith("averaged theory  0.5 m/s")
    assert "40 drive periods in 3 iterations" in said[3]
    assert said[4] == "multipliers      0.900000, 0.100000 (magnitudes)"


def test_finding_nothing_ends_with_1_and_says_so(capsys: pytest.CaptureFixture[str]) -> None:
    outcome = SearchResult("slow_beat", "no common period", 0.5)
    assert tell(outcome, "blocking force", None, "N", as_json=False) == 1
    said = capsys.readouterr().out
    assert said.startswith("blocking force   none\n")
    assert "cost" not in said, "nothing was run"
    assert tell(outcome, "blocking force", None, "N", as_json=True) == 1
    assert json.loads(capsys.readouterr().out)["status"] == "slow_beat"
