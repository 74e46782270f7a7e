#include "kiri_view_check.h"

/* ---- Rules ------------------------------------------------------------------------------------------------------- */

static const kiriMust FadingMust[] = {
    KIRI_INDEX(KIRI_OF_SAMPLES, kiriFading, sample, sample),
    KIRI_REALS(kiriFading, left, offset),
};

static const kiriMust FadesMust[] = {
    KIRI_REALS(kiriFades, time, least),
    KIRI_ITEMS_MUST(kiriFades, fading, FadingMust),
    KIRI_REALS(kiriFades, jump, move),
};

static const kiriMust IsVertexIndex[] = { KIRI_INDEX(KIRI_OF_VERTICES, kiriSpan, first, first) };

static const kiriMust SurfaceMust[] = {
    KIRI_WITHIN(KIRI_SKINNING_LINEAR, KIRI_SKINNING_SMOOTH, kiriSurface, skinning, skinning),
    KIRI_REALS(kiriSurface, middle, middle),
    KIRI_COUNTS(kiriSurface, pose, pose),
    KIRI_ITEMS_MUST(kiriSurface, indices, IsVertexIndex),
    KIRI_ITEMS_MUST(kiriSurface, patches.floats, kiriMustBeFloat),
    KIRI_WITHIN(0, KIRI_CHANGES, kiriSurface, changeCount, changeCount),
    KIRI_WITHIN(0, KIRI_CHANGES - 1, kiriSurface, lastChange, lastChange),
};

/* ---- Fades ------------------------------------------------------------------------------------------------------- */

/* By sample, each once. */
bool kiriFades_Check(const kiriFades* fades, kiriCheck* check, int32_t samples)
{
    check->count[KIRI_OF_SAMPLES] = samples;
    bool areFine = kiriCheck_Object(check, FadesMust, fades);
    for (int32_t k = 1; areFine && k < fades->fading.count; ++k) {
        areFine = kiriCheck_That(check, fades->fading.data[k - 1].sample < fades->fading.data[k].sample);
    }
    for (int32_t k = 0; areFine && k < fades->fading.count; ++k) {
        areFine = kiriCheck_That(check, fades->fading.data[k].left > 0.0);
    }
    return areFine;
}

/* ---- The surface ------------------------------------------------------------------------------------------------- */

bool kiriSurface_HasRoom(const kiriSurface* surface)
{
    int64_t vertices = surface->vertexCount;
    return vertices >= 0 && surface->positions.count == 3 * vertices && surface->places.count == 3 * vertices &&
           surface->normals.count == 3 * vertices && surface->slopes.count == 4 * vertices &&
           surface->positions.capacity >= 3 * vertices + 1 && surface->places.capacity >= 3 * vertices + 1;
}

