#include "kiri_seen.h"
#include "kiri_piece.h"

#include <math.h>

bool kiriPoint_Find(const kiriSheetData* sheet, kiriLatticePoint at, kiriPointPlace* place)
{
    place->at = at;
    place->triangle = kiriMesh_Locate(&sheet->mesh, at);
    if (place->triangle == KIRI_NONE) {
        return false;
    }
    kiriMesh_Shares(&sheet->mesh, place->triangle, at, place->shares);
    return true;
}

static const int32_t* CornersOf(const kiriSheetData* sheet, const kiriPointPlace* place)
{
    return sheet->mesh.triangles.data[place->triangle].vertex;
}

kiriVec3 kiriPoint_Position(const kiriSheetData* sheet, const kiriPointPlace* place)
{
    return kiriSurface_Blend(&sheet->seen.surface, CornersOf(sheet, place), place->shares);
}

kiriVec3 kiriPoint_Drawn(const kiriSheetData* sheet, const kiriPointPlace* place)
{
    const kiriSurface* surface = &sheet->seen.surface;
    kiriVec3 by = { 0 };
    KIRI_TIMES_WHILE(kiriSurface_HasDetail(surface), k, 3) {
        const float* offset = surface->detail.offsets.data + 3 * CornersOf(sheet, place)[k];
        by = kiriVec3_AddScaled(by, place->shares[k], kiriVec3_Load(offset));
    }
    return kiriVec3_Add(kiriPoint_Position(sheet, place), by);
}

static kiriVec3 AddCorner(const kiriSheetData* sheet, const float* places, kiriVec3 sum, int32_t h)
{
    const int32_t* v = sheet->mesh.triangles.data[h / 3].vertex;
    if (kiriMax(kiriMax(v[0], v[1]), v[2]) >= sheet->seen.surface.vertexCount) {
        return sum; /* a vertex of the cut under way: it has no place yet */
    }
    kiriVec3 a = kiriVec3_Load(places + 3 * v[0]), b = kiriVec3_Load(places + 3 * v[1]);
    kiriVec3 c = kiriVec3_Load(places + 3 * v[2]);
    return kiriVec3_Add(sum, kiriVec3_Cross(kiriVec3_Sub(b, a), kiriVec3_Sub(c, a)));
}

/* Returns the normal of the fan around the vertex. `places`: of the skin, or of the drawn surface. */
static kiriVec3 FanNormal(const kiriSheetData* sheet, const float* places, int32_t vertex)
{
    KIRI_ASSERT_HAS(sheet->mesh.vertices, vertex);
    int32_t start = sheet->mesh.vertices.data[vertex].edge, h = start;
    kiriVec3 sum = { 0 };
    do {
        sum = AddCorner(sheet, places, sum, h);
        h = kiriMesh_CounterClockwise(&sheet->mesh, h);
    } while (h != KIRI_NONE && h != start);
    if (h == KIRI_NONE) {
        for (h = kiriMesh_Clockwise(&sheet->mesh, start); h != KIRI_NONE; h = kiriMesh_Clockwise(&sheet->mesh, h)) {
            sum = AddCorner(sheet, places, sum, h);
        }
    }
    kiriVec3 unit = kiriVec3_Normalize(sum);
    return kiriVec3_Dot(unit, unit) > 0.0 ? unit : kiriVec3_Make(0.0, 0.0, 1.0);
}

/* Returns the normal of kiriNormals_Write. Without stored normals it sums the fan: a query may not write. */
static kiriVec3 VertexNormal(const kiriSheetData* sheet, int32_t vertex)
{
    const kiriSurface* surface = &sheet->seen.surface;
    return surface->hasNormals ? kiriVec3_Load(&surface->normals.data[3 * vertex])
                               : FanNormal(sheet, kiriSurface_Drawn(surface), vertex);
}

kiriVec3 kiriVertex_SkinNormal(const kiriSheetData* sheet, int32_t vertex)
{
    const kiriSurface* surface = &sheet->seen.surface;
    KIRI_ASSERT(surface->hasNormals);
    return kiriSurface_HasDetail(surface) ? FanNormal(sheet, surface->places.data, vertex)
                                          : VertexNormal(sheet, vertex);
}

kiriVec3 kiriTriangle_SkinNormal(const kiriSheetData* sheet, int32_t triangle, const double share[3])
{
    const int32_t* corners = kiriSurface_Triangle(&sheet->seen.surface, triangle);
    kiriVec3 sum = { 0 };
    KIRI_EACH_CORNER(k) {
        sum = kiriVec3_AddScaled(sum, share[k], kiriVertex_SkinNormal(sheet, corners[k]));
    }
    return kiriVec3_Normalize(sum);
}

