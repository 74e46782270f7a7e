/* Curtain plays itself. It moves the basket under a mark, cuts along the outline where it is seen to be, and goes on to
   the next one; in a level without end it also cuts corners off, and pulls. */
#include "curtain_parts.h"

#include <math.h>

enum { MARK_STEPS = 96, SLASH_STEPS = 24, PULL_STEPS = 80, START_TICKS = 90, WAIT_TICKS = 150, SHORT_WAIT_TICKS = 40 };

enum Job { JOB_MARK, JOB_SLASH_LEFT, JOB_SLASH_RIGHT, JOB_PULL };

/* What it does in a level without end, over and over. */
static const int32_t endless[] = { JOB_SLASH_LEFT, JOB_MARK, JOB_PULL, JOB_MARK, JOB_SLASH_RIGHT, JOB_PULL, JOB_MARK };

enum { ENDLESS = sizeof endless / sizeof endless[0] };

/* A place on the outline, from a little beside its top all the way round and a little past the start, so that it hangs
   by its top until the end. */
static void GetWay(const Mark* mark, int32_t step, float restPoint[2])
{
    float corners[2 * MARK_CORNERS], at = ((float)step / MARK_STEPS * 1.04f - 0.02f) * MARK_CORNERS;
    Mark_GetOutline(mark, corners);
    int32_t from = (int32_t)floorf(at);
    float share = at - (float)from;
    const float* a = corners + 2 * ((from + MARK_CORNERS) % MARK_CORNERS);
    const float* b = corners + 2 * ((from + 1 + MARK_CORNERS) % MARK_CORNERS);
    for (int i = 0; i < 2; i++) {
        restPoint[i] = a[i] + share * (b[i] - a[i]);
    }
}

/* Where a place of the material is seen; false when it is gone. */
static bool LookAt(const Curtain* curtain, float u, float v, float* x, float* y)
{
    const Cloth* cloth = &curtain->cloths[curtain->demo.cloth];
    const float restPoint[2] = { u, v };
    kiriPointState point;
    return kiriSheet_GetPoint(curtain->world, cloth->sheet, restPoint, &point) == KIRI_OK &&
           CanvasCamera_Project(&curtainCamera, point.position, x, y);
}

/* Across a lower corner of the curtain, from outside to outside. */
static bool GetSlash(const Curtain* curtain, bool left, float t, float* x, float* y)
{
    const Level* level = curtain->level;
    float side = left ? 0.004f : level->width - 0.004f, in = left ? 0.24f : -0.24f, a[2], b[2];
    if (!LookAt(curtain, side, 0.3f, &a[0], &a[1]) || !LookAt(curtain, side + in, 0.004f, &b[0], &b[1])) {
        return false;
    }
    *x = a[0] + (1.5f * t - 0.25f) * (b[0] - a[0]);
    *y = a[1] + (1.5f * t - 0.25f) * (b[1] - a[1]);
    return true;
}

/* The hem is pulled down and aside, and let go. */
static bool GetPull(Curtain* curtain, float t, float* x, float* y)
{
    struct Demo* demo = &curtain->demo;
    if (demo->step == 0) {
        bool seen = LookAt(curtain, 0.62f * curtain->level->width, 0.1f, x, y);
        demo->x = (int32_t)*x;
        demo->y = (int32_t)*y;
        return seen;
    }
    *x = (float)demo->x + 150.0f * t;
    *y = (float)demo->y + 130.0f * t * t;
    return true;
}

static int32_t GetSteps(int32_t job)
{
    return job == JOB_MARK ? MARK_STEPS : job == JOB_PULL ? PULL_STEPS : SLASH_STEPS;
}

