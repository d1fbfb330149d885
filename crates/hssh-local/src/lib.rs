//! Small-scale space: laser logs, occupancy grids, gateways and stars; from a log to an exploration.
