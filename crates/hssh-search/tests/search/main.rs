//! The searches against one another, against a naive mapper, and against independent checks of what
//! they find.

#![allow(clippy::unwrap_used, reason = "in tests a failed unwrap is the failed assertion")]

mod agreement;
mod cases;
mod certificates;
mod checkpoints;
mod constraints;
mod distinction;
mod found;
mod helpers;
mod limits;
mod online;
mod posterior;
mod proof;
mod published;
mod reading;
mod spilling;
mod threads;
