/* The properties, under the ids of ../doc/verification.md.
 *
 * One that fails prints "violated I8", a premise that is met prints "premise I8", each once. Compiled
 * with -DUNTIL_VIOLATED=bits, the verifier stops as soon as all of these are violated.
 */

c_decl {
    static void note(const char *what, int property)
    {
        static unsigned seen[2];
        unsigned bit = 1u << property;
        if (!(seen[what[0] == 'v'] & bit)) {
            seen[what[0] == 'v'] |= bit;
            printf("%s %c%d\n", what, property == 20 ? 'L' : 'I', property == 20 ? 7 : property);
        }
#ifdef UNTIL_VIOLATED
        if ((seen[1] & (UNTIL_VIOLATED)) == (UNTIL_VIOLATED))
            exit(0);
#endif
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
