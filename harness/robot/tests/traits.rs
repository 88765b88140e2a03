//! The RAM of a robot has its traits from a robot file and an operator: category, job, size and battery. A low
//! battery keeps it from taking part.

use crossguard_codec::core::ram::RAM;
use crossguard_codec::{
    Battery, ControlMode, Identifiers, JobRole, MapPlace, RobotCategory, RobotState, Service,
    decode, state_of,
};
use crossguard_endpoint::{Effect, Endpoint, Moment, Stimulus};
use crossguard_protocol::{Availability, Config, Event, Robot, StationId, Unavailability};
use crossguard_robot::application::Application;
use crossguard_robot::machine::Machine;
use crossguard_robot::robot_file::RobotFile;
use crossguard_robot::runtime::Order;

fn read(more: &str) -> Result<RobotFile, String> {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("robot.toml");
    let text = format!(
        "name = \"R\"\nstation = 1\nboot_file = \"r.boot\"\n{more}\n[link]\naddress = \"127.0.0.1:1\"\n"
    );
    std::fs::write(&path, text).unwrap();
    RobotFile::read(&path).map_err(|error| error.to_string())
}

struct Said {
    machine: Machine,
    now_ms: u64,
}

impl Said {
    fn by(file: &RobotFile) -> Self {
        let robot = Robot::new(file.station, 1);
        let endpoint = Endpoint::new(robot, Config::default(), Identifiers::default(), 0);
        let application = Application::new(Box::new(file.body(1)), file.plan()).at(file.site);
        let machine = Machine::new(endpoint, application.with_traits(file.traits));
        Self { machine, now_ms: 0 }
    }

    /// The last RAM of the next 1.1 seconds, in which this happens.
    fn next(&mut self, stimulus: Stimulus<'_>) -> RobotState {
        let mut last = None;
        let mut stimulus = Some(stimulus);
        for _ in 0..22 {
            self.now_ms += 50;
            let moment = Moment::after(694_694_401_000, self.now_ms);
            #[expect(clippy::cast_precision_loss, reason = "a few seconds")]
            let now_s = self.now_ms as f64 / 1e3;
            let stimulus = stimulus.take().unwrap_or(Stimulus::Time);
            for effect in self.machine.handle(moment, now_s, stimulus) {
                if let Effect::Transmit {
                    kind: Service::Ram,
                    octets,
                    ..
                } = effect
                {
                    last = Some(decode::<RAM>(&Identifiers::default(), &octets).unwrap());
                }
            }
        }
        state_of(&last.expect("no RAM within a second").message)
    }

    fn availability(&self) -> Availability {
        self.machine.endpoint.robot().availability()
    }
}

#[test]
fn every_category_job_size_and_battery_of_a_file_is_in_its_ram() {
    use {JobRole as Job, RobotCategory as Build};
    for (job, job_role, build, category) in [
        ("none", Job::None, "unknown", Build::Unknown),
        (
            "traffic-guard",
            Job::TrafficGuard,
            "humanoid",
            Build::Humanoid,
        ),
        ("escort", Job::Escort, "quadruped", Build::Quadruped),
        ("patrol", Job::Patrol, "wheeled", Build::Wheeled),
        ("delivery", Job::Delivery, "tracked", Build::Tracked),
        ("maintenance", Job::Maintenance, "aerial", Build::Aerial),
        ("other", Job::Other, "other", Build::Other),
    ] {
        let text = format!(
            "build = \"{build}\"\njob = \"{job}\"\ndimensions_m = [0.9, 0.6, 1.2]\n\
             battery = {{ charge_percent = 64.0, charging = true }}"
        );
        let state = Said::by(&read(&text).unwrap()).next(Stimulus::Time);
        assert_eq!((state.job_role, state.category), (job_role, category));
        let size = state.dimensions;
        let size = [size.length, size.width, size.height];
        assert_eq!(size, [Some(0.9), Some(0.6), Some(1.2)]);
        let battery = Battery {
            state_of_charge: Some(64.0),
            charging: true,
        };
        assert_eq!(state.battery, battery);
    }
    let plain = Said::by(&read("build = \"humanoid\"").unwrap()).next(Stimulus::Time);
    assert_eq!(plain.job_role, JobRole::TrafficGuard);
    assert_eq!(plain.battery.state_of_charge, Some(80.0));
    assert_eq!(plain.dimensions.height, Some(1.7), "1.65 m in decimetres");
}

