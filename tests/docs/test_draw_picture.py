from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from matplotlib.image import imread

DOCS = Path(__file__).parents[2] / "docs"


@pytest.mark.slow
@pytest.mark.parametrize("script", ["draw_picture.py", "draw_idea.py"])
def test_the_picture_fits_a_page(script: str, native_fmu: Path, tmp_path: Path) -> None:
    path = tmp_path / "picture.png"
    subprocess.run([sys.executable, DOCS / script, native_fmu, path], check=True)
    picture = imread(path)
    assert picture.shape[1] == 1200
    assert np.ptp(picture[..., :3]) > 0.5, "something must be drawn"
