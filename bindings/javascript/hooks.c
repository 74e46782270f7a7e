/* A table of functions in WebAssembly takes no plain functions of JavaScript: the hooks of a world are these here, which
   call functions that the module imports. `user` is the number of the world in kiri.js. */

#include "kiri/kiri.h"

#include <stdarg.h>
#include <stddef.h>

#define IMPORTED(name) __attribute__((import_module("kiri"), import_name(name)))

IMPORTED("log") void kiriHost_Log(void* user, const char* line);
IMPORTED("clock") double kiriHost_Clock(void* user);
IMPORTED("record") void kiriHost_Record(void* user, const void* bytes, int32_t count);

IMPORTED("draw") void kiriHost_Draw(int32_t corners, const kiriDrawVertex* vertices, int32_t count);

static void HostLog(void* user, const char* line)
{
    kiriHost_Log(user, line);
}

static double HostClock(void* user)
{
    return kiriHost_Clock(user);
}

static void HostRecord(void* user, const void* bytes, int32_t count)
{
    kiriHost_Record(user, bytes, count);
}

/* Whether the world has a clock, and a recording; it always has a log. */
KIRI_API void kiriHost_SetHooks(kiriWorldDef* def, int32_t user, int32_t clock, int32_t record)
{
    def->user = (void*)(intptr_t)user;
    def->log = HostLog;
    def->clock = clock ? HostClock : 0;
    def->record = record ? HostRecord : 0;
}

static void HostPoints(void* user, const kiriDrawVertex* vertices, int32_t count)
{
    (void)user;
    kiriHost_Draw(1, vertices, count);
}

static void HostLines(void* user, const kiriDrawVertex* vertices, int32_t count)
{
    (void)user;
    kiriHost_Draw(2, vertices, count);
}

static void HostTriangles(void* user, const kiriDrawVertex* vertices, int32_t count)
{
    (void)user;
    kiriHost_Draw(3, vertices, count);
}

/* What is drawn of points, lines and triangles. */
KIRI_API void kiriHost_SetDraw(kiriDebugDraw* draw, int32_t points, int32_t lines, int32_t triangles)
{
    draw->points = points ? HostPoints : 0;
    draw->lines = lines ? HostLines : 0;
    draw->triangles = triangles ? HostTriangles : 0;
}

/* Of a line that is full, the rest is left out. */
typedef struct kiriHostLine {
    char* text;
    size_t room, length;
} kiriHostLine;

static void AddChar(kiriHostLine* line, char c)
{
    if (line->length + 1 < line->room) {
        line->text[line->length] = c;
    }
    ++line->length;
}

static void AddString(kiriHostLine* line, const char* text)
{
    while (*text) {
        AddChar(line, *text++);
    }
}

static void AddNumber(kiriHostLine* line, long long number)
{
    char digits[24];
    int count = 0;
    unsigned long long rest = number < 0 ? 0 - (unsigned long long)number : (unsigned long long)number;
    if (number < 0) {
        AddChar(line, '-');
    }
    do {
        digits[count++] = (char)('0' + rest % 10);
    } while (rest /= 10);
    while (count > 0) {
        AddChar(line, digits[--count]);
    }
}

/* Messages of the library have %s and %lld only; printf of the C library would be 2 % of the module. */
int snprintf(char* restrict text, size_t room, const char* restrict format, ...)
{
    kiriHostLine line = { text, room, 0 };
    va_list arguments;
    va_start(arguments, format);
    for (const char* at = format; *at; ++at) {
        if (at[0] == '%' && at[1] == 's') {
            AddString(&line, va_arg(arguments, const char*));
            at += 1;
        } else if (at[0] == '%' && at[1] == 'l' && at[2] == 'l' && at[3] == 'd') {
            AddNumber(&line, va_arg(arguments, long long));
            at += 3;
        } else {
            AddChar(&line, *at);
        }
    }
    va_end(arguments);
    if (room > 0) {
        text[line.length < room ? line.length : room - 1] = 0;
    }
    return (int)line.length;
}
