//! The connections between the processes of a check, each with the other's word that it checks the same.
//!
//! timely would connect by itself, but it waits without end for a process that never comes, and asks nobody what
//! they are about to compute.

use std::io::{Read, Write};
use std::net::{TcpListener, TcpStream, ToSocketAddrs};
use std::thread::sleep;
use std::time::{Duration, Instant};

use socket2::{SockRef, TcpKeepalive};

use crate::hosts::Cluster;

/// Why the processes did not come together.
#[derive(Debug, thiserror::Error)]
pub enum ConnectError {
    /// This process cannot listen at its address.
    #[error("process {process} cannot listen at {address}: {cause}")]
    CannotListen {
        /// The number of this process.
        process: usize,
        /// Its address.
        address: String,
        /// Why.
        cause: std::io::Error,
    },
    /// A process was not there in time.
    #[error("process {process} ({address}) was not there within {seconds} s")]
    NotThere {
        /// Its number.
        process: usize,
        /// Its address.
        address: String,
        /// How long it was waited for.
        seconds: u64,
    },
    /// A process checks something else.
    #[error(
        "process {process} checks something else: all processes need the same scenario, the same --workers, --max-states \
         and --timeout and the same build of crossguard"
    )]
    Different {
        /// Its number.
        process: usize,
    },
    /// A process has another file of hosts.
    #[error(
        "a process says that it is number {process} of {processes}, which this one has no place for: all need the \
         same hosts, and each a --process of its own"
    )]
    OtherHosts {
        /// The number that it goes by.
        process: u64,
        /// How many processes it knows of.
        processes: u64,
    },
}

const MAGIC: &[u8; 8] = b"crossgd1";
const HELLO: usize = 8 + 16 + 8 + 8;

/// How long a process that has connected may take to say what it checks.
const TO_SAY: Duration = Duration::from_secs(5);

#[derive(Clone, Copy, PartialEq, Eq, Debug)]
struct Hello {
    digest: u128,
    process: u64,
    processes: u64,
}

impl Hello {
    fn send(self, stream: &mut TcpStream) -> std::io::Result<()> {
        let mut bytes = MAGIC.to_vec();
        bytes.extend(self.digest.to_be_bytes());
        bytes.extend(self.process.to_be_bytes());
        bytes.extend(self.processes.to_be_bytes());
        stream.write_all(&bytes)
    }

    /// `None` where something else than a process of a check speaks.
    fn receive(stream: &mut TcpStream) -> Option<Self> {
        let mut bytes = [0; HELLO];
        stream.set_read_timeout(Some(TO_SAY)).ok()?;
        stream.read_exact(&mut bytes).ok()?;
        stream.set_read_timeout(None).ok()?;
        let (magic, rest) = bytes.split_first_chunk::<8>()?;
        let (digest, rest) = rest.split_first_chunk()?;
        let (process, rest) = rest.split_first_chunk()?;
        let (processes, _) = rest.split_first_chunk()?;
        (magic == MAGIC).then(|| Self {
            digest: u128::from_be_bytes(*digest),
            process: u64::from_be_bytes(*process),
            processes: u64::from_be_bytes(*processes),
        })
    }

    /// It comes from a process with another list of hosts.
    const fn has_no_place(&self) -> ConnectError {
        ConnectError::OtherHosts {
            process: self.process,
            processes: self.processes,
        }
    }
}

