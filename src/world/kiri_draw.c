#include "kiri_draw.h"
#include "../sheet/kiri_piece.h"
#include "../sheet/kiri_seen.h"
#include "../sheet/kiri_touch.h"
#include "kiri_blade.h"

#include <string.h>

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
    return sheet->layout.pieces.data[piece].isGone ? KIRI_NONE : piece;
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
        int32_t piece = kiriPiece_OfVertex(sheet, v);
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

/* Obstacles as lines. */

enum { CIRCLE_SIDES = 32 };

typedef struct ObstacleDrawing {
    kiriDrawing* drawing;
    const kiriObstacleData* obstacle;
    uint32_t color;
} ObstacleDrawing;

static void DrawLocal(const ObstacleDrawing* of, kiriVec3 from, kiriVec3 to)
{
    kiriDrawing_Line(of->drawing, kiriObstacle_PointToWorld(of->obstacle, from),
                     kiriObstacle_PointToWorld(of->obstacle, to), of->color);
}

/* Some sides of a circle of vectors u and v, its radius long, around a middle. */
static void DrawArc(const ObstacleDrawing* of, kiriVec3 middle, kiriVec3 u, kiriVec3 v, int32_t sides)
{
    for (int32_t i = 0; i < sides; ++i) {
        kiriVec2 a = kiriCircle_At(i, CIRCLE_SIDES), b = kiriCircle_At(i + 1, CIRCLE_SIDES);
        DrawLocal(of, kiriVec3_AddScaled(kiriVec3_AddScaled(middle, a.x, u), a.y, v),
                  kiriVec3_AddScaled(kiriVec3_AddScaled(middle, b.x, u), b.y, v));
    }
}

/* Circles around the two ends of the axis, and four lines between them. */
static void DrawTube(const ObstacleDrawing* of, double radius, double half)
{
    const kiriVec3 u = { radius, 0.0, 0.0 }, v = { 0.0, radius, 0.0 };
    for (int side = -1; side <= 1; side += 2) {
        DrawArc(of, kiriVec3_Make(0.0, 0.0, side * half), u, v, CIRCLE_SIDES);
    }
    for (int32_t i = 0; i < 4; ++i) {
        kiriVec2 at = kiriCircle_At(i, 4);
        DrawLocal(of, kiriVec3_Make(radius * at.x, radius * at.y, -half),
                  kiriVec3_Make(radius * at.x, radius * at.y, half));
    }
}

static void DrawRoundEnds(const ObstacleDrawing* of, double radius, double half)
{
    for (int side = -1; side <= 1; side += 2) {
        kiriVec3 middle = { 0.0, 0.0, side * half }, up = { 0.0, 0.0, side * radius };
        DrawArc(of, middle, kiriVec3_Make(radius, 0.0, 0.0), up, CIRCLE_SIDES / 2);
        DrawArc(of, middle, kiriVec3_Make(0.0, radius, 0.0), up, CIRCLE_SIDES / 2);
    }
}

static void DrawPrism(const ObstacleDrawing* of, double half)
{
    const kiriObstacleShape* shape = &of->obstacle->shape;
    for (int32_t i = 0; i < shape->count; ++i) {
        kiriVec2 a = shape->outline[i], b = shape->outline[(i + 1) % shape->count];
        DrawLocal(of, kiriVec3_Make(a.x, a.y, -half), kiriVec3_Make(a.x, a.y, half));
        for (int side = -1; side <= 1; side += 2) {
            DrawLocal(of, kiriVec3_Make(a.x, a.y, side * half), kiriVec3_Make(b.x, b.y, side * half));
        }
    }
}

/* A square, and its normal. */
static void DrawPlane(const ObstacleDrawing* of, double size)
{
    for (int32_t i = 0; i < 4; ++i) {
        kiriVec2 a = kiriCircle_At(i, 4), b = kiriCircle_At(i + 1, 4);
        double half = 10.0 * size; /* corners lie half a side along both axes */
        DrawLocal(of, kiriVec3_Make(half * (a.x - a.y), half * (a.x + a.y), 0.0),
                  kiriVec3_Make(half * (b.x - b.y), half * (b.x + b.y), 0.0));
    }
    DrawLocal(of, kiriVec3_Make(0.0, 0.0, 0.0), kiriVec3_Make(0.0, 0.0, size));
}

