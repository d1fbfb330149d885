//! The processes of a search: where each of them listens, and which this one is.

use std::net::TcpListener;

/// The addresses of all processes, and which of them this one is.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Hosts {
    addresses: Vec<String>,
    process: usize,
}

/// Why addresses are none.
#[derive(Debug, thiserror::Error)]
pub enum HostsError {
    /// An address without a port.
    #[error("line {line}: `{text}` is no address: write one a line, a host and a port, like robot-7:2101")]
    Address {
        /// The line, the first being 1.
        line: usize,
        /// What stands there.
        text: String,
    },
    /// Two processes at one address.
    #[error("line {line}: `{text}` stands there twice: every process needs a port of its own")]
    Twice {
        /// The line, the first being 1.
        line: usize,
        /// What stands there.
        text: String,
    },
    /// There is no such process.
    #[error(
        "there is no process {process}: {processes} addresses are listed, and processes are counted from 0"
    )]
    Process {
        /// The process.
        process: usize,
        /// How many there are.
        processes: usize,
    },
    /// The system gives no ports.
    #[error("this machine has no ports for the processes: {0}")]
    Ports(#[from] std::io::Error),
}

impl Hosts {
    /// The processes whose addresses are the lines of a text, and which of them this one is, counted from 0. Empty lines and those that begin
    /// with # say nothing.
    ///
    /// # Errors
    /// If a line is no address, an address stands there twice, or there is no such process.
    pub fn read(text: &str, process: usize) -> Result<Self, HostsError> {
        let mut addresses: Vec<String> = Vec::new();
        for (number, line) in text.lines().enumerate() {
            let (line, address) = (number + 1, line.trim());
            if address.is_empty() || address.starts_with('#') {
                continue;
            }
            let text = || address.to_owned();
            let port = address.rsplit_once(':').filter(|(host, _)| !host.is_empty());
            if port.and_then(|(_, port)| port.parse::<u16>().ok()).is_none_or(|port| port == 0) {
                return Err(HostsError::Address { line, text: text() });
            }
            if addresses.iter().any(|other| other == address) {
                return Err(HostsError::Twice { line, text: text() });
            }
            addresses.push(text());
        }
        let processes = addresses.len();
        if process < processes {
            Ok(Hosts { addresses, process })
        } else {
            Err(HostsError::Process { process, processes })
        }
    }

    /// So many processes of this machine, of which this is the first.
    ///
    /// # Errors
    /// If the system gives no ports.
    pub fn local(processes: usize) -> Result<Self, HostsError> {
        // All are held until all are known, so that no two are the same.
        let held: Vec<TcpListener> =
            (0..processes.max(1)).map(|_| TcpListener::bind("127.0.0.1:0")).collect::<Result<_, _>>()?;
        let addresses = held.iter().map(|listener| Ok(listener.local_addr()?.to_string()));
        Ok(Hosts { addresses: addresses.collect::<std::io::Result<_>>()?, process: 0 })
    }

    /// By process: where it listens.
    #[must_use]
    pub fn addresses(&self) -> &[String] {
        &self.addresses
    }

    /// Which of them this one is.
    #[must_use]
    pub fn process(&self) -> usize {
        self.process
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn addresses_are_lines() {
        let hosts = Hosts::read("# two\n\n a:2101 \n[::1]:2102\n", 1).unwrap();
        assert_eq!(
            (hosts.addresses(), hosts.process()),
            (&["a:2101".to_owned(), "[::1]:2102".to_owned()][..], 1)
        );
        for (text, process, words) in [
            ("a:2101\nb\n", 0, "line 2: `b` is no address"),
            (":2101\n", 0, "line 1"),
            ("a:0\n", 0, "line 1"),
            ("a:1\na:1\n", 0, "line 2: `a:1` stands there twice"),
            ("a:1\nb:1\n", 2, "no process 2: 2 addresses"),
            ("", 0, "no process 0"),
        ] {
            let error = Hosts::read(text, process).unwrap_err().to_string();
            assert!(error.contains(words), "{error}");
        }
    }

    #[test]
    fn local_processes_have_ports_of_their_own() {
        let hosts = Hosts::local(4).unwrap();
        assert!(Hosts::read(&hosts.addresses().join("\n"), 3).is_ok());
    }
}
