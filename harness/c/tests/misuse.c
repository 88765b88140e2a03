/*
 * Misuse that can be detected returns a code, and nothing else happens. Run under AddressSanitizer, with
 * every buffer in memory of its own that is exactly as large as the library is told.
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "crossguard.h"

static int failures;

#define EXPECT(status, call)                                                                     \
    do {                                                                                         \
        CrossguardStatus got = (call);                                                           \
        if (got != (status)) {                                                                   \
            fprintf(stderr, "line %d: %s is '%s', not '%s'\n", __LINE__, #call,                  \
                    crossguard_status_text(got), crossguard_status_text(status));                \
            failures++;                                                                          \
        }                                                                                        \
    } while (0)

#define OK CROSSGUARD_STATUS_OK
#define IS_NULL CROSSGUARD_STATUS_NULL
#define BAD CROSSGUARD_STATUS_BAD_ARGUMENT

static void *room(size_t size) {
    void *memory = calloc(1, size);
    if (!memory) abort();
    return memory;
}

static CrossguardConfig *config, *other;
static CrossguardRobot *robot;
static CrossguardTurn *turn;
static CrossguardEvent *event;
static CrossguardView *view;
static uint8_t *packets;
static char *lines;

/* Every call that takes a robot, of which `robot` is none. */
static void expect_no_robot(CrossguardStatus expected, CrossguardRobot *none) {
    uint64_t count;
    char name[CROSSGUARD_CAUSE_LEN];
    EXPECT(expected, crossguard_elapse(none, 1, turn));
    EXPECT(expected, crossguard_tell(none, event, turn));
    EXPECT(expected, crossguard_receive(none, packets, 1, turn));
    EXPECT(expected, crossguard_receive_message(none, packets, 1, turn));
    EXPECT(expected, crossguard_announce(none, turn));
    EXPECT(expected, crossguard_log_start(none, 0, turn));
    EXPECT(expected, crossguard_log_stop(none, turn));
    EXPECT(expected, crossguard_view(none, view));
    EXPECT(expected, crossguard_counter(none, 0, name, sizeof name, &count));
    EXPECT(expected, crossguard_robot_finish(none));
}

static CrossguardStatus init(CrossguardRobot *memory) {
    return crossguard_robot_init(memory, sizeof *memory, CROSSGUARD_ABI_VERSION, config);
}

static void null_pointers(void) {
    EXPECT(IS_NULL, crossguard_config_init(NULL));
    EXPECT(IS_NULL, crossguard_config_check(NULL, NULL, 0));
    EXPECT(IS_NULL, crossguard_body_init(NULL));
    EXPECT(IS_NULL, crossguard_event_init(NULL, 0));
    EXPECT(IS_NULL, crossguard_turn_init(NULL, NULL, 0, NULL, 0));
    EXPECT(IS_NULL, init(NULL));
    EXPECT(IS_NULL, crossguard_robot_init(robot, sizeof *robot, CROSSGUARD_ABI_VERSION, NULL));
    expect_no_robot(IS_NULL, NULL);
    EXPECT(OK, init(robot));
    EXPECT(IS_NULL, crossguard_elapse(robot, 1, NULL));
    EXPECT(IS_NULL, crossguard_tell(robot, NULL, turn));
    EXPECT(IS_NULL, crossguard_tell(robot, event, NULL));
    EXPECT(IS_NULL, crossguard_receive(robot, NULL, 5, turn));
    EXPECT(IS_NULL, crossguard_receive_message(robot, NULL, 5, turn));
    EXPECT(IS_NULL, crossguard_view(robot, NULL));
    EXPECT(IS_NULL, crossguard_counter(robot, 0, NULL, 5, NULL));
    turn->packets = NULL;
    EXPECT(IS_NULL, crossguard_elapse(robot, 1, turn));
    turn->packets = packets;
    /* No packet is none, which is counted; and a log is not needed. */
    EXPECT(OK, crossguard_receive(robot, NULL, 0, turn));
    if (strcmp(turn->dropped, "packet: truncated") != 0) failures++, puts(turn->dropped);
    EXPECT(OK, crossguard_robot_finish(robot));
}

