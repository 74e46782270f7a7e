/* Arguments out of bytes. */
#include "fuzz_world.h"

void FuzzIds_Add(FuzzIds* ids, uint32_t id)
{
    if (id != 0) {
        ids->ids[ids->next] = id;
        ids->next = (ids->next + 1) % FUZZ_IDS;
        ids->count = ids->count < FUZZ_IDS ? ids->count + 1 : FUZZ_IDS;
    }
}

/* Most of the time one that there is, or was. */
static uint32_t ReadId(Fuzz* fuzz, const FuzzIds* ids)
{
    uint32_t kind = FuzzBytes_Get(&fuzz->bytes);
    if (kind >= 250) {
        return kind < 252 ? 0 : kind < 254 ? fuzz->frames.ids[0] : FuzzBytes_GetSome(&fuzz->bytes, 4);
    }
    return ids->count == 0 ? 0 : ids->ids[kind % (uint32_t)ids->count];
}

/* ---- Places ---- */

static bool ReadVertex(Fuzz* fuzz, kiriSheet sheet, kiriMesh* mesh, int32_t* vertex)
{
    const kiriWorld* world = fuzz->hosts[0].world;
    sheet = sheet != 0 ? sheet : fuzz->sheets.ids[0];
    uint32_t number = FuzzBytes_GetSome(&fuzz->bytes, 2);
    if (kiriSheet_GetMesh(world, sheet, mesh) != KIRI_OK || mesh->vertexCount == 0) {
        return false;
    }
    *vertex = (int32_t)(number % (uint32_t)mesh->vertexCount);
    return true;
}

/* In and around a sheet; on a vertex of it; or beside one. */
static void ReadRest(Fuzz* fuzz, kiriSheet sheet, float rest[2])
{
    int32_t kind = FuzzBytes_Below(&fuzz->bytes, 8), vertex;
    kiriMesh mesh;
    if (kind < 2 && ReadVertex(fuzz, sheet, &mesh, &vertex)) {
        for (int i = 0; i < 2; ++i) {
            fuzz->bytes.last = rest[i] = mesh.restPositions[2 * vertex + i];
            rest[i] = kind == 0 ? rest[i] : FuzzBytes_Float(&fuzz->bytes, rest[i] - 1e-6f, rest[i] + 1e-6f);
        }
        return;
    }
    for (int i = 0; i < 2; ++i) {
        rest[i] = kind < 5 ? fuzz->scale * (float)(FuzzBytes_Below(&fuzz->bytes, 21) - 2) / 16.0f
                           : FuzzBytes_Float(&fuzz->bytes, -0.1f * fuzz->scale, 1.1f * fuzz->scale);
    }
}

static void ReadVector(Fuzz* fuzz, float size, float vector[3])
{
    for (int i = 0; i < 3; ++i) {
        vector[i] = FuzzBytes_Float(&fuzz->bytes, -size, size);
    }
}

static void ReadPlace(Fuzz* fuzz, kiriSheet sheet, float place[3])
{
    int32_t kind = FuzzBytes_Below(&fuzz->bytes, 4), vertex;
    kiriMesh mesh;
    if (kind < 2 && ReadVertex(fuzz, sheet, &mesh, &vertex)) {
        memcpy(place, &mesh.positions[3 * vertex], 3 * sizeof(float));
        for (int i = 0; i < 3 && kind == 1; ++i) {
            place[i] = FuzzBytes_Float(&fuzz->bytes, place[i] - 0.3f * fuzz->scale, place[i] + 0.3f * fuzz->scale);
        }
        return;
    }
    for (int i = 0; i < 3; ++i) {
        place[i] = FuzzBytes_Float(&fuzz->bytes, i < 2 ? -0.2f * fuzz->scale : -0.5f * fuzz->scale,
                                   i < 2 ? 1.2f * fuzz->scale : 0.5f * fuzz->scale);
    }
}

