"""The native FMU's memory, by the functions of its host: tables come when they are first needed."""

import math
from collections.abc import Iterator

import pytest
from fmpy.fmi1 import FMICallException

from tests.fmu.host import HostMemory, Instance, Unpacked
from tests.fmus import native_fmu_only

pytestmark = native_fmu_only

SMALL = 40_000
"""What an instance may take until it uses a table, in bytes."""


LUGRE = {"friction_law": 1, "averaging_order": 1}

Hosted = tuple[HostMemory, Instance, Instance]
"""Memory of a host, which it does not zero, an instance that takes it, and one that does not."""


@pytest.fixture
def hosted(unpacked: Unpacked) -> Iterator[Hosted]:
    memory = HostMemory()
    instance, other = Instance(unpacked, memory=memory), Instance(unpacked)
    yield memory, instance, other
    instance.free()
    other.free()
    assert memory.in_use == 0, "nothing is left behind"


@pytest.mark.parametrize("fidelity", [2, 1, 0])
def test_coulomb_friction_needs_little_memory(hosted: Hosted, fidelity: int) -> None:
    memory, instance, _ = hosted
    instance.initialize(fidelity=fidelity, averaging_order=1).step(0.01)
    assert 0 < memory.in_use <= SMALL


@pytest.mark.parametrize("fidelity", [2, 1, 0])
def test_tables_come_when_they_are_needed(hosted: Hosted, fidelity: int) -> None:
    memory, instance, other = hosted
    instance.enter_initialization(**LUGRE, fidelity=fidelity)
    assert 0 < memory.in_use <= SMALL
    instance.slave.exitInitializationMode()
    instance.step(0.01)
    other.initialize(**LUGRE, fidelity=fidelity).step(0.01)
    assert instance.get("velocity") == other.get("velocity") != (0.0,)
    taken = memory.in_use
    instance.slave.reset()
    instance.initialize(**LUGRE, fidelity=fidelity)
    assert memory.in_use == taken, "an instance keeps its tables"


@pytest.mark.parametrize("fidelity", [2, 0])
def test_without_memory_for_tables_a_call_is_refused(hosted: Hosted, fidelity: int) -> None:
    """It changes nothing: with memory the same call passes."""
    memory, instance, other = hosted
    memory.limit = memory.in_use + 1000
    instance.enter_initialization(**LUGRE, fidelity=fidelity)
    with pytest.raises(FMICallException):
        instance.slave.exitInitializationMode()
    assert instance.log == ["out of memory: the host gives none for tables of friction"]
    memory.limit = math.inf
    instance.slave.exitInitializationMode()
    instance.step(0.01)
    other.initialize(**LUGRE, fidelity=fidelity).step(0.01)
    assert instance.get("velocity") == other.get("velocity")
