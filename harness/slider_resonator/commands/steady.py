"""`steady`: the steady velocity by shooting."""

from slider_resonator.commands.searching import search_command
from slider_resonator.steady.steady_velocity import find_steady

HELP = """\
Find the steady velocity of an FMU by shooting, without a long run.

The steady motion is a fixed point of the map over one common period.
--set initial_velocity=... is the initial guess. With LuGre friction the bristle is part of the
state, and the FMU's tolerance, 1e-8 unless set, bounds the accuracy. Exit code: 0 when there is
a steady motion, 1 when there is none (the status says why), 2 when the FMU could not run,
crashed or exceeded the time limit.

\b
Examples:
  slider-resonator steady
  slider-resonator steady my.fmu --set phase=0.4 load=0.05 --json
  slider-resonator steady my.fmu --set friction_law=1 bristle_stiffness=1e6 tolerance=1e-12
  slider-resonator steady my.fmu --set frequency_ratio=1.37 --max-denominator 100
"""

steady_command = search_command("steady", "steady velocity", find_steady, HELP)
