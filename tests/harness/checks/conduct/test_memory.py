"""Memory that an FMU keeps is noticed."""

import ctypes
import gc
import sys
from collections.abc import Iterator

import pytest

from slider_resonator.checks.conduct.process import (
    OF_INSTANCE,
    OF_STATE,
    instance_leaks,
    state_leaks,
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
    assert [*state_leaks(instance), *instance_leaks(instance)] == []


@pytest.mark.parametrize(
    ("kind", "call", "allowed"),
    [("state", "getFMUstate", OF_STATE), ("instance", "freeInstance", OF_INSTANCE)],
)
def test_what_is_not_given_back_is_a_fault(
    instance: Instance, monkeypatch: pytest.MonkeyPatch, kind: str, call: str, allowed: float
) -> None:
    allocate = ctypes.CDLL(None).malloc
    allocate.argtypes, allocate.restype = [ctypes.c_size_t], ctypes.c_void_p
    own = getattr(type(instance.slave), call)

    def found(left: float) -> list[str]:
        def leaking(slave: object, *arguments: object) -> object:
            assert allocate(int(left))
            return own(slave, *arguments)

        monkeypatch.setattr(type(instance.slave), call, leaking)
        instance.start({})
        return [*{"state": state_leaks, "instance": instance_leaks}[kind](instance)]

    assert found(0.25 * allowed) == []
    (fault,) = found(4.0 * allowed)
    assert fault.startswith(f"each {kind} that is made and freed leaves ")
