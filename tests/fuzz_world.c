#include "fuzz_world.h"

#include "layout_hash.h"
#include "world/kiri_world.h"

#include <stdio.h>

/* ---- The second world ---- */

/* Ranges one after the other, from the last one on. */
static void* StartBackwards(void* user, kiriTaskFn* task, int32_t itemCount, int32_t minRange, void* context)
{
    int32_t range = minRange + itemCount / 5;
    for (int32_t start = (itemCount - 1) / range * range; start >= 0; start -= range) {
        task(start, start + range < itemCount ? start + range : itemCount, context);
    }
    return NULL;
}

static void FinishNothing(void* user, void* handle)
{
}

static void StartHost(Fuzz* fuzz, int32_t k, const float gravity[3], const kiriBudget* budget)
{
    Host* host = &fuzz->hosts[k];
    memset(host, 0, sizeof(*host));
    host->failAt = -1;
    host->failOnce = true;
    host->most = 1 << 28;
    host->poison = k == 0 ? 0 : 0x5a;
    kiriWorldDef def = Host_Def(host);
    memcpy(def.gravity, gravity, sizeof(def.gravity));
    def.budget = *budget;
    if (k > 0 && fuzz->twin == FUZZ_TASKS) {
        def.startTask = StartBackwards;
        def.finishTask = FinishNothing;
        def.workerCount = 4;
    }
    OK(kiriCreateWorld(&def, &host->world));
}

/* ---- What must hold ---- */

static bool Frame_IsFinite(const kiriWorld* world, kiriFrame frame)
{
    double force[3], torque[3];
    kiriFrameState state = World_FrameState(world, frame);
    OK(kiriFrame_GetReaction(world, frame, force, torque));
    bool isFinite = AllFinite(state.position, 3) && AllFinite(state.rotation, 9) && AllFinite(state.velocity, 3) &&
                    AllFinite(state.angularVelocity, 3);
    for (int i = 0; i < 3; ++i) {
        isFinite = isFinite && isfinite(force[i]) && isfinite(torque[i]);
    }
    return isFinite;
}

static void CheckFinite(const kiriWorld* world, kiriSheet sheet)
{
    kiriFrame frames[512];
    const float* points;
    int32_t count;
    kiriMesh mesh = World_Mesh(world, sheet);
    FUZZ_CHECK(AllFinite(mesh.positions, 3 * mesh.vertexCount), "a position is not finite");
    FUZZ_CHECK(mesh.normals == NULL || AllFinite(mesh.normals, 3 * mesh.vertexCount), "a normal is not finite");
    OK(kiriSheet_GetCollisionPoints(world, sheet, &points, &count));
    FUZZ_CHECK(AllFinite(points, 3 * count), "a collision point is not finite");
    OK(kiriSheet_GetFrames(world, sheet, frames, 512, &count));
    FUZZ_CHECK(count <= 512, "%d frames", (int)count);
    for (int32_t i = 0; i < count; ++i) {
        FUZZ_CHECK(Frame_IsFinite(world, frames[i]), "frame %d is not finite", (int)i);
    }
}

/* Each triangle is in one piece, and each piece one that hangs together by itself. */
static void CheckPieces(kiriWorld* world, kiriSheet sheet)
{
    kiriPieceState state;
    double area = 0.0;
    int32_t triangles = 0, frames = 0;
    kiriCounts counts = World_Counts(world, sheet);
    kiriTotals totals = World_Totals(world, sheet);
    for (int32_t i = 0; i < counts.pieces; ++i) {
        OK(kiriSheet_GetPiece(world, sheet, i, &state));
        area += state.area;
        triangles += state.triangles;
        frames += state.frames;
    }
    FUZZ_CHECK(triangles <= counts.triangles && frames <= counts.frames, "pieces have %d triangles of %d",
               (int)triangles, (int)counts.triangles);
    FUZZ_CHECK(fabs(area - totals.area) <= 1e-9 * totals.area, "pieces have an area of %.12g, the sheet of %.12g", area,
               totals.area);
}

