//! Searches spread over processes and machines, on [timely dataflow](timely).
//!
//! A branch of the tree of hypotheses is a sequence of choices that can be replayed anywhere. The first process gives out branches, all of them
//! count, each on one thread, and what they counted comes back; the first process alone keeps the account and its checkpoints. The counts are the same
//! for any number of processes.
//!
//! Whoever can reach the ports can take part: this is for the machines of one trusted network.

mod connect;
mod count;
mod error;
mod hosts;
mod loss;

pub use count::count;
pub use error::ClusterError;
pub use hosts::{Hosts, HostsError};
pub use loss::report_loss;
