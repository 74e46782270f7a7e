#include "kiri_pair_work.h"

#include "../core/kiri_union_find.h"
#include "../motion/kiri_prediction.h"
#include "../sheet/kiri_update.h"

#include <string.h>

#define HARD 0.01      /* J/kg: a piece that loses more of its motion pushed others too hard */
#define PUSH_SLACK 0.5 /* m/s: a piece whose pushes are twice their sum and more, beyond this speed, is squeezed */

/* ---- Which pieces touch ---- */

/* Counts pieces as they are now, or as a ready update will make them. */
static int32_t MostPieces(const kiriSheetData* sheet)
{
    bool isReady = sheet->update->stage == KIRI_READY && sheet->update->cut.meshChanged;
    int32_t now = sheet->layout.pieces.count, next = isReady ? sheet->update->next.pieces.count : 0;
    return kiriMax(next, now);
}

bool kiriPairs_ReserveIslands(kiriWorld* world)
{
    int64_t count = 0;
    for (int32_t k = 0; k < world->active.count; ++k) {
        const kiriSheetData* sheet = kiriWorld_Active(world, k);
        count += kiriPair_TakesPart(sheet) ? MostPieces(sheet) : 0;
    }
    return kiriArray_Reserve(&world->memory, &world->pairs.parents, count) &&
           kiriArray_Reserve(&world->memory, &world->pairs.islands, count);
}

/* Makes an island of each piece that is awake. */
static void ListIslands(kiriWorld* world)
{
    kiriPairs* pairs = &world->pairs;
    pairs->islands.count = 0;
    for (int32_t k = 0; k < world->active.count; ++k) {
        kiriSheetData* sheet = kiriWorld_Active(world, k);
        for (int32_t p = 0; kiriPair_TakesPart(sheet) && p < sheet->layout.pieces.count; ++p) {
            kiriPiece* piece = &sheet->layout.pieces.data[p];
            piece->island = KIRI_NONE;
            if (kiriPiece_IsAwake(piece)) {
                KIRI_ASSERT(pairs->islands.count < pairs->islands.capacity);
                piece->island = pairs->islands.count;
                memset(&pairs->islands.data[pairs->islands.count++], 0, sizeof(kiriIsland));
            }
        }
    }
    KIRI_ASSERT(pairs->islands.count <= pairs->parents.capacity);
    pairs->parents.count = pairs->islands.count;
    kiriUnion_Init(pairs->parents.data, pairs->parents.count);
}

/* Joins the islands of pairs that touch, or of all pairs in the list. */
static void JoinPairs(kiriWorld* world, const kiriTouchingPairs* list, bool areAll)
{
    kiriPairs* pairs = &world->pairs;
    for (int32_t i = 0; i < list->count; ++i) {
        const kiriTouchingPair* pair = &list->data[i];
        const kiriPiece *upper = kiriPair_PieceOf(world, pair->upper), *lower = kiriPair_PieceOf(world, pair->lower);
        bool areThere = upper != NULL && lower != NULL && kiriPiece_IsAwake(upper) && kiriPiece_IsAwake(lower);
        if (areThere && (areAll || pair->touches)) {
            kiriUnion_Join(pairs->parents.data, upper->island, lower->island);
        }
    }
}

static kiriIsland* RootOf(kiriPairs* pairs, int32_t piece)
{
    return &pairs->islands.data[kiriUnion_Root(pairs->parents.data, piece)];
}

/* A frame that is awake, of a piece in an island. */
typedef struct Member {
    kiriIsland *piece, *island;
    kiriFrameData* frame;
    const kiriMaterial* material;
} Member;

typedef void MemberFn(const Member* member);

static void ForMembers(kiriWorld* world, MemberFn* visit)
{
    kiriPairs* pairs = &world->pairs;
    for (int32_t k = 0; k < world->active.count; ++k) {
        kiriSheetData* sheet = kiriWorld_Active(world, k);
        for (int32_t f = 0; kiriPair_TakesPart(sheet) && f < sheet->frames.count; ++f) {
            const kiriPiece* piece = kiriSheet_PieceOf(sheet, f);
            if (kiriPiece_IsAwake(piece)) {
                Member member = { &pairs->islands.data[piece->island], RootOf(pairs, piece->island),
                                  &sheet->frames.data[f], &sheet->settings.material };
                visit(&member);
            }
        }
    }
}

/* ---- Energy ---- */

