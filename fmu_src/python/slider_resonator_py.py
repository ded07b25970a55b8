"""The script that pythonfmu loads: it shows the class of the component and nothing else."""

from slider_component.slave import SliderResonatorPy, outlast_loading

__all__ = ["SliderResonatorPy"]

outlast_loading(globals())
