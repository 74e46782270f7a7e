#include "kiri_carry.h"

#include "kiri_motion.h"
#include "kiri_seen.h"

#include <string.h>

/* ---- Place ------------------------------------------------------------------------------------------------------- */

static void TurnVector(const kiriMat3* R, kiriVec3* a)
{
    *a = kiriMat3_Mul(*R, *a);
}

static void TurnColumns(const kiriMat3* R, kiriMat3* A)
{
    *A = kiriMat3_MulMat(*R, *A);
}

static void CarryFrame(kiriFrameData* frame, const kiriMat3* R, kiriVec3 t, bool isRigid)
{
    frame->x = kiriVec3_Add(kiriMat3_Mul(*R, frame->x), t);
    TurnColumns(R, &frame->A);
    frame->A = isRigid ? kiriMat3_Rotation(frame->A) : frame->A;
    TurnVector(R, &frame->velocity);
    TurnVector(R, &frame->spin);
    TurnColumns(R, &frame->rate);
    TurnVector(R, &frame->history.gain);
    TurnVector(R, &frame->history.lag);
    TurnVector(R, &frame->history.pull);
    TurnColumns(R, &frame->history.turnGain);
    TurnColumns(R, &frame->history.turnLag);
    TurnColumns(R, &frame->history.turnPull);
    TurnVector(R, &frame->heldOff);
}

/* ---- What holds it ---- */

static void TurnWrench(const kiriMat3* R, kiriWrench* wrench)
{
    TurnVector(R, &wrench->force);
    TurnVector(R, &wrench->moment);
}

static void TurnReaction(const kiriMat3* R, kiriReaction* reaction)
{
    TurnWrench(R, &reaction->gain);
    TurnWrench(R, &reaction->pull);
}

static double SquareApart(kiriVec3 a, kiriVec3 b)
{
    kiriVec3 d = kiriVec3_Sub(a, b);
    return kiriVec3_Dot(d, d);
}

/* How far apart two poses are, of something so large. */
static double PosesApart(kiriVec3 a, const kiriMat3* A, kiriVec3 b, const kiriMat3* B, double size)
{
    double turned = SquareApart(A->u, B->u) + SquareApart(A->v, B->v);
    return SquareApart(a, b) + size * size * turned;
}

static void CarryPose(const kiriMat3* R, kiriVec3 t, kiriVec3* x, kiriMat3* A)
{
    *x = kiriVec3_Add(kiriMat3_Mul(*R, *x), t);
    TurnColumns(R, A);
    *A = kiriMat3_Rotation(*A);
}

/* Carries the pose at which something is held, and its goal for the next tick. A goal that is nearer to the new pose
   than to the old one stays: the host has moved it already. */
static void CarryHeld(const kiriMat3* R, kiriVec3 t, double size, kiriVec3* at, kiriMat3* axes, kiriVec3* goal,
                      kiriMat3* goalAxes)
{
    kiriVec3 was = *at;
    kiriMat3 wasAxes = *axes;
    CarryPose(R, t, at, axes);
    if (!(PosesApart(*goal, goalAxes, *at, axes, size) < PosesApart(*goal, goalAxes, was, &wasAxes, size))) {
        CarryPose(R, t, goal, goalAxes);
    }
}

void kiriCarry_Pin(kiriSheetData* sheet, int32_t index, const kiriMat3* R, kiriVec3 t)
{
    kiriPinData* pin = &sheet->pins.data[index];
    kiriVec2 way = kiriVec2_Sub(kiriMesh_Local(&sheet->mesh, pin->to), kiriMesh_Local(&sheet->mesh, pin->at));
    CarryHeld(R, t, 0.5 * kiriVec2_Length(way), &pin->lastTarget, &pin->lastRotation, &pin->target, &pin->rotation);
}

static void CarryHold(kiriFrameData* frame, const kiriMat3* R, kiriVec3 t)
{
    CarryHeld(R, t, kiriRoot(frame->area), &frame->heldPosition, &frame->heldRotation, &frame->goalPosition,
              &frame->goalRotation);
    TurnReaction(R, &frame->reaction);
    TurnWrench(R, &frame->bore);
}

