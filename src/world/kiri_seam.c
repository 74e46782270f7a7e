#include "kiri_seam.h"
#include "kiri_call.h"
#include "../core/kiri_archive.h"
#include "../sheet/kiri_piece.h"
#include "../sheet/kiri_touch.h"

#define STITCH_STIFFNESS 100.0   /* of a stitch, relative to Young's modulus times thickness: more resists no pull, */
#define SQUARED_PITCH 5e7 /* 1/s^2: and of a frame on it. It sinks by 2e-7 m under its weight, */
#define STIFF_PITCH 5e6   /* and by 2e-6 m where lips are arcs of other frames: these differ a little */
#define CLOSING_SPEED 1.0 /* m/s: limit of the speed at which lips that are apart are drawn together */
#define NEAR 256          /* lattice steps: rounding error of the host's floats */
#define PER_SPACING 1.5   /* stitches for the distance of frames */
#define GRAVITY 9.81      /* m/s^2 */
#define MOST_STITCHES 4096
#define MOST_LINE_CORNERS 4096 /* of the lines: those after them are cut off */
/* Of welds: */
#define ON_SEAM 2048 /* lattice steps: a vertex as near to the line of a seam is on its lip */
#define INTO_SHEET 512 /* lattice steps: from a border into the material */
#define WELD_REACH 1.0  /* distances of frames: way over which offsets fade */
#define WELD_OPEN 0.5   /* distances of frames: lips that are farther apart are drawn where they are */
#define WELD_CLOSED 1e-6 /* sides of the sheet: lips as near need no more rounds */

enum { WELD_SPREADS = 2, WELD_ROUNDS = 8 };

/* ---- Ends -------------------------------------------------------------------------------------------------------- */

static const kiriSlot* SlotOf(const kiriWorld* world, const kiriStitchData* stitch, int end)
{
    return kiriPool_Find(&world->frameIds, stitch->frames[end]);
}

kiriSheetData* kiriStitch_Sheet(const kiriWorld* world, const kiriStitchData* stitch, int end)
{
    const kiriSlot* slot = SlotOf(world, stitch, end);
    return slot != NULL ? slot->owner : NULL;
}

/* Wakes the pieces of a stitch that comes or goes. Their forces do not predict the next step. */
static void WakeEnds(const kiriWorld* world, const kiriStitchData* stitch)
{
    KIRI_TIMES(end, 2) {
        const kiriSlot* slot = SlotOf(world, stitch, end);
        if (slot != NULL) {
            kiriSheetData* sheet = slot->owner;
            int32_t piece = sheet->layout.framePiece.data[slot->index];
            kiriIndexSpan frames = kiriSolver_FramesOf(sheet->solver, piece);
            kiriSheet_WakePiece(sheet, piece);
            KIRI_EACH_LISTED(frame, frames) {
                memset(&sheet->frames.data[frame].history, 0, sizeof(kiriHistory));
            }
        }
    }
}

/* Sets the frame that carries most of the point. Returns false outside the material, and on a destroyed piece. */
static bool FollowEnd(const kiriSheetData* sheet, kiriStitchData* stitch, int end)
{
    kiriContactMember weights[KIRI_STITCH_SIDE];
    int32_t count = kiriTouches_WeighPoint(sheet, stitch->at[end], weights);
    bool isThere = count > 0 && !kiriSheet_IsGone(sheet, weights[0].frame);
    stitch->frames[end] = isThere ? sheet->frames.data[weights[0].frame].id : stitch->frames[end];
    return isThere;
}

void kiriSeams_Follow(kiriWorld* world)
{
    KIRI_EACH_OF(kiriSeamData, seam, world->seams) {
        KIRI_EACH(kiriStitchData, stitch, seam->stitches) {
            KIRI_TIMES(end, 2) {
                const kiriSheetData* sheet = kiriStitch_Sheet(world, stitch, end);
                (void)(sheet != NULL && FollowEnd(sheet, stitch, end));
            }
        }
    }
}

/* Changes weights so that the mean of the centres lies beside the point along a way, or is as near as weights above 0
   allow. */
static void Straighten(const kiriSheetData* sheet, kiriVec2 point, kiriVec2 way, kiriContactMember* weights, int32_t count)
{
    double off[KIRI_STITCH_SIDE], mean = 0.0, spread = 0.0, last = 0.0;
    KIRI_TIMES(n, count) {
        off[n] = kiriVec2_Dot(kiriVec2_Sub(sheet->frames.data[weights[n].frame].center, point), way);
        mean += weights[n].value * off[n];
    }
    KIRI_TIMES(n, count) {
        off[n] = mean > 0.0 ? off[n] - mean : mean - off[n];
        spread += weights[n].value * off[n] * off[n];
        last = kiriMax(last, off[n]);
    }
    /* rounding alone parts frames in a row */
    double slope = spread > 1e-12 * mean * mean ? kiriMin(fabs(mean) / spread, 1.0 / last) : 0.0;
    KIRI_TIMES(n, count) {
        weights[n].value *= 1.0 - slope * off[n];
        KIRI_ASSERT(weights[n].value > -1e-9 && weights[n].value < 1.0 + 1e-9);
    }
}

/* Finds the frames that carry a point of a lip, and the points that they carry. If the material bends, it is an arc
   between frames: from the centre of each frame to the point it goes along the mean of the frame's axes and of the axes
   at the point, which are blended from all frames. So lips with other frames bend alike: all of them go through the
   points of an even bend, for the mean of the centres does. Returns the number of frames. */
static int32_t CarryEnd(const kiriSheetData* sheet, const kiriStitchData* stitch, int end, bool bends,
                        kiriContactMember* members)
{
    kiriContactMember weights[KIRI_STITCH_SIDE];
    int32_t count = kiriTouches_WeighPoint(sheet, stitch->at[end], weights);
    KIRI_ASSERT(count >= 0 && count <= KIRI_STITCH_SIDE);
    kiriVec2 point = kiriMesh_Local(&sheet->mesh, stitch->at[end]), rest = point;
    if (bends) {
        Straighten(sheet, point, kiriVec2_Left(stitch->inward[end]), weights, count);
    }
    KIRI_TIMES(n, count) {
        rest = kiriVec2_AddScaled(rest, -weights[n].value, sheet->frames.data[weights[n].frame].center);
    }
    KIRI_TIMES(n, count) {
        kiriVec2 center = sheet->frames.data[weights[n].frame].center;
        kiriVec2 half = kiriVec2_Scale(0.5, kiriVec2_Add(kiriVec2_Add(center, point), rest));
        members[n] = (kiriContactMember){ weights[n].frame, weights[n].value, bends ? half : point };
    }
    return count;
}

/* ---- Hinges ------------------------------------------------------------------------------------------------------

   At each end a direction of the material leads from the seam into the sheet, across the seam. The hinge turns the
   second one to where the first one and the normal of its sheet have it at the rest angle. Angles are 0 where the sheets
   are one flat sheet, and above 0 where the second one turns to the side of the first one's normal. */

#define ANGLE_HALVINGS 20