/* About any axis, by a rational way to a unit quaternion; or nine numbers. */
static void ReadRotation(Fuzz* fuzz, float r[9])
{
    double q[4], size = 0.0;
    int32_t kind = FuzzBytes_Below(&fuzz->bytes, 16);
    for (int i = 0; i < 4; ++i) {
        q[i] = kind < 4 ? i == 3 : (double)FuzzBytes_Get(&fuzz->bytes) - 127.5;
        q[i] = kind < 8 && i < 2 ? 0.0 : q[i]; /* about z */
        size += q[i] * q[i];
    }
    double s = 2.0 / size, x = q[0], y = q[1], z = q[2], w = q[3];
    const double m[9] = { 1.0 - s * (y * y + z * z), s * (x * y + w * z),       s * (x * z - w * y),
                          s * (x * y - w * z),       1.0 - s * (x * x + z * z), s * (y * z + w * x),
                          s * (x * z + w * y),       s * (y * z - w * x),       1.0 - s * (x * x + y * y) };
    for (int i = 0; i < 9; ++i) {
        r[i] = (float)m[i];
    }
    if (kind == 15) {
        r[FuzzBytes_Below(&fuzz->bytes, 9)] = FuzzBytes_Float(&fuzz->bytes, -1.0f, 1.0f);
    }
}

static void ReadPoints(Fuzz* fuzz, FuzzAct* act)
{
    act->pointCount = FuzzBytes_Below(&fuzz->bytes, FUZZ_POINTS + 1);
    for (int32_t i = 0; i < act->pointCount; ++i) {
        ReadRest(fuzz, act->sheet, &act->points[2 * i]);
    }
}

/* ---- Defs ---- */

/* Of numbers up to `most` four times as much; others as they are. */
static int32_t ReadLimit(Fuzz* fuzz, int32_t most)
{
    int32_t limit = FuzzBytes_Int(&fuzz->bytes, 0, most);
    return limit >= 0 && limit <= most ? 4 * limit : limit;
}

static void ReadBudget(Fuzz* fuzz, kiriBudget* budget)
{
    budget->triangles = FuzzBytes_Int(&fuzz->bytes, KIRI_LEAST_TRIANGLES, 200);
    budget->cells = ReadLimit(fuzz, 240);
    budget->samples = ReadLimit(fuzz, 100);
    budget->iterations = FuzzBytes_Int(&fuzz->bytes, 0, 40);
}

/* Is what the other world does the same only where nothing waits? */
static bool NeedsNoLimit(const Fuzz* fuzz)
{
    return fuzz->twin == FUZZ_SCRATCH || fuzz->twin == FUZZ_REFUSED;
}

static void ReadWind(Fuzz* fuzz, kiriWind* wind)
{
    ReadVector(fuzz, 8.0f, wind->velocity);
    wind->density = FuzzBytes_Float(&fuzz->bytes, 0.0f, 2.0f);
    wind->drag = FuzzBytes_Float(&fuzz->bytes, 0.0f, 2.0f);
    wind->lift = FuzzBytes_Float(&fuzz->bytes, 0.0f, 1.0f);
}

static void ReadTearing(Fuzz* fuzz, kiriTearing* tearing)
{
    tearing->toughness = FuzzBytes_Float(&fuzz->bytes, 0.0f, 100.0f);
    tearing->strength = 0.3f * tearing->toughness * tearing->toughness;
    tearing->grain[0] = FuzzBytes_Float(&fuzz->bytes, -1.0f, 1.0f);
    tearing->grain[1] = FuzzBytes_Float(&fuzz->bytes, -1.0f, 1.0f);
    tearing->grainRatio = FuzzBytes_Float(&fuzz->bytes, 0.0f, 8.0f);
    tearing->maxSpeed = FuzzBytes_Float(&fuzz->bytes, 0.0f, 4.0f);
    tearing->maxTips = FuzzBytes_Below(&fuzz->bytes, 4);
}

static void ReadPin(Fuzz* fuzz, kiriSheet sheet, kiriPinDef* def)
{
    kiriDefaultPinDef(def);
    kiriPointState state;
    ReadRest(fuzz, sheet, def->restPoint);
    if (kiriSheet_GetPoint(fuzz->hosts[0].world, sheet, def->restPoint, &state) == KIRI_OK) {
        memcpy(def->target, state.position, sizeof(def->target));
    } else {
        ReadPlace(fuzz, sheet, def->target);
    }
    int32_t kind = FuzzBytes_Below(&fuzz->bytes, 8);
    def->stiffness = (kind & 1) != 0 ? FuzzBytes_Float(&fuzz->bytes, 0.0f, 100.0f) : 0.0f;
    def->breakForce = (kind & 2) != 0 ? FuzzBytes_Float(&fuzz->bytes, 0.0f, 10.0f) : 0.0f;
    def->obstacle = (kind & 4) != 0 ? ReadId(fuzz, &fuzz->obstacles) : 0;
}

