//! A street of 7 m that runs from west to east, with pavements of 2.5 m, and a machine that watches it.

use crossguard_crossing::*;
use crossguard_protocol::{
    Event, Maneuver, ManeuverId, Millis, RequestId, SessionId, SessionNumber, StationId, TaskType,
    UniqueNumber, Urgency,
};

/// A station that reports people.
pub(crate) const WITNESS: StationId = StationId(9);

/// A rectangle, in centimetres.
pub(crate) fn rectangle(west: i32, south: i32, east: i32, north: i32) -> Option<Shape> {
    let corners = [(west, south), (east, south), (east, north), (west, north)];
    Shape::new(&corners.map(|(east, north)| Point::new(east, north)))
}

/// The street: people wait within 3 m to the west and 5 m to the east, and the carriageway is known for 30 m either way.
pub(crate) fn street() -> Setup {
    Setup {
        watches: true,
        calls: true,
        ground: Ground {
            road: rectangle(-3_000, 0, 3_000, 700),
            crossing: rectangle(-300, 0, 500, 700),
            waiting: rectangle(-300, -250, 500, 950),
            parts: Coverage(0b11),
        },
        ..Setup::default()
    }
}

/// A person who stands, as a source with good sensors has them.
pub(crate) fn person(id: u32, east: i32, north: i32) -> Sighting {
    Sighting {
        id: Some(id),
        at: Point::new(east, north),
        error_cm: 0,
        velocity: Some(Way::default()),
        what: RoadUser::Pedestrian,
        confidence: 100,
    }
}

/// The same person, who walks at so many cm/s.
pub(crate) fn walking(sighting: Sighting, east_cm: i32, north_cm: i32) -> Sighting {
    let velocity = Some(Way { east_cm, north_cm });
    Sighting {
        velocity,
        ..sighting
    }
}

/// A maneuver that robot 1 commands, by the number of its command.
pub(crate) fn maneuver(task: TaskType, request: u8) -> Maneuver {
    let number = SessionNumber(UniqueNumber { boot: 1, count: 0 });
    let leader = StationId(1);
    let session = SessionId { leader, number };
    let id = ManeuverId::of(session, RequestId(request));
    Maneuver { id, task }
}

/// A machine that watches, in virtual time.
pub(crate) struct Scene {
    pub(crate) setup: Setup,
    pub(crate) crossing: Crossing,
    /// Everything that it has put out.
    pub(crate) out: Vec<Output>,
}

impl Scene {
    pub(crate) fn new(setup: Setup) -> Self {
        Self {
            setup,
            crossing: Crossing::default(),
            out: Vec::new(),
        }
    }

    pub(crate) fn tell(&mut self, input: Input<'_>) -> Vec<Output> {
        let out: Vec<Output> = self
            .crossing
            .step(&self.setup, input)
            .iter()
            .copied()
            .collect();
        self.out.extend(&out);
        out
    }

    pub(crate) fn pass(&mut self, ms: u32) {
        self.tell(Input::Elapsed(Millis(ms)));
    }

    /// The body is there, by a position that was measured so long ago.
    pub(crate) fn is_at(&mut self, east: i32, north: i32, age: u32) -> Vec<Output> {
        let (at, error_cm) = (Point::new(east, north), 0);
        self.tell(Input::Pose(Some(Pose { at, error_cm }), Millis(age)))
    }

    /// A frame of a source that looked so long ago.
    pub(crate) fn frame(
        &mut self,
        source: u8,
        age: u32,
        covers: u32,
        people: &[Sighting],
    ) -> Vec<Output> {
        self.tell(Input::Frame(Frame {
            source,
            age: Millis(age),
            covers: Coverage(covers),
            sightings: people,
        }))
    }

    /// Time passes, and a source that covers everything has looked just now.
    pub(crate) fn look(&mut self, ms: u32, people: &[Sighting]) -> Vec<Output> {
        self.pass(ms);
        self.frame(0, 0, 0b11, people)
    }

    /// A person goes on for some time, with this interval between frames. The urgency after each.
    pub(crate) fn sees_at(
        &mut self,
        who: &mut Sighting,
        ms: u32,
        interval: u32,
        tells_velocity: bool,
    ) -> Vec<Option<Urgency>> {
        let mut urgencies = Vec::new();
        for _ in 0..ms.div_ceil(interval) {
            let told = Sighting {
                velocity: who.velocity.filter(|_| tells_velocity),
                ..*who
            };
            self.look(interval, &[told]);
            urgencies.push(self.crossing.tracks().urgency());
            let way = who.velocity.unwrap_or_default();
            let interval = i32::try_from(interval).unwrap();
            who.at = who.at.plus(way.part(interval, 1_000));
        }
        urgencies
    }

    /// The same ten times in a second. The highest urgency meanwhile.
    pub(crate) fn sees(&mut self, who: &mut Sighting, ms: u32) -> Option<Urgency> {
        self.sees_at(who, ms, 100, true).into_iter().max().flatten()
    }

    /// The conduct of the people that it knows of.
    pub(crate) fn conducts(&self) -> Vec<tracks::Conduct> {
        let tracks = self.crossing.tracks().iter();
        tracks.map(|track| track.conduct(&self.setup)).collect()
    }

    pub(crate) fn is_clear(&self) -> bool {
        self.crossing.is_clear(&self.setup)
    }

    /// How often it has told this.
    pub(crate) fn told(&self, is: impl Fn(&Event) -> bool) -> usize {
        let mut count = 0;
        for output in &self.out {
            if let Output::Tell(event) = output {
                count += usize::from(is(event));
            }
        }
        count
    }
}
