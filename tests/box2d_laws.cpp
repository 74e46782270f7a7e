#include "box2d_laws.h"

#include "box2d_rig.h"

#include <algorithm>

namespace
{

const float PI = 3.14159265f, DEGREE = PI / 180.0f;

b2Vec2 SheetMomentum(const Rig& rig)
{
    kiriTotals totals = rig.Totals();
    return b2Vec2(static_cast<float>(totals.momentum[0]), static_cast<float>(totals.momentum[2]));
}

double BodyEnergy(const b2Body& body)
{
    double speed = Rig::Velocity(&body).Length(), spin = body.GetAngularVelocity();
    double inertia = body.GetInertia() / (RIG_UNITS * RIG_UNITS);
    return 0.5 * (body.GetMass() * speed * speed + inertia * spin * spin);
}

/* A cloth that a heavy crate does not tear down. */
kiriSheetDef BannerDef()
{
    kiriSheetDef def = StiffDef(0.3f);
    def.material.youngsModulus = 3e8f;
    def.material.thickness = 0.001f;
    def.material.density = 300.0f;
    def.material.airDamping = 1.0f;
    def.material.flexDamping = 0.005f;
    def.gridResolution = 48;
    def.frameCount = 16;
    return def;
}

/* All along both short edges. */
void HoldEnds(Rig* rig, float length, float width, bool isClamp, std::vector<kiriPin>* pins)
{
    for (float u : { 0.0f, length }) {
        const float from[2] = { u, 0.0f }, to[2] = { u, width };
        kiriPin pin;
        rig->Need(isClamp ? kiriSheet_ClampLine(rig->world, rig->sheets[0], from, to, &pin)
                          : kiriSheet_HingeLine(rig->world, rig->sheets[0], from, to, &pin));
        pins->push_back(pin);
    }
}

b2Vec2 Reactions(const Rig& rig, const std::vector<kiriPin>& pins)
{
    b2Vec2 sum(0.0f, 0.0f);
    for (kiriPin pin : pins) {
        double force[3], torque[3];
        rig.Need(kiriPin_GetReaction(rig.world, pin, force, torque));
        sum += b2Vec2(static_cast<float>(force[0]), static_cast<float>(force[2]));
    }
    return sum;
}

/* How far a body or sheet gets in the second half of a time. */
template <typename Where> float SlideOf(Rig* rig, int ticks, Where where)
{
    b2Vec2 start(0.0f, 0.0f);
    for (int i = 0; i < ticks; ++i) {
        start = i == ticks / 2 ? where() : start;
        rig->Tick();
    }
    return (where() - start).Length();
}

b2Vec2 CenterOf(const Rig& rig)
{
    kiriTotals totals = rig.Totals();
    return b2Vec2(static_cast<float>(totals.center[0]), static_cast<float>(totals.center[2]));
}

b2Vec2 GiveVelocity(b2Fixture&, void* user)
{
    return b2Vec2(*static_cast<float*>(user), 0.0f);
}

std::unique_ptr<b2Shape> MakeShape(LawShape kind)
{
    if (kind == LAW_CIRCLE) {
        std::unique_ptr<b2CircleShape> circle(new b2CircleShape);
        circle->m_radius = 0.15f * RIG_UNITS;
        return std::unique_ptr<b2Shape>(circle.release());
    }
    if (kind == LAW_POLYGON) {
        const b2Vec2 corners[5] = {
            { -1.5f, -1.0f }, { 1.5f, -1.0f }, { 1.8f, 0.5f }, { 0.0f, 1.2f }, { -1.8f, 0.5f }
        };
        std::unique_ptr<b2PolygonShape> polygon(new b2PolygonShape);
        polygon->Set(corners, 5);
        return std::unique_ptr<b2Shape>(polygon.release());
    }
    if (kind == LAW_EDGE) {
        std::unique_ptr<b2EdgeShape> edge(new b2EdgeShape);
        edge->SetTwoSided(b2Vec2(-1.5f, 0.0f), b2Vec2(1.5f, 0.0f));
        return std::unique_ptr<b2Shape>(edge.release());
    }
    /* Hills, solid below: from right to left. */
    const b2Vec2 hills[6] = { { 6.0f, 1.0f },  { 3.0f, 0.0f },  { 1.0f, 0.8f },
                              { -1.0f, 0.0f }, { -3.0f, 0.5f }, { -6.0f, 1.0f } };
    std::unique_ptr<b2ChainShape> chain(new b2ChainShape);
    chain->CreateChain(hills, 6, b2Vec2(8.0f, 1.0f), b2Vec2(-8.0f, 1.0f));
    return std::unique_ptr<b2Shape>(chain.release());
}

/* How deep a point (units) is in a fixture, below 0 outside. What came from above is deep where it is below an edge. */
float DepthIn(const b2Fixture& fixture, const b2Vec2& point)
{
    b2Vec2 at = b2MulT(fixture.GetBody()->GetTransform(), point);
    const b2Shape* shape = fixture.GetShape();
    if (shape->GetType() == b2Shape::e_circle) {
        return shape->m_radius - at.Length();
    }
    float depth = b2_maxFloat;
    if (shape->GetType() == b2Shape::e_polygon) {
        const b2PolygonShape* polygon = static_cast<const b2PolygonShape*>(shape);
        for (int32 i = 0; i < polygon->m_count; ++i) {
            depth = std::min(depth, b2Dot(polygon->m_normals[i], polygon->m_vertices[i] - at));
        }
        return depth;
    }
    depth = -b2_maxFloat;
    for (int32 i = 0; i < shape->GetChildCount(); ++i) {
        b2EdgeShape edge;
        if (shape->GetType() == b2Shape::e_chain) {
            static_cast<const b2ChainShape*>(shape)->GetChildEdge(&edge, i);
        } else {
            edge = *static_cast<const b2EdgeShape*>(shape);
        }
        b2Vec2 along = edge.m_vertex2 - edge.m_vertex1;
        float share = (at.x - edge.m_vertex1.x) / along.x;
        if (share >= 0.04f && share <= 0.96f) { /* beside its ends, where what hangs over an end comes down */
            float below = edge.m_vertex1.y + share * along.y - at.y;
            depth = std::max(depth, below * b2Abs(along.x) / along.Length());
        }
    }
    return depth;
}

double DeepestIn(const Rig& rig, const b2Body* body)
{
    kiriMesh mesh;
    rig.Need(kiriSheet_GetMesh(rig.world, rig.sheets[0], &mesh));
    float deepest = -1.0f;
    for (int32_t i = 0; i < mesh.vertexCount; ++i) {
        b2Vec2 point(mesh.positions[3 * i] * RIG_UNITS, mesh.positions[3 * i + 2] * RIG_UNITS);
        deepest = std::max(deepest, DepthIn(*body->GetFixtureList(), point) / RIG_UNITS);
    }
    return deepest;
}

} // namespace

