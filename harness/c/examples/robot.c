/*
 * One robot of a crossing, in C: a leader that detects a pedestrian and commands, or a follower that
 * goes to the kerb and escorts. Its peer is another process: this program, or
 *
 *     crossguard run --config harness/examples/go2.toml
 *
 * Usage: robot leader|follower STATION PORT PEER_PORT BOOT_FILE [LOG_FILE]
 *
 * Four things in it keep people alive; when you copy it, keep them and put your own robot behind them:
 *
 * 1. The sign ends go by itself, also when this program hangs: `be_sign`.
 * 2. IN_POSITION is told when the body is there, and not before: `move_body`.
 * 3. ROAD_CLEAR is told when the fallback is finished and the road was seen to be clear: `finish_duty`.
 * 4. TASK_COMPLETED is told when nobody is on the road any more: `live`.
 *
 * It is an example of the protocol alone, and no robot for a road. It leaves these rules of
 * protocol/doc/integration.md to you: it asks OPEN_CORRIDOR without a look at vehicles (27) and at the
 * places of its guards (28); its body has no sensors (24), waits for no vehicle (27) and as escort for
 * nobody (29), and does not look before it leaves the road after a boot (30).
 *
 * It ends with 0 when the crossing was completed, with 1 when it was not, with 2 on wrong usage.
 */
#define _POSIX_C_SOURCE 200809L

#include <arpa/inet.h>
#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <netinet/in.h>
#include <poll.h>
#include <signal.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include "crossguard.h"

/* How long a simulated maneuver takes, an escort, and the whole crossing at most. An escort stays until its person is off
   the road, on which people of harness/examples/ari.toml are for less than this. */
#define MANEUVER_MS 1500
#define ESCORT_MS 8000
#define PATIENCE_MS 60000
#define EVENTS_MAX 16

/* What the simulated body does. */
typedef enum { STANDS, UNDER_WAY, HOLDS_PLACE, FALLS_BACK } Doing;

typedef struct {
    bool leads;
    const char *boot_file;
    int link, sign;
    pid_t sign_process;
    struct sockaddr_in peer;
    FILE *log;
    CrossguardRobot robot;
    CrossguardTurn turn;
    uint8_t packets[CROSSGUARD_PACKETS_LEN];
    char lines[CROSSGUARD_LOG_LEN];
    uint64_t started_ms, told_ms, announced_ms, empty_ms;
    /* What the application wants to tell, once the outputs of this turn are carried out. */
    CrossguardEvent events[EVENTS_MAX];
    size_t events_length;
    /* What the body does, for which command, and when it arrives. */
    Doing doing;
    CrossguardOutput maneuver;
    uint64_t arrives_ms;
    /* The plan: 0 asks, 1 commands initialPos, 2 commands move, 3 the escort has arrived, 4 all is done. */
    int stage;
    uint32_t follower;
    uint64_t tried_ms;
    bool corridor_was_open, is_across;
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

/* The next boot counter, which is on the disk when this returns; 0 if there is none to be had. */
static uint16_t next_boot(const char *path) {
    char beside[512];
    unsigned boot = 0;
    FILE *file = fopen(path, "r");
    if (file) {
        bool is_counter = fscanf(file, "%u", &boot) == 1 && boot < UINT16_MAX;
        fclose(file);
        if (!is_counter) {
            fprintf(stderr, "%s: not a boot counter, or used up\n", path);
            return 0;
        }
    }
    snprintf(beside, sizeof beside, "%s.new", path);
    file = fopen(beside, "w");
    if (!file || fprintf(file, "%u\n", boot + 1) < 0 || fflush(file) || fsync(fileno(file)) ||
        fclose(file) || rename(beside, path)) {
        perror(path);
        return 0;
    }
    return (uint16_t)(boot + 1);
}

/*
 * The sign. It is a process of its own, as it is a device of its own on your robot, because it ends go by
 * itself: when its time is over, and when the program that renews it hangs or is gone. What it is sent is
 * the moment until which it may show go, so a message that comes late makes nothing longer.
 */
static void be_sign(int orders) {
    uint64_t go_until_ms = 0;
    bool shows_go = false;
    for (;;) {
        uint64_t now = now_ms();
        bool may = now < go_until_ms;
        if (may != shows_go) printf("sign shows %s\n", may ? "go" : "stop");
        shows_go = may;
        struct pollfd readable = {orders, POLLIN, 0};
        if (poll(&readable, 1, may ? (int)(go_until_ms - now) : -1) <= 0) continue;
        if (read(orders, &go_until_ms, sizeof go_until_ms) != sizeof go_until_ms) break;
    }
    if (shows_go) printf("sign shows stop\n");
    fflush(stdout);
    _exit(0);
}

static void start_sign(Application *app) {
    int ends[2];
    if (pipe(ends) || fcntl(ends[1], F_SETFL, O_NONBLOCK) || (app->sign_process = fork()) < 0) {
        perror("sign");
        exit(2);
    }
    if (app->sign_process == 0) {
        close(ends[1]);
        be_sign(ends[0]);
    }
    close(ends[0]);
    app->sign = ends[1];
}

/* 0 is stop. A sign that does not take the order shows stop when its time is over. */
static void show_go_until(Application *app, uint64_t until_ms) {
    if (write(app->sign, &until_ms, sizeof until_ms) < 0) fprintf(stderr, "the sign is gone\n");
}

/*
 * STANDS FOR YOUR PERCEPTION: whether nobody is on the carriageway. It is to be seen; no clock and no message
 * says it. Here an operator says it (kill -USR1), and the leader's simulated pedestrian is across when its
 * escort has arrived. What was seen before the last go or the beginning of a fallback does not count.
 */
static volatile sig_atomic_t road_was_seen_clear;

static void see_road_clear(int signal) {
    (void)signal;
    road_was_seen_clear = 1;
}

static bool road_is_clear(const Application *app) { return road_was_seen_clear || app->is_across; }

static void look_again(Application *app) {
    road_was_seen_clear = 0;
    app->is_across = false;
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
            app->stage = 3;
            app->is_across = true;
        }
        break;
    case CROSSGUARD_NOTICE_MANEUVER_FAILED:
    case CROSSGUARD_NOTICE_FOLLOWER_SAFE_IDLE:
        /* It gives up. If the corridor was open, its duty lasts until the road is seen to be clear. */
        app->stage = 4;
        tell_later(app, event(CROSSGUARD_EVENT_KIND_LEAVE_REQUESTED));
        break;
    case CROSSGUARD_NOTICE_SESSION_ENDED:
        app->over = true;
        app->completed = news->reason == CROSSGUARD_REASON_TASK_COMPLETED && app->corridor_was_open;
        break;
    default: break;
    }
}

