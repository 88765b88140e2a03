/*
 * One robot of a crossing, in C: a leader that detects a pedestrian and commands, or a follower that
 * goes to the kerb and escorts. Its peer is another process: this program, the one in C++, or
 *
 *     crossguard run --config harness/examples/go2.toml
 *
 * Usage: crossing leader|follower STATION PORT PEER_PORT BOOT_FILE [LOG_FILE]
 *
 * It ends with 0 when the crossing was completed, with 1 when it was not, with 2 on wrong usage.
 */
#define _POSIX_C_SOURCE 200809L

#include <arpa/inet.h>
#include <errno.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <poll.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <time.h>
#include <unistd.h>

#include "crossguard.h"

/* How long a simulated maneuver takes, and how long the whole crossing may. */
#define MANEUVER_MS 1500
#define PATIENCE_MS 60000
#define EVENTS_MAX 16

typedef struct {
    bool leads;
    int link;
    struct sockaddr_in peer;
    FILE *log;
    CrossguardRobot robot;
    CrossguardTurn turn;
    uint8_t packets[CROSSGUARD_PACKETS_LEN];
    char lines[CROSSGUARD_LOG_LEN];
    uint64_t started_ms, told_ms, announced_ms;
    /* What the application wants to tell, once the outputs of this turn are carried out. */
    CrossguardEvent events[EVENTS_MAX];
    size_t events_length;
    /* The maneuver that the body is at, and when it is done. */
    bool moves;
    CrossguardOutput maneuver;
    uint64_t done_ms;
    /* The plan: 0 asks, 1 commands initialPos, 2 commands move. */
    int stage;
    uint32_t follower;
    uint64_t tried_ms;
    bool corridor_was_open;
    int maneuvers_done;
    bool completed, over;
} Application;

static uint64_t clock_us(clockid_t id) {
    struct timespec now;
    clock_gettime(id, &now);
    return (uint64_t)now.tv_sec * 1000000u + (uint64_t)now.tv_nsec / 1000u;
}

static uint64_t now_ms(void) { return clock_us(CLOCK_MONOTONIC) / 1000u; }

/* TimestampIts counts from 2004 with leap seconds, of which there were 5 since. */
static uint64_t timestamp_its(void) {
    return clock_us(CLOCK_REALTIME) / 1000u - 1072915200000u + 5000u;
}

static void fail(const char *what, CrossguardStatus status) {
    fprintf(stderr, "%s: %s\n", what, crossguard_status_text(status));
    exit(1);
}

static void check(const char *what, CrossguardStatus status) {
    if (status != CROSSGUARD_STATUS_OK) fail(what, status);
}

/* The next boot counter. It is on the disk before the robot takes part in anything. */
static uint16_t next_boot(const char *path) {
    char beside[512];
    unsigned boot = 0;
    FILE *file = fopen(path, "r");
    if (file) {
        if (fscanf(file, "%u", &boot) != 1 || boot >= UINT16_MAX) {
            fprintf(stderr, "%s: not a boot counter, or used up\n", path);
            exit(2);
        }
        fclose(file);
    }
    snprintf(beside, sizeof beside, "%s.new", path);
    file = fopen(beside, "w");
    if (!file || fprintf(file, "%u\n", boot + 1) < 0 || fflush(file) || fsync(fileno(file)) ||
        fclose(file) || rename(beside, path)) {
        perror(path);
        exit(2);
    }
    return (uint16_t)(boot + 1);
}

static void tell_later(Application *app, CrossguardEvent event) {
    if (app->events_length < EVENTS_MAX) app->events[app->events_length++] = event;
}

static CrossguardEvent event(uint8_t kind) {
    CrossguardEvent event;
    crossguard_event_init(&event, kind);
    return event;
}

static void command(Application *app, uint8_t task, double latitude, double longitude) {
    CrossguardEvent order = event(CROSSGUARD_EVENT_KIND_COMMAND_MANEUVER);
    order.station = app->follower;
    order.task = task;
    order.parameters.latitude_deg = latitude;
    order.parameters.longitude_deg = longitude;
    order.parameters.maximum_speed_mps = 1.4;
    tell_later(app, order);
}

static void open_corridor(Application *app) {
    app->tried_ms = now_ms();
    tell_later(app, event(CROSSGUARD_EVENT_KIND_OPEN_CORRIDOR));
}