static void AddGained(const Member* member)
{
    kiriIsland *piece = member->piece, *island = member->island;
    const kiriFrameData* frame = member->frame;
    piece->gained += frame->gained;
    piece->passed += frame->passed;
    piece->mass += frame->mass;
    piece->kinetic += kiriFrame_KineticEnergy(frame, member->material);
    island->isHeld |= frame->held != 0;
    island->whole += frame->mass;
    island->velocity = kiriVec3_AddScaled(island->velocity, frame->mass, frame->velocity);
    island->velocity = kiriVec3_Sub(island->velocity, frame->received);
}

/* Returns the energy that the piece gained, above 0, or passed on to others, below 0. A piece pays for gains of
   others only with the energy that it passed on. */
static double DueOf(const kiriIsland* piece)
{
    double passed = kiriMin(piece->passed, 0.0);
    return kiriMax(piece->gained, passed);
}

/* Returns the kinetic energy by mass that the piece has without its gain, J/kg. */
static double OwnHeat(const kiriIsland* piece)
{
    return (piece->kinetic - kiriMax(piece->gained, 0.0)) / piece->mass;
}

static void SumDues(kiriPairs* pairs)
{
    for (int32_t i = 0; i < pairs->islands.count; ++i) {
        const kiriIsland* piece = &pairs->islands.data[i];
        kiriIsland* island = RootOf(pairs, i);
        double due = DueOf(piece);
        island->surplus += due;
        island->sources += kiriMax(due, 0.0);
        island->moving += piece->kinetic;
        island->pieces += 1;
        island->mostHeat = kiriMax(OwnHeat(piece), island->mostHeat);
    }
}

/* Marks islands that pins or obstacles hold, and sums the pushes of other pieces on each piece. */
static void FindPushes(kiriWorld* world)
{
    kiriPairs* pairs = &world->pairs;
    for (int32_t k = 0; k < world->active.count; ++k) {
        kiriSheetData* sheet = kiriWorld_Active(world, k);
        for (int32_t i = 0; kiriPair_TakesPart(sheet) && i < sheet->layout.pinFrame.count; ++i) {
            const kiriPiece* piece = kiriSheet_PieceOf(sheet, sheet->layout.pinFrame.data[i]);
            if (kiriPiece_IsAwake(piece)) {
                RootOf(pairs, piece->island)->isHeld = true;
            }
        }
        for (int32_t i = 0; kiriPair_TakesPart(sheet) && i < sheet->touches.rows.count; ++i) {
            const kiriContactRow* row = &sheet->touches.rows.data[i];
            const kiriPiece* piece = kiriSheet_PieceOf(sheet, row->weights[0].frame);
            double pushed = kiriVec3_Length(row->impulse);
            if (!(pushed > 0.0) || !kiriPiece_IsAwake(piece)) {
                continue;
            }
            if (row->cushion > 0.0) {
                kiriIsland* slot = &pairs->islands.data[piece->island];
                slot->pushed += pushed;
                slot->push = kiriVec3_Add(slot->push, row->impulse);
            } else {
                RootOf(pairs, piece->island)->isHeld = true;
            }
        }
    }
}

/* True if the island keeps its momentum: nothing holds it, and the pieces that exchanged momentum are all in it. */
static bool IsOwn(const kiriIsland* island)
{
    return !island->isHeld && island->pieces > 1;
}

/* Returns the factor that takes `energy` out of velocities with the energy `kinetic`. */
static double KeepWithout(double kinetic, double energy)
{
    return energy > 0.0 ? energy < kinetic ? sqrt(1.0 - energy / kinetic) : 0.0 : 1.0;
}

/* Limits each piece that gained to the speed of the fastest piece of its island without gains. In an island that
   something holds it also loses its share of the surplus. */
static void LimitPieces(kiriPairs* pairs)
{
    for (int32_t i = 0; i < pairs->islands.count; ++i) {
        kiriIsland *piece = &pairs->islands.data[i], *island = RootOf(pairs, i);
        double due = DueOf(piece), above = piece->kinetic - piece->mass * island->mostHeat;
        double part = IsOwn(island) || !(island->surplus > 0.0) ? 0.0 : island->surplus / island->sources;
        double taken = kiriMax(above, part * due);
        piece->keep = due > 0.0 ? KeepWithout(piece->kinetic, kiriMin(taken, due)) : 1.0;
        piece->keepPush = taken > HARD * piece->mass ? piece->keep : 1.0;
        double speed = sqrt(2.0 * piece->kinetic / piece->mass), push = kiriVec3_Length(piece->push);
        double most = 2.0 * push + piece->mass * (speed + PUSH_SLACK);
        piece->keepPush *= piece->pushed > most ? most / piece->pushed : 1.0;
    }
}

