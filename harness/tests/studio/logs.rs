//! Logs to look at.

use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};

use crossguard_endpoint::ras::clustering::VruClass;
use crossguard_judge::facts::{Fact, Observer};
use crossguard_judge::sim::{Swarm, run as simulate};
use crossguard_robot::sight::{Seen, Sight};
use crossguard_robot::trace::{self, Entry, Record};
use crossguard_robot::zone::Conduct;

/// The records of four simulated robots; the first has thirty people around it.
pub(crate) fn crowd() -> Vec<Record> {
    let swarm = (1..200).map(|seed| Swarm::draw(seed, 4, None));
    let swarm = swarm.into_iter().find(|it| it.robots.len() == 4).unwrap();
    let mut records: Vec<Record> = Vec::new();
    let mut watch = |record: Record| records.push(record);
    assert_eq!(simulate(&swarm, Some(&mut watch)).finding, None);
    let (mut observer, mut with_people) = (Observer::default(), Vec::new());
    let conducts = [
        Conduct::Waiting,
        Conduct::Passing,
        Conduct::OnRoad,
        Conduct::Across,
        Conduct::Elsewhere,
    ];
    for record in records {
        let places = observer
            .take(&record)
            .into_iter()
            .find_map(|fact| match fact {
                Fact::Place(placed) => Some((placed.latitude, placed.longitude)),
                _ => None,
            });
        let (at_us, robot) = (record.at_us, record.robot.clone());
        let is_first = robot == swarm.robots[0].name;
        with_people.push(record);
        if let Some((latitude, longitude)) = places.filter(|_| is_first) {
            let person = |number: u8| Seen {
                place: (
                    latitude + f64::from(number % 6) * 7e-6,
                    longitude + f64::from(number / 6) * 1.1e-5,
                ),
                class: VruClass::Pedestrian,
                conduct: conducts[usize::from(number) % conducts.len()],
            };
            let people = (0..30).map(person).collect();
            with_people.push(Record {
                at_us,
                robot,
                entry: Entry::People(Sight { people }),
            });
        }
    }
    with_people
}

pub(crate) fn write(records: &[Record], folder: &Path, name: &str) -> PathBuf {
    let path = folder.join(name);
    let mut file = BufWriter::new(File::create(&path).unwrap());
    for record in records {
        trace::write(&mut file, record).unwrap();
    }
    file.flush().unwrap();
    path
}