HitOutcome MeasureHit(double ratio, bool isFlat, int substeps)
{
    Rig rig(0.0f);
    kiriSheetDef def = StiffDef(1.0f);
    def.velocity[0] = 2.0f;
    rig.AddSheet(0.0f, 0.0f, 0.2f, 0.2f, isFlat, 0.5f * PI, &def);
    const float mass = 0.04f * static_cast<float>(ratio);
    b2Body* crate = rig.AddBox(isFlat ? 0.25f : 0.15f, 0.0f, 0.2f, 0.24f, mass, 0.5f);
    crate->SetSleepingAllowed(false);
    const b2Vec2 before = SheetMomentum(rig);
    const double energy = rig.Totals().kineticEnergy;
    for (int i = 0; i < 40; ++i) {
        rig.Tick(substeps);
    }
    b2Vec2 after = SheetMomentum(rig) + crate->GetMass() * Rig::Velocity(crate);
    return { (after - before).Length() / before.Length(), (rig.Totals().kineticEnergy + BodyEnergy(*crate)) / energy };
}

FallOutcome MeasureFall(double ratio, bool isFlat, double start)
{
    Rig rig;
    /* Pins tell what they did as exactly as the systems are solved. */
    kiriSheetDef def = BannerDef();
    def.iterations = 8;
    def.material.airDamping = 0.0f;
    const float length = 1.0f, width = isFlat ? 0.03f : 0.3f;
    rig.AddSheet(0.0f, 0.0f, length, width, isFlat, 0.0f, &def);
    std::vector<kiriPin> pins;
    HoldEnds(&rig, length, width, false, &pins);
    const float mass = static_cast<float>(rig.Totals().mass * ratio);
    b2Body* crate = rig.AddBox(0.0f, static_cast<float>(start), 0.2f, 0.2f, mass, 0.5f);
    crate->SetSleepingAllowed(false);
    b2Vec2 given(0.0f, 0.0f), first = SheetMomentum(rig);
    FallOutcome outcome = { 0.0, 0.0, -1.0, -1.0 };
    float arrival = 0.0f; /* N s: the most that crate or banner had */
    for (int i = 0; i < 180; ++i) {
        rig.Tick();
        b2Vec2 weight(0.0f, -9.81f * (mass + static_cast<float>(rig.Totals().mass)));
        given += RIG_DT * (weight + Reactions(rig, pins));
        b2Vec2 lost = SheetMomentum(rig) + mass * Rig::Velocity(crate) - first - given;
        arrival = std::max({ arrival, mass * Rig::Velocity(crate).Length(), SheetMomentum(rig).Length() });
        outcome.momentumError = std::max<double>(outcome.momentumError, lost.Length());
        outcome.highest = std::max<double>(outcome.highest, Rig::Place(crate).y - start);
        outcome.deepest = std::max(outcome.deepest, DeepestIn(rig, crate));
    }
    outcome.momentumError /= arrival;
    outcome.depth = DeepestIn(rig, crate);
    return outcome;
}

