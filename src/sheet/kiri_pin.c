#include "kiri_pin.h"
#include "kiri_seen.h"
#include "kiri_sheet_site.h"
#include "kiri_tear.h"
#include "../motion/kiri_solver.h"
#include "../motion/kiri_frame.h"

/* ---- Geometry of lines ------------------------------------------------------------------------------------------- */

/* A line in the rest plane, m, local. */
typedef struct RestLine {
    kiriVec2 from, along; /* unit */
    double length;
} RestLine;

static RestLine RestLineOf(const kiriSheetData* sheet, const kiriPinData* pin)
{
    kiriVec2 from = kiriMesh_Local(&sheet->mesh, pin->at);
    kiriVec2 way = kiriVec2_Sub(kiriMesh_Local(&sheet->mesh, pin->to), from);
    double length = kiriVec2_Length(way);
    RestLine line = { from, kiriVec2_Scale(1.0 / length, way), length };
    return line;
}

static kiriVec2 PointAlong(const RestLine* line, double t)
{
    return kiriVec2_AddScaled(line->from, t * line->length, line->along);
}

/* Returns the shape of a share of a line, for the site of its frame. Its moment is about its centroid. Its outer width
   is at free ends (see kiriLink), beyond the foot of the site on the line. */
static kiriClampShape ShapeOf(const kiriSheetData* sheet, const RestLine* line, const kiriLineShare* share,
                              kiriVec2 site)
{
    KIRI_ASSERT(share->length > 0.0);
    double foot = kiriVec2_Dot(kiriVec2_Sub(site, line->from), line->along) / line->length;
    double about = share->second - share->first * share->first / share->length;
    double before = share->open[0] ? foot - share->ends[0] : 0.0, behind = share->open[1] ? share->ends[1] - foot : 0.0;
    double outer = kiriMax(before, 0.0) + kiriMax(behind, 0.0);
    kiriClampShape shape = { line->from,
                             line->along,
                             PointAlong(line, share->first / share->length),
                             line->length * share->length,
                             line->length * line->length * line->length * kiriMax(about, 0.0),
                             line->length * kiriMin(outer, share->length),
                             &sheet->settings.material,
                             0.1 * sheet->grid.side,
                             kiriMechanics_IsAffine(&sheet->settings.mechanics) };
    return shape;
}

/* Returns where the host holds a point of the line. */
static kiriVec3 HeldPoint(const RestLine* line, kiriVec3 target, const kiriMat3* rotation, kiriVec2 point)
{
    kiriVec2 off = kiriVec2_Sub(point, PointAlong(line, 0.5));
    return kiriVec3_AddScaled(kiriVec3_AddScaled(target, off.x, rotation->u), off.y, rotation->v);
}

/* Takes the mean of the frames' motion, by length. */
void kiriPin_TakePose(const kiriSheetData* sheet, kiriPinData* pin)
{
    RestLine line = RestLineOf(sheet, pin);
    kiriVec2 middle = { 0 };
    kiriVec3 x = { 0 };
    kiriMat3 A = { x, x, x };
    double sum = 0.0;
    KIRI_EACH(const kiriLineShare, share, sheet->lineShares) {
        const kiriFrameData* frame = &sheet->frames.data[share->frame];
        kiriVec2 point = PointAlong(&line, share->first / share->length);
        middle = kiriVec2_AddScaled(middle, share->length, point);
        x = kiriVec3_AddScaled(x, share->length, kiriFrame_Carry(frame, point));
        A = kiriMat3_AddScaled(&A, share->length, &frame->A);
        sum += share->length;
    }
    pin->rotation = kiriMat3_Rotation(A);
    kiriVec2 off = kiriVec2_Sub(PointAlong(&line, 0.5), kiriVec2_Scale(1.0 / sum, middle));
    kiriVec3 way = kiriVec3_AddScaled(kiriVec3_Scale(off.x, pin->rotation.u), off.y, pin->rotation.v);
    pin->target = kiriVec3_AddScaled(way, 1.0 / sum, x);
}

/* ---- Pins come and go -------------------------------------------------------------------------------------------- */

static bool ReserveRows(kiriSheetData* sheet, int64_t pins, int64_t shares, int64_t links)
{
    return kiriSolver_ReserveRows(sheet->solver, pins + 2 * shares, shares, 0) &&
           kiriArray_Reserve(sheet->memory, &sheet->pinRows, pins + 2 * shares) &&
           kiriArray_Reserve(sheet->memory, &sheet->drawnPins, pins + shares) &&
           kiriArray_Reserve(sheet->memory, &sheet->clampRows, shares) &&
           (shares == 0 || kiriArray_Reserve(sheet->memory, &sheet->linkParts, links));
}

/* Appends the shares of a line; capacity is reserved. Returns the frame with the longest share, or `none` if there are
   no shares. */
static int32_t AppendShares(const kiriSheetData* sheet, int32_t pin, kiriPinShares* shares, int32_t none)
{
    const kiriLineShare* longest = NULL;
    KIRI_EACH(const kiriLineShare, from, sheet->lineShares) {
        kiriPinShare share = { .pin = pin, .share = *from };
        if (longest == NULL || share.share.length > longest->length) {
            longest = from;
        }
        KIRI_ASSERT(shares->count < shares->capacity && share.share.length > 0.0);
        KIRI_NEXT(*shares) = share;
    }
    return longest != NULL ? longest->frame : none;
}

