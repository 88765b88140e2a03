//! Time to encode and decode typical and largest messages: by the core, by rasn, and as the endpoint does:
//! `cargo bench -p crossguard-codec --bench messages`.

#[path = "../tests/it/support/samples.rs"]
#[allow(
    dead_code,
    missing_docs,
    unreachable_pub,
    reason = "shared with the tests"
)]
mod samples;

use std::env;
use std::hint::black_box;
use std::time::{Duration, Instant};

use crossguard_codec::core::{self, Uper};
use crossguard_codec::{
    Identifiers, MESSAGE_LEN_MAX, Pdu, asn1, decode, encode, encode_into, ram_from, state_of,
    view_of_ram, views_of_rmcm,
};
use crossguard_protocol::Availability;

/// A row: what is timed, and a function that does it once and says how long it took.
type Row<'a> = (&'a str, Box<dyn FnMut() -> Duration + 'a>);

/// How often each row is timed.
const ROUNDS: usize = 400;

/// How often a row repeats what it times, which is shorter than a clock can tell.
const REPEATS: u32 = 100;

/// How long `work` takes. What it returns is looked at where it lies: a copy of a message would be measured too.
fn time<R>(work: impl FnOnce() -> R) -> Duration {
    let start = Instant::now();
    black_box(&work());
    start.elapsed()
}

/// Prints the shortest time of each row in microseconds, divided by how often a row repeats its work. The rows are timed in
/// turns, and nothing has interrupted the shortest of many.
fn print_shortest<const N: usize>(title: &str, mut rows: [Row; N]) {
    let mut shortest = [Duration::MAX; N];
    for _ in 0..ROUNDS {
        for (shortest, (_, turn)) in shortest.iter_mut().zip(&mut rows) {
            *shortest = turn().min(*shortest);
        }
    }
    println!("\n{title}, in us, the shortest of {ROUNDS}:");
    for (time, (name, _)) in shortest.iter().zip(&rows) {
        let us = time.as_secs_f64() * 1e6 / f64::from(REPEATS);
        println!("{us:>10.3}  {name}");
    }
}

fn row<'a, R>(name: &'a str, mut work: impl FnMut() -> R + 'a) -> Row<'a> {
    let turn = move || {
        time(|| {
            for _ in 0..REPEATS {
                // Of a reference, or else a copy of the message is measured too.
                black_box(&work());
            }
        })
    };
    (name, Box::new(turn))
}

/// `value` is the message as the endpoint has it, `of_rasn` the same in the reference.
fn bench<C, M>(name: &str, value: &C, of_rasn: &M)
where
    C: Uper + Pdu,
    M: rasn::Encode + rasn::Decode,
{
    let ids = &Identifiers::default();
    let octets = &encode(ids, value).expect("a valid message")[..];
    let (mut buffer, mut other) = ([0; MESSAGE_LEN_MAX], [0; MESSAGE_LEN_MAX]);
    let title = format!("{name}, {} octets", octets.len());
    let rows = [
        row("encode by the core", || {
            core::encode(black_box(value), &mut buffer)
        }),
        row("decode by the core", || {
            core::decode::<C>(black_box(octets))
        }),
        row("encode by rasn alone", || {
            rasn::uper::encode(black_box(of_rasn))
        }),
        row("decode by rasn alone", || {
            rasn::uper::decode::<M>(black_box(octets))
        }),
        row("encode by rasn", || asn1::encode(black_box(of_rasn))),
        row("decode by rasn, and tell whether it is canonical", || {
            asn1::decode::<M>(black_box(octets))
        }),
        row("encode", || encode_into(ids, black_box(value), &mut other)),
        row("decode", || decode::<C>(ids, black_box(octets))),
    ];
    print_shortest(&title, rows);
}

fn views(ids: &Identifiers) {
    let (ram, rmcm) = (samples::typical_ram(ids), samples::typical_rmcm(ids));
    let (state, view) = (samples::state(), samples::follower_view());
    let available = Availability::Available;
    let rows = [
        row("a typical RAM of a view and a state", || {
            ram_from(ids, black_box(&state), &view, available, 0, false)
        }),
        row("state of a typical RAM", || state_of(black_box(&ram))),
        row("view of a typical RAM", || view_of_ram(black_box(&ram))),
        row("views of a typical RMCM", || {
            views_of_rmcm(black_box(&rmcm))
        }),
    ];
    print_shortest("views", rows);
}

fn main() {
    // `cargo bench` passes `--bench`, and `cargo test --benches` does not.
    if !env::args().any(|argument| argument == "--bench") {
        return;
    }
    let ids = Identifiers::default();
    for (name, ram) in [
        ("typical RAM", samples::typical_ram(&ids)),
        ("largest RAM", samples::largest_ram(&ids)),
    ] {
        let of_rasn = asn1::ram::RAM::try_from(&ram).expect("the two agree");
        bench(name, &ram, &of_rasn);
    }
    for (name, rmcm) in [
        ("typical RMCM", samples::typical_rmcm(&ids)),
        ("largest RMCM", samples::largest_rmcm(&ids)),
    ] {
        let of_rasn = asn1::rmcm::RMCM::try_from(&rmcm).expect("the two agree");
        bench(name, &rmcm, &of_rasn);
    }
    views(&ids);
}
