//! The studio: what its page shows in a real browser, by keys alone, at two widths, of good logs and of hostile ones;
//! and whom its server answers.

mod browser;

use std::fs::File;
use std::io::{BufRead, BufReader, BufWriter, Read, Write};
use std::net::{TcpListener, TcpStream};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};

use browser::{Browser, PATIENCE};
use crossguard_endpoint::ras::clustering::VruClass;
use crossguard_judge::facts::{Fact, Observer};
use crossguard_judge::sim::{Swarm, run as simulate};
use crossguard_robot::sight::{Seen, Sight};
use crossguard_robot::trace::{self, Entry, Record};
use crossguard_robot::zone::Conduct;
use crossguard_testkit::command::*;
use serde_json::json;

/// A studio that is served.
struct Studio {
    child: Child,
    url: String,
}

impl Studio {
    fn of(logs: &[&Path]) -> Self {
        let mut command =
            crossguard(&["studio", "--no-browser", "--port", "0", "--site", "street"]);
        let mut child = command.args(logs).stdout(Stdio::piped()).spawn().unwrap();
        let mut line = String::new();
        let output = child.stdout.take().unwrap();
        BufReader::new(output).read_line(&mut line).unwrap();
        let url = line.split(' ').find(|word| word.starts_with("http://"));
        let url = url.unwrap_or_else(|| panic!("no address in '{line}'"));
        Self {
            child,
            url: url.to_owned(),
        }
    }

    fn address(&self) -> &str {
        self.url.trim_start_matches("http://").trim_end_matches('/')
    }

    /// What it answers to a head.
    fn ask(&self, head: &str) -> String {
        let mut client = TcpStream::connect(self.address()).unwrap();
        client.write_all(head.as_bytes()).unwrap();
        let mut answer = String::new();
        client.read_to_string(&mut answer).unwrap();
        answer
    }
}

