//! Runs the scripts in `protocol/tests/scripts`, whose page has their form. [`HELP`] lists the commands. With
//! `CROSSGUARD_BLESS=1` in the environment the outputs are written anew.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use crossguard_protocol::*;

use crate::script::*;

mod show;
pub(crate) mod words;

use show::{name, said, show};
use words::{
    Wrong, event, made_ram, made_rmcm, named, number, request_of, set, station, stations, task,
    wrong,
};

/// The commands, as an error about an unknown one shows them.
const HELP: &str = "\
street ROBOT...            robots that are idle
roles ROBOT...             the first leads the others, and all have taken their roles
open TASK ROBOT...         the others guard with TASK for the first, and its corridor is open
teams [ROBOT KEY=VALUE...] ARI with GO2 and SPOT with NAO, parted, each with an open corridor; what one asks for
executing TASK             GO2 executes TASK for ARI
asking N ROBOT...          the first has asked for help of N
repeat N COMMAND           the command, N times; what comes of the last is told
settings KEY=NUMBER...     of all robots, before they are there; `ROBOT settings KEY=NUMBER...` of one
ROBOT EVENT                detects N, orders ROBOT TASK, in position, out of position, completes, fails, opens, closes,
                           road clear, task completed, leaves, unavailable WHY, available, all answered, sees a person,
                           identity N, epoch N
ROBOT elapses MS           time that this robot alone is told
ROBOT expires TIMER        one timer, whatever time it has left; `lease of station 2` is the one on GO2
ROBOT hears NAME           a message that was kept, or `RAM ...` or `RMCM ...` (see `made_ram`, `made_rmcm`)
keep NAME ROBOT RAM|RMCM   what the robot says now, or the RMCM that it sent last
pass MS                    time passes for all
cut A B, part A B, heal    B does not hear A; neither hears the other; all hear all
hang A, wakes A, reboot A, remove A
show ROBOT...              the state of robots";

/// One script of a file.
struct Script<'a> {
    street: Option<Street>,
    settings: Settings,
    kept: BTreeMap<&'a str, Input>,
    out: String,
}

/// The text of a file with outputs as the robots give them.
pub(crate) fn run(text: &str) -> String {
    let mut out = String::new();
    let mut script = None;
    for (number, line) in text.lines().enumerate() {
        if line.starts_with("  ") {
            continue;
        }
        out.push_str(line);
        out.push('\n');
        if line.starts_with("== ") {
            script = Some(Script::new());
        }
        let command = line.split(" # ").next().unwrap_or_default().trim();
        let Some(script) = script.as_mut() else {
            continue;
        };
        if command.is_empty() || line.starts_with("== ") || line.starts_with('#') {
            continue;
        }
        script.out.clear();
        let words: Vec<_> = command.split_whitespace().collect();
        if let Err(why) = script.command(&words) {
            panic!("line {}: {command}: {why}", number + 1);
        }
        out.push_str(&script.out);
    }
    out
}

impl<'a> Script<'a> {
    fn new() -> Self {
        Self {
            street: None,
            settings: Settings::default(),
            kept: BTreeMap::new(),
            out: String::new(),
        }
    }

    fn street(&mut self) -> Result<&mut Street, Wrong> {
        self.street.as_mut().ok_or_else(|| "no street yet".into())
    }

