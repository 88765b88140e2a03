//! Ports: sockets by which programs on this machine talk to a robot in lines. The [body port](crate::body) is one, the
//! [operator port](crate::operator) another. Who may open the socket has the port's rights.

use std::fmt;
use std::io::{BufRead, BufReader, Error, ErrorKind, Read, Write};
use std::net::{Shutdown, SocketAddr, TcpListener, TcpStream};
use std::os::unix::fs::{FileTypeExt as _, MetadataExt as _};
use std::os::unix::net::{UnixListener, UnixStream};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, SyncSender, sync_channel};
use std::thread::JoinHandle;
use std::time::Duration;

use nix::sys::stat::{Mode, fchmod};
use socket2::{Domain, SockAddr, Socket, Type};

/// Longest line that comes in, in octets: a frame with as many people as are possible fits.
const LINE_MAX: u64 = 65_536;

/// How many lines may wait; after that who says them has to.
const LINES: usize = 256;

/// How long a line may wait for room in the socket: who reads has room.
const WRITE_TIMEOUT: Duration = Duration::from_millis(5);

/// How often a port looks for somebody who connects.
const LOOK: Duration = Duration::from_millis(20);

/// How many may wait to be taken in.
const BACKLOG: i32 = 16;

/// Where others connect.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum PortAddress {
    /// A UNIX socket with this path.
    Unix(PathBuf),
    /// TCP on this machine.
    Tcp(SocketAddr),
}

/// No address of this machine.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
#[error(
    "listen: '{0}' is no address of this machine: 'unix:PATH' or one like '127.0.0.1:47600' is wanted"
)]
pub struct NoAddress(pub String);

impl PortAddress {
    /// Understands an address; paths are relative to `folder`.
    ///
    /// # Errors
    /// When others than this machine could connect there, or nobody.
    pub fn parse(listen: &str, folder: &Path) -> Result<Self, NoAddress> {
        if let Some(path) = listen.strip_prefix("unix:").filter(|it| !it.is_empty()) {
            return Ok(Self::Unix(folder.join(path)));
        }
        let parsed = listen.parse().ok();
        let local = parsed.filter(|address: &SocketAddr| address.ip().is_loopback());
        local
            .map(Self::Tcp)
            .ok_or_else(|| NoAddress(listen.to_owned()))
    }
}

impl fmt::Display for PortAddress {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Unix(path) => write!(f, "unix:{}", path.display()),
            Self::Tcp(address) => address.fmt(f),
        }
    }
}

/// A connection, to write to.
#[derive(Debug)]
pub(crate) enum Stream {
    Unix(UnixStream),
    Tcp(TcpStream),
}

impl Stream {
    /// Writes a line, or fails: it waits for nobody.
    pub(crate) fn say(&mut self, line: &impl serde::Serialize) -> std::io::Result<()> {
        let mut line = serde_json::to_vec(line)?;
        line.push(b'\n');
        match self {
            Self::Unix(stream) => stream.write_all(&line),
            Self::Tcp(stream) => stream.write_all(&line),
        }
    }

    pub(crate) fn close(&self) {
        // Who is gone need not be told.
        let _ = match self {
            Self::Unix(stream) => stream.shutdown(Shutdown::Both),
            Self::Tcp(stream) => stream.shutdown(Shutdown::Both),
        };
    }

    /// Makes it ready to write to; the half to read from.
    pub(crate) fn prepare(&self) -> std::io::Result<Box<dyn Read + Send>> {
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

/// What comes in by a port. Connections are numbered.
#[derive(Debug)]
pub(crate) enum Heard {
    Connected(u64, Stream),
    Line(u64, String),
    Closed(u64),
}

enum Bound {
    Unix(UnixListener),
    Tcp(TcpListener),
}

/// An open port; it is closed when this is dropped.
#[derive(Debug)]
pub struct Listening {
    pub(crate) heard: Receiver<Heard>,
    stop: Arc<AtomicBool>,
    accepting: Option<JoinHandle<()>>,
    /// The file of a UNIX socket, and which it is.
    file: Option<(PathBuf, Which)>,
}

/// Device and number of a file.
type Which = (u64, u64);

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
        if let Some((path, which)) = &self.file
            && socket_at(path).is_some_and(|found| found == *which)
        {
            // Another start removes it as well.
            let _ = std::fs::remove_file(path);
        }
    }
}