impl Drop for Studio {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

/// The records of four simulated robots; the first has thirty people around it.
fn crowd() -> Vec<Record> {
    let swarm = (1..200).map(|seed| Swarm::draw(seed, 4, None));
    let swarm = swarm.into_iter().find(|it| it.robots.len() == 4).unwrap();
    let mut records: Vec<Record> = Vec::new();
    let mut watch = |record: Record| records.push(record);
    assert_eq!(simulate(&swarm, Some(&mut watch)).finding, None);
    let (mut observer, mut with_people) = (Observer::default(), Vec::new());
    let conducts = [
        Conduct::Waiting,
        Conduct::Passing,
        Conduct::OnRoad,
        Conduct::Across,
        Conduct::Elsewhere,
    ];
    for record in records {
        let places = observer
            .take(&record)
            .into_iter()
            .find_map(|fact| match fact {
                Fact::Place(placed) => Some((placed.latitude, placed.longitude)),
                _ => None,
            });
        let (at_us, robot) = (record.at_us, record.robot.clone());
        let is_first = robot == swarm.robots[0].name;
        with_people.push(record);
        if let Some((latitude, longitude)) = places.filter(|_| is_first) {
            let person = |number: u8| Seen {
                place: (
                    latitude + f64::from(number % 6) * 7e-6,
                    longitude + f64::from(number / 6) * 1.1e-5,
                ),
                class: VruClass::Pedestrian,
                conduct: conducts[usize::from(number) % conducts.len()],
            };
            let people = (0..30).map(person).collect();
            with_people.push(Record {
                at_us,
                robot,
                entry: Entry::People(Sight { people }),
            });
        }
    }
    with_people
}

fn write(records: &[Record], folder: &Path, name: &str) -> PathBuf {
    let path = folder.join(name);
    let mut file = BufWriter::new(File::create(&path).unwrap());
    for record in records {
        trace::write(&mut file, record).unwrap();
    }
    file.flush().unwrap();
    path
}

/// A browser, or nothing where this machine has none; then the test is said to be skipped.
fn browser(folder: &Path, test: &str) -> Option<Browser> {
    let browser = Browser::start(folder);
    if browser.is_none() {
        eprintln!("SKIPPED {test}: no chromium (Debian package chromium)");
    }
    browser
}

/// The page has no error, and asked only its own server.
fn assert_clean(browser: &Browser, studio: &Studio) {
    let (errors, requests) = browser.told();
    assert!(errors.is_empty(), "{errors:#?}");
    assert!(requests.len() > 8, "{requests:?}");
    let others: Vec<_> = requests
        .iter()
        .filter(|url| !url.starts_with(&studio.url) && *url != "about:blank")
        .collect();
    assert!(others.is_empty(), "{others:?}");
}

const TIME: &str = "Number(document.getElementById('slider').value)";

#[test]
fn a_team_with_thirty_people_is_shown_at_every_width_and_nothing_is_loaded_from_elsewhere() {
    let folder = tempfile::tempdir().unwrap();
    let log = write(&crowd(), folder.path(), "crowd.jsonl");
    let studio = Studio::of(&[&log]);
    let Some(mut browser) = browser(folder.path(), "a_team_with_thirty_people_is_shown") else {
        return;
    };
    browser.open(&studio.url);
    browser.evaluate("document.getElementById('slider').value = document.getElementById('slider').max / 2, document.getElementById('slider').dispatchEvent(new Event('input'))");
    browser.wait_for("document.querySelectorAll('#map .person').length === 30");
    let count = |selector: &str| format!("document.querySelectorAll('{selector}').length");
    assert_eq!(browser.evaluate(&count("#robots article")), json!(4));
    assert_eq!(browser.evaluate(&count("#map .body")), json!(4));
    assert!(browser.evaluate(&count("#messages .row")).as_u64().unwrap() > 10);
    let odd = "[...document.querySelectorAll('.timers .n')].map((it) => it.textContent).filter((it) => !/^[0-9.]+ m?s$/.test(it))";
    assert_eq!(browser.evaluate(odd), json!([]), "timers");
    let shown = "(() => { const list = document.querySelector('.rows').getBoundingClientRect(), row = document.querySelector('.row.current').getBoundingClientRect(); \
        return list.top <= row.top && row.bottom <= list.bottom; })()";
    browser.wait_for(shown);
    assert!(
        browser
            .evaluate(&count("#timeline rect.exec, #timeline rect.role"))
            .as_u64()
            .unwrap()
            > 1
    );
    for width in [1_280, 820] {
        for scheme in ["light", "dark"] {
            browser.look(width, 900, scheme);
            let wide = browser.evaluate("document.documentElement.scrollWidth");
            assert!(
                wide.as_u64().unwrap() <= u64::from(width),
                "{width}, {scheme}: {wide}"
            );
            // What does not scroll by itself shows all of its width.
            let cut = browser.evaluate(
                "[...document.querySelectorAll('h1, h2, h3, p, dd, dt, button, label, output, .said, .timers li')] \
                    .filter((it) => it.offsetParent && it.scrollWidth > it.clientWidth + 1 && getComputedStyle(it).display !== 'inline') \
                    .map((it) => `${it.tagName} ${it.textContent}`)",
            );
            assert_eq!(cut, json!([]), "{width}, {scheme}");
            let labels = browser.evaluate(
                "(() => { const of = document.querySelector('#map svg'), box = of.getBoundingClientRect(); \
                    return [...of.querySelectorAll('text')].filter((it) => { const b = it.getBoundingClientRect(); \
                        return b.left < box.left - 1 || b.right > box.right + 1 || b.top < box.top - 1 || b.bottom > box.bottom + 1; }) \
                        .map((it) => it.textContent); })()",
            );
            assert_eq!(labels, json!([]), "{width}, {scheme}");
        }
    }
    assert_clean(&browser, &studio);
}

#[test]
fn a_run_is_stepped_and_played_by_keys_alone() {
    let folder = tempfile::tempdir().unwrap();
    let log = write(&crowd(), folder.path(), "crowd.jsonl");
    let studio = Studio::of(&[&log]);
    let Some(mut browser) = browser(folder.path(), "a_run_is_stepped_and_played_by_keys_alone")
    else {
        return;
    };
    browser.open(&studio.url);
    let current = "document.querySelector('.row.current')?.textContent ?? ''";
    let settled =
        |at: &str| format!("{TIME} === {at} && document.querySelector('.row.current') !== null");
    let mut seen = Vec::new();
    for _ in 0..5 {
        let before = browser.evaluate(TIME);
        browser.press("ArrowRight", false);
        browser.wait_for(&format!("{TIME} > {before}"));
        let at = browser.evaluate(TIME);
        let told = format!(
            "document.querySelector('.row.current .at')?.textContent === ({at} / 1e6).toFixed(3)"
        );
        browser.wait_for(&told);
        seen.push((at, browser.evaluate(current)));
    }
    for (at, row) in seen.iter().rev().skip(1) {
        browser.press("ArrowLeft", false);
        browser.wait_for(&settled(&at.to_string()));
        browser.wait_for(&format!("({current}) === {row}"));
    }
    browser.press("End", false);
    browser.wait_for(&format!(
        "{TIME} === Number(document.getElementById('slider').max)"
    ));
    browser.press("Home", false);
    browser.wait_for(&format!("{TIME} === 0"));
    // Nothing has the focus, so the key is the page's.
    browser.press(" ", false);
    browser.wait_for(&format!("{TIME} > 200000"));
    browser.press(" ", false);
    assert_eq!(
        browser.evaluate("document.getElementById('play').textContent"),
        json!("Play")
    );
    // Whatever can be used is reached, in order, and shows that it has the focus.
    let mut reached = Vec::new();
    for _ in 0..14 {
        browser.press("Tab", false);
        let shown = browser.evaluate("(() => { const it = document.activeElement, style = getComputedStyle(it); return [it.id || it.className || it.tagName, style.outlineStyle !== 'none']; })()");
        assert_eq!(shown[1], json!(true), "{shown}");
        reached.push(shown[0].as_str().unwrap().to_owned());
    }
    for name in [
        "skip", "first", "previous", "play", "next", "last", "speed", "trial", "repeats", "slider",
        "rows",
    ] {
        assert!(reached.iter().any(|it| it == name), "{name}: {reached:?}");
    }
    assert_clean(&browser, &studio);
}

/// The script of axe-core, from npm, and not kept; nothing where it cannot be had.
fn axe(folder: &Path) -> Option<String> {
    let packed = Command::new("npm")
        .args(["pack", "axe-core@4", "--silent"])
        .current_dir(folder)
        .stderr(Stdio::null())
        .output()
        .ok()
        .filter(|output| output.status.success())?;
    let archive = stdout(&packed).trim().to_owned();
    let unpacked = Command::new("tar")
        .args(["-xzf", &archive, "package/axe.min.js"])
        .current_dir(folder)
        .status();
    unpacked.ok().filter(std::process::ExitStatus::success)?;
    std::fs::read_to_string(folder.join("package/axe.min.js")).ok()
}

#[test]
fn axe_finds_nothing_serious() {
    let folder = tempfile::tempdir().unwrap();
    let Some(script) = axe(folder.path()) else {
        eprintln!("SKIPPED axe_finds_nothing_serious: axe-core cannot be had from npm");
        return;
    };
    let log = write(&crowd(), folder.path(), "crowd.jsonl");
    let studio = Studio::of(&[&log]);
    let Some(mut browser) = browser(folder.path(), "axe_finds_nothing_serious") else {
        return;
    };
    browser.open(&studio.url);
    browser.press("End", false);
    browser.evaluate(&format!("{script}; true"));
    for scheme in ["light", "dark"] {
        browser.look(1_280, 900, scheme);
        let found = browser.evaluate(
            "axe.run().then((all) => all.violations.filter((it) => ['serious', 'critical'].includes(it.impact)) \
                .map((it) => `${it.id}: ${it.nodes.slice(0, 5).map((node) => node.html + node.failureSummary).join(' | ')}`))",
        );
        assert_eq!(found, json!([]), "{scheme}");
        let judged = browser.evaluate("axe.run().then((all) => all.passes.length)");
        assert!(judged.as_u64().unwrap() > 15, "{judged}");
    }
}

#[test]
fn a_hostile_log_runs_no_script_and_shows_where_it_is_cut() {
    let folder = tempfile::tempdir().unwrap();
    let hostile = "<img src=x onerror='window.harmed=1'><script>window.harmed=1</script>";
    let mut records = crowd();
    let first = records[0].robot.clone();
    for record in &mut records {
        if record.robot == first {
            hostile.clone_into(&mut record.robot);
        }
    }
    let path = write(&records, folder.path(), "<b>hostile.jsonl");
    // Very many events, and a cut in the middle of a record with more behind it.
    let mut log = std::fs::read_to_string(&path).unwrap();
    let last = records.last().unwrap().at_us;
    let detail = format!("{hostile}{}", "x".repeat(300));
    for number in 0..40_000_u64 {
        let dropped = json!({"atUs": last + number * 100, "robot": hostile, "entry": "dropped", "layer": "codec",
            "cause": "malformed", "detail": detail, "octets": ""});
        log.push_str(&dropped.to_string());
        log.push('\n');
    }
    log.push_str("{\"atUs\": 1, \"robot\": \"cut\n{}\n");
    std::fs::write(&path, log).unwrap();
    let studio = Studio::of(&[&path]);
    let Some(mut browser) = browser(folder.path(), "a_hostile_log_runs_no_script") else {
        return;
    };
    browser.open(&studio.url);
    let trouble = browser.evaluate("document.getElementById('troubles').textContent");
    assert!(
        trouble.as_str().unwrap().contains("is not a record"),
        "{trouble}"
    );
    assert_eq!(
        browser.evaluate("document.getElementById('chip').textContent"),
        json!("✗ Not valid")
    );
    for key in ["Home", "ArrowRight", "ArrowRight", "End", "ArrowLeft"] {
        browser.press(key, false);
    }
    browser.wait_for(&format!(
        "{TIME} > 1e6 && document.querySelectorAll('#messages .row').length > 50"
    ));
    let rows = browser.evaluate("document.querySelectorAll('*').length");
    assert!(rows.as_u64().unwrap() < 9_000, "{rows} elements");
    assert!(
        browser
            .evaluate("document.body.textContent")
            .as_str()
            .unwrap()
            .contains(hostile)
    );
    assert_eq!(
        browser.evaluate("window.harmed === undefined && document.images.length === 0"),
        json!(true)
    );
    browser.look(820, 900, "light");
    assert!(
        browser
            .evaluate("document.documentElement.scrollWidth")
            .as_u64()
            .unwrap()
            <= 820
    );
    assert_clean(&browser, &studio);
}

#[test]
fn the_server_answers_get_by_its_own_name_and_nothing_else() {
    let folder = tempfile::tempdir().unwrap();
    let log = write(&crowd(), folder.path(), "crowd.jsonl");
    let studio = Studio::of(&[&log]);
    let own = studio.address().to_owned();
    let page = studio.ask(&format!("GET / HTTP/1.1\r\nHost: {own}\r\n\r\n"));
    assert!(page.starts_with("HTTP/1.1 200 OK"), "{page}");
    assert!(
        page.contains("Content-Security-Policy: default-src 'none'; script-src 'self'"),
        "{page}"
    );
    let asked = [
        (
            format!(
                "GET /api/opening HTTP/1.1\r\nHost: evil.example:{}\r\n\r\n",
                own.rsplit(':').next().unwrap()
            ),
            "421",
        ),
        ("GET / HTTP/1.1\r\n\r\n".to_owned(), "421"),
        (
            format!("POST /api/moment HTTP/1.1\r\nHost: {own}\r\n\r\n"),
            "405",
        ),
        (
            format!("GET /../Cargo.toml HTTP/1.1\r\nHost: {own}\r\n\r\n"),
            "404",
        ),
        (
            format!("GET /api/moment?at=now HTTP/1.1\r\nHost: {own}\r\n\r\n"),
            "400",
        ),
        (
            format!(
                "GET /api/moment?at=18446744073709551615&from=9&to=1 HTTP/1.1\r\nHost: {own}\r\n\r\n"
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
