/* Names that only ever grow, and a model that stays finite all the same.
 *
 * Heartbeats and offers are only compared, so each becomes its rank among those that still occur.
 */

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

#define NUMBERS_MAX 9
#define RANKS_SUFFICE ((present >> (NUMBERS_MAX + 1)) == 0)

inline rank_beats() {
    present = (1 << leader.beat) | (1 << leader.echoed) | (1 << follower.heard) | (1 << late.beat);
    EACH_ON_AIR(present = present | (1 << m.beat));
    assert(RANKS_SUFFICE);
    leader.beat = RANK(leader.beat);
    leader.echoed = RANK(leader.echoed);
    follower.heard = RANK(follower.heard);
    late.beat = RANK(late.beat);
    EACH_ON_AIR(m.beat = RANK(m.beat))
}

/* The number of the next offer counts as one that occurs: what is given back is given out again. */
inline rank_offers() {
    present = (1 << leader.offer) | (1 << late.offer) | (1 << late.left_offer);
    present = present | (1 << follower.offer) | (1 << follower.next) | (1 << follower.left_offer);
    EACH_SESSION(present = present | (1 << confirmed[i]));
    EACH_ON_AIR(present = present | (1 << m.offer) | (1 << m.left_offer));
    assert(RANKS_SUFFICE);
    leader.offer = RANK(leader.offer);
    follower.offer = RANK(follower.offer);
    follower.next = RANK(follower.next);
    follower.left_offer = RANK(follower.left_offer);
    late.offer = RANK(late.offer);
    late.left_offer = RANK(late.left_offer);
    EACH_SESSION(confirmed[i] = RANK(confirmed[i]));
    EACH_ON_AIR(m.offer = RANK(m.offer); m.left_offer = RANK(m.left_offer))
}
