#include "defaults.h"
#include "storm.h"

#include "core/kiri_float.h" /* the storm gives the same bits on every machine */

#include "hash.h"

/* ---- Random numbers ---- */

/* xorshift32. */
uint32_t Storm_Random(Storm* storm, uint32_t below)
{
    storm->seed ^= storm->seed << 13;
    storm->seed ^= storm->seed >> 17;
    storm->seed ^= storm->seed << 5;
    return storm->seed % below;
}

float Storm_Between(Storm* storm, float low, float high)
{
    return low + (high - low) * ((float)Storm_Random(storm, 65537) / 65536.0f);
}

void Storm_Vector(Storm* storm, float size, float vector[3])
{
    for (int i = 0; i < 3; i++) {
        vector[i] = Storm_Between(storm, -size, size);
    }
}

/* Of the quaternion (16, x, y, z): a few degrees. */
void Storm_Rotation(Storm* storm, float rotation[9])
{
    float q[3] = { 0.0f, 0.0f, Storm_Between(storm, -1.0f, 1.0f) };
    if (!storm->type->planar) {
        Storm_Vector(storm, 1.0f, q);
    }
    float square = q[0] * q[0] + q[1] * q[1] + q[2] * q[2], all = 256.0f + square;
    for (int column = 0; column < 3; column++) {
        for (int row = 0; row < 3; row++) {
            float even = row == column ? 256.0f - square : 0.0f;
            float odd = row == column ? 0.0f : (column == (row + 1) % 3 ? -32.0f : 32.0f) * q[3 - row - column];
            rotation[3 * column + row] = (even + 2.0f * q[row] * q[column] + odd) / all;
        }
    }
}

/* ---- What there is ---- */

kiriResult Storm_Note(Storm* storm, kiriResult result)
{
    kiriHash_Int32(&storm->results, result);
    return result;
}

static void NoteFloats(Storm* storm, const float* floats, int32_t count)
{
    for (int32_t i = 0; i < count; i++) {
        kiriHash_Double(&storm->results, floats[i]);
    }
}

kiriSheet Storm_AnySheet(Storm* storm)
{
    return storm->sheetCount > 0 ? storm->sheets[Storm_Random(storm, (uint32_t)storm->sheetCount)] : 0;
}

static kiriObstacle AnyObstacle(Storm* storm)
{
    return storm->obstacleCount > 0 ? storm->obstacles[Storm_Random(storm, (uint32_t)storm->obstacleCount)] : 0;
}

void Storm_AnyRestPoint(Storm* storm, float point[2])
{
    point[0] = Storm_Between(storm, -0.05f, 1.05f);
    point[1] = Storm_Between(storm, -0.05f, 1.05f);
}

void Storm_AnyPlace(Storm* storm, float place[3])
{
    float lower[3] = { 0.0f, 0.0f, 0.0f }, upper[3] = { 1.0f, 1.0f, 1.0f };
    kiriSheet_GetReach(storm->world, Storm_AnySheet(storm), 1.0f / 60.0f, lower, upper);
    for (int i = 0; i < 3; i++) {
        place[i] = Storm_Between(storm, lower[i], upper[i]);
    }
}

kiriFrame Storm_AnyFrame(Storm* storm)
{
    enum { FRAMES = 64 };
    kiriFrame frames[FRAMES];
    int32_t count = 0;
    kiriSheet_GetFrames(storm->world, Storm_AnySheet(storm), frames, FRAMES, &count);
    count = count < FRAMES ? count : FRAMES;
    return count > 0 ? frames[Storm_Random(storm, (uint32_t)count)] : 0;
}

static kiriPin AnyPin(Storm* storm)
{
    enum { PINS = 32 };
    kiriPin pins[PINS];
    int32_t count = 0;
    kiriSheet_GetPins(storm->world, Storm_AnySheet(storm), pins, PINS, &count);
    count = count < PINS ? count : PINS;
    return count > 0 ? pins[Storm_Random(storm, (uint32_t)count)] : 0;
}

void Storm_KeepSheet(Storm* storm, kiriSheet sheet)
{
    if (sheet == 0) {
        return;
    }
    if (storm->sheetCount < STORM_SHEETS) {
        storm->sheets[storm->sheetCount++] = sheet;
    } else {
        Storm_Note(storm, kiriDestroySheet(storm->world, sheet));
    }
}

/* ---- Sheets ---- */

