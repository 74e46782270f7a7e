/* How far distances to the site of a frame have to go. */
#include "kiri_shape_work.h"

/* How far distances to the site of its region have to go for the sake of a cell x: to itself, and where a step leads
   over the border to y, to the last cell that gets weight from there. Let the nearest way from such a cell c to the
   border come in by y. Then d <= D(x) + |xy| + |yc|, and the weight is above zero only where d > 2 e = D(x) + |xy| -
   D(y) + 2 |yc|: where |yc| < D(y), and so d < D(x) + |xy| + D(y). */
static int32_t ReachAt(const kiriShapeJob* job, int32_t x)
{
    const kiriField* field = &job->regions->field;
    const int32_t *owner = field->owner.data, *distance = field->distance.data;
    kiriSteps steps;
    int64_t farthest = distance[x];
    if (!job->regions->onBorder.data[x]) {
        return distance[x] < KIRI_FAR ? distance[x] : KIRI_FAR - 1;
    }
    kiriGrid_GetSteps(job->grid, x, &steps);
    for (int32_t s = 0; s < steps.end[KIRI_STEP_LENGTHS - 1]; ++s) {
        kiriStep step = steps.data[s];
        if (owner[step.cell] != owner[x]) {
            int64_t over = (int64_t)distance[x] + step.length + distance[step.cell];
            farthest = kiriMax(over, farthest);
        }
    }
    return farthest < KIRI_FAR ? (int32_t)farthest : KIRI_FAR - 1;
}

static void CountSide(const kiriShapeJob* job, kiriCountedCell counted, int32_t more)
{
    if (counted.label != KIRI_NONE) {
        int32_t frame = kiriLabels_Item(&job->shape->labels, counted.label);
        job->work->sideCounts.data[job->work->frames.data[frame].sides.first + counted.sides] += more;
    }
}

void kiriShapeJob_UncountCell(kiriShapeJob* job, int32_t cell)
{
    kiriCountedCell* counted = &job->work->counted.data[cell];
    CountSide(job, *counted, -1);
    *counted = (kiriCountedCell){ KIRI_NONE, 0 };
}

/* Room to count up to so many sides. */
static bool MakeSidesRoom(kiriShapeJob* job, int32_t frame, int32_t sides)
{
    kiriShapeWork* work = job->work;
    kiriSpan* span = &work->frames.data[frame].sides;
    int32_t k = span->count;
    if (sides >= k && !kiriSpan_Resize(span, &work->sideRoom, job->memory, &work->sideCounts,
                                       sizeof(*work->sideCounts.data), sides + 1)) {
        return false;
    }
    for (; k <= sides; ++k) {
        work->sideCounts.data[span->first + k] = 0;
    }
    return true;
}

bool kiriShapeJob_CountCell(kiriShapeJob* job, int32_t cell)
{
    kiriCountedCell is = { KIRI_NONE, 0 }, was = job->work->counted.data[cell];
    int32_t frame = job->regions->field.owner.data[cell];
    if (frame != KIRI_NONE) {
        is.label = kiriLabels_Of(&job->shape->labels, frame);
        is.sides = ReachAt(job, cell) / KIRI_UNIT;
    }
    if (is.label == was.label && is.sides == was.sides) {
        return true;
    }
    if (frame != KIRI_NONE && !MakeSidesRoom(job, frame, is.sides)) {
        return false;
    }
    kiriShapeJob_UncountCell(job, cell);
    CountSide(job, is, 1);
    job->work->counted.data[cell] = is;
    return true;
}

int32_t kiriShapeJob_LimitOf(const kiriShapeJob* job)
{
    const kiriSpan span = job->work->frames.data[job->frame].sides;
    int64_t sides = span.count;
    while (sides > 1 && job->work->sideCounts.data[span.first + sides - 1] == 0) {
        --sides;
    }
    return sides < 1 ? KIRI_UNIT : sides * KIRI_UNIT < KIRI_FAR ? (int32_t)(sides * KIRI_UNIT) : KIRI_FAR - 1;
}
