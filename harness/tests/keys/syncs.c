/* Notes which files a process has put on the disk: each fsync, with the file's name and length at that moment. */

#define _GNU_SOURCE
#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>

static void note(int file)
{
    char link[64], name[4096];
    const char *to = getenv("SYNCS_FILE");
    struct stat status;
    snprintf(link, sizeof link, "/proc/self/fd/%d", file);
    ssize_t length = readlink(link, name, sizeof name - 1);
    if (to == NULL || length < 0 || fstat(file, &status) != 0) {
        return;
    }
    name[length] = '\0';
    FILE *notes = fopen(to, "a");
    if (notes != NULL) {
        fprintf(notes, "%s %lld\n", name, S_ISDIR(status.st_mode) ? -1LL : (long long)status.st_size);
        fclose(notes);
    }
}

int fsync(int file)
{
    int (*really)(int) = (int (*)(int))dlsym(RTLD_NEXT, "fsync");
    int done = really(file);
    if (done == 0) {
        note(file);
    }
    return done;
}
