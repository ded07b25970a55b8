"""The documentation site builds without a warning, and shows what it promises."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest

from tests.processes import ROOT, run_command


@pytest.mark.slow
def test_the_site_builds_without_a_warning(tmp_path: Path) -> None:
    done = run_command(sys.executable, "-m", "sphinx", "-q", "-W", ROOT / "docs", tmp_path)
    assert (done.returncode, done.stderr) == (0, "")
    reference = (tmp_path / "reference.html").read_text(encoding="utf-8")
    for name in ("open_fmu", "OpenFmu.steady", "Record.final", "validate"):
        assert f'.{name}"' in reference, name
