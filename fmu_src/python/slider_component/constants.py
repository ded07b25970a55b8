"""Constants that both twins share.

The C constants in constants.h are generated from these, with the same names.
"""

from __future__ import annotations

MAX_STEP_LEGS = 5_000_000
"""Legs in one step up to which its work is accepted: 2 to 10 s, the longer with LuGre friction."""

MAX_TURNS = 40_000_000
"""Turns of the fastest oscillation in one step, which take at least `MAX_STEP_LEGS` legs."""

MAX_SLOW_STEPS = 2_000_000
"""Steps of averaged motion in one communication step up to which its work is accepted."""

MAX_QUADRATURE_STEPS = 20_000
"""The same if each step costs quadratures, which take longer the more waves the load has."""

MAX_SEARCH_STEPS = 4_000
"""The same if each stage of a step searches a held orbit, under few waves of the normal load."""

SEARCH_WAVES = 10.0
"""Waves of the normal load in a drive turn that double the cost of such a search."""

PYTHON_SLOWDOWN = 100
"""Time of a leg in Python over that in C. The bounds above are divided by it in Python."""

TIME_SLACK = 1e-6
"""Fraction of a step by which hosts may round their own time."""

STOP_TIME_SLACK = 1e-9
"""Fraction of the stop time by which the last step may pass it."""
