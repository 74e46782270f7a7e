/* Runs a fuzzer without libFuzzer: on files, on all files of folders, and on random bytes.

   fuzz_X [--random COUNT [SEED]] [FILE or FOLDER]...

   Random bytes that end the program are kept in fuzz_failed. */
#define _POSIX_C_SOURCE 200809L

#include "fuzz.h"
#include "support.h"

#include <dirent.h>
#include <fcntl.h>
#include <signal.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/time.h>
#include <unistd.h>

static int RunFile(const char* path)
{
    FILE* file = fopen(path, "rb");
    if (file == NULL) {
        perror(path);
        exit(1);
    }
    static uint8_t read[1 << 20];
    size_t count = fread(read, 1, sizeof(read), file);
    fclose(file);
    printf("%s\n", path);
    fflush(stdout);                                 /* it may be the last line */
    uint8_t* exact = malloc(count > 0 ? count : 1); /* so that reading beyond it is found out */
    memcpy(exact, read, count);
    LLVMFuzzerTestOneInput(exact, count);
    free(exact);
    return 1;
}

static int RunFolder(const char* path)
{
    struct dirent** entries;
    int ran = 0, count = scandir(path, &entries, NULL, alphasort);
    for (int i = 0; i < count; ++i) {
        char name[4096];
        snprintf(name, sizeof(name), "%s/%s", path, entries[i]->d_name);
        if (entries[i]->d_name[0] != '.') {
            ran += RunFile(name);
        }
        free(entries[i]);
    }
    if (count >= 0) {
        free(entries);
    }
    return ran;
}

/* ---- Random bytes ---- */

enum { MOST_BYTES = 700 };

static uint8_t bytes[MOST_BYTES];
static size_t size;

/* Only what a handler of signals may call. */
static void KeepBytes(int number)
{
    int file = open("fuzz_failed", O_WRONLY | O_CREAT | O_TRUNC, 0644);
    if (file < 0 || write(file, bytes, size) != (ssize_t)size) {
        _exit(2);
    }
    signal(number, SIG_DFL);
    raise(number);
}

/* Where a check of cmocka ends the program. */
static bool isDone = false;

static void KeepAtExit(void)
{
    if (!isDone) {
        KeepBytes(SIGABRT);
    }
}

/* By the time of the processor: a busy machine is no error. */
static void SetAlarm(int seconds)
{
    struct itimerval timer = { { 0, 0 }, { seconds, 0 } };
    setitimer(ITIMER_VIRTUAL, &timer, NULL);
}

static void RunRandom(int count, uint32_t seed)
{
    signal(SIGABRT, KeepBytes);
    signal(SIGSEGV, KeepBytes);
    signal(SIGVTALRM, KeepBytes);
    atexit(KeepAtExit);
    for (int run = 0; run < count; ++run) {
        uint32_t state = seed + 2654435761u * (uint32_t)(run + 1);
        size = Random(&state) % sizeof(bytes);
        for (size_t i = 0; i < size; ++i) {
            bytes[i] = (uint8_t)(Random(&state) >> 13);
        }
        SetAlarm(60);
        LLVMFuzzerTestOneInput(bytes, size);
    }
}

static int RunAll(int count, char** arguments)
{
    int ran = 0;
    for (int i = 1; i < count; ++i) {
        struct stat status;
        if (strcmp(arguments[i], "--random") == 0 && i + 1 < count) {
            bool hasSeed = i + 2 < count && strtoul(arguments[i + 2], NULL, 10) > 0;
            RunRandom(atoi(arguments[i + 1]), hasSeed ? (uint32_t)strtoul(arguments[i + 2], NULL, 10) : 1);
            ran += atoi(arguments[i + 1]);
            i += hasSeed ? 2 : 1;
        } else if (stat(arguments[i], &status) == 0 && S_ISDIR(status.st_mode)) {
            ran += RunFolder(arguments[i]);
        } else {
            ran += RunFile(arguments[i]);
        }
    }
    return ran;
}

int main(int count, char** arguments)
{
    int ran = RunAll(count, arguments);
    isDone = true;
    printf("[  PASSED  ] %d inputs.\n", ran);
    return ran > 0 ? 0 : 1;
}
