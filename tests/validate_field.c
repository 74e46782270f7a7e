#include "validate_check.h"
#include "reaches.h"

#include <stdlib.h>
#include <string.h>

/* ---- Spans ---- */

/* The class of a span: its room is 1 << class. */
static int ClassOf(int32_t count)
{
    int size = 0;
    while ((int64_t)1 << size < count) {
        ++size;
    }
    return size;
}

static bool Rooms_Mark(Check* check, Rooms* rooms, int32_t first, int size, int32_t owner)
{
    REQUIRE(first >= 0 && first + ((int64_t)1 << size) <= rooms->count,
            "room of %d items at %d is outside an array of %d (of %d)", 1 << size, first, rooms->count, owner);
    for (int32_t k = first; k < first + (1 << size); ++k) {
        REQUIRE(!rooms->taken[k], "item %d is in two rooms (of %d)", k, owner);
        rooms->taken[k] = 1;
    }
    return true;
}

bool Rooms_Start(Check* check, Rooms* rooms, const void* items, size_t itemBytes, int32_t count, const kiriSpans* spans)
{
    *rooms = (Rooms){ items, itemBytes, count, spans, Check_Bytes(check, count) };
    for (int size = 0; size < KIRI_SPAN_SIZES; ++size) {
        for (int32_t first = spans->freeHead[size] - 1; first != KIRI_NONE;) {
            if (!Rooms_Mark(check, rooms, first, size, KIRI_NONE)) {
                return false;
            }
            int32_t next;
            memcpy(&next, (const char*)items + (size_t)first * itemBytes, sizeof(next));
            first = next - 1;
        }
    }
    return true;
}

bool Rooms_Take(Check* check, Rooms* rooms, kiriSpan span, int32_t owner)
{
    REQUIRE(span.count >= 0, "span of %d has %d items", owner, span.count);
    return span.count == 0 || Rooms_Mark(check, rooms, span.first, ClassOf(span.count), owner);
}

bool Rooms_End(Check* check, Rooms* rooms)
{
    for (int32_t k = 0; k < rooms->count; ++k) {
        REQUIRE(rooms->taken[k], "item %d is in no span, and not free", k);
    }
    return true;
}

/* ---- Cells ---- */

static bool Check_Cells(Check* check, const kiriSheetData* sheet)
{
    const kiriGrid* grid = &sheet->grid;
    const kiriMeshData* mesh = &sheet->mesh;
    int32_t live = 0, unused = 0;
    double area = 0.0;
    REQUIRE_COUNT(grid->squareCell, mesh->squares.columns * mesh->squares.rows);
    REQUIRE_COUNT(grid->whole, grid->squareCell.count);
    REQUIRE_COUNT(grid->runs, grid->cells.count);
    REQUIRE_COUNT(grid->nodeCell, mesh->squares.nodes.count);
    for (int32_t s = 0; s < grid->squareCell.count; ++s) {
        int32_t last = KIRI_NONE;
        for (int32_t c = grid->squareCell.data[s]; c != KIRI_NONE; c = grid->cells.data[c].next) {
            REQUIRE(IsIndex(c, grid->cells.count) && live < grid->cells.count, "square %d has cell %d", s, c);
            const kiriCell* cell = &grid->cells.data[c];
            REQUIRE(cell->square == s, "cell %d of square %d says it is of %d", c, s, cell->square);
            REQUIRE(cell->triangle > last, "cell %d of square %d comes too late", c, s);
            REQUIRE(cell->material >= KIRI_NONE && cell->material < grid->materials.count, "cell %d has material %d", c,
                    cell->material);
            REQUIRE(kiriGrid_Area(grid, c) > 0.0, "cell %d has area %g", c, kiriGrid_Area(grid, c));
            REQUIRE(!grid->whole.data[s] || (last == KIRI_NONE && cell->next == KIRI_NONE),
                    "square %d is whole and has two cells", s);
            last = cell->triangle;
            area += kiriGrid_Area(grid, c);
            ++live;
        }
    }
    REQUIRE(live == grid->cellCount, "%d cells live, counted %d", live, grid->cellCount);
    for (int32_t c = grid->freeCell; c != KIRI_NONE; c = grid->cells.data[c].next) {
        REQUIRE(IsIndex(c, grid->cells.count) && unused < grid->cells.count, "free cell %d", c);
        REQUIRE(!kiriGrid_IsCell(grid, c), "free cell %d is of square %d", c, grid->cells.data[c].square);
        ++unused;
    }
    REQUIRE(live + unused == grid->cells.count, "%d cells live, %d are free, of %d", live, unused, grid->cells.count);
    double specks = 1e-14 * grid->side * grid->side * live; /* the least that each has */
    REQUIRE(IsNear(area, kiriMesh_Area(mesh), 1e-9 * area + specks), "cells cover %.15g, the mesh %.15g", area,
            kiriMesh_Area(mesh));
    return true;
}

