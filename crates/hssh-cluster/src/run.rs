//! One timely worker in each process of a search.

use std::any::Any;
use std::net::TcpStream;
use std::sync::{Mutex, PoisonError};
use std::thread::{self, JoinHandle};

use timely::communication::Hooks;
use timely::communication::allocator::zero_copy::initialize::initialize_networking_from_sockets;
use timely::communication::allocator::{AllocatorBuilder, ProcessBuilder};
use timely::execute::execute_from;
use timely::worker::Worker;
use timely::{CommunicationConfig, WorkerConfig};

use crate::error::ClusterError;
use crate::hosts::Hosts;

/// Runs the part of this process on a thread of its own, by processes that are connected. It ends when all have ended; why it could not begin, if it
/// could not.
///
/// # Errors
/// If the system gives no thread.
pub(crate) fn run(
    hosts: &Hosts,
    connections: Vec<Option<TcpStream>>,
    part: impl FnOnce(&mut Worker) + Send + 'static,
) -> Result<JoinHandle<Result<(), String>>, ClusterError> {
    let (process, part) = (hosts.process(), Mutex::new(Some(part)));
    let running = thread::Builder::new().name("timely:run".to_owned()).spawn(move || {
        let (workers, guard) = workers(connections, process)?;
        let run = move |worker: &mut Worker| {
            // There is one worker in each process.
            let part = part.lock().unwrap_or_else(PoisonError::into_inner).take();
            if let Some(part) = part {
                part(worker);
            }
        };
        execute_from(workers, guard, WorkerConfig::default(), run).map(|guards| drop(guards.join()))
    });
    running.map_err(|error| ClusterError::Connect(error.to_string()))
}

/// The one worker of this process, and what has to live as long as it.
fn workers(
    connections: Vec<Option<TcpStream>>,
    process: usize,
) -> Result<(Vec<AllocatorBuilder>, Box<dyn Any + Send>), String> {
    if connections.len() == 1 {
        return CommunicationConfig::Thread.try_build();
    }
    let hooks = Hooks::default();
    let inside = ProcessBuilder::new_typed_vector(1, hooks.refill.clone(), None);
    let joined = initialize_networking_from_sockets(inside, connections, process, 1, hooks);
    let (workers, guard) = joined.map_err(|error| error.to_string())?;
    Ok((workers.into_iter().map(AllocatorBuilder::Tcp).collect(), Box::new(guard)))
}
