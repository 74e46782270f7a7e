#include "kiri_island.h"
#include "../core/kiri_array.h"
#include "../sheet/kiri_motion.h"
#include "../sheet/kiri_pin.h"
#include "../sheet/kiri_touch.h"
#include "kiri_seam.h"

#define FAR_UNDER 1e9 /* m: offset of planes that nothing can touch */

/* ---- Clusters ---------------------------------------------------------------------------------------------------- */

bool kiriIslands_FindClusters(kiriWorld* world)
{
    kiriIslands* islands = &world->islands;
    int32_t count = world->sheets.count;
    if (!kiriArrays_Resize(&world->memory, count, &islands->clusters, &islands->next, &islands->isJoined,
                           &islands->systems, &islands->firstBodies)) {
        return false;
    }
    kiriUnion_Init(islands->clusters.data, count);
    KIRI_TIMES(i, count) {
        islands->isJoined.data[i] = 0;
        world->sheets.data[i]->probes.sheet = i;
    }
    KIRI_EACH_OF(kiriSeamData, seam, world->seams) {
        KIRI_EACH(const kiriStitchData, stitch, seam->stitches) {
            const kiriSheetData *a = kiriStitch_Sheet(world, stitch, 0), *b = kiriStitch_Sheet(world, stitch, 1);
            islands->isJoined.data[a->probes.sheet] |= kiriSheet_IsActive(a);
            islands->isJoined.data[b->probes.sheet] |= kiriSheet_IsActive(b);
            if (kiriSheet_IsActive(a) && kiriSheet_IsActive(b)) {
                kiriUnion_Join(islands->clusters.data, a->probes.sheet, b->probes.sheet);
            }
        }
    }
    KIRI_EACH(const kiriPairTouch, touch, world->pairs.touches) {
        int32_t upper = touch->upper.sheet->probes.sheet, lower = touch->lower.sheet->probes.sheet;
        if (touch->touch != KIRI_NONE) {
            islands->isJoined.data[upper] = 1;
            if (kiriSheet_IsActive(touch->lower.sheet)) {
                islands->isJoined.data[lower] = 1;
                kiriUnion_Join(islands->clusters.data, upper, lower);
            }
        }
    }
    return true;
}

int32_t kiriIslands_ClusterOf(kiriIslands* islands, int32_t sheet)
{
    return islands->isJoined.data[sheet] ? kiriUnion_Root(islands->clusters.data, sheet) : KIRI_NONE;
}

/* Lists the active sheets of each cluster, from the root on, in the order of sheets. */
static void ListClusters(kiriWorld* world)
{
    kiriIslands* islands = &world->islands;
    KIRI_EACH_LISTED(at, world->active) {
        islands->next.data[at] = KIRI_NONE;
    }
    KIRI_EACH_INDEX_BACK(k, world->active) {
        int32_t i = world->active.data[k], root = kiriIslands_ClusterOf(islands, i);
        if (root != KIRI_NONE && root != i) {
            islands->next.data[i] = islands->next.data[root];
            islands->next.data[root] = i;
        }
    }
}

/* ---- Islands ----------------------------------------------------------------------------------------------------- */

/* Begins the motion of the sheets of clusters, and numbers their bodies. Returns the number of bodies. */
static int32_t BeginClusters(kiriWorld* world, double dt)
{
    kiriIslands* islands = &world->islands;
    int32_t count = 0;
    KIRI_EACH_LISTED(i, world->active) {
        if (islands->isJoined.data[i]) {
            kiriSheetData* sheet = world->sheets.data[i];
            kiriMotion_Begin(sheet, world->gravity, dt, NULL, &islands->systems.data[i]);
            islands->firstBodies.data[i] = count;
            count += sheet->layout.pieces.count;
        }
    }
    return count;
}

static int32_t NumberOfBody(const kiriIslands* islands, const kiriSheetData* sheet, int32_t frame)
{
    return islands->firstBodies.data[sheet->probes.sheet] + sheet->layout.framePiece.data[frame];
}

/* Joins the rows of mutual contacts to their second points, and the bodies of both. A second point that does not move
   leaves the plane fixed. */
