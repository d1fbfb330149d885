//! Searches spread over processes and machines, on [timely dataflow](timely).
//!
//! A branch of the tree of hypotheses is a sequence of choices that can be replayed anywhere. To [`count`], the first process gives out branches, all of
//! them count, each on one thread, and what they counted comes back. To [`explain`], the first process searches as it does alone, and gives out the turns
//! of hypotheses, which are laid out and expanded wherever it is. It alone keeps the account and its checkpoints; the answer is the same for any number
//! of processes.
//!
//! Whoever can reach the ports can take part: this is for the machines of one trusted network.

mod connect;
mod count;
mod error;
mod explain;
mod hosts;
mod loss;
mod run;

pub use count::count;
pub use error::ClusterError;
pub use explain::explain;
pub use hosts::{Hosts, HostsError};
pub use loss::report_loss;
