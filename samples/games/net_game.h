/* What the game Net is made of: a kiriWorld of flat sheets, a b2World of crates, and what ties them together. */
#ifndef NET_GAME_H
#define NET_GAME_H

#include "net_level.h"

#include "../box2d/kiri_box2d.h"
#include "game.h"
#include "track.h"
#include "undo.h"

#include <memory>
#include <vector>

const float NET_UNITS = 10.0f;       /* of Box2D, a metre: its slop of 0.005 units is half a millimetre */
const float NET_ROPE_WIDTH = 0.024f; /* m */
const float NET_DEPTH = 0.16f;       /* m: how deep things are drawn; they meet as if they had no end */
const float NET_HEIGHT = 2.4f;       /* m: what is seen from bottom to top, at the sheets */
const int NET_REST_TICKS = 30;       /* so long a crate rests in its goal until that counts */
const int NET_TRAIL = 14;            /* points of the blade's trail */

struct NetBody {
    const NetItem* item;
    b2Body* body;
    Pose before, after;
    int restTicks; /* of a goal: how long a crate is at rest in it */
};

struct NetSheet {
    NetKind kind;
    kiriSheet sheet;
    Track track;
};

struct NetGame : b2ContactListener {
    NetLevel level;
    const GameHost* host = nullptr;
    kiriWorld* world = nullptr;
    std::unique_ptr<b2World> box2d;
    std::unique_ptr<KiriBox2d> touching;
    std::vector<NetBody> bodies; /* one for each item that is a body; a goal has none, but is among them */
    std::vector<NetSheet> sheets;
    std::vector<kiriSheet> handles; /* the same, for KiriBox2d */
    std::vector<b2Vec2> pegs;       /* m */
    CanvasCamera camera;

    kiriBlade blade = 0;
    bool isPressed = false, isReleased = false, hasCut = false;
    std::vector<b2Vec2> path;  /* m: where the mouse was since the last tick */
    std::vector<b2Vec2> trail; /* m: and before that */

    Undo undo = Undo();

    int ticks = 0, cuts = 0, state = GAME_PLAYING;
    float loudest = 0.0f; /* speed of the hardest hit in this tick, m/s */

    ~NetGame() override;
    void PreSolve(b2Contact* contact, const b2Manifold* manifold) override;
    void PostSolve(b2Contact* contact, const b2ContactImpulse* impulse) override;
};

/* net_build.cpp. False: it says on stderr what failed. */
bool NetGame_Build(NetGame* game);
/* A b2World with its bodies as they are when the level begins. Returns the former one, into which others may still
   point. */
std::unique_ptr<b2World> NetGame_BuildBodies(NetGame* game);
Pose NetGame_GetPose(const b2Body& body);
const NetItem* NetGame_FindPar(const NetGame& game);

/* net_undo.cpp. Keep: a stroke begins. Undo: to before the last stroke that has cut; false: there is none, or it
   failed. */
void NetGame_InitUndo(NetGame* game);
void NetGame_Keep(NetGame* game);
bool NetGame_Undo(NetGame* game);

/* net_draw.cpp */
CanvasCamera NetGame_MakeCamera();
void NetGame_Draw(NetGame* game, Canvas* canvas, float alpha);

/* net.cpp */
int NetGame_GetScore(const NetGame& game);

#endif
