/* The robot that helps: it offers and follows. */

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

/* Answers the command in m; m stays as it is. */
inline send_answer(yes) {
    m.kind = ANSWER; m.says = yes; transmit(); m.kind = COMMAND;
    accepted = accepted | ((yes && !quiet) -> BIT(m.session, m.request) : 0)
}

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

#ifdef NO_OFFER_NUMBERS
#define CONFIRMED HEARS_LEADER
#else
#define CONFIRMED (HEARS_LEADER && m.offer == follower.offer)
#endif

inline hear_leader() {
    if
    :: CONFIRMED && follower.phase == OFFERING -> join()
    :: CONFIRMED && follower.phase == FOLLOWING ->
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
            send_follower_ram() }    /* RAM period */
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
