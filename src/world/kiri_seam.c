#include "kiri_seam.h"
#include "kiri_call.h"
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
            KIRI_EACH(const int32_t, frame, frames) {
                memset(&sheet->frames.data[*frame].history, 0, sizeof(kiriHistory));
            }
        }
    }
}

/* Sets the frame that carries most of the point. Returns false outside the material, and on a destroyed piece. */
static bool FollowEnd(const kiriSheetData* sheet, kiriStitchData* stitch, int end)
{
    kiriWeight weights[KIRI_CONTACT_WEIGHTS];
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
static void Straighten(const kiriSheetData* sheet, kiriVec2 point, kiriVec2 way, kiriWeight* weights, int32_t count)
{
    double off[KIRI_CONTACT_WEIGHTS], mean = 0.0, spread = 0.0, last = 0.0;
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
    kiriWeight weights[KIRI_CONTACT_WEIGHTS];
    int32_t count = kiriTouches_WeighPoint(sheet, stitch->at[end], weights);
    KIRI_ASSERT(count >= 0 && count <= KIRI_CONTACT_WEIGHTS);
    kiriVec2 point = kiriMesh_Local(&sheet->mesh, stitch->at[end]), rest = point;
    if (bends) {
        Straighten(sheet, point, kiriVec2_Make(-stitch->inward[end].y, stitch->inward[end].x), weights, count);
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

static kiriVec3 CarriedEnd(const kiriSheetData* sheet, const kiriContactMember* members, int32_t count)
{
    kiriVec3 x = { 0 };
    KIRI_TIMES(n, count) {
        kiriVec3 carried = kiriFrame_Carry(&sheet->frames.data[members[n].frame], members[n].at);
        x = kiriVec3_AddScaled(x, members[n].value, carried);
    }
    return x;
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

static kiriVec2 LinePoint(const float* line, int32_t i)
{
    return kiriVec2_Make(line[2 * i], line[2 * i + 1]);
}

static double LineLength(const float* line, int32_t count)
{
    double length = 0.0;
    KIRI_FROM_TO(i, 1, count) {
        length += kiriVec2_Length(kiriVec2_Sub(LinePoint(line, i), LinePoint(line, i - 1)));
    }
    return length;
}

/* Finds the point of the material at a length along the line. Tries points beside it if it is outside by rounding. */
static bool PlaceEnd(const kiriSheetData* sheet, const float* line, int32_t count, double along, kiriStitchData* stitch,
                     int end)
{
    static const int8_t sides[9][2] = { { 0, 0 }, { 1, 0 },  { -1, 0 }, { 0, 1 },  { 0, -1 },
                                        { 1, 1 }, { -1, 1 }, { 1, -1 }, { -1, -1 } };
    KIRI_ASSERT(count >= 2 && along >= 0.0);
    int32_t i = 1;
    kiriVec2 from = LinePoint(line, 0), way = kiriVec2_Sub(LinePoint(line, 1), from);
    while (count > 2 && memcmp(&line[2 * count - 2], &line[2 * count - 4], 2 * sizeof(float)) == 0) {
        --count;
    }
    for (; i + 1 < count && (along > kiriVec2_Length(way) || !(kiriVec2_Length(way) > 0.0)); ++i) {
        along -= kiriVec2_Length(way);
        from = LinePoint(line, i);
        way = kiriVec2_Sub(LinePoint(line, i + 1), from);
    }
    double length = kiriVec2_Length(way);
    kiriVec2 point = kiriVec2_AddScaled(from, length > 0.0 ? kiriMin(along / length, 1.0) : 0.0, way);
    const float rest[2] = { (float)point.x, (float)point.y };
    kiriLatticePoint at;
    bool isFound = false;
    KIRI_TIMES_WHILE(!isFound && kiriSheet_ToLattice(sheet, rest, &at), k, 9) {
        stitch->at[end].x = at.x + NEAR * sides[k][0];
        stitch->at[end].y = at.y + NEAR * sides[k][1];
        isFound = FollowEnd(sheet, stitch, end);
    }
    if (isFound) { /* to the left of the line, if there is material */
        kiriVec2 left = kiriVec2_Scale(length > 0.0 ? 1.0 / length : 0.0, kiriVec2_Make(-way.y, way.x));
        double far = 0.25 * sheet->mesh.squares.side;
        kiriLatticePoint beside = stitch->at[end];
        beside.x += (int32_t)(far * left.x);
        beside.y += (int32_t)(far * left.y);
        bool isLeft = kiriMesh_Locate(&sheet->mesh, beside) != KIRI_NONE;
        stitch->inward[end] = kiriVec2_Scale(isLeft ? 1.0 : -1.0, left);
    }
    return isFound;
}

/* Returns the distance of frames, m. */
static double FrameSpacing(const kiriSheetData* sheet)
{
    double area = 0.0;
    KIRI_EACH(const kiriFrameData, frame, sheet->frames) {
        area += frame->area;
    }
    KIRI_ASSERT(sheet->frames.count > 0 && area > 0.0);
    return sqrt(area / sheet->frames.count);
}

/* Returns true if gravity bends the material less than from frame to frame. Such lips would hold each other straight.
   In softer material they meet where they are drawn. */
static bool IsStiff(const kiriSheetData* sheet)
{
    const kiriMaterial* material = &sheet->settings.material;
    double thickness = material->thickness, spacing = FrameSpacing(sheet);
    double bending = material->youngsModulus * thickness * thickness / 12.0;
    return bending > material->density * GRAVITY * spacing * spacing * spacing;
}

static const char* PlaceStitches(const kiriSeamDef* def, kiriSheetData* const sheets[2], kiriSeamData* seam)
{
    const float* lines[2] = { def->lineA, def->lineB };
    const int32_t counts[2] = { def->countA, def->countB };
    double lengths[2];
    bool isClosed = true;
    KIRI_TIMES(end, 2) {
        lengths[end] = LineLength(lines[end], counts[end]);
        isClosed = isClosed && memcmp(lines[end], &lines[end][2 * (counts[end] - 1)], 2 * sizeof(float)) == 0;
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
        stitch->length = stitch->share / parts * 0.5 * (lengths[0] + lengths[1]);
        KIRI_TIMES(end, 2) {
            if (!PlaceEnd(sheets[end], lines[end], counts[end], part * lengths[end], stitch, end)) {
                return end == 0 ? "def.lineA leaves the material" : "def.lineB leaves the material";
            }
        }
    }
    return NULL;
}

static void FreeSeam(kiriWorld* world, kiriSeamData* seam)
{
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
    kiriSheetData* sheets[2] = { kiriPool_Find(&world->sheetIds, def->sheetA)->owner,
                                 kiriPool_Find(&world->sheetIds, def->sheetB)->owner };
    double length = kiriMin(LineLength(def->lineA, def->countA), LineLength(def->lineB, def->countB));
    double spacing = kiriMin(FrameSpacing(sheets[0]), FrameSpacing(sheets[1]));
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
    const char* why = hasRoom ? PlaceStitches(def, sheets, made) : NULL;
    if (!hasRoom || why != NULL) {
        FreeSeam(world, made);
        return KIRI_FAIL(hasRoom ? KIRI_ERROR_ARGUMENT : KIRI_ERROR_MEMORY, why);
    }
    made->breakForce = def->breakForce;
    made->bending = def->stiffness;
    made->restAngle = def->restAngle;
    made->bends = IsStiff(sheets[0]) || IsStiff(sheets[1]);
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
            ok = from->next != to->number || kiriStitch_Sheet(world, to, k % 2) != sheet ||
                 kiriArray_Push(sheet->memory, &sheet->sewn, line);
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
    kiriContactMember members[KIRI_CONTACT_WEIGHTS];
    KIRI_ASSERT_HAS(seam->stitches, stitch);
    const kiriSheetData* sheet = kiriStitch_Sheet(world, &seam->stitches.data[stitch], end);
    return CarriedEnd(sheet, members, CarryEnd(sheet, &seam->stitches.data[stitch], end, seam->bends, members));
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
        kiriContactMember members[KIRI_CONTACT_WEIGHTS];
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
        kiriContactMember members[KIRI_CONTACT_WEIGHTS];
        int32_t count = CarryEnd(sheet, data, end, seam->bends, members);
        if (count == 0) {
            return false;
        }
        bool isMoved = world->islands.isJoined.data[sheet->probes.sheet] && !sheet->rest.asleep &&
                       kiriSheet_Moves(sheet, members[0].frame);
        kiriVec3 x = kiriVec3_Scale(end == 0 ? 1.0 : -1.0, CarriedEnd(sheet, members, count));
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
