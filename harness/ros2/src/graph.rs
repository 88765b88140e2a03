//! A node in the ROS graph, and what it publishes, listens to, answers and asks.
//!
//! ```text
//!   Graph (one zenoh session) ──► Node (token NN) ──┬─► Publisher    (token MP)
//!                                                   ├─► Subscription (token MS)
//!                                                   ├─► Server       (token SS)
//!                                                   └─► Client       (token SC)
//! ```
//!
//! Each takes its token back when it is dropped. Callbacks run in threads of zenoh and must not wait.

use std::marker::PhantomData;
use std::sync::Arc;
use std::sync::atomic::{AtomicI64, AtomicU64, Ordering};
use std::sync::mpsc::{RecvTimeoutError, sync_channel};
use std::time::{Duration, SystemTime, UNIX_EPOCH};

use zenoh::bytes::ZBytes;
use zenoh::liveliness::LivelinessToken;
use zenoh::qos::CongestionControl;
use zenoh::query::{ConsolidationMode, Query, QueryTarget, Queryable};
use zenoh::{Session, Wait};

use crate::attachment::{Attachment, Gid, NoAttachment};
use crate::entity::{Entity, Kind, NameError, NodeEntity, NodeName};
use crate::message::{CdrError, Message, Service, decode, encode, hash_of};
use crate::qos::Qos;

/// The depth of services in ROS 2.
const SERVICE_QOS: Qos = Qos::depth(10);