static void DescribeSheet(Storm* storm, kiriSheetDef* def)
{
    const StormType* type = storm->type;
    kiriDefaultSheetDef(def);
    /* Stiff ones, squeezed by obstacles that jump, would fly off at kilometres a second. */
    uint32_t preset =
        type->obstacles ? KIRI_MATERIAL_COTTON + Storm_Random(storm, 2) : Storm_Random(storm, KIRI_MATERIAL_COUNT);
    kiriGetMaterial((int32_t)preset, &def->material);
    def->position[0] = Storm_Between(storm, -0.3f, 0.3f);
    def->position[1] = Storm_Between(storm, -0.3f, 0.3f);
    def->position[2] = 0.1f * (float)storm->sheetCount + Storm_Between(storm, 0.1f, 0.15f);
    def->gridResolution = 12 + (int32_t)Storm_Random(storm, 12);
    def->frameCount = (int32_t)Storm_Random(storm, 9);
    def->accuracy = 0.1f;
    def->maxFrames = 24;
    def->crumbArea = 0.01f;
    def->collisionPoints = type->obstacles ? 20 : 0;
    def->touchesSheets = type->touches;
    def->model = type->model;
    def->skinning = type->skinning;
    def->timeStepping = type->timeStepping;
    def->planar = type->planar;
    def->normals = Storm_Random(storm, 4) > 0;
    def->paper.fromScratch = type->fromScratch;
    def->paper.popping = type->fromScratch && Storm_Random(storm, 2) == 0;
    def->paper.linearWeights = Storm_Random(storm, 4) == 0;
    def->paper.integrationOrder = 1 + (int32_t)Storm_Random(storm, 2);
}

/* A draw for each statement: in one list of values compilers choose the order. */
static kiriFold RandomFold(Storm* storm)
{
    kiriFold fold = { 0 };
    for (int axis = 0; axis < 2; axis++) {
        fold.from[axis] = Storm_Between(storm, -0.1f, 1.1f);
        fold.to[axis] = Storm_Between(storm, -0.1f, 1.1f);
    }
    fold.stiffness = Storm_Between(storm, 0.0f, 1e-3f);
    fold.restAngle = Storm_Between(storm, -3.0f, 3.0f);
    fold.yieldMoment = Storm_Between(storm, 0.0f, 1e-4f);
    return fold;
}

void Storm_AddSheet(Storm* storm)
{
    enum { CORNERS = STORM_SQUARES + 1 };
    float positions[2 * CORNERS * CORNERS];
    int32_t indices[6 * STORM_SQUARES * STORM_SQUARES];
    kiriFillRectangle(1.0f, 1.0f, STORM_SQUARES, STORM_SQUARES, positions, indices);
    for (int32_t j = 1; j < STORM_SQUARES; j++) {
        for (int32_t i = 1; i < STORM_SQUARES; i++) {
            positions[2 * (CORNERS * j + i)] += Storm_Between(storm, -0.02f, 0.02f);
            positions[2 * (CORNERS * j + i) + 1] += Storm_Between(storm, -0.02f, 0.02f);
        }
    }
    kiriSheetDef def;
    DescribeSheet(storm, &def);
    def.restPositions = positions;
    def.indices = indices;
    def.vertexCount = CORNERS * CORNERS;
    def.triangleCount = 2 * STORM_SQUARES * STORM_SQUARES;
    kiriSheet sheet = 0;
    kiriFold folds[4];
    for (int i = 0; storm->type->folds && i < 4; i++) {
        folds[i] = RandomFold(storm);
    }
    Storm_Note(storm, storm->type->folds ? kiriCreateFoldedSheet(storm->world, &def, folds, 4, &sheet)
                                         : kiriCreateSheet(storm->world, &def, &sheet));
    Storm_KeepSheet(storm, sheet);
}

static void ReplaceSheet(Storm* storm)
{
    if (Storm_Random(storm, 4) == 0 && storm->sheetCount > 1) {
        uint32_t i = Storm_Random(storm, (uint32_t)storm->sheetCount);
        Storm_Note(storm, kiriDestroySheet(storm->world, storm->sheets[i]));
        storm->sheets[i] = storm->sheets[--storm->sheetCount];
        Storm_AddSheet(storm);
    }
}

