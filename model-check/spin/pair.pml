/* The scenario `pair` in Promela: one robot that detects a pedestrian, one that helps, one who crosses.
 *
 * Its rules are those of the protocol's text (README, "Where the protocol says more than the paper"); it
 * shares no line with the Rust code. How independent it is of that, what is
 * modelled, what is not, and how to run it: README.md in this folder.
 *
 *      Requester  ──► air ──►  Channel  ──►  Helper          air: just sent, fate decided first
 *          ▲                   │  ▲  │          │            late: the one delayed message
 *          └───────────────────┘  ▼  └──────────┘
 *          │                     late           │
 *        sign ──►  Pedestrian  ──►  road  ◄── body
 *
 * Each step of a robot is one atomic step: an input, what the robot does with it, and `settle`.
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
#ifndef LOSSES
#define LOSSES 1        /* messages that get lost; 255 at most */
#endif
#ifndef DELAYED
#define DELAYED 1       /* messages that are delayed at a time; 0 or 1 */
#endif
#ifndef N_ACK
#define N_ACK 1
#endif
#ifndef HOLDING
#define HOLDING 0       /* 1: the task guards from a place (block); 0: on the way (move) */
#endif

/* Phases; IDLE is the only one that both robots have. */
#define IDLE       0
#define REQUESTING 1    /* paper: help requested */
#define LEADING    2    /* paper: role established, maneuver executing */
#define OFFERING   3
#define FOLLOWING  4

/* Progress in a RAM; the last one is the leader's own. */
#define NO_REPORT   0
#define EXECUTING   1
#define IN_POSITION 2
#define COMPLETED   3
#define FAILED      4
#define SAFE_IDLE   5
#define OVER_TIME   6   /* T_exec ran out */

/* How a session ends. */
#define CROSSED 1       /* the road is clear: followers are free */
#define ABORTED 2       /* any other end: followers fall back */

/* The corridor as its leader knows it. */
#define CLEAR    0
#define OPEN     1
#define CLEARING 2      /* nobody may cross any more, and somebody may be on the road */

/* What a body does. */
#define PARKED       0
#define UNDER_WAY    1
#define IN_PLACE     2
#define FALLING_BACK 3
#define STANDS       4  /* it has finished, failed, or finished its fallback */

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
    byte beat;          /* NEED, LEADER: heartbeat; OFFER, FOLLOWER: echo */
    byte offer;         /* OFFER: its number; LEADER: the confirmed one */
    byte request;       /* COMMAND, ANSWER: requestID; FOLLOWER: the newest accepted one */
    byte says;          /* FOLLOWER: progress; ANSWER: whether accepted */
    byte farewell;      /* any RAM: session that the sender names as ended or left, */
    byte ending;        /* how it ended, */
    byte left_offer     /* by which offer it had a part in it */
}

/* Numbers start with 1; 0 is none. Sessions of station 1 are counted, so they are their own names. */
typedef Requester {
    byte phase;
    bool unavailable;
    bool lock_is_over;  /* the identity lock ran out, and a farewell still stands */
    bool duty;          /* led a session that ended while somebody may have been on the road */
    byte session;       /* the newest, also when it is over */
    byte farewell;      /* announced as ended */
    byte ending;
    byte offer;         /* heard while requesting, confirmed while leading */
    bool joined;        /* the follower has taken its role */
    byte beat;          /* newest heartbeat, of the request and then of the leader */
    byte echoed;        /* newest one that came back, in the offer or from the follower */
    bool lease;
    byte newest;        /* requestID of the newest command */
    byte outstanding;   /* requestID that waits for its acknowledgement */
    byte repeats;
    byte order;         /* requestID of the newest acknowledged command */
    byte progress;      /* and what was reported of it */
    byte corridor
}

typedef Helper {
    byte phase;
    bool unavailable;
    bool lock_is_over;
    bool duty;          /* its body falls back, or nobody has said yet that the road is clear */
    byte session;
    byte farewell;      /* announced as left, */
    byte left_offer;    /* by this offer or an earlier one */
    byte offer;
    byte next;          /* number of the next offer */
    byte heard;         /* newest heartbeat */
    bool contact;       /* T_safety runs; otherwise T_leave */
    byte job;           /* requestID of the newest accepted command */
    byte progress;
    byte refused        /* requestID of a newer command that was rejected */
}

