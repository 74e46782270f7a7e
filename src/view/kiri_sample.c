#include "kiri_sample.h"

/* ---- Weights ---------------------------------------------------------------------------------------------------- */

static bool ResizeSampleWeights(kiriSkin* skin, kiriMemory* memory, kiriSpan* span, int32_t count)
{
    return kiriSpan_Resize(span, &skin->room, memory, &skin->weights, sizeof(*skin->weights.data), count);
}

/* Gives the room of a span back. Needs no memory. */
static void DropSpan(kiriSkin* skin, kiriSpan* span)
{
    ResizeSampleWeights(skin, NULL, span, 0);
}

/* Weights are multiples of 1 / WEIGHT_UNITS. Less than half a unit is dropped. */
#define WEIGHT_UNITS 16777216.0
#define LEAST_SHARE (0.5 / WEIGHT_UNITS)

/* Rounds weights to units. The largest gets the rest of the sum. Returns the number of weights above 0. */
static int32_t RoundWeights(kiriSampleWeight* weights, int32_t count)
{
    int32_t kept = 0, largest = 0, missing = (int32_t)WEIGHT_UNITS;
    KIRI_TIMES(i, count) {
        int32_t units = (int32_t)(WEIGHT_UNITS * weights[i].value + 0.5);
        if (units > 0) {
            weights[kept] = (kiriSampleWeight){ weights[i].frame, (float)(units / WEIGHT_UNITS) };
            largest = weights[kept].value > weights[largest].value ? kept : largest;
            missing -= units;
            ++kept;
        }
    }
    weights[largest].value += (float)(missing / WEIGHT_UNITS);
    return kept;
}

/* Stages the weights in the stencil, and makes room for the commit. Cells of an untrusted save may have no weight that
   counts: then one frame carries the sample. */
static bool StageWeights(kiriSkin* skin, kiriMemory* memory, const kiriStencil* stencil,
                         int32_t sample)
{
    kiriReweighed staged = { sample, { 0, 0 } };
    int32_t count = 0;
    KIRI_ASSERT(sample >= 0);
    KIRI_EACH_INDEX(i, stencil->frames) {
        count += stencil->values.data[i] >= LEAST_SHARE;
    }
    if (!kiriArray_Reserve(memory, &skin->spans, (int64_t)sample + 1) ||
        !kiriArray_ReserveMore(memory, &skin->staged, 1) ||
        !ResizeSampleWeights(skin, memory, &staged.span, count > 0 ? count : 1)) {
        return false;
    }
    kiriSampleWeight* weight = skin->weights.data + staged.span.first;
    KIRI_EACH_INDEX(i, stencil->frames) {
        if (stencil->values.data[i] >= LEAST_SHARE) {
            *weight++ = (kiriSampleWeight){ stencil->frames.data[i], (float)stencil->values.data[i] };
        }
    }
    if (count == 0) {
        *weight = (kiriSampleWeight){ stencil->frames.count > 0 ? stencil->frames.data[0] : 0, 1.0f };
    }
    RoundWeights(skin->weights.data + staged.span.first, staged.span.count);
    KIRI_NEXT(skin->staged) = staged;
    return true;
}

bool kiriSkin_Stage(kiriSkin* skin, const kiriShape* shape, const kiriGrid* grid, int32_t sample, int32_t cell,
                    kiriVec2 at)
{
    kiriMemory *memory = grid->mesh->memory, scratch = kiriMemory_Like(memory);
    kiriStencil stencil = { 0 };
    bool ok = kiriStencil_Gather(&stencil, &scratch, shape, grid, cell);
    if (ok) {
        kiriStencil_Weigh(&stencil, at, kiriVec2_Make(0.0, 0.0));
        ok = StageWeights(skin, memory, &stencil, sample);
    }
    kiriMemory_FreeAll(&scratch);
    return ok;
}

