#include "kiri_view_check.h"

/* ---- Tables ------------------------------------------------------------------------------------------------------ */

KIRI_SHARED_TABLE(kiriSkinTable, kiriSkin, {
    KIRI_DERIVED,
    KIRI_ARRAYS(spans, weights, staged),
})

KIRI_SHARED_TABLE(kiriPlacesTable, kiriPlaces, {
    KIRI_DERIVED,
    KIRI_ARRAYS(head, next),
})

/* The stencil is gathered again. */
static void ForgetStencil(kiriArchive* archive, void* object)
{
    if (kiriArchive_Reads(archive)) {
        ((kiriRefresh*)object)->stencil.cell = KIRI_NONE;
    }
}

KIRI_SHARED_TABLE(kiriRefreshTable, kiriRefresh, {
    KIRI_DERIVED,
    KIRI_ARRAYS(noted, squares, marks),
    KIRI_DROPPED(stencil),
    KIRI_CUSTOM(stencil, ForgetStencil),
})

KIRI_TABLE(FadingTable, kiriFading, {
    KIRI_WITHIN(0, INT32_MAX, sample),
    KIRI_REALS(left, offset),
})

KIRI_SHARED_TABLE(kiriFadesTable, kiriFades, {
    KIRI_REALS(time, least),
    KIRI_PARTS(fading, FadingTable),
    KIRI_UNHASHED,
    KIRI_RUN(4, older),
    KIRI_REALS(jump, move),
})

KIRI_TABLE(PatchesTable, kiriPatches, {
    KIRI_FLOAT_ITEMS(floats),
    KIRI_ITEMS(1, isOther),
    KIRI_WITHIN(0, INT32_MAX, count),
    KIRI_BOOLS(isBent, areOther),
})

KIRI_TABLE(DetailTable, kiriDetail, {
    KIRI_HANDED,
    KIRI_WITHIN(0, KIRI_MOST_DETAIL, sweeps),
    KIRI_FLOAT_ITEMS(offsets),
    KIRI_UNHASHED,
    KIRI_DROPPED(longest),
    KIRI_DROPPED(isListed),
    KIRI_DERIVED,
    KIRI_ARRAYS(drawn, moving, crease, vertices, edges, awake),
})

KIRI_SHARED_TABLE(kiriSurfaceTable, kiriSurface, {
    KIRI_FLOAT_ITEMS(before),
    KIRI_REALS(middleBefore),
    KIRI_PART(detail, DetailTable),
    KIRI_UNHASHED,
    KIRI_HANDED,
    KIRI_WITHIN(KIRI_SKINNING_LINEAR, KIRI_SKINNING_SMOOTH, skinning),
    KIRI_RUN(4, revision),
    KIRI_COUNTS(pose),
    KIRI_REALS(middle),
    KIRI_ITEMS(8, carriers),
    KIRI_PART(patches, PatchesTable),
    KIRI_BOOLS(isWritten, hasNormals),
    KIRI_RUN(4, changes),
    KIRI_WITHIN(0, KIRI_CHANGES, changeCount),
    KIRI_WITHIN(0, KIRI_CHANGES - 1, lastChange),
    KIRI_DROPPED(lentAt),
    KIRI_DROPPED(hasSlopes),
    KIRI_DERIVED,
    KIRI_ARRAYS(positions, normals, restPositions, sourceWeights, indices, sourceTriangles),
    KIRI_ARRAYS(rest, turns, slopes, places, bends),
})

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
