#include "kiri_view_check.h"

/* ---- Tables ------------------------------------------------------------------------------------------------------ */

static const kiriMember SkinMembers[] = {
    KIRI_DERIVED,
    KIRI_ARRAYS(kiriSkin, spans, weights, staged),
};
const kiriTable kiriSkinTable = KIRI_TABLE(kiriSkin, SkinMembers);

static const kiriMember PlacesMembers[] = {
    KIRI_DERIVED,
    KIRI_ARRAYS(kiriPlaces, head, next),
};
const kiriTable kiriPlacesTable = KIRI_TABLE(kiriPlaces, PlacesMembers);

/* The stencil is gathered again. */
static void ForgetStencil(kiriArchive* archive, void* object)
{
    if (kiriArchive_Reads(archive)) {
        ((kiriRefresh*)object)->stencil.cell = KIRI_NONE;
    }
}

static const kiriMember RefreshMembers[] = {
    KIRI_DERIVED,
    KIRI_ARRAYS(kiriRefresh, noted, squares, marks),
    KIRI_DROPPED(kiriRefresh, stencil, stencil),
    KIRI_CUSTOM(kiriRefresh, stencil, ForgetStencil),
};
const kiriTable kiriRefreshTable = KIRI_TABLE(kiriRefresh, RefreshMembers);

static const kiriMember FadingMembers[] = {
    KIRI_WITHIN(0, INT32_MAX, kiriFading, sample, sample),
    KIRI_REALS(kiriFading, left, offset),
};
static const kiriTable FadingTable = KIRI_TABLE(kiriFading, FadingMembers);

static const kiriMember FadesMembers[] = {
    KIRI_REALS(kiriFades, time, least),
    KIRI_PARTS(kiriFades, fading, FadingTable),
    KIRI_UNHASHED,
    KIRI_RUN(4, kiriFades, older, older),
    KIRI_REALS(kiriFades, jump, move),
};
const kiriTable kiriFadesTable = KIRI_TABLE(kiriFades, FadesMembers);

static const kiriMember PatchesMembers[] = {
    KIRI_FLOAT_ITEMS(kiriPatches, floats),
    KIRI_ITEMS(1, kiriPatches, isOther),
    KIRI_WITHIN(0, INT32_MAX, kiriPatches, count, count),
    KIRI_BOOLS(kiriPatches, isBent, areOther),
};
static const kiriTable PatchesTable = KIRI_TABLE(kiriPatches, PatchesMembers);

static const kiriMember SurfaceMembers[] = {
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
};
const kiriTable kiriSurfaceTable = KIRI_TABLE(kiriSurface, SurfaceMembers);

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