static void ChangeSettings(Storm* storm)
{
    kiriSheet sheet = Storm_AnySheet(storm);
    kiriSheetSettings settings;
    if (kiriSheet_GetSettings(storm->world, sheet, &settings) != KIRI_OK) {
        return;
    }
    settings.iterations = 1 + (int32_t)Storm_Random(storm, 4);
    settings.friction = Storm_Between(storm, 0.0f, 1.0f);
    settings.fadeTime = Storm_Random(storm, 2) == 0 ? 0.1f : settings.fadeTime;
    settings.material.airDamping = Storm_Between(storm, 0.0f, 1.0f);
    settings.material.flexDamping = Storm_Between(storm, 0.0f, 0.002f);
    settings.material.yieldStress = Storm_Random(storm, 2) == 0 ? 0.0f : 1e7f;
    settings.material.detail = settings.iterations % 3;
    Storm_Note(storm, kiriSheet_SetSettings(storm->world, sheet, &settings));
    if (storm->type->folds) {
        kiriFold fold = RandomFold(storm);
        int32_t index;
        Storm_Note(storm, kiriSheet_AddFold(storm->world, sheet, &fold, &index));
        float angle = Storm_Between(storm, -1.0f, 1.0f);
        Storm_Note(storm, kiriSheet_SetFold(storm->world, sheet, (int32_t)Storm_Random(storm, 4), 1e-4f, angle));
    }
}

/* One without pins, which would draw it back with all their stiffness. */
static void MoveSheet(Storm* storm)
{
    float rotation[9], way[3];
    int32_t pins = 0;
    kiriSheet sheet = Storm_AnySheet(storm);
    kiriSheet_GetPins(storm->world, sheet, NULL, 0, &pins);
    if (pins > 0) {
        return;
    }
    Storm_Rotation(storm, rotation);
    Storm_Vector(storm, 0.01f, way);
    way[2] = storm->type->planar ? 0.0f : way[2];
    Storm_Note(storm, kiriSheet_Transform(storm->world, sheet, rotation, way));
}

static void Throw(Storm* storm)
{
    float velocity[3], spin[3];
    Storm_Vector(storm, 1.0f, velocity);
    Storm_Vector(storm, 2.0f, spin);
    if (Storm_Random(storm, 2) == 0) {
        Storm_Note(storm, kiriSheet_SetVelocity(storm->world, Storm_AnySheet(storm), velocity, spin));
    } else {
        Storm_Note(storm, kiriFrame_SetPieceVelocity(storm->world, Storm_AnyFrame(storm), velocity, spin));
    }
}

/* ---- Pins and holds ---- */

static void AddPin(Storm* storm)
{
    kiriPinDef def = DefaultPin();
    Storm_AnyRestPoint(storm, def.restPoint);
    kiriSheet sheet = Storm_AnySheet(storm);
    kiriPointState state;
    kiriPin pin;
    if (Storm_Note(storm, kiriSheet_GetPoint(storm->world, sheet, def.restPoint, &state)) == KIRI_OK) {
        for (int i = 0; i < 3; i++) {
            def.target[i] = state.position[i] + Storm_Between(storm, -0.01f, 0.01f);
        }
        NoteFloats(storm, state.normal, 3);
        NoteFloats(storm, state.velocity, 3);
        def.obstacle = Storm_Random(storm, 2) == 0 ? AnyObstacle(storm) : 0;
        bool isSoft = def.obstacle != 0 || Storm_Random(storm, 2) == 0; /* obstacles jump: no catapults */
        def.stiffness = isSoft ? Storm_Between(storm, 1.0f, 50.0f) : 0.0f;
        def.breakForce = Storm_Random(storm, 3) == 0 ? Storm_Between(storm, 0.5f, 5.0f) : 0.0f;
        Storm_Note(storm, kiriCreatePin(storm->world, sheet, &def, &pin));
    }
}

static void AddLine(Storm* storm)
{
    float from[2], to[2];
    kiriPin pin;
    Storm_AnyRestPoint(storm, from);
    Storm_AnyRestPoint(storm, to);
    if (Storm_Random(storm, 2) == 0) {
        Storm_Note(storm, kiriSheet_ClampLine(storm->world, Storm_AnySheet(storm), from, to, &pin));
    } else {
        Storm_Note(storm, kiriSheet_HingeLine(storm->world, Storm_AnySheet(storm), from, to, &pin));
    }
}

