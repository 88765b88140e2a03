/* The scenario `pair` in Promela: one robot that detects a pedestrian, one that helps.
 *
 * Written from the text of the protocol (design section 4; README, "Where the protocol says more than
 * the paper"), not from the Rust code, so that an error in one is not repeated in the other. What is
 * modelled, what is not, and how to run it: README.md in this folder.
 *
 *      Requester  ──► air ──►  Channel  ──►  Helper          air: just sent, fate decided first
 *          ▲                   │  ▲  │          │            late: the one delayed message
 *          └───────────────────┘  ▼  └──────────┘
 *                                late
 *
 * A property that fails prints "violated I8"; a premise that is met prints "premise I8".
 */

#ifndef DETECTIONS
#define DETECTIONS 1    /* pedestrians */
#endif
#ifndef COMMANDS
#define COMMANDS 2      /* over all sessions */
#endif
#ifndef DISTURBANCES
#define DISTURBANCES 1  /* a maneuver fails, a robot leaves or becomes unavailable */
#endif
#ifndef N_ACK
#define N_ACK 1
#endif

/* Phases; IDLE is the only one that both robots have. */
#define IDLE       0
#define REQUESTING 1    /* paper: help requested */
#define LEADING    2    /* paper: role established, maneuver executing */
#define OFFERING   3
#define FOLLOWING  4

/* Progress in a RAM. */
#define NO_REPORT 0
#define EXECUTING 1
#define COMPLETED 2
#define FAILED    3
#define SAFE_IDLE 4

/* Messages by content and direction. Up to ANSWER they go to the requester. */
#define OFFER    1      /* RAM offerHelp */
#define FOLLOWER 2      /* RAM of a follower */
#define LEFT     3      /* RAM none, with a farewell */
#define ANSWER   4      /* RMCM acknowledgement or rejection */
#define NEED     5      /* RAM needHelp */
#define LEADER   6      /* RAM of a leader */
#define ENDED    7      /* RAM none, with a farewell */
#define COMMAND  8      /* RMCM command */

typedef Message {
    byte kind;
    byte session;
    byte beat;          /* LEADER: heartbeat; FOLLOWER: echo */
    byte offer;         /* OFFER: its number; LEADER: the confirmed one */
    byte request;       /* COMMAND, ANSWER: requestID; FOLLOWER: the newest accepted one */
    byte says;          /* FOLLOWER: progress; ANSWER: whether accepted */
    byte farewell       /* any RAM: session that the sender names as ended or left */
}

/* Numbers start with 1; 0 is none. Sessions of station 1 are counted, so they are their own names. */
typedef Requester {
    byte phase;
    bool unavailable;
    byte session;       /* the newest, also when it is over */
    byte farewell;      /* announced as ended */
    byte offer;         /* heard while requesting, confirmed while leading */
    bool joined;        /* the follower has taken its role */
    byte beat;          /* newest heartbeat */
    byte echoed;        /* newest one that came back */
    bool lease;
    byte newest;        /* requestID of the newest command */
    byte outstanding;   /* requestID that waits for its acknowledgement */
    byte repeats;
    byte order;         /* requestID of the newest acknowledged command */
    byte progress       /* and what was reported of it */
}

typedef Helper {
    byte phase;
    bool unavailable;
    byte session;
    byte farewell;      /* announced as left */
    byte offer;
    byte heard;         /* newest heartbeat */
    bool contact;       /* T_safety runs; otherwise T_leave */
    byte job;           /* requestID of the newest accepted command */
    byte progress;
    byte refused        /* requestID of a newer command that was rejected */
}

Requester leader;
Helper follower;

/* What application and body have been told. Commands are named by session and requestID. */
bool corridor;
byte running;

chan air = [4] of { Message };
Message late;

byte detections = DETECTIONS;
byte commands = COMMANDS;
byte disturbances = DISTURBANCES;

/* What has happened: one bit per command; the offer that each session has confirmed. */
byte commanded, accepted, started, finished, fallen_back;
byte confirmed[DETECTIONS + 1];

/* Not 0 once applications are silent and the radio is dead; then it counts what still happens. */
byte quiet;
#define QUIET_STEPS_MAX 20

hidden Message m;       /* of use within one step alone */
hidden byte i;
hidden short present;

