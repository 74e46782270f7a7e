#include "kiri_box2d.h"

#include <algorithm>

namespace
{

struct Near : b2QueryCallback {
    std::vector<b2Fixture*> fixtures;
    bool ReportFixture(b2Fixture* fixture) override
    {
        if (std::find(fixtures.begin(), fixtures.end(), fixture) == fixtures.end()) {
            fixtures.push_back(fixture);
        }
        return true;
    }
};

/* A one-sided edge is solid to its left. Its corner down there halves the angle with the next edge, so that both fit; it
   leans by 45 degrees at most, so that edges do not stand out of each other's ground. */
b2Vec2 GroundCorner(const b2Vec2& corner, const b2Vec2& inward, b2Vec2 next, float depth)
{
    next.Normalize();
    float lean = b2Cross(inward, next) / std::max(1.0f + b2Dot(inward, next), 1e-3f);
    return corner + depth * (inward + b2Clamp(lean, -1.0f, 1.0f) * b2Cross(1.0f, inward));
}

std::vector<b2Vec2> EdgeOutline(const b2EdgeShape& edge, float depth)
{
    const b2Vec2 &a = edge.m_vertex1, &b = edge.m_vertex2;
    b2Vec2 inward = b2Cross(1.0f, b - a);
    depth = std::min(depth, 0.4f * inward.Normalize());
    if (!edge.m_oneSided) {
        b2Vec2 half = b2_linearSlop * inward;
        return { a - half, b - half, b + half, a + half };
    }
    return { a, b, GroundCorner(b, inward, b2Cross(1.0f, edge.m_vertex3 - b), depth),
             GroundCorner(a, inward, b2Cross(1.0f, a - edge.m_vertex0), depth) };
}

/* Of a child that is no circle: convex, counter-clockwise, in the axes of its body. */
std::vector<b2Vec2> OutlineOf(const b2Shape& shape, int child, float ground)
{
    if (shape.GetType() == b2Shape::e_polygon) {
        const b2PolygonShape& polygon = static_cast<const b2PolygonShape&>(shape);
        return std::vector<b2Vec2>(polygon.m_vertices, polygon.m_vertices + polygon.m_count);
    }
    if (shape.GetType() == b2Shape::e_edge) {
        return EdgeOutline(static_cast<const b2EdgeShape&>(shape), ground);
    }
    b2EdgeShape edge;
    static_cast<const b2ChainShape&>(shape).GetChildEdge(&edge, child);
    return EdgeOutline(edge, ground);
}

/* 0: nothing moves it. */
float MassOf(const b2Body& body)
{
    return body.GetType() == b2_dynamicBody ? body.GetMass() : 0.0f;
}

/* About its centre of mass; 0: it does not turn. */
float InertiaOf(const b2Body& body)
{
    return std::max(0.0f, body.GetInertia() - body.GetMass() * body.GetLocalCenter().LengthSquared());
}

} // namespace

KiriBox2d::KiriBox2d(kiriWorld* world, b2World* box2d, const KiriBox2dDef& how)
    : kiri(world), bodies(box2d), def(how), metres(1.0f / how.unitsPerMetre), axis(how.up == 1 ? 1.0f : -1.0f)
{
}

KiriBox2d::~KiriBox2d()
{
    for (const Part& part : parts) {
        kiriDestroyObstacle(kiri, part.obstacle);
    }
}

void KiriBox2d::ToKiri(const b2Vec2& vector, float scale, float out[3]) const
{
    out[0] = scale * vector.x;
    out[def.up] = scale * vector.y;
    out[3 - def.up] = 0.0f;
}

void KiriBox2d::Check(kiriResult result)
{
    failure = failure == KIRI_OK ? result : failure;
}

/* ---- Obstacles ---------------------------------------------------------------------------------------------------- */

KiriBox2d::Part* KiriBox2d::FindPart(const b2Fixture* fixture, int child)
{
    auto is = [&](const Part& part) { return part.fixture == fixture && part.child == child; };
    auto found = std::find_if(parts.begin(), parts.end(), is);
    return found == parts.end() ? nullptr : &*found;
}

