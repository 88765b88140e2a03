//! One robot as a running program: its endpoint, link and application in one loop.
//!
//! ```text
//!   socket ──► reader thread ──► inbox ──┐               ┌──► link     (never waits for a receiver)
//!   orders ──────────────────────────────┼──► Machine ───┤
//!   clock  ── when something is due ─────┘               └──► journal  (never waits for a reader)
//! ```
//!
//! 1. The loop waits for the inbox, at most until the machine or the body has something to do.
//! 2. Inputs are handed to the [`Machine`] with the time, in one turn; without any, the time alone.
//! 3. Effects are carried out in order: a packet is put into the [`Journal`] before it is sent, so that no
//!    receiver logs it before its sender.
//!
//! The loop owns the machine, the sending half of the link, and the journal; nothing is locked. It
//! waits for nobody but the clock: a link that does not take a packet, and a reader that does not take
//! a record, lose it, and that is counted. The inbox takes a limited number of datagrams and drops the
//! newest; robots in the same session have more places in it, and orders places of their own, so that a flood does not
//! shut out a heartbeat or keep a robot from stopping.
//!
//! A robot that is told to stop leaves its session by name, says so for `T_farewell`, and then ends.

mod clock;
mod keeper;
mod partners;
mod reader;
mod revoked;
mod running;
mod sampler;

use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver as Inbox, RecvTimeoutError, sync_channel};
use std::time::{Duration, SystemTime};

use crossguard_codec::Identifiers;
use crossguard_endpoint::cause::Cause;
use crossguard_endpoint::ras::clustering::PerceivedVru;
use crossguard_endpoint::ras::surroundings::Awareness;
use crossguard_endpoint::station::Security;
use crossguard_endpoint::{Effect, Endpoint, Stimulus};
use crossguard_protocol::{
    Availability, Config, Event, Output, Phase, Robot, StationId, Unavailability,
};

pub use self::clock::Clock;
pub(crate) use self::clock::timestamp_now;
use self::clock::{moment_at, seconds};
use self::keeper::Keeper;
use self::reader::{Reader, Waiting};
pub use self::running::{Order, Orders, Panicked, Running};
use self::sampler::Sampler;
use crate::application::Application;
use crate::around::Around;
use crate::attachment::unix_us;
use crate::boot::Boot;
use crate::channel::Monitored;
use crate::clock::ClockState;
use crate::journal::Journal;
use crate::machine::Machine;
use crate::perception::{Newest, seen_from};
use crate::trace::{Entry, Record, recorded};
use crate::transport::{Arrival, Halves, Sender};

/// How many datagrams may wait.
const DATAGRAMS: usize = 256;

/// How many datagrams of robots in the same session may wait besides.
const OF_PARTNERS: usize = 64;

/// How many orders may wait besides, before who gives them has to.
const ORDERS: usize = 16;

/// How long the last record waits for a reader that is slow.
const LAST_RECORD_WAIT: Duration = Duration::from_secs(1);

/// How often the body moves at least.
const BODY_PERIOD: Duration = Duration::from_millis(5);

/// How often the log says who is around.
const AROUND_PERIOD_US: u64 = 1_000_000;

enum Delivery {
    Arrived(std::io::Result<Arrival>),
    Order(Order),
    Revoked(revoked::Read),
}

/// A robot that can be run.
pub struct Setup {
    /// Its name in logs.
    pub name: String,
    /// Its station id without security; with it, the id is that of its ticket.
    pub station: StationId,
    /// Its boot counter.
    pub boot: Boot,
    /// Its configuration.
    pub config: Config,
    /// Identifiers that no standard has assigned.
    pub identifiers: Identifiers,
    /// Whether it signs and verifies.
    pub security: Security,
    /// How it announces the people around it, and itself to stations that do not know RAM.
    pub awareness: Awareness,
    /// Moves the body, and leads.
    pub application: Application,
    /// Its link, open.
    pub link: Halves,
    /// Where its records go.
    pub journal: Journal,
    /// The clock.
    pub clock: Clock,
}

