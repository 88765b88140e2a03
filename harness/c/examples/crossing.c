/* A whole crossing in one program: a leader, a follower, and a radio between them that loses nothing. */
#include <crossguard.h>
#include <string.h>

static struct { CrossguardRobot robot; CrossguardTurn turn; uint8_t packets[CROSSGUARD_PACKETS_LEN]; } all[2];
static struct { int to; CrossguardEvent event; uint8_t packet[1500]; size_t length; } queue[512];
static size_t last;
static CrossguardOutput maneuver, ended;

static CrossguardEvent *tell(int who, uint8_t kind) { /* once it is its turn */
    queue[last].to = who;
    crossguard_event_init(&queue[last].event, kind);
    return &queue[last++].event;
}

static void carry_out(int who) {
    for (uint32_t i = 0; i < all[who].turn.outputs_length; i++) {
        const CrossguardOutput *it = &all[who].turn.outputs[i];
        if (it->kind == CROSSGUARD_OUTPUT_KIND_SEND) {
            queue[last].to = !who;
            queue[last].length = it->packet_length;
            memcpy(queue[last++].packet, all[who].packets + it->packet_offset, it->packet_length);
        } else if (it->kind == CROSSGUARD_OUTPUT_KIND_START_MANEUVER) {
            maneuver = *it; /* the body goes */
        } else if (it->kind == CROSSGUARD_OUTPUT_KIND_CORRIDOR_OPENED) {
            CrossguardEvent *done = tell(1, CROSSGUARD_EVENT_KIND_MANEUVER_COMPLETED); /* once people are across */
            done->session = maneuver.session, done->request = maneuver.request;
        } else if (it->notice == CROSSGUARD_NOTICE_FOLLOWER_JOINED) {
            CrossguardEvent *order = tell(who, CROSSGUARD_EVENT_KIND_COMMAND_MANEUVER);
            order->station = it->station, order->task = CROSSGUARD_TASK_MOVE;
        } else if (it->notice == CROSSGUARD_NOTICE_MANEUVER_REPORTED)
            tell(who, CROSSGUARD_EVENT_KIND_OPEN_CORRIDOR);
        else if (it->notice == CROSSGUARD_NOTICE_MANEUVER_COMPLETED)
            tell(who, CROSSGUARD_EVENT_KIND_TASK_COMPLETED); /* only when nobody is on the road any more */
        else if (it->notice == CROSSGUARD_NOTICE_SESSION_ENDED)
            ended = *it;
    }
}

int main(void) {
    CrossguardConfig config;
    crossguard_config_init(&config);
    for (config.boot = 1; config.station < 2;) { /* boot: counted up, and on the disk before this */
        int who = (int)config.station++;
        crossguard_robot_init(&all[who].robot, sizeof all[who].robot, CROSSGUARD_ABI_VERSION, &config);
        crossguard_turn_init(&all[who].turn, all[who].packets, sizeof all[who].packets, NULL, 0);
    }
    CrossguardEvent *detected = tell(0, CROSSGUARD_EVENT_KIND_PEDESTRIAN_DETECTED);
    detected->followers = 1, detected->tasks = 1 << CROSSGUARD_TASK_MOVE;
    for (uint64_t ms = 0, first = 0; ms < 10000 && !ended.notice; ms += first == last ? 20 : 0) {
        int is_time = first == last, who = is_time ? (int)(ms / 20 % 2) : queue[first].to;
        all[who].turn.timestamp_its = 700000000000 + ms;
        if (is_time) crossguard_elapse(&all[who].robot, 40, &all[who].turn); /* time first, then what happened in it */
        else if (!queue[first].length) crossguard_tell(&all[who].robot, &queue[first].event, &all[who].turn);
        else crossguard_receive(&all[who].robot, queue[first].packet, queue[first].length, &all[who].turn);
        first += !is_time;
        carry_out(who);
    }
    return ended.reason == CROSSGUARD_REASON_TASK_COMPLETED ? 0 : 1;
}
