"""Draw docs/leap_error.png: what leaps err by, and what they cost, over the tolerance.

python docs/draw_leap_error.py [FMU [PICTURE]]
"""

import sys
from math import pi
from pathlib import Path
from time import perf_counter

import numpy as np
from matplotlib.figure import Figure
from matplotlib.layout_engine import ConstrainedLayoutEngine

from slider_resonator.device.device import Device
from slider_resonator.device.schedule import schedule
from slider_resonator.fmu.instance import Instance, instantiate
from slider_resonator.fmu.opening import open_fmu
from slider_resonator.fmu.run import run
from slider_resonator.output.plot_style import COLOURS, save, style
from slider_resonator.references.equivalent_force import equivalent_force

ROOT = Path(__file__).resolve().parents[1]
PERIOD = 2.0 * pi / Device().drive_frequency
LENGTHS = (300, 700, 1200, 2000, 3200, 5000)
"""Drive periods of the runs, each of one step: the slow velocity is compared at their ends."""
LONG = 11_000
TOLERANCES = 10.0 ** np.arange(-10.0, -3.5, 0.5)


def draw_leap_error(fmu_path: Path, path: Path) -> None:
    """Run table 1 from rest with the FMU and write the picture to `path`."""
    speed = equivalent_force(Device()).velocity_amplitude
    with open_fmu(fmu_path) as fmu, instantiate(fmu) as instance:
        resolved = [_after(instance, {"fidelity": 2}, length)[0] for length in LENGTHS]
        seconds = _seconds(instance, {"fidelity": 2})
        errors, estimates, costs = [], [], []
        for tolerance in TOLERANCES:
            values = {"fidelity": 0, "tolerance": tolerance}
            ends = [_after(instance, values, length) for length in LENGTHS]
            pairs = zip(ends, resolved, strict=True)
            errors.append(max(abs(end[0] - exact) for end, exact in pairs) / speed)
            estimates.append(max(end[1] for end in ends) / speed)
            costs.append(seconds / _seconds(instance, values))
    with style():
        figure = Figure(figsize=(8.0, 3.4), layout=ConstrainedLayoutEngine(w_pad=0.06))
        left, right = figure.subplots(1, 2)
        left.loglog(TOLERANCES, TOLERANCES, color="0.6", linestyle="--", label="tolerance")
        left.loglog(TOLERANCES, estimates, color=COLOURS["theory"], label="slow_motion_error")
        left.loglog(TOLERANCES, errors, color=COLOURS["slow"], marker="o", label="error")
        left.set(
            title="Table 1 from rest, largest over 5000 periods",
            xlabel="tolerance",
            ylabel="of the slow velocity, over the fast velocity",
        )
        left.legend()
        right.loglog(TOLERANCES, costs, color=COLOURS["slow"], marker="o")
        right.set(
            title=f"One step of {LONG} periods",
            xlabel="tolerance",
            ylabel="times faster than fidelity 2",
        )
        save(figure, path)


def _after(instance: Instance, values: dict[str, float], length: int) -> tuple[float, float]:
    """Return mean velocity and estimated error (m/s) after one step of `length` periods."""
    record = run(instance, values, schedule(length * PERIOD, length * PERIOD))
    return float(record["mean_velocity"][-1]), float(record["slow_motion_error"][-1])


def _seconds(instance: Instance, values: dict[str, float]) -> float:
    """Return the least time of some runs of `LONG` periods."""
    times = []
    for _ in range(5):
        begin = perf_counter()
        _after(instance, values, LONG)
        times.append(perf_counter() - begin)
    return min(times)


if __name__ == "__main__":
    given = [Path(argument) for argument in sys.argv[1:]]
    defaults = [ROOT / "dist" / "SliderResonator.fmu", ROOT / "docs" / "leap_error.png"]
    draw_leap_error(*given, *defaults[len(given) :])