/* Falls back to the normal of the triangle if the corner normals cancel out, and to one corner if its area is zero. */
kiriVec3 kiriPoint_Normal(const kiriSheetData* sheet, const kiriPointPlace* place)
{
    const int32_t* corners = CornersOf(sheet, place);
    kiriVec3 sum = { 0 };
    int heaviest = 0;
    KIRI_EACH_CORNER(k) {
        sum = kiriVec3_AddScaled(sum, place->shares[k], VertexNormal(sheet, corners[k]));
        heaviest = place->shares[k] > place->shares[heaviest] ? k : heaviest;
    }
    if (kiriVec3_Length(sum) < 1e-3) {
        const kiriSurface* surface = &sheet->seen.surface;
        kiriVec3 a = kiriSurface_DrawnAt(surface, corners[0]), b = kiriSurface_DrawnAt(surface, corners[1]);
        sum = kiriVec3_Cross(kiriVec3_Sub(b, a), kiriVec3_Sub(kiriSurface_DrawnAt(surface, corners[2]), a));
    }
    kiriVec3 unit = kiriVec3_Normalize(sum);
    return kiriVec3_Dot(unit, unit) > 0.5 ? unit : VertexNormal(sheet, corners[heaviest]);
}

/* Blends the frames at the corners, then the corners, as the visible mesh does. */
kiriMotion kiriPoint_Blend(const kiriSheetData* sheet, const kiriPointPlace* place)
{
    kiriMotion motion = { 0 };
    KIRI_EACH_CORNER(k) {
        int32_t corner = CornersOf(sheet, place)[k];
        kiriVec2 local = kiriMesh_LocalOf(&sheet->mesh, corner);
        kiriSpan span = sheet->vertexSkin.spans.data[corner];
        KIRI_EACH_IN(i, span) {
            kiriSampleWeight weight = sheet->vertexSkin.weights.data[i];
            const kiriFrameData* frame = &sheet->frames.data[weight.frame];
            double share = place->shares[k] * weight.value;
            motion.x = kiriVec3_AddScaled(motion.x, share, kiriFrame_Carry(frame, local));
            motion.velocity = kiriVec3_AddScaled(motion.velocity, share, kiriFrame_VelocityAt(frame, local));
        }
    }
    return motion;
}

/* ---- Blocks ---- */

/* Marks a block as unknown, so that its mover is found again: weights changed, or vertices are new. */
static void ForgetBlock(kiriBlocks* blocks, int32_t block)
{
    blocks->movers.data[block] = KIRI_UNKNOWN;
    blocks->hasUnknown = true;
}

static void ResizeBlocks(kiriBlocks* blocks, int32_t vertexCount, int32_t frameCount)
{
    int32_t old = blocks->movers.count, count = vertexCount / KIRI_BLOCK + 1, oldFrames = blocks->moved.count;
    KIRI_ASSERT(count <= blocks->movers.capacity && frameCount <= blocks->moved.capacity);
    blocks->touched.count = blocks->movers.count = count;
    blocks->moved.count = frameCount;
    KIRI_FROM_TO(block, old, count) {
        blocks->touched.data[block] = 0;
        ForgetBlock(blocks, block);
    }
    KIRI_FROM_TO(i, oldFrames, frameCount) {
        blocks->moved.data[i] = 0;
    }
}

void kiriBlocks_Renumber(kiriBlocks* blocks, int32_t vertexCount, int32_t frameCount)
{
    KIRI_EACH_INDEX(block, blocks->movers) {
        ForgetBlock(blocks, block);
    }
    KIRI_EACH(uint8_t, moved, blocks->moved) {
        *moved = 0;
    }
    ResizeBlocks(blocks, vertexCount, frameCount);
}

/* ---- Movers ---- */

/* Updates the movers after the set of awake pieces changed, or blocks became unknown. A block keeps its mover until that
   frame falls asleep; a block without a mover gets one when a frame wakes. */
static void FindMovers(kiriSheetData* sheet)
{
    kiriBlocks* blocks = &sheet->seen.blocks;
    bool anyWoke = false;
    KIRI_EACH_INDEX(i, sheet->frames) {
        uint8_t moves = kiriSheet_Moves(sheet, i);
        anyWoke = anyWoke || (moves && !blocks->moved.data[i]);
        blocks->moved.data[i] = moves;
    }
    KIRI_EACH_INDEX(block, blocks->movers) {
        int32_t mover = blocks->movers.data[block];
        bool isKnown = mover == KIRI_NONE ? !anyWoke : mover != KIRI_UNKNOWN && blocks->moved.data[mover];
        int32_t end = kiriMin((block + 1) * KIRI_BLOCK, sheet->seen.surface.vertexCount);
        KIRI_FROM_TO_WHILE(!isKnown, v, block * KIRI_BLOCK, end) {
            mover = sheet->vertexSkin.weights.data[sheet->vertexSkin.spans.data[v].first].frame;
            isKnown = blocks->moved.data[mover] != 0;
        }
        blocks->movers.data[block] = isKnown ? mover : KIRI_NONE;
    }
    blocks->hasUnknown = false;
}

bool kiriView_ReserveFades(kiriSheetData* sheet, int32_t vertexCount, int32_t pointCount, double fadeTime)
{
    bool fade = fadeTime > 0.0;
    return kiriArray_Reserve(sheet->memory, &sheet->seen.pointsBefore, pointCount) &&
           kiriArray_Reserve(sheet->memory, &sheet->seen.fades.fading, fade ? vertexCount : 0) &&
           kiriArray_Reserve(sheet->memory, &sheet->seen.pointFades.fading, fade ? pointCount : 0);
}

