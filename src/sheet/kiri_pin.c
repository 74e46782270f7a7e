#include "kiri_pin.h"

#include "kiri_sever.h"

#include "../motion/kiri_element.h"

#include <string.h>

/* ---- Geometry of lines ------------------------------------------------------------------------------------------- */

/* A line of the rest plane, local m. */
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
    return kiriVec2_Add(line->from, kiriVec2_Scale(t * line->length, line->along));
}

/* Of a share, about its centroid, m^3. */
static double MomentOf(const RestLine* line, const kiriLineShare* share)
{
    double about = share->second - share->first * share->first / share->length;
    return line->length * line->length * line->length * kiriMax(about, 0.0);
}

/* How much of the width is at free ends: see kiriLink. `foot` is where the way from the site meets the line. */
static double OuterOf(const RestLine* line, const kiriLineShare* share, double foot)
{
    double before = share->open[0] ? foot - share->ends[0] : 0.0, behind = share->open[1] ? share->ends[1] - foot : 0.0;
    double outer = kiriMax(before, 0.0) + kiriMax(behind, 0.0);
    return line->length * kiriMin(outer, share->length);
}

/* What a share has of a line, for the site of its frame. */
static kiriClampShape ShapeOf(const kiriSheetData* sheet, const RestLine* line, const kiriLineShare* share,
                              kiriVec2 site)
{
    double foot = kiriVec2_Dot(kiriVec2_Sub(site, line->from), line->along);
    kiriClampShape shape = { line->from,
                             line->along,
                             PointAlong(line, share->first / share->length),
                             line->length * share->length,
                             MomentOf(line, share),
                             OuterOf(line, share, foot / line->length),
                             &sheet->settings.material,
                             0.1 * sheet->grid.side,
                             kiriMechanics_IsAffine(&sheet->settings.mechanics) };
    return shape;
}

/* Where the host has a point of the line. */
static kiriVec3 HeldPoint(const RestLine* line, kiriVec3 target, const kiriMat3* rotation, kiriVec2 point)
{
    kiriVec2 off = kiriVec2_Sub(point, PointAlong(line, 0.5));
    return kiriVec3_AddScaled(kiriVec3_AddScaled(target, off.x, rotation->u), off.y, rotation->v);
}

