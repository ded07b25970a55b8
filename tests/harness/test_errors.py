from __future__ import annotations

from slider_resonator.errors import unknown_name


def test_the_nearest_name_is_suggested_whatever_its_case() -> None:
    text = unknown_name("input", "Phse", ["phase", "load"])
    assert text == "unknown input 'Phse'; did you mean 'phase'? (must be one of load, phase)"


def test_nothing_is_suggested_for_a_name_unlike_any_other() -> None:
    assert "did you mean" not in unknown_name("input", "xyzzy", ["phase", "load"])
