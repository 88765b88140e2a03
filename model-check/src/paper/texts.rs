//! The hazards in words.

use serde::Serialize;

use super::hazards::HazardKind::{Ambiguous, Silent, Stated};
use super::hazards::{Hazard, HazardKind, Passage};
use super::readings::{OtherReading, Reading};

/// What there is to say about a hazard.
#[derive(Clone, Copy, Debug, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct Text {
    /// Its id.
    pub id: &'static str,
    /// What happens, in a few words.
    pub title: &'static str,
    /// What the text says about it.
    pub kind: HazardKind,
    /// Where the text says it, or would have to.
    #[serde(flatten)]
    pub passage: Passage,
    /// The property that it breaks.
    pub statement: &'static str,
    /// How it comes about.
    pub explanation: &'static str,
    /// What it means for a person on the road or at the kerb.
    pub person: &'static str,
    /// The rule of the protocol that closes it, with the ids of the properties that verify it.
    pub closed_by: &'static str,
    /// A reading of the text that says more, and what becomes of the hazard in it.
    #[serde(skip)]
    pub other_reading: Option<OtherReading>,
}

const fn passage(section: &'static str, paragraph: &'static str, words: &'static str) -> Passage {
    Passage {
        section,
        paragraph,
        words,
    }
}

const fn other(reading: Reading, remains: bool, says: &'static str) -> OtherReading {
    OtherReading {
        reading,
        remains,
        says,
    }
}

/// The paragraph after the times of coordination.
const RELIABILITY: &str = "the paragraph on reliability, after the coordination times";
/// The paragraph about who joins.
const COORDINATION: &str = "RAM, multi-robot coordination process, paragraph 1";

