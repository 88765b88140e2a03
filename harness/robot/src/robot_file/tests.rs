//! Settings that do not fit the site.

use std::path::Path;

use super::*;

fn read(protocol: &str) -> Result<RobotFile, String> {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("robot.toml");
    let text = format!(
        "name = \"ARI\"\nstation = 1\nbuild = \"humanoid\"\nboot_file = \"ari.boot\"\n\
         [link]\naddress = \"127.0.0.1:1\"\npeers = [\"127.0.0.1:2\"]\n[protocol]\n{protocol}"
    );
    std::fs::write(&path, text).unwrap();
    let besides = Besides {
        plan_file: Some(Path::new("crossing")),
        ..Besides::default()
    };
    RobotFile::read_with(&path, besides).map_err(|error| error.to_string())
}

#[test]
fn settings_that_switch_a_protection_off_are_refused() {
    assert!(read("").is_ok());
    for (protocol, cause) in [
        ("holding = 0", "[protocol] the settings break 'block-holds'"),
        (
            "guarding = 0",
            "[protocol] the settings break 'named-tasks-guard'",
        ),
        (
            "t_cross = 1",
            "[protocol] t_cross is 0.001 s: a slow walker (0.9 m/s) is between the kerbs of the site for 7.8 s",
        ),
        (
            "t_cross = 20000",
            "plan crossing:26: role 'escort' goes 9.0 m at 0.424 m/s, which takes 21.2 s: t_cross is 20 s",
        ),
    ] {
        let error = read(protocol).unwrap_err();
        assert!(error.contains(cause), "{protocol}: {error}");
    }
}

/// Hazard: an escort without sensors hears of its person in the middle of the road, and takes that for nothing because it
/// knows no road.
#[test]
fn a_robot_without_a_zone_knows_the_carriageway_of_its_site() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("robot.toml");
    let text = "name = \"Spot\"\nstation = 2\nbuild = \"quadruped\"\nboot_file = \"spot.boot\"\n\
         [link]\naddress = \"127.0.0.1:1\"\npeers = [\"127.0.0.1:2\"]\n";
    std::fs::write(&path, text).unwrap();
    let file = RobotFile::read_with(&path, Besides::default()).unwrap();
    let Road::Heard(road) = file.road() else {
        panic!("{:?}", file.road());
    };
    assert!(road.contains([1.0, 3.5]) && !road.contains([1.0, -1.0]));
}
