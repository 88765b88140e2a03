/* The robot that detects the pedestrian: it asks for help and leads. */

inline send_leader_ram() {
    clear_m();
    m.farewell = leader.farewell; m.ending = leader.ending;
    if
    :: leader.phase == REQUESTING ->
        m.kind = NEED; m.session = leader.session; m.beat = leader.beat
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

inline say_ended(which, how) {
    if
    :: leader.farewell == which && leader.ending == how
    :: !(leader.farewell == which && leader.ending == how) && !leader.lock_is_over ->
        leader.farewell = which; leader.ending = how;
        send_leader_ram()
    :: else
    fi
}

/* Only a completed crossing frees everybody. After any other end this robot has to find the road clear
 * before it asks for anything new. */
inline end_session(how) {
    if
    :: leader.corridor == OPEN -> shut_corridor()
    :: else
    fi;
#ifndef FORGETS_ITS_DUTY
    leader.duty = (leader.corridor != CLEAR && how == ABORTED && !quiet);
#endif
    leader.phase = IDLE;
    leader.offer = 0; leader.joined = 0; leader.beat = 0; leader.echoed = 0; leader.lease = 0;
    leader.newest = 0; leader.outstanding = 0; leader.repeats = 0;
    leader.order = 0; leader.progress = NO_REPORT; leader.corridor = CLEAR;
    say_ended(leader.session, how)
}

/* Somebody still believes in a session that is over. */
inline hear_of_old_session() {
    if
    :: (leader.phase == IDLE || m.session != leader.session) && leader.farewell == 0 ->
        say_ended(m.session, ABORTED)
    :: else
    fi
}

inline hear_offer() {
    if
    :: leader.phase == REQUESTING && m.session == leader.session && m.beat <= leader.beat ->
        /* An older offer replaces nothing, and an echo that came back before proves nothing. */
        if
        :: m.offer > leader.offer || (m.offer == leader.offer && m.beat > leader.echoed) ->
            leader.offer = m.offer; leader.echoed = m.beat
        :: else
        fi
    :: else -> hear_of_old_session()
    fi
}

inline acknowledge() {
    leader.order = leader.outstanding; leader.progress = NO_REPORT;
    leader.outstanding = 0; leader.repeats = 0
}

/* A place is taken by a newer echo than all before, and lost by one that is as new. What is over stays so, but for the
 * leader's own limit, after which the follower may fall back. */
#define IS_NEWS (leader.progress == NO_REPORT \
    || (leader.progress == EXECUTING && m.says == IN_POSITION && is_newer) \
    || (leader.progress == IN_POSITION && m.says == EXECUTING && m.beat == leader.echoed) \
    || ((leader.progress == EXECUTING || leader.progress == IN_POSITION) && m.says > IN_POSITION) \
    || (leader.progress == OVER_TIME && m.says == SAFE_IDLE))

inline hear_follower() {
    is_newer = (!leader.joined || m.beat > leader.echoed);
    if
    :: is_newer -> leader.joined = true; leader.echoed = m.beat; leader.lease = true
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
    :: m.request != 0 && m.request == leader.order && IS_NEWS ->
        leader.progress = m.says
    :: else
    fi
}

/* What an answer could change. */
#define RECORD (leader.phase | leader.outstanding << 3 | leader.repeats << 6 | leader.order << 9 \
                | leader.progress << 12 | leader.lease << 15 | leader.joined << 16 \
                | leader.corridor << 17 | sign << 19 | leader.duty << 20)
#define RECORD_TOO (leader.offer | leader.beat << 4 | leader.echoed << 8 | leader.farewell << 12 \
                    | leader.ending << 16 | leader.session << 18 | leader.newest << 22)

inline hear_answer() {
    stray = (leader.phase != LEADING || m.session != leader.session
             || m.request != leader.outstanding);
    before = RECORD;
    before_too = RECORD_TOO;
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
    CHECK(7, !stray || (before == RECORD && before_too == RECORD_TOO))
}

/* A farewell names the offer that is left: it says nothing of a later one. */
#define IS_LEFT (m.farewell != 0 && m.farewell == leader.session && leader.offer <= m.left_offer)

#define IS_OF_MINE (leader.phase == LEADING && m.session == leader.session)

