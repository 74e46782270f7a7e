#include "kiri_state_hash.h"

#include "../sheet/kiri_update.h"

static void Bytes(uint64_t* hash, const void* data, size_t bytes)
{
    const unsigned char* byte = data;
    for (size_t i = 0; i < bytes; ++i) {
        *hash = (*hash ^ byte[i]) * 1099511628211u;
    }
}

static void Int(uint64_t* hash, int32_t value)
{
    Bytes(hash, &value, sizeof(value));
}
static void Long(uint64_t* hash, int64_t value)
{
    Bytes(hash, &value, sizeof(value));
}
static void Real(uint64_t* hash, double value)
{
    Bytes(hash, &value, sizeof(value));
}

static void Vec2(uint64_t* hash, kiriVec2 a)
{
    Real(hash, a.x);
    Real(hash, a.y);
}

static void Vec3(uint64_t* hash, kiriVec3 a)
{
    Real(hash, a.x);
    Real(hash, a.y);
    Real(hash, a.z);
}

static void Point(uint64_t* hash, kiriLatticePoint p)
{
    Int(hash, p.x);
    Int(hash, p.y);
}

static void Mesh(uint64_t* hash, const kiriMeshData* mesh)
{
    Vec2(hash, mesh->origin);
    Real(hash, mesh->step);
    for (int32_t t = 0; t < mesh->triangles.count; ++t) {
        const kiriTriangle* triangle = &mesh->triangles.data[t];
        Bytes(hash, triangle->vertex, sizeof(triangle->vertex));
        Bytes(hash, triangle->twin, sizeof(triangle->twin));
        Int(hash, triangle->open);
    }
    for (int32_t v = 0; v < mesh->vertices.count; ++v) {
        Point(hash, mesh->vertices.data[v].at);
    }
}

static void Moments(uint64_t* hash, const kiriMoments* m)
{
    Real(hash, m->area);
    Vec2(hash, kiriVec2_Make(m->u, m->v));
    Vec3(hash, kiriVec3_Make(m->uu, m->uv, m->vv));
}

static void Skin(uint64_t* hash, const kiriSkin* skin)
{
    for (int32_t i = 0; i < skin->spans.count; ++i) {
        kiriSpan span = skin->spans.data[i];
        Int(hash, span.count);
        for (int32_t k = span.first; k < span.first + span.count; ++k) {
            Int(hash, skin->weights.data[k].frame);
            Real(hash, skin->weights.data[k].value);
        }
    }
}

static void Link(uint64_t* hash, const kiriLink* link)
{
    Int(hash, link->i);
    Int(hash, link->j);
    Vec3(hash, kiriVec3_Make(link->width, link->length, link->moment));
    Real(hash, link->braced);
    Vec2(hash, link->span);
    Vec2(hash, link->normal);
    Vec2(hash, link->tangent);
    Vec2(hash, link->centroid);
    Vec2(hash, link->crossing);
    Vec2(hash, link->spread[0]);
    Vec2(hash, link->spread[1]);
}

static void Patches(uint64_t* hash, const kiriPatches* patches)
{
    for (int32_t i = 0; i < patches->patches.count; ++i) {
        Real(hash, patches->patches.data[i].area);
        Int(hash, patches->patches.data[i].count);
    }
    for (int32_t i = 0; i < patches->shares.count; ++i) {
        const kiriShare* share = &patches->shares.data[i];
        Int(hash, share->frame);
        Real(hash, share->weight);
        Vec2(hash, share->slope);
        Vec2(hash, share->move);
        Vec2(hash, share->u);
        Vec2(hash, share->v);
    }
}

static void Layout(uint64_t* hash, const kiriSheetData* sheet)
{
    const kiriLayout* layout = &sheet->layout;
    for (int32_t i = 0; i < sheet->links.links.count; ++i) {
        Link(hash, &sheet->links.links.data[i]);
    }
    Patches(hash, &layout->patches);
    for (int32_t i = 0; i < sheet->points.count; ++i) {
        Point(hash, sheet->points.data[i].at);
        Int(hash, sheet->points.data[i].frame);
    }
    Skin(hash, &sheet->vertexSkin);
    Skin(hash, &sheet->pointSkin);
    for (int32_t i = 0; i < layout->framePiece.count; ++i) {
        Int(hash, layout->framePiece.data[i]);
    }
    for (int32_t i = 0; i < layout->pinFrame.count; ++i) {
        Int(hash, layout->pinFrame.data[i]);
    }
}

