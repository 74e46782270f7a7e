/* Tasks on threads of the host: whatever these are, and in whatever order they work, a tick gives the same bits. */
#define _POSIX_C_SOURCE 200809L

#include "crew.h"
#include "host.h"

enum { SHEETS = 9, BODIES = 5 };

/* ---- A host with threads ---- */

typedef struct Team {
    Host host; /* first: its hooks get the team */
    Crew crew;
    bool isBackwards;       /* no threads: the caller does all at once, from the last range on */
    int32_t started, split; /* tasks; tasks of several ranges */
    kiriSheet sheets[SHEETS];
    kiriObstacle bodies[BODIES];
} Team;

static void DoBackwards(const Crew* crew)
{
    for (int32_t start = (crew->items - 1) / crew->range * crew->range; start >= 0; start -= crew->range) {
        crew->task(start, start + crew->range < crew->items ? start + crew->range : crew->items, crew->context);
    }
}

static void* StartTask(void* user, kiriTaskFn* task, int32_t itemCount, int32_t minRange, void* context)
{
    Team* team = user;
    assert_false(team->crew.isBusy);
    assert_true(itemCount > 0 && minRange > 0);
    ++team->started;
    team->split += itemCount > minRange;
    Crew_Begin(&team->crew, task, itemCount, minRange, context);
    if (team->isBackwards) {
        DoBackwards(&team->crew);
        team->crew.isBusy = false;
        return NULL;
    }
    return team;
}

static void FinishTask(void* user, void* handle)
{
    assert_ptr_equal(user, handle);
    Crew_Finish(&((Team*)user)->crew);
}

/* Within a task the library asks the host for nothing. */
static void* CrewAlloc(void* user, int64_t bytes)
{
    assert_false(((Team*)user)->crew.isBusy);
    return Host_Alloc(user, bytes);
}

static void CrewFree(void* user, void* pointer)
{
    assert_false(((Team*)user)->crew.isBusy);
    Host_Free(user, pointer);
}

static double CrewClock(void* user)
{
    assert_false(((Team*)user)->crew.isBusy);
    return 0.0;
}

/* Of 0 workers it gives no tasks; of fewer than 0 it works backwards. */
static void Team_Start(Team* team, int32_t workers)
{
    memset(team, 0, sizeof(*team));
    team->host.failAt = -1;
    team->host.every = 12;
    team->isBackwards = workers < 0;
    kiriWorldDef def = Host_Def(&team->host);
    def.alloc = CrewAlloc;
    def.free = CrewFree;
    def.clock = CrewClock;
    def.user = team;
    def.startTask = workers != 0 ? StartTask : NULL;
    def.finishTask = workers != 0 ? FinishTask : NULL;
    def.workerCount = workers < 0 ? 4 : workers;
    assert_true(Crew_Start(&team->crew, workers));
    OK(kiriCreateWorld(&def, &team->host.world));
}

static void Team_Stop(Team* team)
{
    Crew_Stop(&team->crew);
    Host_Stop(&team->host);
}

/* ---- A scene ---- */

static kiriObstacle AddBody(Team* team, int32_t type, const float position[3], float mass, uint32_t body)
{
    kiriObstacle obstacle = 0;
    kiriObstacleDef def = ObstacleOf(type);
    def.radius = 0.2f;
    memcpy(def.position, position, sizeof(def.position));
    def.mass = mass;
    for (int k = 0; k < 3; ++k) {
        def.inertia[k] = 0.016f * mass;
    }
    def.body = body;
    OK(kiriCreateObstacle(team->host.world, &def, &obstacle));
    return obstacle;
}

static kiriSheet AddSheet(Team* team, float x, float y, float z, int32_t squares)
{
    kiriSheetDef def = Host_SmallDef();
    Set3(def.position, x, y, z);
    def.touchesSheets = 1;
    return Host_AddRectangle(&team->host, &def, 1.0f, 1.0f, squares, squares);
}

/* A floor; two sheets that lie on each other; two balls, each under two sheets, the second one of a body with a third
   ball; a sheet that hangs on a ball, which lies on another sheet. */