void kiriPins_WriteLinkParts(kiriSheetData* sheet)
{
    const kiriSevered* severed = &sheet->layout.severed;
    sheet->linkParts.count = severed->count > 0 ? sheet->links.links.count : 0;
    KIRI_EACH(kiriLinkPart, whole, sheet->linkParts) {
        *whole = (kiriLinkPart){ 1.0, 1.0 };
    }
    KIRI_EACH(const kiriSeveredLink, link, *severed) {
        KIRI_ASSERT(link->link >= 0 && link->link < sheet->linkParts.count);
        kiriLinkPart* left = &sheet->linkParts.data[link->link];
        left->part = kiriMax(left->part - link->part, 0.0);
        left->free = kiriMax(left->free - link->held, 0.0);
    }
}

bool kiriPins_Add(kiriSheetData* sheet, const kiriPinData* pin, int32_t frame)
{
    int32_t severed = sheet->layout.severed.count;
    if (pin->type == KIRI_PIN_CLAMP && frame == KIRI_NONE &&
        !kiriSever_Across(sheet, pin->at, pin->to, sheet->pins.count, false, &sheet->layout.severed)) {
        sheet->layout.severed.count = severed;
        return false;
    }
    int64_t need = (int64_t)sheet->pins.count + 1, shares = sheet->layout.pinShares.count;
    shares += pin->type == KIRI_PIN_POINT ? 0 : sheet->lineShares.count;
    if (!kiriArrays_Reserve(sheet->memory, need, &sheet->pins, &sheet->layout.pinFrame) ||
        !kiriArray_Reserve(sheet->memory, &sheet->layout.pinShares, shares) ||
        !ReserveRows(sheet, need, shares, sheet->links.links.count)) {
        sheet->layout.severed.count = severed;
        return false;
    }
    int32_t index = sheet->pins.count++;
    sheet->pins.data[index] = *pin;
    if (pin->type != KIRI_PIN_POINT) {
        frame = AppendShares(sheet, index, &sheet->layout.pinShares, frame);
    }
    KIRI_NEXT(sheet->layout.pinFrame) = frame;
    kiriPins_WriteLinkParts(sheet);
    return true;
}

void kiriPins_ForgetHistory(kiriSheetData* sheet, int32_t index)
{
    KIRI_ASSERT_HAS(sheet->pins, index);
    const kiriPinShares* shares = &sheet->layout.pinShares;
    KIRI_CLEAR(&sheet->frames.data[sheet->layout.pinFrame.data[index]].history);
    KIRI_EACH(const kiriPinShare, share, *shares) {
        if (share->pin == index) {
            KIRI_CLEAR(&sheet->frames.data[share->share.frame].history);
        }
    }
}

/* Removes the items of a pin from an array whose items begin with the index of their pin, and are in the order of pins.
   The last pin takes its place. */
static void RemoveOfPin(void* array, size_t itemBytes, int32_t index, int32_t last)
{
    kiriArrayHeader header = kiriArray_GetHeader(array);
    char *items = header.data, item[sizeof(kiriPinShare)];
    int32_t count = header.count, pin, before;
    KIRI_ASSERT(itemBytes <= sizeof(item));
    header.count = 0;
    KIRI_TIMES(k, count) {
        memcpy(item, items + k * itemBytes, itemBytes);
        memcpy(&pin, item, sizeof(pin));
        if (pin != index) {
            char* to = items + header.count++ * itemBytes;
            pin = pin == last ? index : pin;
            memcpy(item, &pin, sizeof(pin));
            for (; to > items && (memcpy(&before, to - itemBytes, sizeof(before)), before > pin); to -= itemBytes) {
                memcpy(to, to - itemBytes, itemBytes);
            }
            memcpy(to, item, itemBytes);
        }
    }
    kiriArray_SetHeader(array, header);
}

void kiriPins_Remove(kiriSheetData* sheet, int32_t index)
{
    KIRI_ASSERT(index >= 0 && index < sheet->pins.count && sheet->layout.pinFrame.count == sheet->pins.count);
    int32_t last = --sheet->pins.count;
    sheet->layout.pinFrame.count = last;
    sheet->pins.data[index] = sheet->pins.data[last];
    sheet->layout.pinFrame.data[index] = sheet->layout.pinFrame.data[last];
    RemoveOfPin(&sheet->layout.pinShares, sizeof(kiriPinShare), index, last);
    RemoveOfPin(&sheet->layout.severed, sizeof(kiriSeveredLink), index, last);
    kiriPins_WriteLinkParts(sheet);
}

/* ---- Staging ----------------------------------------------------------------------------------------------------- */

bool kiriPins_Stage(kiriSheetData* sheet)
{
    kiriLayout* next = &sheet->update->next;
    next->pinShares.count = next->severed.count = 0;
    bool ok = kiriArray_Resize(sheet->memory, &next->pinFrame, sheet->pins.count);
    KIRI_EACH_INDEX_WHILE(ok, i, sheet->pins) {
        const kiriPinData* pin = &sheet->pins.data[i];
        if (pin->type == KIRI_PIN_POINT) {
            int32_t cell = kiriGrid_CellAround(&sheet->grid, pin->at);
            next->pinFrame.data[i] = sheet->regions.field.owner.data[cell];
            continue;
        }
        ok = kiriOwner_FindShares(sheet, pin->at, pin->to, true) &&
             (pin->type == KIRI_PIN_HINGE || kiriSever_Across(sheet, pin->at, pin->to, i, true, &next->severed)) &&
             kiriArray_ReserveMore(sheet->memory, &next->pinShares, sheet->lineShares.count);
        if (ok) {
            next->pinFrame.data[i] = AppendShares(sheet, i, &next->pinShares, sheet->layout.pinFrame.data[i]);
        }
    }
    return ok && ReserveRows(sheet, sheet->pins.count, next->pinShares.count, sheet->links.next.count);
}