/* The mean of the frames' motion, by length. */
void kiriPin_TakePose(const kiriSheetData* sheet, kiriPinData* pin)
{
    RestLine line = RestLineOf(sheet, pin);
    kiriVec2 middle = { 0.0, 0.0 };
    kiriVec3 x = { 0.0, 0.0, 0.0 };
    kiriMat3 A = { x, x, x };
    double sum = 0.0;
    for (int32_t k = 0; k < sheet->lineShares.count; ++k) {
        const kiriLineShare* share = &sheet->lineShares.data[k];
        const kiriFrameData* frame = &sheet->frames.data[share->frame];
        kiriVec2 point = PointAlong(&line, share->first / share->length);
        middle = kiriVec2_Add(middle, kiriVec2_Scale(share->length, point));
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

/* So many rows, and what they react with. */
static bool ReserveRows(kiriSheetData* sheet, int64_t pins, int64_t shares, int64_t frames, int64_t links)
{
    return kiriArray_Reserve(sheet->memory, &sheet->pinRows, pins + 2 * shares) &&
           kiriArray_Reserve(sheet->memory, &sheet->clampRows, shares) &&
           kiriArray_Reserve(sheet->memory, &sheet->pinReactions, pins + 2 * shares) &&
           kiriArray_Reserve(sheet->memory, &sheet->clampReactions, shares) &&
           kiriArray_Reserve(sheet->memory, &sheet->frameReactions, frames) &&
           (shares == 0 || kiriArray_Reserve(sheet->memory, &sheet->linkParts, links));
}

/* Appends the shares of a line; there is room. Returns the frame that it holds most of, or `none` where there are no
   shares. */
static int32_t AppendShares(const kiriSheetData* sheet, int32_t pin, kiriPinShares* shares, int32_t none)
{
    const kiriLineShare* longest = NULL;
    for (int32_t k = 0; k < sheet->lineShares.count; ++k) {
        kiriPinShare share;
        memset(&share, 0, sizeof(share));
        share.pin = pin;
        share.share = sheet->lineShares.data[k];
        if (longest == NULL || share.share.length > longest->length) {
            longest = &sheet->lineShares.data[k];
        }
        shares->data[shares->count++] = share;
    }
    return longest != NULL ? longest->frame : none;
}

void kiriPins_WriteLinkParts(kiriSheetData* sheet)
{
    const kiriSevered* severed = &sheet->layout.severed;
    sheet->linkParts.count = severed->count > 0 ? sheet->links.links.count : 0;
    for (int32_t k = 0; k < sheet->linkParts.count; ++k) {
        sheet->linkParts.data[k] = 1.0;
    }
    for (int32_t k = 0; k < severed->count; ++k) {
        double* part = &sheet->linkParts.data[severed->data[k].link];
        *part = *part > severed->data[k].part ? *part - severed->data[k].part : 0.0;
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
    if (!kiriArray_Reserve(sheet->memory, &sheet->pins, need) ||
        !kiriArray_Reserve(sheet->memory, &sheet->layout.pinFrame, need) ||
        !kiriArray_Reserve(sheet->memory, &sheet->layout.pinShares, shares) ||
        !ReserveRows(sheet, need, shares, sheet->frames.count, sheet->links.links.count)) {
        sheet->layout.severed.count = severed;
        return false;
    }
    int32_t index = sheet->pins.count++;
    sheet->pins.data[index] = *pin;
    if (pin->type != KIRI_PIN_POINT) {
        frame = AppendShares(sheet, index, &sheet->layout.pinShares, frame);
    }
    sheet->layout.pinFrame.data[sheet->layout.pinFrame.count++] = frame;
    kiriPins_WriteLinkParts(sheet);
    return true;
}

static void ForgetHistory(kiriFrameData* frame)
{
    memset(&frame->history, 0, sizeof(frame->history));
}

void kiriPins_ForgetHistory(kiriSheetData* sheet, int32_t index)
{
    const kiriPinShares* shares = &sheet->layout.pinShares;
    ForgetHistory(&sheet->frames.data[sheet->layout.pinFrame.data[index]]);
    for (int32_t k = 0; k < shares->count; ++k) {
        if (shares->data[k].pin == index) {
            ForgetHistory(&sheet->frames.data[shares->data[k].share.frame]);
        }
    }
}

/* Those of the last pin, which are last, take the place of those of the one that goes. */
static void RemoveShares(kiriPinShares* shares, int32_t index, int32_t last)
{
    int32_t kept = 0, moved;
    for (int32_t k = 0; k < shares->count; ++k) {
        if (shares->data[k].pin != index) {
            shares->data[kept++] = shares->data[k];
        }
    }
    shares->count = kept;
    for (int32_t k = 0; k < kept; ++k) {
        kiriPinShare share = shares->data[k];
        share.pin = share.pin == last ? index : share.pin;
        for (moved = k; moved > 0 && shares->data[moved - 1].pin > share.pin; --moved) {
            shares->data[moved] = shares->data[moved - 1];
        }
        shares->data[moved] = share;
    }
}

static void RemoveSevered(kiriSevered* severed, int32_t index, int32_t last)
{
    int32_t kept = 0, moved;
    for (int32_t k = 0; k < severed->count; ++k) {
        if (severed->data[k].pin != index) {
            severed->data[kept++] = severed->data[k];
        }
    }
    severed->count = kept;
    for (int32_t k = 0; k < kept; ++k) {
        kiriSeveredLink link = severed->data[k];
        link.pin = link.pin == last ? index : link.pin;
        for (moved = k; moved > 0 && severed->data[moved - 1].pin > link.pin; --moved) {
            severed->data[moved] = severed->data[moved - 1];
        }
        severed->data[moved] = link;
    }
}

void kiriPins_Remove(kiriSheetData* sheet, int32_t index)
{
    KIRI_ASSERT(index >= 0 && index < sheet->pins.count && sheet->layout.pinFrame.count == sheet->pins.count);
    int32_t last = --sheet->pins.count;
    sheet->layout.pinFrame.count = last;
    sheet->pins.data[index] = sheet->pins.data[last];
    sheet->layout.pinFrame.data[index] = sheet->layout.pinFrame.data[last];
    RemoveShares(&sheet->layout.pinShares, index, last);
    RemoveSevered(&sheet->layout.severed, index, last);
    kiriPins_WriteLinkParts(sheet);
}

/* ---- Staging ----------------------------------------------------------------------------------------------------- */

bool kiriPins_Stage(kiriSheetData* sheet)
{
    kiriLayout* next = &sheet->update->next;
    int32_t frames = sheet->update->placing.sites.count;
    next->pinShares.count = next->severed.count = 0;
    bool ok = kiriArray_Resize(sheet->memory, &next->pinFrame, sheet->pins.count);
    for (int32_t i = 0; ok && i < sheet->pins.count; ++i) {
        const kiriPinData* pin = &sheet->pins.data[i];
        if (pin->type == KIRI_PIN_POINT) {
            int32_t cell = kiriGrid_CellAround(&sheet->grid, &sheet->mesh, pin->at);
            next->pinFrame.data[i] = sheet->regions.field.owner.data[cell];
            continue;
        }
        ok = kiriOwner_FindShares(sheet, pin->at, pin->to, true) &&
             (pin->type == KIRI_PIN_HINGE || kiriSever_Across(sheet, pin->at, pin->to, i, true, &next->severed)) &&
             kiriArray_Reserve(sheet->memory, &next->pinShares,
                               (int64_t)next->pinShares.count + sheet->lineShares.count);
        if (ok) {
            next->pinFrame.data[i] = AppendShares(sheet, i, &next->pinShares, sheet->layout.pinFrame.data[i]);
        }
    }
    return ok && ReserveRows(sheet, sheet->pins.count, next->pinShares.count, frames, sheet->links.next.count);
}

/* ---- Rows -------------------------------------------------------------------------------------------------------- */

static kiriVec3 PartWay(kiriVec3 a, kiriVec3 b, double part)
{
    return part >= 1.0 ? b : kiriVec3_AddScaled(a, part, kiriVec3_Sub(b, a));
}

/* Where the pin is after a part of the tick, 0 to 1. */
static kiriVec3 TargetAfter(const kiriPinData* pin, double part)
{
    return PartWay(pin->lastTarget, pin->target, part);
}

static kiriMat3 RotationAfter(const kiriPinData* pin, double part)
{
    const kiriMat3 *a = &pin->lastRotation, *b = &pin->rotation;
    bool isSame = kiriVec3_Equal(a->u, b->u) && kiriVec3_Equal(a->v, b->v) && kiriVec3_Equal(a->d, b->d);
    if (isSame || part <= 0.0 || part >= 1.0) {
        return part >= 1.0 ? *b : *a;
    }
    kiriMat3 mean = { PartWay(a->u, b->u, part), PartWay(a->v, b->v, part), PartWay(a->d, b->d, part) };
    return kiriMat3_RotationFrom(*a, mean);
}

/* An obstacle that yields is another spring in series. */
static void WritePoint(kiriSheetData* sheet, int32_t pin, double to)
{
    const kiriPinData* data = &sheet->pins.data[pin];
    kiriVec3 target = kiriVec3_Add(kiriVec3_Add(TargetAfter(data, to), data->off), data->anchor.way);
    double stiffness = data->stiffness / (1.0 + data->stiffness * data->anchor.softness);
    kiriPinRow row = { sheet->layout.pinFrame.data[pin], kiriMesh_Local(&sheet->mesh, data->at), target, stiffness };
    sheet->pinRows.data[sheet->pinRows.count++] = row;
}

/* A hinge holds a line by springs all along it, as stiff as the material up to the site. Two springs, where two equal
   masses have the line's length, centroid and moment, are the same. */
static void WriteHinge(kiriSheetData* sheet, const kiriPinShare* pinned, double to)
{
    const kiriMaterial* material = &sheet->settings.material;
    const kiriPinData* pin = &sheet->pins.data[pinned->pin];
    kiriVec2 site = sheet->frames.data[pinned->share.frame].site.at;
    RestLine line = RestLineOf(sheet, pin);
    kiriClampShape shape = ShapeOf(sheet, &line, &pinned->share, site);
    double away = fabs(kiriVec2_Dot(kiriVec2_Sub(site, line.from), kiriVec2_Make(-line.along.y, line.along.x)));
    double length = kiriMax(away, shape.least);
    double stiffness = (double)material->youngsModulus * material->thickness * shape.width / length;
    kiriMat3 rotation = RotationAfter(pin, to);
    kiriVec2 arm = kiriVec2_Scale(sqrt(shape.moment / shape.width), line.along);
    const kiriVec2 at[2] = { kiriVec2_Sub(shape.centroid, arm), kiriVec2_Add(shape.centroid, arm) };
    for (int k = 0; k < 2; ++k) {
        kiriVec3 target = HeldPoint(&line, TargetAfter(pin, to), &rotation, at[k]);
        kiriPinRow spring = { pinned->share.frame, at[k], target, 0.5 * stiffness };
        sheet->pinRows.data[sheet->pinRows.count++] = spring;
    }
}

kiriVec2 kiriPin_Centroid(const kiriSheetData* sheet, const kiriPinShare* pinned)
{
    RestLine line = RestLineOf(sheet, &sheet->pins.data[pinned->pin]);
    return PointAlong(&line, pinned->share.first / pinned->share.length);
}

kiriVec3 kiriPin_PlaceOf(const kiriSheetData* sheet, const kiriPinData* pin, kiriVec2 point)
{
    RestLine line = RestLineOf(sheet, pin);
    return HeldPoint(&line, pin->target, &pin->rotation, point);
}

/* In a planar sheet, what is across the plane is dropped. */
static kiriVec3 IntoPlane(const kiriSheetData* sheet, const kiriFrameData* frame, kiriVec3 x)
{
    const kiriMechanics* mechanics = &sheet->settings.mechanics;
    kiriVec3 off = kiriVec3_Sub(x, frame->x);
    return mechanics->planar ? kiriVec3_AddScaled(x, -kiriVec3_Dot(off, mechanics->axes.d), mechanics->axes.d) : x;
}

/* What a clamp holds of a frame in a step from one part of the tick to another. */
static kiriClampRow ClampRowOf(const kiriSheetData* sheet, const kiriPinShare* pinned, const kiriFrameData* frame,
                               double from, double to)
{
    const kiriPinData* pin = &sheet->pins.data[pinned->pin];
    RestLine line = RestLineOf(sheet, pin);
    kiriClampShape shape = ShapeOf(sheet, &line, &pinned->share, frame->site.at);
    kiriClampRow row;
    memset(&row, 0, sizeof(row));
    row.frame = pinned->share.frame;
    kiriClamp_Shape(&row, &shape, frame->site.at);
    row.pose.A = RotationAfter(pin, to);
    row.start.A = RotationAfter(pin, from);
    kiriVec3 end = HeldPoint(&line, TargetAfter(pin, to), &row.pose.A, row.foot);
    kiriVec3 start = HeldPoint(&line, TargetAfter(pin, from), &row.start.A, row.foot);
    row.pose.x = IntoPlane(sheet, frame, kiriVec3_Add(end, pinned->off));
    row.start.x = IntoPlane(sheet, frame, kiriVec3_Add(start, pinned->off));
    memcpy(row.offset, pinned->offset, sizeof(row.offset));
    return row;
}

/* Rows are those of pieces that are awake: what sleeps keeps what it was held with. */
bool kiriPins_IsAwakePoint(const kiriSheetData* sheet, int32_t index)
{
    return sheet->pins.data[index].type == KIRI_PIN_POINT && kiriSheet_Moves(sheet, sheet->layout.pinFrame.data[index]);
}

/* A reaction at the start of a tick: only its history is left. */
static kiriReaction BeginReaction(const kiriReaction* last)
{
    const kiriWrench none = { { 0.0, 0.0, 0.0 }, { 0.0, 0.0, 0.0 } };
    kiriReaction reaction = { none, last->gain, last->pull, none };
    return reaction;
}

/* In the order of rows. */
void kiriPins_BeginReactions(kiriSheetData* sheet)
{
    KIRI_ASSERT(sheet->frameReactions.capacity >= sheet->frames.count);
    sheet->pinReactions.count = sheet->clampReactions.count = 0;
    for (int32_t i = 0; i < sheet->pins.count; ++i) {
        if (kiriPins_IsAwakePoint(sheet, i)) {
            sheet->pinReactions.data[sheet->pinReactions.count++] = BeginReaction(&sheet->pins.data[i].reaction);
        }
    }
    for (int32_t k = 0; k < sheet->layout.pinShares.count; ++k) {
        const kiriPinShare* pinned = &sheet->layout.pinShares.data[k];
        if (!kiriSheet_Moves(sheet, pinned->share.frame)) {
            continue;
        }
        if (sheet->pins.data[pinned->pin].type == KIRI_PIN_CLAMP) {
            sheet->clampReactions.data[sheet->clampReactions.count++] = BeginReaction(&pinned->reactions[0]);
        } else {
            sheet->pinReactions.data[sheet->pinReactions.count++] = BeginReaction(&pinned->reactions[0]);
            sheet->pinReactions.data[sheet->pinReactions.count++] = BeginReaction(&pinned->reactions[1]);
        }
    }
    sheet->frameReactions.count = sheet->frames.count;
    KIRI_EACH(i, kiriSolver_Awake(sheet->solver)->frames) {
        sheet->frameReactions.data[i] = BeginReaction(&sheet->frames.data[i].reaction);
    }
    KIRI_ASSERT(sheet->pinReactions.count == sheet->pinRows.count &&
                sheet->clampReactions.count == sheet->clampRows.count);
}

void kiriPins_WriteRows(kiriSheetData* sheet, double from, double to)
{
    const kiriPinShares* shares = &sheet->layout.pinShares;
    sheet->pinRows.count = sheet->clampRows.count = 0;
    for (int32_t i = 0; i < sheet->pins.count; ++i) {
        if (kiriPins_IsAwakePoint(sheet, i)) {
            WritePoint(sheet, i, to);
        }
    }
    for (int32_t k = 0; k < shares->count; ++k) {
        const kiriPinShare* pinned = &shares->data[k];
        if (!kiriSheet_Moves(sheet, pinned->share.frame)) {
            continue;
        }
        if (sheet->pins.data[pinned->pin].type == KIRI_PIN_HINGE) {
            WriteHinge(sheet, pinned, to);
        } else {
            const kiriFrameData* frame = &sheet->frames.data[pinned->share.frame];
            sheet->clampRows.data[sheet->clampRows.count++] = ClampRowOf(sheet, pinned, frame, from, to);
        }
    }
}

/* ---- Strains that clamps keep ------------------------------------------------------------------------------------ */

static void MeasureClamp(const kiriSheetData* sheet, const kiriPinShare* pinned, const kiriFrameData* frame,
                         double* strain)
{
    kiriClampRow row = ClampRowOf(sheet, pinned, frame, 0.0, 1.0);
    kiriPose pose = kiriPose_Of(frame);
    kiriClamp_Measure(&row, frame, &row.pose, &pose, strain, NULL);
}

static const kiriPinShare* FindPinned(const kiriPinShares* shares, int32_t pin, int32_t frame)
{
    for (int32_t k = 0; k < shares->count; ++k) {
        if (shares->data[k].pin == pin && shares->data[k].share.frame == frame) {
            return &shares->data[k];
        }
    }
    return NULL;
}

void kiriPins_KeepReactions(kiriSheetData* sheet, const kiriPinShares* old)
{
    for (int32_t k = 0; k < sheet->layout.pinShares.count; ++k) {
        kiriPinShare* pinned = &sheet->layout.pinShares.data[k];
        const kiriPinShare* older = FindPinned(old, pinned->pin, pinned->share.frame);
        if (older != NULL) {
            memcpy(pinned->reactions, older->reactions, sizeof(pinned->reactions));
            pinned->bore = older->bore;
            pinned->off = older->off;
        }
    }
}

void kiriPins_KeepStrains(kiriSheetData* sheet, const kiriPinShares* old)
{
    for (int32_t k = 0; k < sheet->layout.pinShares.count; ++k) {
        kiriPinShare* pinned = &sheet->layout.pinShares.data[k];
        int32_t frame = pinned->share.frame;
        if (sheet->pins.data[pinned->pin].type != KIRI_PIN_CLAMP) {
            continue;
        }
        const kiriPinShare* older = FindPinned(old, pinned->pin, frame);
        double was[KIRI_CLAMP_STRAINS] = { 0.0 };
        MeasureClamp(sheet, pinned, &sheet->frames.data[frame], pinned->offset);
        if (older != NULL) {
            MeasureClamp(sheet, older, kiriStrainOffsets_FrameBefore(&sheet->strainOffsets, sheet->frames.data, frame),
                         was);
        }
        for (int e = 0; e < KIRI_STRAINS; ++e) {
            pinned->offset[e] -= older != NULL ? was[e] - older->offset[e] : 0.0;
        }
    }
}

void kiriPins_FadeOffsets(kiriSheetData* sheet, double dt, double time)
{
    double keep = time / (time + dt);
    for (int32_t k = 0; k < sheet->layout.pinShares.count; ++k) {
        bool isAwake = kiriSheet_Moves(sheet, sheet->layout.pinShares.data[k].share.frame);
        for (int e = 0; isAwake && e < KIRI_CLAMP_STRAINS; ++e) {
            double* offset = &sheet->layout.pinShares.data[k].offset[e];
            *offset = fabs(*offset) > 1e-12 ? keep * *offset : 0.0;
        }
    }
}

double kiriPins_ElasticEnergy(const kiriSheetData* sheet)
{
    double sum = 0.0;
    for (int32_t k = 0; k < sheet->layout.pinShares.count; ++k) {
        const kiriPinShare* pinned = &sheet->layout.pinShares.data[k];
        const kiriFrameData* frame = &sheet->frames.data[pinned->share.frame];
        if (sheet->pins.data[pinned->pin].type == KIRI_PIN_CLAMP) {
            double pulling[KIRI_CLAMP_STRAINS];
            kiriClampRow row = ClampRowOf(sheet, pinned, frame, 0.0, 1.0);
            kiriPose pose = kiriPose_Of(frame);
            kiriClamp_Begin(&row, sheet->settings.mechanics.planar, &sheet->settings.material, 0.0, frame, &pose);
            kiriClamp_TakeOffsets(&row, row.startStrain, pulling);
            for (int e = 0; e < row.strainCount; ++e) {
                sum += 0.5 * row.stiffness[e] * pulling[e] * pulling[e];
            }
        }
    }
    return sum;
}

/* ---- Reactions --------------------------------------------------------------------------------------------------- */

/* Adds what a row bore about `at`, to be about the pin's target. */
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
    for (int32_t i = 0; i < sheet->pins.count; ++i) {
        kiriPinData* pin = &sheet->pins.data[i];
        if (kiriPins_IsAwakePoint(sheet, i)) {
            memset(&pin->bore, 0, sizeof(pin->bore));
            pin->reaction = sheet->pinReactions.data[row++];
            AddBorne(pin, &pin->reaction, pin->target, perTime, &pin->bore);
        }
    }
    for (int32_t k = 0; k < sheet->layout.pinShares.count; ++k) {
        kiriPinShare* pinned = &sheet->layout.pinShares.data[k];
        const kiriPinData* pin = &sheet->pins.data[pinned->pin];
        if (!kiriSheet_Moves(sheet, pinned->share.frame)) {
            continue;
        }
        memset(&pinned->bore, 0, sizeof(pinned->bore));
        if (pin->type == KIRI_PIN_CLAMP) {
            kiriVec3 at = sheet->clampRows.data[clamp].pose.x;
            pinned->reactions[0] = sheet->clampReactions.data[clamp++];
            AddBorne(pin, &pinned->reactions[0], at, perTime, &pinned->bore);
            continue;
        }
        for (int spring = 0; spring < 2; ++spring) {
            kiriVec3 at = sheet->pinRows.data[row].target;
            pinned->reactions[spring] = sheet->pinReactions.data[row++];
            AddBorne(pin, &pinned->reactions[spring], at, perTime, &pinned->bore);
        }
    }
    kiriPins_SumShares(sheet);
}

void kiriPins_SumShares(kiriSheetData* sheet)
{
    for (int32_t i = 0; i < sheet->pins.count; ++i) {
        if (sheet->pins.data[i].type != KIRI_PIN_POINT) {
            memset(&sheet->pins.data[i].bore, 0, sizeof(kiriWrench));
        }
    }
    for (int32_t k = 0; k < sheet->layout.pinShares.count; ++k) {
        const kiriPinShare* pinned = &sheet->layout.pinShares.data[k];
        kiriWrench_Add(&sheet->pins.data[pinned->pin].bore, 1.0, &pinned->bore);
    }
}

void kiriPins_TakeReactions(kiriSheetData* sheet, double dt)
{
    TakePinReactions(sheet, 1.0 / dt);
    KIRI_EACH(i, kiriSolver_Awake(sheet->solver)->frames) {
        kiriFrameData* frame = &sheet->frames.data[i];
        frame->reaction = sheet->frameReactions.data[i];
        memset(&frame->bore, 0, sizeof(frame->bore));
        kiriWrench_Add(&frame->bore, 1.0 / dt, &frame->reaction.impulse);
    }
    for (int32_t i = 0; i < sheet->pins.count; ++i) {
        sheet->pins.data[i].lastTarget = sheet->pins.data[i].target;
        sheet->pins.data[i].lastRotation = sheet->pins.data[i].rotation;
    }
}

void kiriPins_ClearReactions(kiriSheetData* sheet)
{
    kiriPins_BeginReactions(sheet);
    kiriPins_TakeReactions(sheet, 1.0);
}
