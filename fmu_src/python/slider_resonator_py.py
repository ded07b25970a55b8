"""The script that pythonfmu loads, with the class of the FMU."""

from slider_component.slave import SliderResonatorPy, keep_alive

__all__ = ["SliderResonatorPy"]

keep_alive(globals())
