#include "validate.h"

#include "validate_check.h"
#include "world/kiri_blade.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- A check ---- */

bool Check_Fail(Check* check, const char* condition, const char* format, ...)
{
    va_list list;
    int used = snprintf(check->line, LINE_BYTES, "sheet %d, %s: ", check->sheet, check->part);
    va_start(list, format);
    used += vsnprintf(check->line + used, (size_t)(LINE_BYTES - used), format, list);
    va_end(list);
    if (used < LINE_BYTES) {
        snprintf(check->line + used, (size_t)(LINE_BYTES - used), " [%s]", condition);
    }
    return false;
}

static void* Check_Alloc(Check* check, int64_t bytes, int byte)
{
    void* pointer = kiriMemory_Alloc(&check->memory, bytes + 8);
    if (pointer == NULL) {
        abort();
    }
    return memset(pointer, byte, (size_t)bytes + 8);
}

int32_t* Check_Ints(Check* check, int64_t count, int32_t value)
{
    return Check_Alloc(check, count * (int64_t)sizeof(int32_t), value == KIRI_NONE ? 0xff : 0);
}

uint8_t* Check_Bytes(Check* check, int64_t count)
{
    return Check_Alloc(check, count, 0);
}

int32_t* Check_Unions(Check* check, int32_t count)
{
    int32_t* parent = Check_Ints(check, count, 0);
    for (int32_t i = 0; i < count; ++i) {
        parent[i] = i;
    }
    return parent;
}

/* ---- Memory ---- */

/* The blocks of an owner are a list that holds together. */
static bool Check_Blocks(Check* check, const kiriMemory* memory, const char* name)
{
    check->part = "memory";
    for (const kiriBlock* block = memory->blocks; block != NULL; block = block->next) {
        REQUIRE(*block->link == block, "a block of %s is in another list", name);
    }
    return true;
}

/* ---- Frames ---- */

static bool Check_Frame(Check* check, const kiriSheetData* sheet, int32_t i)
{
    const kiriFrameData* f = &sheet->frames.data[i];
    double density = (double)sheet->settings.material.density * sheet->settings.material.thickness;
    REQUIRE(AreFinite3(f->x) && AreFinite3(f->velocity) && AreFinite3(f->spin), "frame %d is not finite", i);
    REQUIRE(AreFinite3(f->A.u) && AreFinite3(f->A.v) && AreFinite3(f->A.d), "frame %d has no axes", i);
    REQUIRE(AreFinite3(f->rate.u) && AreFinite3(f->rate.v) && AreFinite3(f->rate.d), "frame %d has no rate", i);
    REQUIRE(AreFinite3(f->history.gain) && AreFinite3(f->history.lag) && AreFinite3(f->history.pull) &&
                AreFinite3(f->history.turnGain.u) && AreFinite3(f->history.turnLag.u) &&
                AreFinite3(f->history.turnPull.u) && f->history.dt >= 0.0,
            "frame %d has no history", i);
    REQUIRE(AreFinite3(f->force) && AreFinite3(f->torque), "frame %d has no force", i);
    REQUIRE(f->area > 0.0 && IsNear(f->mass, density * f->area, 1e-9 * f->mass), "frame %d has area %g and mass %g", i,
            f->area, f->mass);
    double noise = 1e-14 * f->mass * kiriSheet_Extent(sheet) * kiriSheet_Extent(sheet); /* of a sliver */
    REQUIRE(f->inertia[0] >= -noise && f->inertia[2] >= -noise &&
                f->inertia[1] * f->inertia[1] <=
                    (f->inertia[0] + 2.0 * noise) * (f->inertia[2] + 2.0 * noise) * (1.0 + 1e-6),
            "frame %d has inertia %g, %g, %g", i, f->inertia[0], f->inertia[1], f->inertia[2]);
    if (sheet->settings.mechanics.model == KIRI_MODEL_LINKS) {
        kiriVec3 d = kiriVec3_Cross(f->A.u, f->A.v);
        REQUIRE(IsNear(kiriVec3_Length(f->A.u), 1.0, 1e-9) && IsNear(kiriVec3_Length(f->A.v), 1.0, 1e-9) &&
                    IsNear(kiriVec3_Dot(f->A.u, f->A.v), 0.0, 1e-9) && kiriVec3_Length(kiriVec3_Sub(d, f->A.d)) <= 1e-9,
                "frame %d is not a rotation", i);
    }
    return true;
}

