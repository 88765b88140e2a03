//! Plans that fit, and plans that do not.

use crossguard_protocol::TaskType;

use super::*;
use crate::table::rows;

const TWO_DOGS: &str = r#"
[[roles]]
name = "leader"
leads = true
waits = "corner"

[[roles]]
name = "first"
[[roles]]
name = "second"
[[stages]]
first = { task = "initialPos", to = "near-kerb" }
second = { task = "initialPos", to = [2.5, -1.0] }
[[stages]]
second = { task = "block", to = "far-lane", heading_deg = 90.0 }
[[stages]]
first = { task = "move", to = "far-kerb", speed_mps = 0.424 }
"#;

fn parse(text: &str) -> Result<PlanFile, String> {
    let settings = Settings::default();
    let plan = PlanFile::parse("p.toml", "p", text, SiteFile::street(), &settings);
    plan.map_err(|error| error.to_string())
}

#[test]
fn every_shipped_plan_fits_the_street_and_the_crossing_is_that_of_the_paper() {
    for (name, _) in SHIPPED {
        let plan = PlanFile::open(Path::new(name), SiteFile::street());
        plan.unwrap_or_else(|error| panic!("{error}"));
    }
    let site = SiteFile::street();
    let file = PlanFile::open(Path::new("crossing"), site.clone()).unwrap();
    let (plan, built) = (file.plan(StationId(1), 1), Plan::crossing(site.site));
    assert_eq!(plan.roles, [None], "any robot may escort");
    assert_eq!(
        (plan.kerbs, plan.crossing_s),
        (built.kerbs, built.crossing_s)
    );
    for stage in 0..2 {
        let leg = |plan: &Plan| plan.lead().leg(stage, 0, false);
        assert_eq!(leg(&plan), leg(&built));
    }
}

#[test]
fn a_team_has_as_many_guards_as_there_are_followers_besides_the_escort() {
    let team = PlanFile::open(Path::new("team"), SiteFile::street()).unwrap();
    assert_eq!(team.followers, 3);
    for followers in 1..=16 {
        let plan = team.plan(StationId(1), followers);
        assert_eq!(plan.followers, followers);
        assert_eq!(
            team.taking_part(followers).len(),
            usize::from(followers) + 1
        );
        assert_eq!(plan.roles.last(), Some(&Some(StationId(2))), "the dog");
        assert_eq!(plan.stages.len(), if followers == 1 { 2 } else { 3 });
    }
}

#[test]
fn two_dogs_go_to_two_places() {
    let plan = parse(TWO_DOGS).unwrap().plan(StationId(1), 2);
    let plan = plan.lead();
    let [first, second] = [0, 1].map(|seat| plan.leg(0, seat, false).unwrap().to);
    assert!(f64::from(first.distance_cm(second)) >= APART_M * 100.0);
    let block = plan.leg(1, 1, false).unwrap();
    assert_eq!(
        (block.task, block.heading_ddeg),
        (TaskType::BLOCK, Some(900))
    );
}

