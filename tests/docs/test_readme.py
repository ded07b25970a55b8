"""The scripts of the README print what stands behind their lines."""

from __future__ import annotations

import os
import re
import sys
from pathlib import Path

from tests.processes import ROOT, run_command

TEXT = (ROOT / "README.md").read_text(encoding="utf-8")


def script(number: int) -> str:
    return str(re.findall(r"^```python\n(.*?)^```", TEXT, re.MULTILINE | re.DOTALL)[number])


def printed(code: str, folder: Path, native_fmu: Path) -> list[str]:
    (folder / "dist").symlink_to(native_fmu.parent)
    env = {**os.environ, "PYTHONPATH": str(ROOT / "harness")}
    done = run_command(sys.executable, "-c", code, cwd=folder, env=env)
    assert done.returncode == 0, done.stderr
    return done.stdout.splitlines()


def test_the_first_script_prints_what_it_says(native_fmu: Path, tmp_path: Path) -> None:
    code = script(0)
    said = re.findall(r"^print\(.*\)  # (.*)$", code, re.MULTILINE)
    assert len(said) == 2
    for line, end in zip(printed(code, tmp_path, native_fmu), said, strict=True):
        assert line.endswith(f" {end}")


def test_the_script_of_the_api_is_ten_lines_that_run(native_fmu: Path, tmp_path: Path) -> None:
    code = script(1).replace("sr.open_fmu()", f"sr.open_fmu({str(native_fmu)!r})")
    code = code.replace("sr.fmu_path()", repr(str(native_fmu)))
    assert len(code.splitlines()) <= 10
    _, run, steady = printed(code, tmp_path, native_fmu)
    assert run == "0.094666 m/s after 4 s"
    assert steady == "0.0986951 m/s in steady motion"