static void start_maneuver(Application *app, const CrossguardOutput *output) {
    app->doing = UNDER_WAY;
    app->maneuver = *output;
    app->arrives_ms = now_ms() + (output->task == CROSSGUARD_TASK_MOVE ? ESCORT_MS : MANEUVER_MS);
    printf("starts task %u of request %u\n", output->task, output->request);
}

/* A body stays at its person's side to the kerb, or holds the traffic: see `policy`. Never just stop. */
static void fall_back(Application *app, const CrossguardOutput *output) {
    app->doing = FALLS_BACK;
    app->arrives_ms = now_ms() + MANEUVER_MS;
    look_again(app);
    printf("falls back from request %u by policy %u\n", output->request, output->policy);
}

/* The application's wish to tell something of the maneuver that it does. */
static void tell_of_maneuver(Application *app, uint8_t kind) {
    CrossguardEvent news = event(kind);
    news.session = app->maneuver.session;
    news.request = app->maneuver.request;
    tell_later(app, news);
}

/* A larger boot counter, on the disk before it is told. The disk may be slow: do it beside your loop. */
static void renew_epoch(Application *app) {
    CrossguardEvent renewed = event(CROSSGUARD_EVENT_KIND_EPOCH_RENEWED);
    renewed.boot = next_boot(app->boot_file);
    if (renewed.boot) tell_later(app, renewed);
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
        app->doing = STANDS;
        printf("stops request %u\n", output->request);
        break;
    case CROSSGUARD_OUTPUT_KIND_FALL_BACK: fall_back(app, output); break;
    case CROSSGUARD_OUTPUT_KIND_CORRIDOR_OPENED:
        app->corridor_was_open = true;
        look_again(app);
        show_go_until(app, app->told_ms + output->open_ms);
        printf("corridor open\n");
        break;
    case CROSSGUARD_OUTPUT_KIND_CORRIDOR_EXTENDED:
        show_go_until(app, app->told_ms + output->open_ms);
        break;
    case CROSSGUARD_OUTPUT_KIND_CORRIDOR_CLOSED:
        show_go_until(app, 0);
        printf("corridor closed\n");
        break;
    case CROSSGUARD_OUTPUT_KIND_RENEW_EPOCH: renew_epoch(app); break;
    case CROSSGUARD_OUTPUT_KIND_NOTICE:
        if (app->leads) {
            lead(app, output);
        } else if (output->notice == CROSSGUARD_NOTICE_RELEASED) {
            app->over = true;
            app->completed = output->reason == CROSSGUARD_REASON_TASK_COMPLETED;
        }
        break;
    default: break;
    }
}

/* The log's clock shows the reading by which the robot was told of time: one reading for both. */
static void prepare(Application *app) {
    app->turn.timestamp_its = timestamp_its();
    app->turn.log_at_us = (app->told_ms - app->started_ms) * 1000u;
}

static void finish_turn(Application *app) {
    for (uint32_t i = 0; i < app->turn.outputs_length; i++) carry_out(app, &app->turn.outputs[i]);
    if (app->log) fwrite(app->lines, 1, app->turn.log_length, app->log);
}

