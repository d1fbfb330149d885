//! Every way to explain an exploration with errors, each at its price, as docs/readings.md defines it.
//!
//! Where that page leaves something open, this is what was taken:
//!
//! 1. The halves of a link keep its direction: of ⟨u, v⟩ with a place inserted, the first is made from u, the second
//!    from the inserted place. Only the half that the robot goes along now is passed once more; so it is with J.
//! 2. A link that one travel goes along twice is passed twice.
//! 3. The chart is judged after each travel, never in the middle of one: with all its places as they are by then,
//!    after each of its links.
//! 4. While the robot is underway every way out of d is open to it, *false* and *turned back* too. A turn at a false
//!    visit allows nothing but the reading: that report cannot be false. After a passed place neither is allowed.
//! 5. A closed end that becomes open takes the label of the end as seen. The ends of J have no label.
//! 6. New open ends take their positions before new closed ones do. New closed ends behind the same open end keep
//!    the order of the star, and stand before what stood there.
//! 7. *Closure by a new end* and *passing by closure* may come back to the very place that the robot left.
//! 8. A visit is named by the number of the visit on which its place was first reported: 0, 1, 0, 3.
//! 9. A way that costs infinitely much is no way, even without a limit.
//! 10. *First shown* counts the visits before this one.

mod account;
mod chart;
mod judge;
mod merge;
mod model;
mod read;
mod travel;
mod way;

pub use account::{ReadHypothesis, enumerate_readings};
pub use model::ReadingModel;
