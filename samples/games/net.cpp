/* Net: crates of 0.05, 0.5 and 5 kg hang on ropes, nets and banners. Slice them, so that each crate comes to rest in
   its goal. All is flat: sheets are planar, and Box2D moves the crates. */
#include "games.h"
#include "net_game.h"

#include <cmath>
#include <cstdio>
#include <cstring>

namespace
{

const char* const LEVELS_PATH = "samples/games/levels/net.txt";
const int LEVELS = 6, SUBSTEPS = 2;

/* ---- The blade --------------------------------------------------------------------------------------------------- */

/* Where the mouse is, in the plane of the sheets. */
b2Vec2 PlaceOf(const NetGame& game, const GameEvent& event)
{
    float origin[3], direction[3];
    CanvasCamera_GetRay(&game.camera, static_cast<float>(event.x), static_cast<float>(event.y), origin, direction);
    float way = -origin[1] / direction[1];
    return b2Vec2(origin[0] + way * direction[0], origin[2] + way * direction[2]);
}

void Event(void* data, const GameEvent* event)
{
    NetGame* game = static_cast<NetGame*>(data);
    if (event->type == GAME_KEY_PRESSED && event->key == 'z') {
        NetGame_Undo(game);
    } else if (event->type == GAME_DOWN && event->button == GAME_LEFT && !game->isPressed) {
        NetGame_Keep(game);
        game->isPressed = true;
        game->path.assign(1, PlaceOf(*game, *event));
        game->trail.clear();
    } else if (event->type == GAME_MOVE && game->isPressed) {
        game->path.push_back(PlaceOf(*game, *event));
    } else if (event->type == GAME_UP && event->button == GAME_LEFT && game->isPressed) {
        game->path.push_back(PlaceOf(*game, *event));
        game->isReleased = true;
    }
}

/* The blade is an edge across the plane: it cuts all that it passes, from where the mouse was to where it is. */
kiriResult MoveBlade(NetGame* game)
{
    kiriResult result = KIRI_OK;
    if (game->isPressed && game->blade == 0) {
        game->hasCut = false;
        result = kiriBeginBlade(game->world, 0, &game->blade);
    }
    for (size_t i = 0; i < game->path.size() && result == KIRI_OK; ++i) {
        const float front[3] = { game->path[i].x, -0.1f, game->path[i].y };
        const float back[3] = { game->path[i].x, 0.1f, game->path[i].y };
        result = kiriBlade_MoveEdge(game->world, game->blade, front, back);
        game->trail.push_back(game->path[i]);
    }
    game->path.clear();
    if (game->isReleased && result == KIRI_OK) {
        result = kiriBlade_End(game->world, game->blade);
        game->blade = 0;
        game->isPressed = game->isReleased = false;
    }
    return result;
}

/* A stroke that cuts nothing is free. */
void CountCuts(NetGame* game)
{
    kiriProfile profile;
    if (kiriWorld_GetProfile(game->world, &profile) == KIRI_OK && profile.trianglesSplit > 0) {
        game->cuts += game->hasCut ? 0 : 1;
        game->hasCut = true;
        game->undo.hasCut = true;
        Sounds_Play(game->host->sounds, SOUND_CUT, 0.5f);
    }
    size_t keep = game->isPressed ? NET_TRAIL : game->trail.size() / 2;
    if (game->trail.size() > keep) {
        game->trail.erase(game->trail.begin(), game->trail.end() - static_cast<std::ptrdiff_t>(keep));
    }
}

/* ---- Rules ------------------------------------------------------------------------------------------------------- */

bool IsIn(const NetItem& goal, const NetBody& crate)
{
    const float* p = crate.after.position;
    bool fits = std::fabs(crate.item->value[3] - goal.value[4]) < 0.01f * goal.value[4];
    return fits && std::fabs(p[0] - goal.value[0]) < 0.5f * goal.value[2] &&
           std::fabs(p[2] - goal.value[1]) < 0.5f * goal.value[3] &&
           crate.body->GetLinearVelocity().Length() < 0.1f * NET_UNITS;
}

void Judge(NetGame* game)
{
    bool isLost = false, isWon = true;
    for (NetBody& body : game->bodies) {
        if (body.item->kind == NET_CRATE) {
            isLost = isLost || body.after.position[2] < -0.3f || std::fabs(body.after.position[0]) > 2.0f;
        } else if (body.item->kind == NET_GOAL) {
            bool isFilled = false;
            for (const NetBody& crate : game->bodies) {
                isFilled = isFilled || (crate.item->kind == NET_CRATE && IsIn(*body.item, crate));
            }
            body.restTicks = isFilled ? body.restTicks + 1 : 0;
            isWon = isWon && body.restTicks >= NET_REST_TICKS;
        }
    }
    if (game->state == GAME_PLAYING && (isLost || isWon)) {
        game->state = isWon ? GAME_WON : GAME_LOST;
        Sounds_Play(game->host->sounds, isWon ? SOUND_GOAL : SOUND_LOST, 0.8f);
    }
}

/* What has fallen out of the picture is gone: a game that goes on for long stays small. */
kiriResult DropScraps(NetGame* game)
{
    for (const NetSheet& sheet : game->sheets) {
        kiriCounts counts;
        kiriResult result = kiriSheet_GetCounts(game->world, sheet.sheet, &counts);
        for (int32_t i = counts.pieces - 1; i >= 0 && counts.pieces > 1 && result == KIRI_OK; --i) {
            kiriPieceState piece;
            const kiriFrame* frames = nullptr;
            int32_t count = 0;
            result = kiriSheet_GetPiece(game->world, sheet.sheet, i, &piece);
            if (result == KIRI_OK && piece.upper[2] < -0.5f) {
                result = kiriSheet_GetPieceFrames(game->world, sheet.sheet, i, &frames, &count);
                return result == KIRI_OK ? kiriFrame_DestroyPiece(game->world, frames[0]) : result;
            }
        }
        if (result != KIRI_OK) {
            return result;
        }
    }
    return KIRI_OK;
}

/* ---- The tick ---------------------------------------------------------------------------------------------------- */

bool Tick(void* data)
{
    NetGame* game = static_cast<NetGame*>(data);
    for (NetSheet& sheet : game->sheets) {
        Track_BeforeTick(&sheet.track, game->world);
    }
    kiriResult result = MoveBlade(game);
    if (result >= 0) {
        result = game->touching->Mirror(game->handles.data(), static_cast<int>(game->handles.size()), GAME_DT);
    }
    result = result >= 0 ? kiriWorld_Tick(game->world, GAME_DT, SUBSTEPS) : result;
    result = result >= 0 ? game->touching->GiveBack() : result;
    if (result < 0) {
        std::fprintf(stderr, "net: %s: %s\n", kiriGetResultName(result), kiriWorld_GetLastError(game->world));
        return false;
    }
    game->loudest = 0.0f;
    game->box2d->Step(GAME_DT, 8, 3);
    for (NetBody& body : game->bodies) {
        body.before = body.after;
        body.after = body.body != nullptr ? NetGame_GetPose(*body.body) : body.after;
    }
    if (game->loudest > 0.3f) {
        Sounds_Play(game->host->sounds, SOUND_CLACK, std::fmin(1.0f, 0.3f * game->loudest));
    }
    game->ticks += game->state == GAME_PLAYING ? 1 : 0;
    CountCuts(game);
    Judge(game);
    return game->ticks % 32 != 0 || DropScraps(game) >= 0;
}

/* ---- What the shell asks for ------------------------------------------------------------------------------------- */

void Stop(void* data)
{
    delete static_cast<NetGame*>(data);
}

void* Start(int32_t level, const GameHost* host)
{
    std::vector<NetLevel> levels;
    if (!NetLevel_ReadAll(LEVELS_PATH, &levels) || levels.size() < static_cast<size_t>(level)) {
        return nullptr;
    }
    NetGame* game = new NetGame;
    game->level = levels[static_cast<size_t>(level - 1)];
    game->host = host;
    if (!NetGame_Build(game)) {
        Stop(game);
        return nullptr;
    }
    return game;
}

void Draw(void* game, Canvas* canvas, float alpha)
{
    NetGame_Draw(static_cast<NetGame*>(game), canvas, alpha);
}

/* FNV-1a. */
void AddToHash(uint64_t* hash, const void* data, size_t bytes)
{
    for (size_t i = 0; i < bytes; ++i) {
        *hash = (*hash ^ static_cast<const uint8_t*>(data)[i]) * 0x100000001b3u;
    }
}

void GetStatus(void* data, GameStatus* status)
{
    const NetGame& game = *static_cast<NetGame*>(data);
    status->state = game.state;
    status->score = NetGame_GetScore(game);
    kiriWorld_GetStateHash(game.world, &status->hash);
    const int counted[] = { game.ticks, game.cuts, game.state };
    AddToHash(&status->hash, counted, sizeof counted);
    for (const NetBody& body : game.bodies) {
        if (body.body != nullptr) {
            b2Vec2 moved[] = { body.body->GetPosition(), body.body->GetLinearVelocity(),
                               b2Vec2(body.body->GetAngle(), body.body->GetAngularVelocity()) };
            AddToHash(&status->hash, moved, sizeof moved);
        }
    }
}

} // namespace

