/* The checks of validate.h see what they are for: a sound world, made wrong in memory in one way at a time. */
#include "field/kiri_grid.h"
#include "host.h"
#include "sheet/kiri_piece.h"
#include "sheet/kiri_update.h"
#include "world/kiri_world.h"
#include "reaches.h"

#include <math.h>

/* Makes the world wrong in the way of this number, and returns words of the line that it expects; null: no such way. */
typedef const char* CorruptFn(kiriWorld* world, kiriSheetData* s, int way);

/* The next way: the words, and what makes the world wrong. */
#define WAY(words, ...)                                                                                                \
    if (way-- == 0) {                                                                                                  \
        __VA_ARGS__;                                                                                                   \
        return words;                                                                                                  \
    }

/* Two pieces, of which one came off inside the other; a pin, contacts, a blade that is still in the sheet, and a point
   that waits. `frames` 0: the four of the small sheet. */
static kiriSheetData* Start(Host* host, int32_t model, int32_t frames)
{
    enum { COUNT = 25 };
    float circle[2 * COUNT];
    const float slit[4] = { 0.1f, 0.1f, 0.9f, 0.17f }, next[2] = { 0.95f, 0.3f };
    Host_Start(host);
    kiriSheetDef def = Host_SmallDef();
    def.model = model;
    def.frameCount = frames > 0 ? frames : def.frameCount;
    def.framePoints = frames > 0 ? NULL : def.framePoints;
    kiriSheet sheet = Host_AddRectangle(host, &def, 1.0f, 1.0f, 7, 7);
    kiriPinDef pinDef = DefaultPin();
    pinDef.restPoint[0] = pinDef.restPoint[1] = 0.93f;
    World_AddPin(host->world, sheet, &pinDef);
    for (int i = 0; i < COUNT; ++i) {
        circle[2 * i] = 0.5f + 0.2f * (float)cos(i % (COUNT - 1) * 0.2617993878);
        circle[2 * i + 1] = 0.5f + 0.2f * (float)sin(i % (COUNT - 1) * 0.2617993878);
    }
    Host_Cut(host, sheet, circle, COUNT);
    OK(Host_Tick(host, 0.01f, 1));
    kiriCut cut = World_BeginCut(host->world, sheet, slit);
    OK(kiriCut_Extend(host->world, cut, slit + 2, 1));
    OK(Host_Tick(host, 0.01f, 1));
    OK(kiriCut_Extend(host->world, cut, next, 1));
    const kiriContact contact = { .point = 0, .normal = { 0.0f, 0.0f, 1.0f }, .offset = -1.0f, .friction = 0.0f };
    OK(kiriSheet_SetContacts(host->world, sheet, &contact, 1));
    assert_int_equal(Host_Counts(host, sheet).pieces, 2);
    return host->world->sheets.data[0];
}

static void CheckWays(CorruptFn* corrupt, int32_t model, int32_t frames)
{
    const char* words = "";
    for (int way = 0; words != NULL; ++way) {
        Host host;
        kiriSheetData* sheet = Start(&host, model, frames);
        assert_null(Validate_World(host.world));
        words = corrupt(host.world, sheet, way);
        const char* line = Validate_World(host.world);
        if (words == NULL) {
            assert_null(line);
        } else if (line == NULL || strstr(line, words) == NULL) {
            fail_msg("way %d: \"%s\" expected, and it says \"%s\"", way, words, line == NULL ? "nothing" : line);
        }
        Host_Destroy(&host);
    }
}

/* ---- Mesh ---- */

/* A half-edge inside the sheet that is open, or not. */
static int32_t InnerEdge(const kiriMeshData* mesh, bool isOpen)
{
    int32_t h = 0;
    while (kiriMesh_Twin(mesh, h) == KIRI_NONE || kiriMesh_IsOpen(mesh, h) != isOpen) {
        ++h;
    }
    return h;
}

static int32_t OutlineEdge(const kiriMeshData* mesh)
{
    int32_t h = 0;
    while (kiriMesh_Twin(mesh, h) != KIRI_NONE) {
        ++h;
    }
    return h;
}

