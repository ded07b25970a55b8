"""Peers as methods: their names, their inputs, and which of them support shooting."""

from __future__ import annotations

from slider_resonator.trading.peer_methods import peer_answers, peer_methods
from tests.harness.trading.problems import LUGRE, TABLE_1, problem


def test_every_setting_has_a_name_of_its_own() -> None:
    for text in (TABLE_1, LUGRE):
        names = [method.label.name for method in peer_methods(problem(text))]
        assert len(set(names)) == len(names)


def test_peers_that_start_in_any_state_support_shooting() -> None:
    answers = {answer.label.family for answer in peer_answers(problem(TABLE_1))}
    assert "Moreau-Jean" in answers
    assert not any("at its fastest" in family for family in answers)
