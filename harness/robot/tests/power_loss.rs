//! The boot counter when power fails while it is written, or cuts it off at any byte: no counter, and so
//! no session number, is ever used twice.

use std::fs;

use crossguard_robot::boot::{self, BootError};

#[test]
fn a_counter_that_was_cut_off_at_any_byte_is_refused_and_never_smaller() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("robot.boot");
    let whole = "crossguard boot counter 12345\n";
    for length in 0..whole.len() {
        fs::write(&path, &whole[..length]).unwrap();
        let error = boot::take(&path).unwrap_err();
        assert!(
            matches!(error, BootError::Corrupt { .. }),
            "{length}: {error}"
        );
        let way_out = "with N larger than at any boot of this robot before";
        assert!(error.to_string().contains(way_out), "{error}");
        assert_eq!(fs::read_to_string(&path).unwrap(), whole[..length]);
    }
    // Garbage that a disk may hold in place of lost writes, and files of something else.
    for garbage in [
        &[0; 30][..],
        b"crossguard boot counter 12\0\0\0\n",
        b"17",
        b"crossguard boot counter x",
        &[0xff, 0xfe],
    ] {
        fs::write(&path, garbage).unwrap();
        assert!(matches!(boot::take(&path), Err(BootError::Corrupt { .. })));
        assert_eq!(fs::read(&path).unwrap(), garbage);
    }
}

#[test]
fn power_that_fails_while_the_next_counter_is_written_leaves_the_old_one() {
    let next = "crossguard boot counter 8\n";
    for length in 0..=next.len() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("robot.boot");
        let new = folder.path().join("robot.boot.new");
        fs::write(&path, "crossguard boot counter 7\n").unwrap();
        fs::write(&new, &next[..length]).unwrap();
        assert_eq!(boot::take(&path).unwrap().counter, 8);
        assert!(!new.exists(), "what a crash has left is used up");
        assert_eq!(boot::take(&path).unwrap().counter, 9);
    }
}

#[test]
fn power_that_fails_while_the_counter_beside_it_is_written_leaves_that_of_the_file() {
    let beside = "crossguard boot counter     8\n";
    for length in 0..=beside.len() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("robot.boot");
        fs::write(&path, "crossguard boot counter 7\n").unwrap();
        fs::write(folder.path().join("robot.boot.lock"), &beside[..length]).unwrap();
        let counter = boot::take(&path).unwrap().counter;
        // The eighth was about to be taken where all of it is there.
        assert_eq!(counter, if length == beside.len() { 9 } else { 8 });
    }
}