static void Toggle(kiriMeshData* mesh, int32_t h)
{
    mesh->triangles.data[h / 3].marks ^= 1 << h % 3;
}

static const char* CorruptMesh(kiriWorld* world, kiriSheetData* s, int way)
{
    kiriMeshData* mesh = &s->mesh;
    kiriTriangle* triangles = mesh->triangles.data;
    int32_t h = InnerEdge(mesh, false), open = InnerEdge(mesh, true);
    WAY("mesh: triangle", triangles[h / 3].vertex[h % 3] = mesh->vertices.count)
    WAY("turned over", mesh->vertices.data[triangles[0].vertex[0]].at = mesh->vertices.data[triangles[0].vertex[1]].at)
    WAY("which has", triangles[h / 3].twin[h % 3] = kiriEdge_Next(kiriMesh_Twin(mesh, h)))
    WAY("only one of twins", Toggle(mesh, open))
    WAY("outline is marked open", Toggle(mesh, OutlineEdge(mesh)))
    WAY("fans,",
        Toggle(mesh, open);
        Toggle(mesh, kiriMesh_Twin(mesh, open)))
    WAY("is in two fans",
        Toggle(mesh, h);
        Toggle(mesh, kiriMesh_Twin(mesh, h)))
    WAY("has half-edge", mesh->vertices.data[0].edge = mesh->vertices.data[1].edge)
    WAY("is of source", triangles[0].source = -1)
    WAY("from elsewhere", mesh->vertices.data[3].source += mesh->vertices.data[3].source > 0 ? -1 : 40)
    WAY("vertex 3 has another source", s->seen.surface.sourceWeights.data[9] += 0.01f)
    WAY("births", mesh->oldVertexCount -= 1)
    WAY("is split from",
        triangles[mesh->triangles.count - 1].parent = mesh->triangles.count;
        s->update->refit.ownership.triangleCount = mesh->triangles.count - 1)
    return NULL;
}

static const char* CorruptSquares(kiriWorld* world, kiriSheetData* s, int way)
{
    kiriSquares* squares = &s->mesh.squares;
    int32_t node = squares->head[0], last = squares->columns * squares->rows - 1;
    WAY("squares list", squares->head[0] = squares->nodes.data[node].next)
    WAY("twice", squares->nodes.data[node].triangle = squares->nodes.data[squares->nodes.data[node].next].triangle)
    WAY("which is elsewhere", squares->nodes.data[node].triangle = squares->nodes.data[squares->head[last]].triangle)
    WAY("nodes are used",
        assert_true(squares->nodes.capacity > squares->nodes.count);
        squares->nodes.data[squares->nodes.count++] = (kiriSquareNode){ KIRI_NONE, KIRI_NONE })
    WAY("has a triangle", squares->freeNode = node)
    WAY("lists vertex", squares->vertexHead[last] = squares->vertexHead[0])
    WAY("vertices of", squares->vertexHead[last] = KIRI_NONE)
    WAY("are marked", squares->isDirty[3] = 1)
    WAY("is not marked", squares->dirty.data[squares->dirty.count++] = 3)
    return NULL;
}

/* Edges that lie on each other and are not twins are as in a mesh that does not conform. */
TEST(SeesThatTwinsAreMissing)
{
    Host host;
    kiriMeshData* mesh = &Start(&host, KIRI_MODEL_LINKS, 0)->mesh;
    int32_t h = InnerEdge(mesh, true), twin = kiriMesh_Twin(mesh, h);
    assert_null(Validate_Mesh(mesh, true));
    Toggle(mesh, h);
    Toggle(mesh, twin);
    mesh->triangles.data[h / 3].twin[h % 3] = mesh->triangles.data[twin / 3].twin[twin % 3] = KIRI_NONE;
    assert_null(Validate_Mesh(mesh, false));
    assert_non_null(strstr(Validate_Mesh(mesh, true), "are not twins"));
    Host_Destroy(&host);
}

/* ---- Grid ---- */