/* Computes cosine and sine: of a small part first, which is then doubled. */
static kiriVec2 DirectionAt(double angle)
{
    KIRI_ASSERT(angle > -4.0 && angle < 4.0);
    double part = angle / (1 << ANGLE_HALVINGS);
    kiriVec2 at = { 1.0 - 0.5 * part * part, part };
    KIRI_TIMES(k, ANGLE_HALVINGS) {
        at = kiriVec2_Make(at.x * at.x - at.y * at.y, 2.0 * at.x * at.y);
    }
    return at;
}

/* Returns the angle between two vectors, 0 to pi. */
static double AngleBetween(kiriVec3 a, kiriVec3 b)
{
    kiriVec3 one = kiriVec3_Normalize(a), other = kiriVec3_Normalize(b);
    double cosine = 0.5 * kiriVec3_Length(kiriVec3_Add(one, other)), sine = 0.5 * kiriVec3_Distance(one, other);
    double times = 2.0;
    KIRI_TIMES(k, ANGLE_HALVINGS) { /* halves the angle */
        cosine = kiriRoot(0.5 * (1.0 + cosine));
        sine *= 0.5 / cosine;
        times *= 2.0;
    }
    return times * sine;
}

/* Returns a vector of the material (u, v, normal) as frames blend it. */
static kiriVec3 BlendedWay(const kiriSheetData* sheet, const kiriContactMember* members, int32_t count, kiriVec3 way)
{
    kiriVec3 sum = { 0.0, 0.0, 0.0 };
    KIRI_TIMES(n, count) {
        sum = kiriVec3_AddScaled(sum, members[n].value, kiriMat3_Mul(sheet->frames.data[members[n].frame].A, way));
    }
    return sum;
}

/* Returns the compliance of the material between the seam and the frames of a lip, rad/(N m) per m. */
static double GiveOf(const kiriSheetData* sheet, const kiriContactMember* members, int32_t count, kiriVec2 from,
                     kiriVec2 inward)
{
    const kiriMaterial* material = &sheet->settings.material;
    double thickness = material->thickness, nu = material->poissonsRatio, reach = 0.0;
    KIRI_TIMES(n, count) {
        kiriVec2 way = kiriVec2_Sub(sheet->frames.data[members[n].frame].center, from);
        reach += members[n].value * kiriVec2_Dot(way, inward);
    }
    return kiriMax(reach, thickness) * 12.0 * (1.0 - nu * nu) /
           (material->youngsModulus * thickness * thickness * thickness);
}

/* ---- Seams come and go ------------------------------------------------------------------------------------------- */

/* A line of the host at one end of a seam. */
typedef struct SeamLine {
    kiriSheetData* sheet;
    const float* points;
    int32_t count;
    double length;
} SeamLine;

static kiriVec2 LinePoint(const SeamLine* line, int32_t i)
{
    KIRI_ASSERT_HAS(*line, i);
    return kiriVec2_Load(&line->points[2 * i]);
}

static double LengthAfter(const SeamLine* line, int32_t i)
{
    return kiriVec2_Distance(LinePoint(line, i), LinePoint(line, i + 1));
}

static SeamLine MakeLine(const kiriWorld* world, kiriSheet sheet, const float* points, int32_t count)
{
    SeamLine line = { kiriPool_Find(&world->sheetIds, sheet)->owner, points, count, 0.0 };
    KIRI_TIMES(i, count - 1) {
        line.length += LengthAfter(&line, i);
    }
    return line;
}

/* Finds the point of the material at a length along the line. Tries points beside it if it is outside by rounding. */
static bool PlaceEnd(const SeamLine* line, double along, kiriStitchData* stitch, int end)
{
    static const int8_t sides[9][2] = { { 0, 0 }, { 1, 0 },  { -1, 0 }, { 0, 1 },  { 0, -1 },
                                        { 1, 1 }, { -1, 1 }, { 1, -1 }, { -1, -1 } };
    const kiriSheetData* sheet = line->sheet;
    int32_t i = 1, count = line->count;
    KIRI_ASSERT(count >= 2 && along >= 0.0);
    kiriVec2 from = LinePoint(line, 0), way = kiriVec2_Sub(LinePoint(line, 1), from);
    while (count > 2 && memcmp(&line->points[2 * count - 2], &line->points[2 * count - 4], 2 * sizeof(float)) == 0) {
        --count;
    }
    for (; i + 1 < count && (along > kiriVec2_Length(way) || !(kiriVec2_Length(way) > 0.0)); ++i) {
        along -= kiriVec2_Length(way);
        from = LinePoint(line, i);
        way = kiriVec2_Sub(LinePoint(line, i + 1), from);
    }
    double length = kiriVec2_Length(way);
    kiriVec2 point = kiriVec2_AddScaled(from, length > 0.0 ? kiriMin(along / length, 1.0) : 0.0, way);
    float rest[2];
    kiriVec2_Store(rest, point);
    kiriLatticePoint at;
    bool isFound = false;
    KIRI_TIMES_WHILE(!isFound && kiriSheet_ToLattice(sheet, rest, &at), k, 9) {
        stitch->at[end].x = at.x + NEAR * sides[k][0];
        stitch->at[end].y = at.y + NEAR * sides[k][1];
        isFound = FollowEnd(sheet, stitch, end);
    }
    if (isFound) { /* to the left of the line, if there is material */
        kiriVec2 left = kiriVec2_Scale(length > 0.0 ? 1.0 / length : 0.0, kiriVec2_Left(way));
        double far = 0.25 * sheet->mesh.squares.side;
        kiriLatticePoint beside = stitch->at[end];
        beside.x += (int32_t)(far * left.x);
        beside.y += (int32_t)(far * left.y);
        bool isLeft = kiriMesh_Locate(&sheet->mesh, beside) != KIRI_NONE;
        stitch->inward[end] = kiriVec2_Scale(isLeft ? 1.0 : -1.0, left);
    }
    return isFound;
}

/* Returns true if gravity bends the material less than from frame to frame. Such lips would hold each other straight.
   In softer material they meet where they are drawn. */
static bool IsStiff(const kiriSheetData* sheet)
{
    const kiriMaterial* material = &sheet->settings.material;
    double thickness = material->thickness, spacing = kiriSheet_Spacing(sheet);
    double bending = material->youngsModulus * thickness * thickness / 12.0;
    return bending > material->density * GRAVITY * spacing * spacing * spacing;
}

static const char* PlaceStitches(const SeamLine lines[2], kiriSeamData* seam)
{
    bool isClosed = true;
    KIRI_TIMES(end, 2) {
        const float *first = lines[end].points, *last = &first[2 * (lines[end].count - 1)];
        isClosed = isClosed && memcmp(first, last, 2 * sizeof(float)) == 0;
    }
    int32_t count = seam->stitches.count, parts = isClosed ? count : count - 1;
    KIRI_ASSERT(parts > 0);
    KIRI_EACH_INDEX(k, seam->stitches) {
        kiriStitchData* stitch = &seam->stitches.data[k];
        double part = (double)k / parts;
        bool isEnd = !isClosed && (k == 0 || k == parts);
        KIRI_CLEAR(stitch);
        stitch->number = k;
        stitch->next = k + 1 < count ? k + 1 : isClosed ? 0 : KIRI_NONE;
        stitch->share = isEnd ? 0.5 : 1.0;
        stitch->length = stitch->share / parts * 0.5 * (lines[0].length + lines[1].length);
        KIRI_TIMES(end, 2) {
            if (!PlaceEnd(&lines[end], part * lines[end].length, stitch, end)) {
                return end == 0 ? "def.lineA leaves the material" : "def.lineB leaves the material";
            }
        }
    }
    return NULL;
}

