/* Puts the wall clock of one process forward or back, by the seconds in the file CLOCK_STEP_FILE, which
   may change at any moment; by INT64_MIN there is none. Preloaded; other clocks go on as they are. */
#define _GNU_SOURCE
#include <errno.h>
#include <fcntl.h>
#include <stdint.h>
#include <stdlib.h>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <time.h>
#include <unistd.h>

static const volatile int64_t *step_s;

__attribute__((constructor)) static void find_step(void) {
    const char *path = getenv("CLOCK_STEP_FILE");
    int file = path ? open(path, O_RDONLY | O_CLOEXEC) : -1;
    if (file < 0)
        return;
    void *page = mmap(NULL, sizeof *step_s, PROT_READ, MAP_SHARED, file, 0);
    if (page != MAP_FAILED)
        step_s = page;
    close(file);
}

int clock_gettime(clockid_t clock, struct timespec *time) {
    int result = (int)syscall(SYS_clock_gettime, clock, time);
    if (result == 0 && clock == CLOCK_REALTIME && step_s) {
        int64_t step = *step_s;
        if (step == INT64_MIN) {
            errno = EINVAL;
            return -1;
        }
        time->tv_sec += step;
    }
    return result;
}