static void MovePin(Storm* storm)
{
    kiriPin pin = AnyPin(storm);
    kiriPinState state;
    if (kiriPin_GetState(storm->world, pin, &state) != KIRI_OK) {
        return;
    }
    if (Storm_Random(storm, 3) == 0) {
        Storm_Note(storm, kiriDestroyPin(storm->world, pin));
        return;
    }
    float rotation[9];
    Storm_Rotation(storm, rotation);
    for (int i = 0; i < 2; i++) {
        state.target[i] += Storm_Between(storm, -0.02f, 0.02f);
    }
    if (state.type == KIRI_PIN_POINT || Storm_Random(storm, 2) == 0) {
        Storm_Note(storm, kiriPin_SetTarget(storm->world, pin, state.target));
    } else {
        Storm_Note(storm, kiriPin_SetPose(storm->world, pin, state.target, rotation));
    }
}

static void Hold(Storm* storm)
{
    kiriFrame frame = Storm_AnyFrame(storm);
    kiriFrameState state;
    if (kiriFrame_GetState(storm->world, frame, &state) != KIRI_OK) {
        return;
    }
    NoteFloats(storm, state.position, 3);
    NoteFloats(storm, state.rotation, 9);
    if (state.held) {
        double force[3], torque[3];
        Storm_Note(storm, kiriFrame_GetReaction(storm->world, frame, force, torque));
        kiriHash_Double(&storm->results, force[2]);
        Storm_Note(storm, kiriFrame_Hold(storm->world, frame, NULL, NULL));
        return;
    }
    float rotation[9];
    Storm_Rotation(storm, rotation);
    state.position[0] += 0.02f;
    Storm_Note(storm, kiriFrame_Hold(storm->world, frame, state.position, rotation));
}

/* ---- Seams ---- */

static void ChangeSeams(Storm* storm)
{
    kiriStitch stitch;
    float lines[2][4];
    if (Storm_Random(storm, 4) == 0) {
        Storm_Note(storm, kiriDestroySeam(storm->world, storm->seam));
    }
    kiriSeamDef def = DefaultSeam();
    for (int k = 0; k < 2; k++) {
        Storm_AnyRestPoint(storm, lines[k]);
        Storm_AnyRestPoint(storm, lines[k] + 2);
    }
    def.sheetA = Storm_AnySheet(storm);
    def.sheetB = Storm_AnySheet(storm);
    def.lineA = lines[0];
    def.lineB = lines[1];
    def.countA = def.countB = 2;
    def.stitches = (int32_t)Storm_Random(storm, 3) * 4;
    def.stiffness = Storm_Random(storm, 2) == 0 ? 1e-3f : 0.0f;
    def.restAngle = Storm_Between(storm, -1.0f, 1.0f);
    def.breakForce = Storm_Random(storm, 2) == 0 ? Storm_Between(storm, 0.5f, 5.0f) : 0.0f;
    Storm_Note(storm, kiriCreateSeam(storm->world, &def, &storm->seam));
    if (Storm_Note(storm, kiriSeam_GetStitch(storm->world, storm->seam, 1, &stitch)) == KIRI_OK) {
        NoteFloats(storm, stitch.position, 3);
        NoteFloats(storm, stitch.force, 3);
        NoteFloats(storm, &stitch.angle, 1);
    }
    float angle = Storm_Between(storm, -1.0f, 1.0f);
    Storm_Note(storm, kiriSeam_SetHinge(storm->world, storm->seam, 1e-3f, angle));
}

/* ---- Loads ---- */

static void Push(Storm* storm)
{
    float point[2], to[2], force[3], torque[3];
    Storm_AnyRestPoint(storm, point);
    Storm_AnyRestPoint(storm, to);
    Storm_Vector(storm, 0.1f, force);
    Storm_Vector(storm, 0.002f, torque);
    kiriSheet sheet = Storm_AnySheet(storm);
    switch (Storm_Random(storm, 5)) {
    case 0:
        Storm_Note(storm, kiriFrame_ApplyForce(storm->world, Storm_AnyFrame(storm), force, torque));
        break;
    case 1:
        Storm_Note(storm, kiriSheet_ApplyForce(storm->world, sheet, point, force, torque));
        break;
    case 2:
        Storm_Note(storm, kiriSheet_ApplyLineLoad(storm->world, sheet, point, to, force));
        break;
    case 3:
        Storm_Note(storm, kiriSheet_ApplyPressure(storm->world, sheet, 50.0f * force[0]));
        break;
    default:
        Storm_Note(storm, kiriSheet_ApplyImpulse(storm->world, sheet, point, torque));
        break;
    }
}

