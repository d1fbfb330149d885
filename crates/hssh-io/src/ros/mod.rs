//! ROS bags, of either generation, as laser logs: containers, messages, clocks and frames, and what is chosen of them.

mod bag;
mod choice;
mod clock;
mod error;
mod frames;
mod gather;
mod growing;
mod inventory;
mod merge;
mod message;
mod recording;
mod sweep;
mod wire;

pub use bag::{BagError, is_packed_bag, with_file};
pub use choice::RecordingOptions;
pub use error::RecordingError;
pub use growing::{GrowingBag, follow_bag};
pub use inventory::{BagAccount, FrameAccount, TopicAccount, bag_account};
pub use recording::{ReadRecording, read_bag};
