#include "kiri_call.h"
#include "kiri_draw.h"

#include <string.h>

void kiriDefaultDebugDraw(kiriDebugDraw* draw)
{
    if (draw != NULL) {
        memset(draw, 0, sizeof(*draw));
        draw->cookie = KIRI_COOKIE(kiriDebugDraw);
        draw->flags = KIRI_DRAW_ALL & ~(KIRI_DRAW_TRIANGLES | KIRI_DRAW_EDGES);
        draw->size = 0.05f;
    }
}

static void BeginBatch(kiriDrawBatch* batch, kiriDrawFn* draw, void* user)
{
    batch->draw = draw;
    batch->user = user;
    batch->count = 0;
}

static void DrawWorld(kiriDrawing* drawing)
{
    const kiriWorld* world = drawing->world;
    for (int32_t i = 0; i < world->sheets.count; ++i) {
        kiriDrawing_Sheet(drawing, world->sheets.data[i]);
    }
    if ((drawing->flags & KIRI_DRAW_OBSTACLES) != 0) {
        kiriDrawing_Obstacles(drawing);
    }
    if ((drawing->flags & KIRI_DRAW_BLADES) != 0) {
        kiriDrawing_Blades(drawing);
    }
}

kiriResult kiriWorld_DebugDraw(const kiriWorld* world, const kiriDebugDraw* draw)
{
    KIRI_READS(world);
    KIRI_CHECK(draw != NULL, "draw is null");
    if (draw->cookie != KIRI_COOKIE(kiriDebugDraw)) {
        return KIRI_FAIL(KIRI_ERROR_DEF, "draw was not filled by kiriDefaultDebugDraw");
    }
    KIRI_CHECK((draw->flags & ~(uint32_t)KIRI_DRAW_ALL) == 0, "flags has more than those of KIRI_DRAW");
    KIRI_CHECK(kiriCall_IsAbove(draw->size, 0.0f), "size is not finite, or not above 0");
    kiriDrawing drawing;
    drawing.world = world;
    drawing.flags = draw->flags;
    drawing.size = draw->size;
    BeginBatch(&drawing.points, draw->points, draw->user);
    BeginBatch(&drawing.lines, draw->lines, draw->user);
    BeginBatch(&drawing.triangles, draw->triangles, draw->user);
    const kiriSheetData* only = kiriCall_Owner(&world->sheetIds, draw->sheet);
    if (only == NULL && draw->sheet != 0) {
        return KIRI_FAIL(KIRI_ERROR_ID, "there is no sheet with this id");
    }
    kiriCall_BeginCallbacks(world);
    if (only != NULL) {
        kiriDrawing_Sheet(&drawing, only);
    } else {
        DrawWorld(&drawing);
    }
    kiriDrawing_End(&drawing);
    kiriCall_EndCallbacks(world);
    return KIRI_OK;
}
