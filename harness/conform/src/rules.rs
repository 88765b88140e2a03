//! The rules of the protocol's page, and what of them a tester without a look inside cannot judge.

/// A rule.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Rule {
    /// Its id in the index of the protocol's page.
    pub id: &'static str,
    /// What it says there.
    pub says: &'static str,
    /// Why nothing of it can be judged from outside, or what of it cannot.
    pub unjudged: Option<&'static str>,
}

/// All of them, in order. A test compares them with the page.
pub const RULES: &[Rule] = &[
    Rule {
        id: "R1",
        says: "A message of another session moves no part; numbers of sessions and offers never repeat.",
        unjudged: None,
    },
    Rule {
        id: "R2",
        says: "A robot follows only a leader that lists the offer which it made and which stands.",
        unjudged: None,
    },
    Rule {
        id: "R3",
        says: "Offers are ordered by number, lapse on both sides without a heartbeat, and fit the lease.",
        unjudged: Some(
            "the lapse of an offer at the requester: who is chosen afterwards does not show it",
        ),
    },
    Rule {
        id: "R4",
        says: "A requester selects the best offers after `t_select`, or at once when all have answered.",
        unjudged: None,
    },
    Rule {
        id: "R5",
        says: "A request ends at `t_help`.",
        unjudged: None,
    },
    Rule {
        id: "R6",
        says: "Requests and leaders compete at one place. The one behind gives way once it has heard the rival beat.",
        unjudged: Some("another place, where the robot does not say which is its own"),
    },
    Rule {
        id: "R7",
        says: "A follower acknowledges a command before it starts.",
        unjudged: Some(
            "the start of the body itself: the air tells the report of it, and that comes after",
        ),
    },
    Rule {
        id: "R8",
        says: "A command is started at most once, and only if it is newer than all before.",
        unjudged: Some("a second start of a body that is under way: it moves before and after"),
    },
    Rule {
        id: "R9",
        says: "An answer counts only for the command that is outstanding.",
        unjudged: None,
    },
    Rule {
        id: "R10",
        says: "A command is repeated after `t_ack`, `n_ack` times at most; then the follower is given up.",
        unjudged: None,
    },
    Rule {
        id: "R11",
        says: "Completion and position are read from a RAM that names session, command and progress.",
        unjudged: Some(
            "what the leader's application makes of it, but for the sign, where RAM tell what it shows",
        ),
    },
    Rule {
        id: "R12",
        says: "The safety timer restarts in full on a newer heartbeat or command, and on nothing else.",
        unjudged: None,
    },
    Rule {
        id: "R13",
        says: "A lease counts from when the echoed heartbeat was sent, and ends before the follower's safety timer.",
        unjudged: Some(
            "the lease itself, but for the sign that ends with it and the follower that is dropped after it",
        ),
    },
    Rule {
        id: "R14",
        says: "Without contact a follower falls back by its task's policy, and leaves after `t_leave`.",
        unjudged: Some("which policy it is: the air tells that a body falls back, not how"),
    },
    Rule {
        id: "R15",
        says: "What fell back is never executed again.",
        unjudged: None,
    },
    Rule {
        id: "R16",
        says: "The corridor opens only over guards in position with time enough to cross, and closes with a reason.",
        unjudged: Some(
            "the sign, where RAM do not tell what it shows; the reason; the time that is left to cross",
        ),
    },
    Rule {
        id: "R17",
        says: "*Go* is a lease that ends by itself.",
        unjudged: Some(
            "the sign, where RAM do not tell what it shows; the sign of a leader that hangs, for it sends no RAM",
        ),
    },
    Rule {
        id: "R18",
        says: "While people may be on the road no guard is commanded away and no session is renewed.",
        unjudged: Some(
            "whether people are on the road, where RAM do not tell what the sign shows; the renewal after 127 commands",
        ),
    },
    Rule {
        id: "R19",
        says: "Every end but a completed crossing applies the policy, and says how it ended.",
        unjudged: Some("which policy it is: the air tells that a body falls back, not how"),
    },
    Rule {
        id: "R20",
        says: "A duty outlives its session until the application says that the road is clear.",
        unjudged: None,
    },
    Rule {
        id: "R21",
        says: "What is left or ended is named for `t_farewell`.",
        unjudged: None,
    },
    Rule {
        id: "R22",
        says: "A follower that goes leaves the records of the others as they are.",
        unjudged: Some("the leases on the others: the next echo renews them"),
    },
    Rule {
        id: "R23",
        says: "The identity is locked while a session knows the robot by it, for at most `t_lock`.",
        unjudged: Some(
            "all of it: nothing that is sent or told makes a robot change its pseudonym, and `t_lock` is five minutes",
        ),
    },
    Rule {
        id: "R24",
        says: "An unavailable robot says so, and fails or leaves what it is in.",
        unjudged: None,
    },
    Rule {
        id: "R25",
        says: "A new boot counter is asked for before the numbers of the old one are used up.",
        unjudged: Some("all of it: it takes more than 32,000 sessions or offers"),
    },
    Rule {
        id: "R26",
        says: "Every input in every state has a defined outcome; what is ignored changes nothing.",
        unjudged: Some("states that no message tells"),
    },
];

impl Rule {
    /// The rule of this id, in capitals or not.
    #[must_use]
    pub fn of_id(id: &str) -> Option<&'static Self> {
        RULES.iter().find(|rule| rule.id.eq_ignore_ascii_case(id))
    }

    /// Whether nothing of it can be judged.
    #[must_use]
    pub fn is_beyond(&self) -> bool {
        self.unjudged
            .is_some_and(|why| why.starts_with("all of it"))
    }
}