/* All rows are as long as the mesh is large, and there is a patch for each frame that is seen. */
static bool AreRowsOfSurface(const kiriSurface* surface, const kiriMeshData* mesh, int64_t frames, int64_t labels)
{
    int64_t vertices = mesh->vertices.count, triangles = mesh->triangles.count;
    int64_t floats = surface->patches.isBent ? KIRI_BENT_FLOATS : KIRI_FLAT_FLOATS;
    return surface->vertexCount == vertices && surface->triangleCount == triangles && kiriSurface_HasRoom(surface) &&
           surface->sourceWeights.count == 3 * vertices && surface->sourceTriangles.count == vertices &&
           surface->indices.count == 3 * triangles && surface->carriers.count >= frames &&
           surface->bends.count >= frames && surface->patches.count >= 0 && surface->patches.count <= labels &&
           surface->patches.floats.capacity >= KIRI_BENT_FLOATS * labels &&
           surface->patches.floats.capacity >= floats * surface->patches.count &&
           surface->patches.isOther.capacity >= labels;
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

static bool IsOfMesh(const kiriSurface* surface, const kiriMeshData* mesh)
{
    return surface->origin.x == mesh->origin.x && surface->origin.y == mesh->origin.y &&
           surface->longer == KIRI_LATTICE * mesh->step;
}

/* Corners are those of the mesh, or all one where the triangle is not seen. */
static bool AreCornersOfSurface(const kiriSurface* surface, const kiriMeshData* mesh)
{
    bool areFine = true;
    for (int32_t t = 0; areFine && t < mesh->triangles.count; ++t) {
        const int32_t *is = &surface->indices.data[3 * (size_t)t], *should = mesh->triangles.data[t].vertex;
        bool isHidden = is[0] == is[1] && is[0] == is[2] && is[0] >= 0 && is[0] < mesh->vertices.count;
        areFine = isHidden || (is[0] == should[0] && is[1] == should[1] && is[2] == should[2]);
    }
    return areFine;
}

bool kiriSurface_Check(const kiriSurface* surface, const kiriLabels* labels, const kiriMeshData* mesh, kiriCheck* check)
{
    int32_t frames = (int32_t)check->count[KIRI_OF_FRAMES];
    return kiriCheck_That(check, AreRowsOfSurface(surface, mesh, frames, kiriLabels_Count(labels, frames))) &&
           kiriCheck_Object(check, SurfaceMust, surface) &&
           kiriCheck_That(check, IsOfMesh(surface, mesh) && AreCornersOfSurface(surface, mesh) && AreChanges(surface));
}

/* It is gathered anew. */
static void ForgetStencil(kiriArchive* archive, void* object)
{
    kiriRefresh* refresh = object;
    if (kiriArchive_Reads(archive)) {
        refresh->stencil.cell = KIRI_NONE;
    }
}

static const kiriMember SkinMembers[] = {
    KIRI_ITEMS(4, kiriSkin, spans),  KIRI_ITEMS(4, kiriSkin, weights),  KIRI_RUN(4, kiriSkin, room, room),
    KIRI_ITEMS(4, kiriSkin, staged),
};
const kiriTable kiriSkinTable = KIRI_TABLE(kiriSkin, SkinMembers);

static const kiriMember PlacesMembers[] = {
    KIRI_ITEMS(4, kiriPlaces, head),
    KIRI_ITEMS(4, kiriPlaces, next),
};
const kiriTable kiriPlacesTable = KIRI_TABLE(kiriPlaces, PlacesMembers);

static const kiriMember RefreshMembers[] = {
    KIRI_ITEMS(4, kiriRefresh, noted),
    KIRI_ITEMS(4, kiriRefresh, squares),
    KIRI_ITEMS(1, kiriRefresh, marks),
    KIRI_RUN(4, kiriRefresh, change, sample),
    KIRI_CUSTOM(kiriRefresh, stencil, ForgetStencil),
};
const kiriTable kiriRefreshTable = KIRI_TABLE(kiriRefresh, RefreshMembers);

static const kiriMember FadingMembers[] = {
    KIRI_RUN(4, kiriFading, sample, sample),
    KIRI_RUN(8, kiriFading, left, offset),
};
static const kiriTable FadingTable = KIRI_TABLE(kiriFading, FadingMembers);

static const kiriMember FadesMembers[] = {
    KIRI_RUN(8, kiriFades, time, least),
    KIRI_PARTS(kiriFades, fading, FadingTable),
    KIRI_RUN(4, kiriFades, older, older),
    KIRI_RUN(8, kiriFades, jump, move),
};
const kiriTable kiriFadesTable = KIRI_TABLE(kiriFades, FadesMembers);

static const kiriMember PatchesMembers[] = {
    KIRI_ITEMS(4, kiriPatches, floats),
    KIRI_ITEMS(1, kiriPatches, isOther),
    KIRI_RUN(4, kiriPatches, count, count),
    KIRI_BOOLS(kiriPatches, isBent, areOther),
};
static const kiriTable PatchesTable = KIRI_TABLE(kiriPatches, PatchesMembers);

/* What only the work on cuts changes, and whoever takes pieces out. */
static const kiriMember StillSurfaceMembers[] = {
    KIRI_ITEMS(4, kiriSurface, sourceWeights),
    KIRI_ITEMS(4, kiriSurface, indices),
    KIRI_ITEMS(4, kiriSurface, sourceTriangles),
    KIRI_RUN(4, kiriSurface, changes, lastChange),
};
const kiriTable kiriStillSurfaceTable = KIRI_TABLE(kiriSurface, StillSurfaceMembers);

/* What saves derive from the mesh. */
static const kiriMember RestSurfaceMembers[] = {
    KIRI_ITEMS(4, kiriSurface, restPositions),
    KIRI_ITEMS(8, kiriSurface, rest),
    KIRI_ITEMS(1, kiriSurface, turns),
};
const kiriTable kiriRestSurfaceTable = KIRI_TABLE(kiriSurface, RestSurfaceMembers);

/* And what changes in any tick. Vertices and normals are made anew. */
static const kiriMember LiveSurfaceMembers[] = {
    KIRI_RUN(4, kiriSurface, skinning, skinning),
    KIRI_RUN(8, kiriSurface, origin, longer),
    KIRI_SHOWN_OF(kiriSurface, positions),
    KIRI_SHOWN_OF(kiriSurface, normals),
    KIRI_RUN(4, kiriSurface, vertexCount, revision),
    KIRI_DROPPED(kiriSurface, lentAt),
    KIRI_SHOWN_OF(kiriSurface, slopes),
    KIRI_RUN(8, kiriSurface, pose, middle),
    KIRI_SHOWN_OF(kiriSurface, places),
    KIRI_ITEMS(8, kiriSurface, carriers),
    KIRI_SHOWN_OF(kiriSurface, bends),
    KIRI_PART(kiriSurface, patches, PatchesTable),
    KIRI_BOOLS(kiriSurface, isWritten, hasNormals),
    KIRI_DROPPED(kiriSurface, hasSlopes),
};
const kiriTable kiriLiveSurfaceTable = KIRI_TABLE(kiriSurface, LiveSurfaceMembers);