/// In the order of [`Hazard::ALL`].
const TEXTS: [Text; Hazard::ALL.len()] = [
    Text {
        id: "P1",
        title: "late acknowledgement after fallback",
        kind: Silent,
        passage: passage("III-A", RELIABILITY, "require acknowledgments"),
        statement: "an acknowledgement counts for nothing once the follower has said that it fell back from that command",
        explanation: "The follower accepts the command, its acknowledgement is late, and before it arrives the safety timeout takes the follower to its safe idle position. It says so in RAM, and the leader hears it. Then the acknowledgement arrives; its jobAdviceID is still that of the outstanding command, so the leader goes to ManeuverExecuting. The text does not say for how long an acknowledgement counts.",
        person: "The leader counts on a guard that has told it that it is not there.",
        closed_by: "A fallback is reported as `safeIdle` of that very command, which is final; the leader's lease ends before the follower can fall back, and the corridor is open only while the lease stands and progress is reported (I9, I10, I11).",
        other_reading: None,
    },
    Text {
        id: "P2",
        title: "completion from a stale RAM",
        kind: Ambiguous,
        passage: passage("III-A", "stage 4, paragraph 2", "inferred by the leader"),
        statement: "what a leader counts as completed, the follower finished",
        explanation: "The leader infers completion from position, motion state and task progression in the follower's RAM, and none of the three says of which command. A robot that blocks stands where `initialPos` has brought it: a RAM in which it stands there and has completed `initialPos`, still on its way, completes the `block` the moment it arrives.",
        person: "The leader takes the duty of a guard for done while people cross behind it: it may command that guard away.",
        closed_by: "A follower's RAM carries (session, last requestID, progress), so that a stale RAM can complete only what is completed (I8).",
        other_reading: Some(other(
            Reading::OlderRamIgnored,
            true,
            "a leader ignores a RAM that is older than one that it has heard, by the GenerationDeltaTime of section II-D. The RAM of this run is the newest that the leader has heard, so the hazard remains",
        )),
    },
    Text {
        id: "P3",
        title: "release that is the idle default",
        kind: Stated,
        passage: passage("III-A", "stage 5", "explicitly released via"),
        statement: "a maneuver that the leader counts on is not stopped by a release that the leader did not mean",
        explanation: "The release is a RAM with `helpStatus = None`, and with that RAM both robots go on broadcasting in Idle: it is also what every idle robot sends all the time. A RAM from before the association, delayed on its way, releases the follower in the middle of its maneuver. The leader knows nothing of it and counts on the maneuver.",
        person: "The guard walks away from people that the leader has let onto the road.",
        closed_by: "The end of a session is announced by naming it. A bare `none` ends nothing, and a message of another session never changes a role (I2, I14).",
        other_reading: Some(other(
            Reading::OlderRamIgnored,
            true,
            "a follower ignores a RAM that is older than one that it has heard, by the GenerationDeltaTime of section II-D. The text gives no such rule, and it does not suffice: a follower that has not heard the release still says `offerHelp`, its leader takes it again, and then the release arrives as the newest RAM that it has heard",
        )),
    },
    Text {
        id: "P4",
        title: "safety timeout that aborts a long move",
        kind: Stated,
        passage: passage("III-A", RELIABILITY, "absence of command"),
        statement: "the safety timeout does not stop a maneuver while the leader is heard",
        explanation: "What holds the safety timeout off is a command. The `Move` of the proof of concept takes 21.6 s and needs no second command, so a shorter timeout stops it half-way although the leader is there and its RAM are heard. The text gives no value; with a timeout that is longer than every maneuver, a follower goes on for as long when its leader is gone.",
        person: "The escort leaves the pedestrian in the middle of the road while nothing is wrong.",
        closed_by: "Keep-alive: each RAM of a leader carries a heartbeat number, and T_safety restarts on each newer heartbeat of the follower's own session, not on commands alone (I10).",
        other_reading: None,
    },
    Text {
        id: "P5",
        title: "two requesters that wait for each other",
        kind: Silent,
        passage: passage("III-A", "stage 2", "transitions to the HelpRequested state"),
        statement: "of two requesters that hear each other, one gets to lead or both give up",
        explanation: "Each robot executes the same state machine, so two of them may detect a pedestrian at the same time. Each asks for help and waits for an offer, and the text lets only a robot that does not ask answer. They hear each other's `needHelp` for ever.",
        person: "The pedestrian waits at the kerb between two able robots.",
        closed_by: "Requests are totally ordered by urgency and station id; who hears a preceding request withdraws its own and offers instead (L6).",
        other_reading: None,
    },
    Text {
        id: "P6",
        title: "duplicated command that is executed twice",
        kind: Silent,
        passage: passage("III-A", "stage 4, paragraph 1", "immediately responds"),
        statement: "a command that was sent once is started at most once",
        explanation: "The radio delivers a command twice. The follower acknowledges and executes upon receiving an RMCM, and the text makes no exception for one that it knows: the second start begins a maneuver anew that is half done or done.",
        person: "An escort that is half-way across turns back to begin again, with the pedestrian beside it.",
        closed_by: "requestIDs are compared as serial numbers within the session. A repeated command is acknowledged again and never executed again; an older one changes nothing (I4, I5).",
        other_reading: None,
    },
    Text {
        id: "P7",
        title: "two leaders of one follower",
        kind: Ambiguous,
        passage: passage("II-D", COORDINATION, "respond to join"),
        statement: "a follower has one leader",
        explanation: "An answer carries `offerHelp` and a container that joins. The text names no field of that container, and stage 2 calls the answer an advertisement. Two requesters hear the same answer, and each takes the helper as its follower. It can follow one of them; the other one leads nobody and does not know it.",
        person: "One of two crossings waits for a helper that stands at the other.",
        closed_by: "An offer names the session that it is for, and a helper is reserved for that one; a leader commands only who has joined (I1, I2).",
        other_reading: Some(other(
            Reading::JoinNamesLeader,
            false,
            "the container names the leader that the robot joins, and no other requester takes the answer",
        )),
    },
    Text {
        id: "P8",
        title: "request without end",
        kind: Silent,
        passage: passage("III-A", "stage 2", "explicitly requesting for assistance"),
        statement: "a request for help comes to an end",
        explanation: "No time limit is given for HelpRequested. A requester that nobody can help asks for ever: it neither tells its application nor becomes free to help others.",
        person: "The pedestrian waits for a crossing that never comes, and the robot does not say so.",
        closed_by: "HelpRequested ends at T_help at the latest, and the application is told (L1).",
        other_reading: None,
    },
    Text {
        id: "P9",
        title: "offer without end",
        kind: Silent,
        passage: passage("III-A", "stage 2", "advertising its availability"),
        statement: "an offer of help comes to an end",
        explanation: "A helper offers, and the requester breaks down before it confirms. No end of an offer is told, so the helper advertises an availability for a request that is over. Where an offer names its leader, the helper is bound for ever; where it does not, the next requester takes an offer that was not made to it, however long ago.",
        person: "The next pedestrian's robot counts on a helper that answered somebody else.",
        closed_by: "A helper reserves itself for T_offer, no longer, and an offer echoes the heartbeat of its request (L1).",
        other_reading: Some(other(
            Reading::JoinNamesLeader,
            true,
            "the container names the leader that the robot joins. The hazard remains: the helper waits for that leader",
        )),
    },
    Text {
        id: "P11",
        title: "acknowledgement of an earlier association",
        kind: Silent,
        passage: passage("II-D", "RMCM, paragraph 2", "derived from the leader's"),
        statement: "an acknowledgement counts only for the command that it answers",
        explanation: "Neither requestID nor jobAdviceID says of which association it is, and nothing says that a leader does not count from the same number in each. A copy of the acknowledgement of command 0 from the crossing before acknowledges command 0 of this one, which nobody has heard.",
        person: "The leader lets people cross on the word of the crossing before.",
        closed_by: "Every RMCM carries the session (leader, session number), and session numbers never repeat, not even after a reboot (I6, I7, I15).",
        other_reading: Some(other(
            Reading::NewRequestIds,
            false,
            "a leader uses no requestID twice. The text does not say so; over a reboot, only something that is persisted keeps it true",
        )),
    },
    Text {
        id: "P12",
        title: "follower that broke down and is counted on for ever",
        kind: Ambiguous,
        passage: passage(
            "III-A",
            "the paragraph on the state machine",
            "communication loss or execution timeouts",
        ),
        statement: "a leader does not count for ever on a follower that is gone",
        explanation: "The follower breaks down in the middle of its maneuver. A fallback on communication loss or execution timeouts is promised, and told of the follower only. The leader waits for a RAM with `completed`, and nothing tells it that no RAM comes any more: it stays in ManeuverExecuting for ever.",
        person: "People cross beside a guard that has lost power, and the leader sends more of them.",
        closed_by: "The lease on a follower runs out t_lease after the newest heartbeat that it echoed, and the corridor closes; T_exec bounds every maneuver, and a follower without a lease is dropped (I10, I11).",
        other_reading: Some(other(
            Reading::LeaderTimesOut,
            false,
            "the leader has an execution timeout too, and may then reissue its command. It still counts on the lost follower until then, and the text gives no value",
        )),
    },
    Text {
        id: "P13",
        title: "follower that asks a lost leader for leave",
        kind: Ambiguous,
        passage: passage("III-A", RELIABILITY, "request to issue leave coordination"),
        statement: "a follower whose leader is gone becomes free",
        explanation: "The leader breaks down. The follower goes to its safe idle position, says so, and requests to leave. A request wants an answer, and the association ends by the leader's release or by the completed task: nobody is there for either. The follower stays bound for ever.",
        person: "A robot that could help the next pedestrian across stands at the kerb and follows nobody.",
        closed_by: "After T_leave without contact a follower names the session that it leaves and is free; no answer is needed (L4, L5).",
        other_reading: Some(other(
            Reading::LeaveByFollower,
            false,
            "the follower announces that it leaves, and is free",
        )),
    },
    Text {
        id: "P14",
        title: "old acknowledgement of a reissued command",
        kind: Ambiguous,
        passage: passage("III-A", RELIABILITY, "reissue commands"),
        statement: "an acknowledgement counts only for the command as it was sent last",
        explanation: "The follower has fallen back and said so, and the leader reissues its command. To reissue is to send the same command with the same requestID. The acknowledgement of the first time arrives late and acknowledges the second time, which the follower has not heard.",
        person: "The leader counts on a guard that rests in its safe idle position.",
        closed_by: "A command after a fallback has a new requestID, and an acknowledgement of an older one changes nothing; a robot whose road is not clear rejects it (I6, I7, I9).",
        other_reading: Some(other(
            Reading::NewRequestIds,
            false,
            "a reissued command has a new requestID",
        )),
    },
    W1_ESCORTED,
    W2,
    W3,
    W4,
    W7,
];