#define NAME(s, q)    (((s) - 1) * COMMANDS + (q))
#define BIT(s, q)     (1 << (NAME(s, q) - 1))
#define HAS(set, s, q) ((q) != 0 && ((set) & BIT(s, q)) != 0)

#define FOLLOWS       (follower.phase == FOLLOWING)
#define EXECUTES      (FOLLOWS && follower.job != 0 && follower.progress == EXECUTING)
#define ORDER_RUNS    (leader.order != 0 && leader.progress <= EXECUTING)
#define ENGAGED       (leader.phase == LEADING && leader.outstanding == 0 && leader.order != 0 \
                       && leader.progress == EXECUTING && leader.lease)
#define HEARS_LEADER  (follower.phase >= OFFERING && follower.session == m.session)
#define STEP          (empty(air) && quiet == 0)
#define ALL_IDLE      (leader.phase == IDLE && follower.phase == IDLE)

c_decl {
    static void note(const char *what, int property)
    {
        static unsigned seen[2];
        unsigned bit = 1u << property;
        if (!(seen[what[0] == 'v'] & bit)) {
            seen[what[0] == 'v'] |= bit;
            printf("%s %c%d\n", what, property == 20 ? 'L' : 'I', property == 20 ? 7 : property);
        }
    }
}
#define L7 20

#define CHECK(property, holds) \
    if \
    :: !(holds) -> c_code { note("violated", property); }; assert(false) \
    :: else \
    fi
#define PREMISE(property, met) \
    if \
    :: (met) -> c_code { note("premise", property); } \
    :: else \
    fi

/* ------------------------------------------------------------------ names */

/* Heartbeats and offers are only compared, so each becomes its rank among those that still occur. */
#define BELOW(v, k) ((v) > k && ((present >> k) & 1))
#define RANK(v) ((v) == 0 -> 0 : 1 + BELOW(v, 1) + BELOW(v, 2) + BELOW(v, 3) + BELOW(v, 4) \
                 + BELOW(v, 5) + BELOW(v, 6) + BELOW(v, 7) + BELOW(v, 8) + BELOW(v, 9))

#define EACH_ON_AIR(change) \
    i = len(air); \
    do \
    :: i > 0 -> air ? m; change; air ! m; i-- \
    :: else -> break \
    od
#define EACH_SESSION(change) \
    i = 1; \
    do \
    :: i <= DETECTIONS -> change; i++ \
    :: else -> break \
    od

inline rank_beats() {
    present = (1 << leader.beat) | (1 << leader.echoed) | (1 << follower.heard) | (1 << late.beat);
    EACH_ON_AIR(present = present | (1 << m.beat));
    leader.beat = RANK(leader.beat);
    leader.echoed = RANK(leader.echoed);
    follower.heard = RANK(follower.heard);
    late.beat = RANK(late.beat);
    EACH_ON_AIR(m.beat = RANK(m.beat))
}

inline collect_offers() {
    present = (1 << leader.offer) | (1 << follower.offer) | (1 << late.offer);
    EACH_SESSION(present = present | (1 << confirmed[i]));
    EACH_ON_AIR(present = present | (1 << m.offer))
}

inline rank_offers() {
    collect_offers();
    leader.offer = RANK(leader.offer);
    follower.offer = RANK(follower.offer);
    late.offer = RANK(late.offer);
    EACH_SESSION(confirmed[i] = RANK(confirmed[i]));
    EACH_ON_AIR(m.offer = RANK(m.offer))
}

/* ------------------------------------------------------------- properties */

inline check_state() {
    /* I1 beyond the shape of the model: whom a follower follows has opened that session. */
    PREMISE(1, leader.phase == LEADING && FOLLOWS);
    CHECK(1, !FOLLOWS || (follower.session != 0 && follower.session <= leader.session));
    PREMISE(2, FOLLOWS);
    CHECK(2, quiet || !FOLLOWS || confirmed[follower.session] == follower.offer);
    PREMISE(6, leader.phase == LEADING && leader.order != 0);
    CHECK(6, quiet || leader.phase != LEADING || leader.order == 0
             || HAS(accepted, leader.session, leader.order));
    CHECK(6, quiet || running == 0 || (accepted & (1 << (running - 1))));
    PREMISE(8, leader.phase == LEADING && leader.progress == COMPLETED);
    CHECK(8, quiet || leader.phase != LEADING || leader.progress != COMPLETED
             || HAS(finished, leader.session, leader.order));
    PREMISE(9, fallen_back != 0);
    CHECK(9, quiet || running == 0 || !(fallen_back & (1 << (running - 1))));
    PREMISE(11, corridor);
    CHECK(11, !corridor || ENGAGED);
    PREMISE(12, !ALL_IDLE);
    PREMISE(14, running != 0);
    CHECK(14, running == (EXECUTES -> NAME(follower.session, follower.job) : 0));
    PREMISE(16, leader.repeats == N_ACK);
    CHECK(16, leader.repeats <= N_ACK);
    CHECK(L7, quiet <= QUIET_STEPS_MAX)
}