/* ---- Sleeping blocks ---- */

/* Returns true if sleeping blocks keep their normals and bounds. A commit may move deferred pieces, too. */
static bool IsPartlyDrawn(const kiriSheetData* sheet)
{
    return sheet->seen.surface.isPartly && !(sheet->turns.waiting > 0 && sheet->seen.isElsewhere);
}

static inline bool IsBlockMoved(const kiriSheetData* sheet, int32_t block)
{
    return sheet->seen.blocks.movers.data[block] != KIRI_NONE;
}

typedef void WriteVerticesFn(kiriSheetData* sheet, int32_t begin, int32_t end);

/* Calls `write` for all vertices; if only a part is written, for runs of blocks that move. */
static void ForBlocks(kiriSheetData* sheet, int32_t begin, int32_t end, bool isPartly, WriteVerticesFn* write)
{
    if (!isPartly) {
        write(sheet, begin, end);
        return;
    }
    for (int32_t next; begin < end; begin = next) {
        int32_t block = begin / KIRI_BLOCK, last = (end - 1) / KIRI_BLOCK;
        bool are = IsBlockMoved(sheet, block);
        while (block < last && IsBlockMoved(sheet, block + 1) == are) {
            ++block;
        }
        next = block < last ? (block + 1) * KIRI_BLOCK : end;
        if (are) {
            write(sheet, begin, next);
        }
    }
}

bool kiriView_Reserve(kiriSheetData* sheet, kiriViewCounts counts)
{
    kiriSeen* seen = &sheet->seen;
    int32_t blocks = counts.vertices / KIRI_BLOCK + 1;
    bool isSeen = seen->surface.vertexCount > 0; /* a surface never written cannot fade */
    return kiriSurface_Reserve(&seen->surface, &sheet->shown, counts.vertices, counts.triangles, counts.frames) &&
           kiriArray_Reserve(&sheet->shown, &seen->pointPositions, 3 * (int64_t)counts.points) &&
           kiriArray_Reserve(sheet->memory, &seen->exactPoints, counts.points) &&
           kiriArrays_Reserve(sheet->memory, blocks, &seen->blocks.touched, &seen->blocks.movers) &&
           kiriArray_Reserve(sheet->memory, &seen->blocks.moved, counts.frames) &&
           (!isSeen || kiriView_ReserveFades(sheet, counts.vertices, counts.points, seen->fades.time));
}

void kiriView_Resize(kiriSheetData* sheet, int32_t frameCount)
{
    kiriSeen* seen = &sheet->seen;
    kiriSurface_Resize(&seen->surface, sheet->mesh.vertices.count, sheet->mesh.triangles.count, frameCount);
    ResizeBlocks(&seen->blocks, sheet->mesh.vertices.count, frameCount);
    KIRI_ASSERT(3 * (int64_t)sheet->points.count <= seen->pointPositions.capacity);
    KIRI_ASSERT(sheet->points.count <= seen->exactPoints.capacity);
    seen->pointPositions.count = 3 * sheet->points.count;
    seen->exactPoints.count = sheet->points.count;
}

void kiriView_HideTriangles(kiriSheetData* sheet)
{
    KIRI_EACH_INDEX(t, sheet->mesh.triangles) {
        int32_t piece = kiriPiece_OfTriangle(sheet, t);
        if (sheet->layout.pieces.data[piece].isGone) {
            kiriSurface_HideTriangle(&sheet->seen.surface, t);
        }
    }
}

void kiriView_HideGone(kiriSheetData* sheet)
{
    kiriSurface* surface = &sheet->seen.surface;
    kiriSurface_NeedNormals(surface); /* hidden vertices keep normals until the next tick */
    kiriView_HideTriangles(sheet);
    surface->isWritten = surface->isSteady = false;
    sheet->mesh.revision += 1;
    surface->revision = sheet->mesh.revision;
    surface->changeCount = 0;
    surface->pose += 1;
}

void kiriView_WriteTopology(kiriSheetData* sheet)
{
    kiriView_Resize(sheet, sheet->frames.count);
    KIRI_FROM_TO(v, sheet->mesh.oldVertexCount, sheet->mesh.oldVertexCount + sheet->mesh.births.count) {
        const kiriBirth* birth = &sheet->mesh.births.data[v - sheet->mesh.oldVertexCount];
        /* On the visible triangle that the vertex was born in. */
        kiriSurface_Place(&sheet->seen.surface, v,
                          kiriSurface_Blend(&sheet->seen.surface, birth->parent, birth->share));
        if (kiriSurface_HasDetail(&sheet->seen.surface)) {
            kiriDetail_Bear(&sheet->seen.surface.detail, v, birth);
            kiriSurface_DrawRange(&sheet->seen.surface, v, v + 1);
            kiriVec3 drawn = kiriVec3_Load(kiriSurface_Drawn(&sheet->seen.surface) + 3 * v);
            kiriVec3_Store(&sheet->seen.surface.positions.data[3 * v],
                           kiriVec3_Add(sheet->seen.surface.middle, drawn));
        }
    }
    kiriSurface_WriteTopology(&sheet->seen.surface, &sheet->mesh);
    if (kiriPieces_AnyGone(sheet)) {
        kiriView_HideTriangles(sheet); /* a cut may have split triangles of a destroyed piece */
    }
    sheet->seen.isElsewhere = true;
}