bool CrateSlides(double friction, double degrees)
{
    Rig rig;
    const float angle = static_cast<float>(degrees) * DEGREE, height = 0.05f / 2.0f + 0.006f;
    kiriSheetDef def = StiffDef(4.0f);
    def.material.youngsModulus = 1e10f;
    def.friction = static_cast<float>(friction);
    rig.AddSheet(0.0f, 0.0f, 1.0f, 0.3f, false, angle, &def);
    std::vector<kiriPin> pins;
    HoldEnds(&rig, 1.0f, 0.3f, true, &pins);
    b2Body* crate = rig.AddBox(-height * std::sin(angle), height * std::cos(angle), 0.15f, 0.05f, 0.2f,
                               static_cast<float>(friction), angle);
    return SlideOf(&rig, 90, [=]() { return Rig::Place(crate); }) > 0.005f;
}

bool SheetSlides(double friction, double degrees, bool isFlat)
{
    Rig rig;
    const float angle = static_cast<float>(degrees) * DEGREE, width = isFlat ? 0.05f : 0.2f;
    const float height = 0.2f + (isFlat ? 0.5f * width : 0.0f) + 0.012f;
    rig.AddBox(0.0f, 0.0f, 4.0f, 0.4f, 0.0f, static_cast<float>(friction), angle);
    kiriSheetDef def = StiffDef(1.0f);
    def.friction = static_cast<float>(friction);
    rig.AddSheet(-height * std::sin(angle), height * std::cos(angle), 0.3f, width, isFlat, angle, &def);
    return SlideOf(&rig, 90, [&]() { return CenterOf(rig); }) > 0.005f;
}

double MeasureBelt(double speed, bool isFlat)
{
    float velocity = static_cast<float>(speed);
    KiriBox2dDef how;
    how.unitsPerMetre = RIG_UNITS;
    how.surfaceVelocity = GiveVelocity;
    how.user = &velocity;
    Rig rig(-9.81f, &how);
    rig.AddBox(0.0f, -0.2f, 20.0f, 0.4f, 0.0f, 0.5f);
    kiriSheetDef def = StiffDef(1.0f);
    rig.AddSheet(0.0f, isFlat ? 0.03f : 0.01f, 0.3f, isFlat ? 0.05f : 0.2f, isFlat, 0.0f, &def);
    for (int i = 0; i < 90; ++i) {
        rig.Tick();
    }
    return SheetMomentum(rig).x / rig.Totals().mass;
}