static double AreaOf(const kiriWorld* world)
{
    double area = 0.0;
    for (int32_t i = 0; i < world->sheets.count; ++i) {
        kiriTotals totals = World_Totals(world, world->sheets.data[i]->id);
        area += totals.area;
    }
    return area;
}

static void CheckArea(Fuzz* fuzz, const FuzzCall* call, kiriResult result)
{
    /* An end is rounded by a step of the lattice, which of a sliver may be that of the sheet it was cut out of. */
    double area = AreaOf(fuzz->hosts[0].world), by = fuzz->slack + 1e-9, rounding = fuzz->slack > 0.0 ? 1e-9 : 0.0;
    if ((call->flags & FUZZ_DESTROYS) != 0) {
        fuzz->mayShrink = fuzz->mayShrink || result == KIRI_PENDING;
        FUZZ_CHECK(area <= fuzz->area * (1.0 + by) + rounding, "%s: the area grows to %.12g", call->name, area);
        fuzz->area = area;
    } else if (strcmp(call->name, "CreateSheet") == 0) {
        fuzz->area = area;
    }
    if (fuzz->mayShrink && area < fuzz->area) {
        fuzz->area = area;
    }
    FUZZ_CHECK(fabs(area - fuzz->area) <= by * fuzz->area + rounding, "%s: the area was %.12g, and is %.12g",
               call->name, fuzz->area, area);
}

static void CheckWorld(const Fuzz* fuzz, int32_t k)
{
    kiriWorld* world = fuzz->hosts[k].world;
    Host_Validate(&fuzz->hosts[k]);
    for (int32_t i = 0; i < world->sheets.count; ++i) {
        CheckFinite(world, world->sheets.data[i]->id);
        CheckPieces(world, world->sheets.data[i]->id);
    }
}

/* J: of motion and height. The size of the parts tells what rounding may be, with speeds of 1e-4 sizes a second. */
static double EnergyOf(const kiriWorld* world, double scale, double* size)
{
    const double gravity[3] = { world->gravity.x, world->gravity.y, world->gravity.z };
    double energy = 0.0;
    *size = 0.0;
    for (int32_t i = 0; i < world->sheets.count; ++i) {
        kiriTotals totals = World_Totals(world, world->sheets.data[i]->id);
        energy += totals.kineticEnergy;
        *size += totals.kineticEnergy + 1e-5 * totals.mass * scale * scale;
        for (int k = 0; k < 3; ++k) {
            energy -= totals.mass * gravity[k] * totals.center[k];
            *size += totals.mass * fabs(gravity[k] * totals.center[k]);
        }
    }
    return energy;
}

/* So far away that doubles hardly tell points of a sheet apart: then strains come of rounding. */
static bool IsFarAway(const kiriWorld* world, double scale)
{
    bool isFar = false;
    for (int32_t i = 0; i < world->sheets.count; ++i) {
        kiriTotals totals = World_Totals(world, world->sheets.data[i]->id);
        for (int k = 0; k < 3; ++k) {
            isFar = isFar || fabs(totals.center[k]) > 1e9 * scale;
        }
    }
    return isFar;
}

/* Where nothing but gravity and what calls gave acts on sheets that began without strain, no tick adds to the energy of
   motion and height: so no speed comes from nowhere. A line that is clamped may be bent, or its pieces apart, once they
   have moved: it is pulled straight. */
static void CheckEnergy(Fuzz* fuzz, const FuzzCall* call, const FuzzAct* act, double before, kiriResult result)
{
    double size, energy = EnergyOf(fuzz->hosts[0].world, fuzz->scale, &size);
    const kiriSheetDef* def = &act->def.sheet;
    bool isCreated = strcmp(call->name, "CreateSheet") == 0;
    bool pulls = strcmp(call->name, "ClampLine") == 0 && fuzz->ticks > 0 && result >= 0;
    fuzz->energySize = size > fuzz->energySize ? size : fuzz->energySize;
    fuzz->isStirred = fuzz->isStirred || ((call->flags & FUZZ_STIRS) != 0 && result >= 0) || fuzz->mayShrink || pulls ||
                      (isCreated && (def->paper.popping || def->touchesSheets)) ||
                      IsFarAway(fuzz->hosts[0].world, fuzz->scale);
    if ((call->flags & FUZZ_TICKS) == 0) {
        fuzz->energy += energy - before;
    } else if (!fuzz->isStirred) {
        FUZZ_CHECK(energy <= fuzz->energy + 1e-3 * fuzz->energySize, "a tick has %g J, of %g", energy, fuzz->energy);
    }
}