static bool GetPlace(Curtain* curtain, GameEvent* event)
{
    struct Demo* demo = &curtain->demo;
    float x = 0.0f, y = 0.0f, restPoint[2], t = (float)demo->step / (float)GetSteps(demo->job);
    bool seen;
    if (demo->job == JOB_MARK) {
        GetWay(&curtain->level->mark[demo->mark], demo->step, restPoint);
        seen = LookAt(curtain, restPoint[0], restPoint[1], &x, &y);
    } else if (demo->job == JOB_PULL) {
        seen = GetPull(curtain, t, &x, &y);
    } else {
        seen = GetSlash(curtain, demo->job == JOB_SLASH_LEFT, t, &x, &y);
    }
    event->x = (int32_t)lroundf(x);
    event->y = (int32_t)lroundf(y);
    return seen;
}

/* The next mark that nobody has cut; false: there is none. */
static bool NextMark(Curtain* curtain)
{
    struct Demo* demo = &curtain->demo;
    for (int32_t i = 0; i < MAX_CLOTHS * MAX_MARKS; i++) {
        demo->mark++;
        if (demo->mark >= curtain->level->marks) {
            demo->mark = 0;
            demo->cloth = (demo->cloth + 1) % MAX_CLOTHS;
        }
        if (Curtain_HasMark(curtain, &curtain->cloths[demo->cloth], demo->mark)) {
            return true;
        }
    }
    return false;
}

/* Keys that bring the basket below x. */
static int32_t Steer(const Curtain* curtain, float x, GameEvent* event)
{
    float way = x - curtain->basketX;
    int32_t wanted = way > 0.02f ? 1 : way < -0.02f ? -1 : 0;
    int32_t now = curtain->basketSpeed > 0.0f ? 1 : curtain->basketSpeed < 0.0f ? -1 : 0;
    if (wanted == now) {
        return 0;
    }
    *event = (GameEvent){ .type = now != 0 ? GAME_KEY_RELEASED : GAME_KEY_PRESSED };
    event->key = (now != 0 ? now : wanted) > 0 ? GAME_KEY_RIGHT : GAME_KEY_LEFT;
    return 1;
}

/* The basket goes with the mark, also while it falls, and stops when it is near. */
static int32_t SteerToMark(const Curtain* curtain, GameEvent* event)
{
    const struct Demo* demo = &curtain->demo;
    kiriPointState middle;
    if (demo->mark < 0 || kiriSheet_GetPoint(curtain->world, curtain->cloths[demo->cloth].sheet,
                                             curtain->level->mark[demo->mark].middle, &middle) != KIRI_OK) {
        return 0;
    }
    bool isLow = middle.position[2] < 1.5f * basketSize[2];
    return Steer(curtain, isLow ? curtain->basketX : middle.position[0], event);
}

/* The job goes one step on. */
static int32_t Work(Curtain* curtain, GameEvent* event)
{
    struct Demo* demo = &curtain->demo;
    int32_t steps = GetSteps(demo->job);
    *event = (GameEvent){ .type = demo->step == 0       ? GAME_DOWN
                                  : demo->step == steps ? GAME_UP
                                                        : GAME_MOVE,
                          .button = demo->job == JOB_PULL ? GAME_RIGHT : GAME_LEFT };
    if (!GetPlace(curtain, event)) { /* what it held on to is gone */
        event->type = GAME_UP;
        demo->step = steps;
    }
    if (demo->step++ == steps) {
        demo->step = 0;
        demo->wait = demo->job == JOB_MARK ? WAIT_TICKS : SHORT_WAIT_TICKS;
    }
    return 1;
}

int32_t Curtain_Demo(void* game, GameEvent* events, int32_t capacity)
{
    Curtain* curtain = game;
    struct Demo* demo = &curtain->demo;
    if (capacity < 2 || curtain->tick < START_TICKS) {
        return 0;
    }
    int32_t count = SteerToMark(curtain, events);
    if (demo->wait > 0) {
        demo->wait--;
        return count;
    }
    if (demo->step == 0) {
        demo->job = curtain->level->wanted == 0 ? endless[demo->jobs++ % ENDLESS] : JOB_MARK;
        if (demo->job == JOB_MARK && !NextMark(curtain)) {
            return count;
        }
    }
    return count + Work(curtain, events + count);
}
