//! A zenoh session as a transport.

use std::error::Error as StdError;
use std::io::{Error, ErrorKind, Read};
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::mpsc::{
    Receiver as Queue, RecvTimeoutError, SyncSender, TrySendError, sync_channel,
};
use std::time::{Duration, Instant};

pub(super) use ::zenoh::Session;
use ::zenoh::key_expr::KeyExpr;
use ::zenoh::pubsub::{Publisher, Subscriber};
use ::zenoh::qos::{CongestionControl, Priority};
use ::zenoh::sample::{Locality, Sample, SampleKind};
use ::zenoh::session::ZenohId;
use ::zenoh::{Config, Wait};
use nix::net::if_::if_nametoindex;
use serde_json::{Value, json};

use super::super::error::interface_of;
use super::super::{Arrival, DATAGRAM_MAX, Halves, LinkError, NotSent, Receiver, Sender, Source};
use super::{Zenoh, ZenohError, ZenohMode};

/// How many datagrams may wait between zenoh's threads and the receiver.
const WAITING: usize = 256;

/// After how long a link that is silent is taken for dead, in ms; zenoh's default is ten seconds, which is
/// longer than robots wait for each other.
const LEASE_MS: u64 = 2_000;

/// How long after a failed attempt to connect the next one is made, in ms.
const RETRY_MS: u64 = 1_000;

/// The largest message that is put together from fragments, in octets.
const FRAGMENTED_MAX: usize = 65_536;

/// Enters the network, and takes part in the key.
pub(super) fn open(part: &Zenoh) -> Result<Halves, LinkError> {
    // Who listens on a port that is always the same cannot be opened anew beside itself; it is found there.
    let is_fixed = !part.listen.is_empty() || part.config.is_some();
    let is_fixed = is_fixed || part.mode == ZenohMode::Router;
    let scout = part.scouts_on().filter(|_| !is_fixed);
    let scout = scout.map(|name| interface_of(&name).map(|(index, _)| (name, index)));
    let scout = scout.transpose()?;
    let (session, is_connecting) = enter(part)?;
    let key = |chunk: &str| {
        let key = part.key.clone();
        let whole = KeyExpr::try_from(format!("{key}/{chunk}"));
        whole.map_err(|_| ZenohError::Key { key })
    };
    let failed = |error: ::zenoh::Error| ZenohError::Session(in_words(&*error));
    let (coming, arrivals) = sync_channel(WAITING);
    let overflow = Arc::new(AtomicU64::new(0));
    let inbox = Inbox {
        coming,
        overflow: Arc::clone(&overflow),
    };
    let subscriber = session
        .declare_subscriber(key("*")?)
        .allowed_origin(Locality::Remote)
        .callback(move |sample| inbox.take(&sample))
        .wait()
        .map_err(failed)?;
    let publisher = session
        .declare_publisher(key(&session.zid().to_string())?)
        .allowed_destination(Locality::Remote)
        .congestion_control(CongestionControl::Drop)
        .priority(Priority::RealTime)
        // What is sent at once goes out at once, but shares a batch: only two unshared ones find room in
        // zenoh's queue, and a leader says more than that in a step.
        .express(false)
        .wait()
        .map_err(failed)?;
    Ok(Halves {
        sender: Box::new(ZenohSender {
            publisher,
            is_connecting,
            scout,
            session: session.clone(),
        }),
        receiver: Box::new(ZenohReceiver {
            arrivals,
            overflow,
            _subscriber: subscriber,
            _session: session,
        }),
    })
}

