/* The robot that helps: it offers and follows. */

inline send_follower_ram() {
    clear_m();
    m.farewell = follower.farewell; m.left_offer = follower.left_offer;
    if
    :: follower.phase == OFFERING ->
        m.kind = OFFER; m.session = follower.session; m.offer = follower.offer;
        m.beat = follower.heard
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

/* The fallback is a duty until the application says that the road is clear. */
inline fall_back() {
    fall_back_body();
#ifndef FORGETS_ITS_DUTY
    follower.duty = !quiet;
#endif
    skip
}

/* The part in the session is over; the leader knows already or need not know. Only a completed crossing
 * stops what runs, any other end makes it fall back. */
inline release(why) {
    if
#ifdef EVERY_END_STOPS
    :: EXECUTES -> stop_body()
#else
    :: EXECUTES && why == CROSSED -> stop_body()
    :: EXECUTES && why != CROSSED -> fall_back()
#endif
    :: else
    fi;
    follower.phase = IDLE; follower.session = 0; follower.offer = 0; follower.heard = 0;
    follower.contact = 0; follower.job = 0; follower.progress = NO_REPORT; follower.refused = 0
}

inline say_left(which, by) {
    if
    :: follower.farewell == which && follower.left_offer == by
    :: !(follower.farewell == which && follower.left_offer == by) && !follower.lock_is_over ->
        follower.farewell = which; follower.left_offer = by;
        send_follower_ram()
    :: else
    fi
}

/* The part in the session is over, and its leader is told. */
inline leave() {
    m.session = follower.session; m.offer = follower.offer;
    release(ABORTED);
    say_left(m.session, m.offer)
}

/* The leader counts on an offer that does not stand. What this robot has never offered is not its own. */
inline decline() {
    if
    :: m.offer < follower.next -> say_left(m.session, m.offer)
    :: else
    fi
}

#define MAY_OFFER (!follower.unavailable && !follower.duty && !follower.lock_is_over)

inline make_offer() {
    CHECK(W4, body != FALLING_BACK);
    follower.phase = OFFERING; follower.session = m.session; follower.heard = m.beat;
    if
    :: follower.farewell == m.session -> follower.farewell = 0; follower.left_offer = 0
    :: else
    fi;
    follower.offer = follower.next;
    follower.next++;
    send_follower_ram()
}

inline join() {
    follower.phase = FOLLOWING; follower.heard = m.beat; follower.contact = true;
    send_follower_ram()
}

inline hear_request() {
    if
    :: follower.phase == IDLE && MAY_OFFER -> make_offer()
#ifdef NO_CONFIRMATION
    :: follower.phase == OFFERING && HEARS_LEADER -> join()
#else
    :: follower.phase == OFFERING && HEARS_LEADER && m.beat > follower.heard ->
        follower.heard = m.beat
#endif
    :: else
    fi
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
        if
        :: HEARS_LEADER -> release(ABORTED)
        :: else
        fi;
        decline()
    fi
}

inline take_command() {
    /* Acknowledged before it is started; the RAM reports it. */
    follower.contact = true;
    if
    :: follower.unavailable -> follower.refused = m.request; send_answer(false)
    :: else ->
        /* A duty is of this session, since it offers to no other, and there is one task: it is taken up again. */
        follower.duty = false;
        send_answer(true);
        if
        :: EXECUTES -> stop_body()
        :: else
        fi;
        follower.job = m.request; follower.progress = EXECUTING; follower.refused = 0;
        start_body(m.request);
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
            start_body(m.request)
#endif
        :: m.request > follower.job && m.request > follower.refused -> take_command()
        :: else ->
#ifdef NO_ORDER_OF_REQUESTS
            start_body(m.request)
#else
            skip
#endif
        fi
    :: else -> skip     /* the leader repeats it, or is told when it lists this robot */
    fi
}

/* The session that this robot has a part in is over. Nobody can confirm the offer any more, so that its
 * number is free again. */
inline hear_ended() {
    if
    :: follower.phase == OFFERING -> follower.next = follower.offer
    :: else
    fi;
    release(m.ending)
}

inline helper_hears() {
    if
    :: m.farewell != 0 && m.farewell == follower.session -> hear_ended()
    :: else
    fi;
    if
    :: m.kind == NEED -> hear_request()
    :: m.kind == LEADER -> hear_leader()
    :: m.kind == COMMAND -> hear_command()
    :: else
    fi
}

inline safety_expires() {
    follower.contact = false;
    if
    :: EXECUTES -> fall_back(); follower.progress = SAFE_IDLE; send_follower_ram()
    :: else
    fi
}

inline become_unavailable() {
    follower.unavailable = true;
    if
    :: EXECUTES -> fail_body(); follower.progress = FAILED; send_follower_ram()
    :: !EXECUTES && follower.phase != IDLE -> leave()
    :: else -> send_follower_ram()
    fi
}

#ifdef NO_FOLLOWER_TIMERS
#define TIMERS_RUN (!FOLLOWS)
#else
#define TIMERS_RUN true
#endif

/* Who guards finishes when nobody is on the road. */
active proctype HelperRobot() {
end:
    do
    :: atomic {
        if
        :: d_step { empty(air) && follower.phase == OFFERING -> release(ABORTED) }   /* T_offer */
        :: d_step { empty(air) && FOLLOWS && follower.contact && TIMERS_RUN -> safety_expires() }
        :: d_step { empty(air) && FOLLOWS && !follower.contact && TIMERS_RUN -> leave() }
        :: d_step { STEP && follower.phase != IDLE && !follower.lock_is_over && TIMERS_RUN ->
            leave(); follower.lock_is_over = true }                                  /* identity lock */
        :: d_step { STEP && HELPER_IS_BOUND && TIMERS_RUN -> send_follower_ram() }   /* RAM period */
        :: d_step { empty(air) && follower.farewell != 0 && TIMERS_RUN ->
            follower.farewell = 0; follower.left_offer = 0 }

        :: d_step { STEP && HOLDING && EXECUTES && follower.progress == EXECUTING ->
            reached = reached | BIT_OF(task); body = IN_PLACE;
            follower.progress = IN_POSITION; send_follower_ram() }
        :: d_step { STEP && EXECUTES && ROAD_IS_FREE ->
            finished = finished | BIT(follower.session, follower.job); body = STANDS;
            follower.progress = COMPLETED; send_follower_ram() }
        :: d_step { STEP && EXECUTES && disturbances > 0 ->
            disturbances--; fail_body(); follower.progress = FAILED; send_follower_ram() }
        :: d_step { STEP && body == FALLING_BACK && ROAD_IS_FREE ->
            follower.duty = false; body = STANDS; send_follower_ram() }
        :: d_step { STEP && follower.phase != IDLE && disturbances > 0 -> disturbances--; leave() }
        :: d_step { STEP && disturbances > 0 && !follower.unavailable ->
            disturbances--; become_unavailable() }
        :: d_step { STEP && follower.unavailable -> follower.unavailable = false; send_follower_ram() }
        fi;
        d_step { settle() }
       }
    od
}
