"""The event loop against solutions on paper, and both closed forms against each other."""

from __future__ import annotations

import math
from dataclasses import replace

import pytest

from fmu_src.python.slider_component import leg
from fmu_src.python.slider_component.contact import BACKWARD, FORWARD, LIFTED, STICK
from fmu_src.python.slider_component.device import Device, Inputs
from fmu_src.python.slider_component.first_zero import Watch, first_zero
from fmu_src.python.slider_component.held import hold
from fmu_src.python.slider_component.law import law_of
from fmu_src.python.slider_component.moment import Moment
from fmu_src.python.slider_component.motion import State
from fmu_src.python.slider_component.regular_slide import RegularSlide
from fmu_src.python.slider_component.split_slide import SplitSlide, split

TABLE_1 = Device()
BLOCK = Device(resonator_mass=0.0, base_amplitude=0.0, normal_amplitude=0.0)
"""A rigid block under constant normal load: friction 0.2 N on 1 kg."""


def begin(device: Device, inputs: Inputs | None = None, **state: float) -> Moment:
    values = {"velocity": 0.0, "displacement": 0.0, "rate": 0.0, **state}
    return law_of(device, inputs or Inputs()).start(State(**values), 0.0)


def run(device: Device, inputs: Inputs, moment: Moment, duration: float) -> Moment:
    return law_of(device, inputs).advance(moment, duration)


def test_block_slides_to_a_stop_and_stays() -> None:
    end = run(BLOCK, Inputs(), begin(BLOCK, velocity=0.1), 3.0)
    assert end.mode == STICK
    assert end.state.velocity == 0.0
    assert end.position == pytest.approx(0.1**2 / (2 * 0.2), rel=1e-14)
    assert end.event_age == pytest.approx(3.0 - 0.1 / 0.2, rel=1e-13)
    assert end.counts.sticks == 1
    assert end.counts.reversals == 0, "a stop into sticking is no reversal"


def test_overload_turns_the_block_back() -> None:
    end = run(BLOCK, Inputs(load=0.5), begin(BLOCK, Inputs(load=0.5), velocity=0.7), 2.0)
    turn = 0.7 / 0.7
    assert end.mode == BACKWARD
    assert end.counts == (BACKWARD, 1, 0)
    assert end.state.velocity == pytest.approx(-(0.5 - 0.2) * (2.0 - turn), rel=1e-13)
    assert end.position == pytest.approx(0.35 - 0.5 * 0.3 * (2.0 - turn) ** 2, rel=1e-13)


def test_load_below_the_limit_never_moves() -> None:
    inputs = Inputs(load=0.199999)
    end = run(BLOCK, inputs, begin(BLOCK, inputs), 100.0)
    assert (end.position, end.mode, end.counts) == (0.0, STICK, (0, 0, 0))


def test_load_at_the_limit_sticks_and_above_it_slides() -> None:
    at = Inputs(load=0.2)
    assert run(BLOCK, at, begin(BLOCK, at), 10.0).position == 0.0
    above = Inputs(load=0.2 * (1 + 1e-12))
    end = run(BLOCK, above, begin(BLOCK, above), 10.0)
    assert end.position == pytest.approx(-0.5 * (above.load - 0.2) * 100.0, rel=1e-6)


def test_flight_has_no_friction() -> None:
    """Normal load 0.5 + 1.5 sin(chi): lifted while sin(chi) < -1/3."""
    device = replace(BLOCK, normal_preload=0.5, normal_amplitude=1.5, drive_frequency=1.0)
    dip = math.asin(1.0 / 3.0)
    moment = run(device, Inputs(), begin(device, velocity=10.0), math.pi + dip + 0.1)
    assert moment.mode == LIFTED
    assert moment.event_age == pytest.approx(0.1, rel=1e-12)
    later = run(device, Inputs(), moment, 0.5)
    assert later.state.velocity == moment.state.velocity, "friction acted in flight"
    landed = run(device, Inputs(), later, math.pi - 2 * dip - 0.6 + 0.25)
    assert landed.mode == FORWARD
    assert landed.event_age == pytest.approx(0.25, rel=1e-12)
    loss = 0.2 * (0.5 * (math.pi + 2 * dip) + 2 * 1.5 * math.cos(dip))
    whole = run(device, Inputs(), begin(device, velocity=10.0), 2 * math.pi)
    assert 10.0 - whole.state.velocity == pytest.approx(loss, rel=1e-12), "impulse of one turn"


def test_free_pair_keeps_its_momentum() -> None:
    device = Device(friction_coefficient=0.0, base_amplitude=0.0, damping_ratio=0.0)
    moment = begin(device, velocity=0.3, displacement=1e-3, rate=-0.2)
    end = run(device, Inputs(), moment, 1.0)
    momentum = 1.1 * end.state.velocity + 0.1 * end.state.rate
    assert momentum == pytest.approx(1.1 * 0.3 - 0.1 * 0.2, rel=1e-12)