bool kiriSkin_StageCopy(kiriSkin* skin, kiriMemory* memory, const kiriSkin* from, int32_t was, const kiriKeep* frames)
{
    const kiriSpan span = from->spans.data[was];
    kiriReweighed staged = { skin->staged.count, { 0, 0 } };
    if (!kiriArray_ReserveMore(memory, &skin->staged, 1) ||
        !ResizeSampleWeights(skin, memory, &staged.span, span.count)) {
        return false;
    }
    KIRI_TIMES(k, span.count) {
        kiriSampleWeight weight = from->weights.data[span.first + k];
        weight.frame = kiriKeep_To(frames, weight.frame);
        KIRI_ASSERT(weight.frame != KIRI_NONE);
        skin->weights.data[staged.span.first + k] = weight;
    }
    KIRI_NEXT(skin->staged) = staged;
    return true;
}

void kiriSkin_Commit(kiriSkin* skin)
{
    KIRI_EACH(const kiriReweighed, staged, skin->staged) {
        if (staged->sample == skin->spans.count) {
            KIRI_NEXT(skin->spans) = (kiriSpan){ 0 };
        }
        KIRI_ASSERT(staged->sample < skin->spans.count);
        DropSpan(skin, &skin->spans.data[staged->sample]);
        skin->spans.data[staged->sample] = staged->span;
    }
    skin->staged.count = 0;
}

void kiriSkin_Drop(kiriSkin* skin)
{
    KIRI_EACH(kiriReweighed, staged, skin->staged) {
        DropSpan(skin, &staged->span);
    }
    skin->staged.count = 0;
}

bool kiriSkin_Sort(kiriSkin* skin, kiriMemory* memory)
{
    KIRI_ASSERT(skin->staged.count == 0);
    kiriSkin sorted = { 0 };
    if (!kiriArray_Reserve(memory, &sorted.weights, skin->weights.count + (int64_t)skin->weights.count / 8)) {
        return false;
    }
    KIRI_EACH(kiriSpan, at, skin->spans) {
        kiriSpan was = *at, is = { 0 };
        ResizeSampleWeights(&sorted, memory, &is, was.count); /* there is room */
        memcpy(sorted.weights.data + is.first, skin->weights.data + was.first,
               sizeof(kiriSampleWeight) * was.count);
        *at = is;
    }
    kiriArray_Release(memory, &skin->weights);
    kiriArray_SetHeader(&skin->weights, kiriArray_GetHeader(&sorted.weights));
    skin->room = sorted.room;
    return true;
}

/* Adds to the weights of a span, which has room. They stay sorted by frame. */
static void Blend(kiriSkin* skin, kiriSpan* span, int32_t frame, double value)
{
    kiriSampleWeight* weights = skin->weights.data + span->first;
    int32_t k = 0;
    while (k < span->count && weights[k].frame < frame) {
        ++k;
    }
    if (k == span->count || weights[k].frame != frame) {
        memmove(weights + k + 1, weights + k, (span->count - k) * sizeof(*weights));
        weights[k] = (kiriSampleWeight){ frame, 0.0f };
        ++span->count;
    }
    weights[k].value += (float)value;
}

static void InheritOne(kiriSkin* skin, kiriMemory* memory, const kiriBirth* birth)
{
    kiriSpan span = { 0 };
    int32_t most = 0;
    for (int k = 0; k < 3 && birth->parent[k] != KIRI_NONE; ++k) {
        most += skin->spans.data[birth->parent[k]].count;
    }
    bool ok = ResizeSampleWeights(skin, memory, &span, most);
    KIRI_ASSERT(ok && skin->spans.count < skin->spans.capacity);
    (void)ok;
    kiriSpan sum = { span.first, 0 };
    for (int k = 0; k < 3 && birth->parent[k] != KIRI_NONE; ++k) {
        kiriSpan parent = skin->spans.data[birth->parent[k]];
        KIRI_EACH_IN(i, parent) {
            kiriSampleWeight weight = skin->weights.data[i];
            Blend(skin, &sum, weight.frame, birth->share[k] * weight.value);
        }
    }
    sum.count = RoundWeights(skin->weights.data + sum.first, sum.count);
    ResizeSampleWeights(skin, memory, &span, sum.count);
    KIRI_NEXT(skin->spans) = span;
}

