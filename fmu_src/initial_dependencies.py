"""What each output depends on during initialization: ModelStructure/InitialUnknowns of FMI 2.0.

Both phase accumulators are zero then, so neither a rate nor `tangential_force` (which acts as its
amplitude times sin(0)) reaches a force directly. What does is read off the equations: the stick
condition needs the force of the resonator's spring and damper, `fidelity` 1 replaces those by the
steady resonator force (34), and LuGre friction depends on its bristle.
"""

from __future__ import annotations

_CHOICES = ("friction_law", "fidelity")
_NORMAL_FORCE = ("phase", "normal_preload", "normal_amplitude")

_MASSES_AND_SPRING = ("slider_mass", "resonator_mass", "resonator_frequency", "damping_ratio")
# What the steady motion of the resonator (32) and its force on the slider (33) follow from.
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
    # On the boundary of a flight its sign decides which way the normal phase goes.
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
    "bristle_stiffness",
    "bristle_damping",
)

INITIAL_DEPENDENCIES: dict[str, tuple[str, ...]] = {
    "position": ("initial_position",),
    "velocity": ("initial_velocity",),
    "mean_velocity": ("initial_velocity",),
    "resonator_displacement": (
        "fidelity",
        *_STEADY_RESONATOR,
        "initial_resonator_displacement",
    ),
    "resonator_velocity": ("fidelity", *_STEADY_RESONATOR, "initial_resonator_velocity"),
    "normal_force": _NORMAL_FORCE,
    "friction_force": _FRICTION,
    "contact_mode": _FRICTION,
    "reversals": (),
    # 0 or 1 until time has passed, by the contact mode.
    "stick_fraction": _FRICTION,
    "last_event_time": (),
    "steady_velocity": (*_AVERAGED_THEORY, "load"),
    "blocking_force": _AVERAGED_THEORY,
}
