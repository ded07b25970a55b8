"""Scenes that are hard to choose for, each for a reason of its own."""

ALTERNATING = ", ".join(f"[{0.18 * i:.2f}, {i % 2}.0]" for i in range(60))
WALK = ", ".join(f"[{0.2 * i:.1f}, {0.06 * ((7 * i) % 5 - 2):.2f}]" for i in range(26))

SCENES = {
    "late_jump": """
        inputs.load = { steps = [[0, 0], [19.7, 0.06]] }
        run = { stop_time = 20.0, step_size = 20.0 }
        need.mean_velocity = { rel = 1e-3 }""",
    "jump_just_before_the_end": """
        inputs.phase = { steps = [[0, 0], [9.99, 1.5]] }
        run = { stop_time = 10.0, step_size = 0.01 }
        need.position = { rel = 1e-5 }""",
    "phases_that_alternate": f"""
        inputs.phase = {{ steps = [{ALTERNATING}] }}
        run = {{ stop_time = 10.8, step_size = 0.01 }}
        need.mean_velocity = {{ rel = 1e-4 }}""",
    "load_that_overcomes_friction": """
        inputs.load = { steps = [[0, 0], [1.5, 0.3]] }
        run = { stop_time = 2.0, step_size = 0.02 }
        need.velocity = { rel = 1e-3 }""",
    "polyline_that_is_held": f"""
        inputs.load = {{ ramp = [{WALK}] }}
        run = {{ stop_time = 5.0, step_size = 0.05 }}
        need.mean_velocity = {{ rel = 0.01 }}""",
    "polyline_that_is_passed_on": f"""
        device = {{ friction_law = 1, bristle_stiffness = 1e4 }}
        inputs.load = {{ ramp = [{WALK}] }}
        run = {{ stop_time = 5.0, step_size = 0.02, interpolate = true }}
        need.mean_velocity = {{ rel = 1e-5 }}""",
    "chirp_that_is_passed_on": """
        inputs.frequency_ratio = { ramp = [[0, 1], [5, 1.02]] }
        run = { stop_time = 5.0, step_size = 0.01, interpolate = true }
        need.mean_velocity = { rel = 0.01 }""",
    "ratio_that_jumps": """
        inputs.frequency_ratio = { steps = [[0, 1], [1, 3], [2, 1.5]] }
        run = { stop_time = 3.0, step_size = 0.03 }
        need.mean_velocity_throughout = { abs = 1e-4 }""",
    "beat": """
        inputs.frequency_ratio = 1.02
        run = { drive_periods = 1000, steps_per_period = 1 }
        need.beat = { rel = 1e-3 }""",
    "flight": """
        device.normal_amplitude = 1.8
        inputs.phase = -1.5
        run = { stop_time = 6.0, step_size = 0.05 }
        need.position = { rel = 1e-4 }""",
    "sticking": """
        device.base_amplitude = 5e-8
        inputs.phase = 0.3
        run = { drive_periods = 2000, steps_per_period = 1 }
        need.position = { rel = 1e-3 }""",
    "stiff_bristle": """
        device = { friction_law = 1, bristle_stiffness = 1e9 }
        run = { stop_time = 1.0, step_size = 0.05 }
        need = { mean_velocity = { rel = 1e-3 }, friction_law = "free" }""",
    "soft_bristle": """
        device = { friction_law = 1, bristle_stiffness = 3.0, normal_amplitude = 1.5 }
        run = { drive_periods = 3000, steps_per_period = 0.01 }
        need.mean_velocity = { rel = 1e-4 }""",
    "resonator_with_a_long_memory": """
        device.damping_ratio = 3e-4
        inputs.load = { steps = [[0, 0], [2.0, 0.05]] }
        run = { stop_time = 5.0, step_size = 0.1 }
        need.velocity = { rel = 1e-2 }""",
    "preload_that_is_tuned": """
        run = { stop_time = 4.0, step_size = 0.01 }
        need.position = { rel = 0.01 }
        tuning.normal_preload = { ramp = [[0, 1.0], [4, 1.5]] }""",
    "few_periods": """
        run = { drive_periods = 5, steps_per_period = 16 }
        need = { velocity = { rel = 1e-8 }, event_times = { abs = 1e-9 } }""",
    "steady_in_flight": """
        device = { friction_law = 1, normal_amplitude = 1.6 }
        inputs.phase = 0.4
        need = { steady_velocity = { rel = 1e-5 }, blocking_force = { rel = 0.01 } }""",
    "steady_beside_a_run": """
        inputs.load = 0.02
        run = { drive_periods = 5000, steps_per_period = 0.1 }
        need = { steady_velocity = { rel = 1e-3 }, mean_velocity = { rel = 1e-3 } }""",
}
"""The text of scenes by name, of dotted keys."""