bool kiriSkin_ReserveBirths(kiriSkin* skin, kiriMemory* memory, int32_t births, int32_t frames)
{
    /* Three parents, and spans have room for a power of two. */
    int64_t weights = skin->weights.count + 8 * (int64_t)frames * births;
    return kiriArray_ReserveMore(memory, &skin->spans, births) && kiriArray_Reserve(memory, &skin->weights, weights);
}

void kiriSkin_Inherit(kiriSkin* skin, const kiriMeshData* mesh)
{
    KIRI_FROM_TO(v, skin->spans.count, mesh->vertices.count) {
        InheritOne(skin, mesh->memory, &mesh->births.data[v - mesh->oldVertexCount]);
    }
}

void kiriSkin_Keep(kiriSkin* skin, const kiriKeep* samples, const kiriKeep* frames)
{
    KIRI_ASSERT(skin->staged.count == 0 && samples->to.count == skin->spans.count);
    KIRI_FROM_TO(i, samples->first, skin->spans.count) {
        if (!kiriKeep_Has(samples, i)) {
            DropSpan(skin, &skin->spans.data[i]);
        }
    }
    kiriKeep_Compact(samples, &skin->spans, 1, sizeof(kiriSpan));
    KIRI_EACH_WHILE(kiriKeep_Moves(frames), const kiriSpan, at, skin->spans) {
        kiriSampleWeight* weights = skin->weights.data + at->first;
        /* Frames ascend, and those below `first` stay. */
        for (int32_t k = at->count; k-- > 0 && weights[k].frame >= frames->first;) {
            KIRI_ASSERT(kiriKeep_Has(frames, weights[k].frame));
            weights[k].frame = frames->to.data[weights[k].frame];
        }
    }
}

/* ---- Samples of squares ----------------------------------------------------------------------------------------- */

static int32_t SquareCount(const kiriMeshData* mesh)
{
    return mesh->squares.columns * mesh->squares.rows;
}

bool kiriPlaces_Reserve(kiriPlaces* places, const kiriMeshData* mesh, int64_t sampleCount)
{
    if (sampleCount == 0) {
        return true;
    }
    if (!kiriArray_Reserve(mesh->memory, &places->next, sampleCount) ||
        !kiriArray_ReserveJust(mesh->memory, &places->head, SquareCount(mesh))) {
        return false;
    }
    kiriArray_Extend(&places->head, SquareCount(mesh), KIRI_NONE);
    return true;
}

bool kiriPlaces_Add(kiriPlaces* places, const kiriMeshData* mesh, kiriLatticePoint at)
{
    if (!kiriPlaces_Reserve(places, mesh, (int64_t)places->next.count + 1)) {
        return false;
    }
    int32_t square = kiriSquares_At(&mesh->squares, at), sample = places->next.count++;
    places->next.data[sample] = KIRI_NONE;
    if (square != KIRI_NONE) {
        places->next.data[sample] = places->head.data[square];
        places->head.data[square] = sample;
    }
    return true;
}

void kiriPlaces_Keep(kiriPlaces* places, const kiriKeep* samples)
{
    if (places->next.count > 0) {
        kiriKeep_Relink(samples, places->head.data, places->head.count, places->next.data, sizeof(int32_t));
        kiriKeep_Compact(samples, &places->next, 1, sizeof(int32_t));
    }
}

/* ---- Refreshing ------------------------------------------------------------------------------------------------- */

static void AddSquare(kiriRefresh* refresh, int32_t square)
{
    KIRI_ASSERT_HAS(refresh->marks, square);
    if (!refresh->marks.data[square]) {
        refresh->marks.data[square] = 1;
        KIRI_NEXT(refresh->squares) = square;
    }
}

/* Adds a square and the squares beside it, as far as a stencil reaches. */
static void AddSquaresAround(kiriRefresh* refresh, const kiriMeshData* mesh, int32_t square)
{
    int32_t columns = mesh->squares.columns, column = square % columns, row = square / columns;
    for (int32_t v = row > 0 ? row - 1 : 0; v <= row + 1 && v < mesh->squares.rows; ++v) {
        for (int32_t u = column > 0 ? column - 1 : 0; u <= column + 1 && u < columns; ++u) {
            AddSquare(refresh, v * columns + u);
        }
    }
}

