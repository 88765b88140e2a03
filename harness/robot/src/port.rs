//! Ports: UNIX sockets by which programs on this machine talk to a robot in lines. The [body port](crate::body) is one, the
//! [operator port](crate::operator) another. A program that connects has the port's rights, so the socket is its owner's alone:
//! by its mode, and by the user that the kernel names.

use std::fmt;
use std::io::{BufRead, BufReader, Error, ErrorKind, Read, Write};
use std::net::{IpAddr, Shutdown, SocketAddr, TcpStream};
use std::os::unix::fs::{FileTypeExt as _, MetadataExt as _};
use std::os::unix::net::{UnixListener, UnixStream};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, SyncSender, sync_channel};
use std::thread::JoinHandle;
use std::time::Duration;

use nix::sys::socket::{getsockopt, sockopt::PeerCredentials};
use nix::sys::stat::{Mode, fchmod};
use nix::unistd::geteuid;
use socket2::{Domain, SockAddr, Socket, Type};

/// Longest line that comes in, in octets: a frame with as many people as are possible fits.
const LINE_MAX: u64 = 65_536;

/// Why a line cannot be read.
const TOO_LONG: &str = "a line has more than 65,536 octets";
const TORN: &str = "the connection ended in the middle of a line";

/// How many lines may wait; after that who says them has to.
pub(crate) const LINES: usize = 256;

/// How long a line may wait for room in the socket: a peer that reads has room.
const WRITE_TIMEOUT: Duration = Duration::from_millis(5);

/// How often a port looks for somebody who connects.
const LOOK: Duration = Duration::from_millis(20);

/// How many may wait to be taken in.
const BACKLOG: i32 = 16;

/// Where others connect: the path of a UNIX socket.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct PortAddress(pub PathBuf);

/// No UNIX socket.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
#[error(
    "listen: '{0}' is no UNIX socket: \"unix:FILE\" is wanted, which its owner alone can open; any account could connect \
     to a TCP port"
)]
pub struct NoAddress(pub String);

impl PortAddress {
    /// Understands an address; paths are relative to `folder`.
    ///
    /// # Errors
    /// When others than the owner could connect there, or nobody.
    pub fn parse(listen: &str, folder: &Path) -> Result<Self, NoAddress> {
        let path = listen.strip_prefix("unix:").filter(|it| !it.is_empty());
        path.map(|path| Self(folder.join(path)))
            .ok_or_else(|| NoAddress(listen.to_owned()))
    }
}

impl fmt::Display for PortAddress {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "unix:{}", self.0.display())
    }
}

/// A connection, to write to.
#[derive(Debug)]
pub(crate) struct Stream(UnixStream);

impl Stream {
    /// Writes a line, or fails: it waits for nobody.
    pub(crate) fn say(&mut self, line: &impl serde::Serialize) -> std::io::Result<()> {
        let mut line = serde_json::to_vec(line)?;
        line.push(b'\n');
        self.0.write_all(&line)
    }

    pub(crate) fn close(&self) {
        // A program that is gone need not be told.
        let _ = self.0.shutdown(Shutdown::Both);
    }
}

/// Makes a connection ready: the half to write to, and the half to read from.
pub(crate) fn prepare(stream: UnixStream) -> std::io::Result<(Stream, UnixStream)> {
    stream.set_nonblocking(false)?;
    stream.set_write_timeout(Some(WRITE_TIMEOUT))?;
    let half = stream.try_clone()?;
    Ok((Stream(stream), half))
}

/// The user at the other end, if that is another than the one of this process. Root may connect.
fn stranger(stream: &UnixStream) -> Option<u32> {
    // A user that the kernel does not name is nobody's.
    let uid = getsockopt(stream, PeerCredentials).map_or(u32::MAX, |peer| peer.uid());
    (!is_own(uid)).then_some(uid)
}

fn is_own(uid: u32) -> bool {
    uid == geteuid().as_raw() || uid == 0
}

/// Whether a client of this machine is of the user of this process, or root, as clients of ports are. The kernel names the
/// users of established connections in `/proc/net`; a client without a name there is nobody's.
#[must_use]
pub fn is_own_client(client: &TcpStream) -> bool {
    let user = || {
        let (theirs, ours) = (client.peer_addr().ok()?, client.local_addr().ok()?);
        let version = if theirs.is_ipv4() { "" } else { "6" };
        let table = std::fs::read_to_string(format!("/proc/net/tcp{version}")).ok()?;
        let ends = format!("{} {} 01 ", end(theirs), end(ours));
        let mut lines = table.lines().filter_map(|line| line.split_once(": "));
        let rest = lines.find_map(|(_, line)| line.strip_prefix(&ends));
        rest?.split_whitespace().nth(3)?.parse().ok()
    };
    user().is_some_and(is_own)
}