/* No tick counts more items than its limit, but for a single linear system that is larger, and for up to three systems a
   substep where a step starts again. The three kinds of work on cuts share the limit. Their steps are all smaller than the
   least limit, count as all of it, or are paid in parts. */
static void CheckBudget(const kiriWorld* world, kiriResult result)
{
    enum { MOST_MORE = 3 * 4 }; /* of mean size; fuzzers make at most 4 substeps */
    kiriProfile profile = World_Profile(world);
    const int32_t limits[] = { world->budget.triangles, world->budget.cells, world->budget.samples,
                               world->budget.iterations };
    const int32_t items[] = { profile.trianglesSplit, profile.cellsSettled, profile.samplesRefreshed,
                              profile.solverIterations };
    double share = 0.0;
    for (int i = 0; i < 4; ++i) {
        share += i < 3 && limits[i] > 0 ? (double)items[i] / limits[i] : 0.0;
        bool isKept = result < 0 || limits[i] == 0 || items[i] <= limits[i];
        bool startsAgain = i == 3 && (items[i] - limits[i]) * profile.systemsSolved <= MOST_MORE * items[i];
        FUZZ_CHECK(isKept || startsAgain, "a tick counts %d of %d items of kind %d", (int)items[i], (int)limits[i], i);
    }
    FUZZ_CHECK(result < 0 || share <= 1.0 + 1e-9, "work on cuts takes %.17g of a tick", share);
}

static bool IsAtWork(const kiriWorld* world)
{
    for (int32_t i = 0; i < world->sheets.count; ++i) {
        if (world->sheets.data[i]->queue.count > 0) {
            return true;
        }
    }
    return false;
}

static void CompareWorlds(const Fuzz* fuzz, const char* name)
{
    const kiriWorld *a = fuzz->hosts[0].world, *b = fuzz->hosts[1].world;
    FUZZ_CHECK(a->sheets.count == b->sheets.count, "%s: %d and %d sheets", name, (int)a->sheets.count,
               (int)b->sheets.count);
    for (int32_t i = 0; i < a->sheets.count && !IsAtWork(a); ++i) {
        FUZZ_CHECK(Layout_Hash(a, a->sheets.data[i]->id) == Layout_Hash(b, b->sheets.data[i]->id),
                   "%s: what cuts left in sheet %d differs", name, (int)i);
    }
    FUZZ_CHECK(Host_Hash(&fuzz->hosts[0]) == Host_Hash(&fuzz->hosts[1]), "%s: state hashes differ", name);
    FUZZ_CHECK(Look_World(a) == Look_World(b), "%s: the worlds look different", name);
}

/* ---- A call ---- */

/* A hash may tell of work that is made again, see kiriWorld_GetStateHash. */
static bool MayHashMove(const Fuzz* fuzz, int32_t k, kiriResult result)
{
    const kiriWorld* world = fuzz->hosts[k].world;
    bool isLimited = world->budget.cells > 0 || world->budget.samples > 0;
    return result == KIRI_ERROR_MEMORY && (isLimited || IsAtWork(world));
}