static void TurnPins(kiriSheetData* sheet, const kiriMat3* R)
{
    for (int32_t i = 0; i < sheet->pins.count; ++i) {
        kiriPinData* pin = &sheet->pins.data[i];
        TurnVector(R, &pin->off);
        TurnReaction(R, &pin->reaction);
        TurnWrench(R, &pin->bore);
    }
    for (int32_t k = 0; k < sheet->layout.pinShares.count; ++k) {
        kiriPinShare* share = &sheet->layout.pinShares.data[k];
        TurnVector(R, &share->off);
        TurnReaction(R, &share->reactions[0]);
        TurnReaction(R, &share->reactions[1]);
        TurnWrench(R, &share->bore);
    }
}

/* ---- All of it ---- */

bool kiriCarry_FitsSheet(const kiriSheetData* sheet, const kiriMat3* R, kiriVec3 t)
{
    for (int32_t i = 0; i < sheet->frames.count; ++i) {
        kiriFrameData moved = sheet->frames.data[i];
        CarryFrame(&moved, R, t, false);
        if (!kiriFrame_FitsFloats(&moved)) {
            return false;
        }
    }
    for (int32_t i = 0; i < sheet->pins.count; ++i) {
        if (!kiriVec3_FitsFloats(kiriVec3_Add(kiriMat3_Mul(*R, sheet->pins.data[i].target), t))) {
            return false;
        }
    }
    return true;
}

static void TurnFades(kiriFades* fades, const kiriMat3* R)
{
    for (int32_t k = 0; k < fades->fading.count; ++k) {
        TurnVector(R, &fades->fading.data[k].offset);
    }
}

/* Another block for an array of which all is written anew. */
static float* Renewed(kiriMemory* memory, int32_t capacity)
{
    return kiriMemory_Alloc(memory, (int64_t)sizeof(float) * (capacity > 0 ? capacity : 1));
}

static void Retire(kiriMemory* retired, float** array, float* renewed)
{
    if (*array != NULL) {
        kiriMemory_Adopt(retired, *array);
    }
    *array = renewed;
}

bool kiriCarry_Renew(kiriSheetData* sheet, kiriMemory* retired)
{
    kiriSurface* surface = &sheet->seen.surface;
    float* positions = Renewed(&sheet->shown, surface->positions.capacity);
    float* normals = Renewed(&sheet->shown, surface->normals.capacity);
    float* points = Renewed(&sheet->shown, sheet->seen.pointPositions.capacity);
    if (positions == NULL || normals == NULL || points == NULL) {
        kiriMemory_Free(&sheet->shown, positions);
        kiriMemory_Free(&sheet->shown, normals);
        kiriMemory_Free(&sheet->shown, points);
        return false;
    }
    Retire(retired, &surface->positions.data, positions);
    Retire(retired, &surface->normals.data, normals);
    Retire(retired, &sheet->seen.pointPositions.data, points);
    surface->isWritten = surface->isSteady = false;
    return true;
}

bool kiriCarry_Sheet(kiriSheetData* sheet, const kiriMat3* R, kiriVec3 t, kiriMemory* retired)
{
    if (!kiriCarry_Renew(sheet, retired)) {
        return false;
    }
    for (int32_t i = 0; i < sheet->frames.count; ++i) {
        kiriFrameData* frame = &sheet->frames.data[i];
        CarryFrame(frame, R, t, sheet->settings.mechanics.model == KIRI_MODEL_LINKS);
        if (frame->held) {
            CarryHold(frame, R, t);
        }
    }
    TurnPins(sheet, R);
    TurnFades(&sheet->seen.fades, R);
    TurnFades(&sheet->seen.pointFades, R);
    kiriView_WritePositions(sheet);
    kiriMotion_Wake(sheet);
    return true;
}

/* ---- Another origin ---------------------------------------------------------------------------------------------- */

static void Shift(kiriVec3* at, kiriVec3 origin)
{
    *at = kiriVec3_Sub(*at, origin);
}

static void ShiftTouches(kiriTouch* touches, int32_t count, kiriVec3 origin)
{
    for (int32_t i = 0; i < count; ++i) {
        Shift(&touches[i].seen, origin);
        touches[i].offset -= kiriVec3_Dot(touches[i].normal, origin);
    }
}

