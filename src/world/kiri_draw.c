/* Debug draw: points, lines and triangles of the inside of a world, handed to the host in batches. Allocates nothing. */
#include "kiri_call.h"
#include "../sheet/kiri_piece.h"
#include "../sheet/kiri_seen.h"
#include "../sheet/kiri_obstacle.h"
#include "../sheet/kiri_touch.h"
#include "kiri_blade.h"

#include <math.h>

/* ---- Batches ----------------------------------------------------------------------------------------------------- */

enum { BATCH_VERTICES = 240 }; /* whole lines and triangles */

typedef struct Batch {
    kiriDrawFn* draw; /* null: nothing is drawn */
    int32_t count;
    kiriDrawVertex vertices[BATCH_VERTICES];
} Batch;

typedef struct Drawing {
    void* user;
    uint32_t flags; /* KIRI_DRAW_... */
    double size;    /* m, of axes and normals */
    Batch batches[3]; /* of points, lines and triangles */
} Drawing;

static uint32_t Color(uint32_t red, uint32_t green, uint32_t blue)
{
    return 0xff000000u | blue << 16 | green << 8 | red;
}

static void FlushBatch(Drawing* drawing, Batch* batch)
{
    if (batch->count > 0) {
        batch->draw(drawing->user, batch->vertices, batch->count);
    }
    batch->count = 0;
}

/* Draws a point, a line or a triangle, by the count of its corners. */
static void Draw(Drawing* drawing, const kiriVec3* corners, int32_t count, uint32_t color)
{
    KIRI_ASSERT(count >= 1 && count <= 3);
    Batch* batch = &drawing->batches[count - 1];
    if (batch->draw == NULL) {
        return;
    }
    if (batch->count + count > BATCH_VERTICES) {
        FlushBatch(drawing, batch);
    }
    KIRI_TIMES(i, count) {
        kiriDrawVertex* vertex = &batch->vertices[batch->count++];
        kiriVec3_Store(vertex->position, corners[i]);
        vertex->color = color;
    }
}

static void DrawLine(Drawing* drawing, kiriVec3 from, kiriVec3 to, uint32_t color)
{
    const kiriVec3 ends[2] = { from, to };
    Draw(drawing, ends, 2, color);
}

/* ---- Mesh -------------------------------------------------------------------------------------------------------- */

/* Neighbours in the list of pieces have different colours. Sleeping pieces are paler. */
static uint32_t ColorOfPiece(const kiriSheetData* sheet, int32_t piece)
{
    static const uint8_t colors[8][3] = { { 230, 159, 0 }, { 86, 180, 233 }, { 0, 158, 115 },   { 240, 228, 66 },
                                          { 0, 114, 178 }, { 213, 94, 0 },   { 204, 121, 167 }, { 150, 150, 150 } };
    KIRI_ASSERT_HAS(sheet->layout.pieces, piece);
    const uint8_t* c = colors[piece % 8];
    uint32_t pale = sheet->layout.pieces.data[piece].rest.asleep ? 1 : 0;
    return Color((c[0] + 255 * pale) >> pale, (c[1] + 255 * pale) >> pale, (c[2] + 255 * pale) >> pale);
}

/* Draws an edge between two triangles with the triangle that has the lower half-edge. */
static void DrawEdges(Drawing* drawing, const kiriSheetData* sheet, int32_t triangle, const kiriVec3 corners[3])
{
    KIRI_EACH_CORNER(k) {
        int32_t h = 3 * triangle + k;
        KIRI_ASSERT(h >= 0 && h < 3 * sheet->mesh.triangles.count);
        bool isBorder = kiriMesh_IsBorder(&sheet->mesh, h);
        uint32_t flag = isBorder ? KIRI_DRAW_BORDERS : KIRI_DRAW_EDGES;
        if ((drawing->flags & flag) != 0 && (isBorder || h < kiriMesh_Twin(&sheet->mesh, h))) {
            DrawLine(drawing, corners[k], corners[(k + 1) % 3], isBorder ? Color(200, 30, 30) : Color(110, 115, 125));
        }
    }
}

static void DrawMesh(Drawing* drawing, const kiriSheetData* sheet)
{
    KIRI_EACH_INDEX(t, sheet->mesh.triangles) {
        int32_t piece = kiriPiece_OfTriangle(sheet, t);
        if (sheet->layout.pieces.data[piece].isGone) {
            continue;
        }
        kiriVec3 corners[3];
        KIRI_EACH_CORNER(k) {
            corners[k] = kiriSurface_DrawnAt(&sheet->seen.surface, sheet->mesh.triangles.data[t].vertex[k]);
        }
        if ((drawing->flags & KIRI_DRAW_TRIANGLES) != 0) {
            Draw(drawing, corners, 3, ColorOfPiece(sheet, piece));
        }
        DrawEdges(drawing, sheet, t, corners);
    }
}

