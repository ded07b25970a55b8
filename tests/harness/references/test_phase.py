from __future__ import annotations

import math
from fractions import Fraction

from slider_resonator.references.phase import Elapsed, advanced


def test_angle_stays_within_half_a_turn_and_keeps_its_value() -> None:
    for increment in (0.1, 3.0, 100.0, -7.0):
        angle = advanced(3.0, increment)
        assert abs(angle) <= math.pi * (1.0 + 1e-15), "reduced"
        assert math.isclose(math.sin(angle), math.sin(3.0 + increment), abs_tol=1e-14), "the same"


def test_many_steps_lose_no_digits() -> None:
    turn = Fraction(2.0 * math.pi) + Fraction(2.4492935982947064e-16)
    angle, plain = 0.0, 0.0
    for _ in range(100_000):
        angle = advanced(angle, 0.37)
        plain += 0.37
    exact = 100_000 * Fraction(0.37)
    exact -= round(exact / turn) * turn
    assert abs(Fraction(angle) - exact) < 1e-11, "rounding of single steps is all that adds up"
    assert abs(math.remainder(plain, 2.0 * math.pi) - exact) > 1e-10, "a plain sum is far worse"


def test_elapsed_time_keeps_the_rounding_of_its_steps() -> None:
    elapsed = Elapsed()
    for _ in range(100_000):
        elapsed.add(1e-3 / 3.0)
    exact = 100_000 * Fraction(1e-3 / 3.0)
    found = Fraction(elapsed.seconds) + Fraction(elapsed.carry)
    assert abs(found - exact) < Fraction(1e-17), "a plain sum is off by 1e-11 here"
