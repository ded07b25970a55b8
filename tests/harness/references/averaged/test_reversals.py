from __future__ import annotations

import numpy as np
import pytest

from slider_resonator.references.averaged.reversals import sign_changes

TURN = 2.0 * np.pi


def test_roots_are_found_to_rounding_and_within_the_period() -> None:
    roots = sign_changes(lambda angle: 0.3 - np.cos(angle), TURN)
    assert roots == pytest.approx([np.arccos(0.3), TURN - np.arccos(0.3)], abs=1e-14)


@pytest.mark.parametrize("half_width", [1e-3, 1e-6])
@pytest.mark.parametrize("centre", [0.0, 1.2345])
@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_a_close_pair_of_roots_is_not_missed(half_width: float, centre: float, sign: float) -> None:
    level = np.cos(half_width)
    roots = sign_changes(lambda angle: sign * (level - np.cos(angle - centre)), TURN)
    exact = np.sort(np.array([centre - half_width, centre + half_width]) % TURN)
    assert roots == pytest.approx(exact, abs=1e-3 * half_width)


def test_a_function_that_only_comes_close_has_none() -> None:
    assert not len(sign_changes(lambda angle: 1.0 + 1e-12 - np.cos(angle - 0.7), TURN))
