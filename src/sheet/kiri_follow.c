#include "kiri_follow.h"

#define SETTLING 0.05  /* s: within which targets go over to what is seen */
#define CLAMP_RATE 0.2 /* of that of pins: a clamp bends the sheet, and with it the surface that it asks */
#define LEAST 1e-5     /* of the longer side: less is not seen, and stays */

/* ---- What is seen is what is held ---- */

/* The share of a frame in what is seen at a point. */
static double ShareAt(const kiriSheetData* sheet, const kiriPointPlace* place, int32_t frame)
{
    double sum = 0.0;
    for (int k = 0; k < 3; ++k) {
        kiriSpan span = sheet->vertexSkin.spans.data[sheet->mesh.triangles.data[place->triangle].vertex[k]];
        for (int32_t i = span.first; i < span.first + span.count; ++i) {
            const kiriSampleWeight* weight = &sheet->vertexSkin.weights.data[i];
            sum += kiriSheet_FrameOf(sheet, weight->label) == frame ? place->shares[k] * weight->value : 0.0;
        }
    }
    return sum;
}

/* False where nothing of the frame is seen: outside, or at the other lip of a cut. */
static bool FindSeen(const kiriSheetData* sheet, int32_t frame, kiriLatticePoint at, kiriVec3* seen)
{
    kiriPointPlace place;
    if (!kiriPoint_Find(sheet, at, &place) || !(ShareAt(sheet, &place, frame) > 0.0)) {
        return false;
    }
    *seen = kiriPoint_Position(sheet, &place);
    return true;
}

/* A line may run along an edge of the sheet: a little towards the site there is material for certain. */
static bool FindSeenBeside(const kiriSheetData* sheet, int32_t frame, kiriVec2 at, kiriVec3* seen)
{
    kiriVec2 way = kiriVec2_Sub(sheet->frames.data[frame].site.at, at);
    double length = kiriVec2_Length(way), aside = sheet->grid.side / 1024.0;
    kiriVec2 beside = kiriVec2_Add(at, kiriVec2_Scale(length > aside ? aside / length : 1.0, way));
    return FindSeen(sheet, frame, kiriMesh_Snap(&sheet->mesh, beside), seen);
}

/* Takes a part of the way to what was measured; all of it where nothing was known. */
static void Settle(const kiriSheetData* sheet, kiriVec3* off, kiriVec3 measured, bool isKnown, double dt)
{
    kiriVec3 change = kiriVec3_Sub(measured, *off);
    if (!isKnown) {
        *off = measured;
    } else if (kiriVec3_Length(change) > LEAST * kiriSheet_Extent(sheet)) {
        *off = kiriVec3_AddScaled(*off, dt < SETTLING ? dt / SETTLING : 1.0, change);
    }
}

static void SettlePoint(kiriSheetData* sheet, int32_t index, double dt)
{
    kiriPinData* pin = &sheet->pins.data[index];
    int32_t frame = sheet->layout.pinFrame.data[index];
    const kiriFrameData* data = &sheet->frames.data[frame];
    kiriVec3 seen;
    if (FindSeen(sheet, frame, pin->at, &seen)) {
        kiriVec3 own = kiriFrame_Carry(data, kiriMesh_Local(&sheet->mesh, pin->at));
        Settle(sheet, &pin->off, kiriVec3_Sub(own, seen), pin->offFrame == data->id, dt);
        pin->offFrame = data->id;
    }
}

/* Do they hold the same piece for the same clamp? */
static bool IsSameHold(const kiriSheetData* sheet, const kiriPinShare* a, const kiriPinShare* b)
{
    const int32_t* pieces = sheet->layout.framePiece.data;
    return a->pin == b->pin && pieces[a->share.frame] == pieces[b->share.frame];
}

static bool IsFirstOfHold(const kiriSheetData* sheet, int32_t k)
{
    const kiriPinShare* shares = sheet->layout.pinShares.data;
    for (int32_t i = k - 1; i >= 0 && shares[i].pin == shares[k].pin; --i) {
        if (IsSameHold(sheet, &shares[i], &shares[k])) {
            return false;
        }
    }
    return true;
}

/* Where the pose has to be moved for the piece to be seen on the line: the mean along it. */
static bool FindHoldOff(const kiriSheetData* sheet, int32_t first, kiriVec3* off)
{
    const kiriPinShares* shares = &sheet->layout.pinShares;
    kiriVec3 sum = { 0.0, 0.0, 0.0 }, seen;
    double length = 0.0;
    for (int32_t k = first; k < shares->count && shares->data[k].pin == shares->data[first].pin; ++k) {
        const kiriPinShare* pinned = &shares->data[k];
        kiriVec2 at = kiriPin_Centroid(sheet, pinned);
        if (IsSameHold(sheet, &shares->data[first], pinned) && FindSeenBeside(sheet, pinned->share.frame, at, &seen)) {
            kiriVec3 missing = kiriVec3_Sub(kiriPin_PlaceOf(sheet, &sheet->pins.data[pinned->pin], at), seen);
            sum = kiriVec3_AddScaled(sum, pinned->share.length, kiriVec3_Add(pinned->off, missing));
            length += pinned->share.length;
        }
    }
    *off = length > 0.0 ? kiriVec3_Scale(1.0 / length, sum) : sum;
    return length > 0.0;
}

/* All that it holds of a piece is moved as one. Were each share moved by what is missing there, the line would bend: a
   sheet that is curled along its clamp is far too stiff, and turns its surface there, which asks for more. */