static void ShiftContacts(kiriSheetData* sheet, kiriVec3 origin)
{
    kiriTouches* touches = &sheet->touches;
    ShiftTouches(touches->found.data, touches->found.count, origin);
    ShiftTouches(touches->last.touches.data, touches->last.touches.count, origin);
    ShiftTouches(touches->slept.touches.data, touches->slept.touches.count, origin);
    touches->rests.areSummed = false; /* about centres of mass of obstacles */
    for (int32_t i = 0; i < sheet->contacts.count; ++i) {
        kiriContact* contact = &sheet->contacts.data[i].contact;
        contact->offset = (float)(contact->offset - kiriVec3_Dot(kiriVec3_Load(contact->normal), origin));
    }
}

void kiriCarry_Shift(kiriSheetData* sheet, kiriVec3 origin)
{
    for (int32_t i = 0; i < sheet->frames.count; ++i) {
        kiriFrameData* frame = &sheet->frames.data[i];
        Shift(&frame->x, origin);
        if (frame->held) {
            Shift(&frame->heldPosition, origin);
            Shift(&frame->goalPosition, origin);
        }
    }
    for (int32_t i = 0; i < sheet->pins.count; ++i) {
        Shift(&sheet->pins.data[i].target, origin);
        Shift(&sheet->pins.data[i].lastTarget, origin);
    }
    ShiftContacts(sheet, origin);
    kiriView_WritePositions(sheet);
}

/* ---- Velocity ---------------------------------------------------------------------------------------------------- */

static bool IsOf(const kiriSheetData* sheet, int32_t frame, int32_t piece)
{
    return piece == KIRI_NONE || sheet->layout.framePiece.data[frame] == piece;
}

static kiriVec3 CenterOf(const kiriSheetData* sheet, int32_t piece)
{
    kiriVec3 sum = { 0.0, 0.0, 0.0 };
    double mass = 0.0;
    for (int32_t i = 0; i < sheet->frames.count; ++i) {
        if (IsOf(sheet, i, piece)) {
            sum = kiriVec3_AddScaled(sum, sheet->frames.data[i].mass, sheet->frames.data[i].x);
            mass += sheet->frames.data[i].mass;
        }
    }
    return kiriVec3_Scale(1.0 / mass, sum);
}

static void GiveVelocity(kiriFrameData* frame, kiriVec3 center, kiriVec3 velocity, kiriVec3 spin)
{
    frame->velocity = kiriVec3_Add(velocity, kiriVec3_Cross(spin, kiriVec3_Sub(frame->x, center)));
    frame->spin = spin;
    memset(&frame->rate, 0, sizeof(frame->rate));
    memset(&frame->history, 0, sizeof(frame->history));
}

static bool FitsVelocity(const kiriSheetData* sheet, int32_t piece, kiriVec3 center, kiriVec3 velocity, kiriVec3 spin)
{
    for (int32_t i = 0; i < sheet->frames.count; ++i) {
        kiriFrameData given = sheet->frames.data[i];
        GiveVelocity(&given, center, velocity, spin);
        if (IsOf(sheet, i, piece) && !kiriFrame_FitsFloats(&given)) {
            return false;
        }
    }
    return true;
}

/* In a planar sheet, what is across the plane is dropped. */
bool kiriCarry_SetVelocity(kiriSheetData* sheet, int32_t piece, kiriVec3 velocity, kiriVec3 spin)
{
    const kiriMechanics* mechanics = &sheet->settings.mechanics;
    kiriVec3 d = mechanics->axes.d, center = CenterOf(sheet, piece);
    if (mechanics->planar) {
        velocity = kiriVec3_AddScaled(velocity, -kiriVec3_Dot(velocity, d), d);
        spin = kiriVec3_Scale(kiriVec3_Dot(spin, d), d);
    }
    if (!FitsVelocity(sheet, piece, center, velocity, spin)) {
        return false;
    }
    for (int32_t i = 0; i < sheet->frames.count; ++i) {
        if (IsOf(sheet, i, piece)) {
            GiveVelocity(&sheet->frames.data[i], center, velocity, spin);
            kiriMotion_WakeFrame(sheet, i);
        }
    }
    return true;
}
