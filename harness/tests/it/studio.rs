//! Requests that the studio's server answers. Its pages in a browser are tested in `tests/studio/pages.py`.

use std::io::{BufRead, BufReader, Read, Write};
use std::net::{TcpListener, TcpStream};
use std::path::Path;
use std::process::Stdio;

use crossguard_testkit::command::*;

use crate::sim::log_of;

pub(crate) struct Studio {
    _child: Killed,
    pub(crate) address: String,
}

impl Studio {
    pub(crate) fn of(logs: &[&Path]) -> Self {
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

    /// Its answer to a request, by its own name or another one.
    pub(crate) fn ask(&self, request: &str, host: &str, rest: &str) -> String {
        self.send(request, host, rest, &[])
    }

    pub(crate) fn send(&self, request: &str, host: &str, rest: &str, body: &[u8]) -> String {
        let mut client = TcpStream::connect(&self.address).unwrap();
        write!(client, "{request} HTTP/1.1\r\nHost: {host}\r\n{rest}\r\n").unwrap();
        client.write_all(body).unwrap();
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
    let (same, null) = (format!("Origin: http://{own}\r\n"), "Origin: null\r\n");
    let far = "/after/api/moment?at=18446744073709551615&from=9&to=1";
    let [too_long, empty] = ["Content-Length: 1048577\r\n", "Content-Length: 0\r\n"];
    for (request, host, rest, code) in [
        ("GET /after/", own, "", "200"),
        ("GET /after/api/opening", &other, "", "421"),
        ("GET /", "", "", "421"),
        ("POST /after/api/moment?at=1", own, &evil, "403"),
        ("POST /after/api/moment?at=1", own, null, "403"),
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

/// Sends these files as the page does; the code of the answer, and the answer.
fn open_logs(studio: &Studio, files: &[&Path], more: &str) -> (String, String) {
    let read = |path: &&Path| {
        let text = std::fs::read(path).unwrap();
        ((path.display().to_string(), text.len()), text)
    };
    let (heads, texts): (Vec<_>, Vec<_>) = files.iter().map(read).unzip();
    let heads = serde_json::to_vec(&heads).unwrap();
    let body = [&heads[..], b"\n", &texts.concat()].concat();
    let rest = format!("Content-Length: {}\r\n{more}", body.len());
    let answer = studio.send("POST /after/api/logs", &studio.address, &rest, &body);
    parts(&answer)
}

/// Asserts that an answer has this code, and says why.
#[track_caller]
pub(crate) fn is_refused(answer: &(String, String), code: &str, cause: &str) {
    let is_it = answer.0 == code && answer.1.contains(cause);
    assert!(is_it, "{answer:?}, and not {cause}");
}

pub(crate) fn parts(answer: &str) -> (String, String) {
    let (head, body) = answer.split_once("\r\n\r\n").unwrap();
    let code = head.split(' ').nth(1).unwrap();
    (code.to_owned(), body.to_owned())
}

#[test]
fn logs_that_the_page_sends_are_shown_as_files_are() {
    let folder = tempfile::tempdir().unwrap();
    let file = |name: &str, text: &[u8]| {
        let path = folder.path().join(name);
        std::fs::write(&path, text).unwrap();
        path
    };
    let all = log_of(3, 2);
    let lines = || all.split_inclusive(|octet| *octet == b'\n');
    let robot = |line: &[u8]| {
        let record: serde_json::Value = serde_json::from_slice(line).unwrap();
        record["robot"].as_str().unwrap().to_owned()
    };
    let first = robot(lines().next().unwrap());
    let (one, other): (Vec<_>, Vec<_>) = lines().partition(|line| robot(line) == first);
    let [one, other] = [one, other].map(|lines| lines.concat());
    assert!(one.len() > 10_000 && other.len() > 10_000);
    let torn = [&one[..], b"{\"atUs\": 1, \"robot\": \"\xc3\n", &one].concat();
    let a = file("a.jsonl", &one);
    let b = file("b.jsonl", &other);
    let torn = file("torn.jsonl", &torn);
    let ended = file("ended.jsonl", &one[..one.len() - 9]);
    for files in [&[&*a, &b][..], &[&torn], &[&b, &ended]] {
        let studio = Studio::of(&[]);
        let (code, opened) = open_logs(&studio, files, "");
        assert_eq!(code, "200", "{opened}");
        let given = Studio::of(files);
        let given = parts(&given.ask("GET /after/api/opening", &given.address, "")).1;
        assert!(opened == given, "{opened}\nas files: {given}");
    }

    let studio = Studio::of(&[&a]);
    let evil = "Origin: http://evil.example\r\n";
    let cut = file("cut.jsonl", &one[..99]);
    let no_log = file("README.md", b"# Look at it\n");
    let empty = file("empty.jsonl", b"");
    let many = vec![&*b; 65];
    for (files, cause) in [
        (&[&*b, &cut][..], "cut.jsonl, line 1: is not a record"),
        (&[&no_log], "README.md, line 1: is not a record"),
        (&[&empty], "there is nothing in this log"),
        (&[], "wanted are 1 to 64 logs"),
        (&many, "wanted are 1 to 64 logs"),
    ] {
        is_refused(&open_logs(&studio, files, ""), "400", cause);
    }
    is_refused(&open_logs(&studio, &[&b], evil), "403", "another origin");
    for (length, body, code, cause) in [
        (12, "[[\"a\",4]]\n{}", "400", "wanted are"),
        (67_108_865, "", "413", "67108864"),
    ] {
        let (own, rest) = (&*studio.address, format!("Content-Length: {length}\r\n"));
        let answer = studio.send("POST /after/api/logs", own, &rest, body.as_bytes());
        is_refused(&parts(&answer), code, cause);
    }
    // None of these has changed the page; other logs do, and a page of the logs before is told so.
    let moment = |run| {
        let request = format!("GET /after/api/moment?at=1&run={run}");
        parts(&studio.ask(&request, &studio.address, ""))
    };
    assert_eq!(moment(0).0, "200");
    assert_eq!(open_logs(&studio, &[&b, &b], "").0, "200");
    assert_eq!(moment(1).0, "200");
    is_refused(&moment(0), "400", "other logs were opened");

    let reached = Studio::of(&["--address", "0.0.0.0"].map(Path::new));
    is_refused(&open_logs(&reached, &[&b], ""), "400", "without --address");
}

#[test]
fn a_port_in_use_is_a_clear_error() {
    let taken = TcpListener::bind("127.0.0.1:0").unwrap();
    let port = taken.local_addr().unwrap().port().to_string();
    let output = run(&["studio", "--no-browser", "--port", &port]);
    assert_refused(&output, "Address already in use");
    assert_refused(&output, "--port 0 any that is free");
}
