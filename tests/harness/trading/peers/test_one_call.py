"""One call of heyoka: the devices that it covers, and its cost."""

from __future__ import annotations

import pytest

from slider_resonator.trading.peer_methods import peer_methods
from slider_resonator.trading.peers.registry import peers
from tests.harness.trading.problems import RAMP, TABLE_1, problem


def test_one_call_of_heyoka_covers_no_inputs_that_vary() -> None:
    ramp = problem(RAMP)
    peer = next(peer for peer in peers(ramp) if peer.family == "heyoka at its fastest")
    with pytest.raises(ValueError, match="inputs vary"):
        peer.follow(ramp.device, ramp.lines(4), ramp.readings(4))


def test_being_led_into_motion_is_not_charged() -> None:
    short = problem(TABLE_1, max_periods=4)
    by_family = {method.label.family: method for method in peer_methods(short)}
    led = by_family["heyoka at its fastest"].run(4)
    assert led.start_cpu is not None
    assert led.start_cpu > 0.0
    assert by_family["Moreau-Jean"].run(4).start_cpu is None, "it starts by itself"