static void ReadMass(Fuzz* fuzz, kiriObstacleDef* def)
{
    def->mass = FuzzBytes_Float(&fuzz->bytes, 0.0f, 2.0f);
    for (int i = 0; i < 6; ++i) {
        def->inertia[i] = i < 3 ? FuzzBytes_Float(&fuzz->bytes, 0.0f, 0.1f) : 0.0f;
    }
    def->body = FuzzBytes_Get(&fuzz->bytes) % 3;
}

static void ReadObstacle(Fuzz* fuzz, FuzzAct* act, kiriObstacleDef* def)
{
    float scale = fuzz->scale;
    kiriDefaultObstacleDef(def);
    def->type = FuzzBytes_Int(&fuzz->bytes, 0, KIRI_OBSTACLE_PRISM);
    for (int i = 0; i < 3; ++i) {
        def->size[i] = FuzzBytes_Float(&fuzz->bytes, 0.05f * scale, 0.6f * scale);
    }
    def->radius = FuzzBytes_Float(&fuzz->bytes, 0.02f * scale, 0.4f * scale);
    def->height = FuzzBytes_Float(&fuzz->bytes, 0.0f, 0.5f * scale);
    ReadPlace(fuzz, fuzz->sheets.ids[0], def->position);
    ReadRotation(fuzz, def->rotation);
    if (def->type == KIRI_OBSTACLE_PRISM) {
        def->outlineCount = FuzzBytes_Int(&fuzz->bytes, 3, 6);
        for (int32_t i = 0; i < 2 * FUZZ_POINTS; ++i) {
            static const float hexagon[12] = { 0.2f,  0.0f, 0.1f,  0.2f,  -0.1f, 0.2f,
                                               -0.2f, 0.0f, -0.1f, -0.2f, 0.1f,  -0.2f };
            act->outline[i] = i < 12 ? scale * hexagon[i] : 0.0f;
        }
        int32_t turned = FuzzBytes_Below(&fuzz->bytes, 24);
        act->outline[turned] = FuzzBytes_Float(&fuzz->bytes, act->outline[turned] - 0.1f, act->outline[turned] + 0.1f);
        def->outline = act->outline;
        def->outlineCount = def->outlineCount > FUZZ_POINTS && def->outlineCount <= 64 ? 6 : def->outlineCount;
    }
    int32_t kind = FuzzBytes_Below(&fuzz->bytes, 16);
    def->rounding = (kind & 1) != 0 ? FuzzBytes_Float(&fuzz->bytes, 0.0f, 0.05f * scale) : 0.0f;
    if ((kind & 2) != 0) {
        ReadVector(fuzz, scale, def->velocity);
        ReadVector(fuzz, 3.0f, def->angularVelocity);
    }
    if ((kind & 4) != 0) {
        ReadMass(fuzz, def);
    }
    if ((kind & 8) != 0) {
        def->friction = FuzzBytes_Float(&fuzz->bytes, 0.0f, 1.0f);
        def->pushSpeed = FuzzBytes_Float(&fuzz->bytes, 0.1f, 3.0f);
        ReadVector(fuzz, scale, def->surfaceVelocity);
        def->groups = FuzzBytes_Get(&fuzz->bytes);
    }
}

static void ReadContacts(Fuzz* fuzz, FuzzAct* act)
{
    memset(act->def.contacts, 0, sizeof(act->def.contacts));
    int32_t count = act->numbers[0] > 0 && act->numbers[0] < FUZZ_POINTS ? act->numbers[0] : FUZZ_POINTS;
    act->numbers[0] = act->numbers[0] < FUZZ_POINTS ? act->numbers[0] : FUZZ_POINTS;
    for (int32_t i = 0; i < count; ++i) {
        kiriContact* contact = &act->def.contacts[i];
        contact->point = FuzzBytes_Int(&fuzz->bytes, -1, 20);
        contact->normal[i % 3] = 1.0f;
        contact->offset = FuzzBytes_Float(&fuzz->bytes, -0.5f * fuzz->scale, 0.5f * fuzz->scale);
        if (contact->point == -1) {
            ReadRest(fuzz, act->sheet, contact->restPoint);
        }
        uint32_t kind = FuzzBytes_Get(&fuzz->bytes);
        contact->obstacle = (int32_t)kind % 4;
        contact->friction = (kind & 16) != 0 ? FuzzBytes_Float(&fuzz->bytes, 0.0f, 1.0f) : 0.0f;
        contact->inverseMass = (kind & 32) != 0 ? FuzzBytes_Float(&fuzz->bytes, 0.0f, 10.0f) : 0.0f;
        contact->pushSpeed = (kind & 64) != 0 ? FuzzBytes_Float(&fuzz->bytes, 0.0f, 3.0f) : 0.0f;
        if ((kind & 128) != 0) {
            ReadVector(fuzz, 1.0f, contact->velocity);
        }
    }
}