/* A cell of a square that has two. */
static int32_t DividedCell(const kiriGrid* grid)
{
    int32_t s = 0;
    while (grid->squareCell.data[s] == KIRI_NONE || grid->cells.data[grid->squareCell.data[s]].next == KIRI_NONE) {
        ++s;
    }
    return grid->squareCell.data[s];
}

static const char* CorruptCells(kiriWorld* world, kiriSheetData* s, int way)
{
    kiriGrid* grid = &s->grid;
    int32_t c = DividedCell(grid), other = grid->cells.data[c].next, square = grid->cells.data[c].square;
    int32_t node = s->mesh.squares.head[square];
    WAY("grid: ", grid->nodeCell.data[node] = grid->nodeCell.data[node] == c ? other : c)
    WAY("is of cell", grid->nodeCell.data[node] = grid->squareCell.data[square > 0 ? 0 : 1])
    WAY("grid: cell", grid->cells.data[other].triangle += 1)
    WAY("the mesh", kiriGrid_OwnMaterial(grid, c)->area *= 1.0 + 1e-4)
    WAY("counted", grid->cells.data[c].next = KIRI_NONE)
    WAY("counted", grid->cellCount += 1)
    WAY("free cell", grid->freeCell = c)
    WAY("says it is of", grid->cells.data[c].square += 1)
    WAY("is whole", grid->whole.data[square] = 1)
    WAY("nodeCell", grid->nodeCell.count -= 1)
    return NULL;
}

static const char* CorruptFaces(kiriWorld* world, kiriSheetData* s, int way)
{
    kiriGrid* grid = &s->grid;
    kiriStep* steps = grid->steps.data;
    int32_t c = DividedCell(grid), f = grid->cells.data[c].firstFace;
    kiriStepRun* run = &grid->runs.data[c];
    WAY("wide", kiriGrid_OwnStretch(grid, f)->width = 0.0)
    WAY("on its side",
        kiriGrid_OwnStretch(grid, f)->middle.x += grid->side;
        kiriGrid_OwnStretch(grid, f)->middle.y += grid->side)
    WAY("between squares", grid->faces.data[f].kind ^= 1)
    WAY("cells list", grid->cells.data[c].firstFace = grid->faces.data[f].next[grid->faces.data[f].cell[1] == c])
    WAY("free face", grid->freeFace = f)
    WAY("no face between",
        kiriFace* face = &grid->faces.data[f]; /* as if it had never been made */
        for (int end = 0; end < 2; ++end) {
            int32_t* link = &grid->cells.data[face->cell[end]].firstFace;
            while (*link != f) {
                link = &grid->faces.data[*link].next[grid->faces.data[*link].cell[1] == face->cell[end]];
            }
            *link = face->next[end];
        }
        face->cell[0] = KIRI_NONE;
        face->next[0] = grid->freeFace;
        grid->freeFace = f)
    WAY("grid: the step", steps[run->first].length += 1)
    WAY("the step from cell", steps[run->first].cell = steps[run->first + 1].cell)
    WAY("squares [",
        steps[run->end[0] - 1].u = (int8_t)-steps[run->end[0] - 1].u;
        steps[run->end[0] - 1].v = (int8_t)-steps[run->end[0] - 1].v)
    WAY("has steps", run->end[1] = run->end[0] - 1)
    if (way-- == 0) {
        for (run = grid->runs.data; run->end[2] == run->end[1];) {
            ++run;
        }
        run->end[2] -= 1; /* a knight of it */
        return "no way back";
    }
    WAY("grid: ", run->first += 1)
    WAY("grid: ", grid->stepRoom.freeHead[4] = run->first + 1)
    WAY("is in no span", grid->steps.count += 1)
    if (way-- == 0) {
        run->first = KIRI_NONE; /* as if it were amid whole squares */
        return "has steps";
    }
    return NULL;
}

/* ---- Regions and shape functions ---- */

