/* All that a host sees of a world through the functions that only read, as one number: two looks tell whether a call
   changed any of it. */
#ifndef KIRI_TEST_LOOK_H
#define KIRI_TEST_LOOK_H

#include "host.h"

static inline uint64_t Look_Bytes(uint64_t hash, const void* data, size_t bytes)
{
    for (size_t i = 0; i < bytes; ++i) {
        hash = (hash ^ ((const unsigned char*)data)[i]) * 1099511628211u;
    }
    return hash;
}

static inline uint64_t Look_Mesh(uint64_t hash, const kiriMesh* mesh)
{
    size_t vertices = (size_t)mesh->vertexCount, triangles = (size_t)mesh->triangleCount;
    hash = Look_Bytes(hash, mesh->positions, 12 * vertices);
    hash = mesh->normals == NULL ? hash : Look_Bytes(hash, mesh->normals, 12 * vertices);
    hash = Look_Bytes(hash, mesh->restPositions, 8 * vertices);
    hash = Look_Bytes(hash, mesh->indices, 12 * triangles);
    hash = Look_Bytes(hash, mesh->sourceTriangles, 4 * vertices);
    return Look_Bytes(hash, mesh->sourceWeights, 12 * vertices);
}

static inline uint64_t Look_Reaction(uint64_t hash, const double force[3], const double torque[3])
{
    return Look_Bytes(Look_Bytes(hash, force, 3 * sizeof(double)), torque, 3 * sizeof(double));
}

static inline uint64_t Look_Frames(uint64_t hash, const kiriWorld* world, kiriSheet sheet)
{
    kiriFrame frames[512];
    int32_t count;
    OK(kiriSheet_GetFrames(world, sheet, frames, 512, &count));
    assert_in_range(count, 1, 512);
    for (int32_t i = 0; i < count; ++i) {
        kiriFrameState state;
        int32_t piece;
        double force[3], torque[3];
        OK(kiriFrame_GetState(world, frames[i], &state));
        OK(kiriFrame_GetPiece(world, frames[i], &piece));
        OK(kiriFrame_GetReaction(world, frames[i], force, torque));
        hash = Look_Bytes(Look_Bytes(hash, &state, sizeof(state)), &piece, sizeof(piece));
        hash = Look_Reaction(hash, force, torque);
    }
    return Look_Bytes(hash, frames, sizeof(kiriFrame) * (size_t)count);
}

static inline uint64_t Look_Pins(uint64_t hash, const kiriWorld* world, kiriSheet sheet)
{
    kiriPin pins[64];
    int32_t count;
    double force[3], torque[3];
    OK(kiriSheet_GetPins(world, sheet, pins, 64, &count));
    assert_in_range(count, 0, 64);
    for (int32_t i = 0; i < count; ++i) {
        kiriPinState state;
        OK(kiriPin_GetState(world, pins[i], &state));
        OK(kiriPin_GetReaction(world, pins[i], force, torque));
        hash = Look_Reaction(Look_Bytes(hash, &state, sizeof(state)), force, torque);
    }
    return Look_Bytes(hash, pins, sizeof(kiriPin) * (size_t)count);
}

static inline uint64_t Look_Sheet(uint64_t hash, const kiriWorld* world, kiriSheet sheet)
{
    kiriMesh mesh;
    kiriCounts counts;
    kiriTotals totals;
    const float* points;
    int32_t count, awake;
    OK(kiriSheet_GetMesh(world, sheet, &mesh));
    OK(kiriSheet_GetCollisionPoints(world, sheet, &points, &count));
    OK(kiriSheet_GetTotals(world, sheet, &totals));
    OK(kiriSheet_IsAwake(world, sheet, &awake));
    OK(kiriSheet_GetCounts(world, sheet, &counts));
    hash = Look_Bytes(Look_Mesh(hash, &mesh), points, 12 * (size_t)count);
    hash = Look_Bytes(Look_Bytes(hash, &totals, sizeof(totals)), &awake, sizeof(awake));
    counts.cells = 0; /* of the grid as far as the work on a cut has come */
    hash = Look_Pins(Look_Bytes(hash, &counts, sizeof(counts)), world, sheet);
    return Look_Frames(hash, world, sheet);
}

/* All sheets, and the events. */
static inline uint64_t Look_World(const kiriWorld* world)
{
    uint64_t hash = 14695981039346656037u;
    const kiriEvent* events;
    int32_t count;
    kiriSheet sheets[64];
    OK(kiriWorld_GetSheets(world, sheets, 64, &count));
    assert_in_range(count, 0, 64);
    for (int32_t i = 0; i < count; ++i) {
        hash = Look_Sheet(hash, world, sheets[i]);
    }
    OK(kiriWorld_GetEvents(world, &events, &count));
    return Look_Bytes(hash, events, sizeof(kiriEvent) * (size_t)count);
}

/* But for its times. */
static inline uint64_t Look_Profile(uint64_t hash, const kiriWorld* world)
{
    kiriProfile profile;
    OK(kiriWorld_GetProfile(world, &profile));
    memset(profile.seconds, 0, sizeof(profile.seconds));
    return Look_Bytes(hash, &profile, sizeof(profile));
}

#endif
