"""Independent reference models of the slider-resonator.

Nothing here imports the component: an FMU and these models meet only in numbers. ``README.md``
lists their equations.
"""