bool kiriRefresh_NoteDirty(kiriRefresh* refresh, const kiriMeshData* mesh)
{
    int32_t count = mesh->squares.dirty.count;
    if (!kiriArray_Resize(mesh->memory, &refresh->noted, count)) {
        return false;
    }
    if (count > 0) {
        memcpy(refresh->noted.data, mesh->squares.dirty.data, sizeof(int32_t) * count);
    }
    return true;
}

void kiriRefresh_Drop(kiriRefresh* refresh)
{
    KIRI_EACH_LISTED_WHILE(refresh->change > 0, square, refresh->squares) {
        refresh->marks.data[square] = 0;
    }
    refresh->noted.count = refresh->change = 0;
}

kiriProgress kiriRefresh_Start(kiriRefresh* refresh, const kiriSampleSource* source, int32_t firstVertex,
                               kiriQuota* quota)
{
    enum { CHANGES_AN_ITEM = 16 };
    const kiriMeshData* mesh = source->grid->mesh;
    int32_t cells = source->shape->changes.count, squares = cells + refresh->noted.count;
    int32_t count = squares + mesh->vertices.count - firstVertex;
    refresh->oldCount = firstVertex;
    if (refresh->change == 0) {
        refresh->squares.count = refresh->square = 0;
        refresh->sample = refresh->stencil.cell = KIRI_NONE;
        if (!kiriArray_ReserveJust(source->memory, &refresh->squares, SquareCount(mesh)) ||
            !kiriArray_ReserveJust(source->memory, &refresh->marks, SquareCount(mesh))) {
            return KIRI_FAILED;
        }
        kiriArray_Extend(&refresh->marks, SquareCount(mesh), 0);
    }
    for (; refresh->change < count; ++refresh->change) {
        int32_t k = refresh->change;
        if (k % CHANGES_AN_ITEM == 0 && !kiriQuota_Take(quota, 1)) {
            return KIRI_MORE;
        }
        if (k < cells) {
            AddSquaresAround(refresh, mesh, source->grid->cells.data[source->shape->changes.data[k]].square);
        } else if (k < squares) {
            AddSquaresAround(refresh, mesh, refresh->noted.data[k - cells]);
        } else {
            AddSquare(refresh, kiriSquares_At(&mesh->squares, kiriMesh_At(mesh, firstVertex + k - squares)));
        }
    }
    kiriRefresh_Drop(refresh);
    return KIRI_DONE;
}

/* Puts the weights of one sample into the stencil. Many samples have the cell of the sample before. */
static bool WeighSample(kiriRefresh* refresh, const kiriSampleSource* source, int32_t square, int32_t sample)
{
    const kiriGrid* grid = source->grid;
    const kiriMeshData* mesh = source->grid->mesh;
    kiriStencil* stencil = &refresh->stencil;
    bool isVertex = source->places == NULL;
    kiriLatticePoint at = isVertex ? kiriMesh_At(mesh, sample) : source->points->data[sample].at;
    KIRI_ASSERT_HAS(grid->squareCell, square);
    int32_t cell = grid->squareCell.data[square];
    if (grid->cells.data[cell].next != KIRI_NONE) {
        cell = isVertex ? kiriGrid_CellOfVertex(grid, sample) : kiriGrid_CellAround(grid, at);
    }
    if (stencil->cell != cell && !kiriStencil_Gather(stencil, source->memory, source->shape, grid, cell)) {
        return false;
    }
    kiriVec2 lean = stencil->split && isVertex ? kiriMesh_Lean(mesh, sample) : kiriVec2_Make(0.0, 0.0);
    kiriStencil_Weigh(stencil, kiriMesh_Local(mesh, at), lean);
    return true;
}

