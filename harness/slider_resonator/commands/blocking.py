"""`blocking`: the blocking force by shooting."""

from slider_resonator.commands.searching import search_command
from slider_resonator.steady.blocking_force import find_blocking

HELP = """\
Find the load that stops an FMU, by shooting, without a long run.

The load is one more unknown of the shooting, zero displacement over the common period one more
equation. --set load=... is the initial guess. Exit code: 0 when it is found, 1 when there is
none (the status says why), 2 when the FMU could not run, crashed or exceeded the time limit.

\b
Examples:
  slider-resonator blocking
  slider-resonator blocking my.fmu --set phase=0.4 friction_faces=1 --json
  slider-resonator blocking my.fmu --set friction_law=1 bristle_stiffness=1e4
"""

blocking_command = search_command("blocking", "blocking force", find_blocking, HELP)
