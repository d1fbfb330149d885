//! Mapping while the robot drives: a stream is read, followed and mapped by a thread each, and shown by a page.

mod follow;
mod hub;
mod incoming;
mod page;
mod server;
mod stream;

pub(crate) use follow::{Latest, Remade, follow, keep_mapping, lock, renew};
pub(crate) use hub::Hub;
pub(crate) use incoming::Source;
pub(crate) use page::{html, show};
pub(crate) use server::PageServer;
pub(crate) use stream::Stream;