static void ReadMaterial(Fuzz* fuzz, kiriMaterial* material)
{
    kiriGetMaterial(FuzzBytes_Below(&fuzz->bytes, KIRI_MATERIAL_COUNT), material);
    int32_t kind = FuzzBytes_Below(&fuzz->bytes, 8);
    if (kind == 7) {
        material->youngsModulus = FuzzBytes_Float(&fuzz->bytes, 1e4f, 1e9f);
        material->poissonsRatio = FuzzBytes_Float(&fuzz->bytes, 0.0f, 0.49f);
        material->thickness = FuzzBytes_Float(&fuzz->bytes, 1e-5f, 1e-2f);
        material->density = FuzzBytes_Float(&fuzz->bytes, 1.0f, 8000.0f);
    }
    if (kind >= 5) {
        material->airDamping = FuzzBytes_Float(&fuzz->bytes, 0.0f, 3.0f);
        material->flexDamping = FuzzBytes_Float(&fuzz->bytes, 0.0f, 0.01f);
        material->yieldStress = FuzzBytes_Float(&fuzz->bytes, 0.0f, 1e8f);
        material->hardening = FuzzBytes_Float(&fuzz->bytes, 0.0f, 0.9f);
        material->slack = FuzzBytes_Below(&fuzz->bytes, 3) == 0 ? 0.97f : 0.0f;
        material->detail = FuzzBytes_Below(&fuzz->bytes, 4);
        material->restCurvature[0] = FuzzBytes_Below(&fuzz->bytes, 4) == 0 ? FuzzBytes_Float(&fuzz->bytes, -9.0f, 9.0f) : 0.0f;
    }
}

static void ReadSettings(Fuzz* fuzz, kiriSheet sheet, kiriSheetSettings* settings)
{
    memset(settings, 0, sizeof(*settings));
    kiriSheet_GetSettings(fuzz->hosts[0].world, sheet, settings);
    uint32_t kind = FuzzBytes_GetSome(&fuzz->bytes, 2);
    FuzzBytes* bytes = &fuzz->bytes;
    if ((kind & 1) != 0) {
        ReadMaterial(fuzz, &settings->material);
    }
    settings->maxFrames = (kind & 2) != 0 ? FuzzBytes_Int(bytes, 1, 32) : settings->maxFrames;
    settings->maxFrames = settings->maxFrames > 64 ? 64 : settings->maxFrames;
    settings->crumbArea = (kind & 4) != 0 ? FuzzBytes_Float(bytes, 0.0f, 0.1f) : settings->crumbArea;
    settings->friction = (kind & 8) != 0 ? FuzzBytes_Float(bytes, 0.0f, 1.0f) : settings->friction;
    settings->contactThickness = (kind & 16) != 0 ? FuzzBytes_Float(bytes, 0.0f, 0.05f) : settings->contactThickness;
    settings->groups ^= (kind & 32) != 0 ? 1u : 0u;
    settings->touchesSheets ^= (kind & 64) != 0;
    settings->iterations = (kind & 128) != 0 ? FuzzBytes_Int(bytes, 1, 6) : settings->iterations;
    settings->iterations = settings->iterations > 8 && settings->iterations <= 64 ? 8 : settings->iterations;
    settings->sleepSpeed = (kind & 256) != 0 ? FuzzBytes_Float(bytes, 0.0f, 0.1f) : settings->sleepSpeed;
    settings->skinning ^= (kind & 512) != 0;
    settings->timeStepping ^= (kind & 1024) != 0;
    settings->fadeTime = (kind & 2048) != 0 ? FuzzBytes_Float(bytes, 0.0f, 1.0f) : settings->fadeTime;
    settings->normals ^= (kind & 4096) != 0;
}

/* ---- Sheets ---- */

