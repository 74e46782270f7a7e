#include "kiri_sheet_save.h"

#include "kiri_obstacle.h"

static const kiriMember ObstacleShapeMembers[] = {
    KIRI_RUN(4, kiriObstacleShape, type, type), KIRI_RUN(8, kiriObstacleShape, radius, rounding),
    KIRI_DROPPED(kiriObstacleShape, outline),   KIRI_DROPPED(kiriObstacleShape, normals),
    KIRI_DROPPED(kiriObstacleShape, count),     KIRI_RUN(8, kiriObstacleShape, flat, flat),
};
static const kiriTable ObstacleShapeTable = KIRI_TABLE(kiriObstacleShape, ObstacleShapeMembers);

static const kiriMember ObstacleDataMembers[] = {
    KIRI_RUN(4, kiriObstacleData, id, id),
    KIRI_PART(kiriObstacleData, shape, ObstacleShapeTable),
    KIRI_RUN(8, kiriObstacleData, position, center),
    KIRI_RUN(4, kiriObstacleData, body, body),
    KIRI_RUN(8, kiriObstacleData, pushSpeed, pushSpeed),
    KIRI_RUN(4, kiriObstacleData, groups, groups),
    KIRI_RUN(8, kiriObstacleData, impulse, impulse),
    KIRI_RUN(4, kiriObstacleData, contacts, contacts),
    KIRI_RUN(8, kiriObstacleData, drift, upper),
};
static const kiriTable ObstacleDataTable = KIRI_TABLE(kiriObstacleData, ObstacleDataMembers);

enum { MOST_OUTLINE = 64 };

void kiriObstacle_Archive(kiriArchive* archive, kiriObstacleData** made, kiriMemory* memory)
{
    bool reads = kiriArchive_Reads(archive);
    int32_t corners = kiriArchive_Count(archive, reads ? 0 : (*made)->shape.count, 0, MOST_OUTLINE);
    if (reads) {
        *made = kiriArchive_HasFailed(archive) ? NULL : kiriObstacle_Alloc(memory, corners);
        archive->isShort |= *made == NULL && !archive->isBad;
    }
    if (*made != NULL) {
        kiriArchive_Object(archive, &ObstacleDataTable, *made);
        kiriArchive_Numbers(archive, (*made)->shape.outline, 8, 4 * (int64_t)corners);
    }
}
