"""The table of FMU variables: names, units, bounds and start values (SI units).

All descriptions of the interface are generated from these rows: the model description, checks of
values, fields of the device in both twins, and the documentation. The value reference of a variable
is its position in `VARIABLES`.

During initialization both phases are zero, so neither a rate nor `tangential_force` (which acts as
its amplitude times sin(0)) acts on a force directly. The other dependencies follow from the
equations: the stick condition needs the force of the resonator's spring and damper, `fidelity` 1
replaces those by the steady resonator force (34), and LuGre friction depends on its bristle.

Each row is: kind, name, unit (display unit), then what is not its default; an indented description,
and the inputs and parameters that an output depends on. Words in capitals are groups of those.
"""

import re
from collections.abc import Iterator

from .variable import Causality, Variability, Variable

KINDS: dict[str, tuple[Causality, Variability]] = {
    "input": ("input", "continuous"),
    "fixed": ("parameter", "fixed"),
    "tunable": ("parameter", "tunable"),
    "choice": ("parameter", "fixed"),
    "output": ("output", "continuous"),
    "count": ("output", "discrete"),
}
"""A choice is an Integer, all others are Real."""

DEPENDENCIES = ("depends on", "initially on")
"""At a communication point, and during initialization."""

GROUPS = """
DRIVE
    amplitude_deviation frequency_deviation
INPUTS
    phase load frequency_ratio DRIVE
CHOICES
    friction_law fidelity averaging_order
NORMAL_FORCE
    phase normal_preload normal_amplitude
MASSES_AND_SPRING
    slider_mass resonator_mass resonator_frequency damping_ratio
STEADY_RESONATOR
    MASSES_AND_SPRING DRIVE base_amplitude drive_frequency tangential_force
FRICTION
    NORMAL_FORCE CHOICES STEADY_RESONATOR load frequency_ratio friction_coefficient friction_faces
    bristle_stiffness bristle_damping initial_velocity initial_resonator_displacement
    initial_resonator_velocity initial_bristle_deflection
AVERAGED_THEORY
    NORMAL_FORCE STEADY_RESONATOR frequency_ratio friction_coefficient friction_faces friction_law
    averaging_order bristle_stiffness bristle_damping tolerance
WHICH_MOTION
    fidelity AVERAGED_THEORY
"""
"""Among them the parameters of the resonator's steady motion (32) and force (33). At the boundary
of a flight the sign of `frequency_ratio` is the direction of the normal phase. At fidelity 1 and 0
velocities follow from the momentum, less that of the steady vibration."""

