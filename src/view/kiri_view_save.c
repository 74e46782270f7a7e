#include "kiri_view_save.h"

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
    KIRI_ITEMS(4, kiriSkin, staged), KIRI_ITEMS(4, kiriSkin, settling),
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