/* ---- Boxes ------------------------------------------------------------------------------------------------------- */

enum { BOXES_A_PASS = 64 };

/* Returns corner i of eight: bits 0, 1 and 2 select the upper x, y and z. */
static kiriVec3 CornerOfBox(const kiriBox* box, int i)
{
    return kiriVec3_Make((i & 1) != 0 ? box->upper.x : box->lower.x, (i & 2) != 0 ? box->upper.y : box->lower.y,
                         (i & 4) != 0 ? box->upper.z : box->lower.z);
}

/* Draws boxes of BOXES_A_PASS pieces in one pass over the vertices. Lists of pieces would need memory. */
static void DrawBoxesFrom(Drawing* drawing, const kiriSheetData* sheet, int32_t first)
{
    KIRI_ASSERT(first >= 0 && first % BOXES_A_PASS == 0);
    kiriBox boxes[BOXES_A_PASS];
    KIRI_TIMES(i, BOXES_A_PASS) {
        boxes[i] = KIRI_EMPTY_BOX;
    }
    KIRI_EACH_INDEX(v, sheet->mesh.vertices) {
        int32_t piece = kiriPiece_OfVertex(sheet, v);
        if (piece >= first && piece < first + BOXES_A_PASS && !sheet->layout.pieces.data[piece].isGone) {
            kiriBox_Add(&boxes[piece - first], kiriSurface_DrawnAt(&sheet->seen.surface, v));
        }
    }
    KIRI_TIMES(i, BOXES_A_PASS) {
        KIRI_TIMES_WHILE(boxes[i].lower.x <= boxes[i].upper.x, edge, 24) {
            int corner = edge / 3, bit = 1 << edge % 3;
            if ((corner & bit) == 0) {
                DrawLine(drawing, CornerOfBox(&boxes[i], corner), CornerOfBox(&boxes[i], corner | bit),
                         ColorOfPiece(sheet, first + i));
            }
        }
    }
}

/* ---- Frames and links -------------------------------------------------------------------------------------------- */

static void DrawFrames(Drawing* drawing, const kiriSheetData* sheet)
{
    KIRI_EACH_INDEX(i, sheet->frames) {
        const kiriFrameData* frame = &sheet->frames.data[i];
        if (kiriSheet_IsGone(sheet, i)) {
            continue;
        }
        kiriVec3 at = kiriFrame_Carry(frame, frame->site.at);
        Draw(drawing, &at, 1, frame->held ? Color(220, 40, 40) : Color(25, 25, 30));
        DrawLine(drawing, at, kiriVec3_AddScaled(at, drawing->size, frame->A.u), Color(230, 40, 40));
        DrawLine(drawing, at, kiriVec3_AddScaled(at, drawing->size, frame->A.v), Color(40, 170, 40));
        DrawLine(drawing, at, kiriVec3_AddScaled(at, drawing->size, frame->A.d), Color(40, 40, 230));
    }
}

/* Draws each link by way of the middle of its border, at the mean of the two places where its frames carry it. */
static void DrawLinks(Drawing* drawing, const kiriSheetData* sheet)
{
    const uint32_t color = Color(30, 30, 35);
    KIRI_EACH(const kiriLink, link, sheet->links.links) {
        KIRI_ASSERT(link->i >= 0 && link->i < sheet->frames.count && link->j >= 0 && link->j < sheet->frames.count);
        const kiriFrameData *a = &sheet->frames.data[link->i], *b = &sheet->frames.data[link->j];
        if (kiriSheet_IsGone(sheet, link->i)) {
            continue;
        }
        kiriVec3 middle = kiriVec3_Add(kiriFrame_Carry(a, link->centroid), kiriFrame_Carry(b, link->centroid));
        middle = kiriVec3_Scale(0.5, middle);
        DrawLine(drawing, kiriFrame_Carry(a, a->site.at), middle, color);
        DrawLine(drawing, middle, kiriFrame_Carry(b, b->site.at), color);
    }
}

/* ---- Pins and contacts ------------------------------------------------------------------------------------------- */