void kiriView_ShowNewborn(kiriSheetData* sheet)
{
    kiriSurface* surface = &sheet->seen.surface;
    if (surface->vertexCount > sheet->seen.vertexCount && surface->hasNormals) {
        surface->hasNormals = surface->hasSlopes = false;
        if (surface->wantsNormals) {
            kiriSurface_NeedNormals(surface);
        }
    }
}

void kiriView_TakeFrames(kiriSheetData* sheet)
{
    kiriSeen* seen = &sheet->seen;
    const kiriMoved* moved = &sheet->solver->moved;
    bool isLocal = sheet->settings.mechanics.model != KIRI_MODEL_POINTS ||
                   sheet->settings.skinning == KIRI_SKINNING_LINEAR;
    bool isOther = !seen->surface.isSteady || seen->areFadesAsleep || /* positions of other bodies may have changed */
                   (sheet->rest.asleep && seen->fades.fading.count + seen->pointFades.fading.count > 0);
    moved = moved->isListed && !isOther && isLocal ? moved : NULL;
    const kiriPulls pulls = { sheet->links.links.data, sheet->links.links.count,
                              sheet->settings.mechanics.model == KIRI_MODEL_LINKS, &sheet->settings.material };
    kiriSurface_TakeFrames(&seen->surface, sheet->frames.data, sheet->frames.count, &pulls,
                           moved != NULL ? &moved->frames : NULL, moved != NULL ? &moved->links : NULL);
    if (seen->surface.isPartly && (moved->version != seen->lists || seen->blocks.hasUnknown)) {
        FindMovers(sheet);
        seen->lists = moved->version;
    }
    seen->surface.isWritten &= seen->fades.fading.count == 0;
}

/* Places collision points by linear blending under any skinning, because contacts use it (see kiri_motion.c). */
static void BlendPoints(kiriSheetData* sheet, bool isPartly)
{
    KIRI_EACH_INDEX(i, sheet->points) {
        if (isPartly && !kiriSheet_Moves(sheet, sheet->points.data[i].frame)) {
            continue;
        }
        kiriVec2 local = kiriMesh_Local(&sheet->mesh, sheet->points.data[i].at);
        sheet->seen.exactPoints.data[i] =
            kiriSkin_Position(&sheet->pointSkin, i, sheet->frames.data, local);
    }
}

static void AddPointFades(kiriSheetData* sheet)
{
    KIRI_EACH(const kiriFading, from, sheet->seen.pointFades.fading) {
        kiriFading fading = *from;
        kiriVec3* at = &sheet->seen.exactPoints.data[fading.sample];
        *at = kiriVec3_Add(*at, fading.offset);
    }
}

void kiriView_TouchStaged(kiriSheetData* sheet)
{
    KIRI_EACH(const kiriReweighed, staged, sheet->vertexSkin.staged) {
        sheet->seen.blocks.touched.data[staged->sample / KIRI_BLOCK] = 1;
    }
}

/* Comparison of positions before and after the commits of a tick. */
typedef struct JumpLook {
    kiriVec3 shift;
    bool isShifted;
    const float* before; /* visible positions of all vertices */
    bool anySleeps;      /* a piece sleeps */
    bool movesSleepers;  /* the position of a vertex of a sleeping piece changed */
} JumpLook;

static bool IsVertexAwake(const kiriSheetData* sheet, int32_t vertex)
{
    KIRI_ASSERT_HAS(sheet->mesh.vertices, vertex);
    return kiriPiece_IsMoved(&sheet->layout.pieces.data[kiriPiece_OfVertex(sheet, vertex)]);
}

static bool IsAnyBeyond(const float* a, const float* b, int32_t count, float most)
{
    int32_t beyond = 0;
    KIRI_TIMES(k, count) {
        float by = a[k] - b[k];
        beyond |= !(by <= most) | !(by >= -most);
    }
    return beyond != 0;
}

/* Blends the vertices of a block and adds fades for the ones that jumped. Most differ only by rounding, so a first test
   compares floats. */
