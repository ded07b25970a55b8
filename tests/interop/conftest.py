from __future__ import annotations

from pathlib import Path

import pytest

from fmu_src.building.native_fmu import build_native
from fmu_src.building.platforms import HOST


@pytest.fixture(scope="session")
def native_fmu_for_wine(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The native FMU for this machine and for Windows."""
    return build_native(tmp_path_factory.mktemp("interop"), platforms=[HOST, "win64"])
