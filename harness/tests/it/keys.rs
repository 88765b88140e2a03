//! Keys in files: each is on the disk before it has its name, and once a robot has read it, its text is nowhere in the
//! robot's memory.

use std::fs::{self, File};
use std::os::unix::fs::{FileExt, MetadataExt as _, PermissionsExt as _};
use std::os::unix::process::CommandExt as _;
use std::path::Path;

use crossguard_robot::pki;
use crossguard_testkit::command::*;

#[test]
fn each_file_is_on_the_disk_before_it_has_its_name() {
    let folder = tempfile::tempdir().unwrap();
    let Some(library) = shim(folder.path(), "tests/keys/syncs.c") else {
        return;
    };
    let (pki, notes) = (folder.path().join("pki"), folder.path().join("notes"));
    let pki_name = pki.to_str().unwrap();
    assert!(run(&["pki", "init", pki_name]).status.success());
    let mut tickets = crossguard(&["pki", "tickets", pki_name, "--robot", "guest"]);
    tickets.args(["--count", "1"]).env("LD_PRELOAD", &library);
    let made = tickets.env("SYNCS_FILE", &notes).output().unwrap();
    assert_code(&made, 0);
    let notes = fs::read_to_string(&notes).unwrap();
    let notes = notes.lines().map(|line| line.rsplit_once(' ').unwrap());
    let notes = notes.map(|(name, length)| (name, length.parse().unwrap()));
    let notes: Vec<(&str, i64)> = notes.collect();
    let tickets = pki.join("robots/guest/tickets");
    let shown = tickets.canonicalize().unwrap();
    let is_folder = |(name, length): &(&str, i64)| Path::new(name) == shown && *length == -1;
    let files = fs::read_dir(&tickets).unwrap();
    let files: Vec<_> = files.map(|it| it.unwrap().path()).collect();
    assert_eq!(files.len(), 2, "nothing else is left behind");
    for path in files {
        let length = i64::try_from(fs::metadata(&path).unwrap().len()).unwrap();
        // All of it, under another name in the same folder; and then the folder, which has the name.
        let at = notes.iter().position(|(synced, synced_length)| {
            let synced = Path::new(synced);
            synced.parent() == Some(&shown) && synced != path && *synced_length == length
        });
        let at = at.unwrap_or_else(|| panic!("{path:?} was not put on the disk: {notes:?}"));
        let is_named = notes[at..].iter().any(is_folder);
        assert!(is_named, "the name of {path:?}: {notes:?}");
    }
}

/// Hazard: another account of the machine signs as a robot. The folders are open to it here, and it reads certificates.
#[test]
fn point_6_another_user_reads_no_key_of_a_pki() {
    let folder = tempfile::tempdir().unwrap();
    if fs::metadata(folder.path()).unwrap().uid() != 0 {
        return skipped("it takes root to be another user");
    }
    let pki = folder.path().join("pki");
    assert_code(&run(&["pki", "init", pki.to_str().unwrap()]), 0);
    fs::set_permissions(folder.path(), fs::Permissions::from_mode(0o755)).unwrap();
    let find = "find . -type f -readable; echo all; find . -type f";
    let mut stranger = std::process::Command::new("sh");
    stranger.args(["-c", find]).current_dir(&pki).uid(12_345);
    let said = stdout(&stranger.output().unwrap());
    let (read, all) = said.split_once("all\n").unwrap();
    let is_key = |it: &&str| Path::new(it).extension() == Some("key".as_ref());
    let keys = |files: &str| files.lines().filter(is_key).count();
    assert_eq!((keys(read), keys(all)), (0, 19), "{said}");
    assert!(read.contains("./root.cert"), "{said}");
    let write = "for it in $(find .); do test -w $it && echo $it; done";
    let mut stranger = std::process::Command::new("sh");
    stranger.args(["-c", write]).current_dir(&pki).uid(12_345);
    assert_eq!(stdout(&stranger.output().unwrap()), "");
}

/// Mask that hides a needle, so that the search does not find itself.
const MASK: u8 = 0x5a;

/// A part of a file that is not in this process's memory but hidden.
fn hidden(path: &Path, from: u64, length: u64) -> Vec<u8> {
    let file = File::open(path).unwrap();
    let octet = |at| {
        let mut octet = [0];
        file.read_exact_at(&mut octet, at).unwrap();
        octet[0] ^ MASK
    };
    (from..from + length).map(octet).collect()
}

/// How often the needle is in the memory of this process that can be written to; `None` where it may not be looked at.
fn count_in_memory(needle: &[u8]) -> Option<usize> {
    let maps = fs::read_to_string("/proc/self/maps").ok()?;
    let memory = File::open("/proc/self/mem").ok()?;
    let mut count = 0;
    for line in maps.lines() {
        let (range, rest) = line.split_once(' ')?;
        // The kernel's own pages cannot be read.
        if !rest.starts_with("rw") || line.ends_with("[vvar]") {
            continue;
        }
        let (from, until) = range.split_once('-')?;
        let [from, until] = [from, until].map(|it| u64::from_str_radix(it, 16).unwrap());
        let mut octets = vec![0; usize::try_from(until - from).unwrap()];
        if memory.read_exact_at(&mut octets, from).is_err() {
            continue;
        }
        // Octets that were searched are hidden at once: the copy would be found in the next region.
        for octet in &mut octets {
            *octet ^= MASK;
        }
        count += octets
            .windows(needle.len())
            .filter(|it| *it == needle)
            .count();
    }
    Some(count)
}

/// The other test of this file leaves keys to another process.
#[test]
fn the_text_of_a_key_is_gone_from_memory_once_it_was_read() {
    let folder = tempfile::tempdir().unwrap();
    let pki = folder.path().join("pki");
    let made = run(&["pki", "init", pki.to_str().unwrap(), "--robot", "Go2"]);
    assert_code(&made, 0);
    let tickets = pki.join("robots/Go2/tickets");
    let mut keys = fs::read_dir(&tickets).unwrap().map(|it| it.unwrap().path());
    let key = keys
        .find(|it| it.extension().is_some_and(|it| it == "key"))
        .unwrap();
    // Behind the line that all keys begin with: 48 characters of the encoded key.
    let needle = hidden(&key, 100, 48);
    let credentials = pki::read_credentials(&pki.join("robots/Go2")).unwrap();
    let Some(found) = count_in_memory(&needle) else {
        return skipped("there is no /proc/self/mem");
    };
    let count = credentials.tickets.len();
    assert_eq!(found, 0, "{count} keys were read, and one left its text");
    // The test of the test: read in any other way, it is there.
    let text = fs::read_to_string(&key).unwrap();
    assert_ne!(count_in_memory(&needle), Some(0));
    drop(text);
}
