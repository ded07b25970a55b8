"""The notebook runs, with the FMU that these tests have built."""

from __future__ import annotations

import shutil
from pathlib import Path

import nbformat
import pytest
from nbclient import NotebookClient

from tests.processes import ROOT


@pytest.mark.slow
def test_every_cell_runs_and_finds_the_known_velocity(native_fmu: Path, tmp_path: Path) -> None:
    notebook = nbformat.read(ROOT / "docs" / "tutorial.ipynb", as_version=4)
    shutil.copy(native_fmu, tmp_path / "SliderResonator.fmu")
    preamble = (
        "from pathlib import Path\n"
        "from slider_resonator.fmu import finished\n"
        f"finished.FOLDERS = (Path({str(tmp_path)!r}),)"
    )
    notebook.cells.insert(0, nbformat.v4.new_code_cell(preamble))
    NotebookClient(notebook, timeout=120, kernel_name="python3").execute(cwd=str(tmp_path))
    printed = "".join(
        output.get("text", "")
        for cell in notebook.cells
        if cell.cell_type == "code"
        for output in cell.outputs
    )
    assert "steady 0.0986951 m/s" in printed
    assert "passed" in printed