/// What does not work in the ROS graph.
#[derive(Debug, thiserror::Error)]
pub enum RosError {
    /// Zenoh does not do it.
    #[error("zenoh: {0}")]
    Zenoh(String),
    /// A name is none.
    #[error(transparent)]
    Name(#[from] NameError),
    /// A message cannot be written or read.
    #[error(transparent)]
    Message(#[from] Unreadable),
    /// A service did not answer in time.
    #[error("{0} did not answer in time")]
    NoAnswer(String),
    /// A service answered that it cannot.
    #[error("{service} answered: {why}")]
    Refused {
        /// The service.
        service: String,
        /// What it answered.
        why: String,
    },
}

fn of_zenoh(error: impl std::fmt::Display) -> RosError {
    RosError::Zenoh(error.to_string())
}

/// Why something that came in says nothing.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
pub enum Unreadable {
    /// It is no message of its type.
    #[error(transparent)]
    Cdr(#[from] CdrError),
    /// Its attachment is of another form.
    #[error(transparent)]
    Attachment(#[from] NoAttachment),
    /// It has no payload.
    #[error("it has no payload")]
    Nothing,
}

impl Unreadable {
    /// The cause that it is counted under.
    #[must_use]
    pub const fn cause(&self) -> &'static str {
        match self {
            Self::Cdr(_) => "ros: no message of its type",
            Self::Attachment(_) => "ros: attachment of another form",
            Self::Nothing => "ros: without a payload",
        }
    }
}

/// Where a node meets others. The default is that of `rmw_zenoh`.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Meeting {
    /// `ROS_DOMAIN_ID`.
    pub domain: u32,
    /// Routers and peers to connect to, like `tcp/localhost:7447`.
    pub connect: Vec<String>,
    /// Where to listen for peers, like `tcp/localhost:0`.
    pub listen: Vec<String>,
}

impl Default for Meeting {
    fn default() -> Self {
        Self {
            domain: 0,
            connect: vec!["tcp/localhost:7447".to_owned()],
            listen: vec!["tcp/localhost:0".to_owned()],
        }
    }
}

impl Meeting {
    /// The configuration of zenoh: a peer that goes by gossip and not by multicast, as that of `rmw_zenoh`.
    fn config(&self) -> Result<zenoh::Config, RosError> {
        let list = |endpoints: &[String]| {
            let quoted: Vec<_> = endpoints.iter().map(|it| format!("{it:?}")).collect();
            format!("[{}]", quoted.join(", "))
        };
        let mut config = zenoh::Config::default();
        for (key, value) in [
            ("mode", "\"peer\"".to_owned()),
            ("connect/endpoints", list(&self.connect)),
            ("listen/endpoints", list(&self.listen)),
            ("scouting/multicast/enabled", "false".to_owned()),
            ("scouting/gossip/enabled", "true".to_owned()),
        ] {
            config.insert_json5(key, &value).map_err(of_zenoh)?;
        }
        Ok(config)
    }
}

/// A session in a domain.
#[derive(Clone, Debug)]
pub struct Graph {
    session: Session,
    domain: u32,
    next_id: Arc<AtomicU64>,
}

impl Graph {
    /// Opens a session. Routers and peers that are not there yet are tried again for as long as it lasts.
    ///
    /// # Errors
    /// When an endpoint is none, or none can be listened at.
    pub fn open(meeting: &Meeting) -> Result<Self, RosError> {
        let session = zenoh::open(meeting.config()?).wait().map_err(of_zenoh)?;
        Ok(Self {
            session,
            domain: meeting.domain,
            next_id: Arc::default(),
        })
    }

    /// Makes a node appear.
    ///
    /// # Errors
    /// Those of zenoh.
    pub fn node(&self, name: NodeName) -> Result<Node, RosError> {
        let entity = NodeEntity {
            domain: self.domain,
            zid: self.session.zid().to_string(),
            id: self.next_id(),
            name,
        };
        let token = self.declare(entity.token())?;
        Ok(Node {
            graph: self.clone(),
            entity,
            _token: token,
        })
    }

    /// Takes everything back and ends the session.
    ///
    /// # Errors
    /// Those of zenoh.
    pub fn close(self) -> Result<(), RosError> {
        self.session.close().wait().map_err(of_zenoh)
    }

    fn next_id(&self) -> u64 {
        self.next_id.fetch_add(1, Ordering::Relaxed)
    }

    fn declare(&self, token: String) -> Result<LivelinessToken, RosError> {
        let liveliness = self.session.liveliness();
        liveliness.declare_token(token).wait().map_err(of_zenoh)
    }
}

/// A node.
#[derive(Debug)]
pub struct Node {
    graph: Graph,
    entity: NodeEntity,
    _token: LivelinessToken,
}

impl Node {
    /// Its name.
    #[must_use]
    pub const fn name(&self) -> &NodeName {
        &self.entity.name
    }

    fn part(&self, kind: Kind, topic: &str, name: &str, qos: Qos) -> Result<Entity, RosError> {
        Ok(Entity {
            node: self.entity.clone(),
            id: self.graph.next_id(),
            kind,
            topic: self.entity.name.resolve(topic)?,
            type_name: name.to_owned(),
            type_hash: hash_of(name),
            qos,
        })
    }

    /// Publishes on a topic.
    ///
    /// # Errors
    /// When the topic is no name, and those of zenoh.
    pub fn publisher<M: Message>(&self, topic: &str, qos: Qos) -> Result<Publisher<M>, RosError> {
        let entity = self.part(Kind::Publisher, topic, M::NAME, qos)?;
        let session = &self.graph.session;
        let inner = session
            .declare_publisher(entity.key())
            // A reader that does not read holds nobody up.
            .congestion_control(CongestionControl::Drop)
            .wait()
            .map_err(of_zenoh)?;
        Ok(Publisher {
            inner,
            gid: entity.gid(),
            sequence: AtomicI64::new(1),
            _token: self.graph.declare(entity.token())?,
            _of: PhantomData,
        })
    }

    /// Listens to a topic. `take` gets every message that comes in, in a thread of zenoh.
    ///
    /// # Errors
    /// When the topic is no name, and those of zenoh.
    pub fn subscription<M: Message>(
        &self,
        topic: &str,
        qos: Qos,
        take: impl Fn(Result<M, Unreadable>) + Send + Sync + 'static,
    ) -> Result<Subscription, RosError> {
        let entity = self.part(Kind::Subscription, topic, M::NAME, qos)?;
        let session = &self.graph.session;
        let subscriber = session
            .declare_subscriber(entity.key())
            .callback(move |sample| {
                take(decode(&sample.payload().to_bytes()).map_err(Unreadable::from));
            })
            .wait()
            .map_err(of_zenoh)?;
        Ok(Subscription {
            _subscriber: subscriber,
            _token: self.graph.declare(entity.token())?,
        })
    }

    /// Answers requests. `take` gets every request, in a thread of zenoh; the answer may come later.
    ///
    /// # Errors
    /// When the service is no name, and those of zenoh.
    pub fn server<S: Service + 'static>(
        &self,
        service: &str,
        take: impl Fn(Result<Call<S>, Unreadable>) + Send + Sync + 'static,
    ) -> Result<Server, RosError> {
        let entity = self.part(Kind::Service, service, S::NAME, SERVICE_QOS)?;
        let (session, key) = (&self.graph.session, entity.key());
        let queryable = session
            .declare_queryable(entity.key())
            .complete(true)
            .callback(move |query| take(Call::read(query, &key)))
            .wait()
            .map_err(of_zenoh)?;
        Ok(Server {
            _queryable: queryable,
            _token: self.graph.declare(entity.token())?,
        })
    }

    /// Asks a service.
    ///
    /// # Errors
    /// When the service is no name, and those of zenoh.
    pub fn client<S: Service>(&self, service: &str) -> Result<Client<S>, RosError> {
        let entity = self.part(Kind::Client, service, S::NAME, SERVICE_QOS)?;
        Ok(Client {
            session: self.graph.session.clone(),
            gid: entity.gid(),
            sequence: AtomicI64::new(1),
            _token: self.graph.declare(entity.token())?,
            entity,
            _of: PhantomData,
        })
    }
}

/// Nanoseconds since 1970 (UTC).
#[must_use]
pub fn now_ns() -> i64 {
    let since = SystemTime::now().duration_since(UNIX_EPOCH);
    i64::try_from(since.unwrap_or_default().as_nanos()).unwrap_or(i64::MAX)
}

fn attached(sequence: i64, gid: Gid) -> Vec<u8> {
    let attachment = Attachment {
        sequence,
        sent_ns: now_ns(),
        gid,
    };
    attachment.to_octets()
}

/// Publishes messages of one type on one topic.
#[derive(Debug)]
pub struct Publisher<M> {
    inner: zenoh::pubsub::Publisher<'static>,
    gid: Gid,
    sequence: AtomicI64,
    _token: LivelinessToken,
    _of: PhantomData<fn(M)>,
}

impl<M: Message> Publisher<M> {
    /// Publishes a message. It waits for no reader.
    ///
    /// # Errors
    /// When it cannot be written, and those of zenoh.
    pub fn publish(&self, message: &M) -> Result<(), RosError> {
        let payload = encode(message).map_err(Unreadable::from)?;
        let sequence = self.sequence.fetch_add(1, Ordering::Relaxed);
        let put = self.inner.put(payload);
        put.attachment(attached(sequence, self.gid))
            .wait()
            .map_err(of_zenoh)
    }
}

/// Listens to a topic until it is dropped.
#[derive(Debug)]
pub struct Subscription {
    _subscriber: zenoh::pubsub::Subscriber<()>,
    _token: LivelinessToken,
}

/// Answers requests until it is dropped.
#[derive(Debug)]
pub struct Server {
    _queryable: Queryable<()>,
    _token: LivelinessToken,
}

/// A request that waits for its answer.
pub struct Call<S: Service> {
    /// What is asked.
    pub request: S::Request,
    query: Query,
    key: String,
    asked: Attachment,
}

impl<S: Service> Call<S> {
    fn read(query: Query, key: &str) -> Result<Self, Unreadable> {
        let read = || {
            let octets = |part: Option<&ZBytes>| part.map(|it| it.to_bytes().into_owned());
            let asked = octets(query.attachment()).ok_or(NoAttachment(0))?;
            let request = octets(query.payload()).ok_or(Unreadable::Nothing)?;
            Ok((decode(&request)?, Attachment::read(&asked)?))
        };
        match read() {
            Ok((request, asked)) => Ok(Self {
                request,
                query,
                key: key.to_owned(),
                asked,
            }),
            Err(error) => {
                let error: Unreadable = error;
                // Who asked may be gone.
                let _ = query.reply_err(error.to_string()).wait();
                Err(error)
            }
        }
    }

