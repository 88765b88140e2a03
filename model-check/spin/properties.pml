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
            printf("%s %c%d\n", what, property < 20 ? 'I' : property == 20 ? 'L' : 'W',
                   property < 20 ? property : property == 20 ? 7 : property - 20);
        }
#ifdef UNTIL_VIOLATED
        if ((seen[1] & (UNTIL_VIOLATED)) == (UNTIL_VIOLATED))
            exit(0);
#endif
    }
}
#define L7 20
#define W1 21
#define W2 22
#define W4 24

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

#define IS_DONE (leader.phase == LEADING && (leader.progress == COMPLETED || leader.progress == IN_POSITION))

inline check_state() {
    /* I1 beyond the shape of the model: the leader of a follower has opened that session. */
    PREMISE(1, leader.phase == LEADING && FOLLOWS);
    CHECK(1, !FOLLOWS || (follower.session != 0 && follower.session <= leader.session));
    PREMISE(2, FOLLOWS);
    CHECK(2, quiet || !FOLLOWS || confirmed[follower.session] == follower.offer);
    PREMISE(6, leader.phase == LEADING && leader.order != 0);
    CHECK(6, quiet || leader.phase != LEADING || leader.order == 0
             || HAS(accepted, leader.session, leader.order));
    CHECK(6, quiet || RUNNING == 0 || (accepted & BIT_OF(RUNNING)));
    PREMISE(8, IS_DONE);
    CHECK(8, quiet || !(IS_DONE && leader.progress == COMPLETED)
             || HAS(finished, leader.session, leader.order));
    CHECK(8, quiet || !(IS_DONE && leader.progress == IN_POSITION)
             || HAS(reached, leader.session, leader.order));
    PREMISE(9, fallen_back != 0);
    CHECK(9, quiet || RUNNING == 0 || !(fallen_back & BIT_OF(RUNNING)));
    PREMISE(11, sign);
    CHECK(11, sign == (leader.corridor == OPEN));
    CHECK(11, leader.corridor != OPEN || (leader.phase == LEADING && leader.outstanding == 0
              && leader.order != 0 && leader.lease
              && leader.progress == (HOLDING -> IN_POSITION : EXECUTING)));
    PREMISE(12, !ALL_IDLE);
    PREMISE(14, RUNNING != 0);
    CHECK(14, RUNNING == (EXECUTES -> NAME(follower.session, follower.job) : 0));
    PREMISE(16, leader.repeats == N_ACK);
    CHECK(16, leader.repeats <= N_ACK);
    CHECK(L7, quiet <= QUIET_STEPS_MAX);
    PREMISE(W4, unsure || body == FALLING_BACK)
}