/* ---- Rows -------------------------------------------------------------------------------------------------------- */

static kiriVec3 PartWay(kiriVec3 a, kiriVec3 b, double part)
{
    return part >= 1.0 ? b : kiriVec3_AddScaled(a, part, kiriVec3_Sub(b, a));
}

/* Returns the target at a fraction of the tick, 0 to 1. */
static kiriVec3 TargetAfter(const kiriPinData* pin, double part)
{
    return PartWay(pin->lastTarget, pin->target, part);
}

static kiriMat3 RotationAfter(const kiriPinData* pin, double part)
{
    const kiriMat3 *a = &pin->lastRotation, *b = &pin->rotation;
    if (kiriMat3_Equal(a, b) || part <= 0.0 || part >= 1.0) {
        return part >= 1.0 ? *b : *a;
    }
    kiriMat3 mean = { PartWay(a->u, b->u, part), PartWay(a->v, b->v, part), PartWay(a->d, b->d, part) };
    return kiriMat3_RotationFrom(*a, mean);
}

static kiriPinRow PointRow(const kiriSheetData* sheet, kiriPinData* pin, int32_t frame, double to)
{
    kiriVec3 target = kiriVec3_Add(kiriVec3_Add(TargetAfter(pin, to), pin->anchor.way), pin->reaction.offset);
    double stiffness = pin->stiffness / (1.0 + pin->stiffness * pin->anchor.softness); /* an obstacle yields in series */
    return (kiriPinRow){ frame, kiriMesh_Local(&sheet->mesh, pin->at), target, stiffness, &pin->reaction };
}

/* Returns a row of a hinge. It holds the line by springs along it, as stiff as the material up to the site. Two springs
   are equivalent, k = 0 and 1, at the points of two equal masses with the line's length, centroid and second moment. */
static kiriPinRow HingeRow(const kiriSheetData* sheet, kiriPinShare* pinned, int k, double to)
{
    const kiriMaterial* material = &sheet->settings.material;
    const kiriPinData* pin = &sheet->pins.data[pinned->pin];
    kiriVec2 site = sheet->frames.data[pinned->share.frame].site.at;
    RestLine line = RestLineOf(sheet, pin);
    kiriClampShape shape = ShapeOf(sheet, &line, &pinned->share, site);
    double away = fabs(kiriVec2_Dot(kiriVec2_Sub(site, line.from), kiriVec2_Left(line.along)));
    double length = kiriMax(away, shape.least);
    double stiffness = (double)material->youngsModulus * material->thickness * shape.width / length;
    kiriMat3 rotation = RotationAfter(pin, to);
    kiriVec2 at = kiriVec2_AddScaled(shape.centroid, (2 * k - 1) * sqrt(shape.moment / shape.width), line.along);
    kiriReaction* reaction = &pinned->reactions[k];
    kiriVec3 target = kiriVec3_Add(HeldPoint(&line, TargetAfter(pin, to), &rotation, at), reaction->offset);
    return (kiriPinRow){ pinned->share.frame, at, target, 0.5 * stiffness, reaction };
}

/* Projects a point into the plane of a planar sheet. */
static kiriVec3 IntoPlane(const kiriSheetData* sheet, const kiriFrameData* frame, kiriVec3 x)
{
    const kiriMechanics* mechanics = &sheet->settings.mechanics;
    kiriVec3 off = kiriVec3_Sub(x, frame->x);
    return mechanics->planar ? kiriVec3_AddScaled(x, -kiriVec3_Dot(off, mechanics->axes.d), mechanics->axes.d) : x;
}

/* Makes the row of a clamp and a frame, for a step between two fractions of the tick. */
static kiriClampRow ClampRowOf(const kiriSheetData* sheet, const kiriPinShare* pinned, const kiriFrameData* frame,
                               double from, double to)
{
    const kiriPinData* pin = &sheet->pins.data[pinned->pin];
    RestLine line = RestLineOf(sheet, pin);
    kiriClampShape shape = ShapeOf(sheet, &line, &pinned->share, frame->site.at);
    kiriClampRow row = { 0 };
    row.frame = pinned->share.frame;
    kiriClamp_Shape(&row, &shape, frame->site.at);
    row.pose.A = RotationAfter(pin, to);
    row.start.A = RotationAfter(pin, from);
    row.pose.x = IntoPlane(sheet, frame, HeldPoint(&line, TargetAfter(pin, to), &row.pose.A, row.foot));
    row.start.x = IntoPlane(sheet, frame, HeldPoint(&line, TargetAfter(pin, from), &row.start.A, row.foot));
    memcpy(row.offset, pinned->offset, sizeof(row.offset));
    row.plastic = pinned->plastic;
    return row;
}

/* Returns true for a point pin of an awake piece. These pins have the first rows, in order. Sleeping pieces have no
   rows and keep their reactions. */
static bool IsAwakePoint(const kiriSheetData* sheet, int32_t index)
{
    KIRI_ASSERT_HAS(sheet->pins, index);
    return sheet->pins.data[index].type == KIRI_PIN_POINT && kiriSheet_Moves(sheet, sheet->layout.pinFrame.data[index]);
}