/* Joins the nodes of a square whose triangles hang together in it. */
static bool Check_PartsOfSquare(Check* check, const kiriSheetData* sheet, int32_t square, int32_t* nodeOf,
                                int32_t* parent)
{
    const kiriMeshData* mesh = &sheet->mesh;
    const kiriSquareNode* nodes = mesh->squares.nodes.data;
    const int32_t* cellOf = sheet->grid.nodeCell.data;
    int32_t parts = 0, cells = 0;
    for (int32_t n = mesh->squares.head[square]; n != KIRI_NONE; n = nodes[n].next) {
        nodeOf[nodes[n].triangle] = n;
        ++parts;
    }
    for (int32_t n = mesh->squares.head[square]; n != KIRI_NONE; n = nodes[n].next) {
        REQUIRE(IsIndex(cellOf[n], sheet->grid.cells.count) && sheet->grid.cells.data[cellOf[n]].square == square,
                "triangle %d in square %d is of cell %d", nodes[n].triangle, square, cellOf[n]);
        REQUIRE(sheet->grid.cells.data[cellOf[n]].triangle <= nodes[n].triangle, "cell %d has a lower triangle %d",
                cellOf[n], nodes[n].triangle);
        for (int32_t h = 3 * nodes[n].triangle; h < 3 * nodes[n].triangle + 3; ++h) {
            int32_t twin = kiriMesh_Twin(mesh, h), other = twin == KIRI_NONE ? KIRI_NONE : nodeOf[twin / 3];
            if (twin < h || kiriMesh_IsOpen(mesh, h) || other == KIRI_NONE ||
                !kiriSquares_RunsThrough(&mesh->squares, square, mesh->vertices.data[kiriMesh_Tail(mesh, h)].at,
                                         mesh->vertices.data[kiriMesh_Tail(mesh, kiriEdge_Next(h))].at)) {
                continue;
            }
            REQUIRE(cellOf[n] == cellOf[other], "triangles %d and %d of square %d are of cells %d and %d",
                    nodes[n].triangle, twin / 3, square, cellOf[n], cellOf[other]);
            parts = Union_Join(parent, n, other, parts);
        }
    }
    for (int32_t c = sheet->grid.squareCell.data[square]; c != KIRI_NONE; c = sheet->grid.cells.data[c].next) {
        int32_t lowest = sheet->grid.cells.data[c].triangle;
        REQUIRE(IsIndex(lowest, mesh->triangles.count) && nodeOf[lowest] != KIRI_NONE && cellOf[nodeOf[lowest]] == c,
                "cell %d does not have its triangle %d", c, lowest);
        ++cells;
    }
    REQUIRE(parts == cells, "square %d has %d parts and %d cells", square, parts, cells);
    for (int32_t n = mesh->squares.head[square]; n != KIRI_NONE; n = nodes[n].next) {
        nodeOf[nodes[n].triangle] = KIRI_NONE;
    }
    return true;
}

/* The cells of each square are what its triangles fall into along open edges. */
static bool Check_Parts(Check* check, const kiriSheetData* sheet)
{
    int32_t* nodeOf = Check_Ints(check, sheet->mesh.triangles.count, KIRI_NONE);
    int32_t* parent = Check_Unions(check, sheet->mesh.squares.nodes.count);
    for (int32_t s = 0; s < sheet->grid.squareCell.count; ++s) {
        if (!Check_PartsOfSquare(check, sheet, s, nodeOf, parent)) {
            return false;
        }
    }
    return true;
}

/* ---- Faces ---- */

static int32_t FaceWith(const kiriGrid* grid, int32_t a, int32_t b)
{
    int32_t f = grid->cells.data[a].firstFace;
    while (f != KIRI_NONE && grid->faces.data[f].cell[grid->faces.data[f].cell[0] == a] != b) {
        f = grid->faces.data[f].next[grid->faces.data[f].cell[1] == a];
    }
    return f;
}

