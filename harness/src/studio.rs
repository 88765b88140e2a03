//! The studio: a page on which a run is looked at, served to a browser on this machine.
//!
//! The page, its style and its scripts are in the program, and it loads nothing from elsewhere. What logs say reaches
//! the page as JSON and is put into it as text, never as markup; the browser runs no other script
//! (see the policy in the head of each answer). Only who names this machine is answered, so that a page of a stranger whose name is made to lead here
//! reads nothing.

use std::borrow::Cow;
use std::net::SocketAddr;

use crossguard_judge::playback::{Overview, Playback, Stretch};
use crossguard_judge::validate::{Invalid, Validated};
use crossguard_judge::verdict::{self, PropertyVerdict};
use serde::Serialize;

use crate::http::{self, Answer, Request};

/// What goes with each answer: the page may run and load what this server has, and nothing else.
const HEADERS: &str = "Content-Security-Policy: default-src 'none'; script-src 'self'; style-src 'self'; \
    img-src 'self'; connect-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'\r\n\
    X-Content-Type-Options: nosniff\r\nReferrer-Policy: no-referrer\r\nCross-Origin-Resource-Policy: same-origin\r\n\
    Cross-Origin-Opener-Policy: same-origin\r\nCache-Control: no-store\r\n";

const TEXT: &str = "text/plain; charset=utf-8";
const SCRIPT: &str = "text/javascript; charset=utf-8";

/// The files of the page: path, type, and what is in them.
const FILES: [(&str, &str, &str); 10] = [
    (
        "/",
        "text/html; charset=utf-8",
        include_str!("studio/index.html"),
    ),
    (
        "/studio.css",
        "text/css; charset=utf-8",
        include_str!("studio/studio.css"),
    ),
    (
        "/icon.svg",
        "image/svg+xml",
        include_str!("studio/icon.svg"),
    ),
    ("/studio.js", SCRIPT, include_str!("studio/studio.js")),
    ("/player.js", SCRIPT, include_str!("studio/player.js")),
    ("/dom.js", SCRIPT, include_str!("studio/dom.js")),
    ("/map.js", SCRIPT, include_str!("studio/map.js")),
    ("/messages.js", SCRIPT, include_str!("studio/messages.js")),
    ("/timeline.js", SCRIPT, include_str!("studio/timeline.js")),
    ("/panels.js", SCRIPT, include_str!("studio/panels.js")),
];

/// A run, and what is said of it.
pub struct Studied {
    /// The run.
    pub playback: Playback,
    /// The names of its logs.
    pub logs: Vec<String>,
    /// What validation says of them.
    pub validated: Result<Validated, Invalid>,
    /// When the first record that does not fit was written, in µs since 1970, where one does not.
    pub invalid_us: Option<u64>,
}

/// What the page gets first.
#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
struct Opening {
    version: &'static str,
    logs: Vec<String>,
    verdict: Verdict,
    overview: Overview,
}

/// What validation says.
#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
struct Verdict {
    kind: &'static str,
    sentences: Vec<String>,
    /// Where it belongs, in µs since the first record.
    at: Option<u64>,
    robot: Option<String>,
    properties: Vec<PropertyVerdict>,
}

impl Studied {
    fn verdict(&self, overview: &Overview) -> Verdict {
        let validated = self.validated.as_ref();
        let began_us = overview.began_ms.saturating_mul(1_000);
        let (kind, sentences) = match validated {
            Ok(valid) if valid.missing > 0 => ("incomplete", verdict::sentences(valid)),
            Ok(valid) => ("valid", verdict::sentences(valid)),
            Err(invalid) => ("invalid", vec![format!("{invalid}.")]),
        };
        let at = self.invalid_us.map(|at_us| at_us.saturating_sub(began_us));
        Verdict {
            kind,
            sentences,
            at: at.map(|at| at.min(overview.lasted)),
            robot: validated.err().and_then(|invalid| invalid.robot.clone()),
            properties: verdict::properties(validated),
        }
    }

    fn opening(&self) -> Opening {
        let overview = self.playback.overview(&self.logs);
        Opening {
            version: env!("CARGO_PKG_VERSION"),
            logs: self.logs.clone(),
            verdict: self.verdict(&overview),
            overview,
        }
    }
}

/// Serves the page at `address` until the process ends. The address that it is served at.
///
/// # Errors
/// When nothing can be served there.
pub fn serve(address: SocketAddr, run: Studied) -> std::io::Result<SocketAddr> {
    let opening = serde_json::to_string(&run.opening())?;
    http::serve(address, "studio", move |request| {
        if !is_own(request.host, address) {
            let refusal =
                "the studio answers to 127.0.0.1, localhost and the address that it is served at\n";
            return answer("421 Misdirected Request", TEXT, refusal.into());
        }
        respond(request, &opening, &run.playback)
    })
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
        std::net::IpAddr::V4(ip) => ip.to_string(),
        std::net::IpAddr::V6(ip) => format!("[{ip}]"),
    };
    // At all addresses of a machine its own are meant, and a number is nobody's name.
    let plain = name.trim_start_matches('[').trim_end_matches(']');
    let is_number = ip.is_unspecified() && plain.parse::<std::net::IpAddr>().is_ok();
    ["127.0.0.1", "[::1]", "localhost", &own].contains(&name) || is_number
}

fn respond(request: &Request, opening: &str, playback: &Playback) -> Answer {
    const JSON: &str = "application/json";
    match request.path {
        "/api/opening" => answer("200 OK", JSON, opening.to_owned().into()),
        "/api/moment" => match moment(request.query, playback) {
            Some(json) => answer("200 OK", JSON, json.into()),
            None => answer(
                "400 Bad Request",
                TEXT,
                "at=MICROSECONDS is wanted, and from=, to= and repeats=1 are possible\n".into(),
            ),
        },
        path => match FILES.iter().find(|(name, ..)| *name == path) {
            Some((_, content_type, text)) => answer("200 OK", content_type, (*text).into()),
            None => answer("404 Not Found", TEXT, "the page is at /\n".into()),
        },
    }
}

fn moment(query: &str, playback: &Playback) -> Option<String> {
    let value = |name: &str| {
        let mut pairs = query.split('&').filter_map(|pair| pair.split_once('='));
        pairs.find(|(key, _)| *key == name).map(|(_, value)| value)
    };
    let number = |name: &str| value(name).map(str::parse::<u64>).transpose().ok();
    let (from, to) = (number("from")?, number("to")?);
    let span = from.zip(to).map(|(from, to)| Stretch { from, to });
    let moment = playback.moment(number("at")??, span, value("repeats") == Some("1"));
    serde_json::to_string(&moment).ok()
}

const fn answer(
    status: &'static str,
    content_type: &'static str,
    body: Cow<'static, str>,
) -> Answer {
    Answer {
        status,
        content_type,
        headers: HEADERS,
        body,
    }
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