inline clear_m() {
    m.kind = 0; m.session = 0; m.beat = 0; m.offer = 0; m.request = 0; m.says = 0; m.farewell = 0
}

/* Ends every step. The corridor closes in the step in which the follower stops to be engaged. */
inline settle() {
#ifndef CORRIDOR_STAYS_OPEN
    if
    :: corridor && !ENGAGED -> corridor = false
    :: else
    fi;
#endif
    rank_beats();
    rank_offers();
    quiet = quiet + (quiet > 0);
    check_state();
    clear_m()
}

/* ---------------------------------------------------------------- sending */

inline transmit() {
    if
    :: m.kind != 0 && quiet == 0 -> air ! m
    :: else
    fi
}

inline send_leader_ram() {
    clear_m();
    m.farewell = leader.farewell;
    if
    :: leader.phase == REQUESTING -> m.kind = NEED; m.session = leader.session
    :: leader.phase == LEADING ->
        m.kind = LEADER; m.session = leader.session; m.beat = leader.beat; m.offer = leader.offer
    :: leader.phase == IDLE && leader.farewell != 0 -> m.kind = ENDED
    :: else
    fi;
    transmit()
}

inline send_follower_ram() {
    clear_m();
    m.farewell = follower.farewell;
    if
    :: follower.phase == OFFERING ->
        m.kind = OFFER; m.session = follower.session; m.offer = follower.offer
    :: follower.phase == FOLLOWING ->
        m.kind = FOLLOWER; m.session = follower.session; m.beat = follower.heard;
        m.request = follower.job; m.says = follower.progress
    :: follower.phase == IDLE && follower.farewell != 0 -> m.kind = LEFT
    :: else
    fi;
    transmit()
}

inline send_command() {
    clear_m();
    m.kind = COMMAND; m.session = leader.session; m.request = leader.outstanding;
    commanded = commanded | (quiet -> 0 : BIT(leader.session, leader.outstanding));
    transmit()
}

/* Answers the command in m; m stays as it is. */
inline send_answer(yes) {
    m.kind = ANSWER; m.says = yes; transmit(); m.kind = COMMAND;
    accepted = accepted | ((yes && !quiet) -> BIT(m.session, m.request) : 0)
}

/* -------------------------------------------------------------- requester */

inline end_session() {
    leader.phase = IDLE;
    leader.farewell = leader.session;
    leader.offer = 0; leader.joined = 0; leader.beat = 0; leader.echoed = 0; leader.lease = 0;
    leader.newest = 0; leader.outstanding = 0; leader.repeats = 0;
    leader.order = 0; leader.progress = NO_REPORT;
#ifndef CORRIDOR_STAYS_OPEN
    corridor = false;
#endif
    send_leader_ram()
}

inline acknowledge() {
    leader.order = leader.outstanding; leader.progress = NO_REPORT;
    leader.outstanding = 0; leader.repeats = 0
}

inline hear_follower() {
    leader.joined = true;
    if
    :: m.beat > leader.echoed -> leader.echoed = m.beat; leader.lease = true
    :: else
    fi;
#ifdef ANY_PROGRESS
    /* No request numbers in RAM: progress counts for the newest acknowledged command. */
    m.request = (m.request != 0 && leader.order != 0 -> leader.order : m.request);
#endif
    if
    :: m.request != 0 && m.request == leader.outstanding -> acknowledge()
    :: else
    fi;
    if
    :: m.request != 0 && m.request == leader.order && ORDER_RUNS -> leader.progress = m.says
    :: else
    fi
}

