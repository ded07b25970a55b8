"""Memory that an FMU keeps is noticed, a few hundred bytes of it at a time."""

from __future__ import annotations

import ctypes
import sys

import pytest

from slider_resonator.checks.conduct.memory import ALLOWED, instance_leaks, state_leaks
from slider_resonator.fmu.instance import Instance

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="glibc counts what is allocated")


def test_a_sound_fmu_gives_everything_back(instance: Instance) -> None:
    instance.start({})
    assert [*state_leaks(instance), *instance_leaks(instance)] == []


@pytest.mark.parametrize(
    ("kind", "begin"), [("state", "getFMUstate"), ("instance", "freeInstance")]
)
def test_what_is_not_given_back_is_a_fault(
    instance: Instance, monkeypatch: pytest.MonkeyPatch, kind: str, begin: str
) -> None:
    allocate = ctypes.CDLL(None).malloc
    allocate.argtypes, allocate.restype = [ctypes.c_size_t], ctypes.c_void_p
    own = getattr(type(instance.slave), begin)

    def leaking(slave: object) -> object:
        assert allocate(int(2 * ALLOWED))
        return own(slave)

    monkeypatch.setattr(type(instance.slave), begin, leaking)
    instance.start({})
    (fault,) = {"state": state_leaks, "instance": instance_leaks}[kind](instance)
    assert fault.startswith(f"each {kind} that is made and freed leaves 5")
