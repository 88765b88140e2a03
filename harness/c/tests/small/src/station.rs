//! One robot with its application: it leads a crossing, or follows one. The body is a stand-in that takes a second for
//! every maneuver.

use crossguard::{
    CROSSGUARD_ABI_VERSION, CROSSGUARD_LOG_LEN, CROSSGUARD_PACKETS_LEN, CrossguardConfig,
    CrossguardEvent, CrossguardEventKind as Kind, CrossguardNotice as Notice, CrossguardOutput,
    CrossguardOutputKind as Does, CrossguardProgress as Progress, CrossguardRobot,
    CrossguardStatus, CrossguardTask as Task, CrossguardTurn, CrossguardView,
};
use crossguard_codec::si::timestamp_its;

/// Where the site of the kit's demonstrations is, in degrees.
const LATITUDE: f64 = 49.0101;
const LONGITUDE: f64 = 8.4124;
/// How long the body takes for a maneuver that goes to a place.
const MANEUVER_MS: u64 = 1_000;
/// How long it takes beside somebody who crosses: it must not be done before they are.
const ESCORT_MS: u64 = 15_000;
/// After so many heartbeats beside an open corridor the pedestrian of this program is across.
const CROSSING: u32 = 20;
/// How often a robot without a session says that it is there.
const ANNOUNCE_MS: u64 = 1_000;
/// The longest time for which a robot is not told the time.
const TELL_MS: u32 = 50;

/// The kinds of calls.
#[derive(Clone, Copy)]
pub(crate) enum Call {
    Init,
    Elapse,
    Tell,
    Receive,
    Announce,
    View,
}

impl Call {
    pub(crate) const NAMES: [&str; 6] = ["init", "elapse", "tell", "receive", "announce", "view"];
}

/// What is around a station.
pub(crate) trait Outside {
    /// A packet of the station goes out.
    fn send(&mut self, packet: &[u8]);
    /// Lines of its log.
    fn log(&mut self, lines: &[u8]);
    /// Does a call; one may measure it.
    fn call(&mut self, kind: Call, call: &mut dyn FnMut() -> CrossguardStatus) {
        let _ = kind;
        check(call());
    }
}

/// Gives up where a call did not do what it is for.
pub(crate) fn check(status: CrossguardStatus) {
    if status != CrossguardStatus::Ok {
        crate::give_up(format_args!("{status:?}"));
    }
}

/// Who a station is, and what time it was when its clock showed 0.
#[derive(Clone, Copy)]
pub(crate) struct Mission {
    pub(crate) leads: bool,
    pub(crate) station: u32,
    pub(crate) boot: u16,
    pub(crate) unix_ms: u64,
}

/// Its memory. Zeros are a value of it.
pub(crate) struct Station {
    robot: CrossguardRobot,
    turn: CrossguardTurn,
    view: CrossguardView,
    event: CrossguardEvent,
    app: Application,
}

/// Where the packets and lines of a station's calls go. Only the library and `carry_out` look at it.
pub(crate) struct Room {
    packets: [u8; CROSSGUARD_PACKETS_LEN],
    lines: [u8; CROSSGUARD_LOG_LEN],
}

/// What the application knows.
struct Application {
    leads: bool,
    unix_ms: u64,
    told_ms: u64,
    announced_ms: u64,
    running: Option<(CrossguardOutput, u64)>,
    asked: bool,
    opened: bool,
    extended: u32,
    had_part: bool,
    is_over: bool,
}