static bool Check_Face(Check* check, const kiriSheetData* sheet, int32_t f)
{
    const kiriGrid* grid = &sheet->grid;
    const kiriFace* face = &grid->faces.data[f];
    int32_t axis = kiriFace_Axis(face), apart = axis == 0 ? 1 : sheet->mesh.squares.columns;
    for (int k = 0; k < 2; ++k) {
        REQUIRE(IsIndex(face->cell[k], grid->cells.count) && kiriGrid_IsCell(grid, face->cell[k]),
                "face %d is of cell %d", f, face->cell[k]);
    }
    int32_t a = grid->cells.data[face->cell[0]].square, b = grid->cells.data[face->cell[1]].square;
    REQUIRE(a + apart == b && (axis == 1 || b % sheet->mesh.squares.columns != 0),
            "face %d is between squares %d and %d", f, a, b);
    kiriStretch s = kiriGrid_Stretch(grid, f);
    REQUIRE(s.width > 0.0 && s.width < grid->side * (1.0 + 1e-9), "face %d is %g wide", f, s.width);
    REQUIRE(s.moment > 0.0 || s.width < 1e-100, "face %d has moment %g", f, s.moment);
    kiriVec2 from = kiriMesh_Local(&sheet->mesh, kiriSquares_Corner(&sheet->mesh.squares, b));
    double along = axis == 0 ? s.middle.y - from.y : s.middle.x - from.x;
    double across = axis == 0 ? s.middle.x - from.x : s.middle.y - from.y;
    REQUIRE(IsNear(across, 0.0, 1e-9 * grid->side) && along > -1e-9 * grid->side && along < grid->side * (1.0 + 1e-9),
            "face %d is not on its side", f);
    return true;
}

/* Faces are in the lists of both their cells, once. */
static bool Check_FaceLists(Check* check, const kiriSheetData* sheet)
{
    const kiriGrid* grid = &sheet->grid;
    int32_t live = 0, unused = 0, listed = 0;
    for (int32_t f = 0; f < grid->faces.count; ++f) {
        if (grid->faces.data[f].cell[0] != KIRI_NONE) {
            ++live;
            if (!Check_Face(check, sheet, f)) {
                return false;
            }
        }
    }
    for (int32_t c = 0; c < grid->cells.count; ++c) {
        int32_t f = kiriGrid_IsCell(grid, c) ? grid->cells.data[c].firstFace : KIRI_NONE;
        while (f != KIRI_NONE) {
            REQUIRE(IsIndex(f, grid->faces.count) && listed <= 2 * live, "cell %d lists face %d", c, f);
            const kiriFace* face = &grid->faces.data[f];
            REQUIRE(face->cell[0] == c || face->cell[1] == c, "cell %d lists face %d of others", c, f);
            f = face->next[face->cell[1] == c];
            ++listed;
        }
    }
    REQUIRE(listed == 2 * live, "cells list %d faces, %d live", listed, live);
    for (int32_t f = grid->freeFace; f != KIRI_NONE; f = grid->faces.data[f].next[0]) {
        REQUIRE(IsIndex(f, grid->faces.count) && unused < grid->faces.count, "free face %d", f);
        REQUIRE(grid->faces.data[f].cell[0] == KIRI_NONE, "free face %d is of cell %d", f, grid->faces.data[f].cell[0]);
        ++unused;
    }
    REQUIRE(live + unused == grid->faces.count, "%d faces live, %d are free, of %d", live, unused, grid->faces.count);
    return true;
}

