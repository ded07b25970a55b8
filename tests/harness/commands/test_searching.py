from __future__ import annotations

import json

import pytest

from slider_resonator.commands.searching import print_search_result
from slider_resonator.steady.blocking_force import Blocking
from slider_resonator.steady.steady_velocity import SteadyMotion
from tests.harness.known_provenance import PROVENANCE


def test_a_result_is_reported_in_sentences(capsys: pytest.CaptureFixture[str]) -> None:
    multipliers = (0.9 + 0j, 0.1j)
    outcome = SteadyMotion("steady", "stable", 0.5, 1, 40, 3, 1e-14, multipliers, True, 0.25)
    assert print_search_result(outcome, False, PROVENANCE, {}) == 0
    lines = capsys.readouterr().out.splitlines()
    assert lines[0] == "steady velocity  0.25 m/s"
    assert lines[1] == "status           steady: stable"
    assert lines[2].startswith("FMU's output     0.5 m/s")
    assert "40 drive periods in 3 iterations" in lines[3]
    assert lines[4] == "multipliers      0.900000, 0.100000 (magnitudes)"


def test_no_result_is_reported_and_exits_with_1(capsys: pytest.CaptureFixture[str]) -> None:
    outcome = Blocking("slow_beat", "no common period", 0.5)
    assert print_search_result(outcome, False, PROVENANCE, {}) == 1
    lines = capsys.readouterr().out
    assert lines.startswith("blocking force   none\n")
    assert "cost" not in lines, "nothing was run"
    assert print_search_result(outcome, True, PROVENANCE, {}) == 1
    assert json.loads(capsys.readouterr().out)["status"] == "slow_beat"