NetGame::~NetGame()
{
    Undo_Clear(&undo);
    touching.reset();
    for (NetSheet& sheet : sheets) {
        Track_Free(&sheet.track);
    }
    kiriDestroyWorld(world);
}

/* A belt carries crates along its upper side. */
void NetGame::PreSolve(b2Contact* contact, const b2Manifold*)
{
    for (b2Fixture* fixture : { contact->GetFixtureA(), contact->GetFixtureB() }) {
        const NetItem* item = reinterpret_cast<const NetItem*>(fixture->GetBody()->GetUserData().pointer);
        if (item != nullptr && item->kind == NET_BELT) {
            contact->SetTangentSpeed(item->value[4] * NET_UNITS);
        }
    }
}

void NetGame::PostSolve(b2Contact* contact, const b2ContactImpulse* impulse)
{
    for (b2Fixture* fixture : { contact->GetFixtureA(), contact->GetFixtureB() }) {
        if (fixture->GetBody()->GetMass() > 0.0f) {
            float speed = impulse->normalImpulses[0] / fixture->GetBody()->GetMass() / NET_UNITS;
            loudest = std::fmax(loudest, speed);
        }
    }
}

int NetGame_GetScore(const NetGame& game)
{
    const NetItem* par = NetGame_FindPar(game);
    float cuts = static_cast<float>(game.cuts), seconds = static_cast<float>(game.ticks) / GAME_RATE;
    float more = par != nullptr ? std::fmax(0.0f, cuts - par->value[0]) : cuts;
    float late = par != nullptr ? std::fmax(0.0f, seconds - par->value[1]) : seconds;
    return static_cast<int>(std::fmax(100.0f, 1000.0f - 150.0f * more - 20.0f * late));
}

const GameType netGame = { "net",     "slice what crates hang on, so that they come to rest in their goals",
                           "Left button: cut",
                           LEVELS,
                           Start,
                           Stop,
                           Event,
                           Tick,
                           Draw,
                           GetStatus,
                           nullptr };