/* Refused, it leaves all as it was, and says why. */
static kiriResult CallOnce(Fuzz* fuzz, int32_t k, const FuzzCall* call, FuzzAct* act)
{
    Host* host = &fuzz->hosts[k];
    bool looks = (call->flags & FUZZ_TICKS) != 0 || (act->nulls != 0);
    uint64_t hash = Host_Hash(host), look = looks ? Look_World(host->world) : 0;
    memset(&act->said, 0, sizeof(act->said));
    kiriResult result = call->call(host->world, act);
    bool mayMove = result == KIRI_ERROR_MEMORY && (call->flags & FUZZ_TICKS) != 0;
    if ((result < 0 && result != KIRI_DIVERGED && !mayMove && (call->flags & FUZZ_SEVERAL) == 0) ||
        (call->flags & FUZZ_READS) != 0) {
        FUZZ_CHECK(Host_Hash(host) == hash || MayHashMove(fuzz, k, result), "%s gives %s, and changes the world",
                   call->name, kiriGetResultName(result));
        FUZZ_CHECK(!looks || Look_World(host->world) == look, "%s gives %s, and changes what is seen", call->name,
                   kiriGetResultName(result));
        FUZZ_CHECK(act->said.id == 0, "%s gives %s and an id", call->name, kiriGetResultName(result));
    }
    if ((call->flags & (FUZZ_READS | FUZZ_SEVERAL)) == 0) {
        FUZZ_CHECK((result < 0) == (kiriWorld_GetLastError(host->world)[0] != '\0'), "%s gives %s and the line \"%s\"",
                   call->name, kiriGetResultName(result), kiriWorld_GetLastError(host->world));
    }
    return result;
}

/* Makes a call with memory refused at the n-th request, and again without. Ticks are left out: they go on. */
static kiriResult CallPoorly(Fuzz* fuzz, int32_t k, const FuzzCall* call, FuzzAct* act, int32_t n)
{
    Host* host = &fuzz->hosts[k];
    if (n > 0 && (call->flags & (FUZZ_SEVERAL | FUZZ_TICKS)) == 0) {
        host->failAt = host->calls + n - 1;
        kiriResult result = CallOnce(fuzz, k, call, act);
        host->failAt = -1;
        if (result != KIRI_ERROR_MEMORY) {
            return result;
        }
        Host_Validate(host);
    }
    return CallOnce(fuzz, k, call, act);
}

static void KeepIds(Fuzz* fuzz, const FuzzCall* call, const FuzzAct* act)
{
    if (call->makes != NULL) {
        FuzzIds_Add(call->makes(fuzz), act->said.id);
    }
    for (int i = 0; i < 4 && strcmp(call->name, "DetachPieces") == 0; ++i) {
        FuzzIds_Add(&fuzz->sheets, act->said.ids[i]);
    }
    if ((call->flags & (FUZZ_TICKS | FUZZ_MAKES_SHEET)) == 0) {
        return;
    }
    kiriWorld* world = fuzz->hosts[0].world;
    const kiriEvent* events;
    int32_t count;
    OK(kiriWorld_GetEvents(world, &events, &count));
    for (int32_t i = 0; i < count && (call->flags & FUZZ_TICKS) != 0; ++i) {
        if (events[i].type == KIRI_EVENT_PIECE_DETACHED) {
            FuzzIds_Add(&fuzz->sheets, events[i].sheet);
        }
        FuzzIds_Add(&fuzz->frames, events[i].frame);
    }
    for (int32_t i = 0; i < world->sheets.count && (call->flags & FUZZ_MAKES_SHEET) != 0; ++i) {
        kiriFrame frames[4];
        OK(kiriSheet_GetFrames(world, world->sheets.data[i]->id, frames, 4, &count));
        for (int32_t f = 0; f < count && f < 4; ++f) {
            FuzzIds_Add(&fuzz->frames, frames[f]);
        }
    }
}

/* Is there enough of it? */
static bool IsTooMuch(const Fuzz* fuzz, const FuzzCall* call)
{
    const kiriWorld* world = fuzz->hosts[0].world;
    bool isFull =
        fuzz->pins.count >= FUZZ_IDS || world->obstacles.count >= 6 || world->blades.count >= 4 || world->seams.count >= 4 ||
        fuzz->sheetsMade > 3;
    return (call->flags & FUZZ_ADDS) != 0 && isFull;
}

static void Report(const FuzzCall* call, kiriResult result)
{
    if (getenv("FUZZ_TRACE") != NULL) {
        fprintf(stderr, "%s: %s\n", call->name, kiriGetResultName(result));
    }
}

