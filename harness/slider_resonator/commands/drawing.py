"""What `run --plot` draws: signals, a window of time, further runs."""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial
from pathlib import Path

from slider_resonator.commands.options import setting
from slider_resonator.fmu.isolation.process import IsolatedFmu
from slider_resonator.fmu.record import Record
from slider_resonator.fmu.run import run
from slider_resonator.scenes.scene import Scene


def window_of(text: str) -> tuple[float, float]:
    """Return the two times (s) of FROM:TO; ValueError for another text."""
    begin, _, end = text.partition(":")
    try:
        return float(begin), float(end)
    except ValueError as error:
        raise ValueError(f"{text!r}: must be FROM:TO, two times in s, such as 0.1:0.11") from error


def overlay(text: str) -> tuple[str, float] | Path:
    """Return the setting NAME=VALUE, or the path of an FMU; ValueError for a wrong setting."""
    if "=" in text and not Path(text).is_file():
        return setting(text)
    return Path(text)


@dataclass(frozen=True)
class Drawing:
    """What `--plot` draws: signals, a window of time (s), and further runs."""

    signals: tuple[str, ...] | None = None
    window: tuple[float, float] | None = None
    overlays: tuple[tuple[str, float] | Path, ...] = ()

    @property
    def is_default(self) -> bool:
        """Whether nothing is chosen, so that the plot is that of `run_plot`."""
        return self == Drawing()


def check_drawing(scene: Scene, drawing: Drawing) -> None:
    """Raise HarnessError for signals that do not exist or a window outside the run."""
    # Imported here: drawing takes longer to load than the rest to run.
    from slider_resonator.scenes.signals_plot import check_signals, check_window

    check_signals(drawing.signals or (), scene)
    if drawing.window is not None:
        check_window(drawing.window, scene)


def draw_signals(
    isolated: IsolatedFmu,
    fmu: Path,
    scene: Scene,
    drawing: Drawing,
    path: Path,
    time_limit: float,
) -> None:
    """Run the scene, and again for each overlay, and draw; by default `SIGNALS` and the whole run.

    With an FMU among the overlays, differences are drawn, too.

    Raises HarnessError for a setting that the scene refuses, and as `IsolatedFmu` does.
    """
    from slider_resonator.scenes.signals_plot import SIGNALS, Run, plot_signals, schedule_for_window

    shown = drawing.window or (0.0, float(scene.schedule().times[-1]))

    def record(on: IsolatedFmu, varied: Scene) -> Record:
        interpolates = varied.schedule().interpolates and on.interpolates
        schedule = schedule_for_window(varied.interpolating(interpolates), shown)
        found: Record = on.run(partial(run, parameters=varied.parameters, schedule=schedule))
        return found

    runs = [Run(fmu.name, record(isolated, scene))]
    for overlay in drawing.overlays:
        if isinstance(overlay, Path):
            with IsolatedFmu(overlay, time_limit) as other:
                runs.append(Run(overlay.name, record(other, scene)))
        else:
            name, value = overlay
            varied = scene.with_values({name: value})
            runs.append(Run(f"{name} {value:g}", record(isolated, varied)))
    differences = any(isinstance(overlay, Path) for overlay in drawing.overlays)
    signals = drawing.signals or SIGNALS
    plot_signals(runs, scene, signals, shown, path, differences=differences)