/* Places the corners of both lines that are between stitches. Those outside the material are left out. */
static void PlaceCorners(const SeamLine lines[2], kiriSeamData* seam)
{
    int32_t stitches = seam->stitches.count, next[2] = { 1, 1 };
    double last = 0.0, parts = seam->stitches.data[stitches - 1].next == KIRI_NONE ? stitches - 1 : stitches;
    double along[2] = { LengthAfter(&lines[0], 0) / lines[0].length, LengthAfter(&lines[1], 0) / lines[1].length };
    while (next[0] + 1 < lines[0].count || next[1] + 1 < lines[1].count) {
        int end = next[1] + 1 >= lines[1].count || (next[0] + 1 < lines[0].count && along[0] <= along[1]) ? 0 : 1;
        double at = along[end] * parts;
        kiriSeamCorner corner = { kiriMin((int32_t)at, (int32_t)parts - 1), 0.0, { { 0, 0 }, { 0, 0 } } };
        kiriStitchData place = { 0 };
        corner.part = at - corner.stitch;
        if (at > last + 1e-6 && corner.part > 1e-6 && corner.part < 1.0 - 1e-6 &&
            seam->corners.count < seam->corners.capacity &&
            PlaceEnd(&lines[0], along[end] * lines[0].length, &place, 0) &&
            PlaceEnd(&lines[1], along[end] * lines[1].length, &place, 1)) {
            memcpy(corner.at, place.at, sizeof(corner.at));
            KIRI_NEXT(seam->corners) = corner;
        }
        last = at;
        along[end] += LengthAfter(&lines[end], next[end]++) / lines[end].length;
    }
}

static void FreeSeam(kiriWorld* world, kiriSeamData* seam)
{
    kiriArray_Release(&world->memory, &seam->weld.nodes);
    kiriArray_Release(&world->memory, &seam->weld.vertices);
    kiriArray_Release(&world->memory, &seam->corners);
    kiriArray_Release(&world->memory, &seam->stitches);
    kiriArray_Release(&world->memory, &seam->rows);
    kiriMemory_Free(&world->memory, seam);
}

static void WakeSeam(const kiriWorld* world, const kiriSeamData* seam)
{
    KIRI_EACH(const kiriStitchData, stitch, seam->stitches) {
        WakeEnds(world, stitch);
    }
}

void kiriDefaultSeamDef(kiriSeamDef* def)
{
    if (def != NULL) {
        KIRI_CLEAR(def);
        def->cookie = KIRI_COOKIE(kiriSeamDef);
    }
}

kiriResult kiriCreateSeam(kiriWorld* world, const kiriSeamDef* def, kiriSeam* seam)
{
    KIRI_CHANGES(CreateSeam, def, seam);
    const SeamLine lines[2] = { MakeLine(world, def->sheetA, def->lineA, def->countA),
                                MakeLine(world, def->sheetB, def->lineB, def->countB) };
    kiriSheetData* const sheets[2] = { lines[0].sheet, lines[1].sheet };
    double length = kiriMin(lines[0].length, lines[1].length);
    double spacing = kiriMin(kiriSheet_Spacing(sheets[0]), kiriSheet_Spacing(sheets[1]));
    KIRI_CHECK(length > 0.0, "def.lineA or def.lineB has no length");
    KIRI_CHECK(!sheets[0]->settings.mechanics.planar && !sheets[1]->settings.mechanics.planar,
               "def names a planar sheet: it cannot be sewn");
    KIRI_CHECK(sheets[0]->settings.mechanics.model == sheets[1]->settings.mechanics.model,
               "def names sheets of different models");
    double wanted = kiriMin(1.5 + PER_SPACING * length / spacing, MOST_STITCHES);
    int32_t count = kiriMax(def->stitches > 0 ? def->stitches : (int32_t)wanted, 2);
    kiriResult result = kiriArray_ReserveMore(&world->memory, &world->seams, 1)
                            ? kiriWorld_ReserveIds(world, &world->seamIds, 1)
                            : KIRI_ERROR_MEMORY;
    kiriSeamData* made = result == KIRI_OK ? kiriMemory_AllocZeroed(&world->memory, sizeof(*made)) : NULL;
    KIRI_REQUIRE(made != NULL, result != KIRI_OK ? result : KIRI_ERROR_MEMORY, NULL);
    bool hasRoom = kiriArray_ResizeJust(&world->memory, &made->stitches, count) &&
                   kiriArray_ReserveJust(&world->memory, &made->rows, count);
    hasRoom = hasRoom && kiriArray_ReserveJust(&world->memory, &made->corners,
                                               kiriMin(def->countA + def->countB - 4, MOST_LINE_CORNERS));
    const char* why = hasRoom ? PlaceStitches(lines, made) : NULL;
    if (hasRoom && why == NULL) {
        PlaceCorners(lines, made);
        hasRoom = kiriWeld_Make(world, made);
    }
    KIRI_TIMES_WHILE(hasRoom, end, 2) { /* the offsets of drawn lips */
        hasRoom = kiriSurface_ReserveHeld(&sheets[end]->seen.surface, &sheets[end]->shown);
    }
    if (!hasRoom || why != NULL) {
        FreeSeam(world, made);
        return KIRI_FAIL(hasRoom ? KIRI_ERROR_ARGUMENT : KIRI_ERROR_MEMORY, why);
    }
    made->breakForce = def->breakForce;
    made->bending = def->stiffness;
    made->restAngle = def->restAngle;
    made->bends = IsStiff(sheets[0]) || IsStiff(sheets[1]);
    KIRI_TIMES(end, 2) {
        kiriSurface* surface = &sheets[end]->seen.surface;
        kiriSurface_SetDetail(surface, surface->detail.sweeps, true);
    }
    made->id = kiriPool_Add(&world->seamIds, made, 0);
    KIRI_NEXT(world->seams) = made;
    WakeSeam(world, made);
    *seam = made->id;
    KIRI_RETURN(KIRI_OK);
}

kiriResult kiriSeam_SetHinge(kiriWorld* world, kiriSeam seam, float stiffness, float restAngle)
{
    KIRI_CHANGES(Seam_SetHinge, &seam, &stiffness, &restAngle);
    kiriSeamData* data = call->owner;
    if (data->bending != stiffness || data->restAngle != restAngle) {
        data->bending = stiffness;
        data->restAngle = restAngle;
        WakeSeam(world, data);
    }
    KIRI_RETURN(KIRI_OK);
}