static void Build(Team* team)
{
    static const float first[3] = { 1.2f, 0.5f, 0.3f }, second[3] = { 4.2f, 0.5f, 0.3f },
                       third[3] = { 5.4f, 0.5f, 0.3f }, fourth[3] = { 7.5f, 0.5f, 0.6f };
    static const float spots[SHEETS][3] = {
        { 0.15f, 0.0f, 0.52f }, { 4.0f, 0.0f, 0.52f }, { 1.15f, 0.0f, 0.53f },
        { 3.0f, 0.0f, 0.52f },  { 5.2f, 0.0f, 0.53f }, { 0.2f, 2.0f, 0.05f },
        { 0.25f, 2.05f, 0.1f }, { 7.0f, 0.0f, 0.35f }, { 7.5f, 0.5f, 0.9f },
    };
    team->bodies[0] = AddBody(team, KIRI_OBSTACLE_PLANE, noVector, 0.0f, 0);
    team->bodies[1] = AddBody(team, KIRI_OBSTACLE_SPHERE, first, 0.3f, 0);
    team->bodies[2] = AddBody(team, KIRI_OBSTACLE_SPHERE, second, 0.4f, 7);
    team->bodies[3] = AddBody(team, KIRI_OBSTACLE_SPHERE, third, 0.4f, 7);
    team->bodies[4] = AddBody(team, KIRI_OBSTACLE_SPHERE, fourth, 0.2f, 0);
    for (int32_t i = 0; i < SHEETS; ++i) {
        team->sheets[i] = AddSheet(team, spots[i][0], spots[i][1], spots[i][2], i == 5 ? 46 : 4 + 2 * (i % 4));
    }
    kiriPinDef pin = Host_PinDef(0.0f, 0.0f, spots[8][0], spots[8][1], spots[8][2]);
    pin.obstacle = team->bodies[4];
    World_AddPin(team->host.world, team->sheets[8], &pin);
}

/* The host moves its bodies by what sheets gave them. */
static void MoveBodies(Team* team, float dt)
{
    for (int32_t i = 1; i < BODIES; ++i) {
        kiriObstacleState state = World_ObstacleState(team->host.world, team->bodies[i]);
        for (int k = 0; k < 3; ++k) {
            state.velocity[k] += (float)state.impulse[k] / 0.4f - (k == 2 ? 9.81f * dt : 0.0f);
        }
        OK(kiriObstacle_SetVelocity(team->host.world, team->bodies[i], state.velocity, state.angularVelocity));
    }
}

static void Do(Team* team, int32_t tick)
{
    static const float across[4] = { -0.1f, 0.45f, 1.1f, 0.55f }, slit[4] = { 0.3f, 0.3f, 0.7f, 0.7f };
    if (tick % 10 == 3) {
        Host_Cut(&team->host, team->sheets[tick / 10 % SHEETS], across, 2);
        Host_Cut(&team->host, team->sheets[(tick / 10 + 4) % SHEETS], slit, 2);
    }
    MoveBodies(team, 0.01f);
}

/* ---- Comparing ---- */

static void CompareSheets(const Team* a, const Team* b)
{
    for (int32_t i = 0; i < SHEETS; ++i) {
        kiriMesh left = Host_Mesh(&a->host, a->sheets[i]), right = Host_Mesh(&b->host, b->sheets[i]);
        size_t bytes = 3 * sizeof(float) * (size_t)left.vertexCount;
        assert_int_equal(left.vertexCount, right.vertexCount);
        assert_memory_equal(left.positions, right.positions, bytes);
        assert_memory_equal(left.normals, right.normals, bytes);
    }
}

static void CompareWorlds(const Team* a, const Team* b)
{
    const kiriEvent *first, *second;
    int32_t firstCount, secondCount;
    assert_true(Host_Hash(&a->host) == Host_Hash(&b->host));
    kiriProfile left = World_Profile(a->host.world);
    kiriProfile right = World_Profile(b->host.world);
    assert_memory_equal(&left, &right, sizeof(left));
    OK(kiriWorld_GetEvents(a->host.world, &first, &firstCount));
    OK(kiriWorld_GetEvents(b->host.world, &second, &secondCount));
    assert_int_equal(firstCount, secondCount);
    assert_memory_equal(first, second, sizeof(*first) * (size_t)firstCount);
    for (int32_t i = 0; i < BODIES; ++i) {
        kiriObstacleState one = World_ObstacleState(a->host.world, a->bodies[i]);
        kiriObstacleState other = World_ObstacleState(b->host.world, b->bodies[i]);
        assert_memory_equal(one.impulse, other.impulse, sizeof(one.impulse));
        assert_memory_equal(one.angularImpulse, other.angularImpulse, sizeof(one.angularImpulse));
    }
    CompareSheets(a, b);
}

