/* Lets the sheets of a kiriWorld touch the bodies of a JPH::PhysicsSystem, and bodies feel the sheets. A sample: copy
   this file into your game. Each tick, outside of PhysicsSystem::Update:

     bodies.Mirror(sheets, count, dt);         shapes near the sheets become obstacles
     kiriWorld_Tick(world, dt, substeps);
     bodies.GiveBack();                        impulses of the sheets go to the bodies
     physics.Update(dt, 1, &memory, &jobs);

   Boxes, spheres, capsules and cylinders touch, also in compound shapes; `skipped` counts the others. Sensors do not
   touch. Lengths are metres in both. Jolt's usual axes have y up: set gravity of the kiriWorld to (0, -9.81, 0). */
#ifndef KIRI_JOLT_H
#define KIRI_JOLT_H

#include <Jolt/Jolt.h>

#include <Jolt/Physics/Body/BodyInterface.h>
#include <Jolt/Physics/Body/BodyLock.h>
#include <Jolt/Physics/Collision/CollisionCollectorImpl.h>
#include <Jolt/Physics/Collision/Shape/BoxShape.h>
#include <Jolt/Physics/Collision/Shape/CapsuleShape.h>
#include <Jolt/Physics/Collision/Shape/CylinderShape.h>
#include <Jolt/Physics/Collision/Shape/SphereShape.h>
#include <Jolt/Physics/PhysicsSystem.h>

#include <kiri/kiri.h>

#include <map>
#include <utility>

class KiriJolt
{
  public:
    /* fastest: m/s, of bodies that come into reach within a tick. */
    KiriJolt(kiriWorld* world, JPH::PhysicsSystem& physics, float fastest = 20.0f)
        : world_(world), physics_(physics), fastest_(fastest)
    {
    }

    ~KiriJolt() /* before the kiriWorld */
    {
        for (const auto& part : parts_) {
            kiriDestroyObstacle(world_, part.second.obstacle);
        }
    }

    kiriResult Mirror(const kiriSheet* sheets, int count, float dt)
    {
        for (auto& part : parts_) {
            part.second.isSeen = false;
        }
        skipped = 0;
        for (int i = 0; i < count; i++) {
            float lower[3], upper[3];
            kiriResult result = kiriSheet_GetReach(world_, sheets[i], dt, lower, upper);
            if (result < 0) {
                return result;
            }
            JPH::AABox box(JPH::Vec3(lower[0], lower[1], lower[2]), JPH::Vec3(upper[0], upper[1], upper[2]));
            box.ExpandBy(JPH::Vec3::sReplicate(fastest_ * dt));
            JPH::AllHitCollisionCollector<JPH::TransformedShapeCollector> found;
            physics_.GetNarrowPhaseQuery().CollectTransformedShapes(box, found);
            for (const JPH::TransformedShape& shape : found.mHits) {
                result = Take(shape, dt);
                if (result < 0) {
                    return result;
                }
            }
        }
        for (auto part = parts_.begin(); part != parts_.end();) {
            if (!part->second.isSeen) {
                kiriDestroyObstacle(world_, part->second.obstacle);
                part = parts_.erase(part);
            } else {
                ++part;
            }
        }
        return KIRI_OK;
    }

    /* A sleeping body wakes when the impulse changes by more than a twentieth. */
    void GiveBack()
    {
        JPH::BodyInterface& bodies = physics_.GetBodyInterface();
        for (auto& item : parts_) {
            Part& part = item.second;
            kiriObstacleState state;
            if (!part.isDynamic || kiriObstacle_GetState(world_, part.obstacle, &state) < 0) {
                continue;
            }
            JPH::Vec3 impulse((float)state.impulse[0], (float)state.impulse[1], (float)state.impulse[2]);
            JPH::Vec3 turn((float)state.angularImpulse[0], (float)state.angularImpulse[1],
                           (float)state.angularImpulse[2]);
            bool hasChanged = (impulse - part.felt).Length() > 0.05f * part.felt.Length();
            if (!impulse.IsNearZero(0.0f) && (bodies.IsActive(part.body) || hasChanged)) {
                bodies.AddImpulse(part.body, impulse); /* at the centre of mass; wakes the body */
                bodies.AddAngularImpulse(part.body, turn);
            }
            part.felt = impulse;
        }
    }

    int skipped = 0; /* shapes near the sheets that no obstacle can have, in the last Mirror */

  private:
    struct Part {
        kiriObstacle obstacle = 0;
        JPH::BodyID body;
        JPH::Vec3 felt = JPH::Vec3::sZero();
        bool isSeen = false, isDynamic = false;
    };

