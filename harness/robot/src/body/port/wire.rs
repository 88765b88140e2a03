//! The sockets of the body port: who connects, and the lines that come in.

use std::fmt;
use std::io::{BufRead, BufReader, ErrorKind, Read, Write};
use std::net::{Shutdown, SocketAddr, TcpListener, TcpStream};
use std::os::unix::net::{UnixListener, UnixStream};
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, SyncSender, sync_channel};
use std::thread::JoinHandle;
use std::time::Duration;

/// Longest line of a body, in octets.
const LINE_MAX: u64 = 4_096;

/// How many lines may wait; after that the body has to.
const LINES: usize = 256;

/// How long a line may wait for room in the socket: a body that reads has room.
const WRITE_TIMEOUT: Duration = Duration::from_millis(5);

/// How often the port looks for a body that connects.
const LOOK: Duration = Duration::from_millis(20);

/// Where a body connects.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum PortAddress {
    /// A UNIX socket with this path.
    Unix(PathBuf),
    /// TCP on this machine.
    Tcp(SocketAddr),
}

impl fmt::Display for PortAddress {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Unix(path) => write!(f, "unix:{}", path.display()),
            Self::Tcp(address) => address.fmt(f),
        }
    }
}

/// A body's connection, to write to.
#[derive(Debug)]
pub(super) enum Stream {
    Unix(UnixStream),
    Tcp(TcpStream),
}

impl Stream {
    /// Writes a line, or fails: it waits for nobody.
    pub(super) fn say(&mut self, line: &str) -> std::io::Result<()> {
        match self {
            Self::Unix(stream) => stream.write_all(line.as_bytes()),
            Self::Tcp(stream) => stream.write_all(line.as_bytes()),
        }
    }

    pub(super) fn close(&self) {
        // Who is gone need not be told.
        let _ = match self {
            Self::Unix(stream) => stream.shutdown(Shutdown::Both),
            Self::Tcp(stream) => stream.shutdown(Shutdown::Both),
        };
    }

    /// Makes it ready to write to; the half to read from.
    fn prepare(&self) -> std::io::Result<Box<dyn Read + Send>> {
        Ok(match self {
            Self::Unix(stream) => {
                stream.set_nonblocking(false)?;
                stream.set_write_timeout(Some(WRITE_TIMEOUT))?;
                Box::new(stream.try_clone()?)
            }
            Self::Tcp(stream) => {
                stream.set_nonblocking(false)?;
                stream.set_nodelay(true)?;
                stream.set_write_timeout(Some(WRITE_TIMEOUT))?;
                Box::new(stream.try_clone()?)
            }
        })
    }
}

/// What comes in by the port. Connections are numbered.
#[derive(Debug)]
pub(super) enum Heard {
    Connected(u64, Stream),
    Line(u64, String),
    Closed(u64),
}

enum Bound {
    Unix(UnixListener),
    Tcp(TcpListener),
}

/// The open port; it is closed when this is dropped.
#[derive(Debug)]
pub(super) struct Listening {
    pub(super) heard: Receiver<Heard>,
    stop: Arc<AtomicBool>,
    accepting: Option<JoinHandle<()>>,
    path: Option<PathBuf>,
}

impl Drop for Listening {
    fn drop(&mut self) {
        self.stop.store(true, Ordering::Relaxed);
        // The address is free when this returns: a robot that is started again takes it.
        while let Some(accepting) = self.accepting.take_if(|it| !it.is_finished()) {
            // It may wait for room.
            while self.heard.try_recv().is_ok() {}
            std::thread::sleep(Duration::from_millis(1));
            self.accepting = Some(accepting);
        }
        if let Some(path) = &self.path {
            // Another start removes it as well.
            let _ = std::fs::remove_file(path);
        }
    }
}

/// Opens the port.
pub(super) fn listen(address: &PortAddress) -> std::io::Result<Listening> {
    let listener = match address {
        PortAddress::Unix(path) => {
            // What a robot that was killed left behind is nobody's any more.
            if UnixStream::connect(path)
                .is_err_and(|error| error.kind() == ErrorKind::ConnectionRefused)
            {
                std::fs::remove_file(path)?;
            }
            let listener = UnixListener::bind(path)?;
            listener.set_nonblocking(true)?;
            Bound::Unix(listener)
        }
        PortAddress::Tcp(address) => {
            let listener = TcpListener::bind(address)?;
            listener.set_nonblocking(true)?;
            Bound::Tcp(listener)
        }
    };
    let (tell, heard) = sync_channel(LINES);
    let stop = Arc::new(AtomicBool::new(false));
    let stopped = Arc::clone(&stop);
    let accepting = Some(std::thread::spawn(move || {
        accept(&listener, &tell, &stopped);
    }));
    let path = match address {
        PortAddress::Unix(path) => Some(path.clone()),
        PortAddress::Tcp(_) => None,
    };
    Ok(Listening {
        heard,
        stop,
        accepting,
        path,
    })
}

fn accept(listener: &Bound, tell: &SyncSender<Heard>, stop: &AtomicBool) {
    for number in 0.. {
        let stream = loop {
            if stop.load(Ordering::Relaxed) {
                return;
            }
            let accepted = match listener {
                Bound::Unix(listener) => listener.accept().map(|(it, _)| Stream::Unix(it)),
                Bound::Tcp(listener) => listener.accept().map(|(it, _)| Stream::Tcp(it)),
            };
            match accepted {
                Ok(stream) => break stream,
                Err(_) => std::thread::sleep(LOOK),
            }
        };
        let Ok(half) = stream.prepare() else { continue };
        if tell.send(Heard::Connected(number, stream)).is_err() {
            return;
        }
        let tell = tell.clone();
        std::thread::spawn(move || {
            read(half, number, &tell);
            // Nobody may be left who wants to know.
            let _ = tell.send(Heard::Closed(number));
        });
    }
}

/// Takes lines in until the connection ends, or a line has no end.
fn read(half: Box<dyn Read + Send>, number: u64, tell: &SyncSender<Heard>) {
    let mut half = BufReader::new(half);
    loop {
        let mut line = Vec::new();
        let read = half.by_ref().take(LINE_MAX).read_until(b'\n', &mut line);
        if !matches!(read, Ok(1..)) || line.last() != Some(&b'\n') {
            return;
        }
        let line = String::from_utf8_lossy(&line).into_owned();
        if tell.send(Heard::Line(number, line)).is_err() {
            return;
        }
    }
}
