//! What Prometheus wants to know of a running robot: text over HTTP, at an address that nobody but this
//! machine reaches unless another one is given.

use std::fmt::{Display, Write as _};
use std::io::{BufRead, BufReader, Read, Write};
use std::net::{SocketAddr, TcpListener, TcpStream};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

use crossguard_codec::its::Kind;
use crossguard_endpoint::counters::CauseName;
use crossguard_protocol::{Role, State};

use crossguard_robot::tally::Tally;

/// How long a client may take to ask, and to take the answer.
const PATIENCE: Duration = Duration::from_secs(2);

/// The longest request that is read, in octets.
const REQUEST_MAX: u64 = 8_192;

/// The type of the text: the Prometheus exposition format.
const CONTENT_TYPE: &str = "text/plain; version=0.0.4; charset=utf-8";

/// A tally that is served while it changes.
#[derive(Clone, Debug, Default)]
pub struct Shared(Arc<Mutex<Tally>>);

impl Shared {
    /// Looks at the tally, or changes it.
    pub fn with<T>(&self, look: impl FnOnce(&mut Tally) -> T) -> T {
        look(&mut self.0.lock().unwrap_or_else(PoisonError::into_inner))
    }
}

/// Serves `tally` at `address` until the process ends, one client after the other. The address that it is
/// served at, where the port that was given is 0.
///
/// # Errors
/// When nothing can be served there.
pub fn serve(address: SocketAddr, tally: Shared) -> std::io::Result<SocketAddr> {
    let listener = TcpListener::bind(address)?;
    let address = listener.local_addr()?;
    std::thread::Builder::new()
        .name("metrics".to_owned())
        .spawn(move || {
            for client in listener.incoming() {
                let served = client.and_then(|client| answer(&client, &tally));
                if let Err(error) = served {
                    tracing::debug!(%error, "a client of the metrics went away");
                }
            }
        })?;
    Ok(address)
}

fn answer(client: &TcpStream, tally: &Shared) -> std::io::Result<()> {
    client.set_read_timeout(Some(PATIENCE))?;
    client.set_write_timeout(Some(PATIENCE))?;
    let mut request = BufReader::new(client.take(REQUEST_MAX));
    let mut line = String::new();
    request.read_line(&mut line)?;
    let mut header = String::new();
    // The rest of the request says nothing that matters, and is read so that the client gets the answer.
    while request.read_line(&mut header)? > 2 {
        header.clear();
    }
    let mut words = line.split_whitespace();
    let (status, body) = match (words.next(), words.next()) {
        (Some("GET"), Some("/metrics" | "/")) => ("200 OK", tally.with(|tally| text(tally))),
        (Some("GET"), _) => ("404 Not Found", "there is /metrics\n".to_owned()),
        _ => ("405 Method Not Allowed", "GET is possible\n".to_owned()),
    };
    let length = body.len();
    let mut client = client;
    write!(
        client,
        "HTTP/1.1 {status}\r\nContent-Type: {CONTENT_TYPE}\r\nContent-Length: {length}\r\n\
         Connection: close\r\n\r\n{body}"
    )
}

/// A tally in the exposition format.
#[must_use]
pub fn text(tally: &Tally) -> String {
    let mut page = Page::default();
    let robot = ("robot", tally.robot.as_str());
    if let Some(state) = &tally.state {
        let (station, boot) = (state.station().to_string(), state.boot().to_string());
        page.family("crossguard_robot_info", "gauge", "Who the robot is.");
        page.value(&[robot, ("station", &station), ("boot", &boot)], 1);
        page.family(
            "crossguard_state",
            "gauge",
            "1 for the state of the paper's model that it is in.",
        );
        for it in [
            State::Idle,
            State::HelpRequested,
            State::RoleEstablished,
            State::ManeuverExecuting,
        ] {
            let is_it = u64::from(state.state() == it);
            page.value(&[robot, ("state", &format!("{it:?}"))], is_it);
        }
        page.family("crossguard_role", "gauge", "1 for the role that it has.");
        for it in [
            Role::None,
            Role::Requester,
            Role::Helper,
            Role::Leader,
            Role::Follower,
        ] {
            page.value(
                &[robot, ("role", &it.to_string())],
                u64::from(state.role() == it),
            );
        }
    }
    page.family(
        "crossguard_followers",
        "gauge",
        "How many followers it leads.",
    );
    page.value(&[robot], tally.followers() as u64);
    page.family(
        "crossguard_corridor_open",
        "gauge",
        "Whether the pedestrian may cross.",
    );
    page.value(&[robot], u64::from(tally.corridor_open()));
    page.family(
        "crossguard_on_duty",
        "gauge",
        "Whether it has a duty on the road that waits for the road to be clear.",
    );
    page.value(&[robot], u64::from(tally.is_on_duty()));
    page.family(
        "crossguard_steps_total",
        "counter",
        "Steps of the transition function.",
    );
    page.value(&[robot], tally.steps);
    page.family(
        "crossguard_messages_total",
        "counter",
        "Messages sent, and heard and understood.",
    );
    for ((way, kind), count) in &tally.messages {
        page.value(
            &[robot, ("direction", way.name()), ("message", kind.name())],
            *count,
        );
    }
    around(&mut page, robot, tally);
    page.family(
        "crossguard_without_effect_total",
        "counter",
        "Messages that were dropped and inputs that were ignored, by layer and cause.",
    );
    for (CauseName { layer, reason }, count) in tally.causes.iter() {
        let labels = [robot, ("layer", layer.name()), ("cause", &reason)];
        page.value(&labels, count);
    }
    page.text
}