/* Two cells that share a triangle over the side between their squares have a face; so do no others. */
static bool Check_FacesAreComplete(Check* check, const kiriSheetData* sheet)
{
    const kiriGrid* grid = &sheet->grid;
    const kiriSquares* squares = &sheet->mesh.squares;
    int32_t* first = Check_Ints(check, sheet->mesh.triangles.count, KIRI_NONE); /* node of each triangle */
    int32_t* next = Check_Ints(check, squares->nodes.count, KIRI_NONE);
    int32_t* square = Check_Ints(check, squares->nodes.count, KIRI_NONE);
    int32_t* cellIn = Check_Ints(check, grid->squareCell.count, KIRI_NONE); /* of the triangle at hand */
    uint8_t* found = Check_Bytes(check, grid->faces.count);
    for (int32_t s = 0; s < grid->squareCell.count; ++s) {
        for (int32_t n = squares->head[s]; n != KIRI_NONE; n = squares->nodes.data[n].next) {
            square[n] = s;
            next[n] = first[squares->nodes.data[n].triangle];
            first[squares->nodes.data[n].triangle] = n;
        }
    }
    for (int32_t t = 0; t < sheet->mesh.triangles.count; ++t) {
        for (int32_t n = first[t]; n != KIRI_NONE; n = next[n]) {
            cellIn[square[n]] = grid->nodeCell.data[n];
        }
        for (int32_t n = first[t]; n != KIRI_NONE; n = next[n]) {
            for (int axis = 0; axis < 2; ++axis) {
                int32_t before = square[n] - (axis == 0 ? 1 : squares->columns);
                bool isInside = axis == 0 ? square[n] % squares->columns > 0 : before >= 0;
                if (isInside && cellIn[before] != KIRI_NONE) {
                    int32_t f = FaceWith(grid, grid->nodeCell.data[n], cellIn[before]);
                    REQUIRE(f != KIRI_NONE, "no face between cells %d and %d", cellIn[before], grid->nodeCell.data[n]);
                    found[f] = 1;
                }
            }
        }
        for (int32_t n = first[t]; n != KIRI_NONE; n = next[n]) {
            cellIn[square[n]] = KIRI_NONE;
        }
    }
    for (int32_t f = 0; f < grid->faces.count; ++f) {
        REQUIRE(found[f] == (grid->faces.data[f].cell[0] != KIRI_NONE), "face %d has no material", f);
    }
    return true;
}

/* ---- Steps ---- */

static bool HasWayBack(const kiriGrid* grid, int32_t from, int length, kiriStep step)
{
    bool found = false;
    kiriSteps steps = kiriGrid_GetSteps(grid, step.cell);
    for (int32_t k = length == 0 ? 0 : steps.end[length - 1]; !found && k < steps.end[length]; ++k) {
        kiriStep back = kiriSteps_At(&steps, k);
        found = back.cell == from && back.length == step.length && back.u == -step.u && back.v == -step.v;
    }
    return found;
}

/* Stored steps, or an open cell with two rows of squares around it. */
static bool IsRun(const kiriSheetData* sheet, int32_t c)
{
    const kiriGrid* grid = &sheet->grid;
    const kiriStepRun* run = &grid->runs.data[c];
    int32_t square = grid->cells.data[c].square, columns = sheet->mesh.squares.columns;
    int32_t column = square % columns, row = square / columns;
    if (kiriStepRun_IsOpen(run)) {
        return c == square && column >= 2 && column < columns - 2 && row >= 2 &&
               row < sheet->mesh.squares.rows - 2;
    }
    return !kiriGrid_IsOpen(grid, c) && run->first <= run->end[0] && run->end[0] <= run->end[1] &&
           run->end[1] <= run->end[2] && run->end[2] <= grid->steps.count;
}

/* Before any is followed. */
static bool Check_Runs(Check* check, const kiriSheetData* sheet)
{
    for (int32_t c = 0; c < sheet->grid.cells.count; ++c) {
        const kiriStepRun* run = &sheet->grid.runs.data[c];
        REQUIRE(!kiriGrid_IsCell(&sheet->grid, c) || IsRun(sheet, c), "cell %d has steps %d to %d, %d, %d", c,
                run->first, run->end[0], run->end[1], run->end[2]);
    }
    return true;
}

