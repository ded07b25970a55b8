"""The site builds, the notebook runs and the pictures are drawn."""

import shutil
import subprocess
import sys
from pathlib import Path

import nbformat
import numpy as np
import pytest
from matplotlib.image import imread
from nbclient import NotebookClient

from tests.processes import ROOT, run_command


@pytest.mark.slow
def test_the_site_builds_without_a_warning(tmp_path: Path) -> None:
    done = run_command(sys.executable, "-m", "sphinx", "-q", "-W", ROOT / "docs", tmp_path)
    assert (done.returncode, done.stderr) == (0, "")
    reference = (tmp_path / "reference.html").read_text(encoding="utf-8")
    for name in ("open_fmu", "OpenFmu.steady", "Record.final", "validate"):
        assert f'.{name}"' in reference, name


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


@pytest.mark.slow
@pytest.mark.parametrize("script", ["draw_picture.py", "draw_idea.py"])
def test_the_picture_fits_a_page(script: str, native_fmu: Path, tmp_path: Path) -> None:
    path = tmp_path / "picture.png"
    subprocess.run([sys.executable, ROOT / "docs" / script, native_fmu, path], check=True)
    picture = imread(path)
    assert picture.shape[1] == 1200
    assert np.ptp(picture[..., :3]) > 0.5, "something must be drawn"