static void DrawObstacle(const ObstacleDrawing* of)
{
    const kiriObstacleShape* shape = &of->obstacle->shape;
    double endless = 10.0 * of->drawing->size, half = shape->half < KIRI_ENDLESS ? shape->half : endless;
    double radius = shape->radius;
    switch (shape->type) {
    case KIRI_OBSTACLE_PLANE:
        DrawPlane(of, of->drawing->size);
        break;
    case KIRI_OBSTACLE_SPHERE:
        DrawArc(of, kiriVec3_Make(0.0, 0.0, 0.0), kiriVec3_Make(radius, 0.0, 0.0), kiriVec3_Make(0.0, radius, 0.0),
                CIRCLE_SIDES);
        DrawRoundEnds(of, radius, 0.0);
        break;
    case KIRI_OBSTACLE_CAPSULE:
        DrawTube(of, radius, half);
        DrawRoundEnds(of, radius, half);
        break;
    case KIRI_OBSTACLE_CYLINDER:
        DrawTube(of, radius, half);
        break;
    default:
        DrawPrism(of, half);
        break;
    }
}

void kiriDrawing_Obstacles(kiriDrawing* drawing)
{
    for (int32_t i = 0; i < drawing->world->obstacles.count; ++i) {
        const ObstacleDrawing of = { drawing, drawing->world->obstacles.data[i], kiriDrawing_Color(90, 70, 50) };
        DrawObstacle(&of);
    }
}

#define STEEP 0.5           /* beside a border: what is off along the surface, by what is off across it */
#define FLAT_TRIANGLE 0.25  /* of the distance that they keep: lower than that, and */
#define INSIDE_TRIANGLE 0.5 /* the same: no farther inside of the border than that, lips lie beside each other */

/* Where on a triangle a place is: inside (KIRI_NONE), on edge 0 to 2, or at corner 0 to 2. */
typedef struct Place {
    double share[3];
    int edge, corner;
} Place;

static Place AtCorner(int corner)
{
    Place place = { { 0.0, 0.0, 0.0 }, KIRI_NONE, corner };
    place.share[corner] = 1.0;
    return place;
}

static Place OnEdge(int edge, double t)
{
    Place place = { { 0.0, 0.0, 0.0 }, edge, KIRI_NONE };
    place.share[edge] = 1.0 - t;
    place.share[(edge + 1) % 3] = t;
    return place;
}

/* Ericson, Real-Time Collision Detection, 5.1.5: by the Voronoi regions of corners, edges and the inside. */
static Place NearestOnTriangle(kiriVec3 p, kiriVec3 a, kiriVec3 b, kiriVec3 c)
{
    kiriVec3 ab = kiriVec3_Sub(b, a), ac = kiriVec3_Sub(c, a);
    kiriVec3 ap = kiriVec3_Sub(p, a), bp = kiriVec3_Sub(p, b), cp = kiriVec3_Sub(p, c);
    double d1 = kiriVec3_Dot(ab, ap), d2 = kiriVec3_Dot(ac, ap);
    double d3 = kiriVec3_Dot(ab, bp), d4 = kiriVec3_Dot(ac, bp);
    double d5 = kiriVec3_Dot(ab, cp), d6 = kiriVec3_Dot(ac, cp);
    double onA = d3 * d6 - d5 * d4, onB = d5 * d2 - d1 * d6, onC = d1 * d4 - d3 * d2;
    if (d1 <= 0.0 && d2 <= 0.0) {
        return AtCorner(0);
    }
    if (d3 >= 0.0 && d4 <= d3) {
        return AtCorner(1);
    }
    if (d6 >= 0.0 && d5 <= d6) {
        return AtCorner(2);
    }
    if (onC <= 0.0 && d1 >= 0.0 && d3 <= 0.0) {
        return OnEdge(0, d1 / (d1 - d3));
    }
    if (onB <= 0.0 && d2 >= 0.0 && d6 <= 0.0) {
        return OnEdge(2, 1.0 - d2 / (d2 - d6));
    }
    if (onA <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0) {
        return OnEdge(1, (d4 - d3) / ((d4 - d3) + (d5 - d6)));
    }
    double sum = onA + onB + onC;
    Place inside = { { onA / sum, onB / sum, onC / sum }, KIRI_NONE, KIRI_NONE };
    return inside;
}

/* m: how far inside of the border the place is, by the edges of its triangle and by corners at which others have border
   edges; far, where there are none. */