static void DrawPin(Drawing* drawing, const kiriSheetData* sheet, const kiriPinData* pin)
{
    const uint32_t color = Color(170, 0, 170);
    kiriPointPlace place;
    Draw(drawing, &pin->target, 1, color);
    if (pin->type != KIRI_PIN_POINT) {
        kiriVec2 half = kiriVec2_Sub(kiriMesh_Local(&sheet->mesh, pin->to), kiriMesh_Local(&sheet->mesh, pin->at));
        kiriVec3 way = kiriVec3_AddScaled(kiriVec3_Scale(0.5 * half.x, pin->rotation.u), 0.5 * half.y, pin->rotation.v);
        DrawLine(drawing, kiriVec3_Sub(pin->target, way), kiriVec3_Add(pin->target, way), color);
    } else if (kiriPoint_Find(sheet, pin->at, &place)) {
        DrawLine(drawing, pin->target, kiriPoint_Position(sheet, &place), color);
    }
}

static void DrawContacts(Drawing* drawing, const kiriSheetData* sheet, const kiriTouchMemory* memory)
{
    const uint32_t color = Color(0, 150, 170);
    KIRI_EACH(const kiriTouch, touch, memory->touches) {
        kiriVec3 force = kiriTouches_ForceOf(sheet, touch->key);
        if (kiriVec3_Dot(force, force) > 0.0) {
            kiriVec3 at = kiriTouch_Seen(sheet, touch);
            Draw(drawing, &at, 1, color);
            DrawLine(drawing, at, kiriVec3_AddScaled(at, drawing->size, touch->normal), color);
        }
    }
}

/* ---- Obstacles --------------------------------------------------------------------------------------------------- */

enum { CIRCLE_SIDES = 32 };

/* Draws a line in the axes of the obstacle. */
static void DrawLocal(Drawing* drawing, const kiriObstacleData* obstacle, kiriVec3 from, kiriVec3 to)
{
    DrawLine(drawing, kiriObstacle_PointToWorld(obstacle, from), kiriObstacle_PointToWorld(obstacle, to),
             Color(90, 70, 50));
}

/* Returns a corner of the outline, or of the polygon that stands for a circle. */
static kiriVec2 CornerOf(const kiriObstacleShape* shape, double radius, int32_t i, int32_t sides)
{
    KIRI_ASSERT(sides > 0 && (shape->count == 0 || shape->count == sides));
    return shape->count > 0 ? shape->outline[i % sides] : kiriVec2_Scale(radius, kiriCircle_At(i, sides));
}

/* Draws two meridians of each round end. */
static void DrawRoundEnds(Drawing* drawing, const kiriObstacleData* obstacle, double half)
{
    double radius = obstacle->shape.radius;
    KIRI_TIMES(i, CIRCLE_SIDES / 2) {
        kiriVec2 a = kiriVec2_Scale(radius, kiriCircle_At(i, CIRCLE_SIDES));
        kiriVec2 b = kiriVec2_Scale(radius, kiriCircle_At(i + 1, CIRCLE_SIDES));
        for (int side = -1; side <= 1; side += 2) {
            double from = side * (half + a.y), to = side * (half + b.y);
            DrawLocal(drawing, obstacle, kiriVec3_Make(a.x, 0.0, from), kiriVec3_Make(b.x, 0.0, to));
            DrawLocal(drawing, obstacle, kiriVec3_Make(0.0, a.x, from), kiriVec3_Make(0.0, b.x, to));
        }
    }
}

/* Draws the outline at both ends of the axis and lines along the axis; a plane as a square with its normal. */
static void DrawObstacle(Drawing* drawing, const kiriObstacleData* obstacle)
{
    const kiriObstacleShape* shape = &obstacle->shape;
    bool isPlane = shape->type == KIRI_OBSTACLE_PLANE;
    double endless = 10.0 * drawing->size, half = shape->half < KIRI_ENDLESS ? shape->half : endless;
    double radius = isPlane ? sqrt(2.0) * endless : shape->radius;
    int32_t sides = shape->count > 0 ? shape->count : isPlane ? 4 : CIRCLE_SIDES;
    KIRI_TIMES(i, sides) {
        kiriVec2 a = CornerOf(shape, radius, i, sides), b = CornerOf(shape, radius, i + 1, sides);
        for (int side = half > 0.0 ? -1 : 1; side <= 1; side += 2) {
            DrawLocal(drawing, obstacle, kiriVec3_Make(a.x, a.y, side * half), kiriVec3_Make(b.x, b.y, side * half));
        }
        if (half > 0.0 && (shape->count > 0 || i % (CIRCLE_SIDES / 4) == 0)) {
            DrawLocal(drawing, obstacle, kiriVec3_Make(a.x, a.y, -half), kiriVec3_Make(a.x, a.y, half));
        }
    }
    if (isPlane) {
        DrawLocal(drawing, obstacle, kiriVec3_Make(0.0, 0.0, 0.0), kiriVec3_Make(0.0, 0.0, drawing->size));
    } else if (shape->type == KIRI_OBSTACLE_SPHERE || shape->type == KIRI_OBSTACLE_CAPSULE) {
        DrawRoundEnds(drawing, obstacle, half);
    }
}