/* Returns how many contacts there were in all ticks. */
static int64_t Compare(int32_t workers, const kiriBudget* budget, int32_t ticks)
{
    static Team team, alone;
    int64_t contacts = 0;
    Team_Start(&team, workers);
    Team_Start(&alone, 0);
    Build(&team);
    Build(&alone);
    OK(kiriWorld_SetBudget(team.host.world, budget));
    OK(kiriWorld_SetBudget(alone.host.world, budget));
    for (int32_t tick = 0; tick < ticks; ++tick) {
        Do(&team, tick);
        Do(&alone, tick);
        assert_int_equal(Host_Tick(&team.host, 0.01f, 2), Host_Tick(&alone.host, 0.01f, 2));
        CompareWorlds(&team, &alone);
        kiriProfile profile = World_Profile(team.host.world);
        contacts += profile.contacts;
    }
    assert_int_equal(alone.started, 0);
    assert_true(workers == 1 ? team.started == 0 : team.split > ticks);
    Team_Stop(&team);
    Team_Stop(&alone);
    return contacts;
}

/* ---- Tests ---- */

TEST(AnyCrewGivesTheSameBits)
{
    static const int32_t crews[] = { -1, 1, 2, 16 };
    static const kiriBudget all = { 0, 0, 0, 0 };
    for (size_t i = 0; i < sizeof(crews) / sizeof(*crews); ++i) {
        assert_true(Compare(crews[i], &all, 36) > 1000);
    }
}

/* Systems for about one sheet in three: those share what is left that come first. */
TEST(SoItDoesOnABudget)
{
    static const kiriBudget tight = { 32, 60, 40, 14 }, wide = { 64, 200, 100, 120 };
    Compare(-1, &tight, 24);
    Compare(4, &tight, 24);
    Compare(-1, &wide, 24);
    Compare(4, &wide, 24);
}

/* Tasks of one tick of sheets in free fall, beside an obstacle or not. */
static int32_t TasksOfFall(bool hasObstacle)
{
    static const float below[3] = { 0.0f, 0.0f, -100.0f };
    static Team team;
    Team_Start(&team, 2);
    for (int32_t i = 0; i < 4; ++i) {
        AddSheet(&team, 2.0f * (float)i, 0.0f, 0.5f, 6);
    }
    if (hasObstacle) {
        AddBody(&team, KIRI_OBSTACLE_PLANE, below, 0.0f, 0);
    }
    Host_Tick(&team.host, 0.01f, 2);
    int32_t before = team.started;
    Host_Tick(&team.host, 0.01f, 2);
    int32_t tasks = team.started - before;
    Team_Stop(&team);
    return tasks;
}

TEST(SheetsLookForObstaclesInATask)
{
    assert_int_equal(TasksOfFall(true), TasksOfFall(false) + 1);
}

TEST(HooksComeTogether)
{
    Host host;
    kiriWorld* world = NULL;
    memset(&host, 0, sizeof(host));
    host.failAt = -1;
    kiriWorldDef def = Host_Def(&host);
    def.startTask = StartTask;
    assert_int_equal(kiriCreateWorld(&def, &world), KIRI_ERROR_ARGUMENT);
    assert_null(world);
    def.startTask = NULL;
    def.workerCount = 2;
    assert_int_equal(kiriCreateWorld(&def, &world), KIRI_ERROR_ARGUMENT);
    def.startTask = StartTask;
    def.finishTask = FinishTask;
    def.workerCount = -1;
    assert_int_equal(kiriCreateWorld(&def, &world), KIRI_ERROR_ARGUMENT);
    def.workerCount = 1025;
    assert_int_equal(kiriCreateWorld(&def, &world), KIRI_ERROR_ARGUMENT);
    def.workerCount = 1024;
    OK(kiriCreateWorld(&def, &world));
    kiriDestroyWorld(world);
    assert_int_equal(host.live, 0);
}
