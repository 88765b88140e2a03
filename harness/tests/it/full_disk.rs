//! A disk that is full: without a boot counter on it a robot does not start, and does when there is room again.

use std::fs;

use crossguard_testkit::command::*;

/// Runs the robot three times on a small disk of its own: with room, without, and with room again.
const SMALL_DISK: &str = r#"
set -e
mount -t tmpfs -o size=16k tmpfs "$1"
[ "$2" = try ] && exit 0
printf '%s' "$3" > "$1/ARI.toml"
start() { echo quit | "$2" run --config "$1/ARI.toml" > /dev/null; }
start "$1" "$2"
dd if=/dev/zero of="$1/full" bs=1k status=none 2>/dev/null || true
start "$1" "$2" && exit 90 || [ $? = 2 ]
cat "$1/ARI.boot"
rm "$1/full"
start "$1" "$2"
cat "$1/ARI.boot"
"#;

#[test]
fn on_a_disk_that_is_full_a_robot_does_not_start_and_does_when_there_is_room_again() {
    let folder = tempfile::tempdir().unwrap();
    let disk = folder.path().to_str().unwrap();
    let elsewhere = tempfile::tempdir().unwrap();
    let port = two_free_ports();
    let config = robot_file(elsewhere.path(), "ARI", 1, port, port + 1);
    let config = fs::read_to_string(config).unwrap();
    let arguments = [disk, env!("CARGO_BIN_EXE_crossguard"), &config];
    let Some(output) = unshared(&["--mount"], SMALL_DISK, &[disk, "try"], &arguments) else {
        return;
    };
    let said = stderr(&output);
    assert_code(&output, 0);
    said.must_have(&[
        "the boot counter cannot be kept in",
        "No space left on device",
    ]);
    let counters = "crossguard boot counter 1\ncrossguard boot counter 2\n";
    assert_eq!(stdout(&output), counters);
}
