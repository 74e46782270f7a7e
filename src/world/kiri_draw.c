#include "kiri_draw.h"

#include "../sheet/kiri_piece.h"
#include "../sheet/kiri_point.h"
#include "../sheet/kiri_touch.h"
#include "kiri_blade.h"

/* ---- Batches ----------------------------------------------------------------------------------------------------- */

static void FlushBatch(kiriDrawBatch* batch)
{
    if (batch->count > 0) {
        batch->draw(batch->user, batch->vertices, batch->count);
    }
    batch->count = 0;
}

static void AddToBatch(kiriDrawBatch* batch, const kiriVec3* corners, int32_t count, uint32_t color)
{
    if (batch->draw == NULL) {
        return;
    }
    if (batch->count + count > KIRI_DRAW_BATCH) {
        FlushBatch(batch);
    }
    for (int32_t i = 0; i < count; ++i) {
        kiriDrawVertex* vertex = &batch->vertices[batch->count++];
        kiriVec3_Store(vertex->position, corners[i]);
        vertex->color = color;
    }
}

void kiriDrawing_Point(kiriDrawing* drawing, kiriVec3 at, uint32_t color)
{
    AddToBatch(&drawing->points, &at, 1, color);
}

void kiriDrawing_Line(kiriDrawing* drawing, kiriVec3 from, kiriVec3 to, uint32_t color)
{
    const kiriVec3 ends[2] = { from, to };
    AddToBatch(&drawing->lines, ends, 2, color);
}

void kiriDrawing_Triangle(kiriDrawing* drawing, const kiriVec3 corners[3], uint32_t color)
{
    AddToBatch(&drawing->triangles, corners, 3, color);
}

void kiriDrawing_End(kiriDrawing* drawing)
{
    FlushBatch(&drawing->points);
    FlushBatch(&drawing->lines);
    FlushBatch(&drawing->triangles);
}

/* ---- Mesh -------------------------------------------------------------------------------------------------------- */

/* Colours that neighbours in a list tell apart; a piece that sleeps is half white. */
static uint32_t ColorOfPiece(const kiriSheetData* sheet, int32_t piece)
{
    static const uint8_t colors[8][3] = { { 230, 159, 0 }, { 86, 180, 233 }, { 0, 158, 115 },   { 240, 228, 66 },
                                          { 0, 114, 178 }, { 213, 94, 0 },   { 204, 121, 167 }, { 150, 150, 150 } };
    const uint8_t* c = colors[piece % 8];
    uint32_t pale = sheet->layout.pieces.data[piece].rest.asleep ? 1 : 0;
    return kiriDrawing_Color((c[0] + 255 * pale) >> pale, (c[1] + 255 * pale) >> pale, (c[2] + 255 * pale) >> pale);
}

/* KIRI_NONE for a triangle that is not seen. */
static int32_t SeenPieceOf(const kiriSheetData* sheet, int32_t triangle)
{
    int32_t piece = kiriPiece_OfTriangle(sheet, triangle);
    return piece == KIRI_NONE || sheet->layout.pieces.data[piece].isGone ? KIRI_NONE : piece;
}

/* An edge between two triangles is that of the one with the lower half-edge. */
static void DrawEdges(kiriDrawing* drawing, const kiriSheetData* sheet, int32_t triangle, const kiriVec3 corners[3])
{
    for (int32_t k = 0; k < 3; ++k) {
        int32_t h = 3 * triangle + k;
        bool isBorder = kiriMesh_IsBorder(&sheet->mesh, h);
        if (isBorder && (drawing->flags & KIRI_DRAW_BORDERS) != 0) {
            kiriDrawing_Line(drawing, corners[k], corners[(k + 1) % 3], kiriDrawing_Color(200, 30, 30));
        } else if (!isBorder && (drawing->flags & KIRI_DRAW_EDGES) != 0 && h < kiriMesh_Twin(&sheet->mesh, h)) {
            kiriDrawing_Line(drawing, corners[k], corners[(k + 1) % 3], kiriDrawing_Color(110, 115, 125));
        }
    }
}

static void DrawMesh(kiriDrawing* drawing, const kiriSheetData* sheet)
{
    for (int32_t t = 0; t < sheet->mesh.triangles.count; ++t) {
        int32_t piece = SeenPieceOf(sheet, t);
        if (piece == KIRI_NONE) {
            continue;
        }
        kiriVec3 corners[3];
        for (int k = 0; k < 3; ++k) {
            corners[k] = kiriSurface_At(&sheet->seen.surface, sheet->mesh.triangles.data[t].vertex[k]);
        }
        if ((drawing->flags & KIRI_DRAW_TRIANGLES) != 0) {
            kiriDrawing_Triangle(drawing, corners, ColorOfPiece(sheet, piece));
        }
        DrawEdges(drawing, sheet, t, corners);
    }
}