void kiriPins_BeginReactions(kiriSheetData* sheet)
{
    KIRI_EACH_INDEX(i, sheet->pins) {
        if (IsAwakePoint(sheet, i)) {
            KIRI_CLEAR(&sheet->pins.data[i].reaction.impulse);
        }
    }
    KIRI_EACH(kiriPinShare, pinned, sheet->layout.pinShares) {
        KIRI_TIMES_WHILE(kiriSheet_Moves(sheet, pinned->share.frame), k, 2) {
            KIRI_CLEAR(&pinned->reactions[k].impulse);
        }
    }
    KIRI_EACH_LISTED(frame, sheet->solver->moved.frames) {
        KIRI_CLEAR(&sheet->frames.data[frame].reaction.impulse);
    }
}

void kiriPins_WriteRows(kiriSheetData* sheet, double from, double to)
{
    bool yields = kiriSettings_Yield(&sheet->settings);
    sheet->pinRows.count = sheet->clampRows.count = 0;
    KIRI_EACH_INDEX(i, sheet->pins) {
        if (IsAwakePoint(sheet, i)) {
            KIRI_NEXT(sheet->pinRows) = PointRow(sheet, &sheet->pins.data[i], sheet->layout.pinFrame.data[i], to);
        }
    }
    KIRI_EACH(kiriPinShare, pinned, sheet->layout.pinShares) {
        if (!kiriSheet_Moves(sheet, pinned->share.frame)) {
            continue;
        }
        if (sheet->pins.data[pinned->pin].type == KIRI_PIN_HINGE) {
            KIRI_TIMES(k, 2) {
                KIRI_NEXT(sheet->pinRows) = HingeRow(sheet, pinned, k, to);
            }
        } else {
            const kiriFrameData* frame = &sheet->frames.data[pinned->share.frame];
            kiriClampRow* row = &KIRI_NEXT(sheet->clampRows);
            *row = ClampRowOf(sheet, pinned, frame, from, to);
            row->reaction = &pinned->reactions[0];
            row->keptOffset = yields ? pinned->offset : NULL;
            row->keptPlastic = yields ? &pinned->plastic : NULL;
        }
    }
}

/* ---- Strains that clamps keep ------------------------------------------------------------------------------------ */

static void MeasureClamp(const kiriSheetData* sheet, const kiriPinShare* pinned, const kiriFrameData* frame,
                         double turned, double* strain)
{
    kiriClampRow row = ClampRowOf(sheet, pinned, frame, 0.0, 1.0);
    kiriPose pose = kiriPose_Of(frame);
    row.offset[KIRI_PLANE_BENDING] = turned;
    kiriClamp_Measure(&row, frame, &row.pose, &pose, strain, NULL);
}

/* Returns the share of the same pin whose frame is nearest to a new frame, or null: the material there is bent alike. */
static const kiriPinShare* FindPinnedBeside(const kiriSheetData* sheet, const kiriPinShares* old,
                                            const kiriPinShare* pinned)
{
    const kiriPinShare* found = NULL;
    double least = HUGE_VAL;
    kiriVec2 center = sheet->frames.data[pinned->share.frame].center;
    KIRI_EACH(const kiriPinShare, share, *old) {
        double far = kiriVec2_Distance(sheet->frames.data[share->share.frame].center, center);
        if (share->pin == pinned->pin && far < least) {
            found = share;
            least = far;
        }
    }
    return found;
}

static const kiriFrameData* FrameBefore(const kiriSheetData* sheet, int32_t frame)
{
    return kiriStrainOffsets_FrameBefore(&sheet->strainOffsets, sheet->frames.data, frame);
}

static void KeepStrains(kiriSheetData* sheet, const kiriPinShares* old, const kiriPinShare* older, kiriPinShare* pinned)
{
    int32_t frame = pinned->share.frame;
    double strain[KIRI_CLAMP_STRAINS], turned[KIRI_CLAMP_STRAINS], was[KIRI_CLAMP_STRAINS] = { 0 };
    const double none[KIRI_CLAMP_STRAINS] = { 0 };
    MeasureClamp(sheet, pinned, &sheet->frames.data[frame], 0.0, strain);
    MeasureClamp(sheet, pinned, &sheet->frames.data[frame], 1.0, turned);
    if (older != NULL) {
        MeasureClamp(sheet, older, FrameBefore(sheet, frame), older->offset[KIRI_PLANE_BENDING], was);
    }
    kiriStrainOffset_Keep(strain, turned, was, older != NULL ? older->offset : none, pinned->offset);
    KIRI_CLEAR(&pinned->plastic);
    if (sheet->plastics.isKept) {
        const kiriLink link = ClampRowOf(sheet, pinned, &sheet->frames.data[frame], 0.0, 1.0).link;
        older = older != NULL ? older : FindPinnedBeside(sheet, old, pinned);
        const kiriFrameData* bent = older != NULL ? &sheet->frames.data[older->share.frame] : NULL;
        pinned->plastic =
            older == NULL ? kiriPlastic_AtRest(&sheet->settings.material, &link) :
            kiriPlastic_Scaled(&older->plastic, link.length / ClampRowOf(sheet, older, bent, 0.0, 1.0).link.length);
    }
}

void kiriPins_TakeRest(kiriSheetData* sheet, const kiriMaterial* before)
{
    KIRI_EACH(kiriPinShare, pinned, sheet->layout.pinShares) {
        if (sheet->pins.data[pinned->pin].type == KIRI_PIN_CLAMP) {
            kiriClampRow row = ClampRowOf(sheet, pinned, &sheet->frames.data[pinned->share.frame], 0.0, 1.0);
            kiriPlastic_Rest(&pinned->plastic, before, &sheet->settings.material, &row.link);
        }
    }
}

