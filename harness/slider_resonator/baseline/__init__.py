"""Golden results of an FMU in CSV files: recorded, checked, and replaced by accepted changes.

`validate` compares an FMU with references, a baseline with its own earlier results.
"""