/* ---- Boxes ------------------------------------------------------------------------------------------------------- */

enum { BOXES_A_PASS = 64 };

/* Corner i of eight: bits say which are upper. */
static kiriVec3 CornerOfBox(const kiriBox* box, int i)
{
    return kiriVec3_Make((i & 1) != 0 ? box->upper.x : box->lower.x, (i & 2) != 0 ? box->upper.y : box->lower.y,
                         (i & 4) != 0 ? box->upper.z : box->lower.z);
}

static void DrawBox(kiriDrawing* drawing, const kiriBox* box, uint32_t color)
{
    for (int i = 0; i < 8; ++i) {
        for (int bit = 1; bit < 8; bit *= 2) {
            if ((i & bit) == 0) {
                kiriDrawing_Line(drawing, CornerOfBox(box, i), CornerOfBox(box, i | bit), color);
            }
        }
    }
}

/* A box for each of some pieces by one pass over the vertices: lists of pieces would take memory. */
static void DrawBoxesFrom(kiriDrawing* drawing, const kiriSheetData* sheet, int32_t first)
{
    kiriBox boxes[BOXES_A_PASS];
    bool isSeen[BOXES_A_PASS] = { false };
    for (int32_t v = 0; v < sheet->mesh.vertices.count; ++v) {
        int32_t piece = kiriMesh_IsVertex(&sheet->mesh, v) ? kiriPiece_OfVertex(sheet, v) : KIRI_NONE;
        if (piece < first || piece >= first + BOXES_A_PASS || sheet->layout.pieces.data[piece].isGone) {
            continue;
        }
        kiriVec3 at = kiriSurface_At(&sheet->seen.surface, v);
        kiriBox* box = &boxes[piece - first];
        if (!isSeen[piece - first]) {
            box->lower = box->upper = at;
        }
        kiriBox_Add(box, at);
        isSeen[piece - first] = true;
    }
    for (int32_t i = 0; i < BOXES_A_PASS; ++i) {
        if (isSeen[i]) {
            DrawBox(drawing, &boxes[i], ColorOfPiece(sheet, first + i));
        }
    }
}

/* ---- Frames and links -------------------------------------------------------------------------------------------- */

static void DrawFrames(kiriDrawing* drawing, const kiriSheetData* sheet)
{
    for (int32_t i = 0; i < sheet->frames.count; ++i) {
        const kiriFrameData* frame = &sheet->frames.data[i];
        if (kiriSheet_IsGone(sheet, i)) {
            continue;
        }
        kiriVec3 at = kiriFrame_Carry(frame, frame->site.at);
        kiriDrawing_Point(drawing, at, frame->held ? kiriDrawing_Color(220, 40, 40) : kiriDrawing_Color(25, 25, 30));
        kiriDrawing_Line(drawing, at, kiriVec3_AddScaled(at, drawing->size, frame->A.u),
                         kiriDrawing_Color(230, 40, 40));
        kiriDrawing_Line(drawing, at, kiriVec3_AddScaled(at, drawing->size, frame->A.v),
                         kiriDrawing_Color(40, 170, 40));
        kiriDrawing_Line(drawing, at, kiriVec3_AddScaled(at, drawing->size, frame->A.d),
                         kiriDrawing_Color(40, 40, 230));
    }
}

/* The middle of the border is where the two frames have it, in the mean. */
static void DrawLinks(kiriDrawing* drawing, const kiriSheetData* sheet)
{
    const uint32_t color = kiriDrawing_Color(30, 30, 35);
    for (int32_t k = 0; k < sheet->links.links.count; ++k) {
        const kiriLink* link = &sheet->links.links.data[k];
        const kiriFrameData *a = &sheet->frames.data[link->i], *b = &sheet->frames.data[link->j];
        if (kiriSheet_IsGone(sheet, link->i)) {
            continue;
        }
        kiriVec3 middle = kiriVec3_Add(kiriFrame_Carry(a, link->centroid), kiriFrame_Carry(b, link->centroid));
        middle = kiriVec3_Scale(0.5, middle);
        kiriDrawing_Line(drawing, kiriFrame_Carry(a, a->site.at), middle, color);
        kiriDrawing_Line(drawing, middle, kiriFrame_Carry(b, b->site.at), color);
    }
}

/* ---- Pins and contacts ------------------------------------------------------------------------------------------- */