impl Station {
    /// Starts it, at 0 ms of its clock. Nothing else may use `room` from then on.
    pub(crate) fn start(
        &mut self,
        mission: Mission,
        (room, logs): (*mut Room, bool),
        outside: &mut impl Outside,
    ) {
        self.app = Application {
            leads: mission.leads,
            unix_ms: mission.unix_ms,
            told_ms: 0,
            announced_ms: 0,
            running: None,
            asked: false,
            opened: false,
            extended: 0,
            had_part: false,
            is_over: false,
        };
        let Self { robot, turn, .. } = self;
        let mut config = CrossguardConfig::default();
        // SAFETY: in all calls, the memory is this station's, of its types, and of the lengths that are said.
        check(unsafe { crossguard::crossguard_config_init(&raw mut config) });
        (config.station, config.boot) = (mission.station, mission.boot);
        for (place, letter) in config.name.iter_mut().zip(*b"small") {
            *place = letter as _;
        }
        outside.call(Call::Init, &mut || unsafe {
            let length = size_of::<CrossguardRobot>();
            crossguard::crossguard_robot_init(
                robot,
                length,
                CROSSGUARD_ABI_VERSION,
                &raw const config,
            )
        });
        check(unsafe {
            let lines = (&raw mut (*room).lines).cast();
            let lines = if logs { lines } else { core::ptr::null_mut() };
            let packets = (&raw mut (*room).packets).cast();
            let lines_length = if logs { CROSSGUARD_LOG_LEN } else { 0 };
            crossguard::crossguard_turn_init(
                turn,
                packets,
                CROSSGUARD_PACKETS_LEN,
                lines,
                lines_length,
            )
        });
        self.turn.body.latitude_deg = LATITUDE;
        self.turn.body.longitude_deg = LONGITUDE;
        self.turn.body.accuracy_m = 0.2;
        self.at(0);
        if logs {
            let Self { robot, turn, .. } = self;
            check(unsafe { crossguard::crossguard_log_start(robot, mission.unix_ms, turn) });
            self.carry_out(0, outside);
        }
        self.announce(0, outside);
    }

    /// Whether its crossing is over.
    pub(crate) fn is_over(&self) -> bool {
        self.app.is_over
    }

    /// Ends its log.
    pub(crate) fn stop(&mut self, outside: &mut impl Outside) {
        let Self { robot, turn, .. } = self;
        check(unsafe { crossguard::crossguard_log_stop(robot, turn) });
        self.carry_out(self.app.told_ms, outside);
    }

    /// A packet has arrived.
    pub(crate) fn receive(&mut self, now_ms: u64, packet: &[u8], outside: &mut impl Outside) {
        self.pass(now_ms, outside);
        let Self { robot, turn, .. } = self;
        turn.waited_ms = 0;
        outside.call(Call::Receive, &mut || unsafe {
            crossguard::crossguard_receive(robot, packet.as_ptr(), packet.len(), turn)
        });
        self.carry_out(now_ms, outside);
    }

    /// Does what is due. It is to be called every few milliseconds.
    pub(crate) fn live(&mut self, now_ms: u64, outside: &mut impl Outside) {
        self.look(outside);
        let passed_ms = now_ms - self.app.told_ms;
        if passed_ms < u64::from(self.view.next_due_ms.min(TELL_MS)) {
            return;
        }
        self.pass(now_ms, outside);
        self.look(outside);
        if self.view.has_session == 0 && now_ms - self.app.announced_ms >= ANNOUNCE_MS {
            self.announce(now_ms, outside);
        }
        if self.app.leads {
            self.lead(now_ms, outside);
        } else {
            self.follow(now_ms, outside);
        }
    }

    /// Tells the robot that time has passed.
    fn pass(&mut self, now_ms: u64, outside: &mut impl Outside) {
        let passed_ms = u32::try_from(now_ms - self.app.told_ms).unwrap_or(u32::MAX);
        self.app.told_ms = now_ms;
        self.at(now_ms);
        if passed_ms > 0 {
            let Self { robot, turn, .. } = self;
            outside.call(Call::Elapse, &mut || unsafe {
                crossguard::crossguard_elapse(robot, passed_ms, turn)
            });
            self.carry_out(now_ms, outside);
        }
    }

    fn at(&mut self, now_ms: u64) {
        let unix_ms = self.app.unix_ms + now_ms;
        self.turn.timestamp_its = timestamp_its(i64::try_from(unix_ms).unwrap_or(i64::MAX));
        self.turn.log_at_us = now_ms * 1_000;
    }

    fn announce(&mut self, now_ms: u64, outside: &mut impl Outside) {
        self.app.announced_ms = now_ms;
        let Self { robot, turn, .. } = self;
        outside.call(Call::Announce, &mut || unsafe {
            crossguard::crossguard_announce(robot, turn)
        });
        self.carry_out(now_ms, outside);
    }

    fn look(&mut self, outside: &mut impl Outside) {
        let Self { robot, view, .. } = self;
        outside.call(Call::View, &mut || unsafe {
            crossguard::crossguard_view(robot, view)
        });
    }

    fn tell(
        &mut self,
        now_ms: u64,
        kind: Kind,
        outside: &mut impl Outside,
        more: impl Fn(&mut CrossguardEvent),
    ) {
        check(unsafe { crossguard::crossguard_event_init(&raw mut self.event, kind as u8) });
        more(&mut self.event);
        let Self {
            robot, turn, event, ..
        } = self;
        outside.call(Call::Tell, &mut || unsafe {
            crossguard::crossguard_tell(robot, event, turn)
        });
        self.carry_out(now_ms, outside);
    }