/* A rectangle, at times with holes, with inner vertices moved, slanted, or with a slit. */
static void ReadMesh(Fuzz* fuzz, FuzzAct* act, kiriSheetDef* def)
{
    int32_t columns = 1 + FuzzBytes_Below(&fuzz->bytes, FUZZ_SQUARES),
            rows = 1 + FuzzBytes_Below(&fuzz->bytes, FUZZ_SQUARES), kind = FuzzBytes_Below(&fuzz->bytes, 16);
    float width = fuzz->scale, height = fuzz->scale * (float)rows / (float)columns;
    OK(kiriFillRectangle(width, height, columns, rows, act->positions, act->indices));
    def->vertexCount = (columns + 1) * (rows + 1);
    def->triangleCount = 2 * columns * rows;
    if ((kind & 1) != 0) { /* without a triangle or two; others may hang by a corner */
        for (int i = 0; i < 2 && def->triangleCount > 1; ++i) {
            int32_t hole = FuzzBytes_Below(&fuzz->bytes, def->triangleCount), last = --def->triangleCount;
            memmove(&act->indices[3 * hole], &act->indices[3 * last], 3 * sizeof(int32_t));
        }
    }
    for (int32_t i = 0; i < def->vertexCount; ++i) {
        int32_t column = i % (columns + 1), row = i / (columns + 1);
        bool isInner = column > 0 && column < columns && row > 0 && row < rows;
        float* at = &act->positions[2 * i];
        if ((kind & 2) != 0 && isInner) {
            at[0] = FuzzBytes_Float(&fuzz->bytes, at[0] - 0.2f * width / (float)columns,
                                    at[0] + 0.2f * width / (float)columns);
        }
        if ((kind & 4) != 0) {
            at[0] += 0.3f * at[1];
        }
    }
    if ((kind & 8) != 0 && columns > 1 &&
        def->triangleCount == 2 * columns * rows) { /* vertices of a column but the first, twice */
        int32_t column = columns / 2;
        for (int32_t row = 1; row <= rows; ++row) {
            memcpy(&act->positions[2 * (def->vertexCount + row - 1)],
                   &act->positions[2 * (row * (columns + 1) + column)], 2 * sizeof(float));
        }
        for (int32_t t = 0; t < def->triangleCount; ++t) {
            int32_t* corners = &act->indices[3 * t];
            bool isRight = (t / 2) % columns >= column;
            for (int k = 0; k < 3 && isRight; ++k) {
                int32_t row = corners[k] / (columns + 1);
                corners[k] = corners[k] % (columns + 1) == column && row > 0 ? def->vertexCount + row - 1 : corners[k];
            }
        }
        def->vertexCount += rows;
    }
    def->restPositions = act->positions;
    def->indices = act->indices;
    fuzz->slack = (kind & 5) != 0 ? 1e-6 : fuzz->slack; /* cuts through slanted edges of the outline round their ends */
}

static void ReadFrames(Fuzz* fuzz, FuzzAct* act, kiriSheetDef* def)
{
    FuzzBytes* bytes = &fuzz->bytes;
    def->frameCount = FuzzBytes_Int(bytes, 0, 10);
    def->maxFrames = FuzzBytes_Int(bytes, 1, 32);
    def->maxFrames = def->maxFrames > 48 ? 48 : def->maxFrames;
    def->accuracy = 0.1f;
    if (def->frameCount > 0 && def->frameCount <= FUZZ_POINTS && FuzzBytes_Below(bytes, 8) == 0) {
        for (int32_t i = 0; i < def->frameCount; ++i) {
            ReadRest(fuzz, 0, &act->framePoints[2 * i]);
        }
        def->framePoints = act->framePoints;
    }
    def->frameLength = FuzzBytes_Below(bytes, 4) == 0 ? FuzzBytes_Float(bytes, 0.05f, 0.5f) : 0.0f;
    def->rigidWeight = FuzzBytes_Below(bytes, 4) == 0 ? FuzzBytes_Float(bytes, 0.5f, 1.0f) : def->rigidWeight;
    def->rigidArea = FuzzBytes_Below(bytes, 4) == 0 ? FuzzBytes_Float(bytes, 0.0f, 0.3f) : def->rigidArea;
}

