//! A small HTTP server for what a process tells of itself: it answers GET and HEAD, and POST where it is served so.
//!
//! A page of somebody else in a browser on this machine gets nothing: a name that was made to lead here is not answered, and a
//! POST from another origin is not done.
//!
//! Each client is served by a thread of its own, so that one that asks nothing delays no other. There is a limit to
//! how many are served at once, to how much is read of each, and to how long one may take.

use std::borrow::Cow;
use std::io::{ErrorKind, Read, Write};
use std::net::{IpAddr, Shutdown, SocketAddr, TcpListener, TcpStream};
use std::sync::Arc;
use std::time::{Duration, Instant};

use crossguard_robot::port::is_own_client;

/// How long a client may take to ask, and to take the answer.
const PATIENCE: Duration = Duration::from_secs(2);

/// How fast a client sends the body of a POST at least, in octets per second, after [`PATIENCE`].
const OCTETS_PER_S_MIN: usize = 1 << 20;

/// The longest request that is read, in octets.
const REQUEST_MAX: usize = 8_192;

/// How many clients are served at once; the next one is turned away.
pub(crate) const CLIENTS_MAX: usize = 32;

/// Request of a client.
pub(crate) struct Request<'a> {
    /// The path, as it was sent.
    pub(crate) path: &'a str,
    /// The text after the question mark.
    pub(crate) query: &'a str,
    /// The body of a POST; empty with GET.
    pub(crate) body: &'a [u8],
    content_type: Option<&'a str>,
    client: &'a TcpStream,
}

impl Request<'_> {
    /// Why this request may not do anything, if so: it may be of a page of another origin, for which a browser sends no JSON
    /// unasked, or of another user of the machine.
    pub(crate) fn foreign(&self) -> Option<&'static str> {
        if self.content_type != Some("application/json") {
            return Some("a POST of application/json is wanted\n");
        }
        let cause = "another user of this machine asks, or the kernel does not name the user in /proc/net\n";
        (!is_own_client(self.client)).then_some(cause)
    }
}

/// Answer to a client.
pub(crate) struct Answer {
    /// Code and words.
    pub(crate) status: &'static str,
    pub(crate) content_type: &'static str,
    /// More lines of the head, each with its end.
    pub(crate) headers: Cow<'static, str>,
    pub(crate) body: Cow<'static, str>,
}

/// Serves at `address` until the process ends. The address that is served, where the port that was given is 0.
/// Up to `body_max` of the path octets are read of the body of a POST; where it is 0, POST is refused. Fails where
/// nothing can be served there.
pub(crate) fn serve(
    address: SocketAddr,
    name: &'static str,
    body_max: fn(&str) -> usize,
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
                // A client that is not served sees that the connection ends.
                let _ = client
                    .and_then(|client| attend(client, name, body_max, address, &answer, &clients));
            }
        })?;
    Ok(address)
}

/// Serves a client in a thread, unless there are too many of them.
fn attend<F>(
    client: TcpStream,
    name: &'static str,
    body_max: fn(&str) -> usize,
    address: SocketAddr,
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
        // The client may have gone away.
        let _ = converse(&client, body_max, address, &*answer);
        drop(slot);
    };
    let thread = std::thread::Builder::new().name(format!("{name} client"));
    thread.spawn(serve).map(|_| ())
}

fn converse(
    mut client: &TcpStream,
    body_max: fn(&str) -> usize,
    address: SocketAddr,
    answer: impl Fn(&Request) -> Answer,
) -> std::io::Result<()> {
    client.set_write_timeout(Some(PATIENCE))?;
    let until = Instant::now() + PATIENCE;
    let (head, begun) = head(client, until)?;
    let mut lines = head.split("\r\n");
    let mut words = lines.next().unwrap_or_default().split_whitespace();
    let method = words.next();
    let target = words.next().unwrap_or_default();
    let (path, query) = target.split_once('?').unwrap_or((target, ""));
    let body_max = body_max(path);
    let field = |wanted: &str| {
        lines.clone().find_map(|line| {
            let (name, value) = line.split_once(':')?;
            name.eq_ignore_ascii_case(wanted).then_some(value.trim())
        })
    };
    let host = field("host");
    // A page that is only looked at may be asked by any name where others than this machine reach it.
    let is_open = body_max == 0 && !address.ip().is_loopback();
    let same_origin = |origin: &str| origin.split_once("://").map(|(_, it)| it) == host;
    let length = field("content-length").map_or(Some(0), |length| length.parse().ok());
    let content_type = field("content-type");
    let ask = |body| {
        answer(&Request {
            path,
            query,
            body,
            content_type,
            client,
        })
    };
    let Answer {
        status,
        content_type,
        headers,
        body,
    } = match (method, length) {
        _ if !is_open && !is_own(host, address) => refusal(
            "421 Misdirected Request",
            "",
            "127.0.0.1, localhost and the address that is served are answered to\n",
        ),
        (Some("GET" | "HEAD"), _) => ask(&[]),
        (Some("POST"), _) if field("origin").is_some_and(|it| !same_origin(it)) => {
            refusal("403 Forbidden", "", "a page of another origin asks\n")
        }
        (Some("POST"), Some(length)) if body_max > 0 && length <= body_max => {
            let until = until + Duration::from_secs(length.div_ceil(OCTETS_PER_S_MIN) as u64);
            ask(&body(client, begun, length, until)?)
        }
        (Some("POST"), _) if body_max > 0 => refusal(
            "413 Content Too Large",
            "",
            format!(
                "{body_max} octets are possible; the command takes longer files: crossguard studio\n"
            ),
        ),
        _ if body_max > 0 => refusal(
            NOT_ALLOWED,
            "Allow: GET, HEAD, POST\r\n",
            "GET and POST are possible\n",
        ),
        _ => refusal(NOT_ALLOWED, "Allow: GET, HEAD\r\n", "GET is possible\n"),
    };
    let length = body.len();
    let body = if method == Some("HEAD") { "" } else { &body };
    write!(
        client,
        "HTTP/1.1 {status}\r\nContent-Type: {content_type}\r\nContent-Length: {length}\r\n{headers}\
         Connection: close\r\n\r\n{body}"
    )?;
    // A client that is refused while it sends gets the answer only if the rest is read.
    client.shutdown(Shutdown::Write)?;
    let mut rest = Vec::new();
    while read_more(client, &mut rest, until)? {
        rest.clear();
    }
    Ok(())
}