/* Keeps the pull of a spring on the point of a frame, or of none (null): without pull. */
static void KeepPull(const kiriSheetData* sheet, kiriPinRow row, const kiriFrameData* older)
{
    kiriVec3 is = kiriFrame_Carry(&sheet->frames.data[row.frame], row.at);
    kiriVec3 was = older != NULL ? kiriFrame_Carry(older, row.at) : row.target;
    row.reaction->offset = kiriVec3_Add(row.reaction->offset, kiriVec3_Sub(is, was));
}

void kiriPins_Keep(kiriSheetData* sheet, const kiriLayout* old)
{
    /* Tears take effect in each tick: pulls that are kept would let pins slip. */
    bool keepsPulls = kiriSheet_KeepsPulls(sheet) && !kiriTears_AreGrowing(sheet);
    KIRI_EACH_INDEX_WHILE(keepsPulls, i, sheet->pins) {
        if (sheet->pins.data[i].type == KIRI_PIN_POINT) {
            kiriPinRow row = PointRow(sheet, &sheet->pins.data[i], sheet->layout.pinFrame.data[i], 0.0);
            KeepPull(sheet, row, FrameBefore(sheet, old->pinFrame.data[i]));
        }
    }
    KIRI_EACH(kiriPinShare, pinned, sheet->layout.pinShares) {
        const kiriPinShare* older = NULL;
        KIRI_EACH_WHILE(older == NULL, const kiriPinShare, share, old->pinShares) {
            older = share->pin == pinned->pin && share->share.frame == pinned->share.frame ? share : NULL;
        }
        if (older != NULL) {
            memcpy(pinned->reactions, older->reactions, sizeof(pinned->reactions));
            pinned->bore = older->bore;
        }
        if (kiriSheet_KeepsStrains(sheet) && sheet->pins.data[pinned->pin].type == KIRI_PIN_CLAMP) {
            KeepStrains(sheet, &old->pinShares, older, pinned);
        }
        KIRI_TIMES_WHILE(keepsPulls && sheet->pins.data[pinned->pin].type == KIRI_PIN_HINGE, k, 2) {
            KeepPull(sheet, HingeRow(sheet, pinned, k, 0.0), older != NULL ? FrameBefore(sheet, pinned->share.frame) : NULL);
        }
    }
}

static void FadeOffset(kiriReaction* reaction, double keep)
{
    bool isLeft = kiriVec3_Length(reaction->offset) > 1e-12;
    reaction->offset = kiriVec3_Scale(isLeft ? keep : 0.0, reaction->offset);
}

void kiriPins_FadeOffsets(kiriSheetData* sheet, double dt, double time)
{
    double keep = time / (time + dt);
    KIRI_EACH_INDEX(i, sheet->pins) {
        if (IsAwakePoint(sheet, i)) {
            FadeOffset(&sheet->pins.data[i].reaction, keep);
        }
    }
    KIRI_EACH(kiriPinShare, share, sheet->layout.pinShares) {
        bool isAwake = kiriSheet_Moves(sheet, share->share.frame);
        if (isAwake) {
            kiriStrainOffset_Fade(share->offset, sheet->plastics.isKept ? &share->plastic : NULL, KIRI_CLAMP_STRAINS,
                                  keep);
            FadeOffset(&share->reactions[0], keep);
            FadeOffset(&share->reactions[1], keep);
        }
    }
}

double kiriPins_ElasticEnergy(const kiriSheetData* sheet, kiriSystem system)
{
    double sum = 0.0;
    system.clampCount = 1;
    KIRI_EACH(const kiriPinShare, pinned, sheet->layout.pinShares) {
        if (sheet->pins.data[pinned->pin].type == KIRI_PIN_CLAMP) {
            kiriClampRow row = ClampRowOf(sheet, pinned, &sheet->frames.data[pinned->share.frame], 0.0, 0.0);
            system.clamps = &row;
            sum += kiriElement_Energy(&system, kiriElement_Count(&system) - 1);
        }
    }
    return sum;
}

int32_t kiriPins_WriteClamps(const kiriSheetData* sheet, kiriClampRow* rows)
{
    int32_t count = 0;
    KIRI_EACH(const kiriPinShare, pinned, sheet->layout.pinShares) {
        if (sheet->pins.data[pinned->pin].type == KIRI_PIN_CLAMP) {
            rows[count++] = ClampRowOf(sheet, pinned, &sheet->frames.data[pinned->share.frame], 0.0, 1.0);
        }
    }
    return count;
}

/* ---- Reactions --------------------------------------------------------------------------------------------------- */

/* Adds the reaction of a row at `at`, about the pin's target. */
static void AddBorne(const kiriPinData* pin, const kiriReaction* reaction, kiriVec3 at, double perTime, kiriWrench* sum)
{
    kiriVec3 arm = kiriVec3_Sub(at, pin->target);
    kiriWrench borne = reaction->impulse;
    borne.moment = kiriVec3_Add(borne.moment, kiriVec3_Cross(arm, borne.force));
    kiriWrench_Add(sum, perTime, &borne);
}

