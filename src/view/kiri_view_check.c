#include "kiri_view_check.h"

/* ---- Tables ------------------------------------------------------------------------------------------------------ */

KIRI_SHARED_TABLE(kiriSkinTable, kiriSkin, {
    KIRI_DERIVED,
    KIRI_ARRAYS(kiriSkin, spans, weights, staged),
});

KIRI_SHARED_TABLE(kiriPlacesTable, kiriPlaces, {
    KIRI_DERIVED,
    KIRI_ARRAYS(kiriPlaces, head, next),
});

/* The stencil is gathered again. */
static void ForgetStencil(kiriArchive* archive, void* object)
{
    if (kiriArchive_Reads(archive)) {
        ((kiriRefresh*)object)->stencil.cell = KIRI_NONE;
    }
}

KIRI_SHARED_TABLE(kiriRefreshTable, kiriRefresh, {
    KIRI_DERIVED,
    KIRI_ARRAYS(kiriRefresh, noted, squares, marks),
    KIRI_DROPPED(kiriRefresh, stencil, stencil),
    KIRI_CUSTOM(kiriRefresh, stencil, ForgetStencil),
});

KIRI_TABLE(FadingTable, kiriFading, {
    KIRI_WITHIN(0, INT32_MAX, kiriFading, sample, sample),
    KIRI_REALS(kiriFading, left, offset),
});

KIRI_SHARED_TABLE(kiriFadesTable, kiriFades, {
    KIRI_REALS(kiriFades, time, least),
    KIRI_PARTS(kiriFades, fading, FadingTable),
    KIRI_UNHASHED,
    KIRI_RUN(4, kiriFades, older, older),
    KIRI_REALS(kiriFades, jump, move),
});

KIRI_TABLE(PatchesTable, kiriPatches, {
    KIRI_FLOAT_ITEMS(kiriPatches, floats),
    KIRI_ITEMS(1, kiriPatches, isOther),
    KIRI_WITHIN(0, INT32_MAX, kiriPatches, count, count),
    KIRI_BOOLS(kiriPatches, isBent, areOther),
});

KIRI_SHARED_TABLE(kiriSurfaceTable, kiriSurface, {
    KIRI_UNHASHED,
    KIRI_HANDED,
    KIRI_WITHIN(KIRI_SKINNING_LINEAR, KIRI_SKINNING_SMOOTH, kiriSurface, skinning, skinning),
    KIRI_RUN(4, kiriSurface, revision, revision),
    KIRI_COUNTS(kiriSurface, pose, pose),
    KIRI_REALS(kiriSurface, middle, middle),
    KIRI_ITEMS(8, kiriSurface, carriers),
    KIRI_PART(kiriSurface, patches, PatchesTable),
    KIRI_BOOLS(kiriSurface, isWritten, hasNormals),
    KIRI_RUN(4, kiriSurface, changes, changes),
    KIRI_WITHIN(0, KIRI_CHANGES, kiriSurface, changeCount, changeCount),
    KIRI_WITHIN(0, KIRI_CHANGES - 1, kiriSurface, lastChange, lastChange),
    KIRI_DROPPED(kiriSurface, lentAt, lentAt),
    KIRI_DROPPED(kiriSurface, hasSlopes, hasSlopes),
    KIRI_DERIVED,
    KIRI_ARRAYS(kiriSurface, positions, normals, restPositions, sourceWeights, indices, sourceTriangles),
    KIRI_ARRAYS(kiriSurface, rest, turns, slopes, places, bends),
});

/* ---- Checks ------------------------------------------------------------------------------------------------------ */

bool kiriFades_AreSound(const kiriFades* fades, int32_t samples)
{
    bool areFine = true;
    for (int32_t k = 0; areFine && k < fades->fading.count; ++k) {
        int32_t before = k > 0 ? fades->fading.data[k - 1].sample : KIRI_NONE, sample = fades->fading.data[k].sample;
        areFine = before < sample && sample < samples && fades->fading.data[k].left > 0.0;
    }
    return areFine;
}

/* Hosts copy these ranges. */
static bool IsRangeUpTo(kiriRange range, int32_t end)
{
    return range.first >= 0 && range.count >= 0 && range.first + (int64_t)range.count <= end;
}

bool kiriSurface_AreChangesSound(const kiriSurface* surface)
{
    bool areFine = true;
    for (int32_t k = 0; k < surface->changeCount; ++k) {
        const kiriChange* change = &surface->changes[(surface->lastChange + KIRI_CHANGES - k) % KIRI_CHANGES];
        areFine = areFine && change->oldVertexCount >= 0 && change->oldVertexCount <= surface->vertexCount &&
                  change->oldTriangleCount >= 0 && change->oldTriangleCount <= surface->triangleCount &&
                  IsRangeUpTo(change->vertices, surface->vertexCount) &&
                  IsRangeUpTo(change->triangles, surface->triangleCount);
    }
    return areFine;
}