static void short_buffers(void) {
    uint64_t count;
    char name[1];
    CrossguardView before, after;
    EXPECT(CROSSGUARD_STATUS_SHORT_BUFFER,
           crossguard_robot_init(robot, sizeof *robot - 1, CROSSGUARD_ABI_VERSION, config));
    EXPECT(OK, init(robot));
    EXPECT(OK, crossguard_view(robot, &before));
    event->kind = CROSSGUARD_EVENT_KIND_PEDESTRIAN_DETECTED;
    event->followers = 1;
    event->tasks = 1;
    uint8_t *small = room(CROSSGUARD_PACKETS_LEN - 1);
    turn->packets = small;
    turn->packets_capacity = CROSSGUARD_PACKETS_LEN - 1;
    EXPECT(CROSSGUARD_STATUS_SHORT_BUFFER, crossguard_tell(robot, event, turn));
    EXPECT(OK, crossguard_view(robot, &after));
    if (memcmp(&before, &after, sizeof before) != 0) failures++, puts("the robot has changed");
    turn->packets = packets;
    turn->packets_capacity = CROSSGUARD_PACKETS_LEN;
    /* A log of any length below that of a line: nothing is cut, and what is lost is counted. */
    for (size_t length = 0; length < 300; length += 37) {
        char *log = room(length ? length : 1);
        turn->log = log;
        turn->log_capacity = length;
        EXPECT(OK, crossguard_log_start(robot, 0, turn));
        if (turn->log_length != 0 || turn->log_lost != 1) failures++, puts("a line was cut");
        free(log);
    }
    turn->log = lines;
    turn->log_capacity = CROSSGUARD_LOG_LEN;
    EXPECT(OK, crossguard_tell(robot, event, turn));
    if (turn->outputs_length == 0 || turn->log_length == 0) failures++, puts("no output");
    EXPECT(OK, crossguard_counter(robot, 0, name, 1, &count));
    EXPECT(CROSSGUARD_STATUS_SHORT_BUFFER, crossguard_counter(robot, 0, name, 0, &count));
    EXPECT(CROSSGUARD_STATUS_END, crossguard_counter(robot, 99, name, 1, &count));
    EXPECT(OK, crossguard_robot_finish(robot));
    free(small);
}

static void versions(void) {
    EXPECT(CROSSGUARD_STATUS_WRONG_VERSION,
           crossguard_robot_init(robot, sizeof *robot, CROSSGUARD_ABI_VERSION + 1, config));
    EXPECT(OK, init(robot));
    /* The version in a robot's memory stands behind the first eight octets. */
    uint32_t version;
    memcpy(&version, (char *)robot + 8, sizeof version);
    if (version != CROSSGUARD_ABI_VERSION) failures++, puts("no version at its place");
    version++;
    memcpy((char *)robot + 8, &version, sizeof version);
    expect_no_robot(CROSSGUARD_STATUS_WRONG_VERSION, robot);
}

static void no_robots(void) {
    memset(robot, 0, sizeof *robot);
    expect_no_robot(CROSSGUARD_STATUS_NOT_INITIALISED, robot);
    memset(robot, 0xA5, sizeof *robot);
    expect_no_robot(CROSSGUARD_STATUS_NOT_INITIALISED, robot);
    CrossguardRobot *fresh = malloc(sizeof *fresh);
    expect_no_robot(CROSSGUARD_STATUS_NOT_INITIALISED, fresh);
    free(fresh);
    EXPECT(OK, init(robot));
    EXPECT(OK, crossguard_robot_finish(robot));
    expect_no_robot(CROSSGUARD_STATUS_FINISHED, robot);
    CrossguardRobot *unaligned = (CrossguardRobot *)((char *)room(sizeof *robot + 8) + 1);
    expect_no_robot(CROSSGUARD_STATUS_MISALIGNED, unaligned);
    EXPECT(CROSSGUARD_STATUS_MISALIGNED, init(unaligned));
    free((char *)unaligned - 1);
    /* A robot may be moved: it holds no address. */
    EXPECT(OK, init(robot));
    CrossguardRobot *copy = room(sizeof *copy);
    memcpy(copy, robot, sizeof *copy);
    memset(robot, 0, sizeof *robot);
    EXPECT(OK, crossguard_elapse(copy, 10, turn));
    EXPECT(OK, crossguard_robot_finish(copy));
    free(copy);
}