static void TakePinReactions(kiriSheetData* sheet, double perTime)
{
    int32_t row = 0, clamp = 0;
    KIRI_EACH_INDEX(i, sheet->pins) {
        kiriPinData* pin = &sheet->pins.data[i];
        if (IsAwakePoint(sheet, i)) {
            KIRI_CLEAR(&pin->bore);
            ++row;
            AddBorne(pin, &pin->reaction, pin->target, perTime, &pin->bore);
        }
    }
    KIRI_EACH(kiriPinShare, pinned, sheet->layout.pinShares) {
        const kiriPinData* pin = &sheet->pins.data[pinned->pin];
        if (!kiriSheet_Moves(sheet, pinned->share.frame)) {
            continue;
        }
        KIRI_CLEAR(&pinned->bore);
        if (pin->type == KIRI_PIN_CLAMP) {
            KIRI_ASSERT(clamp < sheet->clampRows.count);
            AddBorne(pin, &pinned->reactions[0], sheet->clampRows.data[clamp++].pose.x, perTime, &pinned->bore);
            continue;
        }
        KIRI_TIMES(spring, 2) {
            KIRI_ASSERT(row < sheet->pinRows.count);
            AddBorne(pin, &pinned->reactions[spring], sheet->pinRows.data[row++].target, perTime, &pinned->bore);
        }
    }
    KIRI_ASSERT(row == sheet->pinRows.count && clamp == sheet->clampRows.count);
    kiriPins_SumShares(sheet);
}

void kiriPins_SumShares(kiriSheetData* sheet)
{
    KIRI_EACH(kiriPinData, pin, sheet->pins) {
        if (pin->type != KIRI_PIN_POINT) {
            KIRI_CLEAR(&pin->bore);
        }
    }
    KIRI_EACH(const kiriPinShare, pinned, sheet->layout.pinShares) {
        kiriWrench_Add(&sheet->pins.data[pinned->pin].bore, 1.0, &pinned->bore);
    }
}

void kiriPins_TakeReactions(kiriSheetData* sheet, double dt)
{
    TakePinReactions(sheet, 1.0 / dt);
    KIRI_EACH_LISTED(at, sheet->solver->moved.frames) {
        kiriFrameData* frame = &sheet->frames.data[at];
        KIRI_CLEAR(&frame->bore);
        kiriWrench_Add(&frame->bore, 1.0 / dt, &frame->reaction.impulse);
    }
    KIRI_EACH(kiriPinData, pin, sheet->pins) {
        pin->lastTarget = pin->target;
        pin->lastRotation = pin->rotation;
    }
}

/* ---- Drawn points ---- */

/* Returns the share of a frame in the position of a point. */
static double ShareAt(const kiriSheetData* sheet, const kiriPointPlace* place, int32_t frame)
{
    KIRI_ASSERT_HAS(sheet->frames, frame);
    double sum = 0.0;
    KIRI_EACH_CORNER(k) {
        kiriSpan span = sheet->vertexSkin.spans.data[sheet->mesh.triangles.data[place->triangle].vertex[k]];
        KIRI_EACH_IN(i, span) {
            const kiriSampleWeight* weight = &sheet->vertexSkin.weights.data[i];
            sum += weight->frame == frame ? place->shares[k] * weight->value : 0.0;
        }
    }
    return sum;
}

#define DRAW_ROUNDS 64  /* over pins that share frames */
#define MOST_SHIFT 1.25 /* of the way of the farthest pin: pins that share frames would shift them far, in opposite ways */
#define DRAWN 1e-6      /* of the longer side: nearer to its pin a point is drawn as it is */
#define DRAW_REACH 0.5  /* of the side of a region: farther points are moved in part, and from twice as far not at all */

/* Returns how far the shifts move a vertex. */
static kiriVec3 ShiftOf(const kiriSheetData* sheet, int32_t vertex)
{
    kiriVec3 sum = { 0 };
    KIRI_EACH_IN(i, sheet->vertexSkin.spans.data[vertex]) {
        const kiriSampleWeight* weight = &sheet->vertexSkin.weights.data[i];
        const kiriShift* shift = &sheet->seen.surface.detail.shifts.data[weight->frame];
        if (shift->moves) {
            kiriVec2 off = kiriVec2_Sub(sheet->seen.surface.rest.data[vertex], shift->from);
            double away = shift->reach > 0.0 ? kiriVec2_Dot(off, shift->across) : 0.0;
            double part = away != 0.0 ? kiriMin(fabs(away) / shift->reach, 1.0) : 0.0;
            double left = weight->value * (1.0 - part) * (1.0 - part);
            sum = kiriVec3_AddScaled(sum, left * (1.0 + 2.0 * part), shift->by);
            sum = kiriVec3_AddScaled(sum, left * away, shift->turn);
        }
    }
    return sum;
}

/* Lists a point of a frame that is drawn at its target. Returns its place, and which part of the way it goes, 0 to 1. */
static double ListDrawn(kiriSheetData* sheet, int32_t frame, kiriLatticePoint at, kiriVec3 target, kiriPointPlace* place)
{
    if (!kiriPoint_Find(sheet, at, place) || !(ShareAt(sheet, place, frame) > 0.0)) {
        return 0.0; /* outside, or on the other lip of a cut */
    }
    const kiriVec3 normal = sheet->settings.mechanics.axes.d;
    kiriVec3 skin = kiriPoint_Position(sheet, place), way = kiriVec3_Sub(target, skin);
    way = sheet->settings.mechanics.planar ? kiriVec3_Across(way, normal) : way;
    double reach = DRAW_REACH * sqrt(sheet->frames.data[frame].area);
    double part = kiriClamp(2.0 - kiriVec3_Length(way) / reach, 0.0, 1.0);
    kiriDrawnPin drawn = { .missing = kiriVec3_Sub(kiriVec3_AddScaled(skin, part, way), kiriPoint_Drawn(sheet, place)) };
    KIRI_EACH_CORNER(k) {
        drawn.vertex[k] = sheet->mesh.triangles.data[place->triangle].vertex[k];
        drawn.share[k] = place->shares[k];
        KIRI_EACH_IN(i, sheet->vertexSkin.spans.data[drawn.vertex[k]]) {
            const kiriSampleWeight* weight = &sheet->vertexSkin.weights.data[i];
            drawn.square += place->shares[k] * weight->value * ShareAt(sheet, place, weight->frame);
        }
    }
    KIRI_ASSERT(drawn.square > 0.0);
    KIRI_NEXT(sheet->drawnPins) = drawn;
    return part;
}