static void RemoveSeam(kiriWorld* world, kiriSeamData* seam)
{
    WakeSeam(world, seam);
    KIRI_KEEP_IF(kiriSeamData*, item, world->seams, *item != seam);
    kiriPool_Remove(&world->seamIds, seam->id);
    FreeSeam(world, seam);
}

kiriResult kiriDestroySeam(kiriWorld* world, kiriSeam seam)
{
    KIRI_CHANGES(DestroySeam, &seam);
    RemoveSeam(world, call->owner);
    KIRI_RETURN(KIRI_OK);
}

/* Returns the force on a stretch of a seam for its length, N/m: of a stitch and those beside it. Stitches pull against each
   other where lips have other frames; the sum has the load alone. */
static double LoadOf(const kiriStitchData* before, const kiriStitchData* stitch, const kiriStitchData* after)
{
    kiriVec3 force = stitch->force;
    double length = stitch->length;
    if (before != NULL && before->next == stitch->number) {
        force = kiriVec3_Add(force, before->force);
        length += before->length;
    }
    if (after != NULL && stitch->next == after->number) {
        force = kiriVec3_Add(force, after->force);
        length += after->length;
    }
    return kiriVec3_Length(force) / length;
}

/* Removes a stitch if one of its sheets is gone, or if its load is above the limit. Wakes the pieces of removed stitches.
   Returns their number. */
static int32_t DropStitches(const kiriWorld* world, kiriSeamData* seam, double limit)
{
    int32_t kept = 0, count = seam->stitches.count;
    kiriStitchData *all = seam->stitches.data, before = count > 0 ? all[count - 1] : (kiriStitchData){ 0 };
    KIRI_ASSERT(seam->rows.count == 0 || seam->rows.count == count);
    const kiriStitchData first = count > 0 ? all[0] : before;
    KIRI_EACH_INDEX(k, seam->stitches) {
        const kiriStitchData stitch = all[k];
        if (SlotOf(world, &stitch, 0) == NULL || SlotOf(world, &stitch, 1) == NULL ||
            LoadOf(&before, &stitch, k + 1 < count ? &all[k + 1] : &first) > limit) {
            WakeEnds(world, &stitch);
        } else {
            all[kept++] = stitch;
        }
        before = stitch;
    }
    seam->stitches.count = kept;
    seam->rows.count = 0;
    return count - kept;
}

void kiriSeams_DropStale(kiriWorld* world)
{
    KIRI_EACH_INDEX_BACK(i, world->seams) {
        kiriSeamData* seam = world->seams.data[i];
        if (DropStitches(world, seam, HUGE_VAL) > 0 && seam->stitches.count == 0) {
            RemoveSeam(world, seam);
        }
    }
}

/* ---- In a tick --------------------------------------------------------------------------------------------------- */

bool kiriSeams_ListLines(kiriWorld* world)
{
    bool ok = true;
    KIRI_EACH_OF(kiriSheetData, sheet, world->sheets) {
        sheet->sewn.count = 0;
    }
    KIRI_EACH_OF(kiriSeamData, seam, world->seams) {
        KIRI_TIMES_WHILE(ok, k, 2 * seam->stitches.count) {
            const kiriStitchData *all = seam->stitches.data, *from = &all[k / 2];
            const kiriStitchData* to = k / 2 + 1 < seam->stitches.count ? from + 1 : all;
            kiriSheetData* sheet = kiriStitch_Sheet(world, from, k % 2);
            kiriSewnLine line = { seam->id, from->at[k % 2], to->at[k % 2] };
            bool isWhole = from->next == to->number && kiriStitch_Sheet(world, to, k % 2) == sheet;
            KIRI_EACH_WHILE(ok && isWhole, const kiriSeamCorner, corner, seam->corners) {
                if (corner->stitch == from->number) {
                    line.to = corner->at[k % 2];
                    ok = kiriArray_Push(sheet->memory, &sheet->sewn, line);
                    line.from = line.to;
                }
            }
            line.to = to->at[k % 2];
            ok = ok && (!isWhole || kiriArray_Push(sheet->memory, &sheet->sewn, line));
        }
    }
    return ok;
}

bool kiriSeams_Stir(const kiriWorld* world)
{
    bool any = false;
    for (bool isNew = true; isNew;) { /* pieces may be sewn in a row */
        isNew = false;
        KIRI_EACH_OF(kiriSeamData, seam, world->seams) {
            KIRI_EACH(const kiriStitchData, stitch, seam->stitches) {
                const kiriSlot *a = SlotOf(world, stitch, 0), *b = SlotOf(world, stitch, 1);
                kiriPiece *one = kiriSheet_PieceOf(a->owner, a->index), *other = kiriSheet_PieceOf(b->owner, b->index);
                if (kiriPiece_MayMove(one) != kiriPiece_MayMove(other)) {
                    kiriSheetData* asleep = kiriPiece_MayMove(one) ? b->owner : a->owner;
                    (kiriPiece_MayMove(one) ? other : one)->rest.isStirred = asleep->rest.isStirred = isNew = true;
                }
            }
        }
        any |= isNew;
    }
    return any;
}

kiriVec3 kiriStitch_Point(const kiriWorld* world, const kiriSeamData* seam, int32_t stitch, int end)
{
    kiriContactMember members[KIRI_STITCH_SIDE];
    KIRI_ASSERT_HAS(seam->stitches, stitch);
    const kiriSheetData* sheet = kiriStitch_Sheet(world, &seam->stitches.data[stitch], end);
    return kiriSheet_CarriedPoint(sheet, members, CarryEnd(sheet, &seam->stitches.data[stitch], end, seam->bends, members));
}

/* Finds the vectors of both materials that a hinge keeps alike: of the first one, turned by an angle, and of the second
   one. */
static void FindWays(const kiriStitchData* stitch, double angle, kiriVec3 ways[2])
{
    kiriVec2 turn = DirectionAt(angle);
    ways[0] = kiriVec3_Make(-turn.x * stitch->inward[0].x, -turn.x * stitch->inward[0].y, turn.y);
    ways[1] = kiriVec3_Make(stitch->inward[1].x, stitch->inward[1].y, 0.0);
}

double kiriStitch_Angle(const kiriWorld* world, const kiriSeamData* seam, int32_t stitch)
{
    const kiriStitchData* data = &seam->stitches.data[stitch];
    kiriVec3 ways[3], seen[2], normal = { 0.0, 0.0, 0.0 };
    KIRI_ASSERT_HAS(seam->stitches, stitch);
    FindWays(data, 0.0, ways);
    KIRI_TIMES(end, 2) {
        kiriContactMember members[KIRI_STITCH_SIDE];
        const kiriSheetData* sheet = kiriStitch_Sheet(world, data, end);
        int32_t count = CarryEnd(sheet, data, end, seam->bends, members);
        seen[end] = BlendedWay(sheet, members, count, ways[end]);
        normal = end == 0 ? BlendedWay(sheet, members, count, kiriVec3_Make(0.0, 0.0, 1.0)) : normal;
    }
    double angle = AngleBetween(seen[0], seen[1]);
    KIRI_ASSERT(angle >= 0.0 && angle < 3.2);
    return kiriVec3_Dot(normal, seen[1]) >= 0.0 ? angle : -angle;
}