/// A session, and whether it is configured to connect to others.
pub(super) fn enter(part: &Zenoh) -> Result<(Session, bool), LinkError> {
    let config = config(part)?;
    let is_connecting = names_endpoints(&config, "connect/endpoints", part.mode);
    if part.mode == ZenohMode::Client && !is_connecting {
        return Err(ZenohError::NoRouter.into());
    }
    let opened = ::zenoh::open(config).wait();
    let session = opened.map_err(|error| match part.mode {
        ZenohMode::Client if part.listen.is_empty() => ZenohError::Unreachable {
            endpoints: match &part.config {
                Some(path) if part.connect.is_empty() => format!("what {} names", path.display()),
                _ => part.connect.join(", "),
            },
        },
        // The other end of a peer or a router may come later.
        _ => ZenohError::Unavailable {
            endpoints: part.listens_on().join(", "),
            cause: in_words(&*error),
        },
    })?;
    Ok((session, is_connecting))
}

/// zenoh's settings: those of a file, if there is one, and of the part.
fn config(part: &Zenoh) -> Result<Config, ZenohError> {
    let mut config = match &part.config {
        None => Config::default(),
        Some(path) => Config::from_file(path).map_err(|error| ZenohError::Config {
            path: path.clone(),
            cause: in_words(&*error),
        })?,
    };
    // zenoh remembers which interfaces there were when it was asked first.
    let scout = part.scouts_on().and_then(|name| interface_of(&name).ok());
    let retry = json!({
        "period_init_ms": RETRY_MS, "period_max_ms": RETRY_MS, "period_increase_factor": 1
    });
    let mut settings = vec![
        ("mode", json!(part.mode)),
        ("connect/retry", retry),
        // Robots begin to talk before others are found, and again when an interface is back.
        ("open/return_conditions/connect_scouted", json!(false)),
        ("scouting/delay", json!(0)),
        // Sending waits for nobody.
        (
            "transport/link/tx/queue/congestion_control/drop/wait_before_drop",
            json!(0),
        ),
    ];
    if part.config.is_none() {
        settings.extend([
            ("listen/endpoints", json!(part.listens_on())),
            ("scouting/multicast/enabled", json!(scout.is_some())),
            ("transport/link/tx/lease", json!(LEASE_MS)),
            ("transport/link/rx/max_message_size", json!(FRAGMENTED_MAX)),
        ]);
    } else if !part.listen.is_empty() {
        settings.push(("listen/endpoints", json!(part.listen)));
    }
    if !part.connect.is_empty() {
        settings.push(("connect/endpoints", json!(part.connect)));
    }
    if let Some((_, address)) = scout {
        settings.push(("scouting/multicast/enabled", json!(true)));
        settings.push(("scouting/multicast/interface", json!(address)));
    }
    for (setting, value) in settings {
        let value = value.to_string();
        config
            .insert_json5(setting, &value)
            .map_err(|error| ZenohError::Setting {
                setting,
                value,
                cause: in_words(&*error),
            })?;
    }
    Ok(config)
}

/// Whether a list of endpoints, which may be one for each mode, has some for this mode.
fn names_endpoints(config: &Config, setting: &str, mode: ZenohMode) -> bool {
    let text = config.get_json(setting).unwrap_or_default();
    let value: Value = serde_json::from_str(&text).unwrap_or_default();
    let mode = json!(mode);
    let of_mode = mode.as_str().and_then(|mode| value.get(mode));
    let list = of_mode.unwrap_or(&value).as_array();
    list.is_some_and(|endpoints| !endpoints.is_empty())
}

