//! The hazards in words.

use super::hazards::Hazard;
use super::road::{RoadProperty, Task};

/// What there is to say about a hazard.
#[derive(Clone, Copy, Debug)]
pub struct Text {
    /// Its id.
    pub id: &'static str,
    /// What happens, in a few words.
    pub title: &'static str,
    /// The property that it breaks.
    pub statement: &'static str,
    /// How it comes about and what harm it does.
    pub explanation: &'static str,
    /// The rule of the protocol that closes it, with the ids of the properties that verify it.
    pub closed_by: &'static str,
}

/// In the order of [`Hazard::ALL`].
const TEXTS: [Text; Hazard::ALL.len()] = [
    Text {
        id: "P1",
        title: "late acknowledgement after fallback",
        statement: "a leader counts a command as accepted only while the follower has not fallen back from it",
        explanation: "The follower accepts the command, its acknowledgement is late, and before it arrives the safety timeout takes the follower back to Idle. The acknowledgement still matches the outstanding requestID, so the leader goes to ManeuverExecuting and would send the pedestrian onto a road that nobody guards.",
        closed_by: "Leases and the corridor: the leader's lease ends before the follower can fall back, the corridor is open only while the lease stands and progress is reported, and a fallback is reported as `safeIdle` of that very command, which is final (I9, I10, I11).",
    },
    Text {
        id: "P2",
        title: "completion from a stale RAM",
        statement: "what a leader counts as completed, the follower finished",
        explanation: "Completion is read from the follower's RAM, and that RAM does not say of which command. A RAM with `completed` from the command before, still on its way, completes the newer command the moment it arrives; the leader goes on while the follower is in the middle of its maneuver.",
        closed_by: "A follower's RAM carries (session, last requestID, progress), so that a stale RAM can complete only what is completed (I8).",
    },
    Text {
        id: "P3",
        title: "release that is the idle default",
        statement: "a maneuver that the leader counts on is not stopped by a release that the leader did not mean",
        explanation: "The release is a RAM with `none`, which is also what every idle robot sends all the time. A RAM from before the session, delayed on its way, releases the follower in the middle of its maneuver; the leader knows nothing of it and counts on the maneuver.",
        closed_by: "The end of a session is announced by naming it. A bare `none` ends nothing, and a message of another session never changes a role (I2, I14).",
    },
    Text {
        id: "P4",
        title: "safety timeout that aborts a long move",
        statement: "the safety timeout does not stop a maneuver while the leader is heard",
        explanation: "The text does not say which message holds the safety timeout off; taken by the word it is the RMCM. A `move` takes 21.6 s and needs no second RMCM, so the timeout stops it half-way over the road although the leader is there and its RAM are heard.",
        closed_by: "Keep-alive: each RAM of a leader carries a heartbeat number, and T_safety restarts on each newer heartbeat of the follower's own session, not on commands alone (I10).",
    },
    Text {
        id: "P5",
        title: "two requesters that wait for each other",
        statement: "of two requesters that hear each other, one gets to lead or both give up",
        explanation: "Two robots detect a pedestrian at the same time. Each asks for help and waits for an offer; a robot that asks does not offer. They hear each other's `needHelp` for ever.",
        closed_by: "Requests are totally ordered by urgency and station id; who hears a preceding request withdraws its own and offers instead (L6).",
    },
    Text {
        id: "P6",
        title: "duplicated command that is executed twice",
        statement: "a command is started at most once",
        explanation: "The radio delivers a command twice. The follower acknowledges and starts it both times: the second start begins a maneuver anew that is half done or done.",
        closed_by: "requestIDs are compared as serial numbers within the session. A repeated command is acknowledged again and never executed again; an older one changes nothing (I4, I5).",
    },
    Text {
        id: "P7",
        title: "two leaders of one follower",
        statement: "a follower has one leader",
        explanation: "`offerHelp` names nobody. Two requesters hear the same offer, and each takes the helper as its follower. It can follow one of them; the other one leads nobody and does not know it.",
        closed_by: "An offer names the session that it is for, and a helper is reserved for that one; a leader commands only who has joined (I1, I2).",
    },
    Text {
        id: "P8",
        title: "request without end",
        statement: "a request for help comes to an end",
        explanation: "No time limit is given for HelpRequested. A requester that nobody can help asks for ever: it neither tells its application nor becomes free to help others.",
        closed_by: "HelpRequested ends at T_help at the latest, and the application is told (L1).",
    },
    Text {
        id: "P9",
        title: "offer without end",
        statement: "an offer of help comes to an end",
        explanation: "A helper offers, and the requester breaks down before it confirms. The helper stays in HelpRequested for ever: it answers no other request.",
        closed_by: "A helper reserves itself for T_offer, no longer (L1).",
    },
    Text {
        id: "P10",
        title: "lost command that is waited for for ever",
        statement: "a command is acknowledged or given up",
        explanation: "One RMCM gets lost. The text knows no repetition, so nobody says anything more: the follower's safety timeout takes it to Idle, the leader waits for the acknowledgement for ever, and with it the pedestrian at the kerb.",
        closed_by: "The leader repeats the same command after T_ack, at most N_ack times, then treats the follower as lost (I16, L2).",
    },
    Text {
        id: "P11",
        title: "acknowledgement of an earlier session",
        statement: "an acknowledgement counts only for the command that it answers",
        explanation: "Neither requestID nor jobAdviceID says of which session it is, and every leader counts from the same number. A late offer from the crossing before makes its robot a follower of this one, and a copy of the acknowledgement of command 0 from the crossing before acknowledges command 0 of this one, which nobody has heard.",
        closed_by: "Every RMCM carries the session (leader, session number), and session numbers never repeat, not even after a reboot (I6, I7, I15).",
    },
    Text {
        id: "P12",
        title: "follower that broke down and is counted on for ever",
        statement: "a leader does not count for ever on a follower that is gone",
        explanation: "The follower breaks down in the middle of its maneuver. The leader waits for a RAM with `completed`, and nothing tells it that no RAM comes any more: it stays in ManeuverExecuting for ever, and the pedestrian is on the road.",
        closed_by: "The lease on a follower runs out t_lease after the newest heartbeat that it echoed, and the corridor closes; T_exec bounds every maneuver, and a follower without a lease is dropped (I10, I11).",
    },
];

