#include "curtain_parts.h"

#include <math.h>
#include <string.h>

static const float pi = 3.14159265f;

const Level levels[] = {
    { .name = "First cut",
      .hint = "Left button: cut along the dashes. Arrows: move the basket.",
      .curtains = 1,
      .width = 1.5f,
      .height = 1.15f,
      .gather = 0.86f,
      .rings = 9,
      .marks = 1,
      .mark = { { MARK_CIRCLE, { 0.75f, 0.52f }, 0.17f } },
      .wanted = 1,
      .seconds = 60 },
    { .name = "Draught",
      .hint = "The wind carries what you cut. Right button: pull. Space: leave a hand there.",
      .curtains = 1,
      .width = 1.7f,
      .height = 1.15f,
      .gather = 0.84f,
      .rings = 9,
      .wind = 0.5f,
      .gusts = 0.8f,
      .marks = 2,
      .mark = { { MARK_HEART, { 0.5f, 0.5f }, 0.17f }, { MARK_DROP, { 1.2f, 0.5f }, 0.17f } },
      .wanted = 2,
      .seconds = 75 },
    { .name = "Two layers",
      .hint = "A blade goes through both curtains.",
      .curtains = 2,
      .width = 1.6f,
      .height = 1.1f,
      .gather = 0.84f,
      .rings = 9,
      .wind = 0.3f,
      .gusts = 0.5f,
      .marks = 1,
      .mark = { { MARK_STAR, { 0.8f, 0.5f }, 0.21f } },
      .wanted = 2,
      .seconds = 60 },
    { .name = "Weak rings",
      .hint = "Pull too hard and the rings break.",
      .curtains = 1,
      .width = 1.8f,
      .height = 1.15f,
      .gather = 0.8f,
      .rings = 8,
      .breakForce = 3.0f,
      .wind = 0.6f,
      .gusts = 1.0f,
      .marks = 3,
      .mark = { { MARK_CIRCLE, { 0.46f, 0.5f }, 0.14f },
                { MARK_HEART, { 0.9f, 0.55f }, 0.15f },
                { MARK_CIRCLE, { 1.34f, 0.5f }, 0.14f } },
      .wanted = 2,
      .seconds = 90 },
    { .name = "Workshop",
      .hint = "No clock. A new curtain comes when this one is used up.",
      .curtains = 1,
      .width = 1.7f,
      .height = 1.15f,
      .gather = 0.84f,
      .rings = 9,
      .breakForce = 6.0f,
      .wind = 0.5f,
      .gusts = 0.8f,
      .marks = 3,
      .mark = { { MARK_STAR, { 0.4f, 0.48f }, 0.17f },
                { MARK_HEART, { 0.87f, 0.62f }, 0.15f },
                { MARK_DROP, { 1.3f, 0.48f }, 0.16f } } },
};

int32_t Level_GetCount(void)
{
    return (int32_t)(sizeof levels / sizeof levels[0]);
}

/* Of a shape of radius 1, at an angle counter-clockwise from the top. */
static void GetRim(int32_t shape, float angle, float point[2])
{
    float x = -sinf(angle), y = cosf(angle), r = 1.0f;
    if (shape == MARK_STAR) { /* between tip and notch the edge is straight */
        float turn = pi / 5.0f, a = fmodf(angle, 2.0f * turn), tip = 1.0f, notch = 0.45f;
        a = a > turn ? 2.0f * turn - a : a;
        r = tip * notch * sinf(turn) / (tip * sinf(a) + notch * sinf(turn - a));
    } else if (shape == MARK_DROP) {
        r = 0.72f + 0.28f * powf(fmaxf(0.0f, cosf(angle)), 6.0f);
    } else if (shape == MARK_HEART) {
        point[0] = -0.95f * sinf(angle) * sinf(angle) * sinf(angle);
        point[1] = 0.78f * cosf(angle) - 0.30f * cosf(2.0f * angle) - 0.12f * cosf(3.0f * angle) -
                   0.06f * cosf(4.0f * angle) + 0.12f;
        return;
    }
    point[0] = r * x;
    point[1] = r * y;
}

float Mark_GetOutline(const Mark* mark, float corners[2 * MARK_CORNERS])
{
    float area = 0.0f;
    for (int32_t i = 0; i < MARK_CORNERS; i++) {
        float* corner = corners + 2 * i;
        GetRim(mark->shape, 2.0f * pi * (float)i / MARK_CORNERS, corner);
        corner[0] = mark->middle[0] + mark->radius * corner[0];
        corner[1] = mark->middle[1] + mark->radius * corner[1];
    }
    for (int32_t i = 0; i < MARK_CORNERS; i++) {
        const float *a = corners + 2 * i, *b = corners + 2 * ((i + 1) % MARK_CORNERS);
        area += 0.5f * (a[0] * b[1] - b[0] * a[1]);
    }
    return area;
}