#define LEAST_SINE 0.1 /* a hinge that is more than 3 rad off its rest angle pulls no harder */

bool kiriSeam_WriteRow(const kiriWorld* world, kiriSeamData* seam, int32_t stitch, double dt, kiriSheetData* sheets[2])
{
    KIRI_ASSERT_HAS(seam->stitches, stitch);
    const kiriStitchData* data = &seam->stitches.data[stitch];
    kiriStitchRow* row = &seam->rows.data[stitch];
    kiriVec3 apart = { 0 }, seen[2];
    double mass = 0.0, stiffness = 0.0, give = 0.0;
    KIRI_ASSERT(seam->rows.capacity >= seam->stitches.count);
    KIRI_CLEAR(row);
    FindWays(data, seam->restAngle, row->ways);
    KIRI_TIMES(end, 2) {
        kiriSheetData* sheet = kiriStitch_Sheet(world, data, end);
        kiriContactMember members[KIRI_STITCH_SIDE];
        int32_t count = CarryEnd(sheet, data, end, seam->bends, members);
        if (count == 0) {
            return false;
        }
        bool isMoved = world->islands.isJoined.data[sheet->probes.sheet] && !sheet->rest.asleep &&
                       kiriSheet_Moves(sheet, members[0].frame);
        kiriVec3 x = kiriVec3_Scale(end == 0 ? 1.0 : -1.0, kiriSheet_CarriedPoint(sheet, members, count));
        apart = kiriVec3_Add(apart, x);
        const kiriMaterial* material = &sheet->settings.material;
        stiffness = kiriMax((double)material->youngsModulus * material->thickness, stiffness);
        mass = kiriMax(sheet->frames.data[members[0].frame].mass, mass);
        seen[end] = BlendedWay(sheet, members, count, row->ways[end]);
        give += GiveOf(sheet, members, count, kiriMesh_Local(&sheet->mesh, data->at[end]), data->inward[end]);
        sheets[end] = isMoved ? sheet : NULL;
        row->solvers[end] = isMoved ? sheet->solver : NULL;
        row->counts[end] = isMoved ? count : 0;
        row->off = isMoved ? row->off : kiriVec3_Sub(row->off, x);
        KIRI_TIMES_WHILE(isMoved, n, count) {
            kiriContactMember* member = &row->members[end * row->counts[0] + n];
            *member = members[n];
            member->value = end == 0 ? member->value : -member->value;
        }
    }
    row->stiffness = data->share * kiriMin((seam->bends ? STIFF_PITCH : SQUARED_PITCH) * mass, STITCH_STIFFNESS * stiffness);
    if (seam->bending > 0.0 && row->solvers[0] != NULL && row->solvers[1] != NULL) {
        double off = AngleBetween(seen[0], seen[1]), sine = DirectionAt(off).y;
        double linear = off > 1e-3 ? off / kiriMax(sine, LEAST_SINE) : 1.0; /* the spring pulls with the sine */
        row->bending = linear * data->length / (1.0 / seam->bending + give);
    }
    KIRI_ASSERT(row->stiffness > 0.0 && row->bending >= 0.0);
    double gap = kiriVec3_Length(apart), closed = CLOSING_SPEED * dt;
    row->off = kiriVec3_AddScaled(row->off, gap > closed ? 1.0 - closed / gap : 0.0, apart);
    return row->solvers[0] != NULL || row->solvers[1] != NULL;
}

void kiriSeams_End(kiriWorld* world, double dt)
{
    KIRI_EACH_INDEX_BACK(i, world->seams) {
        kiriSeamData* seam = world->seams.data[i];
        KIRI_ASSERT(seam->stitches.count > 0 && seam->rows.count <= seam->stitches.count);
        KIRI_EACH_INDEX(k, seam->rows) {
            const kiriStitchRow* row = &seam->rows.data[k];
            const kiriSheetData* moved = kiriStitch_Sheet(world, &seam->stitches.data[k], row->solvers[0] == NULL);
            if (row->body != KIRI_NONE && world->moves.of.data[moved->probes.sheet].progress == KIRI_DONE) {
                seam->stitches.data[k].force = kiriVec3_Scale(1.0 / dt, row->impulse);
            }
        }
        seam->rows.count = 0;
        const kiriSheetData* sheet = kiriStitch_Sheet(world, &seam->stitches.data[0], 0);
        if (seam->breakForce > 0.0 && DropStitches(world, seam, seam->breakForce) > 0) {
            kiriEvent* event = kiriWorld_AddEvent(world, KIRI_EVENT_SEAM_BROKE, sheet);
            event->seam = seam->id;
            event->stitches = seam->stitches.count;
            if (seam->stitches.count == 0) {
                RemoveSeam(world, seam);
            }
        }
    }
}

/* ---- Welds: drawn lips ------------------------------------------------------------------------------------------- */

/* Stitches hold points that frames carry. Drawn lips differ by millimetres: patches of a smooth skin bend, and weights are
   not linear between stitches. So the drawn surface gets an offset (kiriDetail): vertices of both lips are drawn at one
   point, and the offset fades over a distance of frames. Motion, contacts and blades do not see it. */

/* ---- Stretches --------------------------------------------------------------------------------------------------- */

/* The part of a seam from a stitch to the next one, in one piece at each end. */
typedef struct Stretch {
    kiriSheetData* sheets[2];
    int32_t frames[2], pieces[2];
    const kiriStitchData *from, *to;
} Stretch;

static bool FindStretch(const kiriWorld* world, const kiriSeamData* seam, int32_t k, Stretch* stretch)
{
    const kiriStitchData* all = seam->stitches.data;
    KIRI_ASSERT_HAS(seam->stitches, k);
    *stretch = (Stretch){ .from = &all[k], .to = k + 1 < seam->stitches.count ? &all[k + 1] : &all[0] };
    bool isWhole = stretch->from->next == stretch->to->number;
    KIRI_TIMES_WHILE(isWhole, end, 2) {
        const kiriSlot *a = SlotOf(world, stretch->from, end), *b = SlotOf(world, stretch->to, end);
        const int32_t* pieces = ((const kiriSheetData*)a->owner)->layout.framePiece.data;
        stretch->sheets[end] = a->owner;
        stretch->frames[end] = a->index;
        stretch->pieces[end] = pieces[a->index];
        isWhole = a->owner == b->owner && pieces[a->index] == pieces[b->index];
    }
    return isWhole;
}

/* Corners of the lines are knots of a stretch, as its stitches are. */
typedef struct Knot {
    double part; /* of the stretch */
    const kiriLatticePoint* at;
} Knot;

/* Returns the next knot. *corner: index of the next corner to look at; 0 at first. */
static Knot NextKnot(const kiriSeamData* seam, const Stretch* stretch, int32_t* corner)
{
    for (; *corner < seam->corners.count; ++*corner) {
        const kiriSeamCorner* at = &seam->corners.data[*corner];
        if (at->stitch == stretch->from->number) {
            ++*corner;
            return (Knot){ at->part, at->at };
        }
    }
    return (Knot){ 1.0, stretch->to->at };
}