static bool Check_StepsOfCell(Check* check, const kiriSheetData* sheet, int32_t c)
{
    static const int16_t lengths[KIRI_STEP_LENGTHS] = { KIRI_UNIT, KIRI_UNIT_DIAGONAL, KIRI_UNIT_KNIGHT };
    static const int squared[KIRI_STEP_LENGTHS] = { 1, 2, 5 };
    const kiriGrid* grid = &sheet->grid;
    kiriSteps steps = kiriGrid_GetSteps(grid, c);
    int32_t faces = 0, straight = steps.end[0];
    for (int length = 0; length < KIRI_STEP_LENGTHS; ++length) {
        for (int32_t k = length == 0 ? 0 : steps.end[length - 1]; k < steps.end[length]; ++k) {
            kiriStep step = kiriSteps_At(&steps, k);
            REQUIRE(IsIndex(step.cell, grid->cells.count) && kiriGrid_IsCell(grid, step.cell),
                    "a step leads from cell %d to %d", c, step.cell);
            REQUIRE(step.length == lengths[length] && step.u * step.u + step.v * step.v == squared[length],
                    "the step from cell %d to %d is %d long", c, step.cell, step.length);
            REQUIRE(grid->cells.data[step.cell].square ==
                        grid->cells.data[c].square + step.u + step.v * sheet->mesh.squares.columns,
                    "the step from cell %d to %d goes %d and %d squares", c, step.cell, step.u, step.v);
            REQUIRE(HasWayBack(grid, c, length, step), "the step from cell %d to %d has no way back", c, step.cell);
            REQUIRE(length > 0 || FaceWith(grid, c, step.cell) != KIRI_NONE, "no face, but a step from cell %d to %d",
                    c, step.cell);
        }
    }
    for (int32_t f = grid->cells.data[c].firstFace; f != KIRI_NONE;
         f = grid->faces.data[f].next[grid->faces.data[f].cell[1] == c]) {
        ++faces;
    }
    REQUIRE(faces == straight, "cell %d has %d faces and %d straight steps", c, faces, straight);
    return true;
}

static bool Check_Steps(Check* check, const kiriSheetData* sheet)
{
    enum { LEAST_ROOM = 16 }; /* in kiri_grid.c */
    const kiriGrid* grid = &sheet->grid;
    Rooms rooms;
    if (!Check_Runs(check, sheet) ||
        !Rooms_Start(check, &rooms, grid->steps.data, sizeof(kiriStep), grid->steps.count, &grid->stepRoom)) {
        return false;
    }
    for (int32_t c = 0; c < grid->cells.count; ++c) {
        if (!kiriGrid_IsCell(grid, c)) {
            continue;
        }
        if (!Check_StepsOfCell(check, sheet, c)) {
            return false;
        }
        const kiriStepRun* run = &grid->runs.data[c];
        int32_t count = kiriStepRun_IsOpen(run) ? 0 : run->end[KIRI_STEP_LENGTHS - 1] - run->first;
        kiriSpan span = { run->first, count > 0 && count < LEAST_ROOM ? LEAST_ROOM : count };
        if (!Rooms_Take(check, &rooms, span, c)) {
            return false;
        }
    }
    return Rooms_End(check, &rooms);
}

bool Check_Grid(Check* check, const kiriSheetData* sheet)
{
    check->part = "grid";
    return Check_Cells(check, sheet) && Check_Parts(check, sheet) && Check_FaceLists(check, sheet) &&
           Check_FacesAreComplete(check, sheet) && Check_Steps(check, sheet);
}

/* ---- Regions ---- */

static bool IsNearerSeed(kiriSeed a, kiriSeed b)
{
    return a.distance != b.distance ? a.distance < b.distance : a.owner < b.owner;
}

/* The nearest of the cell's own seed and the ways over its neighbours: the field is the one fixed point of this. */
static kiriSeed NearestWay(const kiriSheetData* sheet, int32_t c)
{
    const kiriGrid* grid = &sheet->grid;
    const int32_t* siteAt = sheet->regions.siteAt.data;
    kiriSeed best = { c, KIRI_FAR, INT32_MAX };
    kiriSteps steps = kiriGrid_GetSteps(grid, c);
    if (siteAt[c] != KIRI_NONE) {
        best = kiriSite_SeedAt(&sheet->frames.data[siteAt[c]].site, siteAt[c], grid, c);
    }
    for (int32_t k = 0; k < steps.end[2]; ++k) {
        kiriStep step = kiriSteps_At(&steps, k);
        kiriSeed way = { c, sheet->regions.field.distance.data[step.cell] + step.length,
                         sheet->regions.field.owner.data[step.cell] };
        best = IsNearerSeed(way, best) ? way : best;
        if (siteAt[c] == KIRI_NONE && siteAt[step.cell] != KIRI_NONE) {
            int32_t site = siteAt[step.cell];
            kiriSeed seed = kiriSite_SeedAt(&sheet->frames.data[site].site, site, grid, c);
            best = seed.distance != KIRI_FAR && IsNearerSeed(seed, best) ? seed : best;
        }
    }
    return best;
}

