from __future__ import annotations

from dataclasses import replace

from slider_resonator.checks.compare import AT_LEAST, AT_MOST
from slider_resonator.checks.verdict import CALLED, called, measure_of, sentence, title
from slider_resonator.scenes.vocabulary import REFERENCES
from tests.harness.verdicts import BOUND, NONE, SIGNAL, SLOWER, WORD


def test_a_number_is_off_by_so_much() -> None:
    assert sentence(SLOWER) == (
        "the FMU gives 0.12 m/s, expected 0.126667 m/s: off by 0.0067 m/s, "
        "6.67e+04 times the allowed 1e-07"
    )
    assert title(SLOWER) == "steady_velocity against located_events at phase 0.4"


def test_the_sentence_of_a_bound_names_its_side() -> None:
    assert sentence(BOUND) == ("the FMU gives 120, expected at most 100: off by 20, must be 0")


def test_the_sentence_of_a_signal_names_the_times() -> None:
    assert sentence(SIGNAL) == (
        "off by 0.0003 of the peak, which is 0.0001 m, 3e+04 times the allowed 1e-08; "
        "from 0.0125 s on, most at 0.05 s"
    )


def test_a_contact_mode_differs_at_points() -> None:
    mode = replace(SIGNAL, quantity="contact_mode", unit="1", deviation=0.25, allowed=0.0)
    assert sentence(mode).startswith("differs at 25.00% of the points, must be 0; from 0.0125 s")


def test_the_sentence_of_a_value_that_does_not_exist() -> None:
    assert "gives none" in sentence(NONE)
    assert "no steady motion" in sentence(NONE)
    without = replace(SLOWER, reference=None, deviation=None, allowed=None)
    assert sentence(without) == "the FMU gives 0.12 m/s, the reference has none"
    assert sentence(WORD) == "the FMU gives 'steady', expected 'stuck'"


def test_tables_call_what_is_compared_with_by_words() -> None:
    assert set(CALLED) == {*REFERENCES, "value", AT_MOST, AT_LEAST}
    assert called("located_events") == "events"
    assert called("recorded_result") == "recorded result", "of other commands"


def test_a_deviation_is_a_share_or_has_a_unit() -> None:
    assert measure_of(SLOWER) == "m/s"
    assert measure_of(SIGNAL) == "of peak"
    assert measure_of(replace(SIGNAL, reference=1e-4, scale=1e-4)) == "of peak"
    assert measure_of(replace(SIGNAL, quantity="event_times")) == "periods"
    assert measure_of(replace(SIGNAL, quantity="contact_mode")) == "of points"
    assert measure_of(WORD) == ""


def test_where_the_reference_is_near_zero_the_deviation_has_its_unit() -> None:
    near_zero = replace(SIGNAL, reference=0.0, scale=2e-6)
    assert measure_of(near_zero) == "of scale"
    assert sentence(near_zero).startswith("off by 6e-10 m, where the peak is 0 m, ")