const W1_STATEMENT: &str = "who steps on the road finds the guard in place, or that guard has fallen back, finished or lost power and its leader has not been told";

/// What there is to say about a run that breaks a property of the road with a guard of this kind.
pub(super) const fn on_road(property: RoadProperty, task: Task) -> Text {
    match (property, task) {
        (RoadProperty::W1, Task::Move) => Text {
            id: "W1",
            title: "invited although the guard was sent away",
            statement: W1_STATEMENT,
            explanation: "The pedestrian is invited onto a road on which nobody is at their side. A late RAM with `none`, as every idle robot sends it, has sent the escort away in the middle of its maneuver. The leader neither meant that nor hears of it: it takes the acknowledgement that is still on its way for a promise, and invites.",
            closed_by: "The end of a session is announced by naming it, so that a bare `none` sends nobody away; the corridor is open only while progress is reported and the lease stands, and an acknowledgement alone opens nothing (I2, I11, W1).",
        },
        (RoadProperty::W1, Task::Block) => Text {
            id: "W1",
            title: "invited while the guard is still on its way",
            statement: W1_STATEMENT,
            explanation: "The pedestrian steps in front of the traffic that the guard has not reached yet. An acknowledgement says that a robot will go to its place, not that it is there, and the wording has no other message between the command and its completion. No message was lost or late.",
            closed_by: "Progress has a value *in position*; a task that guards from a place opens no corridor before it (I8, I11, W1).",
        },
        (RoadProperty::W2, _) => Text {
            id: "W2",
            title: "left alone in the middle of the road",
            statement: "while somebody is on the road, no guard that is able to stays away",
            explanation: "The pedestrian is half-way across when the escort stops and becomes Idle, because no RMCM came for a while. The leader is there, every message has arrived, and the escort would be free for another task at once.",
            closed_by: "Newer heartbeats hold the safety timeout off, and every end but a completed crossing carries out the task's policy: an escort brings its person to the nearer kerb, a blocker holds until the road is clear (W2).",
        },
        (RoadProperty::W3, _) => Text {
            id: "W3",
            title: "two robots that invite at one crossing",
            statement: "at one place one sign shows go, once the leader that goes behind has heard the other one twice",
            explanation: "Two robots invite people onto the same crossing, and only one of them has a guard. The helper of the first one has fallen back, detects the pedestrian itself and leads a team of its own; the first one counts on it as before. The people that the first one invites are guarded by nobody. The second one has heard the first one's RAM as a leader twice, and the wording gives it nothing to do about it.",
            closed_by: "Requests and sessions name their place. Of two leaders at one place the one behind shows stop at once and ends when its road is clear (W3).",
        },
        (RoadProperty::W4, _) => Text {
            id: "W4",
            title: "something new before the last duty is over",
            statement: "a robot begins nothing new before its fallback is finished",
            explanation: "A guard that has just been sent to a safe position begins something else, and nothing asks whether somebody is on the road beside it. A pedestrian who was invited in the meantime would be left there. In the wording the robot is Idle, and an Idle robot asks and offers.",
            closed_by: "A duty outlives its session: the robot asks and offers again only when its application says that the road is clear (W4).",
        },
        (RoadProperty::W7, _) => Text {
            id: "W7",
            title: "waiting at the kerb for ever",
            statement: "once messages arrive, and a helper is there, a request leads to a finished crossing",
            explanation: "The pedestrian waits at the kerb, two able robots beside them, and nothing will ever happen again: one command was lost, its leader waits for the acknowledgement, and its follower has gone back to Idle.",
            closed_by: "A command is repeated at most N_ack times and then given up, every stage has its time limit, and the application is told how a session ended so that it can ask again (L1, L2, W7).",
        },
    }
}

impl RoadProperty {
    /// What there is to say about it.
    pub(super) const fn text(self) -> Text {
        on_road(self, Task::Move)
    }
}

impl Hazard {
    /// What there is to say about it.
    #[must_use]
    pub const fn text(self) -> Text {
        TEXTS[self as usize]
    }
}