    /// Answers it.
    ///
    /// # Errors
    /// When the answer cannot be written, and those of zenoh.
    pub fn answer(self, response: &S::Response) -> Result<(), RosError> {
        let payload = encode(response).map_err(Unreadable::from)?;
        // An answer has the number and the gid of its request.
        let attachment = attached(self.asked.sequence, self.asked.gid);
        let reply = self.query.reply(self.key, payload);
        reply.attachment(attachment).wait().map_err(of_zenoh)
    }
}

/// Asks a service.
#[derive(Debug)]
pub struct Client<S> {
    session: Session,
    entity: Entity,
    gid: Gid,
    sequence: AtomicI64,
    _token: LivelinessToken,
    _of: PhantomData<fn(S)>,
}

impl<S: Service> Client<S> {
    /// Asks, and waits for the answer.
    ///
    /// # Errors
    /// When there is none in time, or it says that it cannot.
    pub fn call(&self, request: &S::Request, at_most: Duration) -> Result<S::Response, RosError> {
        let payload = encode(request).map_err(Unreadable::from)?;
        let sequence = self.sequence.fetch_add(1, Ordering::Relaxed);
        let (answered, answers) = sync_channel(1);
        self.session
            .get(self.entity.key())
            .target(QueryTarget::AllComplete)
            .consolidation(ConsolidationMode::None)
            .timeout(at_most)
            .payload(payload)
            .attachment(attached(sequence, self.gid))
            .callback(move |reply| {
                // The first answer is the one that counts.
                let _ = answered.try_send(reply);
            })
            .wait()
            .map_err(of_zenoh)?;
        let service = &self.entity.topic;
        match answers.recv_timeout(at_most) {
            Ok(reply) => match reply.result() {
                Ok(sample) => Ok(decode(&sample.payload().to_bytes()).map_err(Unreadable::from)?),
                Err(error) => Err(RosError::Refused {
                    service: service.clone(),
                    why: String::from_utf8_lossy(&error.payload().to_bytes()).into_owned(),
                }),
            },
            Err(RecvTimeoutError::Timeout | RecvTimeoutError::Disconnected) => {
                Err(RosError::NoAnswer(service.clone()))
            }
        }
    }
}