static void JoinRows(kiriWorld* world)
{
    kiriIslands* islands = &world->islands;
    KIRI_EACH(const kiriPairTouch, touch, world->pairs.touches) {
        kiriSheetData *upper = touch->upper.sheet, *lower = touch->lower.sheet;
        if (touch->touch == KIRI_NONE || upper->rest.asleep) {
            continue;
        }
        const kiriTouch* found = &upper->touches.found.data[touch->touch];
        if (found->row == KIRI_NONE) {
            continue;
        }
        kiriContactRow* row = &upper->touches.rows.data[found->row];
        if (!kiriTouches_JoinRow(upper, found, touch->distance, lower, touch->lower.vertex, touch->lower.share)) {
            continue;
        }
        int32_t a = NumberOfBody(islands, upper, row->weights[0].frame);
        int32_t b = NumberOfBody(islands, lower, row->otherWeights[0].frame);
        kiriUnion_Join(islands->parents.data, a, b);
        islands->numbers.data[a] = islands->numbers.data[b] = 0;
    }
}

/* Writes the rows of stitches, and joins the bodies of both ends. */
static void JoinStitches(kiriWorld* world, double dt)
{
    kiriIslands* islands = &world->islands;
    KIRI_EACH_OF(kiriSeamData, seam, world->seams) {
        seam->rows.count = seam->stitches.count;
        KIRI_EACH_INDEX(k, seam->rows) {
            kiriStitchRow* row = &seam->rows.data[k];
            kiriSheetData* sheets[2] = { NULL, NULL };
            bool isMoved = kiriSeam_WriteRow(world, seam, k, dt, sheets);
            row->body = KIRI_NONE;
            KIRI_TIMES_WHILE(isMoved, end, 2) {
                if (sheets[end] != NULL) {
                    KIRI_ASSERT(row->counts[end] > 0);
                    int32_t frame = row->members[end * row->counts[0]].frame;
                    int32_t body = NumberOfBody(islands, sheets[end], frame);
                    row->body = row->body == KIRI_NONE ? body : row->body;
                    kiriUnion_Join(islands->parents.data, row->body, body);
                    islands->numbers.data[body] = 0;
                }
            }
        }
    }
}

/* Lists the stitches of each island. Links are made from the last row on, so that each list ascends. */
static void ListStitches(kiriWorld* world)
{
    kiriIslands* islands = &world->islands;
    KIRI_EACH_INDEX_BACK(i, world->seams) {
        kiriSeamData* seam = world->seams.data[i];
        KIRI_EACH_INDEX_BACK(k, seam->rows) {
            kiriStitchRow* row = &seam->rows.data[k];
            if (row->body != KIRI_NONE) {
                KIRI_ASSERT_HAS(islands->numbers, row->body);
                KIRI_ASSERT(islands->numbers.data[row->body] < islands->count);
                kiriIsland* island = &islands->islands.data[islands->numbers.data[row->body]];
                row->next = island->stitches;
                island->stitches = row;
            }
        }
    }
}

/* Lists the bodies of islands: first counts them, then fills the spans. Returns the number of islands. */
static int32_t ListIslands(kiriWorld* world)
{
    kiriIslands* islands = &world->islands;
    int32_t count = 0, bodies = 0;
    KIRI_EACH_INDEX(b, islands->parents) {
        int32_t root = kiriUnion_Root(islands->parents.data, b);
        if (islands->numbers.data[b] != KIRI_NONE) {
            if (root == b) {
                islands->islands.data[count].bodies = (kiriSpan){ 0 };
                islands->islands.data[count].stitches = NULL;
            }
            islands->numbers.data[b] = root == b ? count++ : islands->numbers.data[root];
            islands->islands.data[islands->numbers.data[b]].bodies.count += 1;
        }
    }
    KIRI_TIMES(n, count) {
        islands->islands.data[n].bodies.first = bodies;
        bodies += islands->islands.data[n].bodies.count;
        islands->islands.data[n].bodies.count = islands->islands.data[n].iterations = 0;
    }
    KIRI_EACH_LISTED(i, world->active) {
        kiriSheetData* sheet = world->sheets.data[i];
        KIRI_EACH_INDEX_WHILE(islands->isJoined.data[i], p, sheet->layout.pieces) {
            int32_t number = islands->numbers.data[islands->firstBodies.data[i] + p];
            if (number != KIRI_NONE) {
                kiriSpan* span = &islands->islands.data[number].bodies;
                kiriIslandBody body = { sheet->solver, &islands->systems.data[i], p };
                islands->bodies.data[span->first + span->count++] = body;
                int32_t* iterations = &islands->islands.data[number].iterations;
                *iterations = kiriMax(kiriMotion_Iterations(sheet), *iterations);
            }
        }
    }
    return count;
}

