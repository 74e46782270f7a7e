#include "lines.h"

#include <stdlib.h>
#include <string.h>

static void AddVertices(Lines* lines, Vertices* to, const kiriDrawVertex* vertices, int32_t count)
{
    if (to->count + count > to->capacity) {
        int32_t capacity = 2 * to->capacity + count;
        kiriDrawVertex* data = realloc(to->data, (size_t)capacity * sizeof(kiriDrawVertex));
        lines->isShort = lines->isShort || data == NULL;
        if (data == NULL) {
            return;
        }
        to->data = data;
        to->capacity = capacity;
    }
    memcpy(to->data + to->count, vertices, (size_t)count * sizeof(kiriDrawVertex));
    to->count += count;
}

static void AddPoints(void* user, const kiriDrawVertex* vertices, int32_t count)
{
    Lines* lines = user;
    AddVertices(lines, &lines->points, vertices, count);
}

static void AddLines(void* user, const kiriDrawVertex* vertices, int32_t count)
{
    Lines* lines = user;
    AddVertices(lines, &lines->lines, vertices, count);
}

bool Lines_Add(Lines* lines, const kiriWorld* world, kiriSheet sheet, uint32_t flags, float size, int kinds)
{
    kiriDebugDraw draw;
    kiriDefaultDebugDraw(&draw);
    draw.flags = flags;
    draw.sheet = sheet;
    draw.size = size;
    draw.points = (kinds & LINES_POINTS) != 0 ? AddPoints : NULL;
    draw.lines = (kinds & LINES_LINES) != 0 ? AddLines : NULL;
    draw.user = lines;
    return kiriWorld_DebugDraw(world, &draw) == KIRI_OK && !lines->isShort;
}

void Lines_Clear(Lines* lines)
{
    lines->points.count = lines->lines.count = 0;
    lines->isShort = false;
}

void Lines_Free(Lines* lines)
{
    free(lines->points.data);
    free(lines->lines.data);
    *lines = (Lines){ .isShort = false };
}