/* Lists the middle of a frame's share of a line. The patch leaves a clamp in the clamp's direction. */
static void ListDrawnLine(kiriSheetData* sheet, const kiriPinShare* pinned)
{
    const kiriPinData* pin = &sheet->pins.data[pinned->pin];
    kiriShift* shift = &sheet->seen.surface.detail.shifts.data[pinned->share.frame];
    RestLine line = RestLineOf(sheet, pin);
    kiriPointPlace place;
    kiriVec2 at = PointAlong(&line, pinned->share.first / pinned->share.length);
    kiriVec2 way = kiriVec2_Sub(sheet->frames.data[pinned->share.frame].site.at, at);
    /* The line may be on an edge of the sheet: a little closer to the site is inside the material. */
    double apart = kiriVec2_Length(way), aside = sheet->grid.side / 1024.0;
    at = kiriVec2_AddScaled(at, apart > aside ? aside / apart : 1.0, way);
    double part = ListDrawn(sheet, pinned->share.frame, kiriMesh_Snap(&sheet->mesh, at),
                            HeldPoint(&line, pin->target, &pin->rotation, at), &place);
    kiriVec2 left = kiriVec2_Left(line.along);
    double away = kiriVec2_Dot(way, left);
    shift->from = line.from;
    shift->across = away < 0.0 ? kiriVec2_Scale(-1.0, left) : left;
    shift->reach = shift->reach == 0.0 ? 2.0 * kiriMax(fabs(away), sheet->grid.side) : -1.0;
    if (pin->type == KIRI_PIN_CLAMP && part > 0.0) {
        /* The slope is of the triangle around the point, as drawn: so offsets that it has already count. */
        const double step = sheet->grid.side;
        const kiriVec2 n = shift->across;
        kiriVec3 due = kiriVec3_AddScaled(kiriVec3_Scale(n.x, pin->rotation.u), n.y, pin->rotation.v);
        kiriVec3 here = kiriPoint_Drawn(sheet, &place);
        kiriLatticePoint beside = kiriMesh_Snap(&sheet->mesh, kiriVec2_AddScaled(at, step, n));
        kiriMesh_Shares(&sheet->mesh, place.triangle, beside, place.shares);
        kiriVec3 is = kiriVec3_Scale(1.0 / step, kiriVec3_Sub(kiriPoint_Drawn(sheet, &place), here));
        shift->turn = kiriVec3_Scale(part, kiriVec3_Sub(due, is));
    }
}

/* Lists the points of awake pieces that stiff pins hold, and their lines. */
static void ListAllDrawn(kiriSheetData* sheet, double dt)
{
    sheet->drawnPins.count = 0;
    KIRI_EACH_INDEX(i, sheet->pins) {
        const kiriPinData* pin = &sheet->pins.data[i];
        if (IsAwakePoint(sheet, i) && 10.0 * pin->stiffness >= kiriPins_Stiffness(sheet)) {
            kiriVec3 given = kiriMat3_Mul(pin->anchor.give, kiriVec3_Scale(-dt * dt, pin->bore.force));
            kiriPointPlace place;
            ListDrawn(sheet, sheet->layout.pinFrame.data[i], pin->at, kiriVec3_Add(pin->target, given), &place);
            sheet->seen.surface.detail.shifts.data[sheet->layout.pinFrame.data[i]].reach = -1.0;
        }
    }
    KIRI_EACH(const kiriPinShare, pinned, sheet->layout.pinShares) {
        if (kiriSheet_Moves(sheet, pinned->share.frame)) {
            ListDrawnLine(sheet, pinned);
        }
    }
}

/* Shifts the frames of a pinned point by their shares, by `most` at most, until it is drawn at its pin. Returns how far it was
   away, m. */
static double ShiftToPin(kiriSheetData* sheet, const kiriDrawnPin* drawn, double most)
{
    kiriVec3 missing = drawn->missing;
    KIRI_EACH_CORNER(k) {
        missing = kiriVec3_AddScaled(missing, -drawn->share[k], ShiftOf(sheet, drawn->vertex[k]));
    }
    KIRI_EACH_CORNER(k) {
        KIRI_EACH_IN(i, sheet->vertexSkin.spans.data[drawn->vertex[k]]) {
            const kiriSampleWeight* weight = &sheet->vertexSkin.weights.data[i];
            kiriShift* shift = &sheet->seen.surface.detail.shifts.data[weight->frame];
            shift->by = kiriVec3_AddScaled(shift->by, drawn->share[k] * weight->value / drawn->square, missing);
            shift->moves = true;
            double size = kiriVec3_Length(shift->by);
            shift->by = size > most ? kiriVec3_Scale(most / size, shift->by) : shift->by;
        }
    }
    return kiriVec3_Length(missing);
}