static bool Check_Frames(Check* check, const kiriSheetData* sheet)
{
    double mass = 0.0, area = kiriMesh_Area(&sheet->mesh), side = sheet->grid.side;
    double density = (double)sheet->settings.material.density * sheet->settings.material.thickness;
    double whole = density * area, specks = density * 1e-14 * side * side * sheet->grid.cells.count;
    double outline = 0.0;
    check->part = "frames";
    REQUIRE(sheet->frames.count > 0, "none");
    for (int32_t h = 0; h < 3 * sheet->mesh.triangles.count; ++h) {
        double square = (double)kiriDistanceSquared(kiriMesh_TailAt(&sheet->mesh, h), kiriMesh_HeadAt(&sheet->mesh, h));
        outline += kiriMesh_Twin(&sheet->mesh, h) == KIRI_NONE ? sqrt(square) : 0.0;
    }
    /* Until a cut takes effect, frames keep their masses from before it. A vertex that it has put on a slanted outline is at
       most 24 steps of the lattice beside it (as in Check_Births): the area changes by half of that times the edge. */
    double moved = 12.0 * density * outline * sheet->mesh.step * sheet->mesh.step;
    for (int32_t i = 0; i < sheet->frames.count; ++i) {
        if (!Check_Frame(check, sheet, i)) {
            return false;
        }
        mass += sheet->frames.data[i].mass;
    }
    REQUIRE(IsNear(mass, whole, 1e-9 * whole + specks + moved), "frames weigh %.12g, the sheet %.12g", mass, whole);
    return true;
}

/* ---- Layout ---- */

static bool Check_Links(Check* check, const kiriSheetData* sheet)
{
    check->part = "links";
    for (int32_t k = 0; k < sheet->links.links.count; ++k) {
        const kiriLink* link = &sheet->links.links.data[k];
        const kiriLink* last = k > 0 ? link - 1 : NULL;
        REQUIRE(link->i >= 0 && link->i < link->j && link->j < sheet->frames.count, "link %d joins frames %d and %d", k,
                link->i, link->j);
        REQUIRE(last == NULL || !kiriLink_IsBefore(link, last),
                "link %d of frames %d and %d comes too late", k, link->i, link->j);
        REQUIRE(link->width > 0.0 && link->length > 0.0 && link->moment >= 0.0 && IsFinite(link->width) &&
                    IsFinite(link->length) && IsFinite(link->moment),
                "link %d has width %g, length %g, moment %g", k, link->width, link->length, link->moment);
        REQUIRE(link->fold >= 0 && link->fold <= sheet->mesh.folds.count, "link %d has fold %d", k, link->fold);
        REQUIRE(link->outer >= 0.0 && link->outer <= link->width && link->beyond >= 0.0,
                "link %d of width %g has outer width %g and %g beyond", k, link->width, link->outer, link->beyond);
        REQUIRE(link->square >= 0.0 && link->square <= link->width - link->outer, "link %d of width %g has %g square", k,
                link->width, link->square);
        REQUIRE(IsNear(kiriVec2_Length(link->normal), 1.0, 1e-9) && IsNear(link->tangent.x, -link->normal.y, 1e-12) &&
                    IsNear(link->tangent.y, link->normal.x, 1e-12),
                "link %d has normal (%g, %g)", k, link->normal.x, link->normal.y);
        kiriVec2 span = kiriVec2_Sub(sheet->frames.data[link->j].site.at, sheet->frames.data[link->i].site.at);
        double along = fabs(kiriVec2_Dot(span, link->normal));
        REQUIRE(link->length >= along * (1.0 - 1e-12), "link %d is %g long, its sites are %g apart along it", k,
                link->length, along);
    }
    int32_t offsets = sheet->strainOffsets.strainOffsets.count;
    REQUIRE(offsets == 0 || offsets == sheet->links.links.count, "%d strain offsets, %d links", offsets,
            sheet->links.links.count);
    return true;
}

/* The weights of a corner give the trace of what its links see: the sum of weight_k s_k^T is the unit matrix. */
static bool Check_Corners(Check* check, const kiriSheetData* sheet)
{
    check->part = "corners";
    for (int32_t k = 0; k < sheet->links.corners.count; ++k) {
        const kiriCorner* corner = &sheet->links.corners.data[k];
        double a[4] = { 0.0, 0.0, 0.0, 0.0 };
        REQUIRE(corner->count == 3 || corner->count == 4, "corner %d has %d links", k, corner->count);
        REQUIRE(corner->area > 0.0 && IsFinite(corner->area), "corner %d has area %g", k, corner->area);
        for (int32_t c = 0; c < corner->count; ++c) {
            int32_t last = c > 0 ? corner->link[c - 1] : KIRI_NONE;
            REQUIRE(corner->link[c] > last && corner->link[c] < sheet->links.links.count, "corner %d has link %d", k,
                    corner->link[c]);
            kiriVec2 span = sheet->links.links.data[corner->link[c]].span, weight = corner->weight[c];
            a[0] += weight.x * span.x;
            a[1] += weight.x * span.y;
            a[2] += weight.y * span.x;
            a[3] += weight.y * span.y;
        }
        REQUIRE(IsNear(a[0], 1.0, 1e-9) && IsNear(a[1], 0.0, 1e-9) && IsNear(a[2], 0.0, 1e-9) &&
                    IsNear(a[3], 1.0, 1e-9),
                "weights of corner %d give (%g, %g, %g, %g)", k, a[0], a[1], a[2], a[3]);
    }
    return true;
}

