#include "storm.h"

#include "hash.h"

static void HashFloats(uint64_t* hash, const float* floats, int64_t count)
{
    for (int64_t i = 0; floats != NULL && i < count; i++) {
        int32_t bits;
        memcpy(&bits, &floats[i], sizeof bits);
        kiriHash_Int32(hash, bits);
    }
}

static void HashDoubles(uint64_t* hash, const double* doubles, int32_t count)
{
    for (int32_t i = 0; i < count; i++) {
        kiriHash_Double(hash, doubles[i]);
    }
}

static void HashInts(uint64_t* hash, const int32_t* ints, int64_t count)
{
    for (int64_t i = 0; i < count; i++) {
        kiriHash_Int32(hash, ints[i]);
    }
}

static void HashMesh(uint64_t* hash, const Storm* storm, kiriSheet sheet)
{
    kiriMesh mesh;
    if (kiriSheet_GetMesh(storm->world, sheet, &mesh) != KIRI_OK) {
        return;
    }
    HashFloats(hash, mesh.positions, 3 * (int64_t)mesh.vertexCount);
    HashFloats(hash, mesh.normals, 3 * (int64_t)mesh.vertexCount);
    HashFloats(hash, mesh.restPositions, 2 * (int64_t)mesh.vertexCount);
    HashFloats(hash, mesh.sourceWeights, 3 * (int64_t)mesh.vertexCount);
    HashInts(hash, mesh.sourceTriangles, mesh.vertexCount);
    HashInts(hash, mesh.indices, 3 * (int64_t)mesh.triangleCount);
}

static void HashTotals(uint64_t* hash, const Storm* storm, kiriSheet sheet)
{
    kiriTotals totals;
    if (kiriSheet_GetTotals(storm->world, sheet, &totals) == KIRI_OK) {
        kiriHash_Double(hash, totals.area);
        kiriHash_Double(hash, totals.mass);
        kiriHash_Double(hash, totals.kineticEnergy);
        kiriHash_Double(hash, totals.elasticEnergy);
        HashDoubles(hash, totals.center, 3);
        HashDoubles(hash, totals.momentum, 3);
        HashDoubles(hash, totals.angularMomentum, 3);
    }
}

static void HashForces(uint64_t* hash, const Storm* storm, kiriSheet sheet)
{
    const float* points;
    const kiriContactForce* forces;
    int32_t count;
    if (kiriSheet_GetCollisionPoints(storm->world, sheet, &points, &count) == KIRI_OK) {
        HashFloats(hash, points, 3 * (int64_t)count);
    }
    if (kiriSheet_GetContactForces(storm->world, sheet, &forces, &count) == KIRI_OK) {
        for (int32_t i = 0; i < count; i++) {
            HashDoubles(hash, forces[i].impulse, 3);
            HashDoubles(hash, forces[i].position, 3);
            kiriHash_Double(hash, forces[i].depth);
        }
    }
    enum { PINS = 32 };
    kiriPin pins[PINS];
    if (kiriSheet_GetPins(storm->world, sheet, pins, PINS, &count) == KIRI_OK) {
        double force[3], torque[3];
        for (int32_t i = 0; i < count && i < PINS; i++) {
            kiriPin_GetReaction(storm->world, pins[i], force, torque);
            HashDoubles(hash, force, 3);
            HashDoubles(hash, torque, 3);
        }
    }
}

static void HashPieces(uint64_t* hash, const Storm* storm, kiriSheet sheet)
{
    kiriPieceState piece;
    for (int32_t i = 0; kiriSheet_GetPiece(storm->world, sheet, i, &piece) == KIRI_OK; i++) {
        kiriHash_Double(hash, piece.area);
        HashDoubles(hash, piece.center, 3);
        HashDoubles(hash, piece.angularMomentum, 3);
        HashFloats(hash, piece.lower, 3);
        HashFloats(hash, piece.upper, 3);
        kiriHash_Pair(hash, piece.frames, piece.vertices);
        kiriHash_Pair(hash, piece.triangles, piece.crumb);
    }
}

static void HashEvents(uint64_t* hash, const Storm* storm)
{
    const kiriEvent* events;
    int32_t count;
    if (kiriWorld_GetEvents(storm->world, &events, &count) == KIRI_OK) {
        for (int32_t i = 0; i < count; i++) {
            kiriHash_Pair(hash, events[i].type, events[i].stage);
            kiriHash_Pair(hash, (int32_t)events[i].sheet, (int32_t)events[i].cut);
            kiriHash_Pair(hash, (int32_t)events[i].frame, (int32_t)events[i].pin);
            kiriHash_Pair(hash, events[i].crumb, events[i].waiting);
            HashFloats(hash, &events[i].area, 1);
        }
    }
    kiriProfile p; /* without items: a budget shows those, and else they change with what is made faster */
    if (kiriWorld_GetProfile(storm->world, &p) == KIRI_OK) {
        kiriHash_Pair(hash, p.systemsSolved, p.contacts);
        kiriHash_Double(hash, p.largestJump);
        kiriHash_Double(hash, p.largestFade);
    }
}

static void HashObstacles(uint64_t* hash, const Storm* storm)
{
    for (int32_t i = 0; i < storm->obstacleCount; i++) {
        kiriObstacleState state;
        if (kiriObstacle_GetState(storm->world, storm->obstacles[i], &state) == KIRI_OK) {
            HashFloats(hash, state.position, 3);
            HashFloats(hash, state.rotation, 9);
            HashDoubles(hash, state.impulse, 3);
            HashDoubles(hash, state.angularImpulse, 3);
            kiriHash_Int32(hash, state.contacts);
        }
    }
}

uint64_t Storm_HashSeen(Storm* storm)
{
    uint64_t hash = storm->results;
    HashEvents(&hash, storm);
    for (int32_t i = 0; i < storm->sheetCount; i++) {
        HashMesh(&hash, storm, storm->sheets[i]);
        HashTotals(&hash, storm, storm->sheets[i]);
        HashForces(&hash, storm, storm->sheets[i]);
        HashPieces(&hash, storm, storm->sheets[i]);
    }
    HashObstacles(&hash, storm);
    return hash;
}