    /* The shape as a def; the axis of capsules and cylinders is y in Jolt, and the third one here. False: another type. */
    static bool Describe(const JPH::TransformedShape& from, kiriObstacleDef& def, bool& isAlongY)
    {
        JPH::Vec3 scale = from.GetShapeScale().Abs();
        isAlongY = false;
        switch (from.mShape->GetSubType()) {
        case JPH::EShapeSubType::Box: {
            JPH::Vec3 size = 2.0f * scale * static_cast<const JPH::BoxShape*>(from.mShape.GetPtr())->GetHalfExtent();
            def.type = KIRI_OBSTACLE_BOX;
            for (int k = 0; k < 3; k++) {
                def.size[k] = size[k];
            }
            return true;
        }
        case JPH::EShapeSubType::Sphere:
            def.type = KIRI_OBSTACLE_SPHERE;
            def.radius = scale.GetX() * static_cast<const JPH::SphereShape*>(from.mShape.GetPtr())->GetRadius();
            return true;
        case JPH::EShapeSubType::Capsule: {
            const JPH::CapsuleShape* capsule = static_cast<const JPH::CapsuleShape*>(from.mShape.GetPtr());
            def.type = KIRI_OBSTACLE_CAPSULE;
            def.radius = scale.GetX() * capsule->GetRadius();
            def.height = 2.0f * scale.GetY() * capsule->GetHalfHeightOfCylinder();
            return isAlongY = true;
        }
        case JPH::EShapeSubType::Cylinder: {
            const JPH::CylinderShape* cylinder = static_cast<const JPH::CylinderShape*>(from.mShape.GetPtr());
            def.type = KIRI_OBSTACLE_CYLINDER;
            def.radius = scale.GetX() * cylinder->GetRadius();
            def.height = 2.0f * scale.GetY() * cylinder->GetHalfHeight();
            return isAlongY = true;
        }
        default:
            return false;
        }
    }

    kiriResult Take(const JPH::TransformedShape& shape, float dt)
    {
        JPH::BodyLockRead lock(physics_.GetBodyLockInterface(), shape.mBodyID);
        if (!lock.Succeeded() || lock.GetBody().IsSensor()) {
            return KIRI_OK;
        }
        const JPH::Body& body = lock.GetBody();
        kiriObstacleDef def;
        bool isAlongY;
        kiriDefaultObstacleDef(&def);
        if (!Describe(shape, def, isAlongY)) {
            skipped++;
            return KIRI_OK;
        }
        JPH::Mat44 axes = JPH::Mat44::sRotation(shape.mShapeRotation);
        JPH::Vec3 columns[3] = { axes.GetAxisX(), axes.GetAxisY(), axes.GetAxisZ() };
        if (isAlongY) { /* z, x, y */
            JPH::Vec3 y = columns[1];
            columns[1] = columns[0];
            columns[0] = columns[2];
            columns[2] = y;
        }
        for (int i = 0; i < 9; i++) {
            def.rotation[i] = columns[i / 3][i % 3];
        }
        for (int k = 0; k < 3; k++) {
            def.position[k] = (float)shape.mShapePositionCOM[k];
        }
        /* The velocity as the next Update begins: gravity is in it. */
        JPH::Vec3 velocity = body.GetPointVelocity(shape.mShapePositionCOM), spin = body.GetAngularVelocity();
        if (body.IsDynamic()) {
            velocity += dt * body.GetMotionProperties()->GetGravityFactor() * physics_.GetGravity();
        }
        auto key =
            std::make_pair(shape.mBodyID.GetIndexAndSequenceNumber(), shape.mSubShapeIDCreator.GetID().GetValue());
        Part& part = parts_[key];
        kiriResult result = KIRI_OK;
        if (part.obstacle == 0) {
            def.body = shape.mBodyID.GetIndexAndSequenceNumber() + 1;
            def.friction = body.GetFriction();
            result = kiriCreateObstacle(world_, &def, &part.obstacle);
            if (result < 0) {
                parts_.erase(key);
                return result;
            }
            part.body = shape.mBodyID;
        }
        part.isSeen = true;
        part.isDynamic = body.IsDynamic();
        const float along[3] = { velocity.GetX(), velocity.GetY(), velocity.GetZ() },
                    around[3] = { spin.GetX(), spin.GetY(), spin.GetZ() };
        kiriObstacle_SetPose(world_, part.obstacle, def.position, def.rotation);
        kiriObstacle_SetVelocity(world_, part.obstacle, along, around);
        return body.IsDynamic() ? SetMass(body, shape, def.rotation, part.obstacle) : result;
    }

    /* Mass and inertia of the whole body, in axes of the world. An axis that the body cannot turn about has zeros. */
    kiriResult SetMass(const JPH::Body& body, const JPH::TransformedShape& shape, const float rotation[9],
                       kiriObstacle obstacle)
    {
        JPH::Mat44 inverse = body.GetInverseInertia(), tensor = JPH::Mat44::sZero();
        if (inverse.GetDeterminant3x3() > 0.0f) {
            tensor = inverse.Inversed3x3();
        }
        const float inertia[6] = { tensor(0, 0), tensor(1, 1), tensor(2, 2), tensor(0, 1), tensor(0, 2), tensor(1, 2) };
        JPH::Vec3 offset(body.GetCenterOfMassPosition() - shape.mShapePositionCOM);
        float center[3] = { 0.0f, 0.0f, 0.0f };
        for (int i = 0; i < 9; i++) {
            center[i / 3] += rotation[i] * offset[i % 3];
        }
        float inverseMass = body.GetMotionProperties()->GetInverseMass();
        return kiriObstacle_SetMass(world_, obstacle, inverseMass > 0.0f ? 1.0f / inverseMass : 0.0f, inertia, center);
    }

    kiriWorld* world_;
    JPH::PhysicsSystem& physics_;
    float fastest_;
    std::map<std::pair<JPH::uint32, JPH::uint32>, Part> parts_; /* by body and shape */
};

#endif
