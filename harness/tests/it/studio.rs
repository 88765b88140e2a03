//! Which requests the studio's server answers. What its pages show in a browser is in `tests/studio/pages.py`.

use std::io::{BufRead, BufReader, Read, Write};
use std::net::{TcpListener, TcpStream};
use std::path::Path;
use std::process::Stdio;

use crossguard_testkit::command::*;

use crate::sim::log_of;

/// A studio that is served.
struct Studio {
    _child: Killed,
    address: String,
}

impl Studio {
    fn of(logs: &[&Path]) -> Self {
        let mut command = crossguard(&["studio", "--no-browser", "--port", "0"]);
        let mut child = command.args(logs).stdout(Stdio::piped()).spawn().unwrap();
        let mut line = String::new();
        let output = child.stdout.take().unwrap();
        BufReader::new(output).read_line(&mut line).unwrap();
        let (_, address) = line.split_once("http://").unwrap();
        let address = address.split('/').next().unwrap().to_owned();
        Self {
            _child: Killed(child),
            address,
        }
    }

    /// What it answers to a request, by its own name or another one.
    fn ask(&self, request: &str, host: &str, rest: &str) -> String {
        let mut client = TcpStream::connect(&self.address).unwrap();
        write!(client, "{request} HTTP/1.1\r\nHost: {host}\r\n{rest}\r\n").unwrap();
        let mut answer = String::new();
        client.read_to_string(&mut answer).unwrap();
        answer
    }
}

#[test]
fn the_server_answers_by_its_own_name_and_to_questions_of_limited_length() {
    let folder = tempfile::tempdir().unwrap();
    let log = folder.path().join("log.jsonl");
    std::fs::write(&log, log_of(3, 5)).unwrap();
    let studio = Studio::of(&[&log]);
    let own = &*studio.address;
    let page = studio.ask("GET /after/", own, "");
    let policy = "Content-Security-Policy: default-src 'none'; script-src 'self'";
    page.must_have(&[policy]);
    let port = own.rsplit(':').next().unwrap();
    let other = format!("evil.example:{port}");
    let evil = format!("Origin: http://localhost:{port}1\r\n");
    let same = format!("Origin: http://{own}\r\n");
    let far = "/after/api/moment?at=18446744073709551615&from=9&to=1";
    let [too_long, empty] = ["Content-Length: 1048577\r\n", "Content-Length: 0\r\n"];
    for (request, host, rest, code) in [
        ("GET /after/", own, "", "200"),
        ("GET /after/api/opening", &other, "", "421"),
        ("GET /", "", "", "421"),
        ("POST /after/api/moment?at=1", own, &evil, "403"),
        (
            "POST /after/api/moment?at=1",
            own,
            "Origin: null\r\n",
            "403",
        ),
        ("POST /after/api/moment?at=1", own, &same, "200"),
        ("PUT /after/api/moment", own, "", "405"),
        ("POST /after/api/moment", own, too_long, "413"),
        ("POST /after/api/moment?at=1", own, empty, "200"),
        ("GET /after/api/nosuch", own, "", "404"),
        ("GET /../Cargo.toml", own, "", "404"),
        ("GET //elsewhere", own, "", "404"),
        ("GET /after/api/moment?at=now", own, "", "400"),
        (&format!("GET {far}"), own, "", "200"),
    ] {
        let answer = studio.ask(request, host, rest);
        let begin = format!("HTTP/1.1 {code} ");
        assert!(answer.starts_with(&begin), "{request}: {answer}");
    }
}

#[test]
fn without_logs_it_says_what_can_be_looked_at_and_each_view_is_a_folder() {
    let studio = Studio::of(&[]);
    let own = &*studio.address;
    let page = studio.ask("GET /", own, "");
    page.must_have(&["crossguard studio LOG..."]);
    let answer = studio.ask("GET /after/api/opening", own, "");
    answer.must_have(&["this studio was given no log"]);
    let views = page.split("<h2><a href=\"").skip(1);
    let views: Vec<_> = views.map(|it| it.split('/').next().unwrap()).collect();
    assert!(views.len() >= 4, "{views:?}");
    for view in views {
        let answer = studio.ask(&format!("GET /{view}"), own, "");
        assert!(answer.starts_with("HTTP/1.1 308 "), "{answer}");
        assert!(answer.contains(&format!("\r\nLocation: /{view}/\r\n")));
    }
}

#[test]
fn a_port_in_use_is_a_clear_error() {
    let taken = TcpListener::bind("127.0.0.1:0").unwrap();
    let port = taken.local_addr().unwrap().port().to_string();
    let output = run(&["studio", "--no-browser", "--port", &port]);
    assert_refused(&output, "Address already in use");
    assert_refused(&output, "--port 0 any that is free");
}