/* Pieces are what links join, by their lowest frame. */
static bool Check_Pieces(Check* check, const kiriSheetData* sheet)
{
    const kiriLayout* layout = &sheet->layout;
    int32_t frames = sheet->frames.count, sets = frames, pieces = 0;
    int32_t* parent = Check_Unions(check, frames);
    check->part = "pieces";
    REQUIRE_COUNT(layout->framePiece, frames);
    for (int32_t k = 0; k < sheet->links.links.count; ++k) {
        sets = Union_Join(parent, sheet->links.links.data[k].i, sheet->links.links.data[k].j, sets);
    }
    REQUIRE_COUNT(layout->pieces, sets);
    double* area = Check_Alloc(check, (int64_t)sizeof(double) * sets, 0);
    for (int32_t i = 0; i < frames; ++i) {
        int32_t root = Union_Root(parent, i), piece = layout->framePiece.data[i];
        if (root == i) {
            REQUIRE(piece == pieces && layout->pieces.data[piece].frame == i, "frame %d is of piece %d, not %d", i,
                    piece, pieces);
            ++pieces;
        }
        REQUIRE(piece == layout->framePiece.data[root], "frame %d is of piece %d, %d of %d", i, piece, root,
                layout->framePiece.data[root]);
        area[piece] += sheet->frames.data[i].area;
    }
    for (int32_t p = 0; p < pieces; ++p) {
        REQUIRE(IsNear(area[p], layout->pieces.data[p].area, 1e-9 * area[p]), "piece %d has area %g, its frames %g", p,
                layout->pieces.data[p].area, area[p]);
    }
    return true;
}

/* Pieces of the mesh are those of the frames. */
static bool Check_PiecesOfMesh(Check* check, const kiriSheetData* sheet)
{
    const kiriMeshData* mesh = &sheet->mesh;
    int32_t pieces = mesh->triangles.count, *parent = Check_Unions(check, pieces);
    check->part = "pieces";
    for (int32_t h = 0; h < 3 * mesh->triangles.count; ++h) {
        int32_t twin = kiriMesh_Twin(mesh, h);
        if (twin != KIRI_NONE && (!kiriMesh_IsOpen(mesh, h) || kiriMesh_IsCrease(mesh, h))) {
            pieces = Union_Join(parent, h / 3, twin / 3, pieces);
        }
    }
    REQUIRE(pieces == sheet->layout.pieces.count, "the mesh has %d pieces, the layout %d", pieces,
            sheet->layout.pieces.count);
    for (int32_t t = 0; t < mesh->triangles.count; ++t) {
        REQUIRE(kiriPiece_OfTriangle(sheet, t) == kiriPiece_OfTriangle(sheet, Union_Root(parent, t)),
                "triangle %d is of another piece", t);
    }
    return true;
}

static bool Check_Patches(Check* check, const kiriSheetData* sheet)
{
    const kiriAreaElements* patches = &sheet->layout.areaElements;
    int32_t next = 0;
    check->part = "patches";
    for (int32_t k = 0; k < patches->elements.count; ++k) {
        const kiriAreaElement* patch = &patches->elements.data[k];
        REQUIRE(patch->first == next && patch->count >= 0, "patch %d has %d shares from %d, not %d", k, patch->count,
                patch->first, next);
        REQUIRE(patch->area > 0.0 && patch->firstRow >= 0 && patch->firstRow < patch->lastRow &&
                    patch->lastRow <= KIRI_AREA_STRAINS,
                "patch %d has area %g, strains %d to %d", k, patch->area, patch->firstRow, patch->lastRow);
        next += patch->count;
    }
    REQUIRE(next == patches->shares.count, "patches have %d shares of %d", next, patches->shares.count);
    for (int32_t k = 0; k < next; ++k) {
        REQUIRE(IsIndex(patches->shares.data[k].frame, sheet->frames.count), "share %d is of frame %d", k,
                patches->shares.data[k].frame);
    }
    return true;
}

