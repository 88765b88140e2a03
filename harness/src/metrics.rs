//! What Prometheus wants to know of a running robot: text over HTTP, at an address that nobody but this
//! machine reaches unless another one is given.

use std::fmt::{Display, Write as _};
use std::net::SocketAddr;
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

use crossguard_codec::Kind;
use crossguard_endpoint::counters::CauseName;
use crossguard_protocol::{Role, State};

use crossguard_robot::channel::ChannelState;
use crossguard_robot::tally::Tally;

use crate::http::{self, Answer};

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

/// Serves `tally` at `address` until the process ends. The address that it is served at, where the port that was given
/// is 0.
///
/// # Errors
/// When nothing can be served there.
pub fn serve(address: SocketAddr, tally: Shared) -> std::io::Result<SocketAddr> {
    http::serve(address, "metrics", 0, move |request| {
        // A query says nothing that matters.
        let (status, body) = match request.path {
            "/metrics" | "/" => ("200 OK", tally.with(|tally| text(tally))),
            _ => ("404 Not Found", "there is /metrics\n".to_owned()),
        };
        Answer {
            status,
            content_type: CONTENT_TYPE,
            headers: "".into(),
            body: body.into(),
        }
    })
}

/// A tally in the exposition format.
#[must_use]
pub fn text(tally: &Tally) -> String {
    let mut page = Page::default();
    let robot = ("robot", tally.robot.as_str());
    if let Some(state) = &tally.state {
        let boot = tally.boot.unwrap_or(state.boot());
        let (station, boot) = (state.station().to_string(), boot.to_string());
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
    if let Some(clock) = tally.clock {
        page.family(
            "crossguard_time_trusted",
            "gauge",
            "Whether it trusts its clock; if not, it accepts nothing that is signed.",
        );
        page.value(&[robot], u64::from(clock.is_trusted()));
    }
    if let Some(channel) = tally.channel {
        page.channel(robot, channel);
    }
    equipment(&mut page, robot, tally);
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

/// The link and the security.
fn equipment(page: &mut Page, robot: (&str, &str), tally: &Tally) {
    if !tally.link.is_empty() {
        page.family(
            "crossguard_link_info",
            "gauge",
            "Where its link is, and whether packets are signed and verified.",
        );
        let labels = [robot, ("link", &tally.link), ("security", tally.security)];
        page.value(&labels, 1);
    }
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

    fn channel(&mut self, robot: (&str, &str), channel: ChannelState) {
        if let Some(ratio) = channel.busy_ratio {
            self.family(
                "crossguard_channel_busy_ratio",
                "gauge",
                "Channel busy ratio, from 0 to 1, as the link's unit measures it.",
            );
            self.value(&[robot], ratio);
        }
        if let Some(power) = channel.power_dbm {
            self.family(
                "crossguard_reception_power_dbm",
                "gauge",
                "Power of the last reception whose power is known.",
            );
            self.value(&[robot], power);
        }
        self.family(
            "crossguard_congestion_interval_seconds",
            "gauge",
            "How far apart RAM outside of sessions, and CAM, are to be (TS 102 687, reactive).",
        );
        #[expect(clippy::cast_precision_loss, reason = "at most a second")]
        self.value(&[robot], channel.interval_ms as f64 / 1e3);
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
    use std::io::{ErrorKind, Read, Write};
    use std::net::TcpStream;

    use crossguard_endpoint::cause::Cause;
    use crossguard_protocol::Ignored;

    use super::*;
    use crate::http::CLIENTS_MAX;

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
        let answer = ask(address, "GET /metrics HTTP/1.1\r\nHost: localhost\r\n\r\n");
        let (head, body) = answer.split_once("\r\n\r\n").unwrap();
        assert!(head.starts_with("HTTP/1.1 200 OK\r\nContent-Type: text/plain; version=0.0.4"));
        assert!(head.contains(&format!("Content-Length: {}", body.len())));
        let line = r#"crossguard_without_effect_total{robot="A \"robot\"\n",layer="protocol",cause="nothing new"} 7"#;
        assert!(body.lines().any(|it| it == line), "{body}");
        let asked = ask(
            address,
            "GET /metrics?x=1&y HTTP/1.1\r\nHost: localhost\r\n\r\n",
        );
        assert_eq!(asked, answer);
        let asked = ask(address, "HEAD /metrics HTTP/1.1\r\nHost: localhost\r\n\r\n");
        assert_eq!(asked.strip_suffix("\r\n\r\n"), Some(head));
        for (request, code) in [
            ("GET /other HTTP/1.1\r\nHost: localhost", "404"),
            ("POST /metrics HTTP/1.1\r\nHost: localhost", "405"),
            ("GET /metrics HTTP/1.1\r\nHost: evil.example", "421"),
            ("GET /metrics HTTP/1.1", "421"),
        ] {
            let answer = ask(address, &format!("{request}\r\n\r\n"));
            assert!(
                answer.starts_with(&format!("HTTP/1.1 {code}")),
                "{request}: {answer}"
            );
        }
    }

    #[test]
    fn clients_that_ask_nothing_delay_nobody_and_cannot_become_too_many() {
        let address = serve("127.0.0.1:0".parse().unwrap(), Shared::default()).unwrap();
        let connect = |_| TcpStream::connect(address).unwrap();
        let idle: Vec<_> = (0..5).map(connect).collect();
        let answer = ask(address, "GET /metrics HTTP/1.1\r\nHost: localhost\r\n\r\n");
        assert!(answer.starts_with("HTTP/1.1 200 OK"), "{answer}");
        let more: Vec<_> = (0..2 * CLIENTS_MAX).map(connect).collect();
        // The last ones are turned away before the first one has said nothing for too long.
        let mut last = more.last().unwrap();
        assert!(!matches!(last.read(&mut [0; 8]), Ok(1..)));
        let mut first = &idle[0];
        first.set_nonblocking(true).unwrap();
        let still_open = first.read(&mut [0; 8]).unwrap_err();
        assert_eq!(still_open.kind(), ErrorKind::WouldBlock);
    }
}
