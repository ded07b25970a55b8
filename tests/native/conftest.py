from pathlib import Path

import pytest

from tests.native.toolchain import Binary, unpacked_binary


@pytest.fixture(scope="session")
def product(native_fmu: Path, tmp_path_factory: pytest.TempPathFactory) -> Binary:
    """The binary that users get."""
    return unpacked_binary(native_fmu, tmp_path_factory.mktemp("product"))