/* Of pins along lines. */
static bool Check_PinShares(Check* check, const kiriSheetData* sheet)
{
    const kiriPinShares* shares = &sheet->layout.pinShares;
    for (int32_t k = 0; k < shares->count; ++k) {
        const kiriPinShare* pinned = &shares->data[k];
        const kiriLineShare* share = &pinned->share;
        REQUIRE(IsIndex(pinned->pin, sheet->pins.count) && (k == 0 || shares->data[k - 1].pin <= pinned->pin) &&
                    sheet->pins.data[pinned->pin].type != KIRI_PIN_POINT,
                "share %d is of pin %d", k, pinned->pin);
        REQUIRE(IsIndex(share->frame, sheet->frames.count), "share %d is of frame %d", k, share->frame);
        REQUIRE(share->length > 0.0 && share->length <= 2.0 + 1e-12 && share->load > 0.0 &&
                    share->load <= share->length + 1e-12 && share->ends[0] >= 0.0 && share->ends[1] <= 1.0 &&
                    share->ends[1] > share->ends[0],
                "share %d has length %g, load %g, from %g to %g", k, share->length, share->load, share->ends[0],
                share->ends[1]);
    }
    for (int32_t k = 0; k < sheet->layout.severed.count; ++k) {
        const kiriSeveredLink* severed = &sheet->layout.severed.data[k];
        REQUIRE(IsIndex(severed->pin, sheet->pins.count) && sheet->pins.data[severed->pin].type == KIRI_PIN_CLAMP &&
                    IsIndex(severed->link, sheet->links.links.count) && (severed->part > 0.0 || severed->held > 0.0),
                "pin %d severs %g and holds %g of link %d", severed->pin, severed->part, severed->held, severed->link);
    }
    REQUIRE(sheet->linkParts.count == (sheet->layout.severed.count > 0 ? sheet->links.links.count : 0),
            "parts of %d links of %d, %d severed", sheet->linkParts.count, sheet->links.links.count,
            sheet->layout.severed.count);
    REQUIRE(sheet->pinRows.capacity >= sheet->pins.count && sheet->clampRows.capacity >= shares->count,
            "room for %d pins of %d, %d clamps of %d", sheet->pinRows.capacity, sheet->pins.count,
            sheet->clampRows.capacity, shares->count);
    return true;
}

/* Of pins and collision points. What holds a point is the frame whose region it is in. */
static bool Check_Pins(Check* check, const kiriSheetData* sheet)
{
    check->part = "pins";
    REQUIRE_COUNT(sheet->layout.pinFrame, sheet->pins.count);
    for (int32_t i = 0; i < sheet->pins.count; ++i) {
        const kiriPinData* pin = &sheet->pins.data[i];
        int32_t frame = sheet->layout.pinFrame.data[i];
        REQUIRE(IsIndex(frame, sheet->frames.count), "pin %d holds frame %d", i, frame);
        REQUIRE(AreFinite3(pin->target) && (pin->stiffness > 0.0) == (pin->type == KIRI_PIN_POINT),
                "pin %d has stiffness %g", i, pin->stiffness);
        if (IsSettled(sheet) && pin->type == KIRI_PIN_POINT) {
            int32_t cell = kiriGrid_CellAround(&sheet->grid, pin->at);
            int32_t owner = cell == KIRI_NONE ? KIRI_NONE : sheet->regions.field.owner.data[cell];
            REQUIRE(frame == owner, "pin %d holds frame %d and is in the region of %d", i, frame, owner);
        }
    }
    return Check_PinShares(check, sheet);
}

static bool Check_TouchMemory(Check* check, const kiriSheetData* sheet, const kiriTouchMemory* memory)
{
    int32_t given = 0;
    for (int32_t k = 0; k < memory->touches.count; ++k) {
        int32_t point = memory->touches.data[k].point;
        given += memory->touches.data[k].key >> 60 == KIRI_TOUCH_HOST;
        REQUIRE(point == KIRI_NONE || IsIndex(point, sheet->points.count), "touch %d is of point %d", k, point);
    }
    for (int32_t k = 1; k < memory->forces.count; ++k) {
        REQUIRE(memory->forces.data[k - 1].key <= memory->forces.data[k].key, "force %d is out of order", k);
    }
    REQUIRE(memory->given == given, "%d contacts of the host are counted as %d", given, memory->given);
    REQUIRE(memory->forces.count <= memory->touches.count, "%d forces of %d touches", memory->forces.count,
            memory->touches.count);
    return true;
}

static bool Check_Contacts(Check* check, const kiriSheetData* sheet)
{
    const kiriTouches* touches = &sheet->touches;
    for (int32_t k = 0; k < sheet->contacts.count; ++k) {
        const kiriGivenContact* given = &sheet->contacts.data[k];
        REQUIRE(given->contact.point == -1 || IsIndex(given->contact.point, sheet->points.count),
                "contact %d is of point %d", k, given->contact.point);
        for (int n = 0; n < 3 && given->contact.point == -1; ++n) {
            REQUIRE(IsIndex(given->vertex[n], sheet->mesh.vertices.count), "contact %d has vertex %d", k,
                    given->vertex[n]);
        }
    }
    REQUIRE(touches->nextTold.capacity >= sheet->contacts.count && touches->found.capacity >= sheet->contacts.count,
            "room for %d contacts of %d", touches->found.capacity, sheet->contacts.count);
    return Check_TouchMemory(check, sheet, &touches->last) && Check_TouchMemory(check, sheet, &touches->slept);
}