inline hear_answer() {
    PREMISE(7, leader.phase != LEADING || m.session != leader.session
               || m.request != leader.outstanding);
#ifdef ANY_ACKNOWLEDGEMENT
    if
    :: leader.phase == LEADING && m.session == leader.session && leader.outstanding != 0 ->
        CHECK(7, m.request == leader.outstanding);
#else
    if
    :: leader.phase == LEADING && m.session == leader.session && m.request == leader.outstanding ->
#endif
        if
        :: m.says -> acknowledge()
        :: else -> leader.outstanding = 0; leader.repeats = 0
        fi
    :: else
    fi
}

inline requester_hears() {
    /* A farewell first: a helper may have left and offer again in one RAM. */
    if
    :: m.farewell != 0 && m.farewell == leader.session && leader.phase == REQUESTING ->
        leader.offer = 0
    :: m.farewell != 0 && m.farewell == leader.session && leader.phase == LEADING ->
        end_session()
    :: else
    fi;
    if
    :: m.kind == OFFER && leader.phase == REQUESTING && m.session == leader.session ->
        leader.offer = m.offer
    :: m.kind == FOLLOWER && leader.phase == LEADING && m.session == leader.session ->
        hear_follower()
    :: m.kind == ANSWER -> hear_answer()
    :: else
    fi
}

#define REQUESTER_IS_BOUND (leader.phase != IDLE || leader.farewell != 0)

inline confirm() {
    leader.phase = LEADING; leader.beat = 1;
    confirmed[leader.session] = leader.offer;
    send_leader_ram()
}

inline acknowledgement_expires() {
    if
#ifdef ONE_REPEAT_MORE
    :: leader.repeats <= N_ACK ->
#else
    :: leader.repeats < N_ACK ->
#endif
        leader.repeats++; send_command()
    :: else -> end_session()
    fi
}

inline next_command() {
    leader.newest++; leader.outstanding = leader.newest; leader.repeats = 0;
    send_command()
}

/* Timers first, then the application. A session can end at any time: by T_help or the loss of the
 * follower, by the identity lock, or because the application says so. The last two are left out when
 * it is asked whether robots come to rest by themselves. */
#define SESSION_MAY_END (leader.phase != IDLE \
                         && (!quiet || leader.phase == REQUESTING || !leader.lease))

active proctype RequesterRobot() {
end:
    do
    :: atomic {
        if
        :: d_step { empty(air) && SESSION_MAY_END -> end_session() }
        :: d_step { STEP && leader.phase == REQUESTING && leader.offer != 0 -> confirm() }
        :: d_step { STEP && (leader.phase != IDLE || leader.farewell != 0) ->     /* RAM period */
            leader.beat = leader.beat + (leader.phase == LEADING); send_leader_ram() }
        :: d_step { empty(air) && leader.farewell != 0 -> leader.farewell = 0 }
        :: d_step { empty(air) && leader.lease -> leader.lease = false }
        :: d_step { empty(air) && leader.phase == LEADING && ORDER_RUNS ->        /* T_exec */
            leader.progress = FAILED }
        :: d_step { empty(air) && leader.outstanding != 0 -> acknowledgement_expires() }

        :: d_step { STEP && leader.phase == IDLE && !leader.unavailable && detections > 0 ->
            detections--; leader.session++; leader.phase = REQUESTING; send_leader_ram() }
        :: d_step { STEP && leader.joined && leader.outstanding == 0 && commands > 0 ->
            commands--; next_command() }
        :: d_step { STEP && ENGAGED && !corridor -> corridor = true }
        :: d_step { STEP && corridor -> corridor = false }
        :: d_step { STEP && disturbances > 0 && !leader.unavailable ->
            disturbances--; leader.unavailable = true;
            if
            :: leader.phase != IDLE -> end_session()
            :: else
            fi;
            }
        :: d_step { STEP && leader.unavailable -> leader.unavailable = false }
        fi;
        d_step { settle() }
       }
    od
}

/* ----------------------------------------------------------------- helper */

/* What the body is told. */
inline start() {
    PREMISE(3, true);
    PREMISE(4, true);
    CHECK(3, HAS(commanded, m.session, m.request));
    CHECK(4, !HAS(started, m.session, m.request));
    /* Of the commands of the session, neither this one nor a newer one was started before. */
    PREMISE(5, (started >> (NAME(m.session, 1) - 1)) & ((1 << COMMANDS) - 1));
    CHECK(5, ((started >> (NAME(m.session, m.request) - 1)) & ((1 << (COMMANDS - m.request + 1)) - 1)) == 0);
    started = started | BIT(m.session, m.request);
    running = NAME(m.session, m.request)
}