static void ReadSheetModel(Fuzz* fuzz, kiriSheetDef* def)
{
    FuzzBytes* bytes = &fuzz->bytes;
    uint32_t kind = FuzzBytes_GetSome(bytes, 2);
    def->model = (kind & 3) == 3 ? FuzzBytes_Int(bytes, 0, 2) : (int32_t)(kind & 3);
    def->skinning = (kind & 4) != 0;
    def->timeStepping = (kind & 8) != 0;
    def->planar = (kind & 48) == 48;
    def->touchesSheets = (kind & 64) != 0;
    def->normals = (kind & 128) == 0;
    def->collisionPoints = (kind & 256) != 0 ? FuzzBytes_Int(bytes, 0, 24) : 0;
    def->paper.popping = (kind & 0x600) == 0x600;
    def->paper.linearWeights = (kind & 0x1800) == 0x1800;
    def->paper.integrationOrder = (kind & 0x2000) != 0 ? 2 : 1;
    def->paper.integrationPoints = (kind & 0x4000) != 0 ? FuzzBytes_Int(bytes, 0, 20) : 0;
    def->crumbArea = (kind & 0x8000) != 0 ? FuzzBytes_Float(bytes, 0.0f, 0.1f) : 0.0f;
    int32_t* large[] = { &def->collisionPoints, &def->paper.integrationPoints };
    for (int i = 0; i < 2; ++i) { /* valid, and takes its time */
        *large[i] = *large[i] > 24 && *large[i] <= 1 << 24 ? 24 : *large[i];
    }
}

static void ReadSheet(Fuzz* fuzz, FuzzAct* act, kiriSheetDef* def)
{
    FuzzBytes* bytes = &fuzz->bytes;
    kiriDefaultSheetDef(def);
    def->gridResolution = FuzzBytes_Int(bytes, 1, 20);
    def->gridResolution = def->gridResolution > 20 && def->gridResolution <= 4096 ? 20 : def->gridResolution;
    ReadMesh(fuzz, act, def);
    ReadFrames(fuzz, act, def);
    ReadSheetModel(fuzz, def);
    ReadMaterial(fuzz, &def->material);
    uint32_t kind = FuzzBytes_Get(bytes);
    if ((kind & 3) != 0) {
        ReadPlace(fuzz, fuzz->sheets.ids[0], def->position);
    }
    if ((kind & 12) == 12) {
        float rotation[9];
        ReadRotation(fuzz, rotation);
        memcpy(def->axisU, rotation, sizeof(def->axisU));
        memcpy(def->axisV, rotation + 3, sizeof(def->axisV));
    }
    if ((kind & 48) == 48) {
        ReadVector(fuzz, 2.0f, def->velocity);
    }
    def->snapDistance = (kind & 192) == 192 ? FuzzBytes_Float(bytes, 0.0f, 0.05f) : 0.0f;
}

/* ---- Folds and seams ---- */

static void ReadFolds(Fuzz* fuzz, FuzzAct* act)
{
    act->foldCount = 1 + FuzzBytes_Below(&fuzz->bytes, FUZZ_FOLDS);
    for (int32_t i = 0; i < act->foldCount; ++i) {
        kiriFold* fold = &act->folds[i];
        ReadRest(fuzz, act->sheet, fold->from);
        ReadRest(fuzz, act->sheet, fold->to);
        fold->stiffness = FuzzBytes_Float(&fuzz->bytes, 0.0f, 0.01f);
        fold->restAngle = FuzzBytes_Float(&fuzz->bytes, -3.14f, 3.14f);
        fold->yieldMoment = FuzzBytes_Float(&fuzz->bytes, 0.0f, 0.01f);
    }
}

/* A line in both sheets. */
static void ReadSeam(Fuzz* fuzz, FuzzAct* act, kiriSeamDef* def)
{
    const kiriSheet sheets[2] = { act->sheet, ReadId(fuzz, &fuzz->sheets) };
    int32_t counts[2];
    kiriDefaultSeamDef(def);
    for (int k = 0; k < 2; ++k) {
        counts[k] = FuzzBytes_Int(&fuzz->bytes, 2, 4);
        counts[k] = counts[k] > FUZZ_POINTS ? FUZZ_POINTS : counts[k];
        for (int32_t i = 0; i < counts[k]; ++i) {
            ReadRest(fuzz, sheets[k], &act->lines[k][2 * i]);
        }
    }
    def->sheetA = sheets[0];
    def->sheetB = sheets[1];
    def->lineA = act->lines[0];
    def->lineB = act->lines[1];
    def->countA = counts[0];
    def->countB = counts[1];
    def->stitches = FuzzBytes_Int(&fuzz->bytes, 0, 20);
    def->stitches = def->stitches > 64 && def->stitches <= 4096 ? 64 : def->stitches;
    int32_t kind = FuzzBytes_Below(&fuzz->bytes, 8);
    def->stiffness = (kind & 1) != 0 ? FuzzBytes_Float(&fuzz->bytes, 0.0f, 0.1f) : 0.0f;
    def->restAngle = (kind & 2) != 0 ? FuzzBytes_Float(&fuzz->bytes, -3.14f, 3.14f) : 0.0f;
    def->breakForce = (kind & 4) != 0 ? FuzzBytes_Float(&fuzz->bytes, 0.0f, 10.0f) : 0.0f;
}

