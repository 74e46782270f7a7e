/* Obstacles as lines. */
#include "kiri_draw.h"

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
