//! The studio: what its pages show in a real browser, by keys alone, at two widths, of good files and of hostile ones;
//! and which requests its server answers.

mod after;
mod browser;
mod explore;
mod live;
mod logs;
mod numbers;
mod page;
mod play;

use std::net::TcpListener;

use browser::PATIENCE;
use crossguard_testkit::command::*;
use logs::{crowd, write};
use page::Studio;

#[test]
fn the_server_answers_by_its_own_name_and_to_questions_of_limited_length() {
    let folder = tempfile::tempdir().unwrap();
    let log = write(&crowd(), folder.path(), "crowd.jsonl");
    let studio = Studio::of(&[&log]);
    let own = studio.address().to_owned();
    let page = studio.ask(&format!("GET /after/ HTTP/1.1\r\nHost: {own}\r\n\r\n"));
    assert!(page.starts_with("HTTP/1.1 200 OK"), "{page}");
    assert!(
        page.contains("Content-Security-Policy: default-src 'none'; script-src 'self'"),
        "{page}"
    );
    let asked = [
        (
            format!(
                "GET /after/api/opening HTTP/1.1\r\nHost: evil.example:{}\r\n\r\n",
                own.rsplit(':').next().unwrap()
            ),
            "421",
        ),
        ("GET / HTTP/1.1\r\n\r\n".to_owned(), "421"),
        (
            format!("PUT /after/api/moment HTTP/1.1\r\nHost: {own}\r\n\r\n"),
            "405",
        ),
        (
            format!(
                "POST /after/api/moment HTTP/1.1\r\nHost: {own}\r\nContent-Length: 1048577\r\n\r\n"
            ),
            "413",
        ),
        (
            format!(
                "POST /after/api/moment?at=1 HTTP/1.1\r\nHost: {own}\r\nContent-Length: 2\r\n\r\n{{}}"
            ),
            "200",
        ),
        (
            format!("GET /after/api/nosuch HTTP/1.1\r\nHost: {own}\r\n\r\n"),
            "404",
        ),
        (
            format!("GET /../Cargo.toml HTTP/1.1\r\nHost: {own}\r\n\r\n"),
            "404",
        ),
        (
            format!("GET /after/api/moment?at=now HTTP/1.1\r\nHost: {own}\r\n\r\n"),
            "400",
        ),
        (
            format!(
                "GET /after/api/moment?at=18446744073709551615&from=9&to=1 HTTP/1.1\r\nHost: {own}\r\n\r\n"
            ),
            "200",
        ),
    ];
    for (head, code) in asked {
        let answer = studio.ask(&head);
        assert!(
            answer.starts_with(&format!("HTTP/1.1 {code} ")),
            "{head}: {answer}"
        );
    }
}

#[test]
fn a_port_in_use_is_a_clear_error() {
    let folder = tempfile::tempdir().unwrap();
    let log = write(&crowd(), folder.path(), "crowd.jsonl");
    let taken = TcpListener::bind("127.0.0.1:0").unwrap();
    let port = taken.local_addr().unwrap().port().to_string();
    let output = run(&[
        "studio",
        "--no-browser",
        "--port",
        &port,
        log.to_str().unwrap(),
    ]);
    assert_refused(&output, "Address already in use");
    assert_refused(&output, "--port 0 any that is free");
}

#[test]
fn without_logs_it_says_what_can_be_looked_at() {
    let studio = Studio::of(&[]);
    let own = studio.address();
    let page = studio.ask(&format!("GET / HTTP/1.1\r\nHost: {own}\r\n\r\n"));
    assert!(page.contains("crossguard studio LOG..."), "{page}");
    let asked = format!("GET /after/api/opening HTTP/1.1\r\nHost: {own}\r\n\r\n");
    let answer = studio.ask(&asked);
    assert!(answer.contains("this studio was given no log"), "{answer}");
}

#[test]
fn a_view_without_its_last_slash_is_found() {
    let studio = Studio::of(&[]);
    let own = studio.address();
    let asked = |path: &str| format!("GET {path} HTTP/1.1\r\nHost: {own}\r\n\r\n");
    for view in ["live", "play", "explore", "after", "numbers"] {
        let answer = studio.ask(&asked(&format!("/{view}")));
        assert!(answer.starts_with("HTTP/1.1 308 "), "{answer}");
        assert!(answer.contains(&format!("\r\nLocation: /{view}/\r\n")));
    }
    let answer = studio.ask(&asked("//elsewhere"));
    assert!(answer.starts_with("HTTP/1.1 404 "), "{answer}");
}

#[test]
fn told_to_stop_it_ends_well() {
    let folder = tempfile::tempdir().unwrap();
    let log = write(&crowd(), folder.path(), "crowd.jsonl");
    for name in ["-INT", "-TERM"] {
        let mut studio = Studio::of(&[&log]);
        signal(&studio.child, name);
        let status = wait_for(&mut studio.child, PATIENCE);
        assert_eq!(status.code(), Some(0), "{name}");
    }
}