static bool Check_Distances(Check* check, const kiriSheetData* sheet)
{
    const kiriGrid* grid = &sheet->grid;
    const kiriField* field = &sheet->regions.field;
    for (int32_t c = 0; c < grid->cells.count; ++c) {
        if (kiriGrid_IsCell(grid, c)) {
            REQUIRE(IsIndex(field->owner.data[c], sheet->frames.count), "cell %d is owned by %d", c,
                    field->owner.data[c]);
            REQUIRE(field->distance.data[c] >= 0 && field->distance.data[c] < KIRI_FAR, "cell %d is at distance %d", c,
                    field->distance.data[c]);
        }
    }
    for (int32_t c = 0; c < grid->cells.count; ++c) {
        if (!kiriGrid_IsCell(grid, c)) {
            REQUIRE(field->distance.data[c] == KIRI_FAR && field->owner.data[c] == KIRI_NONE,
                    "cell %d is no more, but owned by %d", c, field->owner.data[c]);
            continue;
        }
        kiriSeed way = NearestWay(sheet, c);
        REQUIRE(way.distance == field->distance.data[c] && way.owner == field->owner.data[c],
                "cell %d is at %d from %d, but there is a way of %d from %d", c, field->distance.data[c],
                field->owner.data[c], way.distance, way.owner);
        bool onBorder = false;
        kiriSteps steps = kiriGrid_GetSteps(grid, c);
        for (int32_t k = 0; k < steps.end[2]; ++k) {
            onBorder = onBorder || field->owner.data[kiriSteps_At(&steps, k).cell] != field->owner.data[c];
        }
        REQUIRE(onBorder == (sheet->regions.onBorder.data[c] != 0), "cell %d and the border", c);
    }
    return true;
}

static bool Check_Sites(Check* check, const kiriSheetData* sheet)
{
    const kiriRegions* regions = &sheet->regions;
    int32_t count = 0;
    for (int32_t c = 0; c < regions->siteAt.count; ++c) {
        count += regions->siteAt.data[c] != KIRI_NONE;
    }
    for (int32_t i = 0; i < sheet->frames.count; ++i) {
        int32_t cell = sheet->frames.data[i].site.cell;
        REQUIRE(IsIndex(cell, regions->siteAt.count) && kiriGrid_IsCell(&sheet->grid, cell) &&
                    regions->siteAt.data[cell] == i,
                "frame %d has its site in cell %d", i, cell);
    }
    REQUIRE(count == sheet->frames.count, "%d cells have sites, of %d frames", count, sheet->frames.count);
    return true;
}

static bool Check_Tallies(Check* check, const kiriSheetData* sheet)
{
    const kiriGrid* grid = &sheet->grid;
    int32_t frames = sheet->frames.count;
    double extent = 536870912.0 * sheet->mesh.step;
    kiriTally* sums = kiriMemory_AllocZeroed(&check->memory, (int64_t)sizeof(kiriTally) * (frames + 1));
    REQUIRE(sums != NULL, "no memory");
    for (int32_t c = 0; c < grid->cells.count; ++c) {
        if (kiriGrid_IsCell(grid, c)) {
            kiriMoments material = kiriGrid_Material(grid, c);
            kiriTally_Add(&sums[sheet->regions.field.owner.data[c]], &material, 1, extent);
        }
    }
    for (int32_t i = 0; i < frames; ++i) {
        REQUIRE(memcmp(&sums[i], &sheet->regions.material.data[i], sizeof(kiriTally)) == 0,
                "the tally of frame %d has area %.17g, its cells %.17g", i,
                kiriTally_Moments(&sheet->regions.material.data[i], extent).area,
                kiriTally_Moments(&sums[i], extent).area);
        /* All of them after another material, see kiriSettings_Change. */
        REQUIRE(sheet->regions.dirty.data[i] == sheet->regions.dirty.data[0], "frame %d is dirty after the commit", i);
        const kiriMoments moments = kiriTally_Moments(&sums[i], extent);
        const kiriFrameData* frame = &sheet->frames.data[i];
        kiriVec2 center = kiriMoments_Center(&moments);
        REQUIRE(IsNear(frame->area, moments.area, 1e-12 * moments.area), "frame %d has area %.17g, its region %.17g", i,
                frame->area, moments.area);
        REQUIRE(IsNear(frame->center.x, center.x, 1e-9 * extent) && IsNear(frame->center.y, center.y, 1e-9 * extent),
                "frame %d is not in the middle of its region", i);
    }
    return true;
}

