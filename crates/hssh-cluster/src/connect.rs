//! Connects the processes of a search with one another. What they say then is timely's affair.

use std::io::{Read, Write};
use std::net::{TcpListener, TcpStream, ToSocketAddrs};
use std::thread;
use std::time::Duration;

use hssh_search::Monitor;

use crate::error::ClusterError;
use crate::hosts::Hosts;
use crate::loss::is_lost;

/// So much time is between two attempts.
const PAUSE: Duration = Duration::from_millis(20);

/// For so long another process may take to answer.
const PATIENCE: Duration = Duration::from_secs(2);

/// What a process says first: its number, and that of what it counts.
type Greeting = [u8; 16];

/// By process: the connection with it, nothing for this one. Each connects to those before it, and waits for those after it.
///
/// # Errors
/// If this process cannot listen, another one searches something else, one is lost, or somebody interrupts it.
pub(crate) fn connect(
    hosts: &Hosts,
    identity: u64,
    monitor: &Monitor,
) -> Result<Vec<Option<TcpStream>>, ClusterError> {
    let (me, addresses) = (hosts.process(), hosts.addresses());
    let listen = |address: &String| -> std::io::Result<TcpListener> {
        let listener = TcpListener::bind(address)?;
        listener.set_nonblocking(true)?;
        Ok(listener)
    };
    let listener = listen(&addresses[me])
        .map_err(|error| ClusterError::Listen { address: addresses[me].clone(), error })?;
    let mut connections: Vec<Option<TcpStream>> = addresses.iter().map(|_| None).collect();
    loop {
        for (process, address) in addresses[..me].iter().enumerate() {
            if connections[process].is_none() {
                connections[process] = call(address, me, identity);
            }
        }
        while let Ok((stream, _)) = listener.accept() {
            let Some((process, stream, there)) = greeted(stream) else { continue };
            if process > me && process < connections.len() && connections[process].is_none() {
                if there != identity {
                    return Err(ClusterError::Foreign(process));
                }
                connections[process] = Some(stream);
            }
        }
        if connections.iter().filter(|connection| connection.is_none()).count() == 1 {
            return Ok(connections);
        }
        if monitor.is_interrupted() {
            return Err(ClusterError::Interrupted);
        }
        if is_lost() {
            return Err(ClusterError::Lost);
        }
        thread::sleep(PAUSE);
    }
}

/// Calls another process; nothing if it is not there yet.
fn call(address: &str, me: usize, identity: u64) -> Option<TcpStream> {
    let known = address.to_socket_addrs().ok()?;
    let mut stream = known.into_iter().find_map(|known| TcpStream::connect_timeout(&known, PATIENCE).ok())?;
    let mut greeting: Greeting = [0; 16];
    greeting[..8].copy_from_slice(&(me as u64).to_le_bytes());
    greeting[8..].copy_from_slice(&identity.to_le_bytes());
    stream.write_all(&greeting).ok()?;
    stream.set_nodelay(true).ok()?;
    Some(stream)
}

/// Who calls, and what it counts; nothing if whoever it is says something else.
fn greeted(mut stream: TcpStream) -> Option<(usize, TcpStream, u64)> {
    let mut greeting: Greeting = [0; 16];
    stream.set_nonblocking(false).ok()?;
    stream.set_read_timeout(Some(PATIENCE)).ok()?;
    stream.read_exact(&mut greeting).ok()?;
    stream.set_read_timeout(None).ok()?;
    stream.set_nodelay(true).ok()?;
    let number = |bytes: &[u8]| bytes.try_into().map(u64::from_le_bytes).ok();
    let process = usize::try_from(number(&greeting[..8])?).ok()?;
    Some((process, stream, number(&greeting[8..])?))
}