#[test]
fn the_area_that_a_robot_serves_is_in_its_ram_and_can_be_changed_like_its_job() {
    let area = |state: &RobotState| state.slow.as_ref().and_then(|slow| slow.area);
    let (region, id) = (Some(276), 12);
    let segment = MapPlace::RoadSegment { region, id };
    let intersection = MapPlace::Intersection { region, id };
    for (file, expected) in [
        ("map_place = \"segment 276:12\"", Some(segment)),
        ("crossing = \"276:12\"", Some(intersection)),
        ("", None),
    ] {
        let text = format!("build = \"humanoid\"\n{file}");
        let state = Said::by(&read(&text).unwrap()).next(Stimulus::Time);
        assert_eq!(area(&state), expected, "{file}");
    }
    let mut said = Said::by(&read("build = \"humanoid\"\njob = \"escort\"").unwrap());
    assert_eq!(said.next(Stimulus::Time).job_role, JobRole::Escort);
    let application = &mut said.machine.application;
    application.obey(Order::Serve(Some(segment)));
    application.obey(Order::Job(JobRole::Patrol));
    let state = said.next(Stimulus::Time);
    assert_eq!(
        (area(&state), state.job_role),
        (Some(segment), JobRole::Patrol)
    );
    said.machine.application.obey(Order::Serve(None));
    assert_eq!(area(&said.next(Stimulus::Time)), None);
}

#[test]
fn a_low_battery_keeps_a_robot_out_until_it_is_charged() {
    let file = read("build = \"quadruped\"\nbattery = { low_percent = 20 }").unwrap();
    let mut said = Said::by(&file);
    let charge = |said: &mut Said, percent: f64| {
        let battery = Battery {
            state_of_charge: Some(percent),
            charging: true,
        };
        said.machine.application.obey(Order::Battery(battery));
        let state = said.next(Stimulus::Time);
        assert_eq!(state.battery.state_of_charge, Some(percent));
    };
    let low = Availability::Unavailable(Unavailability::LowBattery);
    charge(&mut said, 21.0);
    assert_eq!(said.availability(), Availability::Available);
    charge(&mut said, 19.0);
    assert_eq!(said.availability(), low);
    charge(&mut said, 24.0);
    assert_eq!(said.availability(), low, "not at the limit itself");
    charge(&mut said, 25.0);
    assert_eq!(said.availability(), Availability::Available);
    // Another reason stands, whatever the battery is like.
    let stop = Availability::Unavailable(Unavailability::EmergencyStop);
    let state = said.next(Stimulus::Event(Event::AvailabilityChanged(stop)));
    assert_eq!(state.control_mode, ControlMode::EmergencyStop);
    charge(&mut said, 5.0);
    charge(&mut said, 90.0);
    assert_eq!(said.availability(), stop);
    let back = Event::AvailabilityChanged(Availability::Available);
    let state = said.next(Stimulus::Event(back));
    assert_eq!(state.control_mode, ControlMode::Autonomous);
    assert_eq!(said.machine.endpoint.robot().station(), StationId(1));
}

/// Hazard: a charger or driver falls silent, the robot tells of 80 % for hours, and stops on the road.
#[test]
fn a_battery_that_falls_silent_counts_as_low_where_the_file_wants_to_hear_of_it() {
    let full = Battery {
        state_of_charge: Some(80.0),
        charging: false,
    };
    let low = Availability::Unavailable(Unavailability::LowBattery);
    for (battery, expected) in [
        ("silence_s = 5", (low, None)),
        ("", (Availability::Available, Some(80.0))),
    ] {
        let file = read(&format!("build = \"quadruped\"\nbattery = {{ {battery} }}"));
        let mut said = Said::by(&file.unwrap());
        // Once at first, which is as good as a word, and once by a word.
        for _ in 0..2 {
            for turn in 0..4 {
                said.next(Stimulus::Time);
                assert_eq!(said.availability(), Availability::Available, "{turn}");
            }
            said.next(Stimulus::Time);
            let charge = said.next(Stimulus::Time).battery.state_of_charge;
            assert_eq!((said.availability(), charge), expected);
            said.machine.application.obey(Order::Battery(full));
            let charge = said.next(Stimulus::Time).battery.state_of_charge;
            assert_eq!(
                (said.availability(), charge),
                (Availability::Available, Some(80.0))
            );
            said.machine.application.obey(Order::Battery(full));
        }
    }
}

#[test]
fn what_no_robot_is_like_is_refused_by_the_name_of_its_field() {
    for row in [
        "job = 'cook' => unknown variant `cook`",
        "dimensions_m = [1, 0, 1] => dimensions_m has 0: length, width and height in metres",
        "battery = { charge_percent = 120 } => [battery] charge_percent is 120: 0 to 100 is wanted",
        "battery = { charging = true } => [battery] 'charging' wants 'charge_percent', too",
        "battery = { low_percent = -1 } => [battery] low_percent is -1",
        "battery = { silence_s = 0 } => [battery] silence_s is 0: 1 to 86400 s is wanted",
    ] {
        let (text, cause) = row.split_once(" => ").unwrap();
        let error = read(&format!("build = 'other'\n{text}")).unwrap_err();
        assert!(error.contains(cause), "{text}: {error}");
    }
    let error = read("build = 'car'").unwrap_err();
    assert!(error.contains("unknown variant `car`"), "{error}");
}
