/* Whether the robots come to rest by themselves: I12 and L7.
 *
 * At any moment the radio may die and the applications fall silent for good. From then on, timers
 * alone must bring both robots to rest, in finitely many steps. That is more than I12 asks for (someone
 * can make progress) and more than L7 does (from every state, all robots idle can be reached), and
 * unlike L7 it is something that SPIN can check: no formula of linear time says "can be reached".
 */

active proctype Rest() {
end:
    d_step { STEP ->
        quiet = 1; forget_late();
        commanded = 0; accepted = 0; started = 0; reached = 0; finished = 0; fallen_back = 0; told = 0;
        detections = 0; commands = 0; disturbances = 0; losses = 0;
        on_road = 0; unsure = 0; leader.duty = 0; follower.duty = 0;
        EACH_SESSION(confirmed[i] = 0);
        settle() };
    timeout -> CHECK(12, ALL_IDLE); CHECK(L7, ALL_IDLE)
}