TABLE = """
input phase rad (deg), start 0, nominal 1
    Phase of the normal load variation relative to its own drive (phi_1 in eq. 26)
input load N (mN), start 0, nominal 0.1
    External tangential load on the slider; positive opposes motion in +X
input frequency_ratio 1, start 1
    Frequency of the normal load variation over the drive frequency; a change alters a rate, never
    a phase
input amplitude_deviation 1 (%), start 0, from -1, nominal 0.1
    Deviation of base_amplitude and tangential_force from their values, relative to these, held over
    a step; -1 switches the drive off
input frequency_deviation 1 (%), start 0, from -0.99, nominal 0.01
    Deviation of drive_frequency from its value, relative to that, held over a step; a change
    alters a rate, never a phase
fixed slider_mass kg (g), start 1, from 1e-12
    Mass M of the slider without its resonator
fixed resonator_mass kg (g), start 0.1, from 0
    Mass m of the resonator; 0 leaves a rigid slider (fig. 1)
fixed resonator_frequency rad/s (Hz), start 3500, from 1e-6
    Natural angular frequency of the resonator on a held slider, (k/m)^(1/2)
fixed damping_ratio 1, start 0.05, from 0
    Damping ratio of the resonator on a held slider, c/(2 (k m)^(1/2))
tunable normal_preload N, start 1, from 0
    Constant part N_0 of the normal load
tunable normal_amplitude N, start 1, from 0
    Amplitude Delta N of the normal load variation; above normal_preload the contact lifts
tunable base_amplitude m (um), start 1e-4, from 0
    Amplitude A of the base excitation of the resonator
tunable drive_frequency rad/s (Hz), start 3500, from 1e-6
    Angular frequency w of the tangential drive
tunable tangential_force N, start 0, nominal 1
    Amplitude of a direct tangential drive force on the slider (fig. 1)
tunable friction_coefficient 1, start 0.1, from 0
    Coulomb coefficient mu of each face
choice friction_faces, start 2, from 1, to 2
    Number of faces that rub: 2 in fig. 6, 1 in fig. 1
choice friction_law, start 0, from 0, to 1
    0: Coulomb, 1: LuGre
fixed bristle_stiffness 1/m, start 1e5, from 0
    LuGre bristle stiffness per unit normal load, sigma_0 (eq. 8)
fixed bristle_damping s/m, start 10, from 0
    LuGre bristle damping per unit normal load, sigma_1 (eq. 8)
choice fidelity, start 2, from 0, to 2
    Number of resolved degrees of freedom: 0 slow motion, by averaging_order, 1 slider under the
    steady resonator force (eq. 34), 2 full device (eqs 26-27)
choice averaging_order, start 2, from 1, to 2
    1: averages over the vibration without friction, 2: resolved motion that leaps over periods;
    for motion at fidelity 0 and for the predictions at all fidelities
fixed tolerance 1, start 1e-8, from 1e-14, to 0.01
    Error of LuGre friction, relative to the velocities of slider and resonator, each by itself;
    error that leaps over periods may make in the slow velocity, over the fast velocity. Resolved
    Coulomb friction needs none
fixed initial_position m (mm), start 0, nominal 1e-3
    Slider position at the start
fixed initial_velocity m/s (mm/s), start 0, nominal 0.1
    Slider velocity at the start; at fidelity 0 and 1 it fixes, with initial_resonator_velocity,
    the momentum of slider and resonator
fixed initial_resonator_displacement m (um), start 0, nominal 1e-3
    Resonator displacement relative to the slider at the start
fixed initial_resonator_velocity m/s (mm/s), start 0, nominal 1
    Resonator velocity relative to the slider at the start
fixed initial_bristle_deflection m (um), start 0, nominal 1e-6
    LuGre bristle deflection z at the start
output position m (mm), nominal 1e-3
    Slider position X
    initially on: initial_position
output velocity m/s (mm/s), nominal 0.1
    Slider velocity X'
    initially on: fidelity STEADY_RESONATOR initial_velocity initial_resonator_velocity
output mean_velocity m/s (mm/s), nominal 0.1
    Exact mean velocity over the last whole drive period (since the start before the first period
    is complete); by averages of first order the slow velocity
    initially on: WHICH_MOTION initial_velocity initial_resonator_velocity
output resonator_displacement m (um), nominal 1e-3
    Resonator displacement Y relative to the slider
    depends on: DRIVE
    initially on: WHICH_MOTION initial_resonator_displacement
output resonator_velocity m/s (mm/s), nominal 1
    Resonator velocity Y' relative to the slider
    depends on: DRIVE
    initially on: WHICH_MOTION initial_resonator_velocity
output normal_force N, nominal 1
    Normal load N of each face; 0 while the contact is lifted
    depends on: phase
    initially on: NORMAL_FORCE
output friction_force N (mN), nominal 0.1
    Friction force F of all faces on the slider; positive opposes motion in +X
    depends on: INPUTS
    initially on: FRICTION
count contact_mode 1, from -1, to 2
    -1: slips backwards, 0: sticks, 1: slips forwards, 2: lifted
    depends on: INPUTS
    initially on: FRICTION
count reversals 1, from 0
    Number of times that sliding began in the direction opposite to the sliding before
output stick_fraction 1 (%), from 0, to 1, nominal 1
    Fraction of the last whole drive period spent sticking
    initially on: FRICTION
count last_event_time s (ms)
    Time of the last reversal, stick, release, lift-off or touchdown; at first the start time
output steady_velocity m/s (mm/s), nominal 0.1
    Steady velocity for the present inputs: that of the periodic motion of the full device, or by
    averages of first order (eq. 20); the highest where friction and load balance over a range of
    velocities
    depends on: INPUTS
    initially on: AVERAGED_THEORY load
output blocking_force N (mN), nominal 0.1
    Load that stops the slider, for the present inputs: that of the periodic motion of the full
    device, or by averages of first order (eq. 22)
    depends on: phase frequency_ratio DRIVE
    initially on: AVERAGED_THEORY
count prediction_valid 1, from 0, to 1
    1: steady_velocity and blocking_force apply; 0: the load exceeds the mean friction of sliding,
    no steady vibration overcomes this friction, or (averaging_order 2) no periodic motion of the
    full device was found
    depends on: INPUTS
    initially on: AVERAGED_THEORY load
output slow_motion_error m/s (mm/s), from 0
    Estimated error of the slow velocity at fidelity 0, measured along leaps by averaging_order 2;
    0 at fidelity 1 and 2
    depends on: INPUTS
    initially on: WHICH_MOTION load
output friction_power W (mW), nominal 0.01
    Mean power of friction over the last whole drive period (since the start before the first period
    is complete): friction force times slider velocity, positive as heat; by averages of first order
    that at the present slow velocity and vibration
    depends on: INPUTS
    initially on: FRICTION
"""


def _entries(text: str) -> Iterator[tuple[str, list[str]]]:
    """The heads of entries, and the indented lines below each."""
    for entry in re.split(r"\n(?=\S)", text.strip()):
        head, *lines = entry.splitlines()
        yield head, [line.strip() for line in lines]


_GROUPS = {name: " ".join(lines).split() for name, lines in _entries(GROUPS)}


def _names(words: list[str]) -> tuple[str, ...]:
    """The names of variables in a list, with those of groups in their place."""
    return tuple(n for w in words for n in (_names(_GROUPS[w]) if w in _GROUPS else (w,)))


def _variable(head: str, lines: list[str]) -> Variable:
    first, *settings = head.split(", ")
    kind, name, *units = first.split()
    number = int if kind == "choice" else float
    given: dict[str, float] = {k: number(v) for k, v in (text.split() for text in settings)}
    depends = dict(line.split(": ") for line in lines if line.startswith(DEPENDENCIES))
    on_inputs, initially = (_names(depends.get(key, "").split()) for key in DEPENDENCIES)
    return Variable(
        name,
        " ".join(line for line in lines if not line.startswith(DEPENDENCIES)),
        "Integer" if kind == "choice" else "Real",
        *KINDS[kind],
        start=given.get("start"),
        unit=units[0] if units else None,
        display_unit=units[1].strip("()") if len(units) > 1 else None,
        minimum=given.get("from"),
        maximum=given.get("to"),
        nominal=given.get("nominal", None if kind == "choice" else given.get("start")),
        depends_on=on_inputs,
        depends_initially_on=initially,
    )


VARIABLES: tuple[Variable, ...] = tuple(_variable(*entry) for entry in _entries(TABLE))

VALUE_REFERENCE: dict[str, int] = {v.name: i for i, v in enumerate(VARIABLES)}