/* Time first, then what happened in it. */
static void let_time_pass(Application *app) {
    uint64_t before = app->told_ms;
    app->told_ms = now_ms();
    prepare(app);
    check("elapse", crossguard_elapse(&app->robot, (uint32_t)(app->told_ms - before), &app->turn));
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
    app->turn.waited_ms = (uint32_t)(now_ms() - app->empty_ms);
    check("receive", crossguard_receive(&app->robot, packet, (size_t)length, &app->turn));
    if (app->turn.dropped[0]) printf("dropped, %s\n", app->turn.dropped);
    finish_turn(app);
}

/* The next RAM says where the body is: a leader does not believe a follower that is elsewhere than it was sent. */
static void stand_where_sent(Application *app) {
    const CrossguardTaskParameters *sent = &app->maneuver.parameters;
    if (sent->is_offset || isnan(sent->latitude_deg) || isnan(sent->longitude_deg)) return;
    app->turn.body.latitude_deg = sent->latitude_deg;
    app->turn.body.longitude_deg = sent->longitude_deg;
}

/* The simulated body arrives. A guard that holds traffic says so and stays, until it is told to stop. */
static void move_body(Application *app, uint64_t now) {
    if (app->doing != UNDER_WAY || now < app->arrives_ms) return;
    stand_where_sent(app);
    if (app->maneuver.task == CROSSGUARD_TASK_BLOCK) {
        app->doing = HOLDS_PLACE;
        tell_of_maneuver(app, CROSSGUARD_EVENT_KIND_IN_POSITION);
    } else {
        app->doing = STANDS;
        tell_of_maneuver(app, CROSSGUARD_EVENT_KIND_MANEUVER_COMPLETED);
    }
}

/* ROAD_CLEAR, once the body has finished its fallback and the road is seen to be clear. */
static void finish_duty(Application *app, const CrossguardView *view, uint64_t now) {
    if (app->doing == FALLS_BACK && now >= app->arrives_ms && road_is_clear(app)) app->doing = STANDS;
    bool is_bound = view->duty != CROSSGUARD_DUTY_NONE ||
                    (app->leads && view->corridor == CROSSGUARD_CORRIDOR_CLEARING);
    if (is_bound && app->doing == STANDS && road_is_clear(app))
        tell_later(app, event(CROSSGUARD_EVENT_KIND_ROAD_CLEAR));
}

/* What the application does by the clock. */
static void live(Application *app, const CrossguardView *view) {
    uint64_t now = now_ms();
    move_body(app, now);
    finish_duty(app, view, now);
    if (app->leads && app->stage == 0 && now - app->started_ms > 300) {
        CrossguardEvent detected = event(CROSSGUARD_EVENT_KIND_PEDESTRIAN_DETECTED);
        detected.followers = 1;
        detected.tasks = 1u << CROSSGUARD_TASK_INITIAL_POS | 1u << CROSSGUARD_TASK_MOVE;
        app->stage = -1;
        tell_later(app, detected);
    }
    if (app->stage == 2 && view->corridor != CROSSGUARD_CORRIDOR_OPEN && !view->has_yielded &&
        !app->over && now - app->tried_ms > 200)
        open_corridor(app);
    if (app->stage == 3 && road_is_clear(app)) {
        app->stage = 4;
        tell_later(app, event(CROSSGUARD_EVENT_KIND_TASK_COMPLETED));
    }
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
        if (app->over && view.state == CROSSGUARD_STATE_IDLE && !view.is_locked &&
            view.duty == CROSSGUARD_DUTY_NONE)
            break;
        if (now_ms() - app->started_ms > PATIENCE_MS) break;
        struct pollfd readable = {app->link, POLLIN, 0};
        int wait = view.next_due_ms < 20 ? (int)view.next_due_ms : 20;
        uint64_t called = now_ms();
        int ready = poll(&readable, 1, 0);
        /* Only a link that has nothing at once is empty, and that when it was asked: this process may have been
           stopped since. A packet may have come as soon as the link was seen to be empty. */
        if (ready == 0) {
            app->empty_ms = called;
            ready = poll(&readable, 1, wait);
        }
        if (ready > 0) receive(app);
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
    close(app->sign);
    while (waitpid(app->sign_process, NULL, 0) < 0 && errno == EINTR) {}
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

static void start(Application *app, uint32_t station) {
    CrossguardConfig config;
    char why[256];
    crossguard_config_init(&config);
    config.station = station;
    snprintf(config.name, sizeof config.name, "C%u", (unsigned)station);
    config.boot = next_boot(app->boot_file);
    if (!config.boot) exit(2);
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
    app->started_ms = app->told_ms = app->empty_ms = now_ms();
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
    signal(SIGPIPE, SIG_IGN);
    signal(SIGUSR1, see_road_clear);
    start_sign(&app);
    app.leads = strcmp(argv[1], "leader") == 0;
    app.link = open_link((uint16_t)atoi(argv[3]));
    app.peer.sin_family = AF_INET;
    app.peer.sin_port = htons((uint16_t)atoi(argv[4]));
    app.peer.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    if (argc == 7 && !(app.log = fopen(argv[6], "w"))) {
        perror(argv[6]);
        return 2;
    }
    app.boot_file = argv[5];
    start(&app, (uint32_t)strtoul(argv[2], NULL, 10));
    return run(&app);
}
