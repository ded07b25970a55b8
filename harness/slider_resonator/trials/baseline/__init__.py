"""Golden results of an FMU: recorded in CSV files, checked against, accepted when meant to change.

`validate` says whether an FMU is right; a baseline says whether it is what it was.
"""
