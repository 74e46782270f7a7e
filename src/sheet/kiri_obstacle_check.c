#include "kiri_sheet_check.h"

static const kiriMust ObstacleMust[] = {
    KIRI_WITHIN(KIRI_OBSTACLE_PLANE, KIRI_OBSTACLE_PRISM, kiriObstacleData, shape.type, shape.type),
    KIRI_REALS(kiriObstacleData, shape.radius, shape.rounding),
    KIRI_REALS(kiriObstacleData, shape.flat, shape.flat),
    KIRI_REALS(kiriObstacleData, position, center),
    KIRI_REALS(kiriObstacleData, pushSpeed, pushSpeed),
    KIRI_REALS(kiriObstacleData, impulse, impulse),
    KIRI_WITHIN(0, INT32_MAX, kiriObstacleData, contacts, contacts),
    KIRI_REALS(kiriObstacleData, drift, upper),
};

bool kiriObstacle_Check(const kiriObstacleData* obstacle, kiriCheck* check)
{
    const kiriObstacleShape* shape = &obstacle->shape;
    bool isPrism = shape->type == KIRI_OBSTACLE_PRISM, isFine = true;
    for (int32_t k = 0; k < 2 * shape->count; ++k) {
        isFine = isFine && fabs(shape->outline[k].x) <= 2e6 && fabs(shape->outline[k].y) <= 2e6;
    }
    return kiriCheck_Object(check, ObstacleMust, obstacle) &&
           kiriCheck_That(check, isFine && (isPrism ? shape->count >= 3 : shape->count == 0) && obstacle->mass >= 0.0 &&
                                     shape->type != KIRI_OBSTACLE_BOX);
}
