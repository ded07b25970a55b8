import numpy as np
import pytest

from slider_resonator.references.resolved.simulate import simulate
from slider_resonator.trading.peers import event_free
from tests.harness.references.comparing import assert_agree
from tests.harness.references.lugre_problems import PROBLEMS, STIFF, TIMES

QUICK = ("deep presliding", "schedule", "1e8, presliding")


@pytest.mark.parametrize(
    "name",
    [
        pytest.param(name, marks=() if name in QUICK else pytest.mark.slow)
        for name in [*PROBLEMS, *STIFF]
    ],
)
def test_scipy_agrees(name: str) -> None:
    device, held = (PROBLEMS | STIFF)[name]
    found = event_free.simulate(device, held, TIMES, rtol=1e-13, atol=1e-15)
    assert_agree(simulate(device, held, TIMES), found, allowed=1e-8)


@pytest.mark.parametrize("name", ["ratio 1.37, lift-off", "one face"])
def test_reversals_lift_offs_and_touchdowns_are_located(name: str) -> None:
    device, held = PROBLEMS[name]
    exact = simulate(device, held, TIMES)
    assert len(exact.event_times) > 4
    events = exact.event_times
    reverses = np.isin(events, exact.reversal_times)
    found, before, after = (
        event_free.simulate(device, held, events + late) for late in (0.0, -1e-9, 1e-9)
    )
    slow = 1e-9 * np.abs(np.gradient(exact.velocity, TIMES)).max()
    opens = (before.normal_force > 0.0) & (after.normal_force == 0.0)
    closes = (before.normal_force == 0.0) & (after.normal_force > 0.0)
    stops = ~(opens | closes)
    assert np.abs(found.velocity[stops]).max() < slow, "within 1e-9 s of a reversal"
    assert (before.velocity * after.velocity < 0.0).tolist() == stops.tolist()
    assert reverses[stops].all(), "all events but lift-offs and touchdowns are reversals"
    assert not reverses[opens].any()
    if not closes.any():  # else the slider turns in the air, too, and slides back from touchdown on
        assert found.reversals == exact.reversals
