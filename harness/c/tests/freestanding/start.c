/*
 * A program without C library, Rust standard library and heap: two robots in static memory do a crossing,
 * each packet handed from one to the other. It says how much stack each kind of call took, and ends with 0
 * when the crossing was completed. Linked with -nostdlib, so nothing else can have come in.
 */
#include <stddef.h>
#include <stdint.h>

#include "crossguard.h"

/* What a compiler may call of its own accord. */
void *memcpy(void *to, const void *from, size_t size) {
    uint8_t *t = to;
    const uint8_t *f = from;
    while (size--) *t++ = *f++;
    return to;
}
void *memmove(void *to, const void *from, size_t size) {
    uint8_t *t = to;
    const uint8_t *f = from;
    if (t < f) return memcpy(to, from, size);
    while (size--) t[size] = f[size];
    return to;
}
void *memset(void *to, int value, size_t size) {
    uint8_t *t = to;
    while (size--) *t++ = (uint8_t)value;
    return to;
}
int memcmp(const void *a, const void *b, size_t size) {
    const uint8_t *x = a, *y = b;
    for (; size--; x++, y++)
        if (*x != *y) return *x < *y ? -1 : 1;
    return 0;
}
int bcmp(const void *a, const void *b, size_t size) { return memcmp(a, b, size); }
/* The libraries that come with the compiler were built for unwinding, which never happens here. */
void rust_eh_personality(void) {}
size_t strlen(const char *text) {
    size_t length = 0;
    while (text[length]) length++;
    return length;
}

#ifdef __x86_64__
enum { WRITE = 1, EXIT = 60 };
static void system_call(long number, long a, long b, long c) {
    __asm__ volatile("syscall" : "+a"(number) : "D"(a), "S"(b), "d"(c) : "rcx", "r11", "memory");
}
__asm__(".globl _start\n_start:\n  xor %ebp, %ebp\n  and $-16, %rsp\n  call program\n");
#else
enum { EXIT = 1, WRITE = 4 };
static void system_call(long number, long a, long b, long c) {
    __asm__ volatile("int $0x80" : "+a"(number) : "b"(a), "c"(b), "d"(c) : "memory");
}
__asm__(".globl _start\n_start:\n  xor %ebp, %ebp\n  and $-16, %esp\n  call program\n");
#endif

static void say(const char *text) { system_call(WRITE, 1, (long)text, (long)strlen(text)); }

static void say_number(size_t number) {
    char digits[24];
    size_t at = sizeof digits - 1;
    digits[at] = 0;
    do digits[--at] = (char)('0' + number % 10);
    while (number /= 10);
    say(digits + at);
}

__attribute__((noreturn)) static void end(int code) {
    for (;;) system_call(EXIT, code, 0, 0);
}

enum { LEADER, FOLLOWER };
enum { INIT, ELAPSE, TELL, RECEIVE, ANNOUNCE, VIEW, KINDS };
static const char *const names[KINDS] = {"init", "elapse", "tell", "receive", "announce", "view"};

static CrossguardRobot robots[2];
static CrossguardTurn turns[2];
static uint8_t packets[2][CROSSGUARD_PACKETS_LEN];
static CrossguardConfig config;
static CrossguardEvent event;
static CrossguardView view;
static size_t stack[KINDS];

/* The call to be measured. */
static int who;
static uint32_t elapsed;
static const uint8_t *heard;
static size_t heard_length;

static void check(CrossguardStatus status) {
    if (status == CROSSGUARD_STATUS_OK) return;
    say(crossguard_status_text(status));
    end(1);
}

__attribute__((noinline)) static void call(int kind) {
    switch (kind) {
    case INIT:
        check(crossguard_robot_init(&robots[who], sizeof robots[who], CROSSGUARD_ABI_VERSION,
                                    &config));
        break;
    case ELAPSE: check(crossguard_elapse(&robots[who], elapsed, &turns[who])); break;
    case TELL: check(crossguard_tell(&robots[who], &event, &turns[who])); break;
    case RECEIVE:
        check(crossguard_receive(&robots[who], heard, heard_length, &turns[who]));
        break;
    case ANNOUNCE: check(crossguard_announce(&robots[who], &turns[who])); break;
    default: check(crossguard_view(&robots[who], &view)); break;
    }
}

/* Paints the stack below, calls, and looks how far the paint is gone. */
#define PAINTED (64 * 1024)
#define PAINT 0xA5u
__attribute__((noinline)) static void measured(int kind) {
    uint8_t *top = (uint8_t *)__builtin_frame_address(0) - 512;
    for (size_t i = 0; i < PAINTED; i++) *(volatile uint8_t *)(top - i) = PAINT;
    call(kind);
    size_t deepest = PAINTED - 1;
    while (deepest && *(volatile uint8_t *)(top - deepest) == PAINT) deepest--;
    if (deepest + 512 > stack[kind]) stack[kind] = deepest + 512;
}

static int corridor_was_open, extensions, stopped, ended;
static CrossguardOutput running;
static int is_running;

static void tell(int robot, uint8_t kind);

static void command(uint32_t station, uint8_t task) {
    crossguard_event_init(&event, CROSSGUARD_EVENT_KIND_COMMAND_MANEUVER);
    event.station = station;
    event.task = task;
    event.parameters.latitude_deg = 49.01;
    event.parameters.longitude_deg = 8.41;
    event.parameters.maximum_speed_mps = 1.4;
}

