/* A sheet among bodies of Box2D, tied together by samples/box2d: for tests and for `make contact`. Metres; x and z of
   the sheets are x and y of Box2D. */
#ifndef BOX2D_RIG_H
#define BOX2D_RIG_H

#include "../samples/box2d/kiri_box2d.h"
#include "defaults.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <vector>

const float RIG_UNITS = 10.0f, RIG_DT = 1.0f / 60.0f;

struct Rig {
    b2World box2d;
    kiriWorld* world = nullptr;
    std::unique_ptr<KiriBox2d> touching;
    std::vector<kiriSheet> sheets;

    explicit Rig(float gravity = -9.81f, const KiriBox2dDef* how = nullptr) : box2d(b2Vec2(0.0f, gravity * RIG_UNITS))
    {
        kiriWorldDef def;
        kiriDefaultWorldDef(&def);
        def.gravity[2] = gravity;
        KiriBox2dDef plain;
        plain.unitsPerMetre = RIG_UNITS;
        Need(kiriCreateWorld(&def, &world));
        touching.reset(new KiriBox2d(world, &box2d, how != nullptr ? *how : plain));
    }

    ~Rig()
    {
        touching.reset();
        kiriDestroyWorld(world);
    }

    void Need(kiriResult result) const
    {
        if (result < 0) {
            std::printf("rig: %s: %s\n", kiriGetResultName(result),
                        world != nullptr ? kiriWorld_GetLastError(world) : "");
            std::fflush(stdout);
            std::abort();
        }
    }

    /* Mass 0: static. */
    b2Body* AddBody(const b2Shape& shape, float x, float z, float mass, float friction, float angle = 0.0f)
    {
        b2BodyDef def;
        def.type = mass > 0.0f ? b2_dynamicBody : b2_staticBody;
        def.position.Set(x * RIG_UNITS, z * RIG_UNITS);
        def.angle = angle;
        b2MassData unit;
        shape.ComputeMass(&unit, 1.0f);
        b2FixtureDef fixture;
        fixture.shape = &shape;
        fixture.friction = friction;
        fixture.density = mass > 0.0f ? mass / unit.mass : 0.0f;
        b2Body* body = box2d.CreateBody(&def);
        body->CreateFixture(&fixture);
        return body;
    }

    b2Body* AddBox(float x, float z, float width, float height, float mass, float friction, float angle = 0.0f)
    {
        b2PolygonShape box;
        box.SetAsBox(0.5f * width * RIG_UNITS, 0.5f * height * RIG_UNITS);
        return AddBody(box, x, z, mass, friction, angle);
    }

    /* A rectangle of length x width around (x, z). Flat: in the plane of Box2D, its length turned to the left by
       `angle`. Else its width runs along the depth. `def` has what is to be other than by default. */
    kiriSheet AddSheet(float x, float z, float length, float width, bool isFlat, float angle, kiriSheetDef* def)
    {
        const int columns = 40, rows = std::max(1, static_cast<int>(40.0f * width / length));
        std::vector<float> positions(static_cast<size_t>(2 * (columns + 1) * (rows + 1)));
        std::vector<int32_t> indices(static_cast<size_t>(6 * columns * rows));
        kiriFillRectangle(length, width, columns, rows, positions.data(), indices.data());
        def->restPositions = positions.data();
        def->vertexCount = (columns + 1) * (rows + 1);
        def->indices = indices.data();
        def->triangleCount = 2 * columns * rows;
        const float c = std::cos(angle), s = std::sin(angle);
        const float u[3] = { c, 0.0f, s }, v[3] = { isFlat ? -s : 0.0f, isFlat ? 0.0f : 1.0f, isFlat ? c : 0.0f };
        const float middle[3] = { x, 0.0f, z };
        for (int i = 0; i < 3; ++i) {
            def->axisU[i] = u[i];
            def->axisV[i] = v[i];
            def->position[i] = middle[i] - 0.5f * length * u[i] - 0.5f * width * v[i];
        }
        def->planar = isFlat ? 1 : 0;
        kiriSheet sheet = 0;
        Need(kiriCreateSheet(world, def, &sheet));
        sheets.push_back(sheet);
        return sheet;
    }

    void Tick(int substeps = 2)
    {
        Need(touching->Mirror(sheets.data(), static_cast<int>(sheets.size()), RIG_DT));
        Need(kiriWorld_Tick(world, RIG_DT, substeps));
        Need(touching->GiveBack());
        box2d.Step(RIG_DT, 8, 3);
    }

    kiriTotals Totals(size_t sheet = 0) const
    {
        kiriTotals totals;
        Need(kiriSheet_GetTotals(world, sheets[sheet], &totals));
        return totals;
    }

    static b2Vec2 Place(const b2Body* body)
    {
        return (1.0f / RIG_UNITS) * body->GetWorldCenter();
    }

    static b2Vec2 Velocity(const b2Body* body)
    {
        return (1.0f / RIG_UNITS) * body->GetLinearVelocity();
    }
};

/* A sheet that hardly bends. */
inline kiriSheetDef StiffDef(float kilogramsPerArea)
{
    kiriSheetDef def = DefaultSheet();
    def.material.youngsModulus = 1e9f;
    def.material.poissonsRatio = 0.0f;
    def.material.thickness = 0.004f;
    def.material.density = kilogramsPerArea / def.material.thickness;
    def.material.airDamping = 0.0f;
    def.gridResolution = 20;
    def.frameCount = 4;
    return def;
}

#endif