static const char* CorruptRegions(kiriWorld* world, kiriSheetData* s, int way)
{
    kiriRegions* r = &s->regions;
    int32_t c = 0, site = s->frames.data[0].site.cell;
    while (!r->onBorder.data[c] || r->siteAt.data[c] != KIRI_NONE) {
        ++c;
    }
    WAY("there is a way of", r->field.distance.data[c] -= 1)
    WAY("regions: cell", r->field.owner.data[c] = (r->field.owner.data[c] + 1) % s->frames.count)
    WAY("is owned by", r->field.owner.data[c] = KIRI_NONE)
    WAY("has its site", r->siteAt.data[site] = KIRI_NONE)
    WAY("cells have sites", r->siteAt.data[c] = 0)
    WAY("the border", r->onBorder.data[c] = 0)
    WAY("tally", r->material.data[1].of[4].low ^= 1)
    WAY("dirty", r->dirty.data[0] = 1)
    WAY("orphans", r->orphans.count = 1)
    WAY("middle of its region", s->frames.data[1].center.x += 1e-4)
    WAY("handed over", s->update->refit.ownership.squares.data[s->grid.cells.data[site].square].owner = 1)
    WAY("handed over",
        s->update->refit.ownership.triangleOwners
            .data[s->update->refit.ownership.squares.data[s->grid.cells.data[DividedCell(&s->grid)].square].parts.first]
            .owner ^= 1)
    return NULL;
}

/* How far a cell in the region of frame 0 is from its site. */
static int32_t* OwnReach(kiriSheetData* s)
{
    Reach reach = Reaches_First(&s->shape.reaches, 0);
    while (s->regions.field.owner.data[reach.cell] != 0 || reach.fromSite == 0) {
        reach = Reaches_After(&s->shape.reaches, reach);
    }
    return &s->shape.reaches.blocks.data[reach.block].fromSite[reach.cell % KIRI_BLOCK_CELLS];
}

/* The first block of frame 0. */
static bool AddBlockTwice(kiriSheetData* s)
{
    kiriReaches* reaches = &s->shape.reaches;
    int64_t room = (int64_t)reaches->blocks.count + 1 - reaches->freeBlocks;
    bool ok =
        kiriArray_Reserve(s->memory, &reaches->blocks, room) && kiriArray_Reserve(s->memory, &reaches->heads, room);
    if (ok) {
        const kiriReachBlock was = reaches->blocks.data[reaches->ofFrame.data[0]];
        kiriReachBlock* twin = &reaches->blocks.data[kiriReaches_Add(reaches, 0, was.cells)];
        memcpy(twin->fromSite, was.fromSite, sizeof(was.fromSite));
        memcpy(twin->fromBorder, was.fromBorder, sizeof(was.fromBorder));
    }
    return ok;
}

static const char* CorruptShape(kiriWorld* world, kiriSheetData* s, int way)
{
    kiriShape* shape = &s->shape;
    int32_t c = 0;
    while (shape->spans.data[c].count < 2) {
        ++c;
    }
    kiriCellWeight* weight = &shape->weights.data[shape->spans.data[c].first];
    WAY("shape functions: cell", *weight = kiriCellWeight_Make(weight->frame, 2.0))
    WAY("shape functions: cell", *weight = kiriCellWeight_Make(weight->frame, -kiriCellWeight_Value(weight)))
    WAY("after", weight[1].frame = weight[0].frame)
    WAY("is in two rooms", shape->spans.data[c] = shape->spans.data[c == 0 ? 1 : 0])
    WAY("shape functions: ", shape->spans.data[c].first = shape->weights.count - 1)
    WAY("its weight is", *weight = kiriCellWeight_Make(weight->frame, 0.999 * kiriCellWeight_Value(weight)))
    WAY("rigidly", shape->rigid.data[0] += 1)
    WAY("its weight is", *OwnReach(s) = KIRI_FAR)
    if (way-- == 0) {
        return AddBlockTwice(s) ? "twice" : NULL;
    }
    WAY("its weight is", *OwnReach(s) += 100)
    WAY("changed since", shape->changes.count = 1)
    return NULL;
}

/* ---- What is in force ---- */

