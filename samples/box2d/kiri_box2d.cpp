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

/* A one-sided edge is solid to its left. Its corner down there halves the angle with the next edge, so that both fit;
   it leans by 45 degrees at most, so that edges do not stand out of each other's ground. */
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

b2Vec3 VelocityOf(const b2Body& body)
{
    return b2Vec3(body.GetLinearVelocity().x, body.GetLinearVelocity().y, body.GetAngularVelocity());
}

float Length(const b2Vec3& motion)
{
    return b2Vec2(motion.x, motion.y).Length();
}

std::vector<b2Body*> BodiesOf(b2World* box2d)
{
    std::vector<b2Body*> all;
    for (b2Body* body = box2d->GetBodyList(); body != nullptr; body = body->GetNext()) {
        all.push_back(body);
    }
    return all;
}

int NumberOf(const std::vector<b2Body*>& all, const b2Body* body)
{
    return static_cast<int>(std::find(all.begin(), all.end(), body) - all.begin());
}

int NumberOf(const b2Fixture* fixture)
{
    int number = 0;
    for (const b2Fixture* each = fixture->GetBody()->GetFixtureList(); each != fixture; each = each->GetNext()) {
        ++number;
    }
    return number;
}

b2Fixture* FixtureOf(b2Body* body, int number)
{
    b2Fixture* fixture = body->GetFixtureList();
    for (; number > 0; --number) {
        fixture = fixture->GetNext();
    }
    return fixture;
}

} // namespace

KiriBox2d::KiriBox2d(kiriWorld* world, b2World* box2d, const KiriBox2dDef& how)
    : kiri(world), bodies(box2d), def(how), metres(1.0f / how.unitsPerMetre), axis(how.up == 1 ? 1.0f : -1.0f)
{
}