inline stop() {
#ifndef RELEASED_GOES_ON
    running = 0;
#endif
    skip
}

/* The part in the session is over; the leader knows already or need not know. */
inline release() {
    if
    :: EXECUTES -> stop()
    :: else
    fi;
    follower.phase = IDLE; follower.session = 0; follower.offer = 0; follower.heard = 0;
    follower.contact = 0; follower.job = 0; follower.progress = NO_REPORT; follower.refused = 0
}

/* The part in the session is over, and its leader is told. */
inline leave() {
    follower.farewell = follower.session;
    release();
    send_follower_ram()
}

inline name_as_left() {
    if
    :: follower.farewell != m.session -> follower.farewell = m.session; send_follower_ram()
    :: else
    fi
}

inline make_offer() {
    follower.phase = OFFERING; follower.session = m.session;
    follower.farewell = (follower.farewell == m.session -> 0 : follower.farewell);
    /* A number that no other offer has. */
    collect_offers();
    follower.offer = 1;
    do
    :: (present >> follower.offer) != 0 -> follower.offer++
    :: else -> break
    od;
    send_follower_ram()
}

inline join() {
    follower.phase = FOLLOWING; follower.heard = m.beat; follower.contact = true;
    send_follower_ram()
}

inline hear_leader() {
    if
    :: HEARS_LEADER && m.offer == follower.offer && follower.phase == OFFERING -> join()
    :: HEARS_LEADER && m.offer == follower.offer && follower.phase == FOLLOWING ->
        if
        :: m.beat > follower.heard -> follower.heard = m.beat; follower.contact = true
        :: else
        fi
    :: else ->
        /* Confirmed for an offer that does not stand any more. */
        if
        :: HEARS_LEADER -> release()
        :: else
        fi;
        name_as_left()
    fi
}

inline take_command() {
    /* Acknowledged before it is started; the RAM reports it. */
    follower.contact = true;
    if
    :: follower.unavailable -> follower.refused = m.request; send_answer(false)
    :: else ->
        send_answer(true);
        if
        :: EXECUTES -> stop()
        :: else
        fi;
        follower.job = m.request; follower.progress = EXECUTING; follower.refused = 0;
        start();
        send_follower_ram()
    fi
}

inline hear_command() {
#ifdef ANY_SESSION
    m.session = (FOLLOWS -> follower.session : m.session);
#endif
    if
    :: FOLLOWS && HEARS_LEADER ->
        if
        :: m.request == follower.refused -> send_answer(false)
        :: m.request != follower.refused && m.request == follower.job ->
            send_answer(true);
#ifdef NO_MEMORY_OF_REPEATED
            start()
#endif
        :: m.request > follower.job && m.request > follower.refused -> take_command()
        :: else ->
#ifdef NO_ORDER_OF_REQUESTS
            start()
#else
            skip
#endif
        fi
    :: follower.phase == OFFERING && HEARS_LEADER -> skip    /* the leader will repeat it */
    :: !HEARS_LEADER -> name_as_left()
    fi
}

inline helper_hears() {
    if
    :: m.farewell != 0 && m.farewell == follower.session -> release()
    :: else
    fi;
    if
    :: m.kind == NEED && follower.phase == IDLE && !follower.unavailable -> make_offer()
#ifdef NO_CONFIRMATION
    :: m.kind == NEED && follower.phase == OFFERING && HEARS_LEADER -> join()
#endif
    :: m.kind == LEADER -> hear_leader()
    :: m.kind == COMMAND -> hear_command()
    :: else
    fi
}

inline finish(how) {
    follower.progress = how;
    running = 0;
    send_follower_ram()
}

inline safety_expires() {
    follower.contact = false;
    if
    :: EXECUTES ->
        fallen_back = fallen_back | (quiet -> 0 : BIT(follower.session, follower.job));
        finish(SAFE_IDLE)
    :: else
    fi
}

inline become_unavailable() {
    follower.unavailable = true;
    if
    :: EXECUTES -> stop(); follower.progress = FAILED; send_follower_ram()
    :: !EXECUTES && follower.phase != IDLE -> leave()
    :: else
    fi
}

