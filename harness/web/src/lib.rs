//! The questions of the studio's pages, answered in the browser: [`ask`] as WebAssembly.
//! `harness/src/studio/walk/worker.js` calls it. Built for `wasm32-unknown-unknown` by `.ci/dist`.
//!
//! Text goes through one buffer in the module's memory: the page asks for [`room`], writes its question there, calls [`answer`],
//! and reads as many octets as [`length`] says from where that points.
#![allow(
    unsafe_code,
    reason = "names that a page can call; nothing else here is unsafe"
)]

use std::sync::{Mutex, MutexGuard, PoisonError};

use crossguard_model_check::walk::{Refusal, ask};

static TEXT: Mutex<Vec<u8>> = Mutex::new(Vec::new());

fn text() -> MutexGuard<'static, Vec<u8>> {
    TEXT.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Where a question of this many octets is to be written: its name, a line feed, and its body.
#[unsafe(no_mangle)]
pub extern "C" fn room(octets: usize) -> *mut u8 {
    let mut text = text();
    *text = vec![0; octets];
    text.as_mut_ptr()
}

/// Answers the question. Where the answer is: `+` and JSON, or `-` and why there is none.
#[unsafe(no_mangle)]
pub extern "C" fn answer() -> *const u8 {
    let mut text = text();
    let question = String::from_utf8_lossy(&text);
    let (what, body) = question.split_once('\n').unwrap_or((&question, ""));
    let answer = match ask(what, body) {
        Ok(json) => format!("+{json}"),
        Err(Refusal::Wrong(cause)) => format!("-{cause}"),
        Err(Refusal::Unknown) => format!("-there is no question '{what}'"),
    };
    *text = answer.into_bytes();
    text.as_ptr()
}

/// How many octets the answer has.
#[unsafe(no_mangle)]
pub extern "C" fn length() -> usize {
    text().len()
}