/* ---- Nodes ------------------------------------------------------------------------------------------------------- */

/* Adds a node in the order of the line, with a vertex of a lip, unless it is there. KIRI_NONE: none. */
static void AddWeldNode(kiriWeld* weld, const Stretch* stretch, int32_t first, double part, int end, int32_t vertex)
{
    kiriWeldNode node = { .part = part, .open = HUGE_VAL, .vertices = { { -1, -1, -1 }, { -1, -1, -1 } } };
    bool isNew = weld->nodes.count < weld->nodes.capacity;
    KIRI_ASSERT(part >= 0.0 && part <= 1.0 && first <= weld->nodes.count);
    KIRI_FROM_TO(n, first, weld->nodes.count) {
        const kiriWeldNode* other = &weld->nodes.data[n];
        isNew = isNew && !(other->isVertex[end] && other->vertices[end][0] == vertex);
    }
    KIRI_TIMES(k, 2) {
        node.sheets[k] = stretch->sheets[k];
        node.frames[k] = stretch->frames[k];
        node.open = kiriMin(WELD_OPEN * kiriSheet_Spacing(stretch->sheets[k]), node.open);
    }
    node.isVertex[end] = vertex != KIRI_NONE;
    node.vertices[end][0] = vertex;
    node.shares[end][0] = 1.0;
    if (isNew) {
        int32_t n = weld->nodes.count++;
        for (; n > first && weld->nodes.data[n - 1].part > part; --n) {
            weld->nodes.data[n] = weld->nodes.data[n - 1];
        }
        weld->nodes.data[n] = node;
    }
}

/* Adds the vertices on the line between two knots. */
static void AddLipVertices(kiriWeld* weld, const Stretch* stretch, int32_t first, Knot a, Knot b, int end)
{
    const kiriSheetData* sheet = stretch->sheets[end];
    const kiriMeshData* mesh = &sheet->mesh;
    kiriVec2 from = kiriMesh_Local(mesh, a.at[end]), to = kiriMesh_Local(mesh, b.at[end]);
    kiriNearby nearby = kiriNearby_Begin(&mesh->squares, a.at[end], b.at[end], ON_SEAM);
    KIRI_EACH_NEARBY(t, nearby) {
        KIRI_EACH_CORNER(k) {
            int32_t v = mesh->triangles.data[t].vertex[k];
            kiriVec2 p = kiriMesh_LocalOf(mesh, v);
            if (kiriVec2_DistanceToWay(p, from, to) < ON_SEAM * mesh->step &&
                kiriPiece_OfVertex(sheet, v) == stretch->pieces[end]) {
                AddWeldNode(weld, stretch, first, a.part + (b.part - a.part) * kiriVec2_PartOnWay(p, from, to), end, v);
            }
        }
    }
}

/* Joins nodes at the same part of the line: of one lip, of the other, and of a stitch. Where a cut crosses the seam, lips
   have two vertices there, which go apart: then the node is dropped. Returns the number of nodes. */
static int32_t JoinWeldNodes(kiriWeldNode* nodes, int32_t count, double least)
{
    int32_t kept = 0;
    for (int32_t n = 0, next; n < count; n = next) {
        kiriWeldNode joined = nodes[n];
        bool isCut = false;
        for (next = n + 1; next < count && nodes[next].part - nodes[n].part < least; ++next) {
            KIRI_TIMES(end, 2) {
                isCut |= joined.isVertex[end] && nodes[next].isVertex[end];
                if (nodes[next].isVertex[end]) {
                    joined.isVertex[end] = true;
                    memcpy(joined.vertices[end], nodes[next].vertices[end], sizeof(joined.vertices[end]));
                    memcpy(joined.shares[end], nodes[next].shares[end], sizeof(joined.shares[end]));
                }
            }
        }
        if (!isCut) {
            nodes[kept++] = joined;
        }
    }
    return kept;
}

/* Finds the triangle of a lip that has no vertex there. Returns false outside the material. */
static bool PlaceWeldNode(const kiriSeamData* seam, const Stretch* stretch, int end, kiriWeldNode* node)
{
    const kiriSheetData* sheet = stretch->sheets[end];
    int32_t corner = 0, triangle = KIRI_NONE;
    KIRI_ASSERT(node->part >= 0.0 && node->part <= 1.0 && !node->isVertex[end]);
    Knot a = { 0.0, stretch->from->at }, b = NextKnot(seam, stretch, &corner);
    while (b.part < node->part) {
        a = b;
        b = NextKnot(seam, stretch, &corner);
    }
    double share = b.part > a.part ? (node->part - a.part) / (b.part - a.part) : 0.0;
    kiriVec2 inward = stretch->from->inward[end];
    kiriLatticePoint at = { 0, 0 };
    KIRI_TIMES_WHILE(triangle == KIRI_NONE, k, 3) {
        at.x = (int32_t)(a.at[end].x + share * ((double)b.at[end].x - a.at[end].x) + k * INTO_SHEET * inward.x);
        at.y = (int32_t)(a.at[end].y + share * ((double)b.at[end].y - a.at[end].y) + k * INTO_SHEET * inward.y);
        triangle = kiriMesh_Locate(&sheet->mesh, at);
    }
    if (triangle == KIRI_NONE || kiriPiece_OfTriangle(sheet, triangle) != stretch->pieces[end]) {
        return false;
    }
    memcpy(node->vertices[end], sheet->mesh.triangles.data[triangle].vertex, sizeof(node->vertices[end]));
    kiriMesh_Shares(&sheet->mesh, triangle, at, node->shares[end]);
    return true;
}

/* Lists the nodes of a stretch: its ends, and all vertices on both lips. */
static void ListWeldNodes(const kiriSeamData* seam, kiriWeld* weld, const Stretch* stretch)
{
    int32_t first = weld->nodes.count;
    double size = 0.0;
    AddWeldNode(weld, stretch, first, 0.0, 0, KIRI_NONE);
    KIRI_TIMES(end, 2) {
        int32_t corner = 0;
        for (Knot a = { 0.0, stretch->from->at }, b; a.part < 1.0; a = b) {
            b = NextKnot(seam, stretch, &corner);
            AddLipVertices(weld, stretch, first, a, b, end);
        }
        size = kiriMax(stretch->sheets[end]->mesh.step, size);
    }
    AddWeldNode(weld, stretch, first, 1.0, 0, KIRI_NONE);
    kiriWeldNode* nodes = weld->nodes.data + first;
    int32_t count = JoinWeldNodes(nodes, weld->nodes.count - first, 2.0 * ON_SEAM * size / stretch->from->length), kept = 0;
    KIRI_TIMES(n, count) {
        bool isThere = true;
        KIRI_TIMES_WHILE(isThere, end, 2) {
            isThere = nodes[n].isVertex[end] || PlaceWeldNode(seam, stretch, end, &nodes[n]);
        }
        if (isThere) {
            nodes[kept++] = nodes[n];
        }
    }
    KIRI_ASSERT(kept <= count);
    weld->nodes.count = first + kept;
}