static void ScalePiece(const Member* member)
{
    kiriFrameData* frame = member->frame;
    double keep = member->piece->keep;
    if (keep < 1.0 && !frame->held) {
        frame->velocity = kiriVec3_Scale(keep, frame->velocity);
        frame->spin = kiriVec3_Scale(keep, frame->spin);
        frame->rate = kiriMat3_Scale(keep, &frame->rate);
    }
}

static void AddMemberMotion(const Member* member)
{
    kiriIsland* island = member->island;
    const kiriFrameData* frame = member->frame;
    island->left += kiriFrame_KineticEnergy(frame, member->material);
    island->mean = kiriVec3_AddScaled(island->mean, frame->mass / island->whole, frame->velocity);
}

/* Finds the mean velocity that the momentum of an island asks for, and the part of all other motion that stays. */
static void LimitIslands(kiriWorld* world)
{
    kiriPairs* pairs = &world->pairs;
    ForMembers(world, AddMemberMotion);
    for (int32_t i = 0; i < pairs->islands.count; ++i) {
        kiriIsland* island = &pairs->islands.data[i];
        if (island == RootOf(pairs, i)) {
            double half = 0.5 * island->whole, beside = island->left - half * kiriVec3_Dot(island->mean, island->mean);
            island->velocity = kiriVec3_Scale(1.0 / island->whole, island->velocity);
            double whole = half * kiriVec3_Dot(island->velocity, island->velocity);
            island->keepBeside = KeepWithout(beside, beside - (island->moving - island->surplus - whole));
        }
    }
}

static void ScaleBeside(const Member* member)
{
    kiriFrameData* frame = member->frame;
    const kiriIsland* island = member->island;
    if (IsOwn(island) && !frame->held) {
        frame->velocity =
            kiriVec3_AddScaled(island->velocity, island->keepBeside, kiriVec3_Sub(frame->velocity, island->mean));
        frame->spin = kiriVec3_Scale(island->keepBeside, frame->spin);
        frame->rate = kiriMat3_Scale(island->keepBeside, &frame->rate);
    }
}

/* A push and its reaction belong to different ticks, and planes push out deep points: so pieces could gain more energy
   from each other than they pass on. An island that nothing holds keeps its momentum and loses the surplus of energy
   from its other motion. In other islands the pieces that gained lose it. */
void kiriPairs_LimitEnergy(kiriWorld* world)
{
    ListIslands(world);
    JoinPairs(world, &world->pairs.pairs, true);
    JoinPairs(world, &world->pairs.next, true); /* pairs of the last tick: their loads acted in this one */
    if (world->pairs.islands.count == 0) {
        return;
    }
    ForMembers(world, AddGained);
    SumDues(&world->pairs);
    FindPushes(world);
    LimitPieces(&world->pairs);
    ForMembers(world, ScalePiece);
    LimitIslands(world);
    ForMembers(world, ScaleBeside);
}

/* ---- Calm ---- */

void kiriPairs_JoinCalm(kiriWorld* world)
{
    kiriPairs* pairs = &world->pairs;
    ListIslands(world);
    JoinPairs(world, &pairs->pairs, false);
    for (int32_t i = 0; i < pairs->islands.count; ++i) {
        pairs->islands.data[i].calm = HUGE_VAL;
    }
    for (int isGiven = 0; isGiven < 2; ++isGiven) {
        for (int32_t k = 0; k < world->active.count; ++k) {
            kiriSheetData* sheet = kiriWorld_Active(world, k);
            for (int32_t p = 0; kiriPair_TakesPart(sheet) && p < sheet->layout.pieces.count; ++p) {
                kiriRest* rest = &sheet->layout.pieces.data[p].rest;
                if (!kiriPiece_IsAwake(&sheet->layout.pieces.data[p])) {
                    continue;
                }
                kiriIsland* island = RootOf(pairs, sheet->layout.pieces.data[p].island);
                if (isGiven) {
                    rest->calm = island->calm;
                } else {
                    island->calm = kiriMin(rest->calm, island->calm);
                }
            }
        }
    }
}