static void codes(void) {
    char why[256];
    EXPECT(OK, init(robot));
    for (unsigned kind = 16; kind < 256; kind++) {
        EXPECT(OK, crossguard_event_init(event, (uint8_t)kind));
        EXPECT(BAD, crossguard_tell(robot, event, turn));
    }
    crossguard_event_init(event, CROSSGUARD_EVENT_KIND_PEDESTRIAN_DETECTED);
    event->urgency = 4;
    EXPECT(BAD, crossguard_tell(robot, event, turn));
    crossguard_event_init(event, CROSSGUARD_EVENT_KIND_COMMAND_MANEUVER);
    event->task = 16;
    EXPECT(BAD, crossguard_tell(robot, event, turn));
    event->task = 1;
    event->parameters.lane = 15;
    EXPECT(BAD, crossguard_tell(robot, event, turn));
    event->parameters.lane = 3;
    event->parameters.latitude_deg = event->parameters.longitude_deg = 1;
    EXPECT(BAD, crossguard_tell(robot, event, turn));
    crossguard_event_init(event, CROSSGUARD_EVENT_KIND_AVAILABILITY_CHANGED);
    event->unavailability = 6;
    EXPECT(BAD, crossguard_tell(robot, event, turn));
    turn->body.category = 7;
    EXPECT(BAD, crossguard_elapse(robot, 1, turn));
    crossguard_body_init(&turn->body);
    EXPECT(OK, crossguard_elapse(robot, UINT32_MAX, turn));
    EXPECT(OK, crossguard_robot_finish(robot));

    *other = *config;
    other->settings.t_lease_ms = other->settings.t_safety_ms;
    EXPECT(CROSSGUARD_STATUS_BROKEN_SETTINGS, crossguard_config_check(other, why, sizeof why));
    if (!strstr(why, "lease-within-safety")) failures++, puts(why);
    EXPECT(CROSSGUARD_STATUS_BROKEN_SETTINGS,
           crossguard_robot_init(robot, sizeof *robot, CROSSGUARD_ABI_VERSION, other));
    EXPECT(CROSSGUARD_STATUS_FINISHED, crossguard_view(robot, view));
    *other = *config;
    other->settings.fallback[3] = 9;
    EXPECT(BAD, crossguard_config_check(other, why, 1));
    *other = *config;
    other->ram.btp_port = other->rmcm.btp_port;
    EXPECT(BAD, crossguard_config_check(other, NULL, 0));
    *other = *config;
    memset(other->name, 'x', sizeof other->name);
    EXPECT(BAD, crossguard_config_check(other, NULL, 0));
    if (strcmp(crossguard_status_text(4242), "no status of this library") != 0) failures++;
}

/* Whatever comes over the air, and over the boundary, a code comes back. */
static void anything(void) {
    uint32_t random = 1;
    EXPECT(OK, init(robot));
    for (int round = 0; round < 20000; round++) {
        size_t length = random % 200;
        uint8_t *packet = room(length ? length : 1);
        for (size_t i = 0; i < length; i++) {
            random = random * 1664525u + 1013904223u;
            packet[i] = (uint8_t)(random >> 24);
        }
        EXPECT(OK, round & 1 ? crossguard_receive(robot, packet, length, turn)
                             : crossguard_receive_message(robot, packet, length, turn));
        if (turn->dropped[0] == 0 && turn->heard.message == CROSSGUARD_MESSAGE_NONE) failures++;
        if (length >= sizeof *event) {
            memcpy(event, packet, sizeof *event);
            (void)crossguard_tell(robot, event, turn);
            (void)crossguard_elapse(robot, random >> 20, turn);
        }
        free(packet);
        random = random * 1664525u + 1013904223u;
    }
    EXPECT(OK, crossguard_robot_finish(robot));
}

/* Hazard: a program that does not look at the status carries out the turn of before again and again, and its sign shows go for
   ever: a call that is refused leaves nothing to carry out. */