inline requester_hears() {
    if
    :: m.kind == FOLLOWER && m.request != 0 && m.says > IN_POSITION ->
        told = told | BIT(m.session, m.request)
    :: else
    fi;
    /* A farewell first: a helper may have left and offer again in one RAM. */
    if
    :: leader.phase == REQUESTING && IS_LEFT -> leader.offer = 0; leader.echoed = 0
    :: leader.phase == LEADING && IS_LEFT ->
        /* What is still to be heard of this message comes after what is sent. */
        copy(m, heard);
        end_session(ABORTED);
        copy(heard, m)
    :: else
    fi;
    if
    :: m.kind == OFFER -> hear_offer()
    :: m.kind == FOLLOWER && IS_OF_MINE && m.beat <= leader.beat -> hear_follower()
    :: m.kind == FOLLOWER && !IS_OF_MINE -> hear_of_old_session()
    :: m.kind == ANSWER -> hear_answer()
    :: else
    fi
}

inline confirm() {
    leader.phase = LEADING; leader.echoed = 0;
    confirmed[leader.session] = (quiet -> 0 : leader.offer);
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
    :: else -> end_session(ABORTED)
    fi
}

inline next_command() {
    leader.newest++; leader.outstanding = leader.newest; leader.repeats = 0;
    send_command()
}

/* No command takes a guard off a road on which there may be people: one that runs, as far as the follower
 * knows, which knows nothing of the leader's execution limit. */
#ifdef COMMANDS_GUARDS_AWAY
#define MAY_COMMAND true
#else
#define MAY_COMMAND (leader.corridor == CLEAR \
                     || !(leader.order != 0 && (ORDER_RUNS || leader.progress == OVER_TIME)))
#endif

#define MAY_ASK (leader.phase == IDLE && !leader.unavailable && !leader.duty && !leader.lock_is_over)

inline ask_for_help() {
    CHECK(W4, !unsure);
    detections--; leader.session++; leader.phase = REQUESTING; leader.beat = 1;
    send_leader_ram()
}

inline become_unable() {
    leader.unavailable = true;
    if
    :: leader.phase != IDLE -> end_session(ABORTED)
    :: else -> send_leader_ram()
    fi
}

inline find_road_clear() {
    unsure = false;
    if
    :: leader.duty -> leader.duty = false; send_leader_ram()
    :: else -> leader.corridor = CLEAR
    fi
}

/* Timers first, then the application, which is truthful. */
active proctype RequesterRobot() {
end:
    do
    :: atomic {
        if
        :: d_step { empty(air) && leader.phase == REQUESTING -> end_session(ABORTED) }      /* T_help */
        :: d_step { empty(air) && leader.phase == REQUESTING && leader.offer != 0 ->
            leader.offer = 0; leader.echoed = 0 }                                   /* the offer lapses */
        :: d_step { empty(air) && leader.phase == REQUESTING && leader.offer != 0 -> confirm() }
        :: d_step { empty(air) && leader.phase == LEADING && !leader.lease ->       /* lost */
            end_session(ABORTED) }
        :: d_step { STEP && leader.phase != IDLE && !leader.lock_is_over ->         /* identity lock */
            end_session(ABORTED); leader.lock_is_over = true }
        :: d_step { STEP && REQUESTER_IS_BOUND ->                                   /* RAM period */
            leader.beat = leader.beat + (leader.phase != IDLE); send_leader_ram() }
        :: d_step { empty(air) && leader.farewell != 0 -> leader.farewell = 0; leader.ending = 0 }
        :: d_step { empty(air) && leader.lease -> leader.lease = false }
        :: d_step { empty(air) && leader.phase == LEADING && ORDER_RUNS ->          /* T_exec */
            leader.progress = OVER_TIME }
        :: d_step { empty(air) && leader.outstanding != 0 -> acknowledgement_expires() }

        :: d_step { STEP && MAY_ASK && detections > 0 -> ask_for_help() }
        :: d_step { STEP && leader.joined && leader.outstanding == 0 && commands > 0 && MAY_COMMAND ->
            commands--; next_command() }
        :: d_step { STEP && MAY_OPEN && leader.corridor != OPEN ->
            leader.corridor = OPEN; sign = true; unsure = true }
        :: d_step { STEP && leader.corridor == OPEN -> shut_corridor() }
        :: d_step { STEP && unsure && ROAD_IS_FREE && (leader.duty || leader.corridor == CLEARING) ->
            find_road_clear() }
        :: d_step { STEP && leader.phase != IDLE && ROAD_IS_FREE ->
            unsure = false; end_session(CROSSED) }
        :: d_step { STEP && leader.phase != IDLE && disturbances > 0 ->
            disturbances--; end_session(ABORTED) }
        :: d_step { STEP && disturbances > 0 && !leader.unavailable ->
            disturbances--; become_unable() }
        :: d_step { STEP && leader.unavailable -> leader.unavailable = false; send_leader_ram() }
        fi;
        d_step { settle() }
       }
    od
}