double MeasureClimb(bool isSheet)
{
    const float angle = 10.0f * DEGREE, radius = 0.1f;
    Rig rig;
    b2CircleShape circle;
    circle.m_radius = radius * RIG_UNITS;
    kiriSheetDef def = StiffDef(4.0f);
    def.material.youngsModulus = 1e10f;
    def.friction = 0.9f;
    const float across[2] = { -std::sin(angle), std::cos(angle) };
    if (isSheet) {
        rig.AddSheet(0.0f, 0.0f, 3.0f, 0.3f, false, angle, &def);
        std::vector<kiriPin> pins;
        HoldEnds(&rig, 3.0f, 0.3f, true, &pins);
    } else {
        rig.AddBox(-0.2f * across[0], -0.2f * across[1], 3.0f, 0.4f, 0.0f, 0.9f, angle);
    }
    b2Body* wheel = rig.AddBody(circle, (radius + 0.004f) * across[0], (radius + 0.004f) * across[1], 0.05f, 0.9f);
    wheel->SetSleepingAllowed(false);
    for (int i = 0; i < 60; ++i) {
        wheel->ApplyTorque(-0.02f * RIG_UNITS * RIG_UNITS, true);
        rig.Tick();
    }
    return Rig::Place(wheel).x;
}

double MeasurePull()
{
    Rig rig;
    b2CircleShape circle;
    circle.m_radius = 0.15f * RIG_UNITS;
    b2Body* wheel = rig.AddBody(circle, 0.0f, 0.0f, 0.0f, 0.9f);
    wheel->SetType(b2_kinematicBody);
    kiriSheetDef def = BannerDef();
    def.friction = 0.9f;
    def.frameCount = 30;
    def.gridResolution = 160;
    def.material.youngsModulus = 1e7f;
    rig.AddSheet(0.0f, 0.18f, 2.0f, 0.02f, true, 0.0f, &def);
    double speed = 0.0;
    int count = 0;
    for (int i = 0; i < 50; ++i) { /* later its end whips over the wheel */
        wheel->SetAngularVelocity(i < 30 ? 0.0f : -6.0f);
        rig.Tick();
        kiriFrame frames[256];
        int32_t frameCount = 0;
        rig.Need(kiriSheet_GetFrames(rig.world, rig.sheets[0], frames, 256, &frameCount));
        for (int32_t k = 0; k < frameCount && i >= 38; ++k) {
            kiriFrameState state;
            rig.Need(kiriFrame_GetState(rig.world, frames[k], &state));
            if (std::fabs(state.position[0]) < 0.05f && state.position[2] > 0.1f) {
                speed += state.velocity[0];
                count += 1;
            }
        }
    }
    return speed / std::max(count, 1) / (0.15 * 6.0);
}

/* ---- Depth ------------------------------------------------------------------------------------------------------- */

const char* const LAW_SHAPE_NAMES[LAW_SHAPE_COUNT] = { "circle", "polygon", "edge", "chain" };

double MeasureDepth(LawShape kind, bool isFlat)
{
    Rig rig;
    std::unique_ptr<b2Shape> shape = MakeShape(kind);
    b2Body* body = rig.AddBody(*shape, 0.0f, 0.0f, 0.0f, 1.0f);
    kiriSheetDef def = BannerDef();
    def.material.youngsModulus = 1e7f;
    def.friction = 1.0f;
    def.frameCount = 24;
    rig.AddSheet(0.0f, 0.2f, 0.5f, isFlat ? 0.02f : 0.2f, isFlat, 0.0f, &def);
    for (int i = 0; i < 120; ++i) {
        rig.Tick();
    }
    return DeepestIn(rig, body);
}
