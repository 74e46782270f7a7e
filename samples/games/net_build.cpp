/* From a level to bodies, sheets and pins. */
#include "net_game.h"

#include <cmath>
#include <cstdio>

namespace
{

struct Outline {
    std::vector<float> positions;
    std::vector<int32_t> indices;
    float width, height;
};

void AddFixture(b2Body* body, const b2Shape& shape, float friction, float mass)
{
    b2MassData unit;
    shape.ComputeMass(&unit, 1.0f);
    b2FixtureDef def;
    def.shape = &shape;
    def.friction = friction;
    def.density = mass > 0.0f ? mass / unit.mass : 0.0f;
    body->CreateFixture(&def);
}

b2Body* AddBody(NetGame* game, const NetItem* item, b2BodyType type, float turn)
{
    b2BodyDef def;
    def.type = type;
    def.position.Set(item->value[0] * NET_UNITS, item->value[1] * NET_UNITS);
    def.angle = turn * b2_pi / 180.0f;
    def.userData.pointer = reinterpret_cast<uintptr_t>(item);
    b2Body* body = game->box2d->CreateBody(&def);
    game->bodies.push_back({ item, body, NetGame_GetPose(*body), NetGame_GetPose(*body), 0 });
    return body;
}

void AddBox(NetGame* game, const NetItem* item, b2BodyType type, float width, float height, float turn, float mass)
{
    b2PolygonShape box;
    box.SetAsBox(0.5f * width * NET_UNITS, 0.5f * height * NET_UNITS);
    AddFixture(AddBody(game, item, type, turn), box, 0.5f, mass);
}

void AddWheel(NetGame* game, const NetItem* item)
{
    b2CircleShape circle;
    circle.m_radius = item->value[2] * NET_UNITS;
    b2Body* wheel = AddBody(game, item, b2_kinematicBody, 0.0f);
    AddFixture(wheel, circle, 0.9f, 0.0f);
    wheel->SetAngularVelocity(item->value[3]);
}

void AddSeesaw(NetGame* game, const NetItem* item)
{
    AddBox(game, item, b2_dynamicBody, item->value[2], 0.04f, 0.0f, 0.8f);
    b2BodyDef ground;
    b2RevoluteJointDef joint;
    joint.Initialize(game->box2d->CreateBody(&ground), game->bodies.back().body,
                     game->bodies.back().body->GetPosition());
    joint.enableLimit = true;
    joint.lowerAngle = -0.4f;
    joint.upperAngle = 0.4f;
    game->box2d->CreateJoint(&joint);
    game->bodies.back().body->SetAngularDamping(0.5f);
}

/* ---- Sheets ------------------------------------------------------------------------------------------------------ */

/* A rectangle of square meshes, four quads each; `holes`: all quads of a mesh but the strands along two of its sides
   are left out. */
Outline MakeOutline(float width, float height, float quad, bool holes)
{
    int columns = static_cast<int>(width / quad + 0.5f), rows = static_cast<int>(height / quad + 0.5f);
    columns = holes ? columns / 4 * 4 + 1 : columns;
    rows = holes ? rows / 4 * 4 + 1 : rows;
    std::vector<int> seen(static_cast<size_t>((columns + 1) * (rows + 1)), -1);
    Outline outline = { {}, {}, width, height };
    auto vertex = [&](int i, int j) {
        int& known = seen[static_cast<size_t>(j * (columns + 1) + i)];
        if (known < 0) {
            known = static_cast<int>(outline.positions.size() / 2);
            outline.positions.push_back(width * static_cast<float>(i) / static_cast<float>(columns));
            outline.positions.push_back(height * static_cast<float>(j) / static_cast<float>(rows));
        }
        return known;
    };
    for (int j = 0; j < rows; ++j) {
        for (int i = 0; i < columns; ++i) {
            if (!holes || i % 4 == 0 || j % 4 == 0) {
                int a = vertex(i, j), b = vertex(i + 1, j), c = vertex(i + 1, j + 1), d = vertex(i, j + 1);
                outline.indices.insert(outline.indices.end(), { a, b, c, a, c, d });
            }
        }
    }
    return outline;
}

/* Its u runs from one point to the other; the first lies at `left` of the outline. Flat: its normal looks at us. */
bool AddSheet(NetGame* game, NetKind kind, const Outline& outline, const b2Vec2& corner, const b2Vec2& along,
              kiriSheetDef* def)
{
    def->restPositions = outline.positions.data();
    def->vertexCount = static_cast<int32_t>(outline.positions.size() / 2);
    def->indices = outline.indices.data();
    def->triangleCount = static_cast<int32_t>(outline.indices.size() / 3);
    const float position[3] = { corner.x, 0.0f, corner.y }, u[3] = { along.x, 0.0f, along.y };
    const float v[3] = { -along.y, 0.0f, along.x };
    for (int i = 0; i < 3; ++i) {
        def->position[i] = position[i];
        def->axisU[i] = u[i];
        def->axisV[i] = v[i];
    }
    def->planar = 1;
    def->skinning = KIRI_SKINNING_LINEAR;
    def->friction = 0.6f;
    def->material.airDamping = 0.3f;
    def->material.flexDamping = 0.02f;
    NetSheet made = { kind, 0, Track() };
    if (kiriCreateSheet(game->world, def, &made.sheet) != KIRI_OK) {
        return false;
    }
    Track_Init(&made.track, made.sheet);
    game->sheets.push_back(made);
    game->handles.push_back(made.sheet);
    return true;
}

/* Hangs a point of the last sheet on a peg. */
bool AddPin(NetGame* game, float u, float v, const b2Vec2& peg)
{
    kiriPinDef def;
    kiriDefaultPinDef(&def);
    def.restPoint[0] = u;
    def.restPoint[1] = v;
    def.target[0] = peg.x;
    def.target[2] = peg.y;
    game->pegs.push_back(peg);
    kiriPin pin;
    return kiriCreatePin(game->world, game->handles.back(), &def, &pin) == KIRI_OK;
}

/* A strap of rubber between two points. */
bool AddRope(NetGame* game, const b2Vec2& from, const b2Vec2& to)
{
    b2Vec2 along = to - from;
    float length = along.Normalize(), middle = 0.5f * NET_ROPE_WIDTH;
    Outline outline = MakeOutline(length, NET_ROPE_WIDTH, 0.012f, false);
    kiriSheetDef def;
    kiriDefaultSheetDef(&def);
    def.material.youngsModulus = 1e7f;
    def.material.poissonsRatio = 0.0f;
    def.material.thickness = 0.003f;
    def.material.density = 600.0f;
    def.gridResolution = static_cast<int32_t>(length / 0.008f);
    def.frameCount = static_cast<int32_t>(length / 0.05f);
    def.maxFrames = 2 * def.frameCount;
    b2Vec2 corner = from - middle * b2Vec2(-along.y, along.x);
    return AddSheet(game, NET_ROPE, outline, corner, along, &def) && AddPin(game, 0.2f * middle, middle, from) &&
           AddPin(game, length - 0.2f * middle, middle, to);
}

/* A net or a banner. */
bool AddCloth(NetGame* game, const NetItem& item)
{
    float width = item.value[2], height = item.value[3];
    b2Vec2 corner(item.value[0] - 0.5f * width, item.value[1] - 0.5f * height);
    Outline outline = MakeOutline(width, height, item.kind == NET_NET ? 0.0125f : 0.02f, item.kind == NET_NET);
    kiriSheetDef def;
    kiriDefaultSheetDef(&def);
    def.material.youngsModulus = item.kind == NET_NET ? 8e6f : 1e6f;
    def.material.poissonsRatio = 0.2f;
    def.material.thickness = 0.003f;
    def.material.density = 400.0f;
    def.gridResolution = static_cast<int32_t>(width / (item.kind == NET_NET ? 0.00625f : 0.015f));
    def.frameCount = 0;
    def.frameLength = item.kind == NET_NET ? 0.05f : 0.09f;
    def.maxFrames = 160;
    const float inset = 0.006f;
    b2Vec2 left(corner.x + inset, corner.y + height - inset), right(corner.x + width - inset, left.y);
    return AddSheet(game, item.kind, outline, corner, b2Vec2(1.0f, 0.0f), &def) &&
           AddPin(game, inset, height - inset, left) && AddPin(game, width - inset, height - inset, right);
}

void AddBodyOf(NetGame* game, const NetItem* item)
{
    const float* value = item->value;
    switch (item->kind) {
    case NET_BLOCK:
        AddBox(game, item, b2_staticBody, value[2], value[3], value[4], 0.0f);
        break;
    case NET_BELT:
        AddBox(game, item, b2_staticBody, value[2], value[3], 0.0f, 0.0f);
        break;
    case NET_WHEEL:
        AddWheel(game, item);
        break;
    case NET_SEESAW:
        AddSeesaw(game, item);
        break;
    case NET_CRATE:
        AddBox(game, item, b2_dynamicBody, value[2], value[2], 0.0f, value[3]);
        break;
    case NET_GOAL:
        game->bodies.push_back({ item, nullptr, Pose(), Pose(), 0 });
        break;
    default:
        break;
    }
}

bool AddSheetOf(NetGame* game, const NetItem* item)
{
    const float* value = item->value;
    switch (item->kind) {
    case NET_ROPE:
        return AddRope(game, b2Vec2(value[0], value[1]), b2Vec2(value[2], value[3]));
    case NET_NET:
    case NET_BANNER:
        return AddCloth(game, *item);
    default:
        return true;
    }
}

b2Vec2 BeltVelocity(b2Fixture& fixture, void*)
{
    const NetItem* item = reinterpret_cast<const NetItem*>(fixture.GetBody()->GetUserData().pointer);
    return b2Vec2(item != nullptr && item->kind == NET_BELT ? item->value[4] : 0.0f, 0.0f);
}

} // namespace