static void Frame(uint64_t* hash, const kiriFrameData* frame)
{
    Vec2(hash, frame->site.at);
    Vec2(hash, frame->center);
    Real(hash, frame->mass);
    Vec3(hash, kiriVec3_Make(frame->inertia[0], frame->inertia[1], frame->inertia[2]));
    Vec3(hash, frame->x);
    Vec3(hash, frame->A.u);
    Vec3(hash, frame->A.v);
    Vec3(hash, frame->A.d);
    Vec3(hash, frame->velocity);
    Vec3(hash, frame->spin);
    Vec3(hash, frame->rate.u);
    Vec3(hash, frame->rate.v);
    Vec3(hash, frame->rate.d);
    Vec3(hash, frame->force);
    Vec3(hash, frame->torque);
    Point(hash, frame->anchor);
    Int(hash, frame->held);
    if (frame->held) {
        Vec3(hash, frame->heldPosition);
        Vec3(hash, frame->heldRotation.u);
        Vec3(hash, frame->heldRotation.v);
        Vec3(hash, frame->heldRotation.d);
    }
}

static void Parameters(uint64_t* hash, const kiriSheetData* sheet)
{
    const kiriMaterial* m = &sheet->settings.material;
    Vec3(hash, kiriVec3_Make(m->youngsModulus, m->poissonsRatio, m->thickness));
    Vec3(hash, kiriVec3_Make(m->density, m->airDamping, m->flexDamping));
    Vec3(hash, kiriVec3_Make(sheet->settings.snap, sheet->shape.rigidWeight, sheet->settings.rigidArea));
    Real(hash, sheet->settings.crumbArea);
    Real(hash, sheet->settings.frameLength);
    Int(hash, sheet->settings.mechanics.model);
    Int(hash, sheet->settings.mechanics.planar);
    Real(hash, sheet->settings.integrationPoints);
    Int(hash, sheet->settings.integrationOrder);
    Int(hash, sheet->settings.maxFrames);
    Int(hash, sheet->settings.iterations);
    Real(hash, sheet->settings.collisionPoints);
    Int(hash, sheet->settings.popping);
    if (sheet->settings.skinning != KIRI_SKINNING_LINEAR) {
        Int(hash, sheet->settings.skinning); /* what fades is what is seen to jump */
    }
}

static void Contacts(uint64_t* hash, const kiriContact* contacts, int32_t count)
{
    Int(hash, count);
    for (int32_t i = 0; i < count; ++i) {
        Int(hash, contacts[i].point);
        Vec3(hash, kiriVec3_Load(contacts[i].normal));
        Vec3(hash, kiriVec3_Make(contacts[i].offset, contacts[i].friction, contacts[i].stiffness));
    }
}

/* How far the work on a cut has come. Which items of it are done follows from how many, for their order does. What is
   made again after a refused allocation counts where it can change when a cut takes effect. */
static void Work(uint64_t* hash, const kiriWorld* world, const kiriSheetData* sheet)
{
    const kiriUpdate* u = sheet->update;
    bool isLimited = world->budget.cells > 0 || world->budget.samples > 0;
    Int(hash, isLimited && sheet->settings.fromScratch);
    Int(hash, (isLimited || u->stage != KIRI_NONE) && (u->needsRebuild || u->isScratch));
    Int(hash, u->stage);
    if (u->stage != KIRI_NONE) {
        Int(hash, u->step);
        Long(hash, u->spent);
        Long(hash, world->ticks - u->cut.stamp);
        Int(hash, u->cut.count);
        Int(hash, u->cut.taken);
        Int(hash, u->cut.meshChanged);
    }
}

static void Waiting(uint64_t* hash, const kiriWorld* world, const kiriSheetData* sheet)
{
    for (int32_t i = 0; i < sheet->queue.count; ++i) {
        const kiriQueuedPoint* point = &sheet->queue.data[i];
        Vec2(hash, point->to);
        Int(hash, point->jump);
        Long(hash, world->ticks - point->stamp);
        Int(hash, point->cut->index);
    }
    for (int32_t i = 0; i < sheet->cuts.count; ++i) {
        Vec2(hash, sheet->cuts.data[i]->tip.last);
        Point(hash, sheet->cuts.data[i]->tip.blade.at);
        Int(hash, sheet->cuts.data[i]->tip.blade.vertex);
        Int(hash, sheet->cuts.data[i]->ended);
    }
    for (int32_t i = 0; i < sheet->pins.count; ++i) {
        Point(hash, sheet->pins.data[i].at);
        Vec3(hash, sheet->pins.data[i].target);
        Real(hash, sheet->pins.data[i].stiffness);
    }
    Contacts(hash, sheet->contacts.data, sheet->contacts.count);
}

static void Eases(uint64_t* hash, const kiriStrainOffsets* strainOffsets)
{
    for (int32_t k = 0; k < strainOffsets->strainOffsets.count; ++k) {
        for (int e = 0; e < KIRI_STRAINS; ++e) {
            Real(hash, strainOffsets->strainOffsets.data[k].strain[e]);
        }
    }
}

static void Fades(uint64_t* hash, const kiriFades* fades)
{
    Real(hash, fades->time);
    for (int32_t k = 0; k < fades->fading.count; ++k) {
        Int(hash, fades->fading.data[k].sample);
        Real(hash, fades->fading.data[k].left);
        Vec3(hash, fades->fading.data[k].offset);
    }
}

