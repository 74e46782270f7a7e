/* How the game Net looks. */
#include "net_game.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace
{

const Color SKY = { 0.97f, 0.93f, 0.85f, 1.0f }, HAZE = { 0.86f, 0.78f, 0.68f, 1.0f };
const Color WALL = { 0.93f, 0.88f, 0.79f, 1.0f };
const Color STONE = { 0.36f, 0.40f, 0.46f, 1.0f }, STEEL = { 0.26f, 0.29f, 0.35f, 1.0f };
const Color BRASS = { 0.85f, 0.66f, 0.28f, 1.0f }, INK = { 0.17f, 0.17f, 0.22f, 1.0f };
const Color ROPE = { 0.80f, 0.30f, 0.22f, 1.0f }, NETTING = { 0.16f, 0.47f, 0.49f, 1.0f };
const Color BANNER = { 0.87f, 0.45f, 0.27f, 1.0f }, BLADE = { 1.0f, 1.0f, 1.0f, 0.9f };
const Color GOOD = { 0.25f, 0.60f, 0.33f, 1.0f }, BAD = { 0.75f, 0.22f, 0.20f, 1.0f };

/* Crates and their goals have a colour for each mass: balsa, wood and iron. */
Color ColorOf(float mass)
{
    if (mass < 0.2f) {
        return { 0.95f, 0.79f, 0.42f, 1.0f };
    }
    return mass < 2.0f ? Color{ 0.66f, 0.44f, 0.25f, 1.0f } : Color{ 0.33f, 0.39f, 0.52f, 1.0f };
}

Color Mix(const Color& a, const Color& b, float share)
{
    return { a.red + share * (b.red - a.red), a.green + share * (b.green - a.green), a.blue + share * (b.blue - a.blue),
             a.alpha + share * (b.alpha - a.alpha) };
}

Color Fade(Color color, float alpha)
{
    color.alpha = alpha;
    return color;
}

CanvasBody BodyAt(int shape, const Pose& pose, const Color& color)
{
    CanvasBody body = CanvasBody();
    body.shape = shape;
    std::copy(pose.position, pose.position + 3, body.position);
    std::copy(pose.rotation, pose.rotation + 9, body.rotation);
    body.color = color;
    return body;
}

void AddBox(Canvas* canvas, const Pose& pose, float width, float height, float depth, const Color& color)
{
    CanvasBody body = BodyAt(CANVAS_BOX, pose, color);
    body.size[0] = width;
    body.size[1] = height;
    body.size[2] = depth;
    Canvas_AddBody(canvas, &body);
}

void AddDisc(Canvas* canvas, const Pose& pose, float radius, float depth, const Color& color)
{
    CanvasBody body = BodyAt(CANVAS_CYLINDER, pose, color);
    body.radius = radius;
    body.height = depth;
    Canvas_AddBody(canvas, &body);
}

/* A point of a body's front. */
void FrontOf(const Pose& pose, float x, float y, float out[3])
{
    for (int i = 0; i < 3; ++i) {
        out[i] = pose.position[i] + pose.rotation[i] * x + pose.rotation[3 + i] * y;
    }
    out[1] -= 0.5f * NET_DEPTH + 0.002f;
}

void AddFrontLine(Canvas* canvas, const Pose& pose, float x0, float y0, float x1, float y1, float width,
                  const Color& color)
{
    float from[3], to[3];
    FrontOf(pose, x0, y0, from);
    FrontOf(pose, x1, y1, to);
    Canvas_AddLine(canvas, from, to, width, color);
}

/* Boards and their frame. */
void DrawCrate(Canvas* canvas, const Pose& pose, const NetItem& item)
{
    Color color = ColorOf(item.value[3]), dark = Mix(color, INK, 0.45f);
    float half = 0.5f * item.value[2], in = 0.72f * half;
    AddBox(canvas, pose, item.value[2], item.value[2], NET_DEPTH, color);
    AddFrontLine(canvas, pose, -in, -in, in, -in, 2.0f, dark);
    AddFrontLine(canvas, pose, in, -in, in, in, 2.0f, dark);
    AddFrontLine(canvas, pose, in, in, -in, in, 2.0f, dark);
    AddFrontLine(canvas, pose, -in, in, -in, -in, 2.0f, dark);
    AddFrontLine(canvas, pose, -in, -in, in, in, 2.0f, dark);
    if (item.value[3] > 2.0f) {
        AddFrontLine(canvas, pose, -in, in, in, -in, 2.0f, dark);
    }
}

void DrawWheel(Canvas* canvas, const Pose& pose, float radius)
{
    AddDisc(canvas, pose, radius, NET_DEPTH, STEEL);
    for (int i = 0; i < 6; ++i) {
        float angle = b2_pi * static_cast<float>(i) / 3.0f, x = 0.86f * radius * std::cos(angle);
        AddFrontLine(canvas, pose, 0.0f, 0.0f, x, 0.86f * radius * std::sin(angle), 3.0f, BRASS);
    }
}

/* Two rollers and a band; its marks run. */
void DrawBelt(Canvas* canvas, const Pose& pose, const NetItem& item, float seconds)
{
    const float pitch = 0.12f, half = 0.5f * item.value[2], top = 0.5f * item.value[3];
    AddBox(canvas, pose, item.value[2], item.value[3], NET_DEPTH, STEEL);
    float start = std::fmod(item.value[4] * seconds, pitch) - pitch;
    for (float x = -half + start; x < half; x += pitch) {
        float from = std::max(x, -half), to = std::min(x + 0.5f * pitch, half);
        if (from < to) {
            AddFrontLine(canvas, pose, from, top - 0.008f, to, top - 0.008f, 4.0f, BRASS);
        }
    }
    float way = item.value[4] > 0.0f ? 0.02f : -0.02f;
    for (int i = -1; i <= 1; ++i) {
        float x = 0.5f * half * static_cast<float>(i);
        AddFrontLine(canvas, pose, x - way, 0.3f * top, x + way, -0.2f * top, 2.5f, SKY);
        AddFrontLine(canvas, pose, x + way, -0.2f * top, x - way, -0.7f * top, 2.5f, SKY);
    }
}

void DrawBody(Canvas* canvas, const NetBody& body, float alpha, float seconds)
{
    const NetItem& item = *body.item;
    Pose pose;
    Pose_Mix(&body.before, &body.after, alpha, &pose);
    if (item.kind == NET_CRATE) {
        DrawCrate(canvas, pose, item);
    } else if (item.kind == NET_BLOCK) {
        AddBox(canvas, pose, item.value[2], item.value[3], NET_DEPTH, STONE);
    } else if (item.kind == NET_BELT) {
        DrawBelt(canvas, pose, item, seconds);
    } else if (item.kind == NET_WHEEL) {
        DrawWheel(canvas, pose, item.value[2]);
    } else if (item.kind == NET_SEESAW) {
        AddBox(canvas, pose, item.value[2], 0.04f, NET_DEPTH, BRASS);
        AddDisc(canvas, pose, 0.035f, NET_DEPTH + 0.01f, STEEL);
    }
}

/* Behind the crates, from the lower side of a goal up. */
void AddPane(Canvas* canvas, const float* goal, float height, float depth, const Color& color)
{
    Pose pose = { { goal[0], depth * NET_DEPTH, goal[1] + 0.5f * (height - goal[3]) },
                  { 1.0f, 0.0f, 0.0f, 0.0f, 0.0f, 1.0f, 0.0f, -1.0f, 0.0f } };
    CanvasBody pane = BodyAt(CANVAS_PLANE, pose, color);
    pane.size[0] = goal[2];
    pane.size[1] = height;
    pane.shadowless = true;
    Canvas_AddBody(canvas, &pane);
}

/* A frame with corners, in the colour of its crate; it fills while the crate rests there. */
void DrawGoal(Canvas* canvas, const CanvasCamera& camera, const NetBody& goal)
{
    const float* value = goal.item->value;
    const float low[3] = { value[0] - 0.5f * value[2], 0.0f, value[1] - 0.5f * value[3] };
    const float high[3] = { low[0] + value[2], 0.0f, low[2] + value[3] };
    float left, right, top, bottom;
    CanvasCamera_Project(&camera, low, &left, &bottom);
    CanvasCamera_Project(&camera, high, &right, &top);
    float done = std::min(1.0f, static_cast<float>(goal.restTicks) / NET_REST_TICKS);
    Color color = done >= 1.0f ? GOOD : Mix(ColorOf(value[4]), INK, 0.15f);
    AddPane(canvas, value, value[3], 1.0f, Fade(color, 0.20f));
    AddPane(canvas, value, done * value[3], 0.9f, Fade(GOOD, 0.35f));
    float arm = 0.25f * std::min(right - left, bottom - top);
    for (int i = 0; i < 4; ++i) {
        float x = i % 2 != 0 ? right : left, y = i / 2 != 0 ? bottom : top;
        float dx = i % 2 != 0 ? -arm : arm, dy = i / 2 != 0 ? -arm : arm;
        const float corner[6] = { x + dx, y, x, y, x, y + dy };
        Canvas_AddStroke(canvas, corner, 3, 4.0f, color);
    }
}

void DrawSheets(NetGame* game, Canvas* canvas, float alpha)
{
    const Color colors[] = { ROPE, NETTING, BANNER };
    for (NetSheet& sheet : game->sheets) {
        CanvasSheet seen = CanvasSheet();
        if (!Track_Get(&sheet.track, game->world, alpha, &seen)) {
            continue;
        }
        seen.front = seen.back = colors[sheet.kind == NET_BANNER ? 2 : sheet.kind == NET_NET ? 1 : 0];
        seen.lip = Mix(seen.front, SKY, 0.7f);
        seen.rim = Mix(seen.front, INK, 0.4f);
        seen.lineWidth = 1.2f;
        Canvas_AddSheet(canvas, &seen);
    }
    for (const b2Vec2& peg : game->pegs) {
        Pose pose = { { peg.x, 0.0f, peg.y }, { 1.0f, 0.0f, 0.0f, 0.0f, 0.0f, 1.0f, 0.0f, -1.0f, 0.0f } };
        AddDisc(canvas, pose, 0.02f, 0.5f * NET_DEPTH, BRASS);
    }
}

void DrawTrail(const NetGame& game, Canvas* canvas)
{
    for (size_t i = 1; i < game.trail.size(); ++i) {
        float ends[4];
        for (size_t k = 0; k < 2; ++k) {
            const b2Vec2& place = game.trail[i - 1 + k];
            const float point[3] = { place.x, 0.0f, place.y };
            CanvasCamera_Project(&game.camera, point, &ends[2 * k], &ends[2 * k + 1]);
        }
        float share = static_cast<float>(i) / static_cast<float>(game.trail.size());
        Canvas_AddStroke(canvas, ends, 2, 2.0f + 5.0f * share, Fade(BLADE, 0.9f * share));
    }
}

void DrawHud(const NetGame& game, Canvas* canvas)
{
    char text[96], title[96];
    const bool isWon = game.state == GAME_WON, isOver = game.state != GAME_PLAYING;
    const NetItem* par = NetGame_FindPar(game);
    Canvas_AddRectangle(canvas, 0.0f, 0.0f, GAME_WIDTH, 46.0f, isOver ? isWon ? GOOD : BAD : Fade(INK, 0.82f));
    const char* result = isOver ? isWon ? ": well cut" : ": dropped" : "";
    std::snprintf(title, sizeof title, "%s%s", game.level.name.c_str(), result);
    Canvas_AddText(canvas, 18.0f, 14.0f, 18.0f, 0.0f, SKY, title);
    if (isOver) {
        std::snprintf(text, sizeof text, isWon ? "score %d   N: next level   R: again" : "R: again",
                      NetGame_GetScore(game));
    } else {
        std::snprintf(text, sizeof text, "cuts %d, par %d   time %d.%d s   score %d", game.cuts,
                      par != nullptr ? static_cast<int>(par->value[0]) : 0, game.ticks / GAME_RATE,
                      game.ticks % GAME_RATE / 6, NetGame_GetScore(game));
    }
    Canvas_AddText(canvas, GAME_WIDTH - 18.0f, 14.0f, 18.0f, 1.0f, SKY, text);
    if (!isOver) {
        Canvas_AddText(canvas, 0.5f * GAME_WIDTH, GAME_HEIGHT - 26.0f, 15.0f, 0.5f, Fade(INK, 0.85f),
                       game.level.hint.c_str());
    }
}

} // namespace

CanvasCamera NetGame_MakeCamera()
{
    const float fieldOfView = 16.0f, away = 0.5f * NET_HEIGHT / std::tan(0.5f * fieldOfView * b2_pi / 180.0f);
    return { { 0.0f, -away, 1.12f }, { 0.0f, 0.0f, 1.12f }, fieldOfView, NET_HEIGHT };
}

void NetGame_Draw(NetGame* game, Canvas* canvas, float alpha)
{
    Canvas_Begin(canvas, &game->camera, SKY, HAZE);
    Canvas_SetWall(canvas, 0.25f, WALL);
    float seconds = (static_cast<float>(game->ticks) + alpha - 1.0f) * GAME_DT;
    for (const NetBody& body : game->bodies) {
        if (body.item->kind == NET_GOAL) {
            DrawGoal(canvas, game->camera, body);
        } else {
            DrawBody(canvas, body, alpha, seconds);
        }
    }
    DrawSheets(game, canvas, alpha);
    DrawTrail(*game, canvas);
    DrawHud(*game, canvas);
}
