//! The rules of the protocol's page, and what of them a tester without a look inside cannot judge.

/// A rule.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Rule {
    /// Its id in the index of the protocol's page.
    pub id: &'static str,
    /// Its text there.
    pub says: &'static str,
    /// Why nothing of it can be judged from outside, or what of it cannot.
    pub unjudged: Option<&'static str>,
}

/// A table of rules: the id, what it says, and why nothing of it can be judged, or what of it cannot.
macro_rules! rules {
    (@) => { None };
    (@ $why:literal) => { Some($why) };
    ($($id:literal: $says:literal $(but $why:literal)?;)*) => {
        &[$(Rule { id: $id, says: $says, unjudged: rules!(@ $($why)?) }),*]
    };
}

/// All of them, in order. A test compares them with the page.
pub const RULES: &[Rule] = rules! {
    "R1": "A message of another session moves no part; numbers of sessions and offers never repeat.";
    "R2": "A robot follows only a leader that lists the offer which it made and which stands.";
    "R3": "Offers are ordered by number, lapse on both sides without a heartbeat, and fit the lease."
        but "the lapse of an offer at the requester: who is chosen afterwards does not show it";
    "R4": "A requester selects the best offers after `t_select`, or at once when all have answered.";
    "R5": "A request ends at `t_help`.";
    "R6": "Requests and leaders compete at one place. The one behind gives way at the second message of those before it, whichever they are."
        but "another place, where the robot does not say which is its own";
    "R7": "A follower acknowledges a command before it starts."
        but "the start of the body itself: the air tells the report of it, and that comes after";
    "R8": "A command is started at most once, and only if it is newer than all before."
        but "a second start of a body that is under way: it moves before and after";
    "R9": "An answer counts only for the command that is outstanding.";
    "R10": "A command is repeated after `t_ack`, `n_ack` times at most; then the follower is given up.";
    "R11": "Completion and position are read from a RAM that names session, command and progress."
        but "what the leader's application makes of it, but for the sign, where RAM tell what it shows";
    "R12": "The safety timer restarts in full on a newer heartbeat or command, and on nothing else.";
    "R13": "A lease counts from when the echoed heartbeat was sent, and ends before the follower's safety timer."
        but "the lease itself, but for the sign that ends with it and the follower that is dropped after it";
    "R14": "Without contact a follower falls back by its task's policy, and leaves after `t_leave`."
        but "which policy it is: the air tells that a body falls back, not how";
    "R15": "What fell back is never executed again.";
    "R16": "The corridor opens only over guards in position with time enough to cross, and closes with a reason."
        but "the sign, where RAM do not tell what it shows; the reason; the time that is left to cross";
    "R17": "*Go* is a lease that ends by itself."
        but "the sign, where RAM do not tell what it shows; the sign of a leader that hangs, for it sends no RAM";
    "R18": "While people may be on the road no guard is commanded away and no session is renewed."
        but "whether people are on the road, where RAM do not tell what the sign shows; the renewal after 127 commands";
    "R19": "Every end but a completed crossing applies the policy, and says how it ended."
        but "which policy it is: the air tells that a body falls back, not how";
    "R20": "A duty outlives its session until the application says that the road is clear.";
    "R21": "What is left or ended is named for `t_farewell`.";
    "R22": "A follower that goes leaves the records of the others as they are."
        but "the leases on the others: the next echo renews them";
    "R23": "The identity is locked while a session knows the robot by it, for at most `t_lock`."
        but "all of it: nothing that is sent or told makes a robot change its pseudonym, and `t_lock` is five minutes";
    "R24": "An unavailable robot says so, and fails or leaves what it is in.";
    "R25": "A new boot counter is asked for before the numbers of the old one are used up."
        but "all of it: it takes more than 32,000 sessions or offers";
    "R26": "Every input in every state has a defined outcome; what is ignored changes nothing."
        but "states that no message tells";
    "R27": "A robot that falls back takes the same task of the same session on again. That is its duty and no new one; every other command is refused."
        but "all of it: no play gives the same command again to a robot that falls back; the others are rejected by R20";
    "R28": "A place that a guard leaves closes the corridor in the step in which the leader hears of it. That the guard is there again counts by a newer echo alone."
        but "all of it: no play tells a robot that its body has left its place; R16 judges the sign by echoes";
    "R29": "A follower that sees somebody on the road falls back at every end of its session, also at a completed one."
        but "all of it: no play tells a robot that somebody is on the road";
};

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