/* Who owned what of each square when material was last handed over is who owns it now. */
static bool Check_Owners(Check* check, const kiriSheetData* sheet)
{
    const kiriOwnership* ownership = &UpdateOf(sheet)->refit.ownership;
    const kiriSquares* squares = &sheet->mesh.squares;
    Rooms rooms;
    REQUIRE(ownership->staged.count == 0 && ownership->dirty.count == 0, "%d squares are staged, %d noted",
            ownership->staged.count, ownership->dirty.count);
    REQUIRE_COUNT(ownership->squares, sheet->grid.squareCell.count);
    if (!Rooms_Start(check, &rooms, ownership->triangleOwners.data, sizeof(kiriTriangleOwner),
                     ownership->triangleOwners.count, &ownership->spans)) {
        return false;
    }
    for (int32_t s = 0; s < ownership->squares.count; ++s) {
        kiriSpan parts = ownership->squares.data[s].parts;
        if (!Rooms_Take(check, &rooms, parts, s)) {
            return false;
        }
        for (int32_t n = squares->head[s]; n != KIRI_NONE; n = squares->nodes.data[n].next) {
            int32_t triangle = squares->nodes.data[n].triangle, k = 0;
            while (k < parts.count && ownership->triangleOwners.data[parts.first + k].triangle != triangle) {
                ++k;
            }
            int32_t owner = k < parts.count ? ownership->triangleOwners.data[parts.first + k].owner
                                            : ownership->squares.data[s].owner;
            int32_t is = sheet->regions.field.owner.data[sheet->grid.nodeCell.data[n]];
            REQUIRE((k < parts.count) == (parts.count > 0) && owner == is,
                    "triangle %d of square %d was handed over to frame %d, and is of %d", triangle, s, owner, is);
        }
    }
    return Rooms_End(check, &rooms);
}

bool Check_Regions(Check* check, const kiriSheetData* sheet)
{
    const kiriRegions* regions = &sheet->regions;
    check->part = "regions";
    REQUIRE_COUNT(regions->field.distance, sheet->grid.cells.count);
    REQUIRE_COUNT(regions->field.owner, sheet->grid.cells.count);
    REQUIRE_COUNT(regions->siteAt, sheet->grid.cells.count);
    REQUIRE_COUNT(regions->onBorder, sheet->grid.cells.count);
    REQUIRE_COUNT(regions->material, sheet->frames.count);
    REQUIRE_COUNT(regions->dirty, sheet->frames.count);
    REQUIRE(regions->orphans.count == 0 && regions->changes.count == 0 && !regions->running, "%d orphans, %d changes",
            regions->orphans.count, regions->changes.count);
    return Check_Sites(check, sheet) && Check_Distances(check, sheet) && Check_Tallies(check, sheet) &&
           Check_Owners(check, sheet);
}

/* ---- Shape functions ---- */

static bool Check_CellWeights(Check* check, const kiriSheetData* sheet)
{
    const kiriShape* shape = &sheet->shape;
    Rooms rooms;
    REQUIRE_COUNT(shape->spans, sheet->grid.cells.count);
    REQUIRE(shape->changes.count == 0, "%d cells changed since the commit", shape->changes.count);
    if (!Rooms_Start(check, &rooms, shape->weights.data, sizeof(kiriCellWeight), shape->weights.count, &shape->room)) {
        return false;
    }
    for (int32_t c = 0; c < shape->spans.count; ++c) {
        kiriSpan span = shape->spans.data[c];
        int32_t last = KIRI_NONE;
        if (!Rooms_Take(check, &rooms, span, c)) {
            return false;
        }
        REQUIRE((span.count > 0) == kiriGrid_IsCell(&sheet->grid, c), "cell %d has %d weights", c, span.count);
        for (int32_t k = span.first; k < span.first + span.count; ++k) {
            const kiriCellWeight* weight = &shape->weights.data[k];
            REQUIRE(weight->frame > last && weight->frame < sheet->frames.count,
                    "cell %d: weight of frame %d after %d", c, weight->frame, last);
            last = weight->frame;
            REQUIRE(kiriCellWeight_Value(weight) > 0.0 && kiriCellWeight_Value(weight) <= 1.0, "cell %d: weight", c);
        }
    }
    return Rooms_End(check, &rooms);
}

