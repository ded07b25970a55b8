from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from matplotlib.image import imread

from slider_resonator.studies.picture import draw_picture


@pytest.mark.slow
def test_the_picture_fits_a_readme(native_fmu: Path, tmp_path: Path) -> None:
    path = tmp_path / "picture.png"
    draw_picture(native_fmu, path)
    picture = imread(path)
    assert picture.shape[1] == 1200
    assert np.ptp(picture[..., :3]) > 0.5, "something must be drawn"
