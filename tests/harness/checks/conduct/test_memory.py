"""Memory that an FMU keeps is noticed."""

import ctypes
import gc
import sys
from collections.abc import Callable, Iterator

import pytest

from slider_resonator.checks.conduct.process import (
    OF_INSTANCE,
    OF_REFUSAL,
    OF_STATE,
    OF_STEP,
    instance_leaks,
    state_leaks,
    step_leaks,
)
from slider_resonator.fmu.instance import Instance

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="glibc counts what is allocated")


@pytest.fixture(autouse=True)
def frozen() -> Iterator[None]:
    """Leave out what other tests have made: going through it takes long, and may free some."""
    gc.collect()
    gc.freeze()
    yield
    gc.unfreeze()


def test_a_sound_fmu_gives_everything_back(instance: Instance) -> None:
    instance.start({})
    found = [*state_leaks(instance), *step_leaks(instance), *instance_leaks(instance)]
    assert found == []


@pytest.mark.parametrize(
    ("kind", "call", "allowed", "check"),
    [
        ("state", "getFMUstate", OF_STATE, state_leaks),
        ("instance", "freeInstance", OF_INSTANCE, instance_leaks),
        ("step", "call", OF_STEP, step_leaks),
        ("refusal", "call", OF_REFUSAL, step_leaks),
    ],
)
def test_what_is_not_given_back_is_a_fault(
    instance: Instance,
    monkeypatch: pytest.MonkeyPatch,
    kind: str,
    call: str,
    allowed: float,
    check: Callable[[Instance], Iterator[str]],
) -> None:
    allocate = ctypes.CDLL(None).malloc
    allocate.argtypes, allocate.restype = [ctypes.c_size_t], ctypes.c_void_p
    caller = Instance if call == "call" else type(instance.slave)
    own = getattr(caller, call)

    def leaking(slave: object, *arguments: object) -> object:
        assert allocate(int(4.0 * allowed))
        return own(slave, *arguments)

    instance.start({})
    monkeypatch.setattr(caller, call, leaking)
    assert any(fault.startswith(f"each {kind} leaves ") for fault in check(instance))
