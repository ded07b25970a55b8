"""The table of FMU variables: names, units, bounds and start values (SI units).

All descriptions of the interface are generated from these rows: the model description, checks of
values, fields of the device in both twins, and the documentation. The value reference of a variable
is its position in `VARIABLES`.

During initialization both phases are zero, so neither a rate nor `tangential_force` (which acts as
its amplitude times sin(0)) acts on a force directly. The other dependencies follow from the
equations: the stick condition needs the force of the resonator's spring and damper, `fidelity` 1
replaces those by the steady resonator force (34), and LuGre friction depends on its bristle.
"""

from __future__ import annotations

from functools import partial

from .variable import Variable

_input = partial(Variable, type="Real", causality="input", variability="continuous")
_fixed = partial(Variable, type="Real", causality="parameter", variability="fixed")
_tunable = partial(Variable, type="Real", causality="parameter", variability="tunable")
_choice = partial(Variable, type="Integer", causality="parameter", variability="fixed")
_output = partial(Variable, type="Real", causality="output", variability="continuous")
_count = partial(Variable, type="Real", causality="output", variability="discrete")

_INPUTS = ("phase", "load", "frequency_ratio")
_CHOICES = ("friction_law", "fidelity", "averaging_order")
_NORMAL_FORCE = ("phase", "normal_preload", "normal_amplitude")

_MASSES_AND_SPRING = ("slider_mass", "resonator_mass", "resonator_frequency", "damping_ratio")
# The parameters of the resonator's steady motion (32) and of its force on the slider (33).
_STEADY_RESONATOR = (
    *_MASSES_AND_SPRING,
    "base_amplitude",
    "drive_frequency",
    "tangential_force",
)
_FRICTION = (
    *_NORMAL_FORCE,
    *_CHOICES,
    *_STEADY_RESONATOR,
    "load",
    # At the boundary of a flight its sign is the direction of the normal phase.
    "frequency_ratio",
    "friction_coefficient",
    "friction_faces",
    "bristle_stiffness",
    "bristle_damping",
    "initial_velocity",
    "initial_resonator_displacement",
    "initial_resonator_velocity",
    "initial_bristle_deflection",
)
_AVERAGED_THEORY = (
    *_NORMAL_FORCE,
    *_STEADY_RESONATOR,
    "frequency_ratio",
    "friction_coefficient",
    "friction_faces",
    "friction_law",
    "averaging_order",
    "bristle_stiffness",
    "bristle_damping",
    "tolerance",
)

# What selects the model of the motion: `averaging_order` matters at fidelity 0 only.
_WHICH_MOTION = ("fidelity", *_AVERAGED_THEORY)