const NOT_ALLOWED: &str = "405 Method Not Allowed";

fn refusal(
    status: &'static str,
    headers: &'static str,
    body: impl Into<Cow<'static, str>>,
) -> Answer {
    Answer {
        status,
        content_type: "text/plain; charset=utf-8",
        headers: headers.into(),
        body: body.into(),
    }
}

/// Whether a client means this server, and not a name of somebody else that was made to lead here.
fn is_own(host: Option<&str>, address: SocketAddr) -> bool {
    let Some(host) = host else { return false };
    let bracket = host.rfind(']').unwrap_or(0);
    let name = match host.rfind(':').filter(|colon| *colon > bracket) {
        Some(colon) => &host[..colon],
        None => host,
    };
    let ip = address.ip();
    let own = match ip {
        IpAddr::V4(ip) => ip.to_string(),
        IpAddr::V6(ip) => format!("[{ip}]"),
    };
    // At all addresses of a machine its own are meant, and a number is nobody's name.
    let plain = name.trim_start_matches('[').trim_end_matches(']');
    let is_number = ip.is_unspecified() && plain.parse::<IpAddr>().is_ok();
    ["127.0.0.1", "[::1]", "localhost", &own].contains(&name) || is_number
}

/// A request up to the empty line that ends its head, all of which is read so that the client gets the answer, and
/// what was read behind it. A client has until `until` for all of it.
fn head(client: &TcpStream, until: Instant) -> std::io::Result<(String, Vec<u8>)> {
    const END: &[u8] = b"\r\n\r\n";
    let mut request = Vec::new();
    loop {
        let end = request.windows(END.len()).position(|octets| octets == END);
        if let Some(end) = end {
            let begun = request.split_off(end + END.len());
            return Ok((String::from_utf8_lossy(&request).into_owned(), begun));
        }
        if request.len() >= REQUEST_MAX || !read_more(client, &mut request, until)? {
            return Ok((String::from_utf8_lossy(&request).into_owned(), Vec::new()));
        }
    }
}

/// The body of a request, of which `begun` was read with its head.
fn body(
    client: &TcpStream,
    begun: Vec<u8>,
    length: usize,
    until: Instant,
) -> std::io::Result<Vec<u8>> {
    let mut body = begun;
    while body.len() < length {
        if !read_more(client, &mut body, until)? {
            return Err(ErrorKind::UnexpectedEof.into());
        }
    }
    body.truncate(length);
    Ok(body)
}

/// Whether there was more to read.
fn read_more(
    mut client: &TcpStream,
    octets: &mut Vec<u8>,
    until: Instant,
) -> std::io::Result<bool> {
    let mut part = [0; 8_192];
    let left = until.saturating_duration_since(Instant::now());
    if left.is_zero() {
        return Err(ErrorKind::TimedOut.into());
    }
    client.set_read_timeout(Some(left))?;
    let length = client.read(&mut part)?;
    octets.extend_from_slice(&part[..length]);
    Ok(length > 0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_others_are_not_answered() {
        let local = "127.0.0.1:3100".parse().unwrap();
        for host in ["127.0.0.1:3100", "localhost:9", "localhost", "[::1]:3100"] {
            assert!(is_own(Some(host), local), "{host}");
        }
        for host in [
            "evil.example:3100",
            "127.0.0.1.evil.example",
            "10.0.0.7:3100",
            "",
        ] {
            assert!(!is_own(Some(host), local), "{host}");
        }
        assert!(!is_own(None, local));
        let all = "0.0.0.0:3100".parse().unwrap();
        assert!(is_own(Some("10.0.0.7:3100"), all));
        assert!(!is_own(Some("evil.example:3100"), all));
    }
}
