"""The slider with an embedded resonator as a co-simulation component.

Standard library and relative imports only: the build renames the package for each FMU.

How a step flows: `slave` (pythonfmu) calls `component`, which asks the motion of the device under
the present inputs to advance a `moment`, which holds all that the motion carries from one step to
the next. There are three motions.

- `resolved`: a loop over segments, without an event inside. A friction law (`coulomb`, `lugre`)
  begins each. It ends at the first zero of what it watches (`first_zero`), at the latest where the
  contact lifts (`contact`); the law says what succeeds it. `segment` has its motion, on `device`:
  in closed form, or as Taylor series where that loses digits and while bristles bend.
- `averaged` to first order, under `mean_friction`.
- `leap`: over periods, by the `period_map` of resolved motion. It solves a `slow_equation`, as
  averages do.

`prediction` balances mean friction and load, then refines both by periodic motion. The interface is
`variables`; `values` and `outputs` keep its promises. `snapshot` has the state of the component.
"""