/* Moves the corners of a pinned point until it is drawn at its pin. Returns its distance from the pin before, m. */
static double MoveCorners(kiriSheetData* sheet, const kiriDrawnPin* drawn)
{
    kiriVec3 missing = drawn->missing;
    float* offsets = sheet->seen.surface.detail.offsets.data;
    double square = 0.0;
    KIRI_EACH_CORNER(k) {
        missing = kiriVec3_AddScaled(missing, -drawn->share[k], kiriVec3_Load(offsets + 3 * drawn->vertex[k]));
        square += drawn->share[k] * drawn->share[k];
    }
    KIRI_ASSERT(square > 0.0);
    KIRI_EACH_CORNER(k) {
        float* offset = offsets + 3 * drawn->vertex[k];
        kiriVec3_Store(offset, kiriVec3_AddScaled(kiriVec3_Load(offset), drawn->share[k] / square, missing));
    }
    return kiriVec3_Length(missing);
}

void kiriPins_Draw(kiriSheetData* sheet, double dt)
{
    kiriSurface* surface = &sheet->seen.surface;
    double least = DRAWN * surface->longer, apart = HUGE_VAL, most = 0.0;
    bool isAny = false;
    if (surface->isWritten || !kiriSurface_HasDetail(surface) || sheet->pins.count == 0 || sheet->sewn.count > 0) {
        return;
    }
    KIRI_EACH(kiriShift, shift, surface->detail.shifts) {
        KIRI_CLEAR(shift);
    }
    ListAllDrawn(sheet, dt);
    KIRI_EACH(const kiriDrawnPin, pinned, sheet->drawnPins) {
        most = kiriMax(MOST_SHIFT * kiriVec3_Length(pinned->missing), most);
    }
    for (int round = 0; round < DRAW_ROUNDS && apart > least; ++round) {
        apart = 0.0;
        KIRI_EACH(const kiriDrawnPin, drawn, sheet->drawnPins) {
            double missing = ShiftToPin(sheet, drawn, most);
            apart = kiriMax(missing, apart);
        }
        isAny = isAny || apart > least;
    }
    KIRI_EACH_WHILE(isAny, kiriDrawnPin, of, sheet->drawnPins) { /* from here on without offsets */
        KIRI_EACH_CORNER(k) {
            kiriVec3 offset = kiriVec3_Load(surface->detail.offsets.data + 3 * of->vertex[k]);
            of->missing = kiriVec3_AddScaled(of->missing, of->share[k], offset);
        }
    }
    KIRI_TIMES_WHILE(isAny, v, surface->vertexCount) {
        if (kiriPiece_IsMoved(&sheet->layout.pieces.data[kiriPiece_OfVertex(sheet, v)])) {
            float* offset = surface->detail.offsets.data + 3 * v;
            kiriVec3_Store(offset, kiriVec3_Add(kiriVec3_Load(offset), ShiftOf(sheet, v)));
        }
    }
    for (int round = 0; isAny && round < DRAW_ROUNDS && apart > least; ++round) {
        apart = 0.0;
        KIRI_EACH(const kiriDrawnPin, near, sheet->drawnPins) {
            double missing = MoveCorners(sheet, near);
            apart = kiriMax(missing, apart);
        }
    }
}

/* ---- Steps ---- */

/* Moves a held frame by 1 / left of the remaining way; the last step ends at the goal. */
static void MoveHeld(kiriFrameData* frame, int32_t left)
{
    KIRI_ASSERT(frame->held && left >= 1);
    if (left == 1) {
        frame->heldPosition = frame->goalPosition;
        frame->heldRotation = frame->goalRotation;
        return;
    }
    double part = 1.0 / left;
    kiriVec3 way = kiriVec3_Sub(frame->goalPosition, frame->heldPosition);
    frame->heldPosition = kiriVec3_AddScaled(frame->heldPosition, part, way);
    if (!kiriMat3_Equal(&frame->heldRotation, &frame->goalRotation)) {
        kiriMat3 mean = kiriMat3_Scale(1.0 - part, &frame->heldRotation);
        mean = kiriMat3_AddScaled(&mean, part, &frame->goalRotation);
        frame->heldRotation = kiriMat3_RotationFrom(frame->heldRotation, mean);
    }
}

/* Moves the targets of pins on yielding obstacles to the end of the step, `after` s after the start of the tick.
   Returns true if any pin moves. */
static bool MoveTargets(kiriSheetData* sheet, double after, double h)
{
    bool any = false;
    KIRI_EACH_INDEX(i, sheet->pins) {
        kiriPinData* pin = &sheet->pins.data[i];
        kiriPinAnchor* anchor = &pin->anchor;
        any =
            any || !kiriVec3_Equal(pin->target, pin->lastTarget) || !kiriMat3_Equal(&pin->rotation, &pin->lastRotation);
        if (IsAwakePoint(sheet, i) && anchor->most > 0.0) {
            kiriVec3 given = kiriVec3_Scale(-1.0, pin->reaction.impulse.force);
            anchor->way = kiriVec3_Scale(after, kiriMat3_Mul(anchor->give, given));
            anchor->softness = after * h * anchor->most;
            any = true;
        }
    }
    return any;
}

/* If no pin moves, the rows stay valid for all steps. */
void kiriFollow_Step(kiriSheetData* sheet, int32_t i, int32_t n, double h)
{
    KIRI_ASSERT(i >= 0 && i < n);
    if (MoveTargets(sheet, (i + 1) * h, h)) {
        kiriPins_WriteRows(sheet, (double)i / n, i + 1 == n ? 1.0 : (i + 1.0) / n);
    }
    KIRI_EACH_LISTED(f, sheet->solver->moved.frames) {
        if (sheet->frames.data[f].held) {
            MoveHeld(&sheet->frames.data[f], n - i);
        }
    }
}
