/* Saves whose sum is right, but which say what no world can be: kiriWorld_Load refuses them with one line, and changes
   nothing. A world is made wrong in memory in one way at a time, and saved as it is. */
#include "host.h"

#include "world/kiri_world.h"

typedef void SpoilFn(kiriSheetData* sheet);

#define SPOIL(name, statement)                                                                                         \
    static void name(kiriSheetData* sheet)                                                                             \
    {                                                                                                                  \
        statement;                                                                                                     \
    }

typedef struct Spoiler {
    const char* name;
    SpoilFn* spoil;
} Spoiler;

/* ---- Saves ---- */

/* A sheet with a slit. */
static void StartCut(Host* host)
{
    const float slit[4] = { 0.1f, 0.3f, 0.8f, 0.36f };
    Host_Start(host);
    kiriSheet sheet = Host_AddSmall(host, 4);
    Host_Cut(host, sheet, slit, 2);
    OK(Host_Tick(host, 0.01f, 1));
}

/* The world of the host is spoiled, and then what it was again. */
static void CheckRefused(Host* host, const Spoiler* spoiler)
{
    START_HOST(other);
    SCOPED_AS(Bytes, good, Bytes_Free) = World_Write(host->world, kiriWorld_Save);
    spoiler->spoil(host->world->sheets.data[0]);
    SCOPED_AS(Bytes, bad, Bytes_Free) = World_Write(host->world, kiriWorld_Save);
    uint64_t before = Host_Hash(&other);
    if (kiriWorld_Load(other.world, bad.data, bad.size) != KIRI_ERROR_DATA || Host_Hash(&other) != before) {
        fail_msg("%s: the save is not refused", spoiler->name);
    }
    assert_non_null(strstr(kiriWorld_GetLastError(other.world), "a right sum"));
    OK(kiriWorld_Load(host->world, good.data, good.size));
    OK(kiriWorld_Load(other.world, good.data, good.size));
    Host_Validate(&other);
}

static void CheckAll(Host* host, const Spoiler* spoilers, size_t count)
{
    for (size_t k = 0; k < count; ++k) {
        CheckRefused(host, &spoilers[k]);
    }
    Host_Stop(host);
}

#define CHECK_ALL_REFUSED(host, spoilers) CheckAll(host, spoilers, sizeof(spoilers) / sizeof((spoilers)[0]))

/* ---- The mesh and frames ---- */

SPOIL(TwinIsAnother, sheet->mesh.triangles.data[0].twin[1] = 3 * sheet->mesh.triangles.count - 1)
SPOIL(SourceIsFar, sheet->mesh.triangles.data[0].source = 1 << 28)
SPOIL(SourceIsBelow, sheet->mesh.triangles.data[0].source = -80)
SPOIL(SourcesAreTheSame, sheet->mesh.triangles.data[1].source = sheet->mesh.triangles.data[0].source)
SPOIL(OriginalsAreMore, sheet->mesh.originals = sheet->mesh.triangles.count + 1)
SPOIL(BlockIsFar, sheet->mesh.sourceBlocks.data[0] = sheet->mesh.sourceCorners.count / (3 * KIRI_SOURCES_A_BLOCK))

static void BlockHasNoCorners(kiriSheetData* sheet)
{
    memset(sheet->mesh.sourceCorners.data, 0, sizeof(kiriLatticePoint) * (size_t)sheet->mesh.sourceCorners.count);
}

SPOIL(CornerIsNone, sheet->mesh.triangles.data[0].vertex[1] = KIRI_NONE)
SPOIL(FrameIsOfNoPiece, sheet->layout.framePiece.data[0] = 1 << 28)
SPOIL(FrameHasNoPiece, sheet->layout.framePiece.count -= 1)
SPOIL(WeightIsNotFinite, sheet->shape.rigidWeight = HUGE_VAL)
SPOIL(SiteIsFarFromItsAnchor, sheet->frames.data[0].site.at.x += 0.5)

TEST(MeshAndFrames)
{
    static const Spoiler spoilers[] = {
        { "TwinIsAnother", TwinIsAnother },         { "SourceIsFar", SourceIsFar },
        { "SourceIsBelow", SourceIsBelow },         { "SourcesAreTheSame", SourcesAreTheSame },
        { "OriginalsAreMore", OriginalsAreMore },   { "BlockIsFar", BlockIsFar },
        { "BlockHasNoCorners", BlockHasNoCorners }, { "CornerIsNone", CornerIsNone },
        { "FrameIsOfNoPiece", FrameIsOfNoPiece },   { "FrameHasNoPiece", FrameHasNoPiece },
        { "WeightIsNotFinite", WeightIsNotFinite }, { "SiteIsFarFromItsAnchor", SiteIsFarFromItsAnchor },
    };
    Host host;
    StartCut(&host);
    CHECK_ALL_REFUSED(&host, spoilers);
}

/* ---- What is seen ---- */

static void ChangeIsBeyond(kiriSheetData* sheet)
{
    kiriSurface* surface = &sheet->seen.surface;
    assert_true(surface->changeCount > 0);
    surface->changes[surface->lastChange].vertices = (kiriRange){ 0, 1 << 20 };
}

SPOIL(PatienceIsNegative, sheet->seen.bounds->patience = -1)