const W1_STATEMENT: &str = "who steps on the road finds the guards there, or a guard has fallen back, finished or lost power and its leader has not been told";

const W1_ESCORTED: Text = Text {
    id: "W1",
    title: "led onto the road although the leader is gone",
    kind: Stated,
    passage: passage("III-A", "stage 3", "to follow RoboDog"),
    statement: W1_STATEMENT,
    explanation: "The leader has told the pedestrian to follow the robot dog before any maneuver is commanded, and turns to the traffic. It commands the `Move`, and breaks down before the pedestrian has begun. The dog moves, and the pedestrian follows it.",
    person: "The pedestrian walks onto a road on which nobody stops the traffic: the word to go was given once, and nothing takes it back.",
    closed_by: "The pedestrian goes by the leader's sign, which is a lease: the corridor opens when every guard is engaged, and shows go only as long as the leader renews it (I11, W1, W5).",
    other_reading: None,
};

const W1_BLOCKED: Text = Text {
    id: "W1",
    title: "let across while the guard is still on its way",
    kind: Silent,
    passage: passage(
        "III-A",
        "the paragraph on two humanoids, extending FSM control",
        "forming a bidirectional safety corridor",
    ),
    statement: W1_STATEMENT,
    explanation: "`initialPos` has brought the guard to its place, and a command that comes late has let it go to its safe idle position. It acknowledges the `block` and starts back. The text does not say when the corridor that the two commands form is there: an acknowledgement says that a robot will go to its place, not that it is there.",
    person: "The pedestrian steps in front of the traffic that the guard has not reached yet.",
    closed_by: "Progress has a value *in position*; a task that guards from a place opens no corridor before it, and an acknowledgement alone opens nothing (I8, I11, W1).",
    other_reading: None,
};