KiriBox2d::~KiriBox2d()
{
    for (Part& part : parts) {
        part.isNear = part.isHeld = false;
    }
    DropFar();
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

/* ---- Obstacles --------------------------------------------------------------------------------------------------- */

KiriBox2d::Part* KiriBox2d::FindPart(const b2Fixture* fixture, int child)
{
    auto is = [=](const Part& part) { return part.fixture == fixture && part.child == child; };
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
    obstacle.friction = fixture->GetFriction();
    obstacle.groups = def.groups != nullptr ? def.groups(*fixture, def.user) : ~0u;
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
    Memory& memory = memories[fixture->GetBody()];
    obstacle.body = memory.number = memory.number != 0 ? memory.number : ++numbers;
    Check(kiriCreateObstacle(kiri, &obstacle, &part.obstacle));
    if (part.obstacle != 0) {
        parts.push_back(part);
    }
}

kiriObstacle KiriBox2d::Hold(b2Fixture* fixture)
{
    if (FindPart(fixture, 0) == nullptr) {
        AddPart(fixture, 0);
    }
    Part* part = FindPart(fixture, 0);
    if (part != nullptr) {
        part->isHeld = true;
        Move(*part, 0.0f);
    }
    return part != nullptr ? part->obstacle : 0;
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

/* ---- Before the tick --------------------------------------------------------------------------------------------- */

void KiriBox2d::Find(kiriSheet sheet, float dt)
{
    float lower[3] = { 0.0f }, upper[3] = { 0.0f };
    Check(kiriSheet_GetReach(kiri, sheet, dt, lower, upper));
    b2AABB box = { 1.0f / metres * b2Vec2(lower[0], lower[def.up]), 1.0f / metres * b2Vec2(upper[0], upper[def.up]) };
    /* Bodies come to the sheet, too: look as far as the fastest gets. */
    float far = 0.0f;
    for (b2Body* body = bodies->GetBodyList(); body != nullptr; body = body->GetNext()) {
        far = std::max(far, dt * (body->GetLinearVelocity() + dt * bodies->GetGravity()).Length());
    }
    box.lowerBound -= b2Vec2(far, far);
    box.upperBound += b2Vec2(far, far);
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
    std::for_each(parts.begin(), parts.end(), [=](const Part& part) { Move(part, dt); });
    return failure;
}

/* What Box2D did to a body in the last step beside our impulses, as weight and what carries it, it will do again: else
   a sheet on a crate would feel it fall in each tick, and one below a crate would not. What sleeps under a load stays.
   What sleeps on a sheet weighs on it as before: a fixed one would bear the load of the sheet. */
b2Vec3 KiriBox2d::Predict(b2Body* body, Memory* memory, float dt) const
{
    b2Vec3 velocity = VelocityOf(*body), felt = memory->impulse, done = velocity - memory->velocity;
    float mass = MassOf(*body), inertia = InertiaOf(*body);
    b2Vec2 weight = dt * body->GetGravityScale() * bodies->GetGravity();
    bool sleeps = memory->isKnown && !body->IsAwake(), isCarried = b2Dot(weight, b2Vec2(felt.x, felt.y)) < 0.0f;
    memory->isFixed = sleeps && !isCarried && Length(felt) > 0.0f;
    if (mass <= 0.0f || memory->isFixed) {
        return velocity;
    }
    float turn = inertia > 0.0f ? 1.0f / inertia : 0.0f;
    if (sleeps) {
        return velocity - b2Vec3(felt.x / mass, felt.y / mass, turn * felt.z);
    }
    done = memory->isKnown ? done : b2Vec3(weight.x, weight.y, 0.0f);
    float most = weight.Length() + 2.0f / mass * Length(felt);
    float share = std::min(1.0f, most / std::max(Length(done), b2_epsilon));
    turn *= 2.0f * b2Abs(felt.z);
    return velocity + b2Vec3(share * done.x, share * done.y, b2Clamp(done.z, -turn, turn));
}

void KiriBox2d::Move(const Part& part, float dt)
{
    b2Body* body = part.fixture->GetBody();
    Memory& memory = memories[body];
    b2Vec2 place = body->GetWorldPoint(part.place), center = metres * (body->GetLocalCenter() - part.place);
    b2Vec3 motion = Predict(body, &memory, dt);
    b2Vec2 velocity = b2Vec2(motion.x, motion.y) + b2Cross(motion.z, place - body->GetWorldCenter());
    b2Vec2 belt = def.surfaceVelocity != nullptr ? def.surfaceVelocity(*part.fixture, def.user) : b2Vec2_zero;
    float inertia = metres * metres * InertiaOf(*body), mass = memory.isFixed ? 0.0f : MassOf(*body);
    /* A body turns in its plane: out of it it is a million times as heavy. */
    float position[3], rotation[9] = { 0.0f }, speed[3], turning[3] = { 0.0f }, surface[3];
    float tensor[6] = { 1e6f * inertia, 1e6f * inertia, 1e6f * inertia, 0.0f, 0.0f, 0.0f };
    const int out = 3 - def.up;
    ToKiri(place, metres, position);
    ToKiri(body->GetWorldVector(b2Vec2(1.0f, 0.0f)), 1.0f, rotation);
    ToKiri(body->GetWorldVector(b2Vec2(0.0f, 1.0f)), 1.0f, rotation + 3);
    ToKiri(velocity, metres, speed);
    ToKiri(body->GetWorldVector(belt), 1.0f, surface);
    rotation[6 + out] = axis;
    turning[out] = axis * motion.z;
    tensor[out] = inertia;
    const float middle[3] = { center.x, center.y, 0.0f };
    Check(kiriObstacle_SetPose(kiri, part.obstacle, position, rotation));
    Check(kiriObstacle_SetVelocity(kiri, part.obstacle, speed, turning));
    Check(kiriObstacle_SetSurfaceVelocity(kiri, part.obstacle, surface));
    Check(kiriObstacle_SetMass(kiri, part.obstacle, mass, tensor, middle));
}

/* ---- After the tick ---------------------------------------------------------------------------------------------- */

kiriResult KiriBox2d::GiveBack()
{
    failure = KIRI_OK;
    for (const Part& part : parts) {
        kiriObstacleState state = kiriObstacleState();
        Check(kiriObstacle_GetState(kiri, part.obstacle, &state));
        b2Vec3& felt = memories[part.fixture->GetBody()].felt;
        felt.x += static_cast<float>(state.impulse[0]) / metres;
        felt.y += static_cast<float>(state.impulse[def.up]) / metres;
        felt.z += axis * static_cast<float>(state.angularImpulse[3 - def.up]) / (metres * metres);
    }
    for (auto& entry : memories) {
        b2Body* body = entry.first;
        Memory& memory = entry.second;
        /* A sleeping body wakes when it feels other than when it fell asleep, by a tenth. */
        float change = Length(memory.felt - memory.impulse);
        float least = b2_linearSleepTolerance * body->GetMass() + 0.1f * Length(memory.impulse);
        if (body->IsAwake() || change > least) {
            body->ApplyLinearImpulseToCenter(b2Vec2(memory.felt.x, memory.felt.y), change > 0.0f);
            body->ApplyAngularImpulse(memory.felt.z, change > 0.0f);
            memory.impulse = memory.felt;
        }
        memory.velocity = VelocityOf(*body);
        memory.felt = b2Vec3(0.0f, 0.0f, 0.0f);
        memory.isKnown = true;
    }
    return failure;
}

/* ---- Going back -------------------------------------------------------------------------------------------------- */

/* Between ticks nothing is felt yet, and the next Mirror finds what is near. */
KiriBox2dSave KiriBox2d::Save() const
{
    KiriBox2dSave save;
    const std::vector<b2Body*> all = BodiesOf(bodies);
    for (const Part& part : parts) {
        save.parts.push_back({ NumberOf(all, part.fixture->GetBody()), NumberOf(part.fixture), part.child,
                               part.obstacle, part.place, part.isHeld });
    }
    for (const auto& entry : memories) {
        const Memory& memory = entry.second;
        save.memories.push_back({ NumberOf(all, entry.first), memory.number, memory.impulse, memory.velocity,
                                  memory.isKnown, memory.isFixed });
    }
    save.numbers = numbers;
    return save;
}

void KiriBox2d::Load(const KiriBox2dSave& save, b2World* box2d)
{
    const std::vector<b2Body*> all = BodiesOf(box2d);
    parts.clear();
    memories.clear();
    for (const KiriBox2dSave::Part& part : save.parts) {
        b2Fixture* fixture = FixtureOf(all[static_cast<size_t>(part.body)], part.fixture);
        parts.push_back({ fixture, part.child, part.obstacle, part.place, true, part.isHeld });
    }
    for (const KiriBox2dSave::Memory& kept : save.memories) {
        Memory& memory = memories[all[static_cast<size_t>(kept.body)]];
        memory.number = kept.number;
        memory.impulse = kept.impulse;
        memory.velocity = kept.velocity;
        memory.isKnown = kept.isKnown;
        memory.isFixed = kept.isFixed;
    }
    numbers = save.numbers;
    bodies = box2d;
}
