"""Constants that both twins share.

The C constants in constants.h are generated from these, with the same names.
"""

MAX_STEP_SEGMENTS = 1_000_000
"""Segments in one step up to which its work is accepted: 0.4 to 2 s, longer with LuGre friction."""

MAX_TURNS = 8_000_000
"""Turns of the fastest oscillation in one step: these take at least `MAX_STEP_SEGMENTS`."""

MAX_SLOW_STEPS = 400_000
"""Steps of averaged motion in one communication step up to which its work is accepted."""

MAX_QUADRATURE_STEPS = 4_000
"""The same if each step costs quadratures, which take longer the more waves the load has."""

PYTHON_SLOWDOWN = 20
"""In Python each of these bounds is so much lower; a segment takes some hundred times as long."""

TIME_SLACK = 1e-6
"""Fraction of a step by which hosts may round their own time."""

STOP_TIME_SLACK = 1e-9
"""Fraction of the stop time by which the last step may pass it."""
