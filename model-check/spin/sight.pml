/* What an onlooker who is told everything but names and messages sees of a state, in 32 bits.
 *
 * Compiled with -DSIGHTS, each that occurs is printed once, as "sees 1234". ../tests/spin.rs compares them
 * with those of the kit's model, where the order of the bits is written down once more.
 */

#ifdef SIGHTS
c_decl {
    #define SIGHTS_MAX (1u << 20)
    static unsigned packed;

    static void pack(unsigned value, unsigned bits)
    {
        packed = packed << bits | value;
    }

    static void see(void)
    {
        static unsigned known[SIGHTS_MAX], how_many;
        unsigned at = packed * 2654435761u >> 12;
        if (packed == 0)    /* two idle robots, as every run begins; 0 marks a free place */
            return;
        for (; known[at] != 0; at = (at + 1) % SIGHTS_MAX)
            if (known[at] == packed)
                return;
        if (++how_many > SIGHTS_MAX / 2)
            abort();
        known[at] = packed;
        printf("sees %u\n", packed);
    }
}

inline note_sight() {
    c_code {
        if (!now.quiet) {
            packed = 0;
            pack(now.leader.phase, 2);
            pack(now.leader.phase == 1 ? now.leader.offer != 0 : now.leader.joined, 1);
            pack(now.leader.outstanding != 0, 1);
            pack(now.leader.repeats != 0, 1);
            pack(now.leader.order ? now.leader.progress + 1 : 0, 3);
            pack(now.leader.lease, 1);
            pack(now.leader.corridor, 2);
            pack(now.leader.duty, 1);
            pack(now.leader.unavailable, 1);
            pack(now.leader.ending, 2);
            pack(now.leader.lock_is_over, 1);
            pack(now.unsure, 1);
            pack(now.follower.phase ? now.follower.phase - 2 : 0, 2);
            pack(now.follower.contact, 1);
            pack(now.follower.job ? now.follower.progress + 1 : 0, 3);
            pack(now.follower.refused != 0, 1);
            pack(now.follower.duty, 1);
            pack(now.follower.unavailable, 1);
            pack(now.follower.farewell != 0, 1);
            pack(now.follower.lock_is_over, 1);
            pack(now.body, 3);
            pack(now.on_road != 0, 1);
            see();
        }
    }
}
#else
inline note_sight() {
    skip
}
#endif