static void Sleep(uint64_t* hash, const kiriSheetData* sheet)
{
    Real(hash, sheet->settings.sleepSpeed);
    Real(hash, sheet->rest.calm);
    Int(hash, sheet->rest.asleep);
    Contacts(hash, sheet->rest.contacts.data, sheet->rest.contacts.count);
}

uint64_t kiriStateHash_Of(const kiriWorld* world)
{
    uint64_t hash = 14695981039346656037u;
    Vec3(&hash, world->gravity);
    Bytes(&hash, &world->budget, sizeof(world->budget));
    Int(&hash, world->turn);
    for (int32_t i = 0; i < world->sheets.count; ++i) {
        const kiriSheetData* sheet = world->sheets.data[i];
        Parameters(&hash, sheet);
        Mesh(&hash, &sheet->mesh);
        Layout(&hash, sheet);
        uint64_t pattern = kiriSolver_Hash(sheet->solver);
        Bytes(&hash, &pattern, sizeof(pattern));
        Work(&hash, world, sheet);
        Waiting(&hash, world, sheet);
        Sleep(&hash, sheet);
        Eases(&hash, &sheet->strainOffsets);
        Fades(&hash, &sheet->seen.fades);
        Fades(&hash, &sheet->seen.pointFades);
        for (int32_t f = 0; f < sheet->frames.count; ++f) {
            Frame(&hash, &sheet->frames.data[f]);
        }
    }
    return hash;
}

/* ---- Grid, regions and shape, by what does not depend on indices ---- */

static void Place(uint64_t* hash, const kiriGrid* grid, int32_t cell)
{
    Int(hash, cell == KIRI_NONE ? KIRI_NONE : grid->cells.data[cell].square);
    Int(hash, cell == KIRI_NONE ? KIRI_NONE : grid->cells.data[cell].triangle);
}

static void Steps(uint64_t* hash, const kiriGrid* grid, int32_t cell)
{
    kiriStepRun run = grid->runs.data[cell];
    for (int32_t s = run.first; s < run.end[KIRI_STEP_LENGTHS - 1]; ++s) {
        kiriStep step = grid->steps.data[s];
        Place(hash, grid, step.cell);
        Int(hash, step.length);
    }
}

/* A sum, for a cell's faces come in no order. */
static uint64_t Faces(const kiriGrid* grid, int32_t cell)
{
    uint64_t sum = 0;
    for (int32_t f = grid->cells.data[cell].firstFace; f != KIRI_NONE;) {
        const kiriFace* face = &grid->faces.data[f];
        uint64_t hash = 14695981039346656037u;
        Place(&hash, grid, face->cell[0]);
        Place(&hash, grid, face->cell[1]);
        Int(&hash, face->axis);
        Vec3(&hash, kiriVec3_Make(face->width, face->moment, 0.0));
        Vec2(&hash, face->middle);
        sum += hash;
        f = face->next[face->cell[1] == cell];
    }
    return sum;
}

static void CellWeights(uint64_t* hash, const kiriShape* shape, int32_t cell)
{
    kiriSpan span = shape->spans.data[cell];
    for (int32_t k = span.first; k < span.first + span.count; ++k) {
        Int(hash, shape->weights.data[k].frame);
        Real(hash, shape->weights.data[k].value);
    }
}

static void Cell(uint64_t* hash, const kiriSheetData* sheet, int32_t cell)
{
    uint64_t faces = Faces(&sheet->grid, cell);
    Place(hash, &sheet->grid, cell);
    Moments(hash, &sheet->grid.cells.data[cell].material);
    Steps(hash, &sheet->grid, cell);
    Bytes(hash, &faces, sizeof(faces));
    Int(hash, sheet->regions.field.owner.data[cell]);
    Int(hash, sheet->regions.field.distance.data[cell]);
    Int(hash, sheet->regions.onBorder.data[cell]);
    CellWeights(hash, &sheet->shape, cell);
}

uint64_t kiriStateHash_OfLayout(const kiriSheetData* sheet)
{
    uint64_t hash = 14695981039346656037u;
    Mesh(&hash, &sheet->mesh);
    Layout(&hash, sheet);
    for (int32_t s = 0; s < sheet->grid.squareCell.count; ++s) {
        for (int32_t c = sheet->grid.squareCell.data[s]; c != KIRI_NONE; c = sheet->grid.cells.data[c].next) {
            Cell(&hash, sheet, c);
        }
    }
    for (int32_t f = 0; f < sheet->frames.count; ++f) {
        Bytes(&hash, &sheet->regions.material.data[f], sizeof(kiriTally));
        Bytes(&hash, &sheet->shape.rigid.data[f], sizeof(int64_t));
        Place(&hash, &sheet->grid, sheet->frames.data[f].site.cell);
    }
    return hash;
}
