//! A studio that is served, a browser that opens it, and what must hold of each of its pages.

use std::ffi::OsStr;
use std::io::{BufRead, BufReader, Read, Write};
use std::net::TcpStream;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use crossguard_testkit::command::*;
use serde_json::json;

use crate::browser::{Browser, PATIENCE};

/// A studio that is served.
pub(crate) struct Studio {
    pub(crate) child: Child,
    pub(crate) url: String,
}

impl Studio {
    /// Of logs, on the street of the demonstrations.
    pub(crate) fn of(logs: &[&Path]) -> Self {
        let mut given: Vec<&OsStr> = Vec::new();
        if !logs.is_empty() {
            given.extend(["--site", "street"].map(OsStr::new));
        }
        given.extend(logs.iter().map(|path| path.as_os_str()));
        Self::with(&given)
    }

    /// With these arguments.
    pub(crate) fn with(arguments: &[&OsStr]) -> Self {
        let mut command = crossguard(&["studio", "--no-browser", "--port", "0"]);
        command.args(arguments);
        let mut child = command.stdout(Stdio::piped()).spawn().unwrap();
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

    pub(crate) fn address(&self) -> &str {
        let address = self.url.trim_start_matches("http://");
        address.split('/').next().unwrap()
    }

    /// What it answers to a head.
    pub(crate) fn ask(&self, head: &str) -> String {
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

/// A browser, or nothing where this machine has none; then the test is said to be skipped.
pub(crate) fn browser(folder: &Path, test: &str) -> Option<Browser> {
    let browser = Browser::start(folder);
    if browser.is_none() {
        eprintln!("SKIPPED {test}: no chromium (Debian package chromium)");
    }
    browser
}

/// The page has no error, and asked only its own server.
pub(crate) fn assert_clean(browser: &Browser, studio: &Studio) {
    let (errors, requests) = browser.told();
    assert!(errors.is_empty(), "{errors:#?}");
    assert!(requests.len() > 8, "{requests:?}");
    let own = format!("http://{}/", studio.address());
    let others: Vec<_> = requests
        .iter()
        .filter(|url| !url.starts_with(&own) && *url != "about:blank")
        .collect();
    assert!(others.is_empty(), "{others:?}");
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

/// Every width and colour scheme shows the page without cutting a text off.
pub(crate) fn assert_fits(browser: &mut Browser) {
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
                "[...document.querySelectorAll('h1, h2, h3, p, dd, dt, button, label, output, .said, .timers li, summary')] \
                    .filter((it) => it.offsetParent && it.scrollWidth > it.clientWidth + 1 && getComputedStyle(it).display !== 'inline') \
                    .map((it) => `${it.tagName} ${it.textContent}`)",
            );
            assert_eq!(cut, json!([]), "{width}, {scheme}");
            let outside = browser.evaluate(
                "[...document.querySelectorAll('svg[role=img]')].flatMap((of) => { const box = of.getBoundingClientRect(); \
                    return [...of.querySelectorAll('text')].filter((it) => { const b = it.getBoundingClientRect(); \
                        return b.left < box.left - 1 || b.right > box.right + 1 || b.top < box.top - 1 || b.bottom > box.bottom + 1; }) \
                        .map((it) => it.textContent); })",
            );
            assert_eq!(outside, json!([]), "{width}, {scheme}");
        }
    }
}

/// axe-core finds nothing serious in the page as it is, in both colour schemes; skipped by name where npm does not bring it.
pub(crate) fn assert_accessible(browser: &mut Browser, folder: &Path, test: &str) {
    let Some(script) = axe(folder) else {
        eprintln!("SKIPPED axe-core in {test}: it cannot be had from npm");
        return;
    };
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

/// Whatever can be used is reached by Tab, in order, and shows that it has the focus. The names of what was reached.
pub(crate) fn reached_by_tab(browser: &mut Browser, times: usize) -> Vec<String> {
    let mut reached = Vec::new();
    for _ in 0..times {
        browser.press("Tab", false);
        let shown = browser.evaluate("(() => { const it = document.activeElement, style = getComputedStyle(it); return [it.id || it.className || it.textContent, style.outlineStyle !== 'none']; })()");
        assert_eq!(shown[1], json!(true), "{shown}");
        reached.push(shown[0].as_str().unwrap().to_owned());
    }
    reached
}

/// The file that a script makes the page save, in a new folder.
pub(crate) fn saved_into(browser: &mut Browser, folder: &Path, end: &str, script: &str) -> PathBuf {
    std::fs::create_dir(folder).unwrap();
    let behaviour = json!({"behavior": "allow", "downloadPath": folder});
    browser.call("Browser.setDownloadBehavior", &behaviour);
    browser.evaluate(script);
    let deadline = Instant::now() + PATIENCE;
    loop {
        let files = std::fs::read_dir(folder).unwrap().flatten();
        let mut saved = files.map(|it| it.path());
        if let Some(file) = saved.find(|it| it.extension().is_some_and(|it| it == end)) {
            return file;
        }
        assert!(Instant::now() < deadline, "nothing was saved");
        std::thread::sleep(Duration::from_millis(50));
    }
}