/* Which weight the distances to site and border give (section 4.1, algorithm 2). */
static double RawWeight(const kiriSheetData* sheet, int32_t frame, Reach reach)
{
    double d = reach.fromSite, e = reach.fromBorder;
    if (sheet->regions.field.owner.data[reach.cell] == frame) {
        return 0.5 * (1.0 + e / (d + e));
    }
    return d > 2.0 * e ? 0.5 * (1.0 - e / (d - e)) : 0.0;
}

/* The weights are those that the distances give, and there are no others. */
static bool Check_Reaches(Check* check, const kiriSheetData* sheet)
{
    const kiriShape* shape = &sheet->shape;
    int32_t* seen = Check_Ints(check, sheet->grid.cells.count, KIRI_NONE);
    double* sums = kiriMemory_AllocZeroed(&check->memory, (int64_t)sizeof(double) * (sheet->grid.cells.count + 1));
    int64_t found = 0, all = 0;
    const kiriReaches* reaches = &shape->reaches;
    REQUIRE(sums != NULL, "no memory");
    REQUIRE_COUNT(reaches->ofFrame, sheet->frames.count);
    for (int32_t n = 0; n < 2 * sheet->frames.count; ++n) { /* first sums, then weights */
        int32_t i = n % sheet->frames.count;
        Reach reach = Reaches_First(reaches, i);
        for (; reach.cell != KIRI_NONE; reach = Reaches_After(reaches, reach)) {
            REQUIRE(IsIndex(reach.cell, sheet->grid.cells.count) && kiriGrid_IsCell(&sheet->grid, reach.cell),
                    "frame %d reaches cell %d", i, reach.cell);
            double raw = RawWeight(sheet, i, reach);
            if (n == i) {
                REQUIRE(seen[reach.cell] != i, "frame %d reaches cell %d twice", i, reach.cell);
                seen[reach.cell] = i;
                sums[reach.cell] += raw;
                continue;
            }
            kiriSpan span = shape->spans.data[reach.cell];
            int32_t k = span.first;
            while (k < span.first + span.count && shape->weights.data[k].frame != i) {
                ++k;
            }
            double is = k < span.first + span.count ? kiriCellWeight_Value(&shape->weights.data[k]) : 0.0;
            REQUIRE(raw / sums[reach.cell] == is, "cell %d is %d from frame %d and %d from its border, its weight is %.17g", reach.cell,
                    reach.fromSite, i, reach.fromBorder, is);
            found += raw > 0.0;
        }
    }
    for (int32_t c = 0; c < shape->spans.count; ++c) {
        all += shape->spans.data[c].count;
    }
    REQUIRE(found == all, "distances give %ld weights, cells have %ld", (long)found, (long)all);
    return true;
}

static bool Check_Rigid(Check* check, const kiriSheetData* sheet)
{
    const kiriShape* shape = &sheet->shape;
    double square = sheet->grid.side * sheet->grid.side;
    int64_t* sums = kiriMemory_AllocZeroed(&check->memory, (int64_t)sizeof(int64_t) * (sheet->frames.count + 1));
    REQUIRE(sums != NULL, "no memory");
    REQUIRE_COUNT(shape->rigid, sheet->frames.count);
    for (int32_t c = 0; c < shape->spans.count; ++c) {
        kiriSpan span = shape->spans.data[c];
        int64_t share = (int64_t)(kiriGrid_Area(&sheet->grid, c) / square * 1099511627776.0 + 0.5);
        for (int32_t k = span.first; k < span.first + span.count; ++k) {
            sums[shape->weights.data[k].frame] +=
                kiriCellWeight_Value(&shape->weights.data[k]) > shape->rigidWeight ? share : 0;
        }
    }
    for (int32_t i = 0; i < sheet->frames.count; ++i) {
        REQUIRE(sums[i] == shape->rigid.data[i], "frame %d moves %ld rigidly, its cells %ld", i,
                (long)shape->rigid.data[i], (long)sums[i]);
    }
    return true;
}

bool Check_Shape(Check* check, const kiriSheetData* sheet)
{
    check->part = "shape functions";
    return Check_CellWeights(check, sheet) && Check_Reaches(check, sheet) && Check_Rigid(check, sheet);
}