/* ---- All of it --------------------------------------------------------------------------------------------------- */

static void DrawSheet(Drawing* drawing, const kiriSheetData* sheet)
{
    uint32_t flags = drawing->flags;
    if ((flags & (KIRI_DRAW_TRIANGLES | KIRI_DRAW_EDGES | KIRI_DRAW_BORDERS)) != 0) {
        DrawMesh(drawing, sheet);
    }
    for (int32_t p = 0; (flags & KIRI_DRAW_BOXES) != 0 && p < sheet->layout.pieces.count; p += BOXES_A_PASS) {
        DrawBoxesFrom(drawing, sheet, p);
    }
    if ((flags & KIRI_DRAW_FRAMES) != 0) {
        DrawFrames(drawing, sheet);
    }
    if ((flags & KIRI_DRAW_LINKS) != 0) {
        DrawLinks(drawing, sheet);
    }
    KIRI_EACH_WHILE((flags & KIRI_DRAW_PINS) != 0, const kiriPinData, pin, sheet->pins) {
        DrawPin(drawing, sheet, pin);
    }
    if ((flags & KIRI_DRAW_CONTACTS) != 0) {
        DrawContacts(drawing, sheet, &sheet->touches.last);
        DrawContacts(drawing, sheet, &sheet->touches.slept);
    }
    KIRI_EACH_INDEX_WHILE((flags & KIRI_DRAW_POINTS) != 0, i, sheet->points) {
        Draw(drawing, &sheet->seen.exactPoints.data[i], 1, Color(215, 25, 115));
    }
}

void kiriDefaultDebugDraw(kiriDebugDraw* draw)
{
    if (draw != NULL) {
        KIRI_CLEAR(draw);
        draw->cookie = KIRI_COOKIE(kiriDebugDraw);
        draw->flags = KIRI_DRAW_ALL & ~(KIRI_DRAW_TRIANGLES | KIRI_DRAW_EDGES);
        draw->size = 0.05f;
    }
}

kiriResult kiriWorld_DebugDraw(const kiriWorld* world, const kiriDebugDraw* draw)
{
    KIRI_READS(world);
    KIRI_CHECK_OUT(draw);
    KIRI_REQUIRE(draw->cookie == KIRI_COOKIE(kiriDebugDraw), KIRI_ERROR_DEF,
                 "draw was not filled by kiriDefaultDebugDraw");
    KIRI_CHECK((draw->flags & ~(uint32_t)KIRI_DRAW_ALL) == 0, "flags has more than those of KIRI_DRAW");
    KIRI_CHECK_NUMBER(draw->size, KIRI_ABOVE_0, FLT_MAX);
    const kiriSlot* only = kiriPool_Find(&world->sheetIds, draw->sheet);
    if (only == NULL && draw->sheet != 0) {
        return kiriCall_RefuseId(world, call, __func__, "sheet", draw->sheet);
    }
    kiriCall_BeginCallbacks(world);
    Drawing drawing = { draw->user,
                        draw->flags,
                        draw->size,
                        { { .draw = draw->points }, { .draw = draw->lines }, { .draw = draw->triangles } } };
    KIRI_EACH_OF(kiriSheetData, sheet, world->sheets) {
        if (only == NULL || only->owner == sheet) {
            DrawSheet(&drawing, sheet);
        }
    }
    KIRI_EACH_INDEX_WHILE(only == NULL && (draw->flags & KIRI_DRAW_OBSTACLES) != 0, i, world->obstacles) {
        DrawObstacle(&drawing, world->obstacles.data[i]);
    }
    KIRI_EACH_OF_WHILE(only == NULL && (draw->flags & KIRI_DRAW_BLADES) != 0, kiriBladeData, blade, world->blades) {
        if (blade->isPlaced) {
            DrawLine(&drawing, blade->edge[0], blade->edge[1], Color(0, 0, 0));
        }
        KIRI_EACH(const kiriLayer, layer, blade->layers) {
            Draw(&drawing, &layer->at, 1, Color(0, 0, 0));
        }
    }
    KIRI_TIMES(i, 3) {
        FlushBatch(&drawing, &drawing.batches[i]);
    }
    kiriCall_EndCallbacks(world);
    return KIRI_OK;
}