TEST(Seen)
{
    static const Spoiler spoilers[] = {
        { "ChangeIsBeyond", ChangeIsBeyond },
        { "PatienceIsNegative", PatienceIsNegative },
    };
    Host host;
    StartCut(&host);
    host.world->sheets.data[0]->seen.bounds->patience = 1; /* somebody has asked */
    CHECK_ALL_REFUSED(&host, spoilers);
}

/* ---- Cuts that wait ---- */

static void PointEndsACutThatGoesOn(kiriSheetData* sheet)
{
    sheet->queue.data[0].ends = true;
    sheet->queue.data[0].cut->ended = false;
}

SPOIL(BladeIsAtWork, sheet->cuts.data[0]->tip.blade.phase = KIRI_BLADE_LOOKS)

TEST(Cuts)
{
    static const Spoiler spoilers[] = {
        { "PointEndsACutThatGoesOn", PointEndsACutThatGoesOn },
        { "BladeIsAtWork", BladeIsAtWork },
    };
    const float across[4] = { 0.2f, 0.5f, 0.8f, 0.5f };
    Host host;
    StartCut(&host);
    Host_Cut(&host, host.world->sheets.data[0]->id, across, 2);
    CHECK_ALL_REFUSED(&host, spoilers);
}

/* ---- Pieces ---- */

/* Sheet with two pieces that hang together with nothing. */
static void StartPieces(Host* host)
{
    const float through[4] = { -0.2f, 0.45f, 1.2f, 0.55f };
    Host_Start(host);
    kiriSheet sheet = Host_AddSmall(host, 4);
    Host_Cut(host, sheet, through, 2);
    OK(Host_Tick(host, 0.01f, 1));
    assert_int_equal(host->world->sheets.data[0]->layout.pieces.count, 2);
}

static int32_t FrameOfPiece(const kiriSheetData* sheet, int32_t piece)
{
    int32_t frame = sheet->frames.count - 1;
    while (sheet->layout.framePiece.data[frame] != piece) {
        --frame;
    }
    return frame;
}

/* Each is right where it is, but in the midst of the other piece. */
static void FramesChangePlaces(kiriSheetData* sheet)
{
    kiriFrameData *a = &sheet->frames.data[FrameOfPiece(sheet, 0)], *b = &sheet->frames.data[FrameOfPiece(sheet, 1)];
    kiriLatticePoint anchor = a->anchor;
    kiriSite site = a->site;
    a->anchor = b->anchor;
    a->site = b->site;
    b->anchor = anchor;
    b->site = site;
}

/* No grid is fine enough to tell them apart. */
static void FramesShareASite(kiriSheetData* sheet)
{
    kiriFrameData* frames = sheet->frames.data;
    assert_int_equal(sheet->layout.framePiece.data[0], sheet->layout.framePiece.data[1]);
    frames[1].anchor = frames[0].anchor;
    frames[1].site = frames[0].site;
}

TEST(PiecesElsewhere)
{
    static const Spoiler spoilers[] = {
        { "FramesChangePlaces", FramesChangePlaces },
        { "FramesShareASite", FramesShareASite },
    };
    Host host;
    StartPieces(&host);
    CHECK_ALL_REFUSED(&host, spoilers);
}

/* ---- Seams ---- */

static Host sewn;

#define SPOIL_STITCH(name, statement)                                                                                  \
    static void name(kiriSheetData* sheet)                                                                             \
    {                                                                                                                  \
        kiriStitchData* stitch = &sewn.world->seams.data[0]->stitches.data[1];                                         \
        (void)sheet, (void)stitch;                                                                                     \
        statement;                                                                                                     \
    }

SPOIL_STITCH(FrameIsNone, stitch->frames[0] = 12345)
SPOIL_STITCH(PointIsFar, stitch->at[1].x = INT32_MAX)
SPOIL_STITCH(PointIsOutside, stitch->at[1].x -= 1 << 24)
SPOIL_STITCH(LengthIsNegative, stitch->length = -1.0)
SPOIL_STITCH(ShareIsZero, stitch->share = 0.0)
SPOIL_STITCH(SeamIsOther, sewn.world->seams.data[0]->id += 1)
SPOIL_STITCH(SeamIsEmpty, sewn.world->seams.data[0]->stitches.count = 0)

TEST(Seams)
{
    static const Spoiler spoilers[] = {
        { "FrameIsNone", FrameIsNone },         { "PointIsFar", PointIsFar },
        { "PointIsOutside", PointIsOutside },   { "LengthIsNegative", LengthIsNegative },
        { "ShareIsZero", ShareIsZero }, { "SeamIsOther", SeamIsOther },
        { "SeamIsEmpty", SeamIsEmpty },
    };
    static const float right[4] = { 1.0f, 0.0f, 1.0f, 1.0f }, left[4] = { 0.0f, 0.0f, 0.0f, 1.0f };
    Host_Start(&sewn);
    kiriSheetDef def = Host_SmallDef();
    kiriSeamDef seam = DefaultSeam();
    seam.sheetA = Host_AddRectangle(&sewn, &def, 1.0f, 1.0f, 4, 4);
    def.position[0] = 1.0f;
    seam.sheetB = Host_AddRectangle(&sewn, &def, 1.0f, 1.0f, 4, 4);
    seam.lineA = right;
    seam.lineB = left;
    seam.countA = seam.countB = 2;
    World_AddSeam(sewn.world, &seam);
    CHECK_ALL_REFUSED(&sewn, spoilers);
}
