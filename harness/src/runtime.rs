//! One robot as a running program: its endpoint, link and application in one loop.
//!
//! ```text
//!   socket ──► reader thread ──► inbox (bounded) ──► loop ──► endpoint ──► effects
//!   events ──────────────────────────┘                │                     │
//!   clock ─── advances body and endpoint ─────────────┘     link, application, log
//! ```
//!
//! The loop owns everything; nothing is locked. An inbox that is full drops the newest datagram, and
//! counts it.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::mpsc::{
    Receiver as Inbox, RecvTimeoutError, SyncSender, TrySendError, sync_channel,
};
use std::thread::JoinHandle;
use std::time::{Duration, Instant, SystemTime, UNIX_EPOCH};

use crossguard_codec::si::timestamp_its;
use crossguard_protocol::{Config, Event, Phase, Robot, StationId};

use crate::application::{Application, Wish};
use crate::counters::Cause;
use crate::endpoint::{Effect, Endpoint, Moment, Stimulus};
use crate::machine::{Machine, stimulus_of};
use crate::perception::seen_from;
use crate::ras::clustering::PerceivedVru;
use crate::ras::surroundings::Awareness;
use crate::station::Security;
use crate::trace::{Entry, Record, recorded};
use crate::transport::{Arrival, Halves, Receiver, Sender};
use crate::wire::Wire;

/// How many datagrams and orders may wait.
const INBOX: usize = 256;

/// How long the reader waits for a datagram before it looks whether it should stop.
const READER_WAIT: Duration = Duration::from_millis(100);

/// How often the body moves at least.
const BODY_PERIOD: Duration = Duration::from_millis(5);

/// A clock that several robots share, so that their logs line up.
#[derive(Clone, Copy, Debug)]
pub struct Clock {
    start: Instant,
}

impl Clock {
    /// A clock that starts now.
    #[must_use]
    pub fn start() -> Self {
        Self {
            start: Instant::now(),
        }
    }

    /// Microseconds since the start.
    #[must_use]
    pub fn now_us(&self) -> u64 {
        u64::try_from(self.start.elapsed().as_micros()).unwrap_or(u64::MAX)
    }

    fn moment(&self) -> Moment {
        let unix_ms = i64::try_from(unix_ms()).unwrap_or(i64::MAX);
        Moment {
            now_ms: self.now_us() / 1_000,
            timestamp_its: timestamp_its(unix_ms),
        }
    }
}

fn unix_ms() -> u64 {
    let now = SystemTime::now()
        .duration_since(UNIX_EPOCH)
        .unwrap_or_default();
    u64::try_from(now.as_millis()).unwrap_or(u64::MAX)
}

/// What a running robot can be told from outside.
#[derive(Clone, Copy, Debug)]
pub enum Order {
    /// Something for its endpoint.
    Wish(Wish),
    /// The maneuver that runs is finished, well or not.
    Finish {
        /// Whether it was completed.
        well: bool,
    },
    /// The sensors have this person, at this place on the site.
    Perceived(PerceivedVru),
    /// Carry the body back to where it began.
    Reset,
    /// Leave whatever session it is in, say farewell, and stop.
    Stop,
    /// Lose power: end at once and say nothing.
    Die,
}

enum Delivery {
    Arrived(Arrival),
    Order(Order),
    LinkFailed(std::io::Error),
}

/// A robot that can be run.
pub struct Setup {
    /// Its name in logs.
    pub name: String,
    /// Its station id.
    pub station: StationId,
    /// Its boot counter.
    pub boot: u16,
    /// Its configuration.
    pub config: Config,
    /// Encodes and decodes.
    pub wire: Wire,
    /// Whether it signs and verifies.
    pub security: Security,
    /// How it announces the people around it.
    pub awareness: Awareness,
    /// Moves the body, and leads.
    pub application: Application,
    /// Its link, open.
    pub link: Halves,
    /// Where the log goes.
    pub log: SyncSender<Record>,
    /// The clock.
    pub clock: Clock,
}

