"""Texts of the refusals that both twins give: what is refused, its value, what it must be.

The C functions in refusal_texts.h are generated from these. So each shows each of its arguments
once: a number as {x!r}, an integer as {x:d}, and a text, also that of a value of any type, as {x}.
"""

OUT_OF_BOUNDS = "{name} = {value} refused: must be {requirement}"
OUTPUT_SET = "{name} = {value} refused: it is an output and cannot be set"
FIXED_WHILE_RUNNING = (
    "{name} = {value} refused: it is fixed and can be set only before initialization ends"
)
UNKNOWN_REFERENCE = "valueReference = {reference:d} refused: must be from {first:d} to {last:d}"
WRONG_TYPE = "{name} (valueReference = {reference:d}) refused: its type is {own}, not {requested}"
WRONG_STATE = "{call} refused in state '{state}': the state must be '{required}'"
BAD_START_TIME = "startTime = {start_time!r} refused: must be a finite number"
BAD_STOP_TIME = "stopTime = {stop_time!r} refused: must be at least startTime = {start_time!r}"
BAD_TOLERANCE = "tolerance = {tolerance!r} refused: must be a finite number above 0"
BAD_STEP_SIZE = (
    "doStep: communicationStepSize = {step_size!r} refused: must be a finite number above 0"
)
BAD_STEP_START = (
    "doStep: currentCommunicationPoint = {time!r} refused: must be the present time {now!r}"
)
STEP_BEYOND_STOP = (
    "doStep: communicationStepSize = {step_size!r} refused: the step must end by stopTime = "
    "{stop_time!r}"
)
TOO_MANY_TURNS = (
    "doStep: communicationStepSize = {step_size!r} refused: the fastest oscillation has "
    "{frequency!r} rad/s; the step must be at most {max_turns:d} turns of it"
)
TOO_MUCH_WORK = (
    "doStep: communicationStepSize = {step_size!r} refused: it takes more work than {max_count:d} "
    "{what}; must be at most 1e{exponent:d} s"
)
TOO_MUCH_WORK_AT_ONCE = (
    "doStep: communicationStepSize = {step_size!r} refused: it takes more work than {max_count:d} "
    "{what}, however short it is; the forces must be changed"
)
INFINITE_MOTION = (
    "doStep: communicationStepSize = {step_size!r} refused: the motion leaves the range of "
    "floating point numbers; forces, frequencies or steps must be smaller"
)
EXTREME_VALUE = (
    "{name} = {value} refused: together with the other values it leaves the range of floating "
    "point numbers; must be nearer to {start}"
)
INFINITE_OUTPUT = (
    "{name} = {value!r} refused: the output leaves the range of floating point numbers; values, "
    "inputs and state must be smaller"
)
UNBOUNDED_RESONANCE = (
    "damping_ratio = {damping_ratio!r} refused: without damping the steady force of the resonator "
    "is unbounded at drive_frequency = {drive_frequency!r}; there it must be above 0"
)
DRIVE_TOO_SLOW = (
    "frequency_deviation = {frequency_deviation!r} refused: it makes drive_frequency "
    "{drive_frequency!r}; that must be {requirement}"
)
LUGRE_WITHOUT_FRICTION = (
    "friction_coefficient = {friction_coefficient!r} refused: with LuGre friction it must be a "
    "finite number above 0"
)
