"""The code of those recipes whose hosts install here, run as it stands there."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

RECIPES = Path(__file__).parents[2] / "docs" / "recipes"

pytestmark = pytest.mark.interop


@pytest.mark.parametrize("host", ["ecos", "libcosim"])
def test_documented_code_prints_the_documented_output(
    host: str, native_fmu: Path, tmp_path: Path
) -> None:
    (code,) = re.findall(
        r"```python\n(.*?)```", (RECIPES / f"{host}.md").read_text(encoding="utf-8"), re.DOTALL
    )
    (tmp_path / "dist").mkdir()
    shutil.copy(native_fmu, tmp_path / "dist")
    done = subprocess.run(
        [sys.executable, "-c", code],
        cwd=tmp_path,
        env={**os.environ, "LD_LIBRARY_PATH": f"{sys.prefix}/lib"},  # ecos needs the one of tbb
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    (expected,) = re.findall(r"^ *# (.*)$", code, re.MULTILINE)
    assert expected in done.stdout.splitlines()
