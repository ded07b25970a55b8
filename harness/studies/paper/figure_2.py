"""Figure 2: displacement from rest, Coulomb and LuGre, at a low and at a high frequency."""

from math import pi

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure as Drawing

from slider_resonator.arrays import Array
from slider_resonator.fmu.instance import Instance
from slider_resonator.references.averaged import uniform_average
from slider_resonator.references.averaged.averaged_motion import slow_trajectory
from slider_resonator.references.averaged.uniform_average import LugreCase
from studies.paper import labels, slow_theory
from studies.paper.figure import SHADES, Data, PaperFigure, markers, panels
from studies.paper.mapping import Values, coulomb_case, lugre_case
from studies.paper.measure import plain, record

STOP = 8.0
STRENGTH = 1.0
FREQUENCIES = (10.0, 1000.0)
STIFFNESS = 100.0
POINTS = {10.0: 320, 1000.0: 64}
SHOWN = {10.0: (5, 1, "average + fast part"), 1000.0: (2, 16, "average, no fast part drawn")}
"""By frequency every how many points have a marker, the line's points, and what the line is."""
LAWS = ("Coulomb", "LuGre")


def _values(law: str, frequency: float) -> Values:
    if law == "Coulomb":
        return coulomb_case(STRENGTH, frequency)
    return lugre_case(LugreCase(strength=STRENGTH), frequency, STIFFNESS)


def _measure(instance: Instance) -> Data:
    return {
        f"{law} {frequency:g}": plain(
            record(instance, _values(law, frequency), STOP, POINTS[frequency])
        )
        for law in LAWS
        for frequency in FREQUENCIES
    }


def averaged_position(law: str, frequency: float, times: Array) -> Array:
    """Return the averaged position with its fast part at times, shape (n,).

    From rest the slow velocity starts at q, for the fast one starts at -q.
    """

    def acceleration(time: float, velocity: float) -> float:
        if law == "Coulomb":
            return slow_theory.slow_acceleration(velocity, STRENGTH, 1.0, pi / 2.0)
        return -uniform_average.mean_friction(velocity, LugreCase(), STIFFNESS, frequency)

    coarse = np.linspace(0.0, times[-1], 201)
    slow = np.interp(times, coarse, slow_trajectory(acceleration, coarse, velocity=STRENGTH)[0])
    fast = -STRENGTH / frequency * np.sin(frequency * times)  # X_f / Omega of (10)
    return np.asarray(slow + fast)


def _draw(data: Data) -> Drawing:
    drawing, axes = panels(2)
    for axis, law in zip(axes, LAWS, strict=True):
        _panel(axis, law, data)
        axis.set(title=f"{law} friction")
    return drawing


def _panel(axis: Axes, law: str, data: Data) -> None:
    times = np.linspace(0.0, STOP, 1601)
    for frequency, shade, dash in zip(FREQUENCIES, SHADES, ("-", "--"), strict=False):
        run = data[f"{law} {frequency:g}"]
        every, coarse, label = SHOWN[frequency]
        drawn, name = times[::coarse], f"$\\Omega$ = {frequency:g}"
        average = averaged_position(law, frequency, drawn)
        axis.plot(drawn, average, dash, color=shade, label=f"{name}, {label}")
        markers(axis, run["time"][::every], run["position"][::every], shade, f"{name}, FMU")
    axis.set(xlabel=labels.TIME, ylabel=labels.DISPLACEMENT, xlim=(0.0, STOP))
    axis.legend(fontsize=8)


FIGURE = PaperFigure(
    "figure_2",
    "Displacement from rest",
    "alpha = 1, phi = pi/2, q = 1: F_T = Omega = 10 and F_T = Omega = 1000; (b) sigma_0 = 100, "
    "sigma_1 = 1, mu = 0.4. Markers: FMU. Lines: averaged motion from slow velocity q, (4) in (a), "
    "the uniform average in (b), with the fast part -(q/Omega) sin(Omega tau).",
    _measure,
    _draw,
)
