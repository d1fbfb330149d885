//! Logs, scan matching, local maps, places and surveys against simulated buildings and real logs.
#![allow(clippy::unwrap_used, clippy::print_stderr)] // tests fail by panicking, and say what they skip

mod carmen;
mod closing;
mod doubts;
mod local_map;
mod matching;
mod mutations;
mod place;
mod route;
mod simulator;
mod survey;