impl Setup {
    /// A robot of which nothing outlives the process and nobody reads the records, without security, with all settings by
    /// default and on a clock that begins now.
    #[must_use]
    pub fn new(name: &str, station: StationId, application: Application, link: Halves) -> Self {
        Self {
            name: name.to_owned(),
            station,
            boot: Boot::first_of_its_kind(),
            config: Config::default(),
            identifiers: Identifiers::default(),
            security: Security::default(),
            awareness: Awareness::default(),
            application,
            link,
            journal: Journal::new(),
            clock: Clock::start(),
        }
    }

    /// Starts the robot in threads of its own.
    ///
    /// A loop that panics halts the body after the program's panic hook has returned. The hook of the standard library
    /// writes to standard error: where that may be a pipe that nobody reads, set one that waits for nobody.
    #[must_use]
    pub fn start(mut self) -> Running {
        let (deliveries, inbox) = sync_channel(DATAGRAMS + OF_PARTNERS + ORDERS);
        let (places, places_taken) = sync_channel(ORDERS);
        let stop = Arc::new(AtomicBool::new(false));
        let waiting = Arc::new(Waiting::default());
        let reader = Reader {
            receiver: self.link.receiver,
            deliveries: deliveries.clone(),
            waiting: Arc::clone(&waiting),
            stop: Arc::clone(&stop),
        };
        // The log begins when the robot's clock does.
        let began_us = self.clock.now_us();
        let now_ms = began_us / 1_000;
        let memory = self.boot.take_memory();
        let security = self.security.with_secret(memory.secret);
        let security = security.since(memory.known);
        let station = security.station_id(&self.identifiers, self.station);
        let boot = self.boot.counter;
        let epoch = security.epoch(station, boot);
        let robot = Robot::new(station, epoch);
        let mut turn = Loop {
            began_us,
            machine: Machine::new(
                Endpoint::new(robot, self.config, self.identifiers, now_ms)
                    .with_security(security)
                    .with_awareness(self.awareness),
                self.application,
            ),
            name: self.name,
            sender: self.link.sender,
            journal: self.journal,
            ended_logs: 0,
            clock: self.clock,
            waiting: Arc::clone(&waiting),
            places_taken,
            boot,
            keeper: Keeper::start(self.boot, memory),
            clock_state: None,
            channel: Monitored::default(),
            newest: Newest::default(),
            around: (Around::default(), began_us),
            sampler: Sampler::default(),
            stopping: false,
            is_dead: false,
        };
        let stopped = Arc::clone(&stop);
        let threads = vec![
            std::thread::spawn(move || reader.run()),
            std::thread::spawn(move || {
                let ran = catch_unwind(AssertUnwindSafe(|| turn.run(&inbox)));
                if ran.is_err() {
                    turn.halt_body();
                }
                stopped.store(true, Ordering::Relaxed);
                if let Err(panic) = ran {
                    resume_unwind(panic);
                }
            }),
        ];
        Running {
            orders: Orders { deliveries, places },
            waiting,
            threads,
            stop,
        }
    }
}

struct Loop {
    /// When the robot's clock began.
    began_us: u64,
    machine: Machine,
    name: String,
    sender: Box<dyn Sender>,
    journal: Journal,
    /// How many logs have ended.
    ended_logs: usize,
    clock: Clock,
    waiting: Arc<Waiting>,
    /// One for each order that waits.
    places_taken: Inbox<()>,
    /// The boot counter that it started with.
    boot: u16,
    keeper: Keeper,
    /// State of the clock in the log.
    clock_state: Option<ClockState>,
    /// The radio channel, where the link measures it.
    channel: Monitored,
    /// People that its sensors have, for RAM.
    newest: Newest,
    /// Road users around in the log, and since when.
    around: (Around, u64),
    /// Drops that are more frequent than the log takes.
    sampler: Sampler,
    stopping: bool,
    is_dead: bool,
}

impl Loop {
    /// The loop has panicked: nothing that it decided can be relied on, and nobody will tell the body anything more.
    fn halt_body(&mut self) {
        let halt = || self.machine.application.stop();
        // A body that cannot be halted has panicked, and the panic is told on standard error.
        let _ = catch_unwind(AssertUnwindSafe(halt));
    }