bool kiriIslands_Prepare(kiriWorld* world, double dt)
{
    kiriIslands* islands = &world->islands;
    kiriMemory* memory = &world->memory;
    ListClusters(world);
    int32_t count = BeginClusters(world, dt), had = islands->islands.count;
    islands->count = 0;
    bool ok = kiriArrays_Resize(memory, count, &islands->parents, &islands->numbers, &islands->bodies) &&
              (had >= count || kiriArray_Resize(memory, &islands->islands, count));
    KIRI_FROM_TO_WHILE(ok, n, had, islands->islands.count) {
        KIRI_CLEAR(&islands->islands.data[n]);
    }
    if (ok) {
        kiriUnion_Init(islands->parents.data, count);
        KIRI_TIMES(b, count) {
            islands->numbers.data[b] = KIRI_NONE;
        }
        JoinRows(world);
        JoinStitches(world, dt);
        islands->count = ListIslands(world);
        ListStitches(world);
    }
    KIRI_TIMES_WHILE(ok, n, islands->count) {
        kiriIsland* island = &islands->islands.data[n];
        const kiriIslandBody* bodies = &islands->bodies.data[island->bodies.first];
        island->solver = bodies[0].solver;
        ok = kiriSolver_PrepareIsland(island->solver, memory, &island->matrix, bodies, island->bodies.count,
                                      island->stitches);
    }
    if (!ok) {
        islands->count = 0;
    }
    KIRI_EACH_WHILE(!ok, const kiriPairTouch, touch, world->pairs.touches) { /* leave the contacts out of this tick */
        kiriTouches* touches = &touch->upper.sheet->touches;
        int32_t at = touch->touch != KIRI_NONE ? touches->found.data[touch->touch].row : KIRI_NONE;
        if (at != KIRI_NONE) {
            kiriContactRow* row = &touches->rows.data[at];
            row->other = NULL;
            row->offset = -FAR_UNDER;
            row->force = kiriVec3_Make(0.0, 0.0, 0.0); /* else the first system expects this push again */
        }
    }
    return ok;
}

/* ---- Motion ------------------------------------------------------------------------------------------------------ */

/* Returns the island of a body; null: it moves alone. */
static kiriIsland* IslandOf(kiriIslands* islands, int32_t sheet, int32_t piece)
{
    bool mayBeIn = islands->count > 0 && islands->isJoined.data[sheet];
    int32_t number = mayBeIn ? islands->numbers.data[islands->firstBodies.data[sheet] + piece] : KIRI_NONE;
    return number != KIRI_NONE ? &islands->islands.data[number] : NULL;
}

static bool IsFirst(const kiriIslands* islands, const kiriIsland* island, const kiriSheetData* sheet, int32_t piece)
{
    const kiriIslandBody* first = &islands->bodies.data[island->bodies.first];
    return first->solver == sheet->solver && first->body == piece;
}

/* Returns the work of a linear system of a body that moves alone, or, with its first body, of an island. */
static int64_t WorkAt(const kiriWorld* world, int32_t i, int32_t piece)
{
    const kiriIslands* islands = &world->islands;
    const kiriSheetData* sheet = world->sheets.data[i];
    const kiriIsland* island = IslandOf((kiriIslands*)islands, i, piece);
    if (island == NULL) {
        return kiriMotion_WorkOf(sheet, piece);
    }
    return IsFirst(islands, island, sheet, piece)
               ? kiriSolver_WorkOfIsland(island->matrix.matrix, &islands->bodies.data[island->bodies.first],
                                         island->bodies.count)
               : 0;
}

/* Moves all bodies of a cluster by one step. `work` sums the work of the n-th systems of all bodies and islands. Fails
   if the solver does. */