static const char* CorruptFrames(kiriWorld* world, kiriSheetData* s, int way)
{
    kiriFrameData* f = &s->frames.data[1];
    WAY("is not finite", f->x.y = (double)NAN)
    WAY("is not finite", f->spin.z = (double)INFINITY)
    WAY("rotation", f->A.u = kiriVec3_Scale(1.0 + 1e-6, f->A.u))
    WAY("rotation", f->A.d = kiriVec3_Scale(-1.0, f->A.d))
    WAY("and mass", f->mass *= 1.01)
    WAY("the sheet",
        f->mass *= 1.01;
        f->area *= 1.01)
    WAY("inertia", f->inertia[1] = f->inertia[0] + f->inertia[2])
    return NULL;
}

static const char* CorruptLayout(kiriWorld* world, kiriSheetData* s, int way)
{
    kiriLayout* layout = &s->layout;
    kiriLink* links = s->links.links.data;
    int32_t last = s->frames.count - 1, inner = s->mesh.vertices.count; /* a vertex of the piece that came off */
    WAY("joins frames", links[0].j = links[0].i)
    WAY("comes too late", links[1] = links[s->links.links.count - 1])
    WAY("has width", links[0].width = 0.0)
    WAY("normal", links[0].normal.x += 1e-3)
    if (way-- == 0) {
        links[0].j = last;      /* joins the two pieces */
        return "links: link 1"; /* out of order, too */
    }
    WAY("pieces: ",
        s->links.links.count = s->links.corners.count = 0;
        s->strainOffsets.strainOffsets.count = 0)
    WAY("strain offsets", s->strainOffsets.strainOffsets.count = 1)
    WAY("pieces: frame", layout->framePiece.data[last] = 0)
    WAY("pieces: frame", layout->pieces.data[1].frame = 0)
    WAY("piece 1 has area", layout->pieces.data[1].area *= 1.1)
    WAY("in the region of", layout->pinFrame.data[0] = layout->pinFrame.data[0] == 0)
    WAY("pins: ", layout->pinFrame.count = 0)
    WAY("of another piece",
        while (kiriPiece_OfVertex(s, --inner) == 0) {
        }
        for (int32_t k = 0; k < s->vertexSkin.spans.data[inner].count; ++k) {
            assert_int_equal(s->layout.framePiece.data[k], 0);
            s->vertexSkin.weights.data[s->vertexSkin.spans.data[inner].first + k].frame = k;
        })
    WAY("has outer width", links[0].outer = -1e-9)
    WAY("square", links[0].square = 2.0 * links[0].width)
    WAY("its sites are", links[0].length *= 0.9)
    return NULL;
}

static const char* CorruptCorners(kiriWorld* world, kiriSheetData* s, int way)
{
    kiriCorner* corner = s->links.corners.data;
    assert_true(s->links.corners.count > 0);
    WAY("has 2 links", corner->count = 2)
    WAY("corners: corner 0 has link", corner->link[2] = s->links.links.count)
    WAY("weights of corner 0", corner->weight[1].x += 0.01)
    WAY("has area 0", corner->area = 0.0)
    return NULL;
}

static const char* CorruptPatches(kiriWorld* world, kiriSheetData* s, int way)
{
    kiriAreaElements* patches = &s->layout.areaElements;
    assert_true(patches->elements.count > 1);
    WAY("shares from", patches->elements.data[1].first += 1)
    WAY("has area", patches->elements.data[0].area = 0.0)
    WAY("shares of", patches->shares.count -= 1)
    WAY("is of frame", patches->shares.data[0].frame = s->frames.count)
    return NULL;
}