    fn run(&mut self, inbox: &Inbox<Delivery>) {
        let since_us = self.clock.now_us().saturating_sub(self.began_us);
        let began_unix_us = unix_us(SystemTime::now()).saturating_sub(since_us);
        let started = self.record_at(
            self.began_us,
            Entry::Started {
                station: self.machine.endpoint.robot().station(),
                boot: self.boot,
                epoch: Some(self.machine.endpoint.robot().boot())
                    .filter(|epoch| *epoch != self.boot),
                settings: Box::new(self.machine.endpoint.config().settings().clone()),
                identifiers: *self.machine.endpoint.identifiers(),
                unix_ms: began_unix_us / 1_000,
                speed: Some(self.machine.application.time_scale()),
            },
        );
        self.put(started);
        if let Some(outline) = self.machine.application.zone() {
            self.log(Entry::Zone(outline));
        }
        while !self.is_done() {
            let delivery = inbox.recv_timeout(self.patience());
            if let Ok(Delivery::Order(_) | Delivery::Revoked(_)) = delivery {
                let _ = self.places_taken.try_recv();
            }
            match delivery {
                Ok(Delivery::Order(order)) => self.obey(order),
                Ok(Delivery::Revoked(list)) => self.revoke(list),
                Ok(Delivery::Arrived(arrival)) => {
                    self.waiting.datagrams.fetch_sub(1, Ordering::Relaxed);
                    self.take(arrival);
                }
                Err(RecvTimeoutError::Timeout) => self.handle(Stimulus::Time),
                // No sender is left that could order it to stop.
                Err(RecvTimeoutError::Disconnected) => self.begin_to_stop(),
            }
            if self.is_dead {
                return;
            }
            self.renew_epoch();
            self.keep_time();
            self.control_congestion();
        }
        if let Some(time) = self.machine.endpoint.trusted_time() {
            self.keeper.keep_last(time.mark());
        }
        self.count_overflow();
        if let Some(counters) = self.sampler.finish() {
            self.log(Entry::Unrecorded { counters });
        }
        let counters = self.machine.endpoint.counters().named();
        let last = self.record(Entry::Stopped { counters });
        self.journal.put_last(last, LAST_RECORD_WAIT);
    }

    /// How long the loop may wait for something to arrive.
    fn patience(&self) -> Duration {
        let now_us = self.clock.now_us();
        let due_us = self.machine.endpoint.next_wakeup_ms().saturating_mul(1_000);
        Duration::from_micros(due_us.saturating_sub(now_us)).min(BODY_PERIOD)
    }

    /// Takes in what comes from the reader, in one turn.
    fn take(&mut self, arrival: std::io::Result<Arrival>) {
        self.count_overflow();
        match arrival {
            Ok(Arrival::Datagram { octets, at, .. }) => {
                let arrived_ms = self.clock.at_ms(at);
                let packet = &octets;
                return self.handle(Stimulus::Datagram { packet, arrived_ms });
            }
            Ok(Arrival::Lost { how, octets }) => {
                let detail = "by the fault injector".to_owned();
                self.drop(Cause::Simulated(how), detail, octets);
            }
            Ok(Arrival::Channel(radio)) => {
                let now_ms = self.now_ms();
                self.channel.measure(radio, now_ms);
            }
            Ok(Arrival::Misframed {
                cause,
                detail,
                octets,
            }) => self.drop(Cause::Misframed(cause), detail, octets),
            // The reader counts it.
            Ok(Arrival::Overflow(_)) => {}
            Err(cause) => {
                self.drop(Cause::LinkFailed, cause.to_string(), Vec::new());
            }
        }
        self.handle(Stimulus::Time);
    }

    /// Counts what the reader and the socket had no place for.
    fn count_overflow(&mut self) {
        for _ in 0..self.waiting.dropped.swap(0, Ordering::Relaxed) {
            self.machine.miss(Cause::InboxFull);
        }
        let count = self.waiting.overflowed.swap(0, Ordering::Relaxed);
        if count > 0 {
            self.machine.application.miss(Cause::SocketFull);
            let detail = format!("the socket had no room for {count} datagrams");
            self.drop_many(Cause::SocketFull, detail, count);
        }
    }

