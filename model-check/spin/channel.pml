/* The radio channel between the two, with its faults. */

inline copy(from, to) {
    to.kind = from.kind; to.session = from.session; to.beat = from.beat; to.offer = from.offer;
    to.request = from.request; to.says = from.says;
    to.farewell = from.farewell; to.ending = from.ending; to.left_offer = from.left_offer
}

inline forget_late() {
    late.kind = 0; late.session = 0; late.beat = 0; late.offer = 0; late.request = 0; late.says = 0;
    late.farewell = 0; late.ending = 0; late.left_offer = 0
}

#define DELIVER       1
#define LOSE          2
#define DELAY         3
#define DELIVER_LATE  4
#define DELIVER_AGAIN 5     /* late, and it stays on its way */
#define LOSE_LATE     6

inline take(fate) {
    if
    :: fate <= DELAY -> air ? m
    :: else -> copy(late, m)
    fi;
    losses = losses - (fate == LOSE || fate == LOSE_LATE);
    if
    :: fate == DELAY -> copy(m, late)
    :: fate == DELIVER_LATE || fate == LOSE_LATE -> forget_late()
    :: else
    fi;
    if
    :: fate == DELIVER || fate == DELIVER_LATE || fate == DELIVER_AGAIN -> skip
    :: else -> clear_m()
    fi
}

/* What was just sent arrives, gets lost or is delayed, before anything else happens. A delayed message
 * arrives at any time, as often as the channel likes, or never. */
active proctype Channel() {
    byte fate;
end:
    do
    :: atomic {
        if
        :: nempty(air) -> fate = DELIVER
        :: nempty(air) && losses > 0 -> fate = LOSE
        :: nempty(air) && DELAYED && late.kind == 0 -> fate = DELAY
        :: STEP && late.kind != 0 -> fate = DELIVER_LATE
        :: STEP && late.kind != 0 -> fate = DELIVER_AGAIN
        :: STEP && late.kind != 0 && losses > 0 -> fate = LOSE_LATE
        fi;
        d_step {
            take(fate); fate = 0;
            if
            :: m.kind == 0
            :: m.kind != 0 && m.kind <= ANSWER -> requester_hears()
            :: else -> helper_hears()
            fi;
            settle()
        }
       }
    od
}
