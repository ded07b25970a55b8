"""The record of a scene, which can be drawn."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from slider_resonator.fmu.record import Record
from slider_resonator.output.shown import Drawable
from slider_resonator.scenes.scene import Scene

if TYPE_CHECKING:
    from matplotlib.figure import Figure


@dataclass(frozen=True, repr=False)
class SceneRecord(Record, Drawable):
    """The record of a run of `scene`."""

    scene: Scene

    def figure(self) -> Figure:
        """Draw position and mean velocity over time, and inputs that vary.

        Where the communication points resolve them, the last drive periods follow in full.
        """
        # Imported here: drawing takes longer to load than most scenes to run.
        from slider_resonator.scenes.run_plot import run_figure

        return run_figure(self, self.scene)
