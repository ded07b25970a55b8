import ctypes

import pytest

from tests.fmu_src.native_bending import NativeBending
from tests.fmu_src.native_library import compiled_library


@pytest.fixture(scope="session")
def native_library(tmp_path_factory: pytest.TempPathFactory) -> ctypes.CDLL:
    return compiled_library(tmp_path_factory.mktemp("probes"))


@pytest.fixture(scope="session")
def native_bending(native_library: ctypes.CDLL) -> NativeBending:
    return NativeBending(native_library)
