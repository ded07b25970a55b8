"""Constants that both twins share.

The C constants in constants.h are generated from these, with the same names.
"""

from __future__ import annotations

MAX_TURNS = 1e8
"""Turns of the fastest oscillation in one step up to which its work is accepted."""

TIME_SLACK = 1e-6
"""Fraction of a step by which hosts may round their own time."""

STOP_TIME_SLACK = 1e-9
"""Fraction of the stop time by which the last step may pass it."""