    fn command(&mut self, words: &[&'a str]) -> Result<(), Wrong> {
        let settings = self.settings.clone();
        match *words {
            ["settings", ref values @ ..] => set(&mut self.settings, values)?,
            ["street", ref robots @ ..] => {
                self.street = Some(Street::with_settings(&stations(robots)?, settings));
            }
            ["roles", ref robots @ ..] => {
                let robots = stations(robots)?;
                self.street = Some(Street::with_roles_and_settings(&robots, settings));
            }
            ["open", of, ref robots @ ..] if robots.len() > 1 => {
                self.street = Some(Street::open(&stations(robots)?, task(of)?));
            }
            ["executing", of] => self.street = Some(Street::executing(task(of)?)),
            ["asking", followers, ref robots @ ..] if !robots.is_empty() => {
                let robots = stations(robots)?;
                let mut street = Street::with_settings(&robots, settings);
                let request = escort(number(followers)?);
                street.tell(robots[0], Event::PedestrianDetected(request));
                self.street = Some(street);
            }
            ["teams", ref values @ ..] => self.street = Some(two_teams(values)?),
            ["repeat", times, ref command @ ..] => {
                for _ in 0..number::<u32>(times)? {
                    self.out.clear();
                    self.command(command)?;
                }
            }
            ["pass", millis] => {
                let millis = number(millis)?;
                let street = self.street()?;
                street.forget();
                street.pass(millis);
                self.tell_time();
            }
            ["cut", from, to] => self.street()?.cut(station(from)?, station(to)?),
            ["part", a, b] => self.street()?.part(station(a)?, station(b)?),
            ["heal"] => self.street()?.heal(),
            ["hang", robot] => self.street()?.hang(station(robot)?),
            ["reboot", robot] => self.street()?.reboot(station(robot)?),
            ["remove", robot] => self.street()?.remove(station(robot)?),
            ["show", ref robots @ ..] => {
                for robot in stations(robots)? {
                    let shown = show(self.street()?, robot);
                    self.out.push_str(&shown);
                }
            }
            ["keep", name, robot, "RAM"] => {
                let ram = self.street()?[station(robot)?].ram();
                let distance = NEAR;
                self.kept.insert(name, Input::Ram { ram, distance });
            }
            ["keep", name, robot, "RMCM"] => {
                let sent = self.street()?.last_rmcm(station(robot)?);
                let sent = sent.ok_or("it has sent none")?;
                self.kept.insert(name, Input::Rmcm(sent));
            }
            [robot, ref words @ ..] if station(robot).is_ok() => {
                self.robot(station(robot)?, words)?;
            }
            _ => return Err(format!("no such command; there are\n{HELP}")),
        }
        Ok(())
    }

    /// A command to one robot.
    fn robot(&mut self, who: StationId, words: &[&str]) -> Result<(), Wrong> {
        if let ["settings", values @ ..] = words {
            let mut settings = self.settings.clone();
            set(&mut settings, values)?;
            self.street()?.set(who, settings);
            return Ok(());
        }
        let input = match *words {
            ["wakes"] => None,
            ["elapses", millis] => Some(Input::Elapsed(Millis(number(millis)?))),
            ["expires", ref timer @ ..] => {
                Some(Input::Expired(named(Timer::SAMPLES, &timer.join(" "))?))
            }
            ["hears", "RAM", ref words @ ..] => Some(made_ram(words)?),
            ["hears", "RMCM", ref words @ ..] => Some(Input::Rmcm(made_rmcm(words)?)),
            ["hears", name] => {
                let kept = self.kept.get(name).copied();
                Some(kept.ok_or_else(|| wrong(name, "a message that was kept"))?)
            }
            ref words => Some(Input::Local(event(self.street()?, who, words)?)),
        };
        let street = self.street()?;
        street.forget();
        match input {
            Some(input) => street.step(who, input),
            None => street.go_on(who),
        };
        self.tell();
        Ok(())
    }

    /// What the steps of the last command put out. Only the input itself is told to be ignored, not what comes of it.
    fn tell(&mut self) {
        let trace = self.street.as_mut().map(|it| std::mem::take(&mut it.trace));
        for (i, step) in trace.into_iter().flatten().enumerate() {
            for output in &step.outputs {
                if i == 0 || !matches!(output, Output::Ignored(_)) {
                    let _ = writeln!(self.out, "  {:>5} {}", step.now, said(&step, output));
                }
            }
        }
    }

    /// What came of time that has passed: each output but the routine ones, which are counted. Routine is a RAM that is
    /// due and says nothing new, and a go that is prolonged.
    fn tell_time(&mut self) {
        let Some(street) = &mut self.street else {
            return;
        };
        let ended = street.ended_signs();
        let mut told: Vec<_> = ended
            .into_iter()
            .map(|(who, at)| (at, format!("{}: its sign ends by itself", name(who))))
            .collect();
        let mut routine = BTreeMap::<StationId, (u32, u32)>::new();
        for step in std::mem::take(&mut street.trace) {
            let is_routine = |output: &Output| {
                matches!(
                    output,
                    Output::SendRam | Output::CorridorExtended(_) | Output::Ignored(_)
                )
            };
            let all_routine = step.outputs.iter().all(is_routine);
            for output in &step.outputs {
                let (ram, prolonged) = routine.entry(step.who).or_default();
                match output {
                    Output::SendRam if all_routine => *ram += 1,
                    Output::CorridorExtended(_) => *prolonged += 1,
                    Output::Ignored(_) => {}
                    output => told.push((step.now, said(&step, output))),
                }
            }
        }
        told.sort_by_key(|(at, _)| *at);
        for (at, what) in told {
            let _ = writeln!(self.out, "  {at:>5} {what}");
        }
        for (who, (ram, prolonged)) in routine {
            if ram > 0 {
                let _ = write!(self.out, "  {}: {ram} more RAM", name(who));
                if prolonged > 0 {
                    let _ = write!(self.out, ", go prolonged {prolonged} times");
                }
                self.out.push('\n');
            }
        }
    }
}

/// Two teams at one place that do not hear each other: `ARI` with `GO2` and `SPOT` with `NAO`, each with an open corridor.
fn two_teams(values: &[&str]) -> Result<Street, Wrong> {
    let mut requests = BTreeMap::from([(ARI, escort(1)), (SPOT, escort(1))]);
    if let [who, values @ ..] = values {
        let request = requests.get_mut(&station(who)?);
        request_of(request.ok_or_else(|| wrong(who, "ARI or SPOT"))?, values)?;
    }
    let mut street = Street::new(&[ARI, GO2, SPOT, NAO]);
    for a in [ARI, GO2] {
        for b in [SPOT, NAO] {
            street.part(a, b);
        }
    }
    for (leader, request) in requests {
        street.tell(leader, Event::PedestrianDetected(request));
    }
    street.pass(400);
    for (leader, guard) in [(ARI, GO2), (SPOT, NAO)] {
        street.tell(leader, order(guard, TaskType::MOVE));
        street.tell(leader, Event::OpenCorridor);
    }
    street.pass(1_000);
    Ok(street)
}

/// Every file of scripts says what the robots do. Its difference is printed, or the file is written anew.
#[test]
fn robots_do_what_the_scripts_say() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/scripts");
    let (mut differ, mut files) = (Vec::new(), 0);
    for file in std::fs::read_dir(folder).unwrap() {
        let path = file.unwrap().path();
        if path.extension().is_none_or(|it| it != "txt") {
            continue;
        }
        files += 1;
        let text = std::fs::read_to_string(&path).unwrap();
        let file = path.file_name().unwrap().to_string_lossy().into_owned();
        let ran = std::panic::catch_unwind(|| run(&text));
        let Ok(told) = ran else {
            differ.push(format!("{file}: could not be run, see above"));
            continue;
        };
        if told == text {
            continue;
        }
        if std::env::var_os("CROSSGUARD_BLESS").is_some() {
            std::fs::write(&path, &told).unwrap();
            continue;
        }
        let mut script = "";
        let lines = text.lines().zip(told.lines());
        let first = lines
            .inspect(|(line, _)| script = line.strip_prefix("== ").unwrap_or(script))
            .find(|(expected, found)| expected != found);
        let (expected, found) = first.unwrap_or(("the end", "more lines"));
        differ.push(format!(
            "{file}, {script}:\n  expected {expected}\n  found    {found}"
        ));
    }
    assert!(files > 20, "{files} files");
    assert!(differ.is_empty(), "{}", differ.join("\n"));
}