/* Lists the vertices that creases join at the point of a vertex, ascending. */
static bool ListJoined(kiriIndices* joined, const kiriMeshData* mesh, int32_t vertex)
{
    int32_t start = mesh->vertices.data[vertex].edge, h = start;
    bool ok = true;
    KIRI_ASSERT(start >= 0 && kiriMesh_Tail(mesh, start) == vertex);
    joined->count = 0;
    for (int32_t back = start;;) { /* clockwise to the first edge of the fans */
        int32_t twin = kiriMesh_Twin(mesh, back);
        bool isJoined = twin != KIRI_NONE && (!kiriMesh_IsOpen(mesh, back) || kiriMesh_IsCrease(mesh, back));
        h = back;
        back = isJoined ? kiriEdge_Next(twin) : start;
        if (back == start) {
            break;
        }
    }
    const int32_t first = h;
    do {
        int32_t previous = kiriEdge_Previous(h), v = kiriMesh_Tail(mesh, h), at = joined->count;
        bool isKnown = false;
        KIRI_EACH_LISTED(known, *joined) {
            isKnown = isKnown || known == v;
        }
        ok = isKnown || kiriArray_Push(mesh->memory, joined, v);
        for (; ok && !isKnown && at > 0 && joined->data[at - 1] > v; --at) {
            joined->data[at] = joined->data[at - 1];
            joined->data[at - 1] = v;
        }
        bool isJoined = !kiriMesh_IsOpen(mesh, previous) || kiriMesh_IsCrease(mesh, previous);
        h = isJoined ? kiriMesh_Twin(mesh, previous) : KIRI_NONE;
    } while (ok && h != KIRI_NONE && h != first);
    return ok;
}

/* Adds a part of a weight to the mean. Its frames stay sorted. */
static bool AddToMean(kiriStencil* mean, kiriMemory* memory, int32_t frame, double value)
{
    int32_t at = mean->frames.count;
    KIRI_ASSERT(mean->values.count == at && frame >= 0);
    while (at > 0 && mean->frames.data[at - 1] >= frame) {
        --at;
    }
    if (at == mean->frames.count || mean->frames.data[at] != frame) {
        if (!kiriArray_Push(memory, &mean->frames, frame) || !kiriArray_Push(memory, &mean->values, 0.0)) {
            return false;
        }
        for (int32_t k = mean->frames.count - 1; k > at; --k) {
            mean->frames.data[k] = mean->frames.data[k - 1];
            mean->values.data[k] = mean->values.data[k - 1];
        }
        mean->frames.data[at] = frame;
        mean->values.data[at] = 0.0;
    }
    mean->values.data[at] += value;
    return true;
}

/* Finds the weights of a sample. The vertices of a fold at one point have the mean of their weights: so they have one
   position, and a blend of both sides is nowhere else. */
static const kiriStencil* FindWeights(kiriRefresh* refresh, const kiriSampleSource* source, int32_t square,
                                      int32_t sample)
{
    kiriStencil* mean = &refresh->mean;
    refresh->joined.count = 0;
    bool isJoined = source->places == NULL && source->grid->mesh->folds.count > 0;
    bool ok = !isJoined || ListJoined(&refresh->joined, source->grid->mesh, sample);
    if (ok && refresh->joined.count < 2) {
        return WeighSample(refresh, source, square, sample) ? &refresh->stencil : NULL;
    }
    mean->frames.count = mean->values.count = 0;
    KIRI_EACH_LISTED_WHILE(ok, vertex, refresh->joined) {
        ok = WeighSample(refresh, source, square, vertex);
        KIRI_EACH_INDEX_WHILE(ok, k, refresh->stencil.frames) {
            ok = AddToMean(mean, source->memory, refresh->stencil.frames.data[k],
                           refresh->stencil.values.data[k] / refresh->joined.count);
        }
    }
    return ok ? mean : NULL;
}