/// An end of a connection as `/proc/net` spells it: the words of the address as this machine has them in memory.
fn end(address: SocketAddr) -> String {
    let octets = match address.ip() {
        IpAddr::V4(ip) => ip.octets().to_vec(),
        IpAddr::V6(ip) => ip.octets().to_vec(),
    };
    let (words, _) = octets.as_chunks();
    let words = words.iter().map(|word| u32::from_ne_bytes(*word));
    let ip: String = words
        .map(|word| hex::encode_upper(word.to_be_bytes()))
        .collect();
    format!("{ip}:{:04X}", address.port())
}

/// Connects to a port. Connections wait there until the robot takes them; where no more can wait, this one tries for so long: a robot
/// that hangs takes none.
///
/// # Errors
/// When nobody listens there, or takes this connection.
pub fn connect(port: &PortAddress, patience: Duration) -> std::io::Result<UnixStream> {
    let socket = Socket::new(Domain::UNIX, Type::STREAM, None)?;
    socket.set_write_timeout(Some(patience))?;
    socket.connect(&SockAddr::unix(&port.0)?)?;
    Ok(UnixStream::from(std::os::fd::OwnedFd::from(socket)))
}

/// Input of a port. Connections are numbered.
#[derive(Debug)]
pub(crate) enum Heard {
    Connected(u64, Stream),
    Line(u64, String),
    /// The connection ends with a line that cannot be read, for this reason; it is closed after that.
    Unread(u64, &'static str),
    Closed(u64),
    /// Another user wanted to connect, and was refused.
    Stranger(u32),
}

/// An open port; it is closed when this is dropped.
#[derive(Debug)]
pub struct Listening {
    pub(crate) heard: Receiver<Heard>,
    stop: Arc<AtomicBool>,
    accepting: Option<JoinHandle<()>>,
    /// The file of the socket, and which it is.
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
        // The socket of a robot that was killed has no owner any more.
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
    let listener = bind(&address.0)?;
    listener.set_nonblocking(true)?;
    let file = socket_at(&address.0).map(|which| (address.0.clone(), which));
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

fn accept(listener: &UnixListener, tell: &SyncSender<Heard>, stop: &AtomicBool) {
    for number in 0.. {
        let stream = loop {
            if stop.load(Ordering::Relaxed) {
                return;
            }
            match listener.accept() {
                Ok((stream, _)) => break stream,
                Err(_) => std::thread::sleep(LOOK),
            }
        };
        if let Some(uid) = stranger(&stream) {
            // A flood is counted as far as there is room, and at this pace: the owner's lines are not held up.
            let _ = tell.try_send(Heard::Stranger(uid));
            std::thread::sleep(LOOK);
            continue;
        }
        let Ok((stream, half)) = prepare(stream) else {
            continue;
        };
        if tell.send(Heard::Connected(number, stream)).is_err() {
            return;
        }
        let tell = tell.clone();
        std::thread::spawn(move || {
            read(half, number, &tell);
            // The receiver may be gone.
            let _ = tell.send(Heard::Closed(number));
        });
    }
}

/// Takes lines in until the connection ends, or a line has no end.
fn read(half: UnixStream, number: u64, tell: &SyncSender<Heard>) {
    let mut half = BufReader::new(half);
    loop {
        let mut line = Vec::new();
        // Octets that were read before an error are a line without an end, too.
        let _ = half.by_ref().take(LINE_MAX).read_until(b'\n', &mut line);
        if line.last() != Some(&b'\n') {
            if !line.is_empty() {
                let is_too_long = line.len() as u64 == LINE_MAX;
                let why = if is_too_long { TOO_LONG } else { TORN };
                let _ = tell.send(Heard::Unread(number, why));
            }
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
    use std::fs::{Permissions, set_permissions};
    use std::os::unix::fs::PermissionsExt as _;
    use std::os::unix::process::CommandExt as _;
    use std::process::Command;

    use super::*;

    #[test]
    fn point_6_a_port_is_a_unix_socket_and_no_tcp_port() {
        let parse = |listen| PortAddress::parse(listen, Path::new("robot"));
        assert_eq!(
            parse("unix:a.sock").unwrap(),
            PortAddress("robot/a.sock".into())
        );
        for other in [
            "127.0.0.1:47600",
            "[::1]:47600",
            "tcp:127.0.0.1:47600",
            "a.sock",
            "unix:",
            "",
        ] {
            let error = parse(other).unwrap_err().to_string();
            assert!(
                error.contains("\"unix:FILE\" is wanted"),
                "{other}: {error}"
            );
        }
    }

    /// Hazard: another account of the machine becomes the body, says *in position*, and the corridor opens without a guard. The
    /// mode of the socket is the first fence; here it is down, as after `chmod`.
    #[test]
    fn point_6_another_user_is_refused_and_told_of() {
        if !geteuid().is_root() {
            println!("SKIPPED point_6_another_user_is_refused_and_told_of: it takes root");
            return;
        }
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("port.sock");
        let port = listen(&PortAddress(path.clone())).unwrap();
        let connect = "import socket, sys; it = socket.socket(socket.AF_UNIX); it.settimeout(60); \
                       it.connect(sys.argv[1]); it.send(b'{}\\n'); sys.exit(len(it.recv(1)))";
        let mut stranger = Command::new("/usr/bin/python3");
        stranger.args(["-c", connect]).arg(&path).uid(12_345);
        stranger.stderr(std::process::Stdio::null());
        let Ok(ended) = stranger.status() else {
            println!("SKIPPED point_6_another_user_is_refused_and_told_of: there is no python3");
            return;
        };
        assert!(!ended.success(), "the mode keeps it out");
        assert!(port.heard.try_recv().is_err());
        set_permissions(folder.path(), Permissions::from_mode(0o755)).unwrap();
        set_permissions(&path, Permissions::from_mode(0o666)).unwrap();
        stranger.status().unwrap();
        let heard = port.heard.recv_timeout(Duration::from_mins(1)).unwrap();
        assert!(matches!(heard, Heard::Stranger(12_345)), "{heard:?}");
        assert!(port.heard.try_recv().is_err(), "nothing of its line");
        let _owner = UnixStream::connect(&path).unwrap();
        let heard = port.heard.recv_timeout(Duration::from_mins(1)).unwrap();
        assert!(matches!(heard, Heard::Connected(..)), "{heard:?}");
    }

    /// Hazard: the studio, which is on TCP, opens the operator port to every account of the machine.
    #[test]
    fn a_tcp_client_of_another_user_is_no_own_client() {
        let python = "import socket, sys; it = socket.create_connection(('127.0.0.1', int(sys.argv[1]))); \
                      it.settimeout(60); it.recv(1)";
        for listen in ["127.0.0.1:0", "[::1]:0"] {
            let Ok(listener) = std::net::TcpListener::bind(listen) else {
                println!("SKIPPED a_tcp_client_of_another_user_is_no_own_client at {listen}");
                continue;
            };
            let address = listener.local_addr().unwrap();
            let own = TcpStream::connect(address).unwrap();
            let client = listener.accept().unwrap().0;
            assert!(is_own_client(&client), "{listen}");
            // The kernel names no user of a connection that its client has closed.
            drop(own);
            while is_own_client(&client) {
                std::thread::yield_now();
            }
        }
        if !geteuid().is_root() {
            println!("SKIPPED a_tcp_client_of_another_user_is_no_own_client: it takes root");
            return;
        }
        let listener = std::net::TcpListener::bind("127.0.0.1:0").unwrap();
        let port = listener.local_addr().unwrap().port().to_string();
        let mut stranger = Command::new("/usr/bin/python3");
        let Ok(mut child) = stranger.args(["-c", python, &port]).uid(12_345).spawn() else {
            println!("SKIPPED a_tcp_client_of_another_user_is_no_own_client: there is no python3");
            return;
        };
        let client = listener.accept().unwrap().0;
        assert!(!is_own_client(&client));
        drop(client);
        child.wait().unwrap();
    }

    #[test]
    fn a_line_that_cannot_be_read_is_told_of_before_the_connection_ends() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("port.sock");
        let port = listen(&PortAddress(path.clone())).unwrap();
        let heard = || port.heard.recv_timeout(Duration::from_mins(1)).unwrap();
        let longest = usize::try_from(LINE_MAX).unwrap();
        for (length, expected) in [(longest, TOO_LONG), (longest - 1, TORN)] {
            let mut other = UnixStream::connect(&path).unwrap();
            assert!(matches!(heard(), Heard::Connected(..)));
            other.write_all(b"{}\n").unwrap();
            assert!(matches!(heard(), Heard::Line(..)));
            other.write_all(&vec![b'a'; length]).unwrap();
            drop(other);
            assert!(matches!(heard(), Heard::Unread(_, why) if why == expected));
            assert!(matches!(heard(), Heard::Closed(_)));
        }
    }

    #[test]
    fn a_socket_is_its_owners_alone_and_no_other_file_is_removed_for_it() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("port.sock");
        let address = PortAddress(path.clone());
        let port = listen(&address).unwrap();
        let mode = std::fs::metadata(&path).unwrap().permissions().mode();
        assert_eq!(mode & 0o777, 0o600);
        assert!(listen(&address).is_err(), "it is in use");
        drop(port);
        assert!(!path.exists());
        // A process that was killed leaves its socket behind.
        drop(UnixListener::bind(&path).unwrap());
        let port = listen(&address).unwrap();
        // Another file took the place of its file.
        std::fs::write(folder.path().join("other"), "kept").unwrap();
        std::fs::rename(folder.path().join("other"), &path).unwrap();
        drop(port);
        assert!(listen(&address).is_err(), "it is no socket");
        assert_eq!(std::fs::read_to_string(&path).unwrap(), "kept");
    }
}