static void LookAtVertices(kiriSheetData* sheet, JumpLook* look, int32_t begin, int32_t end)
{
    float was[3 * KIRI_BLOCK];
    kiriFades* fades = &sheet->seen.fades;
    memcpy(was, look->before + 3 * begin, 3 * sizeof(float) * (end - begin));
    kiriSurface_BlendRange(&sheet->seen.surface, &sheet->vertexSkin, begin, end);
    const float* is = kiriSurface_Places(&sheet->seen.surface) + 3 * begin;
    if (look->isShifted || (fades->older < fades->fading.capacity && fades->fading.data[fades->older].sample < end) ||
        IsAnyBeyond(was, is, 3 * (end - begin), (float)(0.5 * fades->least))) {
        for (int32_t v = begin, k = 0; v < end; ++v, k += 3) {
            kiriVec3 offset = kiriVec3_Sub(kiriVec3_Load(&was[k]), kiriVec3_Load(&is[k]));
            kiriFades_Take(fades, v, kiriVec3_Add(offset, look->shift));
        }
    }
    for (int32_t v = begin, k = 0; look->anySleeps && v < kiriMin(end, sheet->seen.vertexCount); ++v, k += 3) {
        bool isElsewhere = was[k] != is[k] || was[k + 1] != is[k + 1] || was[k + 2] != is[k + 2];
        look->movesSleepers = look->movesSleepers || (isElsewhere && !IsVertexAwake(sheet, v));
    }
}

/* Turns the jumps of vertices into fades. Vertices with unchanged weights and patches do not jump. Afterwards all
   positions match weights and patches, without fades, as after writing. */
static void TakeVertexJumps(kiriSheetData* sheet)
{
    kiriSurface* surface = &sheet->seen.surface;
    kiriVec3 middle = surface->middle;
    bool wasSteady = surface->isSteady;
    JumpLook look = { .before = kiriSurface_Places(surface) };
    KIRI_EACH(const kiriFading, fading, sheet->seen.fades.fading) {
        sheet->seen.blocks.touched.data[fading->sample / KIRI_BLOCK] = 1;
    }
    surface->isSteady = false;
    kiriView_TakeFrames(sheet);
    surface->isWritten = false;
    look.shift = kiriVec3_Sub(middle, surface->middle);
    /* Patches that changed only by rounding do not count if their piece moves in this tick: it is written again anyway. */
    KIRI_EACH_INDEX(i, sheet->frames) {
        const kiriPiece* piece = kiriSheet_PieceOf(sheet, i);
        uint8_t* isOther = &surface->patches.isOther.data[i];
        bool moves = kiriPiece_IsAwake(piece) && piece->rest.calm < KIRI_CALM_SECONDS;
        *isOther = *isOther == KIRI_PATCH_ROUNDED && moves ? KIRI_PATCH_SAME : *isOther;
    }
    look.isShifted = look.movesSleepers = look.shift.x != 0.0 || look.shift.y != 0.0 || look.shift.z != 0.0;
    KIRI_EACH_WHILE(!look.anySleeps, const kiriPiece, each, sheet->layout.pieces) {
        look.anySleeps = !kiriPiece_IsMoved(each);
    }
    kiriFades_Start(&sheet->seen.fades);
    for (int32_t begin = 0; begin < surface->vertexCount; begin += KIRI_BLOCK) {
        int32_t end = kiriMin(begin + KIRI_BLOCK, surface->vertexCount);
        bool isOther = sheet->seen.blocks.touched.data[begin / KIRI_BLOCK] || end > sheet->seen.vertexCount;
        if (isOther || kiriPatches_MayMove(&surface->patches, &sheet->vertexSkin, begin, end)) {
            LookAtVertices(sheet, &look, begin, end);
        }
        if (isOther) {
            ForgetBlock(&sheet->seen.blocks, begin / KIRI_BLOCK);
        }
    }
    surface->isSteady = wasSteady && !look.movesSleepers; /* false: normals of sleeping pieces are stale */
}

/* Turns the jumps of collision points into fades. New points have no previous position. */
static void TakePointJumps(kiriSheetData* sheet)
{
    kiriSeen* seen = &sheet->seen;
    const kiriVec3 *was = seen->pointsBefore.data, *is = seen->exactPoints.data;
    if (seen->pointCount > 0) {
        memcpy(seen->pointsBefore.data, is, sizeof(kiriVec3) * seen->pointCount);
    }
    BlendPoints(sheet, false);
    kiriFades_Start(&seen->pointFades);
    KIRI_TIMES(i, seen->pointCount) {
        kiriFades_Take(&seen->pointFades, i, kiriVec3_Sub(was[i], is[i]));
    }
    seen->pointCount = sheet->points.count;
}

void kiriView_TakeJump(kiriSheetData* sheet)
{
    if (sheet->seen.isElsewhere) {
        TakeVertexJumps(sheet);
        TakePointJumps(sheet);
        AddPointFades(sheet);
    }
}

void kiriView_Fade(kiriSheetData* sheet, double dt)
{
    kiriFades_Advance(&sheet->seen.fades, dt);
    kiriFades_Advance(&sheet->seen.pointFades, dt);
}

bool kiriView_IsSettled(const kiriSheetData* sheet)
{
    const kiriSeen* seen = &sheet->seen;
    return seen->surface.isWritten && seen->surface.isSteady && !seen->isElsewhere && seen->fades.fading.count == 0 &&
           seen->pointFades.fading.count == 0;
}

void kiriView_Trim(kiriSheetData* sheet)
{
    if (sheet->update->stage == KIRI_NONE && sheet->cuts.count == 0) {
        kiriFades_Trim(&sheet->seen.fades, sheet->memory);
        kiriFades_Trim(&sheet->seen.pointFades, sheet->memory);
        if (sheet->seen.pointFades.fading.count == 0 && sheet->seen.pointsBefore.capacity > 0) {
            kiriArray_Release(sheet->memory, &sheet->seen.pointsBefore);
        }
    }
}