void Fuzz_Make(Fuzz* fuzz, const FuzzCall* call, FuzzAct* act)
{
    int32_t n = fuzz->twin == FUZZ_REFUSED || fuzz->twin == FUZZ_ALONE ? FuzzBytes_Below(&fuzz->bytes, 48) - 15 : 0;
    if (IsTooMuch(fuzz, call)) {
        return;
    }
    if (fuzz->twin == FUZZ_REFUSED && FuzzBytes_Below(&fuzz->bytes, 16) == 0) {
        n += 40 * FuzzBytes_Below(&fuzz->bytes, 32);
    }
    kiriResult results[2] = { KIRI_OK, KIRI_OK };
    double size, energy = EnergyOf(fuzz->hosts[0].world, fuzz->scale, &size);
    FuzzAct other = *act;
    results[0] = CallPoorly(fuzz, 0, call, act, fuzz->twin == FUZZ_ALONE ? n : 0);
    Report(call, results[0]);
    if (fuzz->hostCount > 1) {
        if (fuzz->twin == FUZZ_SCRATCH && strcmp(call->name, "CreateSheet") == 0) {
            other.def.sheet.paper.fromScratch = 1;
        }
        results[1] = CallPoorly(fuzz, 1, call, &other, fuzz->twin == FUZZ_REFUSED ? n : 0);
        FUZZ_CHECK(results[0] == results[1], "%s gives %s and %s", call->name, kiriGetResultName(results[0]),
                   kiriGetResultName(results[1]));
        FUZZ_CHECK(memcmp(&act->said, &other.said, sizeof(act->said)) == 0, "%s says different things", call->name);
    }
    fuzz->sheetsMade += (call->flags & FUZZ_ADDS) != 0 && call->makes != NULL && act->said.id != 0 &&
                        strcmp(call->name, "CreateSheet") == 0;
    KeepIds(fuzz, call, act);
    CheckArea(fuzz, call, results[0]);
    CheckEnergy(fuzz, call, act, energy, results[0]);
    if ((call->flags & FUZZ_READS) == 0) {
        for (int32_t k = 0; k < fuzz->hostCount; ++k) {
            if ((call->flags & FUZZ_TICKS) != 0) {
                CheckWorld(fuzz, k);
                CheckBudget(fuzz->hosts[k].world, results[k]);
            } else {
                Host_Validate(&fuzz->hosts[k]);
            }
        }
        if (fuzz->hostCount > 1) {
            CompareWorlds(fuzz, call->name);
        }
    }
    if ((call->flags & (FUZZ_MAKES_SHEET | FUZZ_DESTROYS)) != 0 && fuzz->ticks > 0) {
        fuzz->slack = 1e-6; /* lips have become slanted edges of an outline */
    }
    fuzz->ticks += (call->flags & FUZZ_TICKS) != 0;
}

int32_t Fuzz_CountTriangles(const Fuzz* fuzz)
{
    const kiriWorld* world = fuzz->hosts[0].world;
    int32_t count = 0;
    for (int32_t i = 0; i < world->sheets.count; ++i) {
        count += world->sheets.data[i]->mesh.triangles.count;
    }
    return count;
}

/* ---- Start and end ---- */

static const FuzzCall* CallNamed(const char* name)
{
    for (int32_t i = 0; i < fuzzCallCount; ++i) {
        if (strcmp(fuzzCalls[i].name, name) == 0) {
            return &fuzzCalls[i];
        }
    }
    return NULL;
}

