//! The program as its users run it, in one test binary.
#![allow(clippy::unwrap_used, reason = "in tests a failed unwrap is the failed assertion")]

mod causal;
mod checkpoints;
mod common;
mod export;
mod faults;
mod graph;
mod kinds;
mod live;
mod log;
mod memory;
mod outputs;
mod processes;
mod program;
mod readings;
mod rooms;
mod signals;
mod simulate;
mod stars;
mod visits;
