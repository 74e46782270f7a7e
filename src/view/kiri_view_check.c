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

/* Vertices and normals are made again. */
static const kiriMember SurfaceMembers[] = {
    KIRI_UNHASHED,
    KIRI_HANDED,
    KIRI_WITHIN(KIRI_SKINNING_LINEAR, KIRI_SKINNING_SMOOTH, kiriSurface, skinning, skinning),
    KIRI_REALS(kiriSurface, origin, longer),
    KIRI_RUN(4, kiriSurface, vertexCount, revision),
    KIRI_COUNTS(kiriSurface, pose, pose),
    KIRI_REALS(kiriSurface, middle, middle),
    KIRI_SHOWN_OF(kiriSurface, positions),
    KIRI_SHOWN_OF(kiriSurface, normals),
    KIRI_SHOWN_OF(kiriSurface, slopes),
    KIRI_SHOWN_OF(kiriSurface, places),
    KIRI_ITEMS(8, kiriSurface, carriers),
    KIRI_SHOWN_OF(kiriSurface, bends),
    KIRI_PART(kiriSurface, patches, PatchesTable),
    KIRI_BOOLS(kiriSurface, isWritten, hasNormals),
    KIRI_ITEMS(4, kiriSurface, sourceWeights),
    KIRI_INDICES(KIRI_OF_VERTICES, kiriSurface, indices),
    KIRI_ITEMS(4, kiriSurface, sourceTriangles),
    KIRI_RUN(4, kiriSurface, changes, changes),
    KIRI_WITHIN(0, KIRI_CHANGES, kiriSurface, changeCount, changeCount),
    KIRI_WITHIN(0, KIRI_CHANGES - 1, kiriSurface, lastChange, lastChange),
    KIRI_DROPPED(kiriSurface, lentAt, lentAt),
    KIRI_DROPPED(kiriSurface, hasSlopes, hasSlopes),
    KIRI_DERIVED,
    KIRI_ARRAYS(kiriSurface, restPositions, rest, turns),
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

bool kiriSurface_HasRoom(const kiriSurface* surface)
{
    int64_t vertices = surface->vertexCount;
    return vertices >= 0 && surface->positions.count == 3 * vertices && surface->places.count == 3 * vertices &&
           surface->normals.count == 3 * vertices && surface->slopes.count == 4 * vertices &&
           surface->positions.capacity >= 3 * vertices + 1 && surface->places.capacity >= 3 * vertices + 1;
}

/* Arrays are as long as the mesh is large, and there is a patch for each frame that is seen. */
static bool HaveArraysLength(const kiriSurface* surface, const kiriMeshData* mesh, int64_t frames)
{
    int64_t vertices = mesh->vertices.count, triangles = mesh->triangles.count;
    int64_t floats = surface->patches.isBent ? KIRI_BENT_FLOATS : KIRI_FLAT_FLOATS;
    return surface->vertexCount == vertices && surface->triangleCount == triangles && kiriSurface_HasRoom(surface) &&
           surface->sourceWeights.count == 3 * vertices && surface->sourceTriangles.count == vertices &&
           surface->indices.count == 3 * triangles && surface->carriers.count >= frames &&
           surface->bends.count >= frames && surface->patches.count <= frames &&
           surface->patches.floats.capacity >= KIRI_BENT_FLOATS * frames &&
           surface->patches.floats.capacity >= floats * surface->patches.count &&
           surface->patches.isOther.capacity >= frames;
}

/* Hosts copy these ranges. */
static bool IsRangeUpTo(kiriRange range, int32_t end)
{
    return range.first >= 0 && range.count >= 0 && range.first + (int64_t)range.count <= end;
}

static bool AreChanges(const kiriSurface* surface)
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

/* Corners are those of the mesh, or all the same if the triangle is not seen. */
static bool AreCorners(const kiriSurface* surface, const kiriMeshData* mesh)
{
    bool areFine = true;
    for (int32_t t = 0; areFine && t < mesh->triangles.count; ++t) {
        const int32_t *is = &surface->indices.data[3 * (size_t)t], *should = mesh->triangles.data[t].vertex;
        areFine = (is[0] == is[1] && is[0] == is[2]) || (is[0] == should[0] && is[1] == should[1] && is[2] == should[2]);
    }
    return areFine;
}

bool kiriSurface_IsSound(const kiriSurface* surface, const kiriMeshData* mesh, int32_t frames)
{
    return HaveArraysLength(surface, mesh, frames) && surface->origin.x == mesh->origin.x && surface->origin.y == mesh->origin.y &&
           surface->longer == KIRI_LATTICE * mesh->step && AreCorners(surface, mesh) && AreChanges(surface);
}