/// Replaced text of [`TWO_DOGS`], its replacement, and the error.
const MISFITS: &str = r#"
\n[[roles]]\nname = "leader" | either_way = ["near-kerb", [2.0, 8.0]]\n[[roles]]\nname = "leader" | p.toml:17: role 'first' escorts people, and not from one place of 'either_way'
\n[[roles]]\nname = "leader" | either_way = [[0.0, -1.0], "far-kerb"]\n[[roles]]\nname = "leader" | p.toml:17: role 'first' escorts people, and not from one place of 'either_way'
[2.5, -1.0]       | "near-kerb"         | p.toml:12: roles 'first' and 'second' are 0.00 m apart
[2.5, -1.0]       | [1.9, -1.0]         | are 0.90 m apart in this stage: at least 1 m is wanted
[2.5, -1.0]       | "corner"            | p.toml:13: roles 'second' and 'leader' are 0.00 m apart
"far-kerb"        | "bench"             | p.toml:17: site 'street' has no place 'bench'; it has
"far-kerb"        | "far-lane"          | p.toml:17: place 'far-lane' is not for a move
"far-lane"        | [-4.0, -0.8]        | p.toml:15: the place of a block is for guarding, and on no lane
"far-kerb"        | [1.0, 3.4]          | p.toml:17: the place of a move is on lane 'near'
"far-kerb"        | [9.0, -1.0]         | p.toml:17: role 'first' escorts people from one place to another that is not over the road
\n[[roles]]\nname = "leader" | either_way = ["near-kerb", [4.0, -1.0]]\n[[roles]]\nname = "leader" | p.toml:1: a place at each of two kerbs is wanted, and these are on one side of the road
"far-lane"        | "corner"            | p.toml:15: place 'corner' is not for a block
"move"            | "dance"             | p.toml:17: 'dance' is no task:
0.424             | 9                   | p.toml:17:
0.424             | 0.1                 | p.toml:17: role 'first' goes 9.0 m at 0.1 m/s, which takes 90.0 s: t_exec is 60 s
0.424             | 0.25                | p.toml:17: role 'first' goes 9.0 m at 0.25 m/s, which takes 36.0 s: t_cross is 30 s
heading_deg = 90.0 | heading_deg = 361.0 | 361 is not possible: 0 to 360 degrees
name = "second"   | name = "first"      | there are two roles 'first'
leads = true      |                     | no role has 'leads = true'
to = [2.5, -1.0]  | to = [1e30, 0.0]    | p.toml:13: [1
to = [2.5, -1.0]  | to = 7              | a place is wanted: its name on the site
waits = "corner"  | wait = "corner"     | p.toml:5: unknown field `wait`
name = "first"    | name = "first"\nstands = "corner" | role 'first' does not lead
name = "first"    | name = "first"\nshows = "stop"    | role 'first' does not lead: no command says what a follower shows
leads = true      | leads = true\nshows = "dance"     | unknown variant `dance`
second = { task = "initialPos" | third = { task = "initialPos"  | p.toml:13: no follower has the role 'third'; there are first, second
[[stages]]\nfirst = { task = "move" | first = { task = "move"  | p.toml:15: role 'second' is sent to guard in stage 2, and a person is escorted from stage 2 on
task = "initialPos", to = "near-kerb" | task = "move", to = "near-kerb" | p.toml:15: role 'second' is sent to guard in stage 2, and a person is escorted from stage 1 on
\n[[roles]]\nname = "leader" | crossing_s = 30.5\n[[roles]]\nname = "leader" | p.toml:1: a pedestrian crosses in 30.5 s: t_cross is 30 s
"#;

#[test]
fn a_plan_that_does_not_fit_is_refused_with_its_line() {
    for [from, to, cause] in rows(MISFITS) {
        assert!(TWO_DOGS.contains(&from), "{from}");
        let error = parse(&TWO_DOGS.replacen(&from, &to, 1)).unwrap_err();
        assert!(error.contains(&cause), "{to}: {error}");
    }
    // Hazard: the stages that are too many are left out, and the escort with them: nobody ever sees go.
    let aside = "[[stages]]\nsecond = { task = \"initialPos\", to = [2.5, -1.0] }\n";
    let longer =
        |by: usize| parse(&TWO_DOGS.replacen("[[stages]]", &(aside.repeat(by) + "[[stages]]"), 1));
    assert!(longer(5).is_ok());
    let error = longer(6).unwrap_err();
    assert!(error.contains("at most 8 stages are possible"), "{error}");
    let optional = TWO_DOGS
        .replace("name = \"first\"", "name = \"first\"\noptional = true")
        .replace("name = \"second\"", "name = \"second\"\noptional = true");
    let team_of = |followers: u8| parse(&format!("followers = {followers}\n{optional}"));
    assert!(team_of(1).is_ok());
    let error = team_of(0).unwrap_err();
    assert!(
        error.contains("0 followers: 1 to 2 fit the roles"),
        "{error}"
    );
    let unknown = PlanFile::open(Path::new("parade"), SiteFile::street()).unwrap_err();
    assert!(
        unknown.to_string().contains("one of crossing, bilateral"),
        "{unknown}"
    );
}