static void BlendVertices(kiriSheetData* sheet, int32_t begin, int32_t end)
{
    kiriSurface_BlendRange(&sheet->seen.surface, &sheet->vertexSkin, begin, end);
}

static void WriteVertices(kiriSheetData* sheet, int32_t begin, int32_t end)
{
    kiriSurface_WriteRange(&sheet->seen.surface, begin, end);
}

void kiriView_BlendRange(kiriSheetData* sheet, int32_t begin, int32_t end)
{
    if (!sheet->seen.surface.isWritten) {
        ForBlocks(sheet, begin, end, sheet->seen.surface.isPartly, BlendVertices);
    }
}

/* ---- Normals ---- */

/* Returns true if the normal sums of most vertices are current. Updating single blocks costs several times as much a
   vertex. */
static bool IsSumKnown(const kiriSheetData* sheet)
{
    enum { FEW = 8 };
    const kiriSurface* surface = &sheet->seen.surface;
    bool isKnown = IsPartlyDrawn(sheet) && surface->hasSlopes && surface->hasNormals && surface->wantsNormals;
    int32_t anew = 0, blocks = (surface->vertexCount + KIRI_BLOCK - 1) / KIRI_BLOCK;
    KIRI_TIMES_WHILE(isKnown, block, blocks) {
        anew += IsBlockMoved(sheet, block);
    }
    return isKnown && FEW * (int64_t)anew <= blocks;
}

/* Sums the normals of blocks that move. No triangle has vertices of both a moving and a sleeping piece. */
static bool SumSomeNormals(kiriSheetData* sheet)
{
    bool ok = true;
    KIRI_TIMES_WHILE(ok, v, sheet->seen.surface.vertexCount) {
        int32_t block = v / KIRI_BLOCK;
        if (!IsBlockMoved(sheet, block)) {
            v = (block + 1) * KIRI_BLOCK - 1;
        } else if (IsVertexAwake(sheet, v)) {
            ok = kiriSurface_SumNormal(&sheet->seen.surface, &sheet->mesh, v);
        }
    }
    return ok;
}

static void DrawVertices(kiriSheetData* sheet, int32_t begin, int32_t end)
{
    kiriSurface_DrawRange(&sheet->seen.surface, begin, end);
}

void kiriView_AddFades(kiriSheetData* sheet)
{
    if (!sheet->seen.surface.isWritten) {
        kiriSurface_AddFades(&sheet->seen.surface, &sheet->seen.fades);
    }
}

void kiriView_Sum(kiriSheetData* sheet)
{
    kiriSeen* seen = &sheet->seen;
    if (!seen->surface.isWritten) {
        if (kiriSurface_HasDetail(&seen->surface)) {
            ForBlocks(sheet, 0, seen->surface.vertexCount, IsPartlyDrawn(sheet), DrawVertices);
            kiriDetail_Measure(&seen->surface.detail);
        }
        if (IsSumKnown(sheet) && SumSomeNormals(sheet)) {
            seen->surface.pose += 1;
        } else {
            kiriSurface_SumNormals(&seen->surface);
        }
    }
    BlendPoints(sheet, seen->surface.isPartly);
    AddPointFades(sheet);
    KIRI_EACH_INDEX(i, sheet->points) {
        kiriVec3_Store(&seen->pointPositions.data[3 * i], seen->exactPoints.data[i]);
    }
    seen->pointCount = sheet->points.count;
    seen->vertexCount = seen->surface.vertexCount;
}

void kiriView_WriteRange(kiriSheetData* sheet, int32_t begin, int32_t end)
{
    if (!sheet->seen.surface.isWritten) {
        ForBlocks(sheet, begin, end, IsPartlyDrawn(sheet), WriteVertices);
    }
}

void kiriView_EndWriting(kiriSheetData* sheet)
{
    kiriSeen* seen = &sheet->seen;
    if (seen->isElsewhere) {
        kiriArray_Set(&seen->blocks.touched, 0);
    }
    seen->surface.isPartly = IsPartlyDrawn(sheet); /* for boxes */
    seen->isElsewhere = false;
    seen->surface.isWritten = seen->fades.fading.count == 0;
    seen->surface.isSteady = true;
}

/* ---- Detail layer ---- */

/* Marks vertices that a pin, a held frame or a seam holds in the last of their numbers in `moving`: corners of triangles
   along its line that are nearer to it, in the rest plane, than `share` of the way to another corner. */
