/* Net goes back to before a cut. Of Box2D a save has what its bodies show: places, angles, velocities, sleep. How hard
   they pressed on each other in the last tick (which begins the next step), for how long they were at rest, and the
   order of contacts it does not show. So the b2World is made anew when a stroke begins, too: what follows a stroke, and
   what follows when it was taken back and is made again, begin with the same b2World, and end in the same bits. */
#include "net_game.h"

namespace
{

struct BodySave {
    b2Vec2 position, velocity;
    float angle, spin;
    bool isAwake;
    Pose before, after;
    int restTicks;
};

struct NetSave {
    std::vector<BodySave> bodies; /* as the game's; a goal has poses only */
    KiriBox2dSave touching;
    int ticks, cuts, state;
};

void FreeSave(void* save)
{
    delete static_cast<NetSave*>(save);
}

BodySave SaveOf(const NetBody& body)
{
    BodySave save = { b2Vec2_zero, b2Vec2_zero, 0.0f, 0.0f, true, body.before, body.after, body.restTicks };
    if (body.body != nullptr) {
        save.position = body.body->GetPosition();
        save.velocity = body.body->GetLinearVelocity();
        save.angle = body.body->GetAngle();
        save.spin = body.body->GetAngularVelocity();
        save.isAwake = body.body->IsAwake();
    }
    return save;
}

void Restore(NetBody* body, const BodySave& save)
{
    body->before = save.before;
    body->after = save.after;
    body->restTicks = save.restTicks;
    if (body->body != nullptr) {
        body->body->SetTransform(save.position, save.angle);
        body->body->SetLinearVelocity(save.velocity);
        body->body->SetAngularVelocity(save.spin);
        body->body->SetAwake(save.isAwake);
    }
}

NetSave* MakeSave(const NetGame& game)
{
    NetSave* save = new NetSave;
    for (const NetBody& body : game.bodies) {
        save->bodies.push_back(SaveOf(body));
    }
    save->touching = game.touching->Save();
    save->ticks = game.ticks;
    save->cuts = game.cuts;
    save->state = game.state;
    return save;
}

/* All but the kiriWorld. */
void GoOnFrom(NetGame* game, const NetSave& save)
{
    std::unique_ptr<b2World> former = NetGame_BuildBodies(game);
    for (size_t i = 0; i < game->bodies.size(); ++i) {
        Restore(&game->bodies[i], save.bodies[i]);
    }
    game->touching->Load(save.touching, game->box2d.get());
    game->ticks = save.ticks;
    game->cuts = save.cuts;
    game->state = save.state;
}

} // namespace

void NetGame_InitUndo(NetGame* game)
{
    Undo_Init(&game->undo, FreeSave);
}

/* Whether it can be kept or not, the game goes on in the same way. */
void NetGame_Keep(NetGame* game)
{
    std::unique_ptr<NetSave> save(MakeSave(*game));
    GoOnFrom(game, *save);
    Undo_Keep(&game->undo, game->world, save.release());
}

/* The mouse has to be pressed again: its stroke ends. */
bool NetGame_Undo(NetGame* game)
{
    const NetSave* save = static_cast<const NetSave*>(Undo_GetGame(&game->undo));
    if (save == nullptr || !Undo_LoadWorld(&game->undo, game->world)) {
        return false;
    }
    GoOnFrom(game, *save);
    Undo_Drop(&game->undo);
    game->blade = 0;
    game->isPressed = game->isReleased = game->hasCut = false;
    game->path.clear();
    game->trail.clear();
    for (NetSheet& sheet : game->sheets) {
        Track_Free(&sheet.track);
        Track_Init(&sheet.track, sheet.sheet);
    }
    return true;
}