/// Who was heard, and who is on the map.
fn around(page: &mut Page, robot: (&str, &str), tally: &Tally) {
    page.family(
        "crossguard_stations_heard",
        "gauge",
        "How many stations were heard since it booted.",
    );
    page.value(&[robot], tally.heard_us.len());
    page.family(
        "crossguard_around",
        "gauge",
        "How many road users are on its map, by kind.",
    );
    for kind in Kind::ALL {
        let count = tally.around.of_kind(kind).map_or(0, |it| it.count);
        page.value(&[robot, ("kind", kind.name())], count);
    }
    page.family(
        "crossguard_around_nearest_metres",
        "gauge",
        "How far away the nearest on its map is, by kind, where that is known.",
    );
    for it in &tally.around.kinds {
        if let Some(nearest) = it.nearest {
            page.value(&[robot, ("kind", it.kind.name())], nearest.distance_m);
        }
    }
    page.family(
        "crossguard_around_oldest_seconds",
        "gauge",
        "For how long the one that was told of longest ago has not been told of again, by kind.",
    );
    for it in &tally.around.kinds {
        let age = Duration::from_millis(it.oldest_ms).as_secs_f64();
        page.value(&[robot, ("kind", it.kind.name())], age);
    }
}

#[derive(Default)]
struct Page {
    text: String,
    name: &'static str,
}

impl Page {
    fn family(&mut self, name: &'static str, kind: &str, help: &str) {
        self.name = name;
        let _ = writeln!(self.text, "# HELP {name} {help}\n# TYPE {name} {kind}");
    }

    fn value(&mut self, labels: &[(&str, &str)], value: impl Display) {
        let labels = labels
            .iter()
            .map(|(name, value)| format!("{name}=\"{}\"", escaped(value)));
        let labels = labels.collect::<Vec<_>>().join(",");
        let _ = writeln!(self.text, "{}{{{labels}}} {value}", self.name);
    }
}

fn escaped(value: &str) -> String {
    value
        .replace('\\', "\\\\")
        .replace('"', "\\\"")
        .replace('\n', "\\n")
}

#[cfg(test)]
mod tests {
    use crossguard_endpoint::cause::Cause;
    use crossguard_protocol::Ignored;

    use super::*;

    fn ask(address: SocketAddr, request: &str) -> String {
        let mut client = TcpStream::connect(address).unwrap();
        client.write_all(request.as_bytes()).unwrap();
        let mut answer = String::new();
        client.read_to_string(&mut answer).unwrap();
        answer
    }

    #[test]
    fn the_metrics_are_served_and_nothing_else() {
        let tally = Shared::default();
        tally.with(|tally| {
            tally.robot = "A \"robot\"\n".to_owned();
            tally
                .causes
                .set(&Cause::from(Ignored::NothingNew).into(), 7);
        });
        let address = serve("127.0.0.1:0".parse().unwrap(), tally).unwrap();
        let answer = ask(address, "GET /metrics HTTP/1.1\r\nHost: here\r\n\r\n");
        let (head, body) = answer.split_once("\r\n\r\n").unwrap();
        assert!(head.starts_with("HTTP/1.1 200 OK\r\nContent-Type: text/plain; version=0.0.4"));
        assert!(head.contains(&format!("Content-Length: {}", body.len())));
        let line = r#"crossguard_without_effect_total{robot="A \"robot\"\n",layer="protocol",cause="nothing new"} 7"#;
        assert!(body.lines().any(|it| it == line), "{body}");
        assert!(ask(address, "GET /other HTTP/1.1\r\n\r\n").starts_with("HTTP/1.1 404"));
        assert!(ask(address, "POST /metrics HTTP/1.1\r\n\r\n").starts_with("HTTP/1.1 405"));
    }
}