/// Which socket has this path, if one does.
fn socket_at(path: &Path) -> Option<Which> {
    let found = std::fs::symlink_metadata(path).ok()?;
    let is_socket = found.file_type().is_socket();
    is_socket.then(|| (found.dev(), found.ino()))
}

/// Binds a socket that its owner alone may open. A file that is no socket stays where it is.
fn bind(path: &Path) -> std::io::Result<UnixListener> {
    if socket_at(path).is_some() {
        // What a robot that was killed left behind is nobody's any more.
        if UnixStream::connect(path)
            .is_err_and(|error| error.kind() == ErrorKind::ConnectionRefused)
        {
            std::fs::remove_file(path)?;
        }
    } else if std::fs::symlink_metadata(path).is_ok() {
        let what = format!("{} is there, and is no socket", path.display());
        return Err(Error::new(ErrorKind::AlreadyExists, what));
    }
    let socket = Socket::new(Domain::UNIX, Type::STREAM, None)?;
    // The file gets the mode that the socket has, so that nobody else can open it meanwhile.
    fchmod(&socket, Mode::S_IRUSR | Mode::S_IWUSR)?;
    socket.bind(&SockAddr::unix(path)?)?;
    socket.listen(BACKLOG)?;
    Ok(UnixListener::from(std::os::fd::OwnedFd::from(socket)))
}

/// Opens a port.
///
/// # Errors
/// When the operating system does not open the socket, or a file that is no socket has its path.
pub fn listen(address: &PortAddress) -> std::io::Result<Listening> {
    let (listener, file) = match address {
        PortAddress::Unix(path) => {
            let listener = bind(path)?;
            listener.set_nonblocking(true)?;
            let file = socket_at(path).map(|which| (path.clone(), which));
            (Bound::Unix(listener), file)
        }
        PortAddress::Tcp(address) => {
            let listener = TcpListener::bind(address)?;
            listener.set_nonblocking(true)?;
            (Bound::Tcp(listener), None)
        }
    };
    let (tell, heard) = sync_channel(LINES);
    let stop = Arc::new(AtomicBool::new(false));
    let stopped = Arc::clone(&stop);
    let accepting = Some(std::thread::spawn(move || {
        accept(&listener, &tell, &stopped);
    }));
    Ok(Listening {
        heard,
        stop,
        accepting,
        file,
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

#[cfg(test)]
mod tests {
    use std::os::unix::fs::PermissionsExt as _;

    use super::*;

    #[test]
    fn a_socket_is_its_owners_alone_and_no_other_file_is_removed_for_it() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("port.sock");
        let address = PortAddress::Unix(path.clone());
        let port = listen(&address).unwrap();
        let mode = std::fs::metadata(&path).unwrap().permissions().mode();
        assert_eq!(mode & 0o777, 0o600);
        assert!(listen(&address).is_err(), "it is in use");
        drop(port);
        assert!(!path.exists());
        // What a process that was killed leaves behind.
        drop(UnixListener::bind(&path).unwrap());
        let port = listen(&address).unwrap();
        // Somebody else took the place of its file.
        std::fs::write(folder.path().join("other"), "kept").unwrap();
        std::fs::rename(folder.path().join("other"), &path).unwrap();
        drop(port);
        assert!(listen(&address).is_err(), "it is no socket");
        assert_eq!(std::fs::read_to_string(&path).unwrap(), "kept");
    }
}