const W2: Text = Text {
    id: "W2",
    title: "left alone in the middle of the road",
    kind: Stated,
    passage: passage("III-A", RELIABILITY, "transitions to a safe idle position"),
    statement: "while somebody is on the road, no guard that is able to stays away",
    explanation: "The pedestrian is half-way across beside the escort when its safety timeout runs out, because no command came for a while. The escort goes to a safe idle position. The position is safe for the robot; the text does not say what becomes of the person. The leader is there, and every message has arrived.",
    person: "The pedestrian stands alone in the middle of the road.",
    closed_by: "Newer heartbeats hold the safety timeout off, and every end but a completed crossing carries out the task's policy: an escort brings its person to the nearer kerb, a blocker holds until the road is clear (W2).",
    other_reading: None,
};

const W3: Text = Text {
    id: "W3",
    title: "two leaders that let people cross at one crossing",
    kind: Silent,
    passage: passage("II-D", COORDINATION, "Nearby robots"),
    statement: "at one place one sign shows go, once the leader that goes behind has heard the other one twice",
    explanation: "Two robots detect a pedestrian at the same crossing, and each finds a helper of its own. Each lets people cross beside its own guard, and each has heard the other one as a leader twice. A request names no place, and the text gives a leader nothing to do about another one.",
    person: "Two leaders at one crossing stop and release the same traffic without regard to each other.",
    closed_by: "Requests and sessions name their place. Of two leaders at one place the one behind shows stop at once and ends when its road is clear (W3).",
    other_reading: None,
};

const W4: Text = Text {
    id: "W4",
    title: "something new before the last duty is over",
    kind: Silent,
    passage: passage("III-A", "stage 5", "remaining available for future tasks"),
    statement: "a robot begins nothing new before its fallback is finished",
    explanation: "A robot that is still on its way to its safe idle position is released, here by a late RAM with `none`. It is Idle, and answers a request at once. The text does not say when a fallback is over, and asks nobody whether the road is clear.",
    person: "The robot falls back beside a pedestrian, and leaves them to themselves while it turns to the next.",
    closed_by: "A duty outlives its session: the robot asks and offers again only when its application says that the road is clear (W4).",
    other_reading: None,
};

const W7: Text = Text {
    id: "W7",
    title: "waiting at the kerb for ever",
    kind: Silent,
    passage: passage("III-A", "stage 2", "transitions to the HelpRequested state"),
    statement: "once messages arrive, and a helper is there, a request leads to a finished crossing",
    explanation: "Two robots see the pedestrian at the same time, and each waits for the other one's offer (P5).",
    person: "The pedestrian waits at the kerb, two able robots beside them, and nothing will ever happen again.",
    closed_by: "Of two requests the one behind is withdrawn, every stage has its time limit, and the application is told how a session ended so that it can ask again (L1, L6, W7).",
    other_reading: None,
};

impl Hazard {
    /// What there is to say about it.
    #[must_use]
    pub const fn text(self) -> Text {
        TEXTS[self as usize]
    }

    /// What there is to say about a run that brings it about, beside an escort or not.
    pub(super) const fn text_beside(self, is_escorted: bool) -> Text {
        match self {
            Self::W1 if !is_escorted => W1_BLOCKED,
            _ => self.text(),
        }
    }
}
