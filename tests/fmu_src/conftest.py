from __future__ import annotations

import pytest

from tests.fmu_src.native_orbits import NativeOrbits, compiled_orbits


@pytest.fixture(scope="session")
def native_orbits(tmp_path_factory: pytest.TempPathFactory) -> NativeOrbits:
    return compiled_orbits(tmp_path_factory.mktemp("orbits"))
