#include "kiri_tearing.h"

#include "../sheet/kiri_piece.h"
#include "../sheet/kiri_tear.h"

#define RESTING 0.5 /* s: a tear that does not go on for this long ends */
#define PAUSE 1.5   /* ticks: frames that moved with the tip come to rest before it is measured again */
#define TIPS 8       /* that tear at a time, if the host names no number */
#define LOOKS 4      /* tips measured in a tick, for each that may tear */

/* Adds a point to a tear; null: begins one at the tip. */
static kiriResult GoOn(kiriWorld* world, kiriSheetData* sheet, const kiriTearTip* tip, kiriCutData* cut, kiriVec2 to,
                       kiriVec2 along)
{
    if (!kiriArray_Reserve(&world->memory, &world->events, (int64_t)world->events.count + 1) ||
        !kiriArray_Reserve(&world->memory, &sheet->queue, (int64_t)sheet->queue.count + 2)) {
        return KIRI_ERROR_MEMORY;
    }
    if (cut == NULL) {
        kiriResult result = kiriWorld_AddCut(world, sheet, 2, &cut);
        if (result != KIRI_OK) {
            return result;
        }
        kiriWorld_QueuePoint(world, cut, kiriMesh_Local(&sheet->mesh, tip->point), true);
        kiriWorld_AddEvent(world, KIRI_EVENT_TEAR_BEGAN, sheet)->cut = cut->id;
        world->newEvents += 1;
    }
    KIRI_ASSERT(cut->sheet == sheet && cut->waiting <= 1 && !cut->ended);
    kiriWorld_QueuePoint(world, cut, to, false);
    cut->tears = along;
    cut->rests = 0.0;
    return KIRI_OK;
}

/* Measures tears, and a number of other tips, by turns. */
static kiriResult GrowIn(kiriWorld* world, kiriSheetData* sheet, double dt)
{
    const kiriTearing* tearing = &sheet->settings.tearing;
    const kiriTears* tears = &sheet->tears;
    kiriResult result = kiriTears_Measure(sheet) ? KIRI_OK : KIRI_ERROR_MEMORY;
    int32_t count = tears->order.count, left = tearing->maxTips > 0 ? tearing->maxTips : TIPS;
    int32_t looks = (int32_t)kiriMin((int64_t)LOOKS * left, (int64_t)count);
    int32_t first = count > 0 ? (int32_t)(world->ticks * looks % count) : 0;
    double most = tearing->maxSpeed > 0.0f ? tearing->maxSpeed * dt : 1e9;
    for (int32_t n = 0; result == KIRI_OK && n < count && left > 0; ++n) {
        kiriTearTip tip = tears->found.data[tears->order.data[(first + n) % count]];
        kiriCutData* cut = NULL;
        KIRI_EACH_OF(kiriCutData, each, sheet->cuts) {
            bool isThere = each->tip.blade.at.x == tip.point.x && each->tip.blade.at.y == tip.point.y;
            cut = isThere && kiriCut_IsTear(each) && !each->ended ? each : cut;
        }
        int32_t piece = kiriPiece_OfVertex(sheet, tip.vertex);
        bool isDue = cut != NULL ? cut->waiting == 0 && cut->rests > PAUSE * dt : n < looks;
        if (!isDue || !kiriPiece_IsAwake(&sheet->layout.pieces.data[piece])) {
            continue;
        }
        tip.along = cut != NULL ? cut->tears : tip.along;
        kiriVec2 along, to = kiriTear_Next(sheet, &tip, most, &along), from = kiriMesh_Local(&sheet->mesh, tip.point);
        if (to.x != from.x || to.y != from.y) {
            result = GoOn(world, sheet, &tip, cut, to, along);
            left -= 1;
        }
    }
    return result;
}

kiriResult kiriTears_Grow(kiriWorld* world, double dt)
{
    kiriResult result = KIRI_OK;
    KIRI_EACH_ACTIVE(sheet, world) {
        if (result == KIRI_OK && kiriTears_MayGrow(sheet) && sheet->update->stage == KIRI_NONE) {
            result = GrowIn(world, sheet, dt);
        }
    }
    return result;
}

void kiriTears_EndResting(kiriWorld* world, double dt)
{
    KIRI_EACH_ACTIVE(sheet, world) {
        KIRI_EACH_OF(kiriCutData, cut, sheet->cuts) {
            cut->rests += kiriCut_IsTear(cut) && cut->waiting == 0 ? dt : 0.0;
            if (cut->rests > RESTING && !cut->ended &&
                kiriArray_Reserve(&world->memory, &sheet->queue, (int64_t)sheet->queue.count + 1)) {
                kiriWorld_EndCut(world, cut);
            }
        }
    }
}
