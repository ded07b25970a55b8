"""The picture of the closed loop: load, velocity, phase, and how far design and proof differ."""

from collections.abc import Callable, Sequence
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from slider_resonator.arrays import Array
from slider_resonator.output.plot_style import COLOURS, save, style
from studies.closed_loop.duty import Duty
from studies.closed_loop.judge import Agreement
from studies.closed_loop.loop import LoopRecord

DESIGN_COLOUR, PROOF_COLOUR = COLOURS["theory"], COLOURS["slow"]
BAND_COLOUR = "#d8e6ee"


def draw_loop(
    design: LoopRecord,
    proof: LoopRecord,
    duty: Duty,
    agreements: Sequence[Agreement],
    path: Path,
    title: str,
) -> None:
    """Draw both records of a host, and their difference with the predicted errors."""
    with style():
        figure = Figure(figsize=(8.0, 6.2), layout="constrained")
        figure.suptitle(title, fontsize=11)
        ratios = {"height_ratios": [0.6, 1.5, 1.0, 1.0]}
        load, velocity, phase, difference = figure.subplots(4, 1, sharex=True, gridspec_kw=ratios)
        _draw_load(load, duty)
        _draw_velocity(velocity, design, proof, duty)
        _draw_phase(phase, design, proof)
        _draw_difference(difference, design, proof, duty, agreements)
        difference.set(xlabel="time [s]", xlim=(0.0, duty.end))
        save(figure, path)


def _draw_load(axes: Axes, duty: Duty) -> None:
    starts = [interval.start for interval in duty.intervals]
    loads = [1e3 * interval.load for interval in duty.intervals]
    axes.step([*starts, duty.end], [*loads, loads[-1]], where="post", color="0.25")
    axes.set_ylabel("load [mN]")


def _draw_velocity(axes: Axes, design: LoopRecord, proof: LoopRecord, duty: Duty) -> None:
    reference = 1e3 * duty.reference
    low, high = (1.0 - duty.band) * reference, (1.0 + duty.band) * reference
    label = f"{duty.band:.0%}, {duty.settling:g} s after each step"
    for interval in duty.intervals:
        since = [interval.start + duty.settling, interval.end]
        axes.fill_between(since, low, high, color=BAND_COLOUR, linewidth=0.0, label=label)
        label = ""
    _plot_both(axes, design, proof, lambda record: 1e3 * record.velocity)
    axes.set(ylabel="mean velocity [mm/s]", ylim=(0.86 * reference, 1.12 * reference))
    axes.legend(loc="lower right", ncols=3)


def _draw_phase(axes: Axes, design: LoopRecord, proof: LoopRecord) -> None:
    _plot_both(axes, design, proof, lambda record: record.phase)
    axes.set_ylabel("phase [rad]")


def _plot_both(
    axes: Axes, design: LoopRecord, proof: LoopRecord, signal: Callable[[LoopRecord], Array]
) -> None:
    for record, colour, dash in ((proof, PROOF_COLOUR, "-"), (design, DESIGN_COLOUR, "--")):
        label = f"fidelity {record.fidelity}"
        axes.plot(record.times, signal(record), dash, color=colour, label=label)


def _draw_difference(
    axes: Axes, design: LoopRecord, proof: LoopRecord, duty: Duty, agreements: Sequence[Agreement]
) -> None:
    counts = design.times > duty.load_steps[0].start
    difference = 1e6 * np.abs(design.velocity - proof.velocity)[counts]
    axes.plot(design.times[counts], difference, color="0.25", label="between the fidelities")
    label = "predicted by choose"
    for interval, agreement in zip(duty.load_steps, agreements, strict=True):
        if agreement.predicted is not None:
            since, error = (interval.start, interval.end), 1e6 * agreement.predicted
            axes.plot(since, (error, error), color=DESIGN_COLOUR, linewidth=1.0, label=label)
            label = ""
    axes.set(ylabel="difference [um/s]")
    axes.set_ylim(0.0, 1.45 * axes.get_ylim()[1])
    axes.legend(loc="upper right", ncols=2)
