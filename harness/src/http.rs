//! A small HTTP server for what a process tells of itself: it answers GET, and reads no more than a head.
//!
//! Each client is served by a thread of its own, so that one that asks nothing delays no other. There is a limit to
//! how many are served at once, to how much is read of each, and to how long one may take.

use std::borrow::Cow;
use std::io::{ErrorKind, Read, Write};
use std::net::{SocketAddr, TcpListener, TcpStream};
use std::sync::Arc;
use std::time::{Duration, Instant};

/// How long a client may take to ask, and to take the answer.
pub(crate) const PATIENCE: Duration = Duration::from_secs(2);

/// The longest request that is read, in octets.
const REQUEST_MAX: usize = 8_192;

/// How many clients are served at once; the next one is turned away.
pub(crate) const CLIENTS_MAX: usize = 32;

/// What a client asks for with GET.
pub(crate) struct Request<'a> {
    /// The path, as it was sent.
    pub(crate) path: &'a str,
    /// What stands after the question mark.
    pub(crate) query: &'a str,
    /// The host that the client takes this server for, if it says one.
    pub(crate) host: Option<&'a str>,
}

/// What it gets.
pub(crate) struct Answer {
    /// Code and words.
    pub(crate) status: &'static str,
    pub(crate) content_type: &'static str,
    /// More lines of the head, each with its end.
    pub(crate) headers: &'static str,
    pub(crate) body: Cow<'static, str>,
}

/// Serves at `address` until the process ends. The address that is served, where the port that was given is 0.
///
/// # Errors
/// When nothing can be served there.
pub(crate) fn serve(
    address: SocketAddr,
    name: &'static str,
    answer: impl Fn(&Request) -> Answer + Send + Sync + 'static,
) -> std::io::Result<SocketAddr> {
    let listener = TcpListener::bind(address)?;
    let address = listener.local_addr()?;
    let answer = Arc::new(answer);
    std::thread::Builder::new()
        .name(name.to_owned())
        .spawn(move || {
            // Each client that is served holds a clone.
            let clients = Arc::new(());
            for client in listener.incoming() {
                let served = client.and_then(|client| attend(client, name, &answer, &clients));
                if let Err(error) = served {
                    tracing::debug!(%error, "a client of the {name} is not served");
                }
            }
        })?;
    Ok(address)
}

/// Serves a client in a thread, unless there are too many of them.
fn attend<F>(
    client: TcpStream,
    name: &'static str,
    answer: &Arc<F>,
    clients: &Arc<()>,
) -> std::io::Result<()>
where
    F: Fn(&Request) -> Answer + Send + Sync + 'static,
{
    if Arc::strong_count(clients) > CLIENTS_MAX {
        return Err(std::io::Error::other("too many clients at once"));
    }
    let (answer, slot) = (Arc::clone(answer), Arc::clone(clients));
    let serve = move || {
        if let Err(error) = converse(&client, &*answer) {
            tracing::debug!(%error, "a client of the {name} went away");
        }
        drop(slot);
    };
    let thread = std::thread::Builder::new().name(format!("{name} client"));
    thread.spawn(serve).map(|_| ())
}

fn converse(mut client: &TcpStream, answer: impl Fn(&Request) -> Answer) -> std::io::Result<()> {
    client.set_write_timeout(Some(PATIENCE))?;
    let head = head(client)?;
    let mut lines = head.split("\r\n");
    let mut words = lines.next().unwrap_or_default().split_whitespace();
    let method = words.next();
    let target = words.next().unwrap_or_default();
    let (path, query) = target.split_once('?').unwrap_or((target, ""));
    let host = lines.find_map(|line| {
        let (name, value) = line.split_once(':')?;
        name.eq_ignore_ascii_case("host").then_some(value.trim())
    });
    let Answer {
        status,
        content_type,
        headers,
        body,
    } = match method {
        Some("GET") => answer(&Request { path, query, host }),
        _ => Answer {
            status: "405 Method Not Allowed",
            content_type: "text/plain; charset=utf-8",
            headers: "Allow: GET\r\n",
            body: "GET is possible\n".into(),
        },
    };
    let length = body.len();
    write!(
        client,
        "HTTP/1.1 {status}\r\nContent-Type: {content_type}\r\nContent-Length: {length}\r\n{headers}\
         Connection: close\r\n\r\n{body}"
    )
}

/// A request up to the empty line that ends it, all of which is read so that the client gets the answer. A client
/// has [`PATIENCE`] for all of it.
fn head(mut client: &TcpStream) -> std::io::Result<String> {
    let until = Instant::now() + PATIENCE;
    let mut request = Vec::new();
    let mut part = [0; 1_024];
    while !request.windows(4).any(|octets| octets == b"\r\n\r\n") && request.len() < REQUEST_MAX {
        let left = until.saturating_duration_since(Instant::now());
        if left.is_zero() {
            return Err(ErrorKind::TimedOut.into());
        }
        client.set_read_timeout(Some(left))?;
        match client.read(&mut part)? {
            0 => break,
            length => request.extend_from_slice(&part[..length]),
        }
    }
    Ok(String::from_utf8_lossy(&request).into_owned())
}