    /// Carries out an order, in one turn.
    fn obey(&mut self, order: Order) {
        let seen: Vec<PerceivedVru>;
        let stimulus = match order {
            Order::Tell(Stimulus::Event(Event::TaskCompleted)) => {
                let counts = self.machine.application.say_completed();
                event(counts.then_some(Event::TaskCompleted))
            }
            Order::Tell(stimulus) => stimulus,
            Order::InPosition => event(self.machine.executing().map(Event::InPosition)),
            Order::OutOfPosition => event(self.machine.executing().map(Event::OutOfPosition)),
            Order::Clear => {
                // Where nothing waits for it, the robot says so.
                let is_awaited = self.machine.application.say_clear();
                event((!is_awaited).then_some(Event::RoadClear))
            }
            Order::Finish { well } => event(self.machine.finish(well)),
            Order::Perceived(vru) => {
                let place = self.machine.application.body().place();
                let station = self.machine.endpoint.robot().station();
                let application = &mut self.machine.application;
                application.perceive(station, &vru);
                seen = vec![seen_from(place, vru)];
                Stimulus::Perceived(&seen)
            }
            Order::Looked(frame, taken) => {
                let place = self.machine.application.body().place();
                let taken_ms = self.clock.signed_ms(taken);
                let application = &mut self.machine.application;
                application.look_at(seconds(self.clock.now_us()), &frame, taken_ms);
                let taken_ms = u64::try_from(taken_ms).unwrap_or(0);
                let people = self.newest.look(&frame, taken_ms).into_iter();
                seen = people.map(|vru| seen_from(place, vru)).collect();
                Stimulus::Perceived(&seen)
            }
            Order::LookedInVain(_)
            | Order::Battery(_)
            | Order::Show(_)
            | Order::Job(_)
            | Order::Serve(_)
            | Order::Reset => {
                self.machine.application.obey(order);
                Stimulus::Time
            }
            Order::Count(cause, detail) => {
                return self.drop(cause, detail.to_owned(), Vec::new());
            }
            Order::Stop => return self.begin_to_stop(),
            Order::Die => {
                self.is_dead = true;
                return;
            }
        };
        self.handle(stimulus);
    }

    /// Holds messages back on a busy channel, where the link measures one.
    fn control_congestion(&mut self) {
        let now_ms = self.now_ms();
        if let Some((interval_ms, news)) = self.channel.evaluate(now_ms) {
            self.machine.endpoint.hold_back(interval_ms);
            if let Some(state) = news {
                self.log(Entry::Channel(state));
            }
        }
    }

    fn now_ms(&self) -> u64 {
        self.clock.now_us() / 1_000
    }

    /// Tells the robot of a boot counter that has been persisted meanwhile.
    fn renew_epoch(&mut self) {
        match self.keeper.answer() {
            None => {}
            Some(Ok(boot)) => self.handle(Stimulus::Event(Event::EpochRenewed(boot))),
            // The robot asks again with the next number that it gives out.
            Some(Err(error)) => {
                self.drop(Cause::EpochNotRenewed, error.to_string(), Vec::new());
            }
        }
    }

    /// Remembers the time for the next boot, and says whether the clock can be relied on.
    fn keep_time(&mut self) {
        let Some(time) = self.machine.endpoint.trusted_time().copied() else {
            return;
        };
        let state = ClockState::of(&time);
        if state.is_trusted()
            && let Some(error) = self.keeper.keep(time.mark())
        {
            self.drop(Cause::TimeNotKept, error.to_string(), Vec::new());
        }
        if self.clock_state.map(ClockState::is_trusted) != Some(state.is_trusted()) {
            self.clock_state = Some(state);
            self.log(Entry::Clock(state));
        }
    }

    /// A robot that is to stop leaves its session in order first.
    fn begin_to_stop(&mut self) {
        if !self.stopping {
            self.stopping = true;
            let has_part = !matches!(self.machine.endpoint.robot().phase(), Phase::Idle);
            self.handle(event(has_part.then_some(Event::LeaveRequested)));
            // While it says farewell it is asked for help again.
            let is_available =
                self.machine.endpoint.robot().availability() == Availability::Available;
            let not_safe = Availability::Unavailable(Unavailability::NotSafe);
            let changed = Event::AvailabilityChanged(not_safe);
            self.handle(event((has_part && is_available).then_some(changed)));
        }
    }

    fn is_done(&self) -> bool {
        self.stopping && self.machine.may_stop()
    }