/* ---- All ---- */

static void ReadDef(Fuzz* fuzz, FuzzAct* act, char need)
{
    switch (need) {
    case 'B':
        ReadBudget(fuzz, &act->def.budget);
        if (NeedsNoLimit(fuzz)) {
            memset(&act->def.budget, 0, sizeof(act->def.budget));
        }
        break;
    case 'W':
        ReadWind(fuzz, &act->def.wind);
        break;
    case 'A':
        ReadTearing(fuzz, &act->def.tearing);
        break;
    case 'I':
        ReadPin(fuzz, act->sheet, &act->def.pin);
        break;
    case 'O':
        ReadObstacle(fuzz, act, &act->def.obstacle);
        break;
    case 'S':
        ReadSheet(fuzz, act, &act->def.sheet);
        break;
    case 'T':
        ReadSettings(fuzz, act->sheet, &act->def.settings);
        break;
    case 'E':
        ReadSeam(fuzz, act, &act->def.seam);
        break;
    default:
        ReadContacts(fuzz, act);
        break;
    }
}

static void ReadFrameIds(Fuzz* fuzz, FuzzAct* act)
{
    act->frameCount = FuzzBytes_Below(&fuzz->bytes, 5);
    for (int32_t i = 0; i < act->frameCount; ++i) {
        act->frames[i] = ReadId(fuzz, &fuzz->frames);
    }
}

static void ReadOne(Fuzz* fuzz, FuzzAct* act, char need)
{
    switch (need) {
    case 's':
        act->sheet = ReadId(fuzz, &fuzz->sheets);
        break;
    case 'f':
        act->frame = ReadId(fuzz, &fuzz->frames);
        break;
    case 'p':
        act->pin = ReadId(fuzz, &fuzz->pins);
        break;
    case 'c':
        act->cut = ReadId(fuzz, &fuzz->cuts);
        break;
    case 'o':
        act->obstacle = ReadId(fuzz, &fuzz->obstacles);
        break;
    case 'b':
        act->blade = ReadId(fuzz, &fuzz->blades);
        break;
    case 'm':
        act->seam = ReadId(fuzz, &fuzz->seams);
        break;
    case 'L':
        ReadFolds(fuzz, act);
        break;
    case 'v':
        ReadPlace(fuzz, act->sheet, act->vectors[act->vectorCount++]);
        break;
    case 'V':
        ReadVector(fuzz, 3.0f, act->vectors[act->vectorCount++]);
        break;
    case 'r':
        ReadRest(fuzz, act->sheet, act->rests[act->restCount++]);
        break;
    case 'R':
        ReadRotation(fuzz, act->rotation);
        break;
    case 'x':
        act->scalar = FuzzBytes_Float(&fuzz->bytes, 0.0f, 1.0f);
        break;
    case 'n':
        act->numbers[act->numberCount++] = FuzzBytes_Int(&fuzz->bytes, 0, 12);
        break;
    case 'P':
        ReadPoints(fuzz, act);
        break;
    case 'F':
        ReadFrameIds(fuzz, act);
        break;
    default:
        ReadDef(fuzz, act, need);
        break;
    }
}

void FuzzAct_Read(FuzzAct* act, Fuzz* fuzz, const char* needs)
{
    memset(act, 0, sizeof(*act));
    uint32_t kind = FuzzBytes_Get(&fuzz->bytes);
    act->nulls = kind >= 252 ? 1u << (kind - 252) : 0;
    for (; *needs != '\0'; ++needs) {
        ReadOne(fuzz, act, *needs);
    }
}