static double WayToBorder(const kiriSheetData* sheet, const kiriNear* near)
{
    const kiriTriangle* t = &sheet->mesh.triangles.data[near->triangle];
    const kiriSurface* surface = &sheet->seen.surface;
    double least = HUGE_VAL;
    for (int k = 0; k < 3; ++k) {
        kiriVec3 from = kiriSurface_At(surface, t->vertex[k]), to = kiriSurface_At(surface, t->vertex[(k + 1) % 3]);
        kiriVec3 apex = kiriSurface_At(surface, t->vertex[(k + 2) % 3]), edge = kiriVec3_Sub(to, from);
        double area = kiriVec3_Length(kiriVec3_Cross(edge, kiriVec3_Sub(apex, from)));
        double way = near->share[(k + 2) % 3] * area / kiriVec3_Length(edge);
        bool isBorder = t->twin[k] == KIRI_NONE || (t->marks >> k & 1) != 0;
        least = isBorder && way < least ? way : least;
        kiriVec3 in = kiriVec3_AddScaled(kiriVec3_Scale(near->share[(k + 1) % 3], edge), near->share[(k + 2) % 3],
                                         kiriVec3_Sub(apex, from));
        double off = kiriVec3_Length(in);
        least = sheet->probes.isBorder.data[t->vertex[k]] && off < least ? off : least;
    }
    return least;
}

/* The place on one triangle; its distance, squared. */
static double Measure(kiriNear* near, const kiriBody* bodies, int32_t triangle)
{
    const kiriSheetData* sheet = bodies[near->other].sheet;
    const kiriSurface* surface = &sheet->seen.surface;
    const int32_t* corners = &surface->indices.data[3 * (size_t)triangle];
    kiriVec3 a = kiriSurface_At(surface, corners[0]), b = kiriSurface_At(surface, corners[1]);
    kiriVec3 c = kiriSurface_At(surface, corners[2]);
    kiriVec3 p = kiriSurface_At(&bodies[near->body].sheet->seen.surface, near->vertex);
    Place place = NearestOnTriangle(p, a, b, c);
    kiriVec3 q = kiriVec3_Scale(place.share[0], a);
    q = kiriVec3_AddScaled(kiriVec3_AddScaled(q, place.share[1], b), place.share[2], c);
    kiriVec3 off = kiriVec3_Sub(p, q);
    near->triangle = triangle;
    memcpy(near->share, place.share, sizeof(near->share));
    near->normal = kiriVec3_Normalize(kiriVec3_Cross(kiriVec3_Sub(b, a), kiriVec3_Sub(c, a)));
    near->height = kiriVec3_Dot(near->normal, off);
    return kiriVec3_Dot(off, off);
}

/* Lips of a fresh cut lie in one plane, and may overlap a little when they move: they are beside each other, and not
   one on the other. */
static bool IsBeside(const kiriNear* near, const kiriBody* bodies, double distance, double squared)
{
    const kiriSheetData* sheet = bodies[near->other].sheet;
    double across = near->height * near->height, way = WayToBorder(sheet, near);
    bool isLip = bodies[near->body].sheet->probes.isBorder.data[near->vertex];
    return (way <= 0.0 && squared - across >= STEEP * STEEP * across) ||
           (isLip && way < INSIDE_TRIANGLE * distance && fabs(near->height) < FLAT_TRIANGLE * distance);
}

typedef struct Looking {
    kiriNear* near;
    const kiriBody* bodies;
    double least; /* m^2 */
    bool found;
} Looking;

static double LookAtTriangle(void* context, int32_t triangle)
{
    Looking* looking = context;
    kiriNear one = *looking->near;
    double squared = Measure(&one, looking->bodies, triangle);
    bool isLower = looking->found && squared == looking->least && triangle < looking->near->triangle;
    if (squared < looking->least || isLower) {
        looking->least = squared;
        *looking->near = one;
        looking->found = true;
    }
    return looking->least;
}

bool kiriNearest_Find(kiriNear* near, const kiriBody* bodies, double reach, double distance)
{
    Looking looking = { near, bodies, reach * reach, false };
    const kiriSheetData* other = bodies[near->other].sheet;
    kiriVec3 from = kiriSurface_At(&bodies[near->body].sheet->seen.surface, near->vertex);
    kiriGroup piece = { other->probes.vertexPiece.data, bodies[near->other].piece };
    kiriBounds_Nearest(other->seen.bounds, &other->seen.surface, piece, from, looking.least, LookAtTriangle, &looking);
    return looking.found && !IsBeside(near, bodies, distance, looking.least);
}
