from __future__ import annotations

from math import pi
from pathlib import Path

import numpy as np
import pytest
from matplotlib.figure import Figure

from slider_resonator.fmu.instance import Instance
from slider_resonator.fmu.run import run
from slider_resonator.output.plot_units import plot_unit
from slider_resonator.scenes import signals_plot
from slider_resonator.scenes.run_plot import run_figure, schedule_to_plot
from slider_resonator.scenes.scene_files import find_scene
from slider_resonator.scenes.signals_plot import Run, plot_signals


@pytest.mark.parametrize(
    ("unit", "peak", "expected"),
    [
        ("m", 9e-5, (1e6, "um")),
        ("m", -2e-4, (1e3, "mm")),
        ("m", 30.0, (1.0, "m")),
        ("m/s", 0.127, (1e3, "mm/s")),
        ("m/s", 12.0, (1.0, "m/s")),
        ("s", 0.2, (1e3, "ms")),
        ("s", 4.0, (1.0, "s")),
        ("N", 0.085, (1e3, "mN")),
        ("N", 0.6, (1.0, "N")),
        ("rad", 0.6, (180.0 / pi, "deg")),
        ("rad/s", 3500.0, (0.5 / pi, "Hz")),
        ("rad/s", 4e4 * pi, (5e-4 / pi, "kHz")),
        ("1", 1e-3, (1.0, "1")),
    ],
)
def test_the_unit_suits_the_peak(unit: str, peak: float, expected: tuple[float, str]) -> None:
    assert plot_unit(unit, np.array([0.0, peak])) == expected


def test_curves_of_one_panel_share_the_unit_of_the_largest() -> None:
    small, large = np.array([1e-5, -1e-6]), np.array([0.0, 0.01])
    assert plot_unit("m", small, large) == plot_unit("m", large)
    assert plot_unit("m", np.array([])) == (1e6, "um")


def test_one_run_and_several_are_drawn_in_the_same_units(
    instance: Instance, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    figures: list[Figure] = []
    monkeypatch.setattr(signals_plot, "save", lambda figure, path: figures.append(figure))
    scene = find_scene("table_1")
    record = run(instance, scene.parameters, schedule_to_plot(scene))
    figures.append(run_figure(record, scene))
    both, window = [Run("a", record), Run("b", record)], (0.0, float(record.times[-1]))
    signals = ("position", "mean_velocity", "velocity", "resonator_displacement")
    plot_signals(both, scene, signals, window, tmp_path / "both.png")
    single, several = figures

    def units(figure: Figure) -> list[str]:
        return [axes.get_ylabel().split("[")[-1] for axes in figure.axes[:4]]

    assert units(single) == units(several)
    assert single.axes[1].get_xlabel() == several.axes[-1].get_xlabel() == "time [ms]"
