from dataclasses import replace
from math import pi
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from matplotlib.figure import Figure
from matplotlib.text import Text

from slider_resonator.fmu.instance import Instance
from slider_resonator.fmu.run import run
from slider_resonator.scenes import run_plots
from slider_resonator.scenes.run_plots import (
    plot_signals,
    run_figure,
    schedule_for_window,
    schedule_to_plot,
)
from slider_resonator.scenes.scene import Scene, scene_from
from slider_resonator.scenes.scene_files import find_scene
from tests.harness.scene_text import built_in


def test_lines_and_constant_inputs_are_named(instance: Instance) -> None:
    scene = find_scene("table_1", {"load": 0.05, "phase": 0.4})
    record = run(instance, scene.parameters, schedule_to_plot(scene))
    text = " ".join(one.get_text() for one in run_figure(record, scene).findobj(Text))
    assert "steady, for these inputs" in text
    assert "phase 22.92 deg, load 50 mN" in text
    assert "frequency_ratio" not in text, "it is at its start"
    scene = find_scene("table_1", {"load": 0.5})  # above the friction of both faces
    axes = run_figure(run(instance, scene.parameters, scene.schedule()), scene).axes[1]
    drawn = [line.get_label() for line in axes.get_lines()]
    assert drawn == ["mean velocity"], "no prediction where it is not valid"


def test_a_start_far_outside_does_not_set_the_axis(instance: Instance) -> None:
    scene = built_in()["table_1"]
    record = run(instance, scene.parameters, scene.schedule())
    spike = np.where(record.times < 0.02 * record.times[-1], 5.0, record["mean_velocity"])
    kicked = replace(record, outputs={**record.outputs, "mean_velocity": spike})
    axes = run_figure(kicked, scene).axes[1]
    assert axes.get_ylim()[1] < 0.2, "5 m/s is named, not drawn"
    words = axes.get_title("right")
    assert words == f"start beyond the axis: {spike.min():.3g} to 5"


WINDOW = (0.02, 0.04)


@pytest.fixture
def drawn(monkeypatch: pytest.MonkeyPatch) -> list[Figure]:
    """The figures, which are not rendered."""
    figures: list[Figure] = []

    def keep(figure: Figure, path: Path) -> None:
        figures.append(figure)
        path.write_text("drawn", encoding="utf-8")

    monkeypatch.setattr(run_plots, "save", keep)
    return figures


def scene_of_run(inputs: dict[str, Any], **run: float) -> Scene:
    return scene_from({"name": "long", "title": "long", "inputs": inputs, "run": run}, "long")


SCAN = {"frequency_deviation": {"ramp": [[0.0, -0.6], [1.0, 0.7]]}}
LONG = [
    *(scene_of_run({}, drive_periods=n, steps_per_period=0.07) for n in (60_000, 777.3, 121)),
    # Periods of another drive would show a beat, and a slow drive too low.
    scene_of_run(SCAN, stop_time=1.0, step_size=0.05),
]


@pytest.mark.parametrize("scene", LONG)
def test_whole_periods_of_a_long_vibration_are_drawn(scene: Scene) -> None:
    """Every n-th point of 60 000 periods would show a beat that the vibration does not have."""
    window = (0.0, float(scene.schedule().times[-1]))
    phase = scene.drive_periods.passed_by(schedule_for_window(scene, window).times)
    assert len(phase) < 40_000
    for share in np.linspace(0.0, 0.99, 100):
        drawn = np.sin(2.0 * pi * phase[phase >= share * phase[-1]][:130])
        assert (drawn.min(), drawn.max()) == pytest.approx((-1.0, 1.0), abs=2e-3)


def test_each_signal_has_a_panel(instance: Instance, tmp_path: Path, drawn: list[Figure]) -> None:
    scene = built_in()["changing_inputs"]
    record = run(instance, scene.parameters, schedule_for_window(scene, WINDOW))
    names = ("velocity", "load", "contact_mode")
    plot_signals([("a", record.table())], scene, names, WINDOW, tmp_path / "a.png")
    velocity, load, contact = drawn[0].axes
    assert velocity.get_ylabel() == "velocity\n[mm/s]"
    assert load.get_ylabel() == "load\n[mN]"
    assert contact.get_xlabel() == "time [ms]"
    assert [label.get_text() for label in contact.get_yticklabels()][1:3] == [
        "sticks",
        "slips forward",
    ]
    (line,) = velocity.get_lines()
    inside = (record.times >= WINDOW[0]) & (record.times <= WINDOW[1])
    assert np.array_equal(np.asarray(line.get_xdata()), 1e3 * record.times[inside])
    assert np.array_equal(np.asarray(line.get_ydata()), 1e3 * record["velocity"][inside])
    (legend,) = drawn[0].legends
    assert {text.get_text() for text in legend.get_texts()} == {"slips backward", "slips forward"}


def test_differences_are_drawn(instance: Instance, tmp_path: Path, drawn: list[Figure]) -> None:
    scene = built_in()["table_1"]
    records = []
    for fidelity in (2, 1):
        varied = scene.with_values({"fidelity": fidelity})
        records.append(run(instance, varied.parameters, schedule_for_window(varied, WINDOW)))
    runs = [("a", records[0].table()), ("b", records[1].table())]
    signals = ("mean_velocity", "phase", "contact_mode")
    plot_signals(runs, scene, signals, WINDOW, tmp_path / "a.png")
    labels = [axes.get_ylabel().split("\n")[0] for axes in drawn[0].axes]
    assert labels == ["mean velocity", "difference", "phase", "contact"]
    (line,) = drawn[0].axes[1].get_lines()
    inside = (records[0].times >= WINDOW[0]) & (records[0].times <= WINDOW[1])
    off = (records[1]["mean_velocity"] - records[0]["mean_velocity"])[inside]
    assert np.abs(off).max() > 1e-6
    factor = 1e3 if "mm/s" in drawn[0].axes[1].get_ylabel() else 1.0
    assert np.asarray(line.get_ydata()) == pytest.approx(factor * off)