@pytest.mark.parametrize("ratio", [1.0, 3.0, 1.37, -1.0, 0.0])
@pytest.mark.parametrize("sign", [1, -1, 0])
@pytest.mark.parametrize("damping", [0.025, 0.05, 0.6])
def test_both_closed_forms_agree(ratio: float, sign: int, damping: float) -> None:
    device = replace(TABLE_1, damping_ratio=damping)
    held = hold(device, Inputs(phase=0.3, load=0.02, frequency_ratio=ratio))
    amplitudes = split(held.plant)
    assert amplitudes is not None, "this device is split"
    state = State(0.1 * sign, 2e-4, -1.1)
    fast = SplitSlide(amplitudes, sign, state, 1.0, 2.0, sign)
    slow = RegularSlide(held.plant, sign, state, 1.0, 2.0, sign)
    for t in (1e-7, 3e-4, 2e-3):
        assert fast.travel(t) == pytest.approx(slow.travel(t), abs=1e-17)
        for one, other in zip(fast.state(t), slow.state(t), strict=True):
            assert one == pytest.approx(other, rel=1e-12, abs=1e-14)
        for a, b in zip(fast.watches(t), slow.watches(t), strict=True):
            assert a.signal(t)[:2] == pytest.approx(b.signal(t)[:2], rel=1e-11, abs=1e-13)


def test_a_change_of_ratio_or_frequency_makes_no_jump() -> None:
    moment = run(TABLE_1, Inputs(), begin(TABLE_1), 0.0123)
    for device, inputs in (
        (TABLE_1, Inputs(frequency_ratio=2.6)),
        (replace(TABLE_1, drive_frequency=4100.0), Inputs()),
    ):
        after = run(device, inputs, moment, 1e-13)
        for name in ("theta", "psi", "position"):
            assert getattr(after, name) == pytest.approx(getattr(moment, name), abs=2e-9)
        assert after.state == pytest.approx(moment.state, abs=1e-8)


@pytest.mark.parametrize(
    ("device", "inputs"),
    [
        (
            Device(base_amplitude=0.0, normal_amplitude=1.7),
            Inputs(phase=-1.4695858455634698),
        ),
        (
            Device(base_amplitude=0.0, normal_preload=0.5),
            Inputs(phase=0.8829369919158161, frequency_ratio=1.611794191945882),
        ),
    ],
)
@pytest.mark.parametrize("parts", [1, 11, 50])
def test_a_lifting_contact_moves_nothing_at_rest(
    device: Device, inputs: Inputs, parts: int
) -> None:
    moment = begin(device, inputs)
    for _ in range(parts):
        moment = run(device, inputs, moment, 0.05 / parts)
    assert (moment.position, moment.counts.reversals) == (0.0, 0)


def test_a_massless_resonator_keeps_its_own_motion() -> None:
    light = replace(TABLE_1, resonator_mass=1e-12, tangential_force=3.0)
    none = replace(light, resonator_mass=0.0)
    ends = [
        run(d, Inputs(), begin(d, velocity=0.1, displacement=1e-3), 1e-3) for d in (light, none)
    ]
    for one, other in zip(ends[0].state, ends[1].state, strict=True):
        assert one == pytest.approx(other, rel=1e-9)


def test_work_is_bounded_by_the_motion(monkeypatch: pytest.MonkeyPatch) -> None:
    """Searches for a zero, per drive period: two while it moves, none where nothing can happen."""
    searches = []

    def counted(watch: Watch, limit: float, start: float = 0.0) -> float | None:
        searches.append(1)
        return first_zero(watch, limit, start)

    monkeypatch.setattr(leg, "first_zero", counted)
    period = math.tau / 3500.0
    run(TABLE_1, Inputs(), begin(TABLE_1), 100 * period)
    assert len(searches) <= 3 * 100
    searches.clear()
    still = replace(TABLE_1, base_amplitude=0.0)
    run(still, Inputs(), begin(still), 100 * period)
    assert searches == []


def test_frictionless_pair_keeps_the_momentum_of_its_drive() -> None:
    """At rest under a lifting contact at first: it must not stick where there is no friction."""
    device = Device(
        resonator_mass=0.5,
        resonator_frequency=30.0,
        damping_ratio=0.0,
        normal_preload=0.5,
        base_amplitude=0.001953125,
        drive_frequency=50.0,
        friction_coefficient=0.0,
    )
    end = run(device, Inputs(), begin(device), 3.3 * math.tau / 50.0)
    momentum = 1.5 * end.state.velocity + 0.5 * end.state.rate
    drive = 0.5 * 0.001953125 * 50.0 * (1.0 - math.cos(3.3 * math.tau))
    assert momentum == pytest.approx(drive, rel=1e-12)