static void SettleClamp(kiriSheetData* sheet, int32_t first, double dt)
{
    kiriPinShares* shares = &sheet->layout.pinShares;
    kiriVec3 off;
    if (!FindHoldOff(sheet, first, &off)) {
        return;
    }
    for (int32_t k = first; k < shares->count && shares->data[k].pin == shares->data[first].pin; ++k) {
        if (IsSameHold(sheet, &shares->data[first], &shares->data[k])) {
            Settle(sheet, &shares->data[k].off, off, true, CLAMP_RATE * dt);
        }
    }
}

static void SettleFrame(kiriSheetData* sheet, int32_t f, double dt)
{
    kiriFrameData* frame = &sheet->frames.data[f];
    kiriVec3 seen;
    if (frame->held && FindSeen(sheet, f, kiriMesh_Snap(&sheet->mesh, frame->site.at), &seen)) {
        kiriVec3 own = kiriFrame_Carry(frame, frame->site.at);
        Settle(sheet, &frame->heldOff, kiriVec3_Sub(own, seen), frame->isOffKnown, dt);
        frame->isOffKnown = true;
    }
}

static void DropOffs(kiriSheetData* sheet)
{
    const kiriVec3 none = { 0.0, 0.0, 0.0 };
    for (int32_t i = 0; i < sheet->pins.count; ++i) {
        sheet->pins.data[i].off = none;
        sheet->pins.data[i].offFrame = 0;
    }
    for (int32_t k = 0; k < sheet->layout.pinShares.count; ++k) {
        sheet->layout.pinShares.data[k].off = none;
    }
    KIRI_EACH(f, kiriSolver_Awake(sheet->solver)->frames) {
        sheet->frames.data[f].heldOff = none;
        sheet->frames.data[f].isOffKnown = false;
    }
}

void kiriFollow_Begin(kiriSheetData* sheet, double dt)
{
    if (sheet->settings.skinning == KIRI_SKINNING_LINEAR) {
        DropOffs(sheet);
        return;
    }
    for (int32_t i = 0; i < sheet->pins.count; ++i) {
        if (kiriPins_IsAwakePoint(sheet, i)) {
            SettlePoint(sheet, i, dt);
        }
    }
    for (int32_t k = 0; k < sheet->layout.pinShares.count; ++k) {
        const kiriPinShare* pinned = &sheet->layout.pinShares.data[k];
        bool isClamp = sheet->pins.data[pinned->pin].type == KIRI_PIN_CLAMP;
        if (isClamp && kiriSheet_Moves(sheet, pinned->share.frame) && IsFirstOfHold(sheet, k)) {
            SettleClamp(sheet, k, dt);
        }
    }
    KIRI_EACH(f, kiriSolver_Awake(sheet->solver)->frames) {
        SettleFrame(sheet, f, dt);
    }
}

/* ---- Steps ---- */

static bool IsSameMat(const kiriMat3* a, const kiriMat3* b)
{
    return kiriVec3_Equal(a->u, b->u) && kiriVec3_Equal(a->v, b->v) && kiriVec3_Equal(a->d, b->d);
}

/* Its part of the way that is left: the last step ends at the goal. */
static void MoveHeld(kiriFrameData* frame, int32_t left)
{
    kiriVec3 goal = kiriVec3_Add(frame->goalPosition, frame->heldOff);
    if (left == 1) {
        frame->heldPosition = goal;
        frame->heldRotation = frame->goalRotation;
        return;
    }
    double part = 1.0 / left;
    kiriVec3 way = kiriVec3_Sub(goal, frame->heldPosition);
    frame->heldPosition = kiriVec3_AddScaled(frame->heldPosition, part, way);
    if (!IsSameMat(&frame->heldRotation, &frame->goalRotation)) {
        kiriMat3 mean = kiriMat3_Scale(1.0 - part, &frame->heldRotation);
        mean = kiriMat3_AddScaled(&mean, part, &frame->goalRotation);
        frame->heldRotation = kiriMat3_RotationFrom(frame->heldRotation, mean);
    }
}

static bool IsAnyPinMoved(const kiriSheetData* sheet)
{
    bool any = false;
    for (int32_t i = 0; i < sheet->pins.count; ++i) {
        const kiriPinData* pin = &sheet->pins.data[i];
        any |= !kiriVec3_Equal(pin->target, pin->lastTarget) || !IsSameMat(&pin->rotation, &pin->lastRotation);
    }
    return any;
}

/* By the end of the step, `after` s after the start of the tick. Pins that hold points of what is awake have the first
   rows, in their order. */
static bool Yield(kiriSheetData* sheet, double after, double h)
{
    bool any = false;
    int32_t row = 0;
    for (int32_t i = 0; i < sheet->pins.count; ++i) {
        kiriPinAnchor* anchor = &sheet->pins.data[i].anchor;
        if (!kiriPins_IsAwakePoint(sheet, i)) {
            continue;
        }
        if (anchor->most > 0.0) {
            kiriVec3 given = kiriVec3_Scale(-1.0, sheet->pinReactions.data[row].impulse.force);
            anchor->way = kiriVec3_Scale(after, kiriMat3_Mul(anchor->give, given));
            anchor->softness = after * h * anchor->most;
            any = true;
        }
        ++row;
    }
    return any;
}

/* Rows of pins that rest are the same in all steps, and are there. */
void kiriFollow_Step(kiriSheetData* sheet, int32_t i, int32_t n, double h)
{
    if (Yield(sheet, (i + 1) * h, h) || IsAnyPinMoved(sheet)) {
        kiriPins_WriteRows(sheet, (double)i / n, i + 1 == n ? 1.0 : (i + 1.0) / n);
    }
    KIRI_EACH(f, kiriSolver_Awake(sheet->solver)->frames) {
        if (sheet->frames.data[f].held) {
            MoveHeld(&sheet->frames.data[f], n - i);
        }
    }
}
