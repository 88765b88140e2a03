//! The lines of the operator port that go out, version 1: one JSON object each, with its kind under `type`. Words are
//! those of the protocol.

use crossguard_endpoint::cause::Layer;
use crossguard_protocol::words::Said;
use crossguard_protocol::{
    Availability, Corridor, Duty, FallbackPolicy, Maneuver, Member, NoticeKind, Output, Phase,
    Robot, SessionId, Unavailability, UniqueNumber,
};
use serde::Serialize;
use serde_json::{Map, Value, json};

use crate::around::Around;

/// Line of the kit to a program at the operator port.
#[derive(Serialize)]
#[serde(
    rename_all_fields = "camelCase",
    tag = "type",
    rename_all = "kebab-case"
)]
pub(super) enum ToOperator<'a> {
    Hello {
        crossguard: u64,
        robot: &'a str,
        station: u32,
        boot: u16,
        trusts_ros_graph: bool,
    },
    State {
        at_us: u64,
        #[serde(skip_serializing_if = "Option::is_none")]
        open_ms: Option<u64>,
        #[serde(flatten)]
        now: &'a Fields,
    },
    Act {
        at_us: u64,
        output: &'static str,
        #[serde(flatten)]
        said: Fields,
    },
    Notice {
        at_us: u64,
        #[serde(flatten)]
        said: Fields,
    },
    Ignored {
        at_us: u64,
        event: &'static str,
        #[serde(flatten)]
        said: Fields,
    },
    Map {
        at_us: u64,
        #[serde(flatten)]
        around: &'a Around,
    },
    Dropped {
        at_us: u64,
        layer: Layer,
        cause: &'a str,
        detail: &'a str,
        count: u64,
    },
    /// People may not cross now.
    Hindered {
        at_us: u64,
        why: &'a str,
    },
    Refused {
        line: u64,
        why: String,
    },
    Stopped {
        at_us: u64,
    },
}

/// Fields of a line; a field without a value is left out.
pub(super) type Fields = Map<String, Value>;

fn fields(all: Value) -> Fields {
    match all {
        Value::Object(mut fields) => {
            fields.retain(|_, value| !value.is_null());
            fields
        }
        _ => Fields::new(),
    }
}

fn session(session: SessionId) -> Value {
    let UniqueNumber { boot, count } = session.number.0;
    json!({ "leader": session.leader.0, "boot": boot, "count": count })
}

/// Fields of an output.
pub(super) fn said(output: &Output) -> Fields {
    let said = Said::by(output);
    fields(json!({
        "notice": said.notice.map(NoticeKind::name),
        "reason": said.reason.map(|word| word.name),
        "unavailability": said.unavailability.map(Unavailability::name),
        "policy": said.policy.map(FallbackPolicy::name),
        "task": said.task,
        "request": said.request,
        "station": said.station,
        "session": said.session.map(session),
        "openMs": said.open,
        "text": output.to_string(),
    }))
}

/// How a robot is.
pub(super) fn condition(robot: &Robot) -> Fields {
    let leading = match robot.phase() {
        Phase::Leading(leading) => Some(leading),
        _ => None,
    };
    let executes = match robot.phase() {
        Phase::Following(following) => following.executing(),
        _ => None,
    };
    let corridor = leading.map_or(Corridor::Clear, |it| it.corridor);
    let (duty, duty_session, duty_request) = match robot.duty() {
        None => (None, None, None),
        Some(Duty::FallingBack(Maneuver { id, .. })) => {
            (Some("fallingBack"), Some(id.session), Some(id.request))
        }
        Some(Duty::Crossing(session)) => (Some("crossing"), Some(session), None),
    };
    let followers = leading.map(|it| it.members.iter().map(follower).collect::<Vec<_>>());
    fields(json!({
        "station": robot.station(),
        "boot": robot.boot(),
        "state": robot.state().name(),
        "role": robot.role().name(),
        "availability": match robot.availability() {
            Availability::Available => "available",
            Availability::Unavailable(why) => why.name(),
        },
        "session": robot.session().map(session),
        "followers": followers,
        "executes": executes.map(|it| json!({ "task": it.task, "request": it.id.request })),
        "corridor": corridor.name(),
        "roadOccupied": corridor != Corridor::Clear || matches!(robot.duty(), Some(Duty::Crossing(_))),
        "yieldsTo": leading.and_then(|it| it.yields_to),
        "duty": duty,
        "dutySession": duty_session.map(session),
        "dutyRequest": duty_request,
    }))
}

fn follower(member: &Member) -> Value {
    let order = member.order;
    Value::Object(fields(json!({
        "station": member.station,
        "hasJoined": member.has_joined(),
        "task": order.map(|it| it.task),
        "progress": order.and_then(|it| it.progress).map(|it| it.kind().name()),
        "hasLease": member.lease.stands(),
    })))
}
