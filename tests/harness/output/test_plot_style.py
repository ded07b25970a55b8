from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure

from slider_resonator.output.plot_style import shade_directions


def test_each_interval_of_one_contact_mode_is_shaded_once() -> None:
    axes = Figure().subplots()
    modes = np.array([1.0, 1.0, -1.0, -1.0, -1.0, 2.0])
    entries = shade_directions(axes, np.arange(6.0), modes)
    assert len(axes.patches) == 3
    assert [entry.get_label() for entry in entries] == ["slips backward", "slips forward", "lifted"]
