//! Metrics of a running robot for Prometheus: text over HTTP, at an address that nobody but this
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
    let no_post = |_: &str| 0;
    http::serve(address, "metrics", no_post, move |request| {
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
    let mut page = Page {
        robot: &tally.robot,
        text: String::new(),
    };
    if let Some(state) = &tally.state {
        let boot = tally.boot.unwrap_or(state.boot()).to_string();
        let labels = [("station", &*state.station().to_string()), ("boot", &boot)];
        let mut info = page.gauge("robot_info", "Who the robot is.");
        info.value(&labels, 1);
        let help = "1 for the state of the paper's model that it is in.";
        let mut states = page.gauge("state", help);
        for it in State::ALL {
            let is_it = u64::from(state.state() == it);
            states.value(&[("state", it.name())], is_it);
        }
        let mut roles = page.gauge("role", "1 for the role that it has.");
        for it in Role::ALL {
            let is_it = u64::from(state.role() == it);
            roles.value(&[("role", &it.to_string())], is_it);
        }
    }
    let help = "How many followers it leads.";
    page.gauge("followers", help).value(&[], tally.followers());
    let is_open = u64::from(tally.corridor_open());
    let help = "Whether the pedestrian may cross.";
    page.gauge("corridor_open", help).value(&[], is_open);
    let is_on_duty = u64::from(tally.is_on_duty());
    let help = "Whether it has a duty on the road that waits for the road to be clear.";
    page.gauge("on_duty", help).value(&[], is_on_duty);
    if let Some(clock) = tally.clock {
        let help = "Whether it trusts its clock; if not, it accepts nothing that is signed.";
        let is_trusted = u64::from(clock.is_trusted());
        page.gauge("time_trusted", help).value(&[], is_trusted);
    }
    if let Some(channel) = tally.channel {
        of_channel(&mut page, channel);
    }
    if !tally.link.is_empty() {
        let help = "Where its link is, and whether packets are signed and verified.";
        let labels = [("link", &*tally.link), ("security", tally.security)];
        page.gauge("link_info", help).value(&labels, 1);
    }
    let help = "Steps of the transition function.";
    page.counter("steps_total", help).value(&[], tally.steps);
    let help = "Messages sent, and heard and understood.";
    let mut messages = page.counter("messages_total", help);
    for ((way, kind), count) in &tally.messages {
        messages.value(
            &[("direction", way.name()), ("message", kind.name())],
            *count,
        );
    }
    around(&mut page, tally);
    let help = "Messages that were dropped and inputs that were ignored, by layer and cause.";
    let mut causes = page.counter("without_effect_total", help);
    for (CauseName { layer, reason }, count) in tally.causes.iter() {
        causes.value(&[("layer", layer.name()), ("cause", &reason)], count);
    }
    page.text
}

/// Stations that were heard, and road users on the map.
fn around(page: &mut Page, tally: &Tally) {
    let help = "How many stations were heard since it booted.";
    let mut heard = page.gauge("stations_heard", help);
    heard.value(&[], tally.heard.len());
    let mut counts = page.gauge("around", "How many road users are on its map, by kind.");
    for kind in Kind::ALL {
        let count = tally.around.of_kind(kind).map_or(0, |it| it.count);
        counts.value(&[("kind", kind.name())], count);
    }
    let help = "How far away the nearest on its map is, by kind, where that is known.";
    let mut nearest = page.gauge("around_nearest_metres", help);
    for it in &tally.around.kinds {
        if let Some(found) = it.nearest {
            nearest.value(&[("kind", it.kind.name())], found.distance_m);
        }
    }
    let help =
        "For how long the one that was told of longest ago has not been told of again, by kind.";
    let mut oldest = page.gauge("around_oldest_seconds", help);
    for it in &tally.around.kinds {
        let age = Duration::from_millis(it.oldest_ms).as_secs_f64();
        oldest.value(&[("kind", it.kind.name())], age);
    }
}

fn of_channel(page: &mut Page, channel: ChannelState) {
    if let Some(ratio) = channel.busy_ratio {
        let help = "Channel busy ratio, from 0 to 1, as the link's unit measures it.";
        page.gauge("channel_busy_ratio", help).value(&[], ratio);
    }
    if let Some(power) = channel.power_dbm {
        let help = "Power of the last reception whose power is known.";
        page.gauge("reception_power_dbm", help).value(&[], power);
    }
    let help = "How far apart RAM outside of sessions, and CAM, are to be (TS 102 687, reactive).";
    #[expect(clippy::cast_precision_loss, reason = "at most a second")]
    let interval_s = channel.interval_ms as f64 / 1e3;
    let mut interval = page.gauge("congestion_interval_seconds", help);
    interval.value(&[], interval_s);
}

/// The metrics of one robot.
struct Page<'a> {
    robot: &'a str,
    text: String,
}

/// Values under one name.
struct Family<'a> {
    name: &'static str,
    robot: &'a str,
    text: &'a mut String,
}

impl Page<'_> {
    fn gauge(&mut self, name: &'static str, help: &str) -> Family<'_> {
        self.family(name, "gauge", help)
    }

    fn counter(&mut self, name: &'static str, help: &str) -> Family<'_> {
        self.family(name, "counter", help)
    }

    /// Begins a family of metrics, whose full name is `crossguard_NAME`.
    fn family(&mut self, name: &'static str, kind: &str, help: &str) -> Family<'_> {
        let (robot, text) = (self.robot, &mut self.text);
        let _ = writeln!(
            text,
            "# HELP crossguard_{name} {help}\n# TYPE crossguard_{name} {kind}"
        );
        Family { name, robot, text }
    }
}

impl Family<'_> {
    /// A value, with labels besides that of the robot.
    fn value(&mut self, labels: &[(&str, &str)], value: impl Display) {
        let labels = [("robot", self.robot)]
            .into_iter()
            .chain(labels.iter().copied());
        let labels = labels.map(|(name, value)| format!("{name}=\"{}\"", escaped(value)));
        let labels = labels.collect::<Vec<_>>().join(",");
        let name = self.name;
        let _ = writeln!(self.text, "crossguard_{name}{{{labels}}} {value}");
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