/* ---- Vertices ---------------------------------------------------------------------------------------------------- */

/* Takes the line between two knots for the vertices that are nearer to it than to those before. */
static void TakeNear(kiriWeldNear* near, const kiriWeld* weld, const Stretch* stretch, int32_t first, Knot a, Knot b,
                     int end, double reach)
{
    const kiriSheetData* sheet = stretch->sheets[end];
    const kiriMeshData* mesh = &sheet->mesh;
    kiriVec2 from = kiriMesh_Local(mesh, a.at[end]), to = kiriMesh_Local(mesh, b.at[end]);
    kiriNearby nearby = kiriNearby_Begin(&mesh->squares, a.at[end], b.at[end], reach / mesh->step);
    KIRI_EACH_NEARBY(t, nearby) {
        KIRI_EACH_CORNER(k) {
            int32_t v = mesh->triangles.data[t].vertex[k];
            kiriVec2 p = kiriMesh_LocalOf(mesh, v);
            float distance = (float)(kiriVec2_DistanceToWay(p, from, to) / reach);
            if (distance < near[v].distance && kiriPiece_OfVertex(sheet, v) == stretch->pieces[end]) {
                double part = a.part + (b.part - a.part) * kiriVec2_PartOnWay(p, from, to);
                int32_t n = first;
                KIRI_ASSERT_HAS(weld->nodes, first);
                while (n + 1 < weld->nodes.count && weld->nodes.data[n + 1].part > weld->nodes.data[n].part &&
                       weld->nodes.data[n + 1].part <= part) {
                    ++n;
                }
                bool isLast = n + 1 == weld->nodes.count || weld->nodes.data[n + 1].part <= weld->nodes.data[n].part;
                double width = isLast ? 0.0 : weld->nodes.data[n + 1].part - weld->nodes.data[n].part;
                double share = width > 0.0 ? (part - weld->nodes.data[n].part) / width : 0.0;
                near[v] = (kiriWeldNear){ distance, n, (float)kiriClamp(share, 0.0, 1.0) };
            }
        }
    }
}

/* Lists the vertices of a sheet that one lip moves: those on it with the nodes, the others by their distance. */
static void ListLipVertices(kiriWorld* world, const kiriSeamData* seam, kiriWeld* weld, const kiriSheetData* sheet, int end)
{
    kiriWeldNear* near = world->weldNear.data;
    double reach = WELD_REACH * kiriSheet_Spacing(sheet);
    KIRI_ASSERT(sheet->mesh.vertices.count <= world->weldNear.capacity);
    KIRI_EACH_INDEX(v, sheet->mesh.vertices) {
        near[v] = (kiriWeldNear){ 1.0f, KIRI_NONE, 0.0f };
    }
    int32_t first = 0;
    KIRI_EACH_INDEX(k, seam->stitches) {
        Stretch stretch;
        bool isWhole = FindStretch(world, seam, k, &stretch);
        while (first < weld->nodes.count && weld->nodes.data[first].stretch < k) {
            ++first;
        }
        if (isWhole && stretch.sheets[end] == sheet && first < weld->nodes.count && weld->nodes.data[first].stretch == k) {
            int32_t corner = 0;
            for (Knot a = { 0.0, stretch.from->at }, b; a.part < 1.0; a = b) {
                b = NextKnot(seam, &stretch, &corner);
                TakeNear(near, weld, &stretch, first, a, b, end, reach);
            }
        }
    }
    KIRI_EACH_INDEX(n, weld->nodes) {
        const kiriWeldNode* node = &weld->nodes.data[n];
        if (node->isVertex[end] && node->sheets[end] == sheet && near[node->vertices[end][0]].distance >= 0.0f) {
            near[node->vertices[end][0]] = (kiriWeldNear){ -1.0f, n, 0.0f };
        }
    }
    KIRI_EACH_INDEX(v, sheet->mesh.vertices) {
        if (near[v].node != KIRI_NONE && weld->vertices.count < weld->vertices.capacity) {
            float left = 1.0f - kiriMax(near[v].distance, 0.0f);
            KIRI_NEXT(weld->vertices) = (kiriWeldVertex){ v, near[v].node, end, near[v].share, left * left };
        }
    }
}

/* ---- Lists ------------------------------------------------------------------------------------------------------- */

static int64_t CountSewnVertices(const kiriWorld* world, const kiriSeamData* seam, int32_t* most)
{
    int64_t sum = 0;
    KIRI_TIMES(k, 2 * seam->stitches.count) {
        const kiriSheetData* sheet = kiriStitch_Sheet(world, &seam->stitches.data[k / 2], k % 2);
        if (k < 2 || sheet != kiriStitch_Sheet(world, &seam->stitches.data[k / 2 - 1], k % 2)) {
            sum += sheet->mesh.vertices.count;
            *most = kiriMax(sheet->mesh.vertices.count, *most);
        }
    }
    return sum;
}

/* Returns a hash of the stitches and meshes: the lists follow from them. */
static uint64_t KeyOfWeld(const kiriWorld* world, const kiriSeamData* seam)
{
    uint64_t key = KIRI_HASH_START;
    KIRI_EACH(const kiriStitchData, stitch, seam->stitches) {
        kiriHash_Int32(&key, stitch->number);
        KIRI_TIMES(end, 2) {
            const kiriSheetData* sheet = SlotOf(world, stitch, end)->owner;
            kiriHash_Word(&key, stitch->frames[end]);
            kiriHash_Word(&key, sheet->id);
            kiriHash_Word(&key, sheet->mesh.revision);
            kiriHash_Int32(&key, sheet->layout.pieces.count);
        }
    }
    return key;
}

static void ListWeld(kiriWorld* world, kiriSeamData* seam)
{
    kiriWeld* weld = &seam->weld;
    int32_t most = 0;
    weld->nodes.count = weld->vertices.count = 0;
    KIRI_EACH_INDEX(k, seam->stitches) {
        Stretch stretch;
        int32_t first = weld->nodes.count;
        if (FindStretch(world, seam, k, &stretch)) {
            ListWeldNodes(seam, weld, &stretch);
        }
        KIRI_FROM_TO(n, first, weld->nodes.count) {
            weld->nodes.data[n].stretch = k;
        }
    }
    KIRI_TIMES(k, 2 * seam->stitches.count) {
        const kiriSheetData* sheet = kiriStitch_Sheet(world, &seam->stitches.data[k / 2], k % 2);
        bool isFirst = true;
        KIRI_TIMES_WHILE(isFirst, back, k / 2) { /* the last one first: it mostly has the same sheet */
            isFirst = kiriStitch_Sheet(world, &seam->stitches.data[k / 2 - 1 - back], k % 2) != sheet;
        }
        if (isFirst) {
            ListLipVertices(world, seam, weld, sheet, k % 2);
        }
    }
    weld->vertexCount = CountSewnVertices(world, seam, &most);
    weld->key = KeyOfWeld(world, seam);
}