void KiriBox2d::AddPart(b2Fixture* fixture, int child)
{
    const b2Shape& shape = *fixture->GetShape();
    Part part = { fixture, child, 0, b2Vec2_zero, true, false };
    std::vector<b2Vec2> outline;
    kiriObstacleDef obstacle;
    kiriDefaultObstacleDef(&obstacle);
    obstacle.height = def.depth;
    if (shape.GetType() == b2Shape::e_circle) {
        obstacle.type = KIRI_OBSTACLE_CYLINDER;
        obstacle.radius = shape.m_radius * metres;
        part.place = static_cast<const b2CircleShape&>(shape).m_p;
    } else {
        outline = OutlineOf(shape, child, def.ground / metres);
        std::for_each(outline.begin(), outline.end(), [this](b2Vec2& corner) { corner *= metres; });
        obstacle.type = KIRI_OBSTACLE_PRISM;
        obstacle.outline = &outline[0].x;
        obstacle.outlineCount = static_cast<int32_t>(outline.size());
    }
    obstacle.friction = fixture->GetFriction();
    obstacle.groups = def.groups != nullptr ? def.groups(*fixture, def.user) : ~0u;
    Memory& memory = memories[fixture->GetBody()];
    obstacle.body = memory.number = memory.number != 0 ? memory.number : ++numbers;
    Check(kiriCreateObstacle(kiri, &obstacle, &part.obstacle));
    if (part.obstacle != 0) {
        parts.push_back(part);
    }
}

kiriObstacle KiriBox2d::Hold(b2Fixture* fixture)
{
    failure = KIRI_OK;
    if (FindPart(fixture, 0) == nullptr) {
        AddPart(fixture, 0);
    }
    Part* part = FindPart(fixture, 0);
    if (part == nullptr) {
        return 0;
    }
    part->isHeld = true;
    SetMotion(*part, 0.0f);
    return part->obstacle;
}

void KiriBox2d::Forget(const b2Fixture* fixture)
{
    for (Part& part : parts) {
        part.isNear = part.fixture != fixture;
        part.isHeld = part.isHeld && part.isNear;
    }
    DropFar();
}

void KiriBox2d::DropFar()
{
    std::unordered_map<b2Body*, Memory> old;
    std::vector<Part> all;
    old.swap(memories);
    all.swap(parts);
    for (const Part& part : all) {
        if (part.isNear || part.isHeld) {
            parts.push_back(part);
            memories[part.fixture->GetBody()] = old[part.fixture->GetBody()];
        } else {
            kiriDestroyObstacle(kiri, part.obstacle);
        }
    }
}

/* ---- Before the tick ---------------------------------------------------------------------------------------------- */

void KiriBox2d::Find(kiriSheet sheet, float dt)
{
    float lower[3], upper[3];
    Check(kiriSheet_GetReach(kiri, sheet, dt, lower, upper));
    if (failure != KIRI_OK) {
        return;
    }
    b2AABB box = { b2Vec2(lower[0] / metres, lower[def.up] / metres),
                   b2Vec2(upper[0] / metres, upper[def.up] / metres) };
    Near near;
    bodies->QueryAABB(&near, box);
    for (b2Fixture* fixture : near.fixtures) {
        bool isTouched = !fixture->IsSensor() && (def.groups == nullptr || def.groups(*fixture, def.user) != 0);
        for (int child = 0; isTouched && child < fixture->GetShape()->GetChildCount(); ++child) {
            bool isNear = b2TestOverlap(fixture->GetAABB(child), box);
            if (isNear && FindPart(fixture, child) == nullptr) {
                AddPart(fixture, child);
            } else if (isNear) {
                FindPart(fixture, child)->isNear = true;
            }
        }
    }
}

kiriResult KiriBox2d::Mirror(const kiriSheet* sheets, int count, float dt)
{
    failure = KIRI_OK;
    std::for_each(parts.begin(), parts.end(), [](Part& part) { part.isNear = false; });
    std::for_each(sheets, sheets + count, [=](kiriSheet sheet) { Find(sheet, dt); });
    DropFar();
    for (const Part& part : parts) {
        SetMotion(part, dt);
        SetMass(part);
    }
    return failure;
}

/* How the body will move. What Box2D did to it in the last step beside our impulses, as weight and what carries it, it
   will do again: else a sheet on a crate would feel it fall in each tick, and one below a crate would not. */