void Fuzz_Start(Fuzz* fuzz, const uint8_t* data, size_t size)
{
    static const float scales[] = { 1.0f, 1.0f, 1.0f, 0.1f, 30.0f, 1e-3f, 1e4f, 1.0f };
    memset(fuzz, 0, sizeof(*fuzz));
    fuzz->bytes.data = data;
    fuzz->bytes.size = size;
    fuzz->twin = (FuzzTwin)FuzzBytes_Below(&fuzz->bytes, FUZZ_TWINS);
    fuzz->hostCount = fuzz->twin == FUZZ_ALONE ? 1 : 2;
    uint32_t kind = FuzzBytes_Get(&fuzz->bytes);
    fuzz->scale = scales[kind & 7];
    float gravity[3] = { 0.0f, (kind & 8) != 0 ? 2.0f : 0.0f, (kind & 16) != 0 ? 0.0f : -9.81f };
    bool isLimited = (kind & 96) == 96 && (fuzz->twin == FUZZ_ALONE || fuzz->twin == FUZZ_TASKS);
    kiriBudget budget = { 0, 0, 0, 0 };
    if (isLimited) {
        budget.triangles = KIRI_LEAST_TRIANGLES + FuzzBytes_Below(&fuzz->bytes, 64);
        budget.cells = 4 * FuzzBytes_Below(&fuzz->bytes, 256);
        budget.samples = FuzzBytes_Below(&fuzz->bytes, 256);
        budget.iterations = FuzzBytes_Below(&fuzz->bytes, 16);
    }
    for (int32_t k = 0; k < fuzz->hostCount; ++k) {
        StartHost(fuzz, k, gravity, &budget);
    }
    FuzzAct act;
    const FuzzCall* create = CallNamed("CreateSheet");
    FuzzAct_Read(&act, fuzz, create->needs);
    Fuzz_Make(fuzz, create, &act);
}

/* A sheet that is new is cut into two. Without a budget each tick does all that was asked for before one tick, also
   where it says KIRI_DIVERGED of another sheet. */
static void CheckStillWorks(Host* host, int32_t ticks)
{
    static const float down[3] = { 0.0f, 0.0f, -9.81f }, across[4] = { -0.1f, 0.41f, 1.1f, 0.43f };
    const kiriBudget none = { 0, 0, 0, 0 };
    host->failAt = -1;
    OK(kiriWorld_SetBudget(host->world, &none));
    OK(kiriWorld_SetGravity(host->world, down));
    kiriSheetDef def = Host_SmallDef();
    def.position[0] = 1e3f;
    def.groups = 0;
    kiriSheet sheet = Host_AddRectangle(host, &def, 1.0f, 1.0f, 4, 4);
    Host_Cut(host, sheet, across, 2);
    kiriResult result = KIRI_PENDING;
    for (int32_t tick = 0; tick < 2 || (tick < ticks + 2 && (result == KIRI_PENDING || IsAtWork(host->world)));
         ++tick) {
        result = kiriWorld_Tick(host->world, 1.0f / 60.0f, 1);
    }
    FUZZ_CHECK(result == KIRI_OK || result == KIRI_DIVERGED, "a tick at the end gives %s", kiriGetResultName(result));
    FUZZ_CHECK(!IsAtWork(host->world), "work waits without a budget");
    FUZZ_CHECK(Host_Counts(host, sheet).pieces == 2, "a sheet is not cut");
}

/* What it became is restored in another world, where it is saved and loaded when the work at hand is done. */
static void LoadInAnother(const Host* host)
{
    START_HOST(other);
    World_Copy(other.world, host->world, kiriWorld_Snapshot);
    FUZZ_CHECK(Host_Hash(&other) == Host_Hash(host), "a snapshot is restored as another world");
    kiriResult result = kiriWorld_FinishCuts(other.world);
    FUZZ_CHECK(result == KIRI_OK || result == KIRI_ERROR_LIMIT, "work is not finished: %s", kiriGetResultName(result));
    int64_t size = 0;
    if (result == KIRI_OK && kiriWorld_Save(other.world, NULL, 0, &size) == KIRI_OK) {
        uint64_t hash = Host_Hash(&other);
        World_Copy(other.world, other.world, kiriWorld_Save);
        FUZZ_CHECK(Host_Hash(&other) == hash, "a save is loaded as another world");
    }
}

void Fuzz_Stop(Fuzz* fuzz)
{
    for (int32_t k = 0; k < fuzz->hostCount; ++k) {
        LoadInAnother(&fuzz->hosts[k]);
        CheckStillWorks(&fuzz->hosts[k], fuzz->ticks);
        CheckWorld(fuzz, k);
        kiriDestroyWorld(fuzz->hosts[k].world);
        FUZZ_CHECK(fuzz->hosts[k].live == 0, "%lld blocks are not freed", (long long)fuzz->hosts[k].live);
    }
}