/// Connects this process to all others: it calls those of lower numbers and is called by those of higher ones.
/// The result has one stream for each, none for this process itself.
pub(crate) fn connect(
    cluster: &Cluster,
    digest: u128,
    patience: Duration,
) -> Result<Vec<Option<TcpStream>>, ConnectError> {
    let process = cluster.process;
    let own = &cluster.addresses[process];
    let listener = TcpListener::bind(own).and_then(|listener| {
        listener.set_nonblocking(true)?;
        Ok(listener)
    });
    let listener = listener.map_err(|cause| ConnectError::CannotListen {
        process,
        address: own.clone(),
        cause,
    })?;
    let meeting = Meeting {
        cluster,
        hello: Hello {
            digest,
            process: process as u64,
            processes: cluster.processes() as u64,
        },
        patience,
        until: Instant::now() + patience,
    };
    let mut streams: Vec<Option<TcpStream>> = (0..cluster.processes()).map(|_| None).collect();
    for (other, stream) in streams.iter_mut().enumerate().take(process) {
        *stream = Some(meeting.call(other)?);
    }
    while let Some(missing) = (process + 1..streams.len()).find(|&other| streams[other].is_none()) {
        match listener.accept() {
            Ok((stream, _)) => {
                if let Some((other, stream)) = meeting.answer(stream)? {
                    if streams[other].is_some() {
                        return Err(ConnectError::OtherHosts {
                            process: other as u64,
                            processes: meeting.hello.processes,
                        });
                    }
                    streams[other] = Some(stream);
                }
            }
            // Nobody calls, or the caller is gone again.
            Err(_) => meeting.wait_for(missing)?,
        }
    }
    streams.iter().flatten().for_each(watch_over);
    Ok(streams)
}

struct Meeting<'a> {
    cluster: &'a Cluster,
    hello: Hello,
    patience: Duration,
    until: Instant,
}

impl Meeting<'_> {
    fn wait_for(&self, process: usize) -> Result<(), ConnectError> {
        if Instant::now() >= self.until {
            return Err(ConnectError::NotThere {
                process,
                address: self.cluster.addresses[process].clone(),
                seconds: self.patience.as_secs(),
            });
        }
        sleep(Duration::from_millis(20));
        Ok(())
    }

    fn call(&self, other: usize) -> Result<TcpStream, ConnectError> {
        loop {
            if let Some(mut stream) = reach(&self.cluster.addresses[other])
                && self.hello.send(&mut stream).is_ok()
                && let Some(said) = Hello::receive(&mut stream)
            {
                self.compare(said)?;
                if said.process != other as u64 {
                    return Err(said.has_no_place());
                }
                return Ok(stream);
            }
            self.wait_for(other)?;
        }
    }

    /// Nothing where something else than a process of a check has called.
    fn answer(&self, mut stream: TcpStream) -> Result<Option<(usize, TcpStream)>, ConnectError> {
        let blocks = stream.set_nonblocking(false).is_ok();
        let said = Hello::receive(&mut stream).filter(|_| blocks);
        let Some(said) = said else {
            return Ok(None);
        };
        // It is told too, so that it can say the same.
        let is_told = self.hello.send(&mut stream).is_ok();
        self.compare(said)?;
        match usize::try_from(said.process) {
            Ok(other) if other > self.cluster.process && other < self.cluster.processes() => {
                Ok(is_told.then_some((other, stream)))
            }
            _ => Err(said.has_no_place()),
        }
    }

    fn compare(&self, said: Hello) -> Result<(), ConnectError> {
        if said.processes != self.hello.processes {
            return Err(said.has_no_place());
        }
        if said.digest != self.hello.digest {
            let process = usize::try_from(said.process).unwrap_or(usize::MAX);
            return Err(ConnectError::Different { process });
        }
        Ok(())
    }
}

fn reach(address: &str) -> Option<TcpStream> {
    let mut addresses = address.to_socket_addrs().ok()?;
    addresses.find_map(|address| TcpStream::connect_timeout(&address, Duration::from_secs(2)).ok())
}

/// Lets the kernel notice within about 15 s that a machine is gone which says nothing any more.
fn watch_over(stream: &TcpStream) {
    let keepalive = TcpKeepalive::new()
        .with_time(Duration::from_secs(6))
        .with_interval(Duration::from_secs(3));
    #[cfg(not(windows))]
    let keepalive = keepalive.with_retries(3);
    // A system that cannot do that notices later.
    let _ = SockRef::from(stream).set_tcp_keepalive(&keepalive);
    #[cfg(target_os = "linux")]
    let _ = SockRef::from(stream).set_tcp_user_timeout(Some(Duration::from_secs(15)));
    let _ = stream.set_nodelay(true);
}
