//! Hazard: a stolen robot speaks on. A certificate on the revocation list of a running robot is not believed, from the
//! list on; a list that cannot be read any more changes nothing, and is said.

use std::fs;
use std::net::{SocketAddr, UdpSocket};
use std::sync::Arc;
use std::sync::mpsc::Receiver;
use std::time::{Duration, Instant};

use crossguard_codec::Identifiers;
use crossguard_endpoint::cause::Cause;
use crossguard_endpoint::station::{Credentials, Mode, Security};
use crossguard_protocol::StationId;
use crossguard_robot::application::Application;
use crossguard_robot::body::{Build, Simulated};
use crossguard_robot::journal::{Journal, WhenFull};
use crossguard_robot::pki::{self, Pki, add_revoked};
use crossguard_robot::runtime::{Running, Setup};
use crossguard_robot::site::{Place, Site};
use crossguard_robot::trace::{Entry, Record};
use crossguard_robot::transport::{Link, Transport};
use nix::sys::stat;
use nix::unistd::mkfifo;

const PATIENCE: Duration = Duration::from_mins(1);

/// An idle robot, which says a RAM at least once a second, and what it notes.
fn robot(
    (own, other): (SocketAddr, SocketAddr),
    credentials: Credentials,
) -> (Running, Receiver<Arc<Record>>) {
    let mut journal = Journal::new();
    let records = journal.reader(4_096, WhenFull::Skip, Cause::OutputFull);
    let body = Simulated::new(Build::Quadruped, Site::default(), Place::default(), 1.0, 1);
    let application = Application::new(Box::new(body), None);
    let link = Link::loopback(own.port(), vec![other]).open().unwrap();
    let name = format!("R{}", own.port());
    let setup = Setup {
        security: Security::new(Mode::Enforce, credentials, None, pki::now()).unwrap(),
        journal,
        ..Setup::new(&name, StationId(1), application, link)
    };
    (setup.start(), records)
}

/// Waits for an entry; which entries came before it.
fn wait_for(
    records: &Receiver<Arc<Record>>,
    what: &str,
    wanted: impl Fn(&Entry) -> bool,
) -> Vec<Entry> {
    let deadline = Instant::now() + PATIENCE;
    let mut before = Vec::new();
    loop {
        let left = deadline.saturating_duration_since(Instant::now());
        let record = records.recv_timeout(left);
        let record = record.unwrap_or_else(|_| panic!("waited in vain for: {what}"));
        if wanted(&record.entry) {
            return before;
        }
        before.push(record.entry.clone());
    }
}

fn is_dropped(entry: &Entry, wanted: Cause) -> bool {
    matches!(entry, Entry::Dropped { cause, .. } if *cause == wanted.into())
}

const REVOKED: Cause = Cause::Rejected("revoked");

#[test]
fn a_list_that_changes_ends_what_a_robot_believes_and_one_that_cannot_be_read_changes_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let list = folder.path().join("revoked.txt");
    add_revoked(&list, &[]).unwrap();
    let (ids, now) = (Identifiers::default(), pki::now());
    let pki = Pki::for_a_day(&ids, now).unwrap();
    let [listens, speaks] = [1, 2].map(|_| pki.credentials(&ids, (1, None), now).unwrap());
    let stolen = speaks.tickets[0].certificate().id();
    let sockets = [(); 2].map(|()| UdpSocket::bind("127.0.0.1:0").unwrap());
    let [one, other] = sockets.map(|it| it.local_addr().unwrap());
    let (mut listener, records) = robot((one, other), listens);
    listener.keep_revoked(list.clone());
    let (speaker, _unread) = robot((other, one), speaks);
    let is_heard = |entry: &Entry| matches!(entry, Entry::Heard { .. });

    wait_for(&records, "the other robot", is_heard);
    add_revoked(&list, &[stolen]).unwrap();
    wait_for(&records, "a revoked message", |it| is_dropped(it, REVOKED));
    // Something takes its place that could be waited for, and then nothing is there.
    let fifo = folder.path().join("fifo");
    mkfifo(&fifo, stat::Mode::S_IRUSR).unwrap();
    fs::rename(fifo, &list).unwrap();
    let is_said = |it: &Entry| is_dropped(it, Cause::RevokedUnread);
    let before = wait_for(&records, "that the list is a FIFO", is_said);
    assert!(!before.iter().any(is_heard), "revoked is revoked");
    fs::remove_file(&list).unwrap();
    let before = wait_for(&records, "that the list is gone", is_said);
    assert!(!before.iter().any(is_heard), "revoked is revoked");
    let before = wait_for(&records, "a revoked message", |it| is_dropped(it, REVOKED));
    assert!(!before.iter().any(is_heard), "the list before it stays");
    // A list without it.
    add_revoked(&list, &[]).unwrap();
    wait_for(&records, "the other robot again", is_heard);
    speaker.stop().unwrap();
    listener.stop().unwrap();
}
