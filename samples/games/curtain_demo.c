/* Curtain plays itself: it moves the basket under a mark, cuts along the outline where it is seen to be, and goes on to
   the next one. */
#include "curtain_parts.h"

#include <math.h>

enum { STEPS = 96, START_TICKS = 90, WAIT_TICKS = 210 };

/* A place on the outline, from a little beside its top all the way round and a little past the start, so that it hangs by
   its top until the end. */
static void GetWay(const Mark* mark, int32_t step, float restPoint[2])
{
    float corners[2 * MARK_CORNERS], at = ((float)step / STEPS * 1.04f - 0.02f) * MARK_CORNERS;
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
static bool LookAt(const Curtain* curtain, const Cloth* cloth, const float restPoint[2], GameEvent* event)
{
    kiriPointState point;
    float x, y;
    if (kiriSheet_GetPoint(curtain->world, cloth->sheet, restPoint, &point) != KIRI_OK ||
        !GameCamera_Project(&curtainCamera, point.position, &x, &y)) {
        return false;
    }
    event->x = (int32_t)lroundf(x);
    event->y = (int32_t)lroundf(y);
    return true;
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
        const Cloth* cloth = &curtain->cloths[demo->cloth];
        if (cloth->sheet != 0 && cloth->leftAt == 0 && !cloth->collected[demo->mark]) {
            return true;
        }
    }
    return false;
}

/* Keys that bring the basket below x. */
static int32_t Steer(Curtain* curtain, float x, GameEvent* event)
{
    float way = x - curtain->basketX;
    int32_t wanted = way > 0.02f ? 1 : way < -0.02f ? -1 : 0;
    int32_t now = curtain->basketSpeed > 0.0f ? 1 : curtain->basketSpeed < 0.0f ? -1 : 0;
    if (wanted == now) {
        return 0;
    }
    event->type = now != 0 ? GAME_KEY_RELEASED : GAME_KEY_PRESSED;
    event->key = (now != 0 ? now : wanted) > 0 ? GAME_KEY_RIGHT : GAME_KEY_LEFT;
    return 1;
}

int32_t Curtain_Demo(void* game, GameEvent* events, int32_t capacity)
{
    Curtain* curtain = game;
    struct Demo* demo = &curtain->demo;
    int32_t count = 0;
    if (capacity < 2 || curtain->tick < START_TICKS) {
        return 0;
    }
    if (demo->wait > 0) {
        demo->wait--;
    } else if (demo->step == 0 && !NextMark(curtain)) {
        return 0;
    }
    const Mark* mark = &curtain->level->mark[demo->mark];
    const Cloth* cloth = &curtain->cloths[demo->cloth];
    kiriPointState middle;
    if (kiriSheet_GetPoint(curtain->world, cloth->sheet, mark->middle, &middle) == KIRI_OK) {
        events[count] = (GameEvent){ 0 };
        count += Steer(curtain, middle.position[0], &events[count]);
    }
    float restPoint[2];
    GetWay(mark, demo->step, restPoint);
    events[count] = (GameEvent){ .type = demo->step == 0       ? GAME_DOWN
                                         : demo->step == STEPS ? GAME_UP
                                                               : GAME_MOVE,
                                 .button = GAME_LEFT };
    if (demo->wait > 0 || !LookAt(curtain, cloth, restPoint, &events[count])) {
        return count;
    }
    demo->step++;
    if (demo->step > STEPS) {
        demo->step = 0;
        demo->wait = WAIT_TICKS;
    }
    return count + 1;
}