static void Blow(Storm* storm)
{
    kiriWind wind = { { 0.0f, 0.0f, 0.0f }, 1.2f, 1.2f, 0.05f };
    Storm_Vector(storm, 4.0f, wind.velocity);
    Storm_Note(storm, kiriSheet_SetWind(storm->world, Storm_AnySheet(storm), &wind));
}

static void Rip(Storm* storm)
{
    static const float toughness[] = { 0.0f, 1.0f, 100.0f };
    kiriSheet sheet = Storm_AnySheet(storm);
    kiriTearing tearing = { 0 };
    tearing.toughness = toughness[Storm_Random(storm, 3)];
    tearing.strength = 100.0f * tearing.toughness;
    tearing.grain[0] = Storm_Between(storm, -1.0f, 1.0f);
    tearing.grain[1] = Storm_Between(storm, -1.0f, 1.0f);
    tearing.grainRatio = Storm_Between(storm, 1.0f, 4.0f);
    tearing.maxTips = (int32_t)Storm_Random(storm, 4);
    Storm_Note(storm, kiriSheet_SetTearing(storm->world, sheet, &tearing));
    const float line[] = { tearing.grain[0], tearing.grain[1], tearing.grain[1], tearing.grain[0] };
    Storm_Note(storm, kiriSheet_SetTearLine(storm->world, sheet, line, 2, Storm_Between(storm, 0.0f, 2.0f)));
}

static void Turn(Storm* storm)
{
    float gravity[3];
    Storm_Vector(storm, 3.0f, gravity);
    gravity[2] -= 8.0f;
    Storm_Note(storm, kiriWorld_SetGravity(storm->world, gravity));
}

/* ---- Obstacles ---- */

static const float outline[10] = { 0.2f, 0.0f, 0.1f, 0.2f, -0.1f, 0.15f, -0.2f, -0.05f, 0.0f, -0.2f };

/* The first one is a floor; then one of each kind. */
void Storm_AddObstacle(Storm* storm)
{
    kiriObstacleDef def = DefaultObstacle();
    def.type = storm->obstacleCount % (KIRI_OBSTACLE_PRISM + 1);
    def.size[0] = def.size[1] = 0.3f;
    def.size[2] = 0.1f;
    def.radius = 0.1f;
    def.height = 0.2f;
    def.outline = outline;
    def.outlineCount = 5;
    def.position[2] = -0.4f;
    def.rounding = def.type == KIRI_OBSTACLE_BOX ? 0.01f : 0.0f;
    if (def.type != KIRI_OBSTACLE_PLANE) {
        def.position[0] = Storm_Between(storm, 0.0f, 1.0f);
        def.position[1] = Storm_Between(storm, 0.0f, 1.0f);
        def.position[2] = Storm_Between(storm, -0.3f, 0.0f);
        Storm_Rotation(storm, def.rotation);
        Storm_Vector(storm, 0.2f, def.velocity);
        Storm_Vector(storm, 1.0f, def.angularVelocity);
        def.mass = Storm_Random(storm, 2) == 0 ? 0.5f : 0.0f;
        def.inertia[0] = def.inertia[1] = def.inertia[2] = 0.001f;
    }
    kiriObstacle obstacle = 0;
    if (Storm_Note(storm, kiriCreateObstacle(storm->world, &def, &obstacle)) == KIRI_OK) {
        storm->obstacles[storm->obstacleCount++] = obstacle;
    }
}

static void MoveObstacle(Storm* storm)
{
    kiriObstacle obstacle = AnyObstacle(storm);
    kiriObstacleState state;
    if (obstacle == 0 || obstacle == storm->obstacles[0] ||
        kiriObstacle_GetState(storm->world, obstacle, &state) != KIRI_OK) {
        return;
    }
    float spin[3];
    Storm_Vector(storm, 2.0f, spin);
    Storm_Rotation(storm, state.rotation);
    for (int i = 0; i < 3; i++) {
        state.position[i] += Storm_Between(storm, -0.02f, 0.02f);
        float velocity = (float)(state.velocity[i] + 0.5 * state.impulse[i]);
        state.velocity[i] = velocity > 0.5f ? 0.5f : velocity < -0.5f ? -0.5f : velocity;
    }
    Storm_Note(storm, kiriObstacle_SetPose(storm->world, obstacle, state.position, state.rotation));
    Storm_Note(storm, kiriObstacle_SetVelocity(storm->world, obstacle, state.velocity, spin));
    Storm_Note(storm, kiriObstacle_SetSurfaceVelocity(storm->world, obstacle, spin));
}