static bool StepCluster(kiriWorld* world, int32_t cluster, double dt, int64_t most, int64_t* work)
{
    kiriIslands* islands = &world->islands;
    KIRI_EACH_OF_CLUSTER(i, islands, cluster) {
        kiriSheetData* sheet = world->sheets.data[i];
        int32_t systems = (int32_t)kiriMin(most, INT32_MAX), iterations = kiriMotion_Iterations(sheet);
        KIRI_EACH_LISTED_WHILE(!sheet->rest.asleep, body, sheet->solver->moved.bodies) {
            kiriIsland* island = IslandOf(islands, i, body);
            int32_t solved = 0;
            if (island == NULL) {
                solved = kiriSolver_Step(sheet->solver, &islands->systems.data[i], body, dt, iterations, systems);
            } else if (IsFirst(islands, island, sheet, body)) {
                solved = kiriSolver_StepIsland(island->solver, island->matrix.matrix,
                                               &islands->bodies.data[island->bodies.first], island->bodies.count,
                                               island->stitches, dt, island->iterations, systems);
            }
            if (solved < 0) {
                return false;
            }
            KIRI_ASSERT(solved <= KIRI_MOST_ROUNDS);
            int64_t each = WorkAt(world, i, body);
            KIRI_TIMES(k, solved) {
                work[k] += each;
            }
        }
    }
    return true;
}

/* Returns the items of one linear system of each island of the cluster. */
static int64_t ItemsOfCluster(const kiriWorld* world, int32_t cluster)
{
    const kiriIslands* islands = &world->islands;
    int64_t work = 0;
    KIRI_EACH_OF_CLUSTER(i, islands, cluster) {
        kiriSheetData* sheet = world->sheets.data[i];
        KIRI_EACH_LISTED_WHILE(!sheet->rest.asleep, body, sheet->solver->moved.bodies) {
            work += WorkAt(world, i, body);
        }
    }
    return kiriSolver_ItemsOf(work);
}

int64_t kiriIslands_MostItems(const kiriWorld* world, int32_t cluster, int32_t substeps)
{
    return (int64_t)substeps * KIRI_MOST_ROUNDS * ItemsOfCluster(world, cluster);
}

/* Runs the substeps; fewer and longer ones if the quota requires it, with at least one system each. */
static kiriProgress TakeSubsteps(kiriWorld* world, int32_t cluster, double dt, int32_t substeps, kiriQuota* systems)
{
    const kiriIslands* islands = &world->islands;
    int64_t items = ItemsOfCluster(world, cluster), left = kiriMotion_SystemsLeft(systems, items);
    substeps = left < substeps ? (int32_t)left : substeps;
    KIRI_TIMES(s, substeps) {
        int64_t work[KIRI_MOST_ROUNDS] = { 0 };
        KIRI_EACH_OF_CLUSTER(i, islands, cluster) {
            KIRI_EACH(kiriYieldRow, row, world->sheets.data[i]->touches.yields) {
                double share = (s > 0 ? 1.0 : 1.0 - substeps) / substeps;
                row->impulse.force = kiriVec3_AddScaled(row->impulse.force, share, row->lent);
            }
            if (!world->sheets.data[i]->rest.asleep) {
                kiriFollow_Step(world->sheets.data[i], s, substeps, dt / substeps);
            }
        }
        left = kiriMax(kiriMotion_SystemsLeft(systems, items) - (substeps - 1 - s), 1);
        if (!StepCluster(world, cluster, dt / substeps, left, work)) {
            return KIRI_FAILED;
        }
        for (int32_t k = 0; k < KIRI_MOST_ROUNDS && work[k] > 0; ++k) {
            int64_t done = kiriSolver_ItemsOf(work[k]);
            systems->left = kiriMax(systems->left - done, 0);
            systems->used += done;
        }
    }
    return substeps > 0 ? KIRI_DONE : KIRI_MORE;
}

void kiriIslands_Move(kiriWorld* world, int32_t cluster, double dt, int32_t substeps, kiriQuota* systems)
{
    const kiriIslands* islands = &world->islands;
    kiriProgress progress = TakeSubsteps(world, cluster, dt, substeps, systems);
    KIRI_EACH_OF_CLUSTER(i, islands, cluster) {
        kiriSheetData* sheet = world->sheets.data[i];
        kiriProgress* own = &world->moves.of.data[i].progress;
        *own = sheet->rest.asleep ? KIRI_DONE : progress;
        kiriMotion_End(sheet, *own, !sheet->rest.asleep, dt);
    }
}