VARIABLES: tuple[Variable, ...] = (
    _input(
        "phase",
        "Phase of the normal load variation relative to its own drive (phi_1 in eq. 26)",
        start=0.0,
        unit="rad",
        display_unit="deg",
        nominal=1.0,
    ),
    _input(
        "load",
        "External tangential load on the slider; positive opposes motion in +X",
        start=0.0,
        unit="N",
        display_unit="mN",
        nominal=0.1,
    ),
    _input(
        "frequency_ratio",
        "Frequency of the normal load variation over the drive frequency; a change alters a rate, "
        "never a phase",
        start=1.0,
        unit="1",
        nominal=1.0,
    ),
    _fixed(
        "slider_mass",
        "Mass M of the slider without its resonator",
        start=1.0,
        unit="kg",
        display_unit="g",
        minimum=1e-12,
        nominal=1.0,
    ),
    _fixed(
        "resonator_mass",
        "Mass m of the resonator; 0 leaves a rigid slider (fig. 1)",
        start=0.1,
        unit="kg",
        display_unit="g",
        minimum=0.0,
        nominal=0.1,
    ),
    _fixed(
        "resonator_frequency",
        "Natural angular frequency of the resonator on a held slider, (k/m)^(1/2)",
        start=3500.0,
        unit="rad/s",
        display_unit="Hz",
        minimum=1e-6,
        nominal=3500.0,
    ),
    _fixed(
        "damping_ratio",
        "Damping ratio of the resonator on a held slider, c/(2 (k m)^(1/2))",
        start=0.05,
        unit="1",
        minimum=0.0,
        nominal=0.05,
    ),
    _tunable(
        "normal_preload",
        "Constant part N_0 of the normal load",
        start=1.0,
        unit="N",
        minimum=0.0,
        nominal=1.0,
    ),
    _tunable(
        "normal_amplitude",
        "Amplitude Delta N of the normal load variation; above normal_preload the contact lifts",
        start=1.0,
        unit="N",
        minimum=0.0,
        nominal=1.0,
    ),
    _tunable(
        "base_amplitude",
        "Amplitude A of the base excitation of the resonator",
        start=1e-4,
        unit="m",
        display_unit="um",
        minimum=0.0,
        nominal=1e-4,
    ),
    _tunable(
        "drive_frequency",
        "Angular frequency w of the tangential drive",
        start=3500.0,
        unit="rad/s",
        display_unit="Hz",
        minimum=1e-6,
        nominal=3500.0,
    ),
    _tunable(
        "tangential_force",
        "Amplitude of a direct tangential drive force on the slider (fig. 1)",
        start=0.0,
        unit="N",
        nominal=1.0,
    ),
    _tunable(
        "friction_coefficient",
        "Coulomb coefficient mu of each face",
        start=0.1,
        unit="1",
        minimum=0.0,
        nominal=0.1,
    ),
    _choice(
        "friction_faces",
        "Number of faces that rub: 2 in fig. 6, 1 in fig. 1",
        start=2,
        minimum=1,
        maximum=2,
    ),
    _choice(
        "friction_law",
        "0: Coulomb, 1: LuGre",
        start=0,
        minimum=0,
        maximum=1,
    ),
    _fixed(
        "bristle_stiffness",
        "LuGre bristle stiffness per unit normal load, sigma_0 (eq. 8)",
        start=1e5,
        unit="1/m",
        minimum=0.0,
        nominal=1e5,
    ),
    _fixed(
        "bristle_damping",
        "LuGre bristle damping per unit normal load, sigma_1 (eq. 8)",
        start=10.0,
        unit="s/m",
        minimum=0.0,
        nominal=10.0,
    ),
    _choice(
        "fidelity",
        "Number of resolved degrees of freedom: 0 slow motion, by averaging_order, 1 slider under "
        "the steady resonator force (eq. 34), 2 full device (eqs 26-27)",
        start=2,
        minimum=0,
        maximum=2,
    ),
    _choice(
        "averaging_order",
        "1: averages over the vibration without friction, 2: resolved motion that leaps over "
        "periods; for motion at fidelity 0 and for the predictions at all fidelities",
        start=2,
        minimum=1,
        maximum=2,
    ),
    _fixed(
        "tolerance",
        "Error of LuGre friction, relative to the velocities of slider and resonator, each by "
        "itself; error that leaps over periods may make in the slow velocity, over the fast "
        "velocity. Resolved Coulomb friction needs none",
        start=1e-8,
        unit="1",
        minimum=1e-14,
        maximum=1e-2,
        nominal=1e-8,
    ),
    _fixed(
        "initial_position",
        "Slider position at the start",
        start=0.0,
        unit="m",
        display_unit="mm",
        nominal=1e-3,
    ),
    _fixed(
        "initial_velocity",
        "Slider velocity at the start; at fidelity 0 and 1 it fixes, with "
        "initial_resonator_velocity, the momentum of slider and resonator",
        start=0.0,
        unit="m/s",
        display_unit="mm/s",
        nominal=0.1,
    ),
    _fixed(
        "initial_resonator_displacement",
        "Resonator displacement relative to the slider at the start",
        start=0.0,
        unit="m",
        display_unit="um",
        nominal=1e-3,
    ),
    _fixed(
        "initial_resonator_velocity",
        "Resonator velocity relative to the slider at the start",
        start=0.0,
        unit="m/s",
        display_unit="mm/s",
        nominal=1.0,
    ),
    _fixed(
        "initial_bristle_deflection",
        "LuGre bristle deflection z at the start",
        start=0.0,
        unit="m",
        display_unit="um",
        nominal=1e-6,
    ),
    _output(
        "position",
        "Slider position X",
        unit="m",
        display_unit="mm",
        nominal=1e-3,
        depends_initially_on=("initial_position",),
    ),
    _output(
        "velocity",
        "Slider velocity X'",
        unit="m/s",
        display_unit="mm/s",
        nominal=0.1,
        # At fidelity 1 it follows from the momentum, less that of the steady vibration.
        depends_initially_on=(
            "fidelity",
            *_STEADY_RESONATOR,
            "initial_velocity",
            "initial_resonator_velocity",
        ),
    ),
    _output(
        "mean_velocity",
        "Exact mean velocity over the last whole drive period (since the start before the first "
        "period is complete); by averages of first order the slow velocity",
        unit="m/s",
        display_unit="mm/s",
        nominal=0.1,
        # By first order it is the momentum of the pair over the mass, without the vibration.
        depends_initially_on=(*_WHICH_MOTION, "initial_velocity", "initial_resonator_velocity"),
    ),
    _output(
        "resonator_displacement",
        "Resonator displacement Y relative to the slider",
        unit="m",
        display_unit="um",
        nominal=1e-3,
        depends_initially_on=(*_WHICH_MOTION, "initial_resonator_displacement"),
    ),
    _output(
        "resonator_velocity",
        "Resonator velocity Y' relative to the slider",
        unit="m/s",
        display_unit="mm/s",
        nominal=1.0,
        depends_initially_on=(*_WHICH_MOTION, "initial_resonator_velocity"),
    ),
    _output(
        "normal_force",
        "Normal load N of each face; 0 while the contact is lifted",
        unit="N",
        nominal=1.0,
        depends_on=("phase",),
        depends_initially_on=_NORMAL_FORCE,
    ),
    _output(
        "friction_force",
        "Friction force F of all faces on the slider; positive opposes motion in +X",
        unit="N",
        display_unit="mN",
        nominal=0.1,
        depends_on=_INPUTS,
        depends_initially_on=_FRICTION,
    ),
    _count(
        "contact_mode",
        "-1: slips backwards, 0: sticks, 1: slips forwards, 2: lifted",
        unit="1",
        minimum=-1.0,
        maximum=2.0,
        depends_on=_INPUTS,
        depends_initially_on=_FRICTION,
    ),
    _count(
        "reversals",
        "Number of times that sliding began in the direction opposite to the sliding before",
        unit="1",
        minimum=0.0,
    ),
    _output(
        "stick_fraction",
        "Fraction of the last whole drive period spent sticking",
        unit="1",
        display_unit="%",
        minimum=0.0,
        maximum=1.0,
        nominal=1.0,
        # 0 or 1, by the contact mode, before the first step.
        depends_initially_on=_FRICTION,
    ),
    _count(
        "last_event_time",
        "Time of the last reversal, stick, release, lift-off or touchdown; at first the start time",
        unit="s",
        display_unit="ms",
    ),
    _output(
        "steady_velocity",
        "Steady velocity for the present inputs: that of the periodic motion of the full device, "
        "or by averages of first order (eq. 20); the highest where friction and load balance over "
        "a range of velocities",
        unit="m/s",
        display_unit="mm/s",
        nominal=0.1,
        depends_on=_INPUTS,
        depends_initially_on=(*_AVERAGED_THEORY, "load"),
    ),
    _output(
        "blocking_force",
        "Load that stops the slider, for the present inputs: that of the periodic motion of the "
        "full device, or by averages of first order (eq. 22)",
        unit="N",
        display_unit="mN",
        nominal=0.1,
        depends_on=("phase", "frequency_ratio"),
        depends_initially_on=_AVERAGED_THEORY,
    ),
    _count(
        "prediction_valid",
        "1: steady_velocity and blocking_force apply; 0: the load exceeds the mean friction of "
        "sliding, no steady vibration overcomes this friction, or (averaging_order 2) no periodic "
        "motion of the full device was found",
        unit="1",
        minimum=0.0,
        maximum=1.0,
        depends_on=_INPUTS,
        depends_initially_on=(*_AVERAGED_THEORY, "load"),
    ),
    _output(
        "slow_motion_error",
        "Estimated error of the slow velocity at fidelity 0, measured along leaps by "
        "averaging_order 2; 0 at fidelity 1 and 2",
        unit="m/s",
        display_unit="mm/s",
        minimum=0.0,
        depends_on=_INPUTS,
        depends_initially_on=(*_WHICH_MOTION, "load"),
    ),
)

VALUE_REFERENCE: dict[str, int] = {v.name: i for i, v in enumerate(VARIABLES)}