Pose NetGame_GetPose(const b2Body& body)
{
    float x = body.GetPosition().x / NET_UNITS, z = body.GetPosition().y / NET_UNITS;
    float c = std::cos(body.GetAngle()), s = std::sin(body.GetAngle());
    return { { x, 0.0f, z }, { c, 0.0f, s, -s, 0.0f, c, 0.0f, -1.0f, 0.0f } };
}

const NetItem* NetGame_FindPar(const NetGame& game)
{
    for (const NetItem& item : game.level.items) {
        if (item.kind == NET_PAR) {
            return &item;
        }
    }
    return nullptr;
}

std::unique_ptr<b2World> NetGame_BuildBodies(NetGame* game)
{
    std::unique_ptr<b2World> former = std::move(game->box2d);
    game->box2d.reset(new b2World(b2Vec2(0.0f, -9.81f * NET_UNITS)));
    game->box2d->SetContactListener(game);
    game->bodies.clear();
    for (const NetItem& item : game->level.items) {
        AddBodyOf(game, &item);
    }
    return former;
}

bool NetGame_Build(NetGame* game)
{
    if (kiriCreateWorld(&game->host->worldDef, &game->world) != KIRI_OK) {
        std::fprintf(stderr, "no world\n");
        return false;
    }
    KiriBox2dDef def;
    def.unitsPerMetre = NET_UNITS;
    def.surfaceVelocity = BeltVelocity;
    NetGame_BuildBodies(game);
    game->touching.reset(new KiriBox2d(game->world, game->box2d.get(), def));
    game->camera = NetGame_MakeCamera();
    NetGame_InitUndo(game);
    for (const NetItem& item : game->level.items) {
        if (!AddSheetOf(game, &item)) {
            std::fprintf(stderr, "level %s: %s\n", game->level.name.c_str(), kiriWorld_GetLastError(game->world));
            return false;
        }
    }
    return true;
}
