"""An FMU in simulators other than the harness's own: runs table 1 in each and compares.

Each host runs in a process of its own, as `python -m studies.hosts.NAME_host`,
because hosts crash, print, and ask for versions of packages that exclude each other. So `job` and
the `*_host` modules import nothing of the harness that is not in the standard library, but for the
host itself.
"""