/* Planes of the host, below some collision points and rest points. */
static void Touch(Storm* storm)
{
    enum { CONTACTS = 12 };
    kiriContact contacts[CONTACTS];
    kiriSheet sheet = Storm_AnySheet(storm);
    const float* points;
    int32_t count;
    if (!storm->type->obstacles || kiriSheet_GetCollisionPoints(storm->world, sheet, &points, &count) != KIRI_OK) {
        return;
    }
    for (int32_t i = 0; i < CONTACTS; i++) {
        kiriContact contact = { -1,    { 0.08f * (float)i, 0.5f },       { 0.0f, 0.0f, 1.0f },  0.1f,
                                { 0 }, Storm_Between(storm, 0.0f, 1.0f), 0.5f * (float)(i % 2), 0.0f,
                                i / 4 };
        if (i < count && i < CONTACTS / 2) {
            contact.point = i;
            contact.offset = points[3 * i + 2] + Storm_Between(storm, -0.01f, 0.01f);
        }
        contacts[i] = contact;
    }
    Storm_Note(storm, kiriSheet_SetContacts(storm->world, sheet, contacts, CONTACTS));
}

/* ---- Questions ---- */

static void Ask(Storm* storm)
{
    float place[3], direction[3], point[2], weights[8], gradients[16];
    kiriFrame frames[8];
    kiriSheet sheet = Storm_AnySheet(storm);
    kiriHit hit = { .triangle = -1 };
    double error = 0.0;
    int32_t count = 0;
    Storm_AnyPlace(storm, place);
    Storm_AnyRestPoint(storm, point);
    Storm_Vector(storm, 1.0f, direction);
    Storm_Note(storm, kiriWorld_Raycast(storm->world, place, direction, 10.0f, &sheet, &hit));
    NoteFloats(storm, hit.restPoint, 2);
    NoteFloats(storm, hit.normal, 3);
    sheet = Storm_AnySheet(storm);
    Storm_Note(storm, kiriSheet_EstimateError(storm->world, sheet, &error));
    kiriHash_Double(&storm->results, error);
    Storm_Note(storm, kiriSheet_GetWeights(storm->world, sheet, point, frames, weights, gradients, 8, &count));
    count = count < 8 ? count : 8;
    NoteFloats(storm, weights, count);
    NoteFloats(storm, gradients, 2 * count);
}

static void AskForSolid(Storm* storm)
{
    kiriSolid solid;
    if (Storm_Note(storm, kiriSheet_GetSolid(storm->world, Storm_AnySheet(storm), 0.01f, &solid)) == KIRI_OK) {
        NoteFloats(storm, solid.positions, 3 * solid.vertexCount);
        NoteFloats(storm, solid.normals, 3 * solid.vertexCount);
    }
}

static void ChangeBudget(Storm* storm)
{
    kiriBudget budget = storm->type->budget;
    if (budget.cells > 0) {
        budget.cells += (int32_t)Storm_Random(storm, 1000);
        budget.samples += (int32_t)Storm_Random(storm, 200);
        Storm_Note(storm, kiriWorld_SetBudget(storm->world, &budget));
    }
}

void Storm_Act(Storm* storm)
{
    typedef void ActFn(Storm*);
    static ActFn* const acts[] = { Storm_Cut,
                                   Storm_Cut,
                                   Storm_CutDisc,
                                   Storm_CutDisc,
                                   Storm_GoOnCutting,
                                   Storm_GoOnCutting,
                                   Storm_GoOnCutting,
                                   Storm_Slice,
                                   Storm_MoveBlade,
                                   Storm_MoveBlade,
                                   Storm_MoveBlade,
                                   Storm_TakePiece,
                                   Storm_TakePiece,
                                   AddPin,
                                   AddPin,
                                   AddLine,
                                   MovePin,
                                   MovePin,
                                   Hold,
                                   Push,
                                   Push,
                                   Blow,
                                   Rip,
                                   Turn,
                                   MoveObstacle,
                                   MoveObstacle,
                                   Touch,
                                   Touch,
                                   Ask,
                                   AskForSolid,
                                   ChangeBudget,
                                   ReplaceSheet,
                                   MoveSheet,
                                   Throw,
                                   ChangeSettings };
    Storm_TakeDetached(storm);
    if (storm->type->seams && Storm_Random(storm, 6) == 0) {
        ChangeSeams(storm);
    } else {
        acts[Storm_Random(storm, sizeof acts / sizeof acts[0])](storm);
    }
}