#ifdef NO_FOLLOWER_TIMERS
#define TIMERS_RUN (!FOLLOWS)
#else
#define TIMERS_RUN true
#endif

active proctype HelperRobot() {
end:
    do
    :: atomic {
        if
        :: d_step { empty(air) && follower.phase == OFFERING -> release() }    /* T_offer */
        :: d_step { empty(air) && FOLLOWS && follower.contact && TIMERS_RUN -> safety_expires() }
        :: d_step { empty(air) && FOLLOWS && !follower.contact && TIMERS_RUN -> leave() }
        :: d_step { STEP && follower.phase != IDLE && TIMERS_RUN -> leave() }  /* identity lock */
        :: d_step { STEP && (follower.phase != IDLE || follower.farewell != 0) && TIMERS_RUN ->
            send_follower_ram() }                                              /* RAM period */
        :: d_step { empty(air) && follower.farewell != 0 && TIMERS_RUN -> follower.farewell = 0 }

        :: d_step { STEP && EXECUTES ->
            finished = finished | BIT(follower.session, follower.job); finish(COMPLETED) }
        :: d_step { STEP && EXECUTES && disturbances > 0 -> disturbances--; finish(FAILED) }
        :: d_step { STEP && follower.phase != IDLE && disturbances > 0 -> disturbances--; leave() }
        :: d_step { STEP && disturbances > 0 && !follower.unavailable ->
            disturbances--; become_unavailable() }
        :: d_step { STEP && follower.unavailable -> follower.unavailable = false }
        fi;
        d_step { settle() }
       }
    od
}

/* ---------------------------------------------------------------- channel */

inline copy(from, to) {
    to.kind = from.kind; to.session = from.session; to.beat = from.beat; to.offer = from.offer;
    to.request = from.request; to.says = from.says; to.farewell = from.farewell
}

inline forget_late() {
    late.kind = 0; late.session = 0; late.beat = 0; late.offer = 0; late.request = 0; late.says = 0;
    late.farewell = 0
}

#define DELIVER       1
#define LOSE          2
#define DELAY         3
#define DELIVER_LATE  4
#define DELIVER_AGAIN 5     /* late, and it stays on its way */
#define LOSE_LATE     6

inline take(fate) {
    if
    :: fate <= DELAY -> air ? m
    :: else -> copy(late, m)
    fi;
    if
    :: fate == DELAY -> copy(m, late)
    :: fate == DELIVER_LATE || fate == LOSE_LATE -> forget_late()
    :: else
    fi;
    if
    :: fate == DELIVER || fate == DELIVER_LATE || fate == DELIVER_AGAIN -> skip
    :: else -> clear_m()
    fi
}

/* What was just sent arrives, gets lost or is delayed, before anything else happens. A delayed message
 * arrives at any time, as often as the channel likes, or never. */
active proctype Channel() {
    byte fate;
end:
    do
    :: atomic {
        if
        :: nempty(air) -> fate = DELIVER
        :: nempty(air) -> fate = LOSE
        :: nempty(air) && late.kind == 0 -> fate = DELAY
        :: STEP && late.kind != 0 -> fate = DELIVER_LATE
        :: STEP && late.kind != 0 -> fate = DELIVER_AGAIN
        :: STEP && late.kind != 0 -> fate = LOSE_LATE
        fi;
        d_step {
            take(fate); fate = 0;
            if
            :: m.kind == 0
            :: m.kind != 0 && m.kind <= ANSWER -> requester_hears()
            :: else -> helper_hears()
            fi;
            settle()
        }
       }
    od
}

/* ------------------------------------------------------------------- rest */

/* From any state: if the radio is dead and the applications are silent from now on, timers alone must
 * bring both robots to rest, and after finitely many steps. That is more than I12 and L7 ask for. */
active proctype Rest() {
end:
    d_step { STEP ->
        quiet = 1; forget_late();
        commanded = 0; accepted = 0; started = 0; finished = 0; fallen_back = 0;
        detections = 0; commands = 0; disturbances = 0;
        EACH_SESSION(confirmed[i] = 0);
        settle() };
    d_step { timeout -> CHECK(12, ALL_IDLE); CHECK(L7, ALL_IDLE) }
}
