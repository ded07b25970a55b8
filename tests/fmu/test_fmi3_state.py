"""States of FMI 3.0: replay, and what is refused."""

from __future__ import annotations

from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.fmu.host import Unpacked
from tests.fmu.host_3 import Instance3, instance_3

STEP = 1e-3


@pytest.fixture
def instance(unpacked_3: Unpacked) -> Any:
    """An initialized instance in step mode, whose steps end at events."""
    with instance_3(unpacked_3) as made:
        yield made.initialize()


@pytest.mark.parametrize("position", range(0, 400, 37))
def test_a_damaged_state_is_refused(instance: Instance3, position: int) -> None:
    data = bytearray(instance.state())
    data[position] ^= 0x55
    with instance.refuses("FMU state refused"):
        instance.slave.deserializeFMUState(bytes(data))


def test_a_state_of_another_build_is_refused(instance: Instance3) -> None:
    data = bytearray(instance.state())
    data[8:44] = b"0" * 36
    with instance.refuses("FMU state refused: it is of another build"):
        instance.slave.deserializeFMUState(bytes(data))


@settings(max_examples=15)
@given(steps=st.lists(st.floats(1e-7, 4e-3), min_size=1, max_size=8))
def test_a_replay_gives_the_same_bits(unpacked_3: Unpacked, steps: list[float]) -> None:
    def go_on(instance: Instance3) -> list[object]:
        found: list[object] = []
        for size in steps:
            found.append(instance.step_to(instance.time + size))
        return [*found, instance.state()]

    with instance_3(unpacked_3) as instance:
        instance.initialize(phase=0.3, load=0.02)
        instance.step_to(STEP)
        data, time = instance.state(), instance.time
        first = go_on(instance)
        instance.restore(data)
        instance.time = time
        assert go_on(instance) == first