static bool IsStill(const kiriFrameData* frame)
{
    return kiriVec3_Dot(frame->velocity, frame->velocity) == 0.0 && kiriVec3_Dot(frame->spin, frame->spin) == 0.0 &&
           frame->history.dt == 0.0;
}

static bool Check_Rest(Check* check, const kiriSheetData* sheet)
{
    bool any = false;
    for (int32_t p = 0; p < sheet->layout.pieces.count; ++p) {
        const kiriPiece* piece = &sheet->layout.pieces.data[p];
        any = any || kiriPiece_IsAwake(piece);
        REQUIRE(!piece->rest.isStirred && piece->rest.calm >= 0.0, "piece %d is stirred, or calm for %g s", p,
                piece->rest.calm);
    }
    REQUIRE(sheet->rest.asleep != any, "the sheet is said to sleep: %d", sheet->rest.asleep);
    for (int32_t f = 0; f < sheet->frames.count; ++f) {
        REQUIRE(!kiriSheet_PieceOf(sheet, f)->rest.asleep || IsStill(&sheet->frames.data[f]),
                "frame %d moves, and its piece sleeps", f);
    }
    return true;
}

static bool Check_Points(Check* check, const kiriSheetData* sheet)
{
    int32_t listed = 0;
    check->part = "collision points";
    REQUIRE_COUNT(sheet->pointPlaces.next, sheet->points.count);
    for (int32_t s = 0; s < sheet->pointPlaces.head.count; ++s) {
        for (int32_t i = sheet->pointPlaces.head.data[s]; i != KIRI_NONE; i = sheet->pointPlaces.next.data[i]) {
            REQUIRE(IsIndex(i, sheet->points.count) && listed < sheet->points.count, "square %d lists point %d", s, i);
            REQUIRE(kiriSquares_At(&sheet->mesh.squares, sheet->points.data[i].at) == s, "square %d lists point %d", s,
                    i);
            ++listed;
        }
    }
    REQUIRE(listed == sheet->points.count, "squares list %d points of %d", listed, sheet->points.count);
    for (int32_t i = 0; i < sheet->points.count; ++i) {
        const kiriSample* point = &sheet->points.data[i];
        REQUIRE(IsIndex(point->frame, sheet->frames.count), "point %d is of frame %d", i, point->frame);
        if (IsSettled(sheet)) {
            int32_t cell = kiriGrid_CellAround(&sheet->grid, point->at);
            REQUIRE(cell == point->cell, "point %d is in cell %d, not %d", i, cell, point->cell);
            REQUIRE(sheet->regions.field.owner.data[cell] == point->frame, "point %d is of frame %d, its cell of %d", i,
                    point->frame, sheet->regions.field.owner.data[cell]);
        }
    }
    check->part = "rest";
    if (!Check_Rest(check, sheet)) {
        return false;
    }
    check->part = "contacts";
    return Check_Contacts(check, sheet);
}

/* ---- Weights of samples ---- */

static bool Check_SampleWeights(Check* check, const kiriSheetData* sheet, const kiriSkin* skin, int32_t sample)
{
    kiriSpan span = skin->spans.data[sample];
    int32_t last = KIRI_NONE, piece = KIRI_NONE;
    double sum = 0.0;
    REQUIRE(span.count > 0, "sample %d has no weights", sample);
    for (int32_t k = span.first; k < span.first + span.count; ++k) {
        kiriSampleWeight weight = skin->weights.data[k];
        REQUIRE(weight.frame > last && weight.frame < sheet->frames.count,
                "sample %d: weight of frame %d after %d", sample, weight.frame, last);
        REQUIRE(weight.value > 0.0f, "sample %d: weight %g of frame %d", sample, weight.value, weight.frame);
        int32_t other = sheet->layout.framePiece.data[weight.frame];
        REQUIRE(piece == KIRI_NONE || other == piece, "sample %d is of pieces %d and %d", sample, piece, other);
        last = weight.frame;
        piece = other;
        sum += weight.value;
    }
    REQUIRE(sum == 1.0, "the weights of sample %d sum to %.17g", sample, sum);
    return true;
}

static bool Check_Skin(Check* check, const kiriSheetData* sheet, const kiriSkin* skin, int32_t count)
{
    Rooms rooms;
    REQUIRE_COUNT(skin->spans, count);
    REQUIRE(HasUpdate(sheet) || skin->staged.count == 0, "%d samples are staged", skin->staged.count);
    if (!Rooms_Start(check, &rooms, skin->weights.data, sizeof(kiriSampleWeight), skin->weights.count, &skin->room)) {
        return false;
    }
    for (int32_t i = 0; i < count; ++i) {
        if (!Rooms_Take(check, &rooms, skin->spans.data[i], i) || !Check_SampleWeights(check, sheet, skin, i)) {
            return false;
        }
    }
    for (int32_t k = 0; k < skin->staged.count; ++k) {
        if (!Rooms_Take(check, &rooms, skin->staged.data[k].span, skin->staged.data[k].sample)) {
            return false;
        }
    }
    return Rooms_End(check, &rooms);
}