/* Stages one sample. */
static bool RefreshOne(kiriRefresh* refresh, const kiriSampleSource* source, int32_t square, int32_t sample)
{
    kiriSkin* skin = source->skin;
    bool isVertex = source->places == NULL;
    const kiriStencil* stencil = FindWeights(refresh, source, square, sample);
    if (stencil == NULL || !StageWeights(skin, source->memory, stencil, sample)) {
        return false;
    }
    /* Weights of an old vertex have often not changed: then it is not staged. A point that is staged may have another
       cell, too. */
    kiriSpan* is = &skin->staged.data[skin->staged.count - 1].span;
    kiriSpan was = isVertex && sample < refresh->oldCount ? skin->spans.data[sample] : (kiriSpan){ 0 };
    if (was.count == is->count && memcmp(skin->weights.data + was.first, skin->weights.data + is->first,
                                         sizeof(kiriSampleWeight) * is->count) == 0) {
        DropSpan(skin, is);
        skin->staged.count -= 1;
    }
    return true;
}

kiriProgress kiriRefresh_Stage(kiriRefresh* refresh, const kiriSampleSource* source, kiriQuota* quota)
{
    enum { SQUARES_AN_ITEM = 16 };
    const kiriMeshData* mesh = source->grid->mesh;
    const kiriPlaces* places = source->places;
    if (places != NULL && places->next.count == 0) {
        return KIRI_DONE;
    }
    for (; refresh->square < refresh->squares.count; ++refresh->square) {
        bool isNext = refresh->sample == KIRI_NONE && refresh->square % SQUARES_AN_ITEM == 0;
        if (!kiriQuota_Take(quota, isNext)) {
            return KIRI_MORE;
        }
        int32_t square = refresh->squares.data[refresh->square], sample = refresh->sample;
        if (sample == KIRI_NONE) {
            sample = places == NULL ? mesh->squares.vertexHead[square] : places->head.data[square];
        }
        for (; sample != KIRI_NONE;
             sample = places == NULL ? mesh->vertices.data[sample].next : places->next.data[sample]) {
            refresh->sample = sample;
            if (kiriMemory_MustPause(source->memory) || !kiriQuota_Take(quota, 1)) {
                return KIRI_MORE;
            }
            if (!RefreshOne(refresh, source, square, sample)) {
                return KIRI_FAILED;
            }
        }
        refresh->sample = KIRI_NONE;
    }
    refresh->square = 0;
    return KIRI_DONE;
}

/* ---- Motion ----------------------------------------------------------------------------------------------------- */

kiriVec3 kiriSkin_Position(const kiriSkin* skin, int32_t sample, const kiriFrameData* frames,
                           kiriVec2 local)
{
    KIRI_ASSERT_HAS(skin->spans, sample);
    kiriVec3 x = { 0 };
    kiriSpan span = skin->spans.data[sample];
    KIRI_EACH_IN(i, span) {
        kiriSampleWeight weight = skin->weights.data[i];
        x = kiriVec3_AddScaled(x, weight.value, kiriFrame_Carry(&frames[weight.frame], local));
    }
    return x;
}

kiriMotion kiriSkin_Motion(const kiriSkin* vertexSkin, const kiriFrameData* frames,
                           const kiriMeshData* mesh, int32_t triangle, kiriLatticePoint at)
{
    kiriMotion motion = { 0 };
    kiriVec2 local = kiriMesh_Local(mesh, at);
    double shares[3];
    kiriMesh_Shares(mesh, triangle, at, shares);
    KIRI_EACH_CORNER(k) {
        kiriSpan span = vertexSkin->spans.data[mesh->triangles.data[triangle].vertex[k]];
        KIRI_EACH_IN(i, span) {
            kiriSampleWeight weight = vertexSkin->weights.data[i];
            const kiriFrameData* frame = &frames[weight.frame];
            kiriMat3 rate = kiriFrame_Rate(frame);
            double w = shares[k] * weight.value;
            motion.x = kiriVec3_AddScaled(motion.x, w, kiriFrame_Carry(frame, local));
            motion.velocity = kiriVec3_AddScaled(motion.velocity, w, kiriFrame_VelocityAt(frame, local));
            motion.spin = kiriVec3_AddScaled(motion.spin, w, frame->spin);
            motion.A = kiriMat3_AddScaled(&motion.A, w, &frame->A);
            motion.rate = kiriMat3_AddScaled(&motion.rate, w, &rate);
        }
    }
    return motion;
}