/// A robot that runs.
pub struct Running {
    orders: SyncSender<Delivery>,
    threads: Vec<JoinHandle<()>>,
    stop: Arc<AtomicBool>,
}

impl Setup {
    /// Starts the robot in threads of its own.
    #[must_use]
    pub fn start(self) -> Running {
        let (deliveries, inbox) = sync_channel(INBOX);
        let stop = Arc::new(AtomicBool::new(false));
        let overflow = Arc::new(AtomicU64::new(0));
        let reader = Reader {
            receiver: self.link.receiver,
            deliveries: deliveries.clone(),
            overflow: Arc::clone(&overflow),
            stop: Arc::clone(&stop),
        };
        let now_ms = self.clock.now_us() / 1_000;
        let robot = Robot::new(self.station, self.boot);
        let mut turn = Loop {
            machine: Machine::new(
                Endpoint::new(robot, self.config, self.wire, now_ms)
                    .with_security(self.security)
                    .with_awareness(self.awareness),
                self.application,
            ),
            name: self.name,
            sender: self.link.sender,
            log: self.log,
            clock: self.clock,
            overflow,
            stopping: false,
            is_dead: false,
        };
        let stopped = Arc::clone(&stop);
        let threads = vec![
            std::thread::spawn(move || reader.run()),
            std::thread::spawn(move || {
                turn.run(&inbox);
                stopped.store(true, Ordering::Relaxed);
            }),
        ];
        Running {
            orders: deliveries,
            threads,
            stop,
        }
    }
}

impl Running {
    /// Tells the robot something. It has no effect on a robot that has stopped.
    pub fn order(&self, order: Order) {
        let _ = self.orders.send(Delivery::Order(order));
    }

    /// Whether the robot has stopped, of its own accord or because it was told to.
    #[must_use]
    pub fn has_stopped(&self) -> bool {
        self.stop.load(Ordering::Relaxed)
    }

    /// Tells the robot to stop and waits until it has said farewell.
    pub fn stop(self) {
        self.order(Order::Stop);
        self.wait();
    }

    /// Waits until the robot has stopped.
    pub fn wait(self) {
        drop(self.orders);
        for thread in self.threads {
            // A panic has been printed by its thread; there is nothing to add.
            let _ = thread.join();
        }
    }
}

struct Reader {
    receiver: Box<dyn Receiver>,
    deliveries: SyncSender<Delivery>,
    overflow: Arc<AtomicU64>,
    stop: Arc<AtomicBool>,
}

impl Reader {
    fn run(mut self) {
        while !self.stop.load(Ordering::Relaxed) {
            let delivery = match self.receiver.receive(READER_WAIT) {
                Ok(None) => continue,
                Ok(Some(arrival)) => Delivery::Arrived(arrival),
                Err(error) => Delivery::LinkFailed(error),
            };
            let failed = matches!(delivery, Delivery::LinkFailed(_));
            match self.deliveries.try_send(delivery) {
                Ok(()) => {}
                Err(TrySendError::Full(_)) => {
                    self.overflow.fetch_add(1, Ordering::Relaxed);
                }
                Err(TrySendError::Disconnected(_)) => return,
            }
            if failed {
                // An interface that is gone may come back; until then there is no hurry.
                std::thread::sleep(Duration::from_millis(200));
            }
        }
    }
}

struct Loop {
    machine: Machine,
    name: String,
    sender: Box<dyn Sender>,
    log: SyncSender<Record>,
    clock: Clock,
    overflow: Arc<AtomicU64>,
    stopping: bool,
    is_dead: bool,
}

