"""LuGre friction per unit load on a periodic motion: the bristle follows from the path.

With the stretch y = s0 z / mu, s the sign of the velocity and a = s0 / mu, between two reversals::

    y = s + (y_r - s) exp(-a s (x - x_r))
    F / (faces mu N) = y + s1 / mu (v - |v| y)

and y repeats after a period. Its first variation has the same closed form,
``dy = exp(-a s (x - x_r)) (dy_r + a (1 - s y_r) (dx - dx_r))``. Reversals move, too, but because
the velocity vanishes there this is an effect of second order.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from slider_resonator.arrays import Array
from slider_resonator.device.device import Device
from slider_resonator.references.averaged.panels import Panels


@dataclass(frozen=True)
class BristlePath:
    """The periodic stretch along a velocity, arrays at the nodes of ``panels``.

    ``spans`` are the panels of each slide in one direction, in order; ``decay`` is the factor to
    which a variation at the last reversal has decayed at the nodes, ``departed`` 1 - s y at that
    reversal.
    """

    device: Device
    panels: Panels
    velocity: Array
    sign: Array
    spans: list[slice]
    decay: Array
    decay_across: Array
    departed: Array
    stretch: Array

    def friction(self) -> Array:
        """Return friction per ``faces mu N``."""
        speed = np.abs(self.velocity)
        damping = self.device.bristle_damping / self.device.friction_coefficient
        return self.stretch + damping * (self.velocity - speed * self.stretch)

    def variation(
        self, change: Array, *, multiplier: float = 1.0, jump: float = 0.0
    ) -> tuple[Array, Array]:
        """Return the first variation of stretch and friction along a change of velocity (m/s).

        After a period that of the stretch is ``multiplier`` times what it was and ``jump`` more.
        """
        rate = self.device.bristle_stiffness / self.device.friction_coefficient
        moved, moved_at_edges = self.panels.integral(change / self.device.drive_frequency)
        gain, kept = 0.0, 1.0
        gains, kepts = [], []
        for span, decay, departed in zip(self.spans, self.decay_across, self.departed, strict=True):
            gains.append(gain)
            kepts.append(kept)
            way = moved_at_edges[span.stop] - moved_at_edges[span.start]
            gain, kept = decay * (gain + rate * departed * way), decay * kept
        first = (gain - jump) / (multiplier - kept)
        stretch = np.empty_like(change)
        for span, departed, gain, kept in zip(self.spans, self.departed, gains, kepts, strict=True):
            way = moved[span] - moved_at_edges[span.start]
            stretch[span] = self.decay[span] * (gain + kept * first + rate * departed * way)
        damping = self.device.bristle_damping / self.device.friction_coefficient
        speed = np.abs(self.velocity)
        slip = change * (1.0 - self.sign * self.stretch) - speed * stretch
        return stretch, stretch + damping * slip


def bristle_path(device: Device, panels: Panels, velocity: Array, reversals: Array) -> BristlePath:
    """Return the periodic stretch along a velocity (m/s) at the nodes of panels.

    The panels start at a reversal and end at all others; without ``reversals`` the stretch is that
    of steady sliding.
    """
    sign = np.sign(velocity[:, [velocity.shape[1] // 2]])
    if not len(reversals):
        still = np.zeros_like(velocity)
        return BristlePath(
            device,
            panels,
            velocity,
            sign,
            [slice(0, len(velocity))],
            still,
            np.zeros(1),
            np.zeros(1),
            sign + still,
        )
    rate = device.bristle_stiffness / device.friction_coefficient
    firsts = np.searchsorted(panels.edges, reversals - 1e-14)
    firsts = np.unique(np.append(firsts, 0))
    spans = [
        slice(int(first), int(last))
        for first, last in zip(firsts, np.append(firsts[1:], len(velocity)), strict=True)
    ]
    path, path_at_edges = panels.integral(velocity / device.drive_frequency)
    decay = np.empty_like(velocity)
    across = []
    gain, kept = 0.0, 1.0
    for span in spans:
        direction = float(sign[span.start, 0])
        decay[span] = np.exp(-rate * direction * (path[span] - path_at_edges[span.start]))
        way = path_at_edges[span.stop] - path_at_edges[span.start]
        across.append(float(np.exp(-rate * direction * way)))
        gain, kept = direction - (direction - gain) * across[-1], kept * across[-1]
    begin = gain / (1.0 - kept)
    stretch = np.empty_like(velocity)
    departed = []
    for span, decay_across in zip(spans, across, strict=True):
        direction = float(sign[span.start, 0])
        departed.append(1.0 - direction * begin)
        stretch[span] = direction + (begin - direction) * decay[span]
        begin = direction + (begin - direction) * decay_across
    return BristlePath(
        device,
        panels,
        velocity,
        sign,
        spans,
        decay,
        np.array(across),
        np.array(departed),
        stretch,
    )