static void MarkHeld(kiriSheetData* sheet, kiriLatticePoint at, kiriLatticePoint to, double share, float mark)
{
    const kiriMeshData* mesh = &sheet->mesh;
    kiriVec2 from = kiriMesh_Local(mesh, at), end = kiriMesh_Local(mesh, to);
    kiriNearby nearby = kiriNearby_Begin(&mesh->squares, at, to, 0.0);
    KIRI_EACH_NEARBY(triangle, nearby) {
        KIRI_FROM_TO(h, 3 * triangle, 3 * triangle + 3) {
            kiriVec2 p = kiriMesh_Local(mesh, kiriMesh_TailAt(mesh, h));
            double next = kiriVec2_Distance(p, kiriMesh_Local(mesh, kiriMesh_HeadAt(mesh, h))),
                   last = kiriVec2_Distance(p, kiriMesh_Local(mesh, kiriMesh_TailAt(mesh, kiriEdge_Previous(h))));
            if (kiriVec2_DistanceToWay(p, from, end) < share * kiriMax(next, last)) {
                sheet->seen.surface.detail.moving.data[4 * kiriMesh_Tail(mesh, h) + 3] = mark;
            }
        }
    }
}

bool kiriSewn_IsNear(const kiriSheetData* sheet, kiriSeam seam, kiriVec2 at, double reach)
{
    bool isNear = false;
    KIRI_EACH_WHILE(!isNear, const kiriSewnLine, line, sheet->sewn) {
        isNear = line->seam == seam && kiriVec2_DistanceToWay(at, kiriMesh_Local(&sheet->mesh, line->from),
                                                                kiriMesh_Local(&sheet->mesh, line->to)) < reach;
    }
    return isNear;
}

#define SEWN 0.3 /* of an edge: a vertex as near to a seam is on the lip */

/* The longest offset by the side of a frame's region. */
#define LEASH 0.25

/* Lists vertices and edges again if pieces woke or fell asleep, or the mesh, the pieces, the pins, the held frames or the
   seams are others. */
static void ListDetail(kiriSheetData* sheet)
{
    kiriDetail* detail = &sheet->seen.surface.detail;
    KIRI_ASSERT(detail->awake.count == sheet->frames.count);
    uint64_t pins = KIRI_HASH_START;
    KIRI_EACH(const kiriPinData, pin, sheet->pins) {
        kiriHash_Word(&pins, pin->id);
    }
    KIRI_EACH(const kiriSewnLine, line, sheet->sewn) {
        kiriHash_Word(&pins, (uint64_t)(uint32_t)line->from.x << 32 | (uint32_t)line->from.y);
    }
    bool isStale = !detail->isListed || sheet->seen.isElsewhere;
    KIRI_EACH_INDEX(f, sheet->frames) {
        uint8_t moves = kiriSheet_Moves(sheet, f);
        isStale = isStale || moves != detail->awake.data[f];
        detail->awake.data[f] = moves;
        kiriHash_Word(&pins, sheet->frames.data[f].held ? sheet->frames.data[f].id : 0);
    }
    if (isStale || pins != detail->pins) {
        detail->pins = pins;
        detail->vertices.count = 0;
        KIRI_EACH_INDEX(v, sheet->mesh.vertices) {
            detail->moving.data[4 * v + 3] = 1.0f;
        }
        KIRI_TIMES_WHILE(sheet->mesh.folds.count > 0, h, 3 * sheet->mesh.triangles.count) {
            if (kiriMesh_IsCrease(&sheet->mesh, h)) { /* both sides stay together */
                detail->moving.data[4 * kiriMesh_Tail(&sheet->mesh, h) + 3] = 0.0f;
                detail->moving.data[4 * kiriMesh_Tail(&sheet->mesh, kiriEdge_Next(h)) + 3] = 0.0f;
            }
        }
        KIRI_EACH(const kiriPinData, pin, sheet->pins) {
            MarkHeld(sheet, pin->at, pin->to, 1.0, sheet->sewn.count == 0 ? -1.0f : 0.0f);
        }
        KIRI_EACH(const kiriSewnLine, line, sheet->sewn) {
            MarkHeld(sheet, line->from, line->to, SEWN, -1.0f);
        }
        KIRI_EACH(const kiriFrameData, frame, sheet->frames) {
            kiriLatticePoint at = kiriMesh_Snap(&sheet->mesh, frame->site.at);
            if (frame->held) {
                MarkHeld(sheet, at, at, 1.0, 0.0f);
            }
        }
        KIRI_EACH_INDEX(v, sheet->mesh.vertices) {
            int32_t frame = sheet->vertexSkin.weights.data[sheet->vertexSkin.spans.data[v].first].frame;
            if (detail->awake.data[frame]) {
                double leash = detail->moving.data[4 * v + 3] * LEASH * sqrt(sheet->frames.data[frame].area);
                KIRI_NEXT(detail->vertices) = (kiriDetailVertex){ v, (float)leash, 0.0f };
            }
        }
        kiriDetail_ListEdges(detail, &sheet->mesh, sheet->seen.surface.slopes.data);
        sheet->seen.surface.hasSlopes = false;
    }
}

/* Takes a part of the offsets away that drawn lips had; those that they have now are completed each tick. So lips that
   part do not jump. */