static bool Check_Skins(Check* check, const kiriSheetData* sheet)
{
    check->part = "weights of vertices";
    if (!Check_Skin(check, sheet, &sheet->vertexSkin, sheet->mesh.vertices.count)) {
        return false;
    }
    check->part = "weights of collision points";
    return Check_Skin(check, sheet, &sheet->pointSkin, sheet->points.count);
}

/* Triangles that are newer than the last commit know which older ones they were split from. */
static bool Check_Parents(Check* check, const kiriSheetData* sheet)
{
    check->part = "mesh";
    for (int32_t t = UpdateOf(sheet)->refit.ownership.triangleCount; t < sheet->mesh.triangles.count; ++t) {
        int32_t parent = sheet->mesh.triangles.data[t].parent;
        REQUIRE(IsIndex(parent, t), "triangle %d is split from %d", t, parent);
    }
    return true;
}

/* ---- What is seen ---- */

static bool Check_IsVertexGone(const kiriSheetData* sheet, int32_t vertex)
{
    int32_t piece = kiriPiece_OfVertex(sheet, vertex);
    return piece == KIRI_NONE || sheet->layout.pieces.data[piece].isGone;
}

static bool Check_Topology(Check* check, const kiriSheetData* sheet)
{
    const kiriSurface* surface = &sheet->seen.surface;
    const kiriMeshData* mesh = &sheet->mesh;
    REQUIRE(surface->vertexCount == mesh->vertices.count && surface->triangleCount == mesh->triangles.count,
            "%d vertices of %d, %d triangles of %d", surface->vertexCount, mesh->vertices.count, surface->triangleCount,
            mesh->triangles.count);
    REQUIRE(surface->revision == mesh->revision, "revision %u of %u", surface->revision, mesh->revision);
    for (int32_t t = 0; t < mesh->triangles.count; ++t) {
        const int32_t *is = mesh->triangles.data[t].vertex, unseen[3] = { is[0], is[0], is[0] };
        REQUIRE(memcmp(&surface->indices.data[3 * (size_t)t], Check_IsVertexGone(sheet, is[0]) ? unseen : is,
                       3 * sizeof(int32_t)) == 0,
                "triangle %d has other corners", t);
    }
    for (int32_t v = 0; v < mesh->vertices.count; ++v) {
        kiriVec2 rest = kiriMesh_Local(mesh, mesh->vertices.data[v].at);
        REQUIRE(surface->rest.data[v].x == rest.x && surface->rest.data[v].y == rest.y, "vertex %d rests elsewhere", v);
        float share[3];
        kiriMesh_GetShare(mesh, v, share);
        REQUIRE(surface->sourceTriangles.data[v] == mesh->vertices.data[v].source &&
                    memcmp(&surface->sourceWeights.data[3 * (size_t)v], share, sizeof(share)) == 0,
                "vertex %d has another source", v);
    }
    return true;
}

static bool Check_Surface(Check* check, const kiriSheetData* sheet)
{
    const kiriSurface* surface = &sheet->seen.surface;
    check->part = "surface";
    if (!Check_Topology(check, sheet)) {
        return false;
    }
    for (int32_t v = 0; v < surface->vertexCount; ++v) {
        kiriVec3 normal = kiriVec3_Load(&surface->normals.data[3 * (size_t)v]);
        kiriVec3 position = kiriVec3_Load(&surface->positions.data[3 * (size_t)v]);
        REQUIRE(isfinite(position.x) && isfinite(position.y) && isfinite(position.z), "vertex %d is at %g %g %g", v,
                position.x, position.y, position.z);
        REQUIRE(!surface->hasNormals || Check_IsVertexGone(sheet, v) || IsNear(kiriVec3_Length(normal), 1.0, 1e-5),
                "vertex %d has normal %g %g %g", v, normal.x, normal.y, normal.z);
    }
    for (int32_t i = 0; i < sheet->points.count; ++i) {
        REQUIRE(AreFinite3(kiriVec3_Load(&sheet->seen.pointPositions.data[3 * i])), "point %d is nowhere", i);
    }
    REQUIRE(sheet->seen.pointCount == sheet->points.count, "%d points are seen, of %d", sheet->seen.pointCount,
            sheet->points.count);
    return true;
}

