/* What happens on the road, whatever the robots believe: a body, a sign and a pedestrian. */

/* Whether the body guards who is on the road now; one that falls back goes on with what it guards. */
#define IS_NEEDED (on_road != 0 && task != 0 && SESSION_OF(task) == on_road \
                   && (GUARDS || body == FALLING_BACK))

/* Whether a command of this session lets the body go on with what it falls back from; there is one task. */
#define RESUMES (body == FALLING_BACK && SESSION_OF(task) == m.session)

/* The body is told to begin. */
inline start_body(command) {
    PREMISE(3, true);
    PREMISE(4, true);
    CHECK(3, HAS(commanded, m.session, command));
    CHECK(4, !HAS(started, m.session, command));
    CHECK(6, HAS(accepted, m.session, command));
    /* Of the commands of the session, neither this one nor a newer one was started before. */
    PREMISE(5, (started >> (NAME(m.session, 1) - 1)) & ((1 << COMMANDS) - 1));
    CHECK(5, ((started >> (NAME(m.session, command) - 1)) & ((1 << (COMMANDS - command + 1)) - 1)) == 0);
    CHECK(W2, !IS_NEEDED || RESUMES);
    CHECK(W4, body != FALLING_BACK || RESUMES);
    started = started | BIT(m.session, command);
    task = NAME(m.session, command);
    body = UNDER_WAY
}

/* The body is told to stop, though nothing is wrong with it. */
inline stop_body() {
    PREMISE(W2, IS_NEEDED);
    CHECK(W2, !IS_NEEDED);
#ifndef RELEASED_GOES_ON
    body = PARKED; task = 0;
#endif
    skip
}

/* The body cannot go on. */
inline fail_body() {
    PREMISE(W2, IS_NEEDED);
    body = STANDS
}

/* The body is told to fall back: to hold its place until the road is clear, or to go with its person to the
 * kerb. */
inline fall_back_body() {
    PREMISE(W2, IS_NEEDED);
    fallen_back = fallen_back | (quiet -> 0 : BIT_OF(task));
#ifdef STOPS_IN_PLACE
    CHECK(W2, !IS_NEEDED);
#endif
    body = FALLING_BACK
}

/* What a body has done last is of no account once nobody leads that session. */
inline forget_body() {
    if
    :: quiet && body >= FALLING_BACK -> body = PARKED; task = 0
    :: body == STANDS && (leader.phase == IDLE || SESSION_OF(task) != leader.session) ->
        body = PARKED; task = 0
    :: else
    fi
}

/* Somebody steps on the road where the sign shows go, and is off it at any later time. */
active proctype Pedestrian() {
end:
    do
    :: d_step { STEP && on_road == 0 && sign && leader.phase != IDLE ->
        on_road = leader.session;
        PREMISE(W1, true);
        /* Who guarded is gone at most as long as its leader has not been told. */
        CHECK(W1, task != 0 && SESSION_OF(task) == on_road
                  && (GUARDS || (body >= FALLING_BACK && !(told & BIT_OF(task)))));
        settle() }
    :: d_step { STEP && on_road != 0 -> on_road = 0; settle() }
    od
}
