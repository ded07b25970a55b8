from __future__ import annotations

from math import inf

from hypothesis import given
from hypothesis import strategies as st

from slider_resonator.choosing.ladder import coarsest


@given(st.integers(1, 30), st.floats(1e-8, 1e8), st.sampled_from([2.0, 10.0]), st.data())
def test_where_the_law_holds_the_coarsest_is_found_in_a_few_trials(
    count: int, scale: float, gain: float, data: st.DataObject
) -> None:
    evaluation: list[int] = []

    def excess(index: int) -> float:
        evaluation.append(index)
        return scale * gain**-index

    found = coarsest(excess, count, gain, first=data.draw(st.integers(0, count - 1)))
    good = [index for index in range(count) if scale * gain**-index <= 1.0]
    assert found == (good[0] if good else None)
    assert len(evaluation) <= 5


@given(st.lists(st.floats(0.0, 100.0), min_size=1, max_size=20), st.integers(0, 19))
def test_the_index_found_meets_the_need_and_the_next_coarser_does_not(
    errors: list[float], first: int
) -> None:
    found = coarsest(errors.__getitem__, len(errors), 2.0, min(first, len(errors) - 1))
    if found is not None:
        assert errors[found] <= 1.0
        assert found == 0 or errors[found - 1] > 1.0


def test_an_error_that_does_not_fall_is_given_up_at_once() -> None:
    evaluation: list[int] = []

    def excess(index: int) -> float:
        evaluation.append(index)
        return 50.0

    assert coarsest(excess, 100, 2.0) is None
    assert len(evaluation) == 3


def test_an_index_that_is_fine_enough_is_tried_before_the_search_gives_up() -> None:
    """Steps longer than an input takes to go up and down see none of it."""
    assert coarsest(lambda index: 3.0 if index < 7 else 0.5, 10, 2.0, fine=8) == 7
    assert coarsest(lambda _: 3.0, 10, 2.0, fine=8) is None


def test_a_candidate_that_cannot_run_is_refined() -> None:
    assert coarsest(lambda index: inf if index < 4 else 0.5, 10, 2.0) == 4
