"""The slider with an embedded resonator as a co-simulation component.

Standard library and relative imports only: the build renames the package for each FMU.

How a step flows: `slave` (pythonfmu) calls `component`, which asks the `motion` of the device under
the present inputs to advance a `moment`. There are three motions.

- Resolved: `events` loops over segments, each without an event. A friction law (`coulomb`, `lugre`)
  says how a segment begins and what succeeds it. `sliding` has its closed forms, on `device` and
  `oscillator`; where these lose digits, and while bristles bend, `series` follows it. `first_zero`
  finds where it ends; `contact` says when the contact lifts.
- Averaged to first order: `slow_motion`, under the `slow_friction` that `mean_friction` and a
  `vibrating_load` give.
- Leaping over periods: `leap`, on the `period_map` of resolved motion.

`prediction` balances mean friction and load, then refines both by `steady_motion`. The interface is
`variables`; `values`, `snapshot`, `outputs` and `budget` keep its promises.
"""
