from __future__ import annotations

from pathlib import Path

import pytest

from harness.commands import options
from harness.errors import FmuError


def test_the_fmu_built_here_is_preferred(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(options, "REPOSITORY", tmp_path / "repository")
    assert options.default_fmu(Path("given.fmu")) == Path("given.fmu")
    with pytest.raises(FmuError, match=r"python build_fmu\.py"):
        options.default_fmu(None)
    in_repository = tmp_path / "repository" / options.BUILT_FMU
    in_repository.parent.mkdir(parents=True)
    in_repository.touch()
    assert options.default_fmu(None) == in_repository
    options.BUILT_FMU.parent.mkdir()
    options.BUILT_FMU.touch()
    assert options.default_fmu(None) == options.BUILT_FMU
