from collections.abc import Iterator
from pathlib import Path

import pytest

from tests.fmu.host import Instance, Instantiate, Unpacked, unpack


@pytest.fixture(scope="session")
def unpacked(fmu: Path, tmp_path_factory: pytest.TempPathFactory) -> Unpacked:
    return unpack(fmu, tmp_path_factory.mktemp("unpacked"))


@pytest.fixture(scope="session")
def unpacked_3(native_3_fmu: Path, tmp_path_factory: pytest.TempPathFactory) -> Unpacked:
    """The native FMU of FMI 3.0."""
    return unpack(native_3_fmu, tmp_path_factory.mktemp("unpacked_3"))


@pytest.fixture
def instantiate(unpacked: Unpacked) -> Iterator[Instantiate]:
    """Makes instances that are not initialized yet, and frees them after the test."""
    made: list[Instance] = []

    def make() -> Instance:
        made.append(Instance(unpacked))
        return made[-1]

    yield make
    for instance in made:
        instance.free()


@pytest.fixture
def instance(instantiate: Instantiate) -> Instance:
    """One initialized instance with start values."""
    return instantiate().initialize()
