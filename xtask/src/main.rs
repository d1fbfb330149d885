//! Scripted experiments, benchmarks and checks.
fn main() {}