static bool ReserveWeld(kiriWorld* world, kiriSeamData* seam)
{
    kiriWeld* weld = &seam->weld;
    int32_t most = 0;
    int64_t vertices = CountSewnVertices(world, seam, &most);
    int64_t nodes = 2 * weld->nodes.count + 4 * seam->stitches.count + 2 * kiriMax(vertices - weld->vertexCount, (int64_t)0);
    return kiriArray_Reserve(&world->memory, &weld->nodes, nodes) &&
           kiriArray_Reserve(&world->memory, &weld->vertices, vertices) &&
           kiriArray_Reserve(&world->memory, &world->weldNear, most);
}

bool kiriWeld_Make(kiriWorld* world, kiriSeamData* seam)
{
    bool hasRoom = ReserveWeld(world, seam);
    if (hasRoom) {
        ListWeld(world, seam);
        kiriArray_Shorten(&world->memory, &seam->weld.nodes, sizeof(*seam->weld.nodes.data));
    }
    return hasRoom;
}

bool kiriWelds_Reserve(kiriWorld* world)
{
    bool ok = true;
    KIRI_EACH_OF_WHILE(ok, kiriSeamData, seam, world->seams) {
        ok = ReserveWeld(world, seam);
    }
    return ok;
}

/* ---- In a tick --------------------------------------------------------------------------------------------------- */

/* Lists the lips again if they are stale, and finds the ends that move: pieces that this tick draws. Returns false if none
   moves. */
static bool BeginWeld(kiriWorld* world, kiriSeamData* seam)
{
    bool isStale = KeyOfWeld(world, seam) != seam->weld.key, any = false;
    KIRI_TIMES_WHILE(!isStale, k, 2 * seam->stitches.count) {
        isStale = kiriStitch_Sheet(world, &seam->stitches.data[k / 2], k % 2)->seen.isElsewhere;
    }
    if (isStale) {
        ListWeld(world, seam);
    }
    KIRI_EACH(kiriWeldNode, node, seam->weld.nodes) {
        bool moves[2];
        KIRI_TIMES(end, 2) {
            const kiriSheetData* sheet = node->sheets[end];
            moves[end] = !sheet->rest.asleep && !sheet->seen.surface.isWritten &&
                         kiriSheet_Moves(sheet, node->frames[end]) && !world->moves.of.data[sheet->probes.sheet].isStill;
        }
        node->moves[0] = moves[0] ? (moves[1] ? -0.5 : -1.0) : 0.0;
        node->moves[1] = moves[1] ? (moves[0] ? 0.5 : 1.0) : 0.0;
        any |= moves[0] || moves[1];
    }
    return any;
}

/* Computes how far the drawn ends of a node are from where they should be to each other. */
static void MeasureWeldNode(kiriWeldNode* node)
{
    kiriVec3 skin = { 0.0, 0.0, 0.0 }, offset = skin;
    KIRI_TIMES(end, 2) {
        const kiriSurface* surface = &node->sheets[end]->seen.surface;
        double sign = end == 0 ? 1.0 : -1.0;
        skin = kiriVec3_AddScaled(skin, sign, surface->middle);
        for (int k = 0; k < 3 && node->vertices[end][k] != KIRI_NONE; ++k) {
            double share = sign * node->shares[end][k];
            skin = kiriVec3_AddScaled(skin, share, kiriVec3_Load(kiriSurface_Places(surface) + 3 * node->vertices[end][k]));
            offset = kiriVec3_AddScaled(offset, share, kiriVec3_Load(surface->detail.offsets.data + 3 * node->vertices[end][k]));
        }
    }
    /* Lips that come nearer than twice WELD_OPEN close ahead of the skin, so that no drawn lip jumps. */
    double gap = kiriVec3_Length(skin), closed = kiriClamp(2.0 - gap / node->open, 0.0, 1.0);
    node->missing = closed >= 0.0 ? kiriVec3_AddScaled(offset, closed, skin) : (kiriVec3){ 0.0, 0.0, 0.0 };
}

static void MoveOffset(const kiriSheetData* sheet, int32_t vertex, kiriVec3 by)
{
    KIRI_ASSERT(vertex >= 0 && 3 * vertex < sheet->seen.surface.detail.offsets.count);
    float* offset = sheet->seen.surface.detail.offsets.data + 3 * vertex;
    kiriVec3_Store(offset, kiriVec3_Add(kiriVec3_Load(offset), by));
}

/* Moves the lips of a seam, and the vertices beside them. */
static void MoveLips(const kiriWeld* weld)
{
    KIRI_EACH(const kiriWeldVertex, at, weld->vertices) {
        const kiriWeldNode *from = &weld->nodes.data[at->node], *to = at->share > 0.0f ? from + 1 : from;
        double share = at->share, moves = from->moves[at->end] * at->weight;
        KIRI_ASSERT(at->node >= 0 && at->node + (at->share > 0.0f) < weld->nodes.count);
        if (moves != 0.0) {
            kiriVec3 by = kiriVec3_Add(kiriVec3_Scale((1.0 - share) * moves, from->missing),
                                       kiriVec3_Scale(share * moves, to->missing));
            MoveOffset(from->sheets[at->end], at->vertex, by);
        }
    }
}

/* Moves lips: with the vertices beside them, or alone. Returns how far they were apart, relative to the sheet. */
static double CloseLips(const kiriWorld* world, bool spreads)
{
    double worst = 0.0;
    KIRI_EACH_OF(kiriSeamData, seam, world->seams) {
        double most = 0.0;
        KIRI_EACH_WHILE(seam->weld.isDrawn, kiriWeldNode, node, seam->weld.nodes) {
            bool hasVertex = node->isVertex[0] || node->isVertex[1];
            MeasureWeldNode(node);
            double apart = kiriVec3_Length(node->missing) / node->sheets[0]->seen.surface.longer;
            most = node->moves[0] != node->moves[1] && (hasVertex || spreads) ? kiriMax(apart, most) : most;
            KIRI_TIMES_WHILE(!spreads, end, 2) { /* a vertex on an edge of the other lip goes there */
                double moves = node->moves[end], way = moves > 0.0 ? 1.0 : -1.0;
                if (node->isVertex[end] && moves != 0.0) {
                    kiriVec3 by = kiriVec3_Scale(node->isVertex[1 - end] ? moves : way, node->missing);
                    MoveOffset(node->sheets[end], node->vertices[end][0], by);
                }
            }
        }
        if (spreads && most > WELD_CLOSED) {
            MoveLips(&seam->weld);
        }
        worst = kiriMax(most, worst);
    }
    return worst;
}

/* Where seams meet, a lip of one is moved by the others: rounds over all seams bring them to one point. */
void kiriWelds_Close(kiriWorld* world)
{
    double apart = 0.0;
    KIRI_EACH_OF(kiriSeamData, seam, world->seams) {
        seam->weld.isDrawn = BeginWeld(world, seam);
        apart = seam->weld.isDrawn ? 1.0 : apart;
    }
    for (int round = 0; round < WELD_ROUNDS && apart > WELD_CLOSED; ++round) {
        apart = CloseLips(world, round < WELD_SPREADS);
    }
}