void KiriBox2d::Predict(b2Body* body, float dt, b2Vec2* velocity, float* spin)
{
    Memory& memory = memories[body];
    float mass = MassOf(*body), inertia = InertiaOf(*body);
    *velocity = body->GetLinearVelocity();
    *spin = body->GetAngularVelocity();
    memory.isCarried = memory.isKnown && !body->IsAwake() && memory.impulse.LengthSquared() > 0.0f;
    if (mass > 0.0f && !memory.isCarried) {
        b2Vec2 weight = (body->IsAwake() ? dt * body->GetGravityScale() : 0.0f) * bodies->GetGravity();
        b2Vec2 done = memory.isKnown ? *velocity - memory.velocity : weight;
        float most = weight.Length() + 2.0f / mass * memory.impulse.Length();
        *velocity += std::min(1.0f, most / std::max(done.Length(), b2_epsilon)) * done;
        most = inertia > 0.0f && memory.isKnown ? 2.0f / inertia * b2Abs(memory.turn) : 0.0f;
        *spin += b2Clamp(*spin - memory.spin, -most, most);
    }
}

void KiriBox2d::SetMotion(const Part& part, float dt)
{
    b2Body* body = part.fixture->GetBody();
    b2Vec2 place = body->GetWorldPoint(part.place), velocity;
    float spin, position[3], rotation[9] = { 0.0f }, speed[3], turning[3] = { 0.0f }, surface[3];
    Predict(body, dt, &velocity, &spin);
    ToKiri(place, metres, position);
    ToKiri(body->GetWorldVector(b2Vec2(1.0f, 0.0f)), 1.0f, rotation);
    ToKiri(body->GetWorldVector(b2Vec2(0.0f, 1.0f)), 1.0f, rotation + 3);
    rotation[6 + 3 - def.up] = axis;
    ToKiri(velocity + b2Cross(spin, place - body->GetWorldCenter()), metres, speed);
    turning[3 - def.up] = axis * spin;
    b2Vec2 belt = def.surfaceVelocity != nullptr ? def.surfaceVelocity(*part.fixture, def.user) : b2Vec2_zero;
    ToKiri(body->GetWorldVector(belt), 1.0f, surface);
    Check(kiriObstacle_SetPose(kiri, part.obstacle, position, rotation));
    Check(kiriObstacle_SetVelocity(kiri, part.obstacle, speed, turning));
    Check(kiriObstacle_SetSurfaceVelocity(kiri, part.obstacle, surface));
}

/* What sleeps under a load is carried, and does not yield. A body turns in its plane: out of it it is a million times as
   heavy. */
void KiriBox2d::SetMass(const Part& part)
{
    const b2Body& body = *part.fixture->GetBody();
    float inertia = InertiaOf(body) * metres * metres;
    float tensor[6] = { 1e6f * inertia, 1e6f * inertia, 1e6f * inertia, 0.0f, 0.0f, 0.0f };
    tensor[3 - def.up] = inertia;
    b2Vec2 center = metres * (body.GetLocalCenter() - part.place);
    const float place[3] = { center.x, center.y, 0.0f };
    float mass = memories[part.fixture->GetBody()].isCarried ? 0.0f : MassOf(body);
    Check(kiriObstacle_SetMass(kiri, part.obstacle, mass, tensor, place));
}

/* ---- After the tick ----------------------------------------------------------------------------------------------- */

kiriResult KiriBox2d::GiveBack()
{
    failure = KIRI_OK;
    for (const Part& part : parts) {
        kiriObstacleState state = kiriObstacleState();
        Check(kiriObstacle_GetState(kiri, part.obstacle, &state));
        Memory& memory = memories[part.fixture->GetBody()];
        memory.felt +=
            1.0f / metres * b2Vec2(static_cast<float>(state.impulse[0]), static_cast<float>(state.impulse[def.up]));
        memory.feltTurn += axis / (metres * metres) * static_cast<float>(state.angularImpulse[3 - def.up]);
    }
    for (auto& entry : memories) {
        b2Body* body = entry.first;
        Memory& memory = entry.second;
        /* A sleeping body wakes when the impulse is other than that with which it fell asleep. */
        if (body->IsAwake() || (memory.felt - memory.impulse).Length() > b2_linearSleepTolerance * body->GetMass()) {
            bool wakes = memory.felt != memory.impulse;
            body->ApplyLinearImpulseToCenter(memory.felt, wakes);
            body->ApplyAngularImpulse(memory.feltTurn, wakes);
            memory.impulse = memory.felt;
            memory.turn = memory.feltTurn;
        }
        memory.velocity = body->GetLinearVelocity();
        memory.spin = body->GetAngularVelocity();
        memory.felt = b2Vec2_zero;
        memory.feltTurn = 0.0f;
        memory.isKnown = true;
    }
    return failure;
}