/// The innermost cause, without the places in its source that zenoh puts behind causes.
fn in_words(error: &(dyn StdError + 'static)) -> String {
    let mut innermost = error;
    while let Some(cause) = innermost.source() {
        innermost = cause;
    }
    let text = innermost.to_string();
    let words: Vec<_> = text.split(' ').collect();
    let is_place = |pair: &[&str]| pair[0] == "at" && pair[1].contains(".rs:");
    let end = words.windows(2).position(is_place).unwrap_or(words.len());
    let text = words[..end].join(" ");
    // What is left of a list of causes that was cut off is its first.
    match text.rsplit_once('[') {
        Some((_, first)) if !first.contains(']') => first.to_owned(),
        _ => text,
    }
}

/// Where zenoh's threads put what comes in. They never wait.
struct Inbox {
    coming: SyncSender<(Source, Vec<u8>, Instant)>,
    /// How many found no place and are not told yet.
    overflow: Arc<AtomicU64>,
}

impl Inbox {
    fn take(&self, sample: &Sample) {
        if sample.kind() != SampleKind::Put {
            return;
        }
        let at = Instant::now();
        let mut octets = Vec::new();
        let mut payload = sample.payload().reader().take(DATAGRAM_MAX as u64);
        // Reading from memory does not fail.
        let _ = payload.read_to_end(&mut octets);
        let datagram = (source_of(sample), octets, at);
        if let Err(TrySendError::Full(_)) = self.coming.try_send(datagram) {
            self.overflow.fetch_add(1, Ordering::Relaxed);
        }
    }
}

/// Who published it, by the last chunk of the key.
fn source_of(sample: &Sample) -> Source {
    let key = sample.key_expr().as_str();
    let chunk = key.rsplit_once('/').map_or(key, |(_, chunk)| chunk);
    chunk.parse::<ZenohId>().map_or(Source::Unknown, |id| {
        Source::Zenoh(u128::from_le_bytes(id.to_le_bytes()))
    })
}

struct ZenohSender {
    publisher: Publisher<'static>,
    /// Whether it is configured to connect to others, so that being connected to nobody is a failure.
    is_connecting: bool,
    /// The interface on which it looks for others, where it can be opened anew, and its index then: another
    /// of that name is not it.
    scout: Option<(String, u32)>,
    session: Session,
}

impl ZenohSender {
    /// Why it reaches nobody, if it does not.
    fn cut_off(&self) -> Option<Error> {
        let is_there = |(name, index): &&(String, u32)| {
            if_nametoindex(name.as_str()).is_ok_and(|now| now == *index)
        };
        if self.session.is_closed() {
            let why = "the zenoh session is closed";
            return Some(Error::new(ErrorKind::BrokenPipe, why));
        }
        if let Some((name, _)) = self.scout.as_ref().filter(|scout| !is_there(scout)) {
            let why = format!("{name}, on which zenoh looks for others, is gone");
            return Some(Error::new(ErrorKind::NetworkDown, why));
        }
        let why = "zenoh is connected to nobody, and goes on trying";
        (self.is_connecting && !self.is_connected())
            .then(|| Error::new(ErrorKind::NotConnected, why))
    }

    fn is_connected(&self) -> bool {
        let info = self.session.info();
        info.routers_zid().wait().next().is_some() || info.peers_zid().wait().next().is_some()
    }
}

impl Sender for ZenohSender {
    fn send(&mut self, octets: &[u8]) -> Result<(), NotSent> {
        let cause = match self.cut_off() {
            Some(cause) => cause,
            None => match self.publisher.put(octets).wait() {
                Ok(()) => return Ok(()),
                Err(error) => Error::other(in_words(&*error)),
            },
        };
        Err(NotSent {
            failed: 1,
            receivers: 1,
            cause,
        })
    }
}

struct ZenohReceiver {
    arrivals: Queue<(Source, Vec<u8>, Instant)>,
    overflow: Arc<AtomicU64>,
    _subscriber: Subscriber<()>,
    _session: Session,
}

impl Receiver for ZenohReceiver {
    fn receive(&mut self, at_most: Duration) -> std::io::Result<Option<Arrival>> {
        let overflow = self.overflow.swap(0, Ordering::Relaxed);
        if overflow > 0 {
            return Ok(Some(Arrival::Overflow(overflow)));
        }
        match self.arrivals.recv_timeout(at_most) {
            Ok((from, octets, at)) => Ok(Some(Arrival::Datagram { from, octets, at })),
            Err(RecvTimeoutError::Timeout) => Ok(None),
            Err(RecvTimeoutError::Disconnected) => {
                let why = "the zenoh session is closed";
                Err(Error::new(ErrorKind::BrokenPipe, why))
            }
        }
    }
}