static void LetOffsetsGo(kiriSheetData* sheet, int32_t begin, int32_t end)
{
    const float kept = 0.8f;
    KIRI_FROM_TO(v, begin, end) {
        float* offset = sheet->seen.surface.detail.offsets.data + 3 * v;
        if ((offset[0] != 0.0f || offset[1] != 0.0f || offset[2] != 0.0f) && IsVertexAwake(sheet, v)) {
            KIRI_TIMES(k, 3) {
                offset[k] = fabsf(offset[k]) > 1e-12f ? kept * offset[k] : 0.0f;
            }
        }
    }
}

bool kiriView_Relax(kiriSheetData* sheet, const kiriTasks* tasks)
{
    enum { GROUPS = 512, VERTICES = 4096 }; /* a task of about 10 us */
    kiriSurface* surface = &sheet->seen.surface;
    kiriDetailTask task = { &surface->detail, kiriSurface_Places(surface), 0, sheet->probes.rooms.data,
                            sheet->probes.limits ? sheet->probes.rooms.count : 0 };
    if (!kiriSurface_HasDetail(surface) || surface->isWritten) {
        return false;
    }
    if (surface->detail.sweeps == 0) {
        ForBlocks(sheet, 0, surface->vertexCount, IsPartlyDrawn(sheet), LetOffsetsGo);
        return false;
    }
    ListDetail(sheet);
    int32_t count = task.detail->vertices.count;
    kiriTasks_Run(tasks, kiriDetail_Begin, count, VERTICES, &task);
    KIRI_TIMES(sweep, task.detail->sweeps) {
        for (task.color = 0; task.color < KIRI_DETAIL_COLORS; ++task.color) {
            int32_t groups = kiriDetail_GroupCount(task.detail, task.color);
            int32_t least = task.color < KIRI_DETAIL_COLORS - 1 ? GROUPS : INT32_MAX;
            kiriTasks_Run(tasks, kiriDetail_Sweep, groups, least, &task);
        }
        kiriTasks_Run(tasks, kiriDetail_Leash, count, VERTICES, &task);
    }
    kiriDetail_Smooth(task.detail, task.skin, surface->slopes.data); /* of awake vertices: kiriView_Sum renews them */
    kiriTasks_Run(tasks, kiriDetail_Leash, count, VERTICES, &task);
    return count > 0;
}

void kiriView_EndRelaxing(kiriSheetData* sheet)
{
    kiriSurface* surface = &sheet->seen.surface;
    kiriDetail_End(&surface->detail, kiriSurface_Places(surface));
}

void kiriView_KeepBounds(kiriSheetData* sheet)
{
    const kiriMovers movers = { sheet->seen.blocks.movers.data, KIRI_BLOCK, sheet->seen.lists };
    kiriBounds_Keep(sheet->seen.bounds, &sheet->seen.surface, &movers);
}

void kiriView_WritePositions(kiriSheetData* sheet)
{
    int32_t count = sheet->seen.surface.vertexCount;
    sheet->seen.surface.isWritten = sheet->seen.surface.isSteady = false;
    kiriView_TakeFrames(sheet);
    kiriView_BlendRange(sheet, 0, count);
    kiriView_AddFades(sheet);
    kiriView_Sum(sheet);
    kiriView_WriteRange(sheet, 0, count);
    kiriView_EndWriting(sheet);
}

double kiriView_Watch(kiriSheetData* sheet, double dt)
{
    kiriStrainWatch* watch = &sheet->watch;
    const kiriSurface* surface = &sheet->seen.surface;
    double end = kiriMin(watch->done + dt, 1.0), strained = 0.0;
    KIRI_ASSERT(watch->done >= 0.0 && watch->done < 1.0 && dt >= 0.0);
    KIRI_ASSERT(3 * (int64_t)surface->triangleCount <= surface->indices.capacity);
    KIRI_FROM_TO(t, (int32_t)(watch->done * surface->triangleCount), (int32_t)(end * surface->triangleCount)) {
        const int32_t* c = surface->indices.data + 3 * t; /* all the same in a hidden triangle */
        bool isBeyond = false;
        kiriVec2 sides[3];
        KIRI_EACH_CORNER(k) {
            int32_t a = c[k], b = c[(k + 1) % 3];
            KIRI_ASSERT_HAS(surface->rest, a);
            sides[k] = kiriVec2_Sub(surface->rest.data[b], surface->rest.data[a]);
            kiriVec3 is = kiriVec3_Sub(kiriSurface_DrawnAt(surface, b), kiriSurface_DrawnAt(surface, a));
            double squared = kiriVec3_Dot(is, is), rest = kiriVec2_Dot(sides[k], sides[k]);
            isBeyond = isBeyond || squared > 1.15 * 1.15 * rest || squared < 0.85 * 0.85 * rest;
        }
        double area = 0.5 * kiriVec2_Cross(sides[0], sides[1]);
        watch->area += area;
        watch->strained += isBeyond ? area : 0.0;
    }
    watch->done = end;
    if (end == 1.0) {
        int32_t rounds = watch->strained > 0.1 * watch->area ? watch->rounds + 1 : 0;
        strained = rounds == 2 ? watch->strained : 0.0;
        *watch = (kiriStrainWatch){ 0.0, 0.0, 0.0, kiriMin(rounds, 2) };
    }
    return strained;
}