Requester leader;
Helper follower;

/* The road: what people see, what the body does and by which command, who is on it by whose sign. Commands
 * are named by session and requestID. */
bool sign;
bool unsure;            /* the sign has shown go, and nobody has said since that the road is clear */
byte body;
byte task;
byte on_road;

chan air = [4] of { Message };
Message late;

byte detections = DETECTIONS;
byte commands = COMMANDS;
byte disturbances = DISTURBANCES;
byte losses = LOSSES;

/* What has happened: one bit per command; the offer that each session has confirmed. */
byte commanded, accepted, started, reached, finished, fallen_back, told;
byte confirmed[DETECTIONS + 1];

/* Not 0 once applications are silent and the radio is dead; then it counts what still happens. */
byte quiet;
#define QUIET_STEPS_MAX 20

hidden Message m;       /* of use within one step alone */
hidden Message heard;
hidden byte i;
hidden short present;
hidden byte stray;
hidden byte is_newer;
hidden int before;
hidden int before_too;

#define NAME(s, q)    (((s) - 1) * COMMANDS + (q))
#define SESSION_OF(t) (((t) + COMMANDS - 1) / COMMANDS)
#define BIT_OF(t)     (1 << ((t) - 1))
#define BIT(s, q)     BIT_OF(NAME(s, q))
#define HAS(set, s, q) ((q) != 0 && ((set) & BIT(s, q)) != 0)

#define FOLLOWS       (follower.phase == FOLLOWING)
#define RUNS(p)       ((p) == EXECUTING || (p) == IN_POSITION)
#define EXECUTES      (FOLLOWS && follower.job != 0 && RUNS(follower.progress))
#define ORDER_RUNS    (leader.order != 0 && leader.progress <= IN_POSITION)
#ifdef OPENS_ON_THE_WAY
#define HOLDS_ITS_PLACE RUNS(leader.progress)
#else
#define HOLDS_ITS_PLACE (leader.progress == (HOLDING -> IN_POSITION : EXECUTING))
#endif
#define MAY_OPEN      (leader.phase == LEADING && leader.outstanding == 0 && leader.order != 0 \
                       && HOLDS_ITS_PLACE && leader.lease)
#define HEARS_LEADER  (follower.phase >= OFFERING && follower.session == m.session)
#define STEP          (empty(air) && quiet == 0)
#define REQUESTER_IS_BOUND (leader.phase != IDLE || leader.farewell != 0)
#define HELPER_IS_BOUND (follower.phase != IDLE || follower.farewell != 0)
#define ALL_IDLE      (leader.phase == IDLE && follower.phase == IDLE)

#define RUNNING       (body == UNDER_WAY || body == IN_PLACE -> task : 0)
#define GUARDS        (body == IN_PLACE || (body == UNDER_WAY && !HOLDING))
#define ROAD_IS_FREE  (on_road == 0)

#include "names.pml"
#include "properties.pml"
#include "sight.pml"

inline clear_m() {
    m.kind = 0; m.session = 0; m.beat = 0; m.offer = 0; m.request = 0; m.says = 0;
    m.farewell = 0; m.ending = 0; m.left_offer = 0
}

inline transmit() {
    if
    :: m.kind != 0 && quiet == 0 -> air ! m
    :: else
    fi
}

/* Nobody may cross any more. Somebody may still be on the road. */
inline shut_corridor() {
    leader.corridor = CLEARING;
#ifndef CORRIDOR_STAYS_OPEN
    sign = false;
#endif
    skip
}

/* Ends every step. The corridor closes in the step in which the follower stops to be engaged, and the
 * identity is unlocked once there is nothing left to say. */
inline settle() {
    if
    :: leader.corridor == OPEN && !MAY_OPEN -> shut_corridor()
    :: else
    fi;
    leader.lock_is_over = leader.lock_is_over && REQUESTER_IS_BOUND;
    follower.lock_is_over = follower.lock_is_over && HELPER_IS_BOUND;
    forget_body();
    rank_beats();
    rank_offers();
    quiet = quiet + (quiet > 0);
    check_state();
    note_sight();
    clear_m()
}

#include "road.pml"
#include "requester.pml"
#include "helper.pml"
#include "channel.pml"
#include "rest.pml"
