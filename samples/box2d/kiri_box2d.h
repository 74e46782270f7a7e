/* Lets the sheets of a kiriWorld touch the bodies of a b2World, and bodies feel the sheets. A sample: copy these two
   files into your game. Each tick:

     bodies.Mirror(sheets, count, dt);         fixtures near the sheets become obstacles
     kiriWorld_Tick(world, dt, substeps);
     bodies.GiveBack();                        what the obstacles felt goes to the bodies
     box2d.Step(dt, 8, 3);

   Either a planar sheet (kiriSheetDef.planar) lies in the plane of the b2World, and all is flat. Or any sheet meets
   that world extruded along its depth: crates are beams, and a banner is seen edge-on. */
#ifndef KIRI_BOX2D_H
#define KIRI_BOX2D_H

#include <box2d/box2d.h>
#include <kiri/kiri.h>

#include <unordered_map>
#include <vector>

struct KiriBox2dDef {
    float unitsPerMetre = 1.0f; /* lengths in the b2World of a metre */
    int up = 2;                 /* the axis of Kiri's world along which its y points: 1 or 2. Its x is Kiri's. */
    float depth = 10.0f;        /* m: of the extruded bodies, half of it to either side of the plane */
    float ground = 0.05f;       /* m: one-sided edges, as of chains, are solid so far below */

    /* The groups of a fixture, as in kiriSheetDef; 0: no sheet touches it. Null: all. Sensors are never touched. */
    uint32_t (*groups)(b2Fixture& fixture, void* user) = nullptr;

    /* How the surface of a fixture moves beside its body, as a conveyor: m/s, in the body's axes. Null: it does not. */
    b2Vec2 (*surfaceVelocity)(b2Fixture& fixture, void* user) = nullptr;

    void* user = nullptr; /* handed to these functions */
};

class KiriBox2d;

/* What a KiriBox2d knows beside the saves of a kiriWorld. Bodies and fixtures are numbered as the b2World lists
   them. */
class KiriBox2dSave
{
    friend class KiriBox2d;
    struct Part {
        int body, fixture, child;
        kiriObstacle obstacle;
        b2Vec2 place;
        bool isHeld;
    };
    struct Memory {
        int body;
        uint32_t number;
        b2Vec3 impulse, velocity;
        bool isKnown, isFixed;
    };
    std::vector<Part> parts;
    std::vector<Memory> memories;
    uint32_t numbers = 0;
};

class KiriBox2d
{
  public:
    KiriBox2d(kiriWorld* world, b2World* box2d, const KiriBox2dDef& def);
    ~KiriBox2d(); /* before the kiriWorld */

    kiriResult Mirror(const kiriSheet* sheets, int count, float dt);
    kiriResult GiveBack();

    /* The obstacle of a fixture (its first child), for pins (kiriPinDef.obstacle): there until Forget. 0: it failed. */
    kiriObstacle Hold(b2Fixture* fixture);

    /* Call it before a fixture is destroyed, with its body or alone, and before its shape changes. */
    void Forget(const b2Fixture* fixture);

    /* For going back, between two ticks. Box2D saves nothing: the host makes a b2World anew, with the same bodies and
       fixtures in the same order, and gives them their places, angles, velocities and sleep. Load comes after
       kiriWorld_Load, and goes on with that b2World; the former one may then be destroyed. */
    KiriBox2dSave Save() const;
    void Load(const KiriBox2dSave& save, b2World* box2d);

  private:
    /* A child of a fixture. */
    struct Part {
        b2Fixture* fixture;
        int child;
        kiriObstacle obstacle;
        b2Vec2 place; /* of the obstacle in the body */
        bool isNear, isHeld;
    };

    /* What is known of a body, in units of Box2D; z is about its axis. */
    struct Memory {
        uint32_t number = 0;                     /* 0: nothing yet */
        b2Vec3 felt = { 0.0f, 0.0f, 0.0f };      /* in this tick */
        b2Vec3 impulse = { 0.0f, 0.0f, 0.0f };   /* felt in the last tick, or when it fell asleep */
        b2Vec3 velocity = { 0.0f, 0.0f, 0.0f };  /* with which the last step of Box2D began */
        bool isKnown = false, isFixed = false;   /* since the last tick; it sleeps under what touches it */
    };

    void Find(kiriSheet sheet, float dt);
    Part* FindPart(const b2Fixture* fixture, int child);
    void AddPart(b2Fixture* fixture, int child);
    void DropFar();
    b2Vec3 Predict(b2Body* body, Memory* memory, float dt) const;
    void Move(const Part& part, float dt);
    void ToKiri(const b2Vec2& vector, float scale, float out[3]) const;
    void Check(kiriResult result);

    kiriWorld* kiri;
    b2World* bodies;
    const KiriBox2dDef def;
    const float metres, axis; /* of a unit of Box2D; 1 or -1: what turns left in Box2D turns about this in Kiri */
    kiriResult failure = KIRI_OK;
    std::vector<Part> parts; /* in the order in which they were found: the same in every run */
    std::unordered_map<b2Body*, Memory> memories;
    uint32_t numbers = 0;
};

#endif