static bool Check_Fades(Check* check, const kiriFades* fades, int32_t sampleCount)
{
    check->part = "fades";
    for (int32_t k = 0; k < fades->fading.count; ++k) {
        const kiriFading* fading = &fades->fading.data[k];
        REQUIRE(IsIndex(fading->sample, sampleCount) && (k == 0 || fading[-1].sample < fading->sample),
                "sample %d of %d fades", fading->sample, sampleCount);
        /* It may be longer than fades->time: what has begun goes on when the time is changed. */
        REQUIRE(AreFinite3(fading->offset) && fading->left > 0.0 && isfinite(fading->left), "sample %d fades for %g s",
                fading->sample, fading->left);
    }
    return true;
}

/* ---- Queue and cuts ---- */

static bool Check_Blade(Check* check, const kiriSheetData* sheet, const kiriBladeTip* blade)
{
    if (blade->vertex != KIRI_NONE) {
        REQUIRE(IsIndex(blade->vertex, sheet->mesh.vertices.count), "a blade is at vertex %d", blade->vertex);
        kiriLatticePoint at = sheet->mesh.vertices.data[blade->vertex].at;
        REQUIRE(at.x == blade->at.x && at.y == blade->at.y, "a blade is not at its vertex %d", blade->vertex);
    }
    return true;
}

static bool Check_Queue(Check* check, const kiriSheetData* sheet)
{
    const kiriUpdate* u = UpdateOf(sheet);
    check->part = "queue";
    REQUIRE(!HasUpdate(sheet) ||
                (u->cut.taken >= 0 && u->cut.taken <= u->cut.count && u->cut.count <= sheet->queue.count),
            "%d points taken of %d, %d wait", u->cut.taken, u->cut.count, sheet->queue.count);
    for (int32_t i = 0; i < sheet->queue.count; ++i) {
        const kiriQueuedPoint* point = &sheet->queue.data[i];
        bool isKnown = false;
        for (int32_t k = 0; k < sheet->cuts.count; ++k) {
            isKnown = isKnown || sheet->cuts.data[k] == point->cut;
        }
        REQUIRE(isKnown, "point %d is of a cut that is no more", i);
        REQUIRE(i == 0 || point[-1].stamp <= point->stamp, "point %d was given before the one before it", i);
        REQUIRE(IsFinite(point->to.x) && IsFinite(point->to.y), "point %d is nowhere", i);
        REQUIRE(!HasUpdate(sheet) || point->stamp >= u->cut.stamp, "point %d was given before the update", i);
        REQUIRE(!point->ends || point->cut->ended, "point %d ends a cut that goes on", i);
    }
    for (int32_t k = 0; k < sheet->cuts.count; ++k) {
        const kiriCutData* cut = sheet->cuts.data[k];
        int32_t waiting = 0;
        for (int32_t i = 0; i < sheet->queue.count; ++i) {
            waiting += sheet->queue.data[i].cut == cut;
        }
        REQUIRE(cut->sheet == sheet && cut->index == k, "cut %d is of another sheet, or number %d", k, cut->index);
        REQUIRE(waiting == cut->waiting, "%d points of cut %d wait, counted %d", waiting, k, cut->waiting);
        if (!Check_Blade(check, sheet, &cut->tip.blade)) {
            return false;
        }
    }
    return true;
}

/* ---- Ids ---- */

/* Ids of a kind: each finds its owner and index, and there are no others. */
static bool Check_Id(Check* check, const kiriPool* pool, uint32_t id, const void* owner, int32_t index)
{
    const kiriSlot* slot = kiriPool_Find(pool, id);
    REQUIRE(slot != NULL && slot->owner == owner && slot->index == index, "id %u of kind %u finds %s, index %d of %d",
            id, pool->kind, slot == NULL ? "nothing" : "something", slot == NULL ? KIRI_NONE : slot->index, index);
    return true;
}

static bool Check_Pool(Check* check, const kiriPool* pool, int32_t things)
{
    int32_t live = 0, unused = 0;
    for (int32_t k = 0; k < pool->slots.count; ++k) {
        live += pool->slots.data[k].owner != NULL;
    }
    REQUIRE(live == things, "%d ids of kind %u, %d things", live, pool->kind, things);
    for (int32_t slot = pool->freeSlot; slot != KIRI_NONE; slot = pool->slots.data[slot].index) {
        REQUIRE(IsIndex(slot, pool->slots.count) && unused < pool->slots.count && pool->slots.data[slot].owner == NULL,
                "slot %d of kind %u is free", slot, pool->kind);
        ++unused;
    }
    return true;
}