static void refused(void) {
    EXPECT(OK, init(robot));
    for (int how = 0; how < 4; how++) {
        turn->log = lines;
        turn->log_capacity = CROSSGUARD_LOG_LEN;
        EXPECT(OK, crossguard_event_init(event, CROSSGUARD_EVENT_KIND_OPEN_CORRIDOR));
        EXPECT(OK, crossguard_tell(robot, event, turn));
        if (turn->outputs_length == 0 || turn->log_length == 0) failures++, puts("no output");
        switch (how) {
        case 0:
            turn->body.control_mode = 200;
            EXPECT(BAD, crossguard_elapse(robot, 1, turn));
            crossguard_body_init(&turn->body);
            break;
        case 1:
            event->kind = 200;
            EXPECT(BAD, crossguard_tell(robot, event, turn));
            break;
        case 2: EXPECT(IS_NULL, crossguard_receive(robot, NULL, 5, turn)); break;
        case 3: EXPECT(IS_NULL, crossguard_elapse(NULL, 1, turn)); break;
        }
        if (turn->outputs_length != 0 || turn->packets_length != 0 || turn->log_length != 0)
            failures++, printf("%d: the last turn is there again\n", how);
    }
    turn->log = NULL;
    EXPECT(OK, crossguard_robot_finish(robot));
}

/* Hazard: a clock that goes back is a time of 49 days. It passes, so that everything ends that waits for time, and is counted. */
static void clock_goes_back(void) {
    const uint32_t before = 2000, now = 1000;
    uint64_t count = 0;
    char name[CROSSGUARD_CAUSE_LEN];
    CrossguardView after;
    EXPECT(OK, init(robot));
    EXPECT(OK, crossguard_event_init(event, CROSSGUARD_EVENT_KIND_PEDESTRIAN_DETECTED));
    event->followers = 1;
    event->tasks = 1;
    EXPECT(OK, crossguard_tell(robot, event, turn));
    EXPECT(OK, crossguard_elapse(robot, now - before, turn));
    EXPECT(OK, crossguard_view(robot, &after));
    if (after.state != CROSSGUARD_STATE_IDLE) failures++, puts("it asks for help still");
    EXPECT(OK, crossguard_counter(robot, 0, name, sizeof name, &count));
    if (strcmp(name, "protocol: clock went back") != 0 || count != 1) failures++, puts(name);
    EXPECT(OK, crossguard_robot_finish(robot));
}

/* Hazard: a thread for packets and one for the time share a robot. A call that finds another one in it is refused. */
static void two_threads(void) {
    const uint32_t in_use = 1, free_again = 0;
    EXPECT(OK, init(robot));
    /* Whether a call is in the robot stands behind the first sixteen octets. */
    memcpy((char *)robot + 16, &in_use, sizeof in_use);
    expect_no_robot(CROSSGUARD_STATUS_IN_USE, robot);
    memcpy((char *)robot + 16, &free_again, sizeof free_again);
    EXPECT(OK, crossguard_elapse(robot, 1, turn));
    EXPECT(OK, crossguard_elapse(robot, 1, turn));
    EXPECT(OK, crossguard_robot_finish(robot));
}

/* What waited for too long is dropped before it is read, and says so. */
static void waits_too_long(void) {
    const uint8_t packet[4] = {0};
    EXPECT(OK, init(robot));
    for (uint32_t late = 0; late < 2; late++) {
        turn->waited_ms = config->settings.delay_max_ms + late;
        EXPECT(OK, crossguard_receive(robot, packet, sizeof packet, turn));
        int is_late = strcmp(turn->dropped, "inbox: waited too long") == 0;
        if (is_late != (int)(late == 1)) failures++;
    }
    turn->waited_ms = CROSSGUARD_NONE_MS;
    EXPECT(OK, crossguard_robot_finish(robot));
}

int main(void) {
    config = room(sizeof *config);
    other = room(sizeof *other);
    robot = room(sizeof *robot);
    turn = room(sizeof *turn);
    event = room(sizeof *event);
    view = room(sizeof *view);
    packets = room(CROSSGUARD_PACKETS_LEN);
    lines = room(CROSSGUARD_LOG_LEN);
    EXPECT(OK, crossguard_config_init(config));
    config->station = 1;
    config->boot = 1;
    EXPECT(OK, crossguard_turn_init(turn, packets, CROSSGUARD_PACKETS_LEN, NULL, 0));
    EXPECT(OK, crossguard_event_init(event, CROSSGUARD_EVENT_KIND_TASK_COMPLETED));
    null_pointers();
    short_buffers();
    versions();
    no_robots();
    codes();
    anything();
    waits_too_long();
    refused();
    clock_goes_back();
    two_threads();
    void *all[] = {config, other, robot, turn, event, view, packets, lines};
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) free(all[i]);
    printf("%d failures\n", failures);
    return failures != 0;
}