    /// The application of a leader, by what it sees.
    fn lead(&mut self, now_ms: u64, outside: &mut impl Outside) {
        if !self.app.asked && now_ms >= 2 * ANNOUNCE_MS {
            self.app.asked = true;
            return self.tell(now_ms, Kind::PedestrianDetected, outside, |event| {
                event.followers = 1;
                event.tasks = 1 << Task::InitialPos as u16 | 1 << Task::Block as u16;
            });
        }
        if self.view.followers_length == 0 {
            return;
        }
        let follower = self.view.followers[0];
        let is_free = follower.has_joined == 1 && follower.is_outstanding == 0;
        let progress = follower.progress;
        if is_free && progress == Progress::None as u8 {
            self.command(now_ms, follower.station, Task::InitialPos, outside);
        } else if is_free && progress == Progress::Completed as u8 {
            self.command(now_ms, follower.station, Task::Block, outside);
        } else if progress == Progress::InPosition as u8 && !self.app.opened {
            self.tell(now_ms, Kind::OpenCorridor, outside, |_| ());
        } else if self.app.extended >= CROSSING {
            self.app.extended = 0;
            self.tell(now_ms, Kind::TaskCompleted, outside, |_| ());
        }
    }

    fn command(&mut self, now_ms: u64, station: u32, task: Task, outside: &mut impl Outside) {
        self.tell(now_ms, Kind::CommandManeuver, outside, |event| {
            (event.station, event.task) = (station, task as u8);
            // Some two metres away.
            event.parameters.latitude_deg = LATITUDE + 0.000_02;
            event.parameters.longitude_deg = LONGITUDE;
            event.parameters.maximum_speed_mps = 1.4;
        });
    }

    /// The application and the body of a follower.
    fn follow(&mut self, now_ms: u64, outside: &mut impl Outside) {
        self.app.had_part |= self.view.has_session == 1;
        self.app.is_over = self.app.had_part && self.view.has_session == 0;
        let Some((maneuver, due_ms)) = self.app.running else {
            return;
        };
        if now_ms < due_ms {
            return;
        }
        self.app.running = None;
        if !maneuver.parameters.latitude_deg.is_nan() {
            self.turn.body.latitude_deg = maneuver.parameters.latitude_deg;
            self.turn.body.longitude_deg = maneuver.parameters.longitude_deg;
        }
        let kind = if maneuver.task == Task::Block as u8 {
            Kind::InPosition
        } else {
            Kind::ManeuverCompleted
        };
        self.tell(now_ms, kind, outside, |event| {
            (event.session, event.request) = (maneuver.session, maneuver.request);
        });
    }

    /// Does what the robot put out in its last call, in order.
    fn carry_out(&mut self, now_ms: u64, outside: &mut impl Outside) {
        // SAFETY: the library has written so many octets there, and writes again in the next call.
        let packets =
            unsafe { core::slice::from_raw_parts(self.turn.packets, self.turn.packets_length) };
        for output in &self.turn.outputs[..self.turn.outputs_length as usize] {
            let is = |kind: Does| output.kind == kind as u8;
            if is(Does::Send) {
                let begin = output.packet_offset as usize;
                outside.send(&packets[begin..begin + output.packet_length as usize]);
            } else if is(Does::StartManeuver) {
                let is_escort = output.task == Task::Move as u8;
                let takes_ms = if is_escort { ESCORT_MS } else { MANEUVER_MS };
                self.app.running = Some((*output, now_ms + takes_ms));
            } else if is(Does::StopManeuver) || is(Does::FallBack) {
                self.app.running = None;
            } else if is(Does::CorridorOpened) {
                self.app.opened = true;
            } else if is(Does::CorridorExtended) {
                self.app.extended += 1;
            } else if is(Does::Notice) && output.notice == Notice::SessionEnded as u8 {
                self.app.is_over = true;
            }
        }
        if self.turn.log_length > 0 {
            let lines = self.turn.log.cast();
            // SAFETY: as above.
            outside.log(unsafe { core::slice::from_raw_parts(lines, self.turn.log_length) });
        }
        self.turn.log_length = 0;
        self.turn.outputs_length = 0;
    }
}