static const char* CorruptSamples(kiriWorld* world, kiriSheetData* s, int way)
{
    kiriSkin *skin = &s->vertexSkin, *points = &s->pointSkin;
    int32_t v = 0;
    while (skin->spans.data[v].count < 2) {
        ++v;
    }
    kiriSampleWeight* weight = &skin->weights.data[skin->spans.data[v].first];
    WAY("weights of vertices: the weights", weight->value += 1e-6)
    WAY("after", weight[1].frame = weight[0].frame)
    WAY("is of pieces", weight[skin->spans.data[v].count - 1].frame = s->frames.count - 1)
    WAY("outside an array", skin->spans.data[v].first = 0x7ffffff0)
    WAY("has no weights", skin->spans.data[v] = (kiriSpan){ 0, 0 })
    WAY("weights of vertices: ", skin->spans.data[v].count += 40)
    WAY("weights of collision points: ", points->spans.count -= 1)
    WAY("weights of collision points: sample 0", points->weights.data[points->spans.data[0].first].value = -1.0)
    WAY("its cell of", s->points.data[0].frame = (s->points.data[0].frame + 1) % s->frames.count)
    WAY("is in cell", s->points.data[0].cell += 1)
    WAY("points of", s->pointPlaces.head.data[kiriSquares_At(&s->mesh.squares, s->points.data[0].at)] = KIRI_NONE)
    WAY("contacts: ", s->contacts.data[0].contact.point = s->points.count)
    return NULL;
}

static const char* CorruptSurface(kiriWorld* world, kiriSheetData* s, int way)
{
    kiriSurface* surface = &s->seen.surface;
    WAY("vertices of", surface->vertexCount -= 1)
    WAY("other corners", surface->indices.data[4] = 0)
    WAY("rests elsewhere", surface->rest.data[2].x += 1e-9)
    WAY("has normal", surface->normals.data[3] = 2.0f)
    WAY("is at", surface->positions.data[7] = NAN)
    WAY("revision", surface->revision += 1)
    WAY("another source", surface->sourceWeights.data[5] += 0.5f)
    WAY("fades: sample",
        assert_true(s->seen.fades.fading.count > 1);
        s->seen.fades.fading.data[1].sample = s->seen.fades.fading.data[0].sample)
    WAY("fades for", s->seen.fades.fading.data[0].left = 0.0)
    return NULL;
}

/* ---- Queue, ids, memory ---- */

static const char* CorruptQueue(kiriWorld* world, kiriSheetData* s, int way)
{
    kiriCutData* cut = s->cuts.data[0];
    assert_true(s->queue.count == 1 && cut->tip.blade.vertex != KIRI_NONE);
    WAY("counted", cut->waiting += 1)
    WAY("no more", s->queue.data[0].cut = NULL)
    WAY("is at vertex", cut->tip.blade.vertex = s->mesh.vertices.count)
    WAY("not at its vertex", cut->tip.blade.vertex = 0)
    WAY("is nowhere", s->queue.data[0].to.y = (double)NAN)
    WAY("another sheet", cut->sheet = NULL)
    return NULL;
}

static const char* CorruptIds(kiriWorld* world, kiriSheetData* s, int way)
{
    WAY("finds", s->frames.data[1].id = s->frames.data[0].id)
    WAY("finds nothing", s->frames.data[1].id ^= 1u << 20)
    WAY("index 0 of 1", kiriPool_Find(&world->frameIds, s->frames.data[1].id)->index = 0)
    WAY("finds something", kiriPool_Find(&world->pinIds, s->pins.data[0].id)->owner = world)
    WAY("ids of kind", kiriPool_Reserve(&world->frameIds, &world->memory, 1); kiriPool_Add(&world->frameIds, s, 0))
    WAY("finds nothing", kiriPool_Remove(&world->cutIds, s->cuts.data[0]->id))
    WAY("is free", world->sheetIds.freeSlot = 0)
    return NULL;
}

TEST(SeesWhatIsWrong)
{
    CorruptFn* const all[] = { CorruptMesh,   CorruptSquares, CorruptCells,   CorruptFaces, CorruptRegions, CorruptShape,
                               CorruptFrames, CorruptLayout,  CorruptSamples, CorruptSurface, CorruptQueue, CorruptIds };
    for (size_t k = 0; k < sizeof(all) / sizeof(all[0]); ++k) {
        CheckWays(all[k], KIRI_MODEL_LINKS, 0);
    }
    CheckWays(CorruptCorners, KIRI_MODEL_LINKS, 12);
    CheckWays(CorruptPatches, KIRI_MODEL_AFFINE, 0);
    CheckWays(CorruptPatches, KIRI_MODEL_POINTS, 0);
}