/* What a leader makes of the news. */
static void lead(Application *app, const CrossguardOutput *news) {
    switch (news->notice) {
    case CROSSGUARD_NOTICE_FOLLOWER_JOINED:
        app->follower = news->station;
        app->stage = 1;
        command(app, CROSSGUARD_TASK_INITIAL_POS, 49.010091, 8.4124137);
        break;
    case CROSSGUARD_NOTICE_MANEUVER_REPORTED:
        if (app->stage == 2) open_corridor(app);
        break;
    case CROSSGUARD_NOTICE_MANEUVER_COMPLETED:
        if (app->stage == 1) {
            app->stage = 2;
            command(app, CROSSGUARD_TASK_MOVE, 49.010172, 8.4124137);
        } else {
            tell_later(app, event(CROSSGUARD_EVENT_KIND_TASK_COMPLETED));
        }
        break;
    case CROSSGUARD_NOTICE_SESSION_ENDED:
        app->over = true;
        app->completed = news->reason == CROSSGUARD_REASON_TASK_COMPLETED && app->corridor_was_open;
        break;
    default: break;
    }
}

static void start_maneuver(Application *app, const CrossguardOutput *output) {
    app->moves = true;
    app->maneuver = *output;
    app->done_ms = now_ms() + MANEUVER_MS;
    printf("starts task %u of request %u\n", output->task, output->request);
}

/* Carries out one output. */
static void carry_out(Application *app, const CrossguardOutput *output) {
    switch (output->kind) {
    case CROSSGUARD_OUTPUT_KIND_SEND:
        /* A packet that the link does not take is as lost as one on the air. */
        (void)sendto(app->link, app->packets + output->packet_offset, output->packet_length, 0,
                     (const struct sockaddr *)&app->peer, sizeof app->peer);
        break;
    case CROSSGUARD_OUTPUT_KIND_START_MANEUVER: start_maneuver(app, output); break;
    case CROSSGUARD_OUTPUT_KIND_STOP_MANEUVER:
    case CROSSGUARD_OUTPUT_KIND_FALL_BACK:
        app->moves = false;
        printf("stops request %u\n", output->request);
        break;
    case CROSSGUARD_OUTPUT_KIND_CORRIDOR_OPENED:
        app->corridor_was_open = true;
        printf("corridor open\n");
        break;
    case CROSSGUARD_OUTPUT_KIND_CORRIDOR_CLOSED: printf("corridor closed\n"); break;
    case CROSSGUARD_OUTPUT_KIND_NOTICE:
        if (app->leads) {
            lead(app, output);
        } else if (output->notice == CROSSGUARD_NOTICE_RELEASED) {
            app->over = true;
            app->completed = output->reason == CROSSGUARD_REASON_SESSION_ENDED &&
                             app->maneuvers_done == 2;
        }
        break;
    default: break;
    }
}

static void prepare(Application *app) {
    app->turn.timestamp_its = timestamp_its();
    app->turn.log_at_us = clock_us(CLOCK_MONOTONIC) - app->started_ms * 1000u;
}

static void finish_turn(Application *app) {
    for (uint32_t i = 0; i < app->turn.outputs_length; i++) carry_out(app, &app->turn.outputs[i]);
    if (app->log) fwrite(app->lines, 1, app->turn.log_length, app->log);
}

/* Time first, then what happened in it. */
static void let_time_pass(Application *app) {
    uint64_t now = now_ms();
    prepare(app);
    check("elapse", crossguard_elapse(&app->robot, (uint32_t)(now - app->told_ms), &app->turn));
    app->told_ms = now;
    finish_turn(app);
}

static void tell(Application *app, const CrossguardEvent *event) {
    let_time_pass(app);
    prepare(app);
    check("tell", crossguard_tell(&app->robot, event, &app->turn));
    finish_turn(app);
}

static void tell_all(Application *app) {
    for (size_t i = 0; i < app->events_length; i++) {
        CrossguardEvent next = app->events[i];
        tell(app, &next);
    }
    app->events_length = 0;
}

static void receive(Application *app) {
    uint8_t packet[2048];
    ssize_t length = recv(app->link, packet, sizeof packet, MSG_DONTWAIT);
    if (length < 0) return;
    let_time_pass(app);
    prepare(app);
    check("receive", crossguard_receive(&app->robot, packet, (size_t)length, &app->turn));
    if (app->turn.dropped[0]) printf("dropped, %s\n", app->turn.dropped);
    finish_turn(app);
}

