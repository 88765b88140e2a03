//! Ports on 127.0.0.1 for the robots of a test.
//!
//! A port that the system picks, asked for and given back, may go to somebody else before the robot of the
//! test binds it: to the next test, or to any connection that goes out. So these come from below the range
//! that systems pick from, and no port is given twice in one process.

use std::net::{TcpListener, UdpSocket};
use std::process;
use std::sync::Mutex;

/// Below what Linux (from 32768) and others (from 49152) pick by themselves.
const FIRST: u16 = 12_000;
const LAST: u16 = 31_999;

/// Where to look for the next free ports.
static NEXT: Mutex<Option<u16>> = Mutex::new(None);

/// The first of this many ports in a row that are free, for UDP and for TCP.
pub fn free_ports(ports: u16) -> u16 {
    let mut next = NEXT.lock().unwrap();
    // Processes that run at the same time begin at places of their own.
    let own = u16::try_from(process::id() % 100).unwrap() * 200;
    let mut first = next.unwrap_or(FIRST + own);
    loop {
        if first + ports > LAST {
            first = FIRST;
        }
        match (first..first + ports).rfind(|port| !is_free(*port)) {
            Some(taken) => first = taken + 1,
            None => break,
        }
    }
    *next = Some(first + ports);
    first
}

/// The first of two ports in a row that are free.
pub fn two_free_ports() -> u16 {
    free_ports(2)
}

fn is_free(port: u16) -> bool {
    UdpSocket::bind(("127.0.0.1", port)).is_ok() && TcpListener::bind(("127.0.0.1", port)).is_ok()
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;
    use std::thread;

    use super::*;

    #[test]
    fn no_port_is_given_twice() {
        let runs: Vec<_> = (0..8)
            .map(|_| thread::spawn(|| [1, 2, 3, 4].map(|ports| (free_ports(ports), ports))))
            .collect();
        let given: Vec<u16> = runs
            .into_iter()
            .flat_map(|run| run.join().unwrap())
            .flat_map(|(first, ports)| first..first + ports)
            .collect();
        assert_eq!(given.len(), 8 * 10);
        assert_eq!(given.iter().collect::<BTreeSet<_>>().len(), given.len());
    }

    #[test]
    fn a_port_that_is_taken_is_not_given() {
        let taken = TcpListener::bind(("127.0.0.1", free_ports(1))).unwrap();
        assert!(!is_free(taken.local_addr().unwrap().port()));
    }
}
