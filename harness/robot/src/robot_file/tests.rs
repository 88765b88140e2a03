//! Settings that do not fit the site.

use std::path::Path;

use super::*;
use crate::table::rows;

/// Changed file (robot, site or plan), replaced text, its replacement, and the error.
const WRONG: &str = r#"
robot | [0.0, -1.5]        | [0,0, -1,5]          | 4 elements are here, and 2 are wanted; decimals have a point, like 1.5
robot | [0.0, -1.5]        | [0.0]                | 1 elements are here, and 2 are wanted
robot | [0.0, -1.5]        | [0.0, 2000.0]        | place is [0, 2000]: metres east and north of the site's origin are wanted, each from -1000 to 1000
robot | [0.0, -1.5]        | [0.0, 1e308]         | place is [0, 1e308]: metres east
robot | [0.0, -1.5]        | [1.0, 3.5]           | place is [1, 3.5], on the carriageway: a place beside it is wanted
robot | [0.0, -1.5]        | [-18.0, 2.0]         | place is [-18, 2], on the carriageway
robot | place = [0.0, -1.5] | LONG                | robot.toml: TOML parse error
robot | [0.53, 0.75, 1.65] | [0,53, 0,75, 1,65]   | 6 elements are here, and 3 are wanted
robot | [6.0, 9.0]]        | [6,0, 9,0]]          | 4 elements are here, and 2 are wanted
robot | [-3.0, 7.0]]       | [-3.0, 7.0, 0.0]]    | 3 elements are here, and 2 are wanted
robot | [1.0, 8.0]]        | [1.0, 8.0, 0.0]]     | 3 elements are here, and 2 are wanted
robot | [1.0, 8.0]]        | [1.0, 8.0], [0, 0]]  | 3 elements are here, and 2 are wanted
robot | [1.0, 8.0]]        | [1.0, 2000.0]]       | [zone] escort_m: [1, 2000] is no place: metres on the site, at most 1000
robot | station = 1        | station = 0          | station is 0: a number from 1 to 4294967295 is wanted, which no other robot has
robot | 127.0.0.1:2        | 127.0.0.1:1          | [link] 127.0.0.1:1 is the robot's own address: 'peers'
robot | 127.0.0.1:1"       | 0.0.0.0:2"           | [link] 127.0.0.1:2 is the robot's own address: 'peers'
robot | plan_file          | autopilot = true #   | 'autopilot' on a site of its own wants 'plan_file': "crossing" is
robot | its_aid = 16482    | its_aid = 16481      | [identifiers] two services have the ITS-AID 16481
robot | its_aid = 16482    | its_aid = 36         | [identifiers] two services have the ITS-AID 36
robot | its_aid = 16482    | its_aid = 638        | [identifiers] two services have the ITS-AID 638
robot | [5.0, 7.0], [-3    | [5.0, 6.9], [-3      | [zone] road_m leaves out a part of the crossing between the kerbs of the site
robot | unix:ari.sock      | tcp:47600            | [body] listen: 'tcp:47600' is no UNIX socket: "unix:FILE" is wanted
robot | unix:ari-op.sock   | 127.0.0.1:47700      | [operator] listen: '127.0.0.1:47700' is no UNIX socket: "unix:FILE" is wanted
site  | [-4.0, 2.0]        | [-4,0, 2,0]          | site.toml:37: 4 elements are here, and 2 are wanted
site  | [-20.0, 1.75]      | [-20.0, 1.75, 0.0]   | site.toml:18: 3 elements are here, and 2 are wanted
site  | [-3.0, 0.0], [5.0  | [-3,0, 0,0], [5.0    | site.toml:10: 4 elements are here, and 2 are wanted
site  | [5.0, 0.0]]        | [5.0, 0.0], [6, 0]]  | site.toml:10: 3 elements are here, and 2 are wanted
site  | [-4.0, 2.0]        | [-4.0, 2000.0]       | [-4, 2000] is no place: metres east and north of the origin, at most 1000, are wanted
plan  | "near-kerb", "far  | "corner", "x", "far  | plan.toml:4: 3 elements are here, and 2 are wanted
plan  | to = "far-kerb"    | to = [1,0, 8,0]      | plan.toml:27: a place is wanted: its name on the site, or [EAST, NORTH] in metres
plan  | station = 1        | station = 0          | plan.toml:6: role 'leader' is for station 0, which is no station
plan  | station = 1        | station = 2          | plan.toml:15: roles 'leader' and 'escort' are for one station
"#;

/// A robot file that says of everything what it can, and is right.
const RIGHT: &str = r#"
name = "ARI"
station = 1
build = "humanoid"
dimensions_m = [0.53, 0.75, 1.65]
boot_file = "ari.boot"
place = [0.0, -1.5]
site_file = "site.toml"
plan_file = "plan.toml"
[zone]
polygon_m = [[-4.0, -2.0], [6.0, -2.0], [6.0, 9.0]]
road_m = [[-3.0, 0.0], [5.0, 0.0], [5.0, 7.0], [-3.0, 7.0]]
escort_m = [[1.0, -1.0], [1.0, 8.0]]
[body]
listen = "unix:ari.sock"
[operator]
listen = "unix:ari-op.sock"
[identifiers.ram]
protocol_version = 1
message_id = 240
btp_port = 2998
its_aid = 16482
[link]
address = "127.0.0.1:1"
peers = ["127.0.0.1:2"]
"#;

#[test]
fn point_7_what_is_wrong_is_refused_with_line_or_key_and_remedy() {
    let folder = tempfile::tempdir().unwrap();
    let right = [
        ("robot", RIGHT),
        ("site", include_str!("../../plans/street.toml")),
        ("plan", include_str!("../../plans/crossing.toml")),
    ];
    let read = |changed: &str, from: &str, to: &str| {
        for (name, text) in right {
            let to = if name == changed { to } else { from };
            assert!(name != changed || text.contains(from), "{from}");
            let path = folder.path().join(format!("{name}.toml"));
            std::fs::write(path, text.replacen(from, to, 1)).unwrap();
        }
        RobotFile::read(&folder.path().join("robot.toml")).map_err(|error| error.to_string())
    };
    assert!(read("", "", "").is_ok());
    for [file, from, to, cause] in rows(WRONG) {
        let error = read(&file, &from, &to.replace("LONG", &"x".repeat(100_000))).expect_err(&to);
        assert!(error.len() < 1_000, "{file}: {to}: {error}");
        assert!(error.contains(&cause), "{file}: {to}: {error}");
    }
}

/// A robot with these settings and this plan.
fn robot(protocol: &str, plan_file: Option<&Path>) -> Result<RobotFile, String> {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("robot.toml");
    let text = format!(
        "name = \"ARI\"\nstation = 1\nbuild = \"humanoid\"\nboot_file = \"ari.boot\"\n\
         [link]\naddress = \"127.0.0.1:1\"\npeers = [\"127.0.0.1:2\"]\n[protocol]\n{protocol}"
    );
    std::fs::write(&path, text).unwrap();
    let besides = Besides {
        plan_file,
        ..Besides::default()
    };
    RobotFile::read_with(&path, besides).map_err(|error| error.to_string())
}

fn read(protocol: &str) -> Result<RobotFile, String> {
    robot(protocol, Some(Path::new("crossing")))
}

/// Settings, and what is said of them.
const UNSAFE: &str = "
holding = 0     | [protocol] the settings break 'block-holds'
holding = 6     | [protocol] holding has 'move': an escort guards beside a person on the way
guarding = 0    | [protocol] the settings break 'named-tasks-guard'
t_cross = 1     | [protocol] t_cross is 0.001 s: a slow walker (0.9 m/s) is on the carriageway for 7.8 s
t_cross = 20000 | plan crossing:27: role 'escort' goes 9.0 m at 0.424 m/s, which takes 21.2 s: t_cross is 20 s
";

#[test]
fn settings_that_switch_a_protection_off_are_refused() {
    assert!(read("").is_ok());
    for [protocol, cause] in rows(UNSAFE) {
        let error = read(&protocol).unwrap_err();
        assert!(error.contains(&cause), "{protocol}: {error}");
    }
}

/// A carriageway, where people are escorted over it, and what is said of that.
const ESCORTS: &str = "
[-13, 0], [15, 0], [15, 7], [-13, 7]     |                               |
[-13, 0], [15, 0], [15, 7], [-13, 7]     | escort_m = [[1, 8], [4, -1]]  |
[-20, 0], [20, 0], [20, 30], [-20, 30]   | escort_m = [[1, -1], [1, 31]] | [protocol] t_cross is 30 s: a slow walker (0.9 m/s) is on the carriageway for 33.3 s
[-13, 0], [15, 0], [15, 7], [-13, 7]     | escort_m = [[1, -1], [1, 4]]  | [zone] escort_m leads from [1, -1] to [1, 4]: a place on each of the two pavements is wanted
[-13, 0], [15, 0], [15, 7], [-13, 7]     | escort_m = [[1, 2], [1, 8]]   | [zone] escort_m leads from [1, 2] to [1, 8]
[-13, 0], [15, 0], [15, 7], [-13, 7]     | escort_m = [[1, -1], [4, -1]] | [zone] escort_m leads from [1, -1] to [4, -1]
[-13, 12], [15, 12], [15, 19], [-13, 19] |                               | [zone] escort_m leads from [1, -1] to [1, 8]
[-30, 0], [30, 0], [30, 24], [-30, 24]   | escort_m = [[1, -1], [1, 25]] | [zone] escort_m is 26.0 m long, which takes an escort 61.3 s: t_exec is 60 s
[-30, 0], [30, 0], [30, 20], [-30, 20]   | escort_m = [[1, -1], [1, 21]] | [zone] escort_m is 22.0 m long, which takes an escort 51.9 s: t_cross is 30 s
";

/// Hazard: a robot leaves people in the middle of a road of its own, or guards them for less time than they need.
#[test]
fn a_robot_escorts_people_over_its_own_road_and_in_time() {
    for [road, escort, cause] in rows(ESCORTS) {
        let text = format!(
            "name = \"ARI\"\nstation = 1\nbuild = \"humanoid\"\nboot_file = \"ari.boot\"\nautopilot = true\n\
             [link]\naddress = \"127.0.0.1:1\"\npeers = [\"127.0.0.1:2\"]\n\
             [zone]\nplace_m = [1, -1.5]\nradius_m = 2\nroad_m = [{road}]\n{escort}"
        );
        let read = RobotFile::parse(Path::new("robot.toml"), &text, Besides::default());
        let error = read.map_or_else(|error| error.to_string(), |_| String::new());
        assert_eq!(
            error.is_empty(),
            cause.is_empty(),
            "{road} {escort}: {error}"
        );
        assert!(error.contains(&cause), "{road} {escort}: {error}");
    }
}

/// A site that is said.
const SITED: &str = "[site]\nlatitude = 48.8\nlongitude = 9.2\n";

/// A robot whose body is another process, with these lines before its tables and this table of its body.
fn bodied(lines: &str, body: &str) -> Result<RobotFile, RobotFileError> {
    let text = format!(
        "name = \"ARI\"\nstation = 1\nbuild = \"humanoid\"\nboot_file = \"ari.boot\"\n{lines}\n\
         [link]\naddress = \"127.0.0.1:1\"\n{body}\nlisten = \"unix:ari.sock\"\n"
    );
    RobotFile::parse(Path::new("ari.toml"), &text, Besides::default())
}

/// Hazard: vehicles that a robot hears are kilometres away from where it takes itself to be, and it sends a person on the
/// road in front of them.
#[test]
fn a_real_body_is_on_a_site_that_is_said() {
    assert!(bodied(SITED, "[body]").is_ok());
    let refused = bodied("", "[body]").unwrap_err().to_string();
    assert!(refused.contains("'site_file'"), "{refused}");
}

/// Hazard: guards with real bodies leave a person on the road, because the simulated people of their leader are across.
#[test]
fn a_real_body_leads_people_whom_it_sees_or_none() {
    let leads = "plan_file = \"crossing\"";
    let zone = "[zone]\npavement_m = 2.5";
    let refused = Some("'simulated_people = true' under [body]");
    for (leads, body, expected) in [
        ("autopilot = true", "[body]", refused),
        (leads, "[body]", refused),
        (leads, "[body]\nsimulated_people = false", refused),
        (leads, "[body]\nsimulated_people = true", None),
        (leads, &format!("{zone}\n[body]"), None),
        (
            leads,
            &format!("{zone}\n[body]\nsimulated_people = true"),
            Some("'simulated_people = true' beside [zone]"),
        ),
        ("", "[body]", None),
    ] {
        let file = bodied(&format!("{leads}\n{SITED}"), body);
        let error = file.err().map(|error| error.to_string());
        let is_it = error
            .as_ref()
            .map(|error| expected.is_some_and(|it| error.contains(it)));
        assert_eq!(is_it, expected.map(|_| true), "{body}: {error:?}");
    }
}

/// Hazard: an escort without sensors hears of its person in the middle of the road, and takes that for nothing because it
/// knows no road.
#[test]
fn a_robot_without_a_zone_knows_the_carriageway_of_its_site() {
    let file = robot("", None).unwrap();
    let Road::Heard(road) = file.road() else {
        panic!("{:?}", file.road());
    };
    assert!(road.contains([1.0, 3.5]) && !road.contains([1.0, -1.0]));
}
