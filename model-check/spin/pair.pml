/* The scenario `pair` in Promela: one robot that detects a pedestrian, one that helps.
 *
 * Its rules are those of the protocol's text (README, "Where the protocol says more than the paper"); it
 * shares no line with the Rust code. How independent it is of that, what is
 * modelled, what is not, and how to run it: README.md in this folder.
 *
 *      Requester  ──► air ──►  Channel  ──►  Helper          air: just sent, fate decided first
 *          ▲                   │  ▲  │          │            late: the one delayed message
 *          └───────────────────┘  ▼  └──────────┘
 *                                late
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
hidden byte stray;
hidden int before;

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

#include "names.pml"
#include "properties.pml"

inline clear_m() {
    m.kind = 0; m.session = 0; m.beat = 0; m.offer = 0; m.request = 0; m.says = 0; m.farewell = 0
}

inline transmit() {
    if
    :: m.kind != 0 && quiet == 0 -> air ! m
    :: else
    fi
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

#include "requester.pml"
#include "helper.pml"
#include "channel.pml"
#include "rest.pml"
