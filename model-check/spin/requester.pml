/* The robot that detects the pedestrian: it asks for help and leads. */

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

inline send_command() {
    clear_m();
    m.kind = COMMAND; m.session = leader.session; m.request = leader.outstanding;
    commanded = commanded | (quiet -> 0 : BIT(leader.session, leader.outstanding));
    transmit()
}

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

/* What an answer could change. */
#define RECORD (leader.phase | leader.outstanding << 3 | leader.repeats << 6 | leader.order << 9 \
                | leader.progress << 12 | leader.lease << 15 | leader.joined << 16 | corridor << 17)

inline hear_answer() {
    stray = (leader.phase != LEADING || m.session != leader.session
             || m.request != leader.outstanding);
    before = RECORD;
    PREMISE(7, stray);
    if
#ifdef ANY_ACKNOWLEDGEMENT
    :: leader.phase == LEADING && m.session == leader.session && leader.outstanding != 0 ->
#else
    :: !stray ->
#endif
        if
        :: m.says -> acknowledge()
        :: else -> leader.outstanding = 0; leader.repeats = 0
        fi
    :: else
    fi;
    CHECK(7, !stray || before == RECORD)
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
            fi }
        :: d_step { STEP && leader.unavailable -> leader.unavailable = false }
        fi;
        d_step { settle() }
       }
    od
}
