from __future__ import annotations

import numpy as np
import pytest

from slider_resonator.references.averaged.slow_trajectory import slide_of_block

TIMES = np.linspace(0.0, 1.0, 11)


def test_it_slides_to_rest_and_stays() -> None:
    moved, velocity = slide_of_block(0.2, 0.3, 0.1, 1.0, TIMES)
    assert velocity == pytest.approx(np.maximum(0.0, 0.2 - 0.4 * TIMES))
    assert moved[-1] == pytest.approx(0.5 * 0.2**2 / 0.4)


def test_it_is_dragged_off_against_the_load() -> None:
    moved, velocity = slide_of_block(0.1, 0.3, 0.5, 2.0, TIMES)
    stop = 0.1 / 0.4
    assert velocity[-1] == pytest.approx(-0.1 * (1.0 - stop))
    assert moved[-1] == pytest.approx(0.5 * 0.1 * stop - 0.05 * (1.0 - stop) ** 2)


@pytest.mark.parametrize("load", [0.3, -0.2, 0.0])
def test_friction_holds_it_at_rest(load: float) -> None:
    moved, velocity = slide_of_block(0.0, 0.3, load, 1.0, TIMES)
    assert not moved.any()
    assert not velocity.any()


def test_a_strong_load_runs_away_with_it() -> None:
    _, velocity = slide_of_block(0.1, 0.3, -0.5, 1.0, TIMES)
    assert velocity == pytest.approx(0.1 + 0.2 * TIMES)