impl Loop {
    fn run(&mut self, inbox: &Inbox<Delivery>) {
        self.log(Entry::Started {
            station: self.machine.endpoint().robot().station(),
            boot: self.machine.endpoint().robot().boot(),
            settings: Box::new(self.machine.endpoint().config().settings().clone()),
            identifiers: self.machine.endpoint().wire().identifiers,
            unix_ms: unix_ms(),
        });
        while !self.is_done() {
            match inbox.recv_timeout(self.patience()) {
                Ok(Delivery::Arrived(arrival)) => self.arrive(arrival),
                Ok(Delivery::Order(order)) => self.obey(order),
                Ok(Delivery::LinkFailed(cause)) => {
                    self.drop(Cause::LinkFailed, cause.to_string(), Vec::new());
                }
                Err(RecvTimeoutError::Timeout) => {}
                // Nobody is left who could tell it to stop.
                Err(RecvTimeoutError::Disconnected) => self.begin_to_stop(),
            }
            if self.is_dead {
                return;
            }
            self.handle(Stimulus::Time);
        }
        for _ in 0..self.overflow.swap(0, Ordering::Relaxed) {
            self.machine.endpoint_mut().count(Cause::InboxFull);
        }
        let counters = self.machine.endpoint().counters().by_name().clone();
        self.log(Entry::Stopped { counters });
    }

    /// How long the loop may wait for something to arrive.
    fn patience(&self) -> Duration {
        let now_us = self.clock.now_us();
        let due_us = self
            .machine
            .endpoint()
            .next_wakeup_ms()
            .saturating_mul(1_000);
        Duration::from_micros(due_us.saturating_sub(now_us)).min(BODY_PERIOD)
    }

    fn arrive(&mut self, arrival: Arrival) {
        match arrival {
            Arrival::Datagram { octets, .. } => self.handle(Stimulus::Datagram(&octets)),
            Arrival::Lost { how, octets } => {
                let detail = "by the fault layer".to_owned();
                self.drop(Cause::Simulated(how), detail, octets);
            }
        }
    }

    fn obey(&mut self, order: Order) {
        match order {
            Order::Wish(wish) => self.handle(stimulus_of(wish)),
            Order::Finish { well } => {
                if let Some(event) = self.machine.finish(well) {
                    self.handle(Stimulus::Event(event));
                }
            }
            Order::Perceived(vru) => {
                let place = self.machine.application().body().place();
                self.handle(Stimulus::Perceived(&[seen_from(place, vru)]));
            }
            Order::Reset => self.machine.application_mut().reset(),
            Order::Stop => self.begin_to_stop(),
            Order::Die => self.is_dead = true,
        }
    }

    /// A robot that is to stop leaves its session in order first.
    fn begin_to_stop(&mut self) {
        if !self.stopping {
            self.stopping = true;
            if !matches!(self.machine.endpoint().robot().phase(), Phase::Idle) {
                self.handle(Stimulus::Event(Event::LeaveRequested));
            }
        }
    }

    fn is_done(&self) -> bool {
        self.stopping && self.machine.is_at_rest()
    }

    /// Hands something to the endpoint and carries out what it wants.
    fn handle(&mut self, stimulus: Stimulus<'_>) {
        let moment = self.clock.moment();
        #[expect(clippy::cast_precision_loss, reason = "centuries of microseconds fit")]
        let now_s = self.clock.now_us() as f64 / 1e6;
        for effect in self.machine.handle(moment, now_s, stimulus) {
            self.carry_out(effect);
        }
    }

    fn carry_out(&mut self, effect: Effect) {
        let packet = match &effect {
            Effect::Transmit { packet, .. } => Some(packet.clone()),
            _ => None,
        };
        // What is sent is logged first: no receiver logs it before its sender.
        if let Some(entry) = recorded(effect) {
            self.log(entry);
        }
        if let Some(packet) = packet
            && let Err(error) = self.sender.send(&packet)
        {
            self.drop(Cause::NotSent, error.to_string(), Vec::new());
        }
    }

    fn drop(&mut self, cause: Cause, detail: String, octets: Vec<u8>) {
        self.machine.endpoint_mut().count(cause);
        self.log(Entry::Dropped {
            cause: cause.name(),
            detail,
            octets,
        });
    }

    fn log(&mut self, entry: Entry) {
        let record = Record {
            at_us: self.clock.now_us(),
            robot: self.name.clone(),
            entry,
        };
        if self.log.try_send(record).is_err() {
            self.machine.endpoint_mut().count(Cause::LogFull);
        }
    }
}