/* The follower that the leader commands. */
static uint32_t follower_station;

/* Carries out what is not a packet. */
static void act(int robot, const CrossguardOutput *it) {
    switch (it->kind) {
    case CROSSGUARD_OUTPUT_KIND_START_MANEUVER:
        running = *it;
        is_running = 1;
        break;
    case CROSSGUARD_OUTPUT_KIND_STOP_MANEUVER:
        stopped = it->task == CROSSGUARD_TASK_BLOCK && it->reason == CROSSGUARD_REASON_TASK_COMPLETED;
        break;
    case CROSSGUARD_OUTPUT_KIND_CORRIDOR_OPENED: corridor_was_open = it->open_ms > 0; break;
    case CROSSGUARD_OUTPUT_KIND_CORRIDOR_EXTENDED: extensions++; break;
    case CROSSGUARD_OUTPUT_KIND_NOTICE:
        if (robot == LEADER && it->notice == CROSSGUARD_NOTICE_SESSION_ENDED) ended = 1;
        break;
    default: break;
    }
}

static void carry_out(int robot) {
    static CrossguardOutput outputs[2][CROSSGUARD_OUTPUTS_MAX];
    static uint8_t sent[2][CROSSGUARD_PACKETS_LEN];
    uint32_t length = turns[robot].outputs_length;
    for (uint32_t i = 0; i < length; i++) outputs[robot][i] = turns[robot].outputs[i];
    memcpy(sent[robot], packets[robot], turns[robot].packets_length);
    for (uint32_t i = 0; i < length; i++) {
        const CrossguardOutput *it = &outputs[robot][i];
        if (it->kind != CROSSGUARD_OUTPUT_KIND_SEND) {
            act(robot, it);
            continue;
        }
        who = !robot;
        heard = sent[robot] + it->packet_offset;
        heard_length = it->packet_length;
        measured(RECEIVE);
        if (robot == LEADER) {
            carry_out(FOLLOWER);
        } else {
            /* What the leader would send at once is as lost as on the air. */
            for (uint32_t j = 0; j < turns[LEADER].outputs_length; j++)
                act(LEADER, &turns[LEADER].outputs[j]);
        }
    }
}

static void tell(int robot, uint8_t kind) {
    crossguard_event_init(&event, kind);
    event.followers = 1;
    event.tasks = 1u << CROSSGUARD_TASK_INITIAL_POS | 1u << CROSSGUARD_TASK_BLOCK;
    event.session = running.session;
    event.request = running.request;
    who = robot;
    measured(TELL);
    carry_out(robot);
}

/* A leader's application, by what it sees. */
static void lead(void) {
    who = LEADER;
    measured(VIEW);
    if (!view.followers_length) return;
    const CrossguardFollower *follower = &view.followers[0];
    follower_station = follower->station;
    int is_free = follower->has_joined && !follower->is_outstanding;
    if (is_free && follower->progress == CROSSGUARD_PROGRESS_NONE) {
        command(follower_station, CROSSGUARD_TASK_INITIAL_POS);
    } else if (is_free && follower->progress == CROSSGUARD_PROGRESS_COMPLETED) {
        command(follower_station, CROSSGUARD_TASK_BLOCK);
    } else {
        if (follower->progress == CROSSGUARD_PROGRESS_IN_POSITION && !corridor_was_open)
            tell(LEADER, CROSSGUARD_EVENT_KIND_OPEN_CORRIDOR);
        /* The pedestrian of this program is across by then. */
        if (extensions == 20) tell(LEADER, CROSSGUARD_EVENT_KIND_TASK_COMPLETED);
        return;
    }
    who = LEADER;
    measured(TELL);
    carry_out(LEADER);
}

__attribute__((noreturn, used)) static void program(void) {
    for (int robot = 0; robot < 2; robot++) {
        crossguard_config_init(&config);
        config.station = (uint32_t)robot + 1;
        config.boot = 1;
        who = robot;
        measured(INIT);
        crossguard_turn_init(&turns[robot], packets[robot], sizeof packets[robot], NULL, 0);
        turns[robot].body.latitude_deg = 49.0101;
        turns[robot].body.longitude_deg = 8.4124;
        measured(ANNOUNCE);
    }
    tell(LEADER, CROSSGUARD_EVENT_KIND_PEDESTRIAN_DETECTED);
    for (uint32_t time = 0; time < 30000 && !ended; time += 20) {
        for (int robot = 0; robot < 2; robot++) {
            who = robot;
            elapsed = 20;
            turns[robot].timestamp_its += elapsed;
            measured(ELAPSE);
            carry_out(robot);
        }
        if (is_running && time % 1000 == 0) {
            is_running = 0;
            tell(FOLLOWER, running.task == CROSSGUARD_TASK_BLOCK
                               ? CROSSGUARD_EVENT_KIND_IN_POSITION
                               : CROSSGUARD_EVENT_KIND_MANEUVER_COMPLETED);
        }
        lead();
    }
    for (int kind = 0; kind < KINDS; kind++) {
        say("stack ");
        say(names[kind]);
        say(" ");
        say_number(stack[kind]);
        say("\n");
    }
    say("robot ");
    say_number(sizeof(CrossguardRobot));
    say("\n");
    int completed = ended && corridor_was_open && stopped;
    say(completed ? "crossing completed\n" : "not completed\n");
    end(!completed);
}
