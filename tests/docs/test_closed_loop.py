"""The code in the documentation, run as it stands there."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

PAGE = Path(__file__).parents[2] / "docs" / "closed_loop.md"
CODE = re.findall(r"```python\n(.*?)```", PAGE.read_text(encoding="utf-8"), re.DOTALL)
FMPY, VARIED, LIBCOSIMPY, ECOS = CODE


@pytest.mark.parametrize(
    "code",
    [
        pytest.param(FMPY, id="fmpy"),
        pytest.param(VARIED, id="inputs-that-vary"),
        pytest.param(LIBCOSIMPY, id="libcosimpy", marks=pytest.mark.interop),
        pytest.param(ECOS, id="ecos", marks=pytest.mark.interop),
    ],
)
def test_documented_code_prints_the_documented_output(
    code: str, closed_loop_package: Path, tmp_path: Path
) -> None:
    (tmp_path / "dist").mkdir()
    shutil.copy(closed_loop_package, tmp_path / "dist")
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
    assert done.stdout.splitlines()[-1] == expected
