"""The event loop against solutions on paper, and both closed forms against each other."""

from __future__ import annotations

import math
from dataclasses import replace

import pytest

from fmu_src.python.slider_component import events
from fmu_src.python.slider_component.component import motion_of
from fmu_src.python.slider_component.contact import BACKWARD, FORWARD, LIFTED, STICK
from fmu_src.python.slider_component.device import Device, System
from fmu_src.python.slider_component.first_zero import Watch, first_zero
from fmu_src.python.slider_component.moment import Moment
from fmu_src.python.slider_component.parameters import Inputs
from fmu_src.python.slider_component.series import Series
from fmu_src.python.slider_component.sliding import Rest, Segment, Slide
from tests.fmu_src.python.motions import BLOCK, PERIOD, TABLE_1, after


def test_block_slides_to_a_stop_and_stays() -> None:
    end = after(3.0, BLOCK, velocity=0.1)
    assert end.mode == STICK
    assert end.velocity == 0.0
    assert end.position == pytest.approx(0.1**2 / (2 * 0.2), rel=1e-14)
    assert end.event_age == pytest.approx(3.0 - 0.1 / 0.2, rel=1e-13)
    assert end.sticks == 1
    assert end.reversals == 0, "a stop into sticking is no reversal"


def test_overload_turns_the_block_back() -> None:
    end = after(2.0, BLOCK, Inputs(load=0.5), velocity=0.7)
    turn = 0.7 / 0.7
    assert end.mode == BACKWARD
    assert (end.sliding, end.reversals, end.sticks) == (BACKWARD, 1, 0)
    assert end.velocity == pytest.approx(-(0.5 - 0.2) * (2.0 - turn), rel=1e-13)
    assert end.position == pytest.approx(0.35 - 0.5 * 0.3 * (2.0 - turn) ** 2, rel=1e-13)


def test_load_at_the_limit_sticks_and_above_it_slides() -> None:
    assert after(10.0, BLOCK, Inputs(load=0.2)).position == 0.0
    above = 0.2 * (1 + 1e-12)
    end = after(10.0, BLOCK, Inputs(load=above))
    assert end.position == pytest.approx(-0.5 * (above - 0.2) * 100.0, rel=1e-6)


def test_flight_has_no_friction() -> None:
    """Normal load 0.5 + 1.5 sin(chi): lifted while sin(chi) < -1/3."""
    device = replace(BLOCK, normal_preload=0.5, normal_amplitude=1.5, drive_frequency=1.0)
    dip = math.asin(1.0 / 3.0)
    law = motion_of(device, Inputs())
    moment = after(math.pi + dip + 0.1, device, velocity=10.0)
    assert moment.mode == LIFTED
    assert moment.event_age == pytest.approx(0.1, rel=1e-12)
    later = law.advance(moment, 0.5)
    assert later.velocity == moment.velocity, "friction acted in flight"
    landed = law.advance(later, math.pi - 2 * dip - 0.6 + 0.25)
    assert landed.mode == FORWARD
    assert landed.event_age == pytest.approx(0.25, rel=1e-12)
    loss = 0.2 * (0.5 * (math.pi + 2 * dip) + 2 * 1.5 * math.cos(dip))
    whole = after(2 * math.pi, device, velocity=10.0)
    assert 10.0 - whole.velocity == pytest.approx(loss, rel=1e-12), "impulse of one turn"


@pytest.mark.parametrize("ratio", [1.0, 3.0, 1.37, -1.0, 0.0])
@pytest.mark.parametrize("mode", [FORWARD, BACKWARD, LIFTED, STICK])
@pytest.mark.parametrize("damping", [0.025, 0.6, 2.0])
def test_exponentials_and_series_agree(ratio: float, mode: int, damping: float) -> None:
    device = replace(TABLE_1, damping_ratio=damping, tangential_force=3.0)
    system = System(device, Inputs(phase=0.3, load=0.02, frequency_ratio=ratio))
    velocity = 0.1 * mode if mode != LIFTED else 0.1
    now = Moment(velocity, 2e-4, -1.1, 0.0, theta=1.0, psi=1.7, mode=mode)
    if mode == STICK:
        motions: tuple[Segment, ...] = (Rest(system, now), Series(system, now, 0, rests=True))
    else:
        direction = 0 if mode == LIFTED else mode
        motions = (Slide(system, now, direction), Series(system, now, direction))
    fast, slow = motions
    assert slow.reach > 1e-5
    for t in (1e-7, 0.5 * slow.reach, slow.reach):
        assert fast.at(t) == pytest.approx(slow.at(t), rel=1e-12, abs=1e-14)
        for a, b in zip(fast.watches(t), slow.watches(t), strict=True):
            value, slope, bound = a.signal(t)
            assert (value, slope) == pytest.approx(b.signal(t)[:2], rel=1e-11, abs=1e-9)
            before = a.signal(0.9 * t)[1]
            assert abs(slope - before) <= 1.001 * a.signal(0.9 * t)[2] * 0.1 * t + 1e-9 * bound


def test_a_change_of_ratio_or_frequency_makes_no_jump() -> None:
    moment = after(0.0123, TABLE_1)
    for device, inputs in (
        (TABLE_1, Inputs(frequency_ratio=2.6)),
        (replace(TABLE_1, drive_frequency=4100.0), Inputs()),
    ):
        tuned = motion_of(device, inputs).advance(moment, 1e-13)
        for name in ("theta", "psi", "position", "velocity", "displacement", "rate"):
            assert getattr(tuned, name) == pytest.approx(getattr(moment, name), abs=1e-8)


@pytest.mark.parametrize(
    ("device", "inputs"),
    [
        (Device(base_amplitude=0.0, normal_amplitude=1.7), Inputs(-1.4695858455634698)),
        (
            Device(base_amplitude=0.0, normal_preload=0.5),
            Inputs(0.8829369919158161, frequency_ratio=1.611794191945882),
        ),
    ],
)
@pytest.mark.parametrize("parts", [1, 11, 50])
def test_a_lifting_contact_moves_nothing_at_rest(
    device: Device, inputs: Inputs, parts: int
) -> None:
    moment = after(0.05, device, inputs, parts)
    assert (moment.position, moment.reversals) == (0.0, 0)


def test_work_is_bounded_by_the_motion(monkeypatch: pytest.MonkeyPatch) -> None:
    """Searches for a zero, per drive period: two while it moves, none where nothing can happen."""
    searches = []

    def counted(watch: Watch, limit: float) -> float | None:
        searches.append(1)
        return first_zero(watch, limit)

    monkeypatch.setattr(events, "first_zero", counted)
    after(100 * PERIOD, TABLE_1)
    assert len(searches) <= 3 * 100
    searches.clear()
    after(100 * PERIOD, replace(TABLE_1, base_amplitude=0.0))
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
    end = after(3.3 * math.tau / 50.0, device)
    momentum = 1.5 * end.velocity + 0.5 * end.rate
    drive = 0.5 * 0.001953125 * 50.0 * (1.0 - math.cos(3.3 * math.tau))
    assert momentum == pytest.approx(drive, rel=1e-12)
