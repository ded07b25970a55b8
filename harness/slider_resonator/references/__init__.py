"""Independent reference models of the slider-resonator.

Nothing here imports the component: an FMU and these models meet only in numbers. ``closed_forms``
holds the averaged theory, ``located_events`` and ``taylor`` integrate the full equations with
located events.
"""