/* What the application does by the clock. */
static void live(Application *app, const CrossguardView *view) {
    uint64_t now = now_ms();
    if (app->moves && now >= app->done_ms) {
        CrossguardEvent done = event(CROSSGUARD_EVENT_KIND_MANEUVER_COMPLETED);
        done.session = app->maneuver.session;
        done.request = app->maneuver.request;
        app->moves = false;
        app->maneuvers_done++;
        tell_later(app, done);
    }
    if (app->leads && app->stage == 0 && now - app->started_ms > 300) {
        CrossguardEvent detected = event(CROSSGUARD_EVENT_KIND_PEDESTRIAN_DETECTED);
        detected.followers = 1;
        detected.tasks = 1u << CROSSGUARD_TASK_INITIAL_POS | 1u << CROSSGUARD_TASK_MOVE;
        app->stage = -1;
        tell_later(app, detected);
    }
    if (app->stage == 2 && !view->is_corridor_open && !app->over && now - app->tried_ms > 200)
        open_corridor(app);
    if (view->next_ram_ms == CROSSGUARD_NONE_MS && now - app->announced_ms >= 1000) {
        app->announced_ms = now;
        let_time_pass(app);
        prepare(app);
        check("announce", crossguard_announce(&app->robot, &app->turn));
        finish_turn(app);
    }
}

static int run(Application *app) {
    for (;;) {
        CrossguardView view;
        check("view", crossguard_view(&app->robot, &view));
        if (app->over && view.state == CROSSGUARD_STATE_IDLE && !view.is_locked) break;
        if (now_ms() - app->started_ms > PATIENCE_MS) break;
        struct pollfd readable = {app->link, POLLIN, 0};
        int wait = view.next_due_ms < 20 ? (int)view.next_due_ms : 20;
        if (poll(&readable, 1, wait) > 0) receive(app);
        let_time_pass(app);
        live(app, &view);
        tell_all(app);
    }
    if (app->log) {
        prepare(app);
        check("log", crossguard_log_stop(&app->robot, &app->turn));
        finish_turn(app);
        fclose(app->log);
    }
    check("finish", crossguard_robot_finish(&app->robot));
    printf("crossing %s\n", app->completed ? "completed" : "not completed");
    return app->completed ? 0 : 1;
}

static int open_link(uint16_t port) {
    struct sockaddr_in own = {0};
    int link = socket(AF_INET, SOCK_DGRAM, 0);
    own.sin_family = AF_INET;
    own.sin_port = htons(port);
    own.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    if (link < 0 || bind(link, (const struct sockaddr *)&own, sizeof own)) {
        perror("link");
        exit(2);
    }
    return link;
}

static void start(Application *app, uint32_t station, const char *boot_file) {
    CrossguardConfig config;
    char why[256];
    crossguard_config_init(&config);
    config.station = station;
    snprintf(config.name, sizeof config.name, "C%u", (unsigned)station);
    config.boot = next_boot(boot_file);
    if (crossguard_config_check(&config, why, sizeof why) != CROSSGUARD_STATUS_OK) {
        fprintf(stderr, "%s\n", why);
        exit(2);
    }
    check("init", crossguard_robot_init(&app->robot, sizeof app->robot, CROSSGUARD_ABI_VERSION,
                                        &config));
    crossguard_turn_init(&app->turn, app->packets, sizeof app->packets,
                         app->log ? app->lines : NULL, app->log ? sizeof app->lines : 0);
    app->turn.body.latitude_deg = 49.0101;
    app->turn.body.longitude_deg = 8.4124;
    app->turn.body.speed_mps = 0;
    app->turn.body.category = app->leads ? 1 : 2;
    app->started_ms = app->told_ms = now_ms();
    if (app->log) {
        prepare(app);
        check("log", crossguard_log_start(&app->robot, clock_us(CLOCK_REALTIME) / 1000u,
                                          &app->turn));
        finish_turn(app);
    }
}

int main(int argc, char **argv) {
    static Application app;
    if (argc < 6 || argc > 7 || (strcmp(argv[1], "leader") && strcmp(argv[1], "follower"))) {
        fprintf(stderr, "usage: %s leader|follower STATION PORT PEER_PORT BOOT_FILE [LOG_FILE]\n",
                argv[0]);
        return 2;
    }
    if (crossguard_abi_version() != CROSSGUARD_ABI_VERSION) {
        fprintf(stderr, "the library is not of the version of crossguard.h\n");
        return 2;
    }
    setvbuf(stdout, NULL, _IOLBF, 0);
    app.leads = strcmp(argv[1], "leader") == 0;
    app.link = open_link((uint16_t)atoi(argv[3]));
    app.peer.sin_family = AF_INET;
    app.peer.sin_port = htons((uint16_t)atoi(argv[4]));
    app.peer.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    if (argc == 7 && !(app.log = fopen(argv[6], "w"))) {
        perror(argv[6]);
        return 2;
    }
    start(&app, (uint32_t)strtoul(argv[2], NULL, 10), argv[5]);
    return run(&app);
}