/* ---- What a curtain looks like ---------------------------------------------------------------------------------- */

static const float grounds[2][3] = { { 0.66f, 0.13f, 0.17f }, { 0.15f, 0.33f, 0.47f } };
static const float gold[3] = { 0.93f, 0.78f, 0.45f }, chalk[3] = { 0.99f, 0.97f, 0.90f };

static void Mix(float color[3], const float other[3], float share)
{
    for (int i = 0; i < 3; i++) {
        color[i] += share * (other[i] - color[i]);
    }
}

/* Stripes of satin, a small pattern, and a golden hem. */
static void PaintGround(const Level* level, int32_t curtain, float u, float v, float color[3])
{
    memcpy(color, grounds[curtain % 2], sizeof grounds[0]);
    float stripe = fmodf(u, 0.12f), du = fmodf(u, 0.06f) - 0.03f,
          dv = fmodf(v + (fmodf(u, 0.12f) < 0.06f ? 0.0f : 0.03f), 0.06f) - 0.03f;
    float shade = stripe < 0.06f ? 1.0f : 0.92f;
    for (int i = 0; i < 3; i++) {
        color[i] *= shade;
    }
    if (fabsf(du) + fabsf(dv) < 0.007f) {
        Mix(color, gold, 0.35f);
    }
    float edge = fminf(fminf(u, level->width - u), fminf(v, level->height - v));
    if ((edge > 0.018f && edge < 0.034f) || (v > 0.05f && v < 0.056f)) {
        Mix(color, gold, 0.9f);
    }
}

/* How far the point is from the outline, and where on it in metres from its start; below 0: inside. */
static float GetDistance(const float* corners, const float point[2], float* along)
{
    float least = 1e9f, passed = 0.0f;
    bool inside = false;
    for (int32_t i = 0; i < MARK_CORNERS; i++) {
        const float *a = corners + 2 * i, *b = corners + 2 * ((i + 1) % MARK_CORNERS);
        float dx = b[0] - a[0], dy = b[1] - a[1], length = sqrtf(dx * dx + dy * dy);
        float t = ((point[0] - a[0]) * dx + (point[1] - a[1]) * dy) / (length * length);
        t = t < 0.0f ? 0.0f : t > 1.0f ? 1.0f : t;
        float x = point[0] - a[0] - t * dx, y = point[1] - a[1] - t * dy, distance = sqrtf(x * x + y * y);
        if (distance < least) {
            least = distance;
            *along = passed + t * length;
        }
        if ((a[1] > point[1]) != (b[1] > point[1]) && point[0] < a[0] + (point[1] - a[1]) / dy * dx) {
            inside = !inside;
        }
        passed += length;
    }
    return inside ? -least : least;
}

/* Chalk lies inside of the outline: a cut along it leaves none on the curtain. */
static void PaintMark(const Mark* mark, const float* corners, float u, float v, float color[3])
{
    float along = 0.0f, du = u - mark->middle[0], dv = v - mark->middle[1];
    if (du * du + dv * dv > 2.0f * mark->radius * mark->radius) {
        return;
    }
    float distance = GetDistance(corners, (float[2]){ u, v }, &along);
    if (distance < 0.0f) {
        Mix(color, gold, 0.55f);
    }
    if (distance > -0.01f && distance < 0.0f && fmodf(along, 0.036f) < 0.022f) {
        Mix(color, chalk, 0.95f);
    }
}

void Level_Paint(const Level* level, int32_t curtain, uint8_t* rgb)
{
    float corners[MAX_MARKS][2 * MARK_CORNERS];
    for (int32_t m = 0; m < level->marks; m++) {
        Mark_GetOutline(&level->mark[m], corners[m]);
    }
    for (int32_t i = 0; i < TEXTURE_SIZE * TEXTURE_SIZE; i++) {
        float u = ((float)(i % TEXTURE_SIZE) + 0.5f) / TEXTURE_SIZE * level->width, color[3];
        float v = ((float)(i / TEXTURE_SIZE) + 0.5f) / TEXTURE_SIZE * level->height;
        PaintGround(level, curtain, u, v, color);
        for (int32_t m = 0; m < level->marks; m++) {
            PaintMark(&level->mark[m], corners[m], u, v, color);
        }
        for (int k = 0; k < 3; k++) {
            rgb[3 * i + k] = (uint8_t)(255.0f * fminf(1.0f, color[k]));
        }
    }
}