TEST(SeesLostBlocks)
{
    HOST(host);
    kiriSheetData* sheet = Start(&host, KIRI_MODEL_LINKS, 0);
    kiriBlock** link = sheet->own.blocks->next->link;
    sheet->own.blocks->next->link = &sheet->own.blocks;
    assert_non_null(strstr(Validate_World(host.world), "another list"));
    sheet->own.blocks->next->link = link;
}

/* ---- Faults that it found, or that were found with it ---- */

/* The frames that pins hold, tried all over the sheet. */
static void HoldAllOver(Host* host, kiriSheet sheet, int32_t* frames)
{
    kiriSheetData* data = host->world->sheets.data[0];
    for (int i = 0; i < 400; ++i) {
        float u = 0.03f + 0.05f * (float)(i % 20), v = 0.021f + 0.05f * (float)(i / 20);
        kiriPin pin = Host_Pin(host, sheet, u, v, 0.0f, 0.0f, 0.0f);
        frames[i] = data->layout.pinFrame.data[data->pins.count - 1];
        assert_in_range(frames[i], 0, data->frames.count - 1);
        OK(kiriDestroyPin(host->world, pin));
    }
}

/* While a budget interrupts the cutting of the mesh, grid->nodeCell does not know the new nodes of mesh->squares: a pin
   must not ask it. */
TEST(PinsWhileTheMeshIsCut)
{
    const float line[4] = { 0.05f, 0.47f, 0.95f, 0.53f };
    const kiriBudget budget = { KIRI_LEAST_TRIANGLES, 0, 0, 0 };
    int32_t frames[400];
    START_HOST(host);
    kiriSheet sheet = Host_AddSmall(&host, 8);
    OK(kiriWorld_SetBudget(host.world, &budget));
    Host_Cut(&host, sheet, line, 2);
    while (Host_Tick(&host, 0.01f, 1) == KIRI_PENDING) {
        HoldAllOver(&host, sheet, frames);
    }
}

/* Nor after a tick whose work on the cut was refused memory: it goes on in the next. */
TEST(PinsAfterATickWithoutMemory)
{
    const float line[4] = { 0.05f, 0.47f, 0.95f, 0.53f };
    int32_t frames[400];
    kiriResult result = KIRI_ERROR_MEMORY;
    START_HOST(host);
    kiriSheet sheet = Host_AddSmall(&host, 8);
    Host_Cut(&host, sheet, line, 2);
    for (int calls = 0; result == KIRI_ERROR_MEMORY; ++calls) {
        host.failAt = host.calls + calls;
        result = Host_Tick(&host, 0.01f, 1);
        host.failAt = -1;
        HoldAllOver(&host, sheet, frames);
    }
}

/* A rigid piece with a site in each of its cells, all new: there is no room for one more, and to place them again would
   be a move, after which all is measured again, without end. A budget keeps the ticks short. */
TEST(ResamplingComesToAnEnd)
{
    const float line[4] = { 0.625f, -0.1f, 0.625f, 1.1f };
    const kiriBudget budget = { 0, 2000, 0, 0 };
    kiriResult result = KIRI_PENDING;
    START_HOST(host);
    kiriSheetDef def = Host_SmallDef();
    def.gridResolution = 4;
    def.framePoints = NULL;
    def.frameCount = def.maxFrames = 1;
    def.rigidArea = 0.01f;
    kiriSheet sheet = Host_AddRectangle(&host, &def, 1.0f, 0.25f, 4, 1);
    host.world->sheets.data[0]->settings.maxFrames = 256;
    OK(kiriWorld_SetBudget(host.world, &budget));
    Host_Cut(&host, sheet, line, 2);
    for (int tick = 0; tick < 200 && result == KIRI_PENDING; ++tick) {
        result = Host_Tick(&host, 0.01f, 1);
    }
    assert_int_equal(result, KIRI_OK);
}
