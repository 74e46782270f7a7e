/* A crate of Jolt falls on a cloth that hangs by its corners, rests there, and falls through when the cloth is cut. */
#include "kiri_jolt.h"

#include <Jolt/Core/Factory.h>
#include <Jolt/Core/JobSystemSingleThreaded.h>
#include <Jolt/Core/TempAllocator.h>
#include <Jolt/Physics/Body/BodyCreationSettings.h>
#include <Jolt/Physics/Collision/BroadPhase/BroadPhaseLayerInterfaceTable.h>
#include <Jolt/Physics/Collision/BroadPhase/ObjectVsBroadPhaseLayerFilterTable.h>
#include <Jolt/Physics/Collision/ObjectLayerPairFilterTable.h>
#include <Jolt/RegisterTypes.h>

#include <cmath>
#include <cstdio>

static const float dt = 1.0f / 60.0f, mass = 0.3f;

static kiriSheet HangCloth(kiriWorld* world)
{
    kiriSheetDef def;
    kiriPinDef pin;
    kiriSheet cloth;
    kiriPin made;
    kiriDefaultSheetDef(&def);
    kiriDefaultPinDef(&pin);
    def.position[1] = 1.0f; /* y is up: v goes to -z, so that the normal is y */
    def.axisV[1] = 0.0f;
    def.axisV[2] = -1.0f;
    def.frameCount = 25;
    kiriCreateRectangle(world, 1.0f, 1.0f, 40, 40, &def, &cloth);
    pin.target[1] = 1.0f;
    for (int i = 0; i < 4; i++) {
        pin.restPoint[0] = pin.target[0] = (float)(i % 2);
        pin.restPoint[1] = (float)(i / 2);
        pin.target[2] = -(float)(i / 2);
        kiriCreatePin(world, cloth, &pin, &made);
    }
    return cloth;
}

int main()
{
    JPH::RegisterDefaultAllocator();
    JPH::Factory::sInstance = new JPH::Factory();
    JPH::RegisterTypes();
    int fault = 0;
    {
        JPH::TempAllocatorImpl memory(10 * 1024 * 1024);
        JPH::JobSystemSingleThreaded jobs(JPH::cMaxPhysicsJobs);
        JPH::BroadPhaseLayerInterfaceTable layers(2, 2); /* 0: still, 1: moving */
        layers.MapObjectToBroadPhaseLayer(0, JPH::BroadPhaseLayer(0));
        layers.MapObjectToBroadPhaseLayer(1, JPH::BroadPhaseLayer(1));
        JPH::ObjectLayerPairFilterTable pairs(2);
        pairs.EnableCollision(0, 1);
        pairs.EnableCollision(1, 1);
        JPH::ObjectVsBroadPhaseLayerFilterTable filter(layers, 2, pairs, 2);
        JPH::PhysicsSystem physics;
        physics.Init(64, 0, 64, 64, layers, filter, pairs); /* gravity: (0, -9.81, 0) */
        JPH::BodyInterface& bodies = physics.GetBodyInterface();

        JPH::BodyCreationSettings floorDef(new JPH::BoxShape(JPH::Vec3(5.0f, 0.1f, 5.0f)), JPH::RVec3(0, -0.1f, 0),
                                           JPH::Quat::sIdentity(), JPH::EMotionType::Static, 0);
        bodies.CreateAndAddBody(floorDef, JPH::EActivation::DontActivate);
        JPH::BodyCreationSettings crateDef(
            new JPH::BoxShape(JPH::Vec3::sReplicate(0.1f)), JPH::RVec3(0.5f, 1.6f, -0.5f),
            JPH::Quat::sRotation(JPH::Vec3(0, 0, 1), 0.6f), JPH::EMotionType::Dynamic, 1);
        crateDef.mOverrideMassProperties = JPH::EOverrideMassProperties::CalculateInertia;
        crateDef.mMassPropertiesOverride.mMass = mass;
        JPH::BodyID crate = bodies.CreateAndAddBody(crateDef, JPH::EActivation::Activate);

        kiriWorldDef def;
        kiriWorld* world;
        kiriCut cut;
        kiriDefaultWorldDef(&def);
        def.gravity[1] = -9.81f;
        def.gravity[2] = 0.0f;
        kiriCreateWorld(&def, &world);
        kiriSheet cloth = HangCloth(world);
        {
            KiriJolt mirror(world, physics);
            for (int tick = 0; tick < 900; tick++) {
                if (tick == 600) {
                    double at = (double)bodies.GetPosition(crate).GetY(),
                           speed = (double)bodies.GetLinearVelocity(crate).Length();
                    std::printf("the crate hangs at %.2f m in the cloth, and moves at %.3f m/s\n", at, speed);
                    fault |= !(at > 0.3 && at < 1.0 && speed < 0.05);
                    const float strokes[2][4] = { { -0.1f, 0.5f, 1.1f, 0.5f }, { 0.5f, -0.1f, 0.5f, 1.1f } };
                    for (const auto& stroke : strokes) {
                        kiriSheet_Cut(world, cloth, stroke, 2, &cut);
                    }
                }
                mirror.Mirror(&cloth, 1, dt);
                kiriWorld_Tick(world, dt, 2);
                mirror.GiveBack();
                physics.Update(dt, 1, &memory, &jobs);
            }
        }
        double at = (double)bodies.GetPosition(crate).GetY();
        std::printf("the cloth was cut, and the crate is at %.2f m\n", at);
        fault |= !(at < 0.2);
        kiriDestroyWorld(world);
    }
    JPH::UnregisterTypes();
    delete JPH::Factory::sInstance;
    return fault;
}