    /// Hands something to the endpoint and carries out what it wants.
    fn handle(&mut self, stimulus: Stimulus<'_>) {
        // Read once: the sign counts from the moment that the protocol counts from.
        let shown = self.clock.now_us();
        let moment = moment_at(shown);
        let effects = self.machine.handle(moment, seconds(shown), stimulus);
        // What the robot saw is logged before what it did by that.
        if let Some(sight) = self.machine.application.next_sight() {
            let sighted = self.record_at(shown, Entry::People(sight));
            self.put(sighted);
        }
        for effect in effects {
            self.carry_out(effect);
        }
        while let Some((cause, detail, count)) = self.machine.application.next_trouble() {
            self.drop_many(cause, detail.into_owned(), count);
        }
        if let Some(why) = self.machine.application.next_hindrance() {
            self.log(Entry::Hindered { why });
        }
        self.look_around(shown);
        if let Some(counters) = self.sampler.elapse(shown) {
            self.log(Entry::Unrecorded { counters });
        }
    }

    /// Says once a second who is on the map.
    fn look_around(&mut self, now_us: u64) {
        let (last, last_us) = &self.around;
        if now_us.saturating_sub(*last_us) < AROUND_PERIOD_US {
            return;
        }
        let own = self.machine.application.state().position;
        let around = Around::of(self.machine.endpoint.map(), &own, now_us / 1_000);
        let is_told = !(last.kinds.is_empty() && around.kinds.is_empty());
        self.around = (around.clone(), now_us);
        if is_told {
            self.log(Entry::Around(around));
        }
    }

    fn carry_out(&mut self, mut effect: Effect) {
        let mut to_send = None;
        match &mut effect {
            Effect::Act(Output::RenewEpoch, _) => self.keeper.ask(),
            Effect::Stepped { state, .. } => {
                let identifiers = self.machine.endpoint.identifiers();
                self.waiting.partners.follow(state, identifiers);
            }
            Effect::Transmit { packet, .. } => to_send = Some(std::mem::take(packet)),
            _ => {}
        }
        // A packet is logged before it is sent: no receiver logs it before its sender.
        if let Some(entry) = recorded(effect) {
            self.log(entry);
        }
        if let Some(packet) = to_send
            && let Err(error) = self.sender.send(&packet)
        {
            self.drop(Cause::NotSent, error.to_string(), Vec::new());
        }
    }

    /// So many were dropped: one record has the details, the others are counted.
    fn drop_many(&mut self, cause: Cause, detail: String, count: u64) {
        self.drop(cause, detail, Vec::new());
        let others = count.saturating_sub(1);
        (0..others).for_each(|_| self.machine.endpoint.count(cause));
        self.sampler.count(&cause.into(), others);
    }

    fn drop(&mut self, cause: Cause, detail: String, octets: Vec<u8>) {
        self.machine.endpoint.count(cause);
        self.log(Entry::Dropped {
            cause: cause.into(),
            detail,
            octets,
        });
    }

    fn log(&mut self, entry: Entry) {
        if let Entry::Dropped { cause, .. } = &entry
            && !self.sampler.admits(cause)
        {
            return;
        }
        let record = self.record(entry);
        self.put(record);
    }

    fn put(&mut self, record: Record) {
        for lost in self.journal.put(record) {
            self.machine.endpoint.count(lost);
        }
        let ended = self.journal.ended_logs();
        if ended > std::mem::replace(&mut self.ended_logs, ended) {
            // No counter has it: the records that a log lacks are counted one by one.
            self.log(Entry::Dropped {
                cause: Cause::LogFull.into(),
                detail: "a log has ended, and has no more of this robot".to_owned(),
                octets: Vec::new(),
            });
        }
    }

    fn record(&mut self, entry: Entry) -> Record {
        self.record_at(self.clock.now_us(), entry)
    }

    fn record_at(&mut self, at_us: u64, entry: Entry) -> Record {
        Record {
            at_us,
            robot: self.name.clone(),
            entry,
        }
    }
}

/// An event if there is one, or else that time has passed.
fn event(event: Option<Event>) -> Stimulus<'static> {
    event.map_or(Stimulus::Time, Stimulus::Event)
}