static void DrawPin(kiriDrawing* drawing, const kiriSheetData* sheet, const kiriPinData* pin)
{
    const uint32_t color = kiriDrawing_Color(170, 0, 170);
    kiriPointPlace place;
    kiriDrawing_Point(drawing, pin->target, color);
    if (pin->type != KIRI_PIN_POINT) {
        kiriVec2 half = kiriVec2_Sub(kiriMesh_Local(&sheet->mesh, pin->to), kiriMesh_Local(&sheet->mesh, pin->at));
        kiriVec3 way = kiriVec3_AddScaled(kiriVec3_Scale(0.5 * half.x, pin->rotation.u), 0.5 * half.y, pin->rotation.v);
        kiriDrawing_Line(drawing, kiriVec3_Sub(pin->target, way), kiriVec3_Add(pin->target, way), color);
    } else if (kiriPoint_Find(sheet, pin->at, &place)) {
        kiriDrawing_Line(drawing, pin->target, kiriPoint_Position(sheet, &place), color);
    }
}

/* Where the point of a touch is seen now. */
static kiriVec3 PlaceOfTouch(const kiriSheetData* sheet, const kiriTouch* touch)
{
    kiriVec3 at = { 0.0, 0.0, 0.0 };
    if (touch->point != KIRI_NONE) {
        return sheet->seen.exactPoints.data[touch->point];
    }
    for (int k = 0; k < 3; ++k) {
        if (touch->vertex[k] != KIRI_NONE) {
            at = kiriVec3_AddScaled(at, touch->share[k], kiriSurface_At(&sheet->seen.surface, touch->vertex[k]));
        }
    }
    return at;
}

static void DrawContacts(kiriDrawing* drawing, const kiriSheetData* sheet, const kiriTouchMemory* memory)
{
    const uint32_t color = kiriDrawing_Color(0, 150, 170);
    for (int32_t i = 0; i < memory->touches.count; ++i) {
        const kiriTouch* touch = &memory->touches.data[i];
        kiriVec3 force = kiriTouches_ForceOf(sheet, touch->key);
        if (kiriVec3_Dot(force, force) > 0.0) {
            kiriVec3 at = PlaceOfTouch(sheet, touch);
            kiriDrawing_Point(drawing, at, color);
            kiriDrawing_Line(drawing, at, kiriVec3_AddScaled(at, drawing->size, touch->normal), color);
        }
    }
}

/* ---- All of it --------------------------------------------------------------------------------------------------- */

void kiriDrawing_Sheet(kiriDrawing* drawing, const kiriSheetData* sheet)
{
    if ((drawing->flags & (KIRI_DRAW_TRIANGLES | KIRI_DRAW_EDGES | KIRI_DRAW_BORDERS)) != 0) {
        DrawMesh(drawing, sheet);
    }
    for (int32_t p = 0; (drawing->flags & KIRI_DRAW_BOXES) != 0 && p < sheet->layout.pieces.count; p += BOXES_A_PASS) {
        DrawBoxesFrom(drawing, sheet, p);
    }
    if ((drawing->flags & KIRI_DRAW_FRAMES) != 0) {
        DrawFrames(drawing, sheet);
    }
    if ((drawing->flags & KIRI_DRAW_LINKS) != 0) {
        DrawLinks(drawing, sheet);
    }
    for (int32_t i = 0; (drawing->flags & KIRI_DRAW_PINS) != 0 && i < sheet->pins.count; ++i) {
        DrawPin(drawing, sheet, &sheet->pins.data[i]);
    }
    if ((drawing->flags & KIRI_DRAW_CONTACTS) != 0) {
        DrawContacts(drawing, sheet, &sheet->touches.last);
        DrawContacts(drawing, sheet, &sheet->touches.slept);
    }
    for (int32_t i = 0; (drawing->flags & KIRI_DRAW_POINTS) != 0 && i < sheet->points.count; ++i) {
        kiriDrawing_Point(drawing, sheet->seen.exactPoints.data[i], kiriDrawing_Color(215, 25, 115));
    }
}

void kiriDrawing_Blades(kiriDrawing* drawing)
{
    const uint32_t color = kiriDrawing_Color(0, 0, 0);
    for (int32_t i = 0; i < drawing->world->blades.count; ++i) {
        const kiriBladeData* blade = drawing->world->blades.data[i];
        if (blade->isPlaced) {
            kiriDrawing_Line(drawing, blade->edge[0], blade->edge[1], color);
        }
        for (int32_t k = 0; k < blade->layers.count; ++k) {
            kiriDrawing_Point(drawing, blade->layers.data[k].at, color);
        }
    }
}