static bool Check_Ids(Check* check, const kiriWorld* world)
{
    int32_t frames = 0, pins = 0, cuts = 0;
    check->part = "ids";
    for (int32_t s = 0; s < world->sheets.count; ++s) {
        const kiriSheetData* sheet = world->sheets.data[s];
        bool ok = Check_Id(check, &world->sheetIds, sheet->id, sheet, 0);
        for (int32_t i = 0; ok && i < sheet->frames.count; ++i) {
            bool isGone = kiriSheet_IsGone(sheet, i); /* until the work at hand is done */
            ok = isGone ? sheet->frames.data[i].id == 0
                        : Check_Id(check, &world->frameIds, sheet->frames.data[i].id, sheet, i);
            frames += !isGone;
        }
        for (int32_t i = 0; ok && i < sheet->pins.count; ++i) {
            ok = Check_Id(check, &world->pinIds, sheet->pins.data[i].id, sheet, i);
        }
        for (int32_t i = 0; ok && i < sheet->cuts.count; ++i) {
            ok = Check_Id(check, &world->cutIds, sheet->cuts.data[i]->id, sheet->cuts.data[i], 0);
        }
        if (!ok) {
            return false;
        }
        pins += sheet->pins.count;
        cuts += sheet->cuts.count;
    }
    for (int32_t i = 0; i < world->blades.count; ++i) {
        if (!Check_Id(check, &world->bladeIds, world->blades.data[i]->id, world->blades.data[i], 0)) {
            return false;
        }
    }
    for (int32_t i = 0; i < world->seams.count; ++i) {
        const kiriSeamData* seam = world->seams.data[i];
        bool ok = Check_Id(check, &world->seamIds, seam->id, seam, 0);
        for (int32_t k = 0; ok && k < 2 * seam->stitches.count; ++k) {
            const kiriStitchData* stitch = &seam->stitches.data[k / 2];
            const kiriSlot* slot = kiriPool_Find(&world->frameIds, stitch->frames[k % 2]);
            const kiriSheetData* sheet = slot != NULL ? slot->owner : NULL;
            ok = sheet != NULL && kiriMesh_Locate(&sheet->mesh, stitch->at[k % 2]) != KIRI_NONE;
            REQUIRE(ok, "end %d of stitch %d of seam %u has no material", k % 2, k / 2, seam->id);
        }
        if (!ok) {
            return false;
        }
    }
    return Check_Pool(check, &world->seamIds, world->seams.count) && Check_Pool(check, &world->sheetIds, world->sheets.count) && Check_Pool(check, &world->frameIds, frames) &&
           Check_Pool(check, &world->bladeIds, world->blades.count) && Check_Pool(check, &world->pinIds, pins) &&
           Check_Pool(check, &world->cutIds, cuts);
}

/* ---- All of it ---- */

static bool Check_Derived(Check* check, const kiriSheetData* sheet)
{
    return Check_Grid(check, sheet) && Check_Regions(check, sheet) && Check_Shape(check, sheet) &&
           Check_PiecesOfMesh(check, sheet);
}

/* In an order in which nothing is read that was not checked before. */
static bool Check_Sheet(Check* check, const kiriSheetData* sheet)
{
    return Check_Blocks(check, &sheet->own, "the sheet") && Check_Blocks(check, &sheet->shown, "the host's arrays") &&
           Check_Mesh(check, &sheet->mesh, false) && Check_Parents(check, sheet) && Check_Frames(check, sheet) &&
           Check_Links(check, sheet) && Check_Corners(check, sheet) && Check_Pieces(check, sheet) &&
           Check_Patches(check, sheet) && Check_Skins(check, sheet) &&
           (!IsSettled(sheet) || Check_Derived(check, sheet)) && Check_Pins(check, sheet) &&
           Check_Points(check, sheet) && Check_Surface(check, sheet) &&
           Check_Fades(check, &sheet->seen.fades, sheet->mesh.vertices.count) && Check_Seen(check, sheet) &&
           Check_Fades(check, &sheet->seen.pointFades, sheet->points.count) && Check_Queue(check, sheet);
}

const char* Validate_World(const kiriWorld* world)
{
    static char line[LINE_BYTES];
    Check check = { kiriMemory_Make(NULL, NULL, NULL), KIRI_NONE, "", line };
    bool ok = Check_Blocks(&check, &world->memory, "the world") &&
              Check_Blocks(&check, &world->retired, "what is retired") && Check_Ids(&check, world);
    for (int32_t s = 0; ok && s < world->sheets.count; ++s) {
        check.sheet = s;
        ok = Check_Sheet(&check, world->sheets.data[s]);
        kiriMemory_FreeAll(&check.memory);
    }
    kiriMemory_FreeAll(&check.memory);
    return ok ? NULL : line;
}

const char* Validate_Mesh(const kiriMeshData* mesh, bool isConforming)
{
    static char line[LINE_BYTES];
    Check check = { kiriMemory_Make(NULL, NULL, NULL), KIRI_NONE, "", line };
    bool ok = Check_Mesh(&check, mesh, isConforming);
    kiriMemory_FreeAll(&check.memory);
    return ok ? NULL : line;
}
