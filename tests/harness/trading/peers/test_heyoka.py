"""heyoka in one call, on motions without sticking."""

import pytest

from slider_resonator.trading.peer_methods import Peer, peer_answers, peer_methods
from tests.harness.trading.problems import RAMP, TABLE_1, problem


def in_one_call(text: str) -> Peer:
    methods = peer_methods(problem(text, max_periods=4))
    return next(method for method in methods if method.row.family == "heyoka at its fastest")


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        (RAMP, "inputs vary"),
        ("[device]\nnormal_amplitude = 1.5\n", "the contact lifts"),
        ("[device]\nresonator_mass = 0\n", "only full devices"),
        ("[device]\nbase_amplitude = 0\n", "the slider sticks"),
    ],
)
def test_what_it_does_not_cover_is_refused(text: str, reason: str) -> None:
    with pytest.raises(ValueError, match=reason):
        in_one_call(text).run(4)


def test_it_is_not_used_for_shooting_which_starts_at_rest_too() -> None:
    answers = {answer.row.family for answer in peer_answers(problem(TABLE_1))}
    assert "Moreau-Jean" in answers
    assert not any("at its fastest" in family for family in answers)


def test_being_led_into_motion_is_not_charged() -> None:
    _, led = in_one_call(TABLE_1).run(4)
    assert led.start_cpu is not None
    assert led.start_cpu > 0.0
    by_family = {m.row.family: m for m in peer_methods(problem(TABLE_1, max_periods=4))}
    assert by_family["Moreau-Jean"].run(4)[1].start_cpu is None, "it starts by itself"
