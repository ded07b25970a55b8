"""The tree of FMUs, inputs and reference results that the FMI cross-check asks of exporting tools.

Rules: https://github.com/modelica/fmi-cross-check, version 4.1.
"""
