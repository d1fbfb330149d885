//! A naive reference mapper, for tests only: it shares no code with the mapper it checks.
