#include "kiri_state_hash.h"

#include "../sheet/kiri_update.h"

static void HashBytes(uint64_t* hash, const void* data, size_t bytes)
{
    const unsigned char* byte = data;
    for (size_t i = 0; i < bytes; ++i) {
        *hash = (*hash ^ byte[i]) * 1099511628211u;
    }
}

static void HashInt(uint64_t* hash, int32_t value)
{
    HashBytes(hash, &value, sizeof(value));
}
static void HashLong(uint64_t* hash, int64_t value)
{
    HashBytes(hash, &value, sizeof(value));
}
static void HashReal(uint64_t* hash, double value)
{
    HashBytes(hash, &value, sizeof(value));
}

static void HashVec2(uint64_t* hash, kiriVec2 a)
{
    HashReal(hash, a.x);
    HashReal(hash, a.y);
}

static void HashVec3(uint64_t* hash, kiriVec3 a)
{
    HashReal(hash, a.x);
    HashReal(hash, a.y);
    HashReal(hash, a.z);
}

static void HashPoint(uint64_t* hash, kiriLatticePoint p)
{
    HashInt(hash, p.x);
    HashInt(hash, p.y);
}

static void HashMesh(uint64_t* hash, const kiriMeshData* mesh)
{
    HashVec2(hash, mesh->origin);
    HashReal(hash, mesh->step);
    for (int32_t t = 0; t < mesh->triangles.count; ++t) {
        const kiriTriangle* triangle = &mesh->triangles.data[t];
        HashBytes(hash, triangle->vertex, sizeof(triangle->vertex));
        HashBytes(hash, triangle->twin, sizeof(triangle->twin));
        HashInt(hash, triangle->open);
    }
    for (int32_t v = 0; v < mesh->vertices.count; ++v) {
        HashPoint(hash, mesh->vertices.data[v].at);
    }
}

static void HashMoments(uint64_t* hash, const kiriMoments* m)
{
    HashReal(hash, m->area);
    HashVec2(hash, kiriVec2_Make(m->u, m->v));
    HashVec3(hash, kiriVec3_Make(m->uu, m->uv, m->vv));
}

static void HashSkin(uint64_t* hash, const kiriSkin* skin)
{
    for (int32_t i = 0; i < skin->spans.count; ++i) {
        kiriSpan span = skin->spans.data[i];
        HashInt(hash, span.count);
        for (int32_t k = span.first; k < span.first + span.count; ++k) {
            HashInt(hash, skin->weights.data[k].frame);
            HashReal(hash, skin->weights.data[k].value);
        }
    }
}

static void HashLink(uint64_t* hash, const kiriLink* link)
{
    HashInt(hash, link->i);
    HashInt(hash, link->j);
    HashVec3(hash, kiriVec3_Make(link->width, link->length, link->moment));
    HashReal(hash, link->braced);
    HashVec2(hash, link->span);
    HashVec2(hash, link->normal);
    HashVec2(hash, link->tangent);
    HashVec2(hash, link->centroid);
    HashVec2(hash, link->crossing);
    HashVec2(hash, link->spread[0]);
    HashVec2(hash, link->spread[1]);
}

static void HashAreaElements(uint64_t* hash, const kiriAreaElements* elements)
{
    for (int32_t i = 0; i < elements->elements.count; ++i) {
        HashReal(hash, elements->elements.data[i].area);
        HashInt(hash, elements->elements.data[i].count);
    }
    for (int32_t i = 0; i < elements->shares.count; ++i) {
        const kiriFrameShare* share = &elements->shares.data[i];
        HashInt(hash, share->frame);
        HashReal(hash, share->weight);
        HashVec2(hash, share->slope);
        HashVec2(hash, share->move);
        HashVec2(hash, share->u);
        HashVec2(hash, share->v);
    }
}

static void HashLayout(uint64_t* hash, const kiriSheetData* sheet)
{
    const kiriLayout* layout = &sheet->layout;
    for (int32_t i = 0; i < sheet->links.links.count; ++i) {
        HashLink(hash, &sheet->links.links.data[i]);
    }
    HashAreaElements(hash, &layout->areaElements);
    for (int32_t i = 0; i < sheet->points.count; ++i) {
        HashPoint(hash, sheet->points.data[i].at);
        HashInt(hash, sheet->points.data[i].frame);
    }
    HashSkin(hash, &sheet->vertexSkin);
    HashSkin(hash, &sheet->pointSkin);
    for (int32_t i = 0; i < layout->framePiece.count; ++i) {
        HashInt(hash, layout->framePiece.data[i]);
    }
    for (int32_t i = 0; i < layout->pinFrame.count; ++i) {
        HashInt(hash, layout->pinFrame.data[i]);
    }
}

static void HashFrame(uint64_t* hash, const kiriFrameData* frame)
{
    HashVec2(hash, frame->site.at);
    HashVec2(hash, frame->center);
    HashReal(hash, frame->mass);
    HashVec3(hash, kiriVec3_Make(frame->inertia[0], frame->inertia[1], frame->inertia[2]));
    HashVec3(hash, frame->x);
    HashVec3(hash, frame->A.u);
    HashVec3(hash, frame->A.v);
    HashVec3(hash, frame->A.d);
    HashVec3(hash, frame->velocity);
    HashVec3(hash, frame->spin);
    HashVec3(hash, frame->rate.u);
    HashVec3(hash, frame->rate.v);
    HashVec3(hash, frame->rate.d);
    HashVec3(hash, frame->force);
    HashVec3(hash, frame->torque);
    HashPoint(hash, frame->anchor);
    HashInt(hash, frame->held);
    if (frame->held) {
        HashVec3(hash, frame->heldPosition);
        HashVec3(hash, frame->heldRotation.u);
        HashVec3(hash, frame->heldRotation.v);
        HashVec3(hash, frame->heldRotation.d);
    }
}

static void HashSettings(uint64_t* hash, const kiriSheetData* sheet)
{
    const kiriMaterial* m = &sheet->settings.material;
    HashVec3(hash, kiriVec3_Make(m->youngsModulus, m->poissonsRatio, m->thickness));
    HashVec3(hash, kiriVec3_Make(m->density, m->airDamping, m->flexDamping));
    HashVec3(hash, kiriVec3_Make(sheet->settings.snap, sheet->shape.rigidWeight, sheet->settings.rigidArea));
    HashReal(hash, sheet->settings.crumbArea);
    HashReal(hash, sheet->settings.frameLength);
    HashInt(hash, sheet->settings.mechanics.model);
    HashInt(hash, sheet->settings.mechanics.planar);
    HashReal(hash, sheet->settings.integrationPoints);
    HashInt(hash, sheet->settings.integrationOrder);
    HashInt(hash, sheet->settings.maxFrames);
    HashInt(hash, sheet->settings.iterations);
    HashReal(hash, sheet->settings.collisionPoints);
    HashInt(hash, sheet->settings.popping);
}

static void HashContacts(uint64_t* hash, const kiriContact* contacts, int32_t count)
{
    HashInt(hash, count);
    for (int32_t i = 0; i < count; ++i) {
        HashInt(hash, contacts[i].point);
        HashVec3(hash, kiriVec3_Load(contacts[i].normal));
        HashVec3(hash, kiriVec3_Make(contacts[i].offset, contacts[i].friction, contacts[i].stiffness));
    }
}

/* How far the work on a cut has come. Which items of it are done follows from how many, for their order does. What is
   made again after a refused allocation counts where it can change when a cut takes effect. */
static void HashWork(uint64_t* hash, const kiriWorld* world, const kiriSheetData* sheet)
{
    const kiriUpdate* u = sheet->update;
    bool isLimited = world->budget.cells > 0 || world->budget.samples > 0;
    HashInt(hash, isLimited && sheet->settings.fromScratch);
    HashInt(hash, (isLimited || u->stage != KIRI_NONE) && (u->needsRebuild || u->isScratch));
    HashInt(hash, u->stage);
    if (u->stage != KIRI_NONE) {
        HashInt(hash, u->step);
        HashLong(hash, u->spent);
        HashLong(hash, world->ticks - u->cut.stamp);
        HashInt(hash, u->cut.count);
        HashInt(hash, u->cut.taken);
        HashInt(hash, u->cut.meshChanged);
    }
}

static void HashWaiting(uint64_t* hash, const kiriWorld* world, const kiriSheetData* sheet)
{
    for (int32_t i = 0; i < sheet->queue.count; ++i) {
        const kiriQueuedPoint* point = &sheet->queue.data[i];
        HashVec2(hash, point->to);
        HashInt(hash, point->jump);
        HashLong(hash, world->ticks - point->stamp);
        HashInt(hash, point->cut->index);
    }
    for (int32_t i = 0; i < sheet->cuts.count; ++i) {
        HashVec2(hash, sheet->cuts.data[i]->tip.last);
        HashPoint(hash, sheet->cuts.data[i]->tip.blade.at);
        HashInt(hash, sheet->cuts.data[i]->tip.blade.vertex);
        HashInt(hash, sheet->cuts.data[i]->ended);
    }
    for (int32_t i = 0; i < sheet->pins.count; ++i) {
        HashPoint(hash, sheet->pins.data[i].at);
        HashVec3(hash, sheet->pins.data[i].target);
        HashReal(hash, sheet->pins.data[i].stiffness);
    }
    HashContacts(hash, sheet->contacts.data, sheet->contacts.count);
}

static void HashStrainOffsets(uint64_t* hash, const kiriStrainOffsets* strainOffsets)
{
    for (int32_t k = 0; k < strainOffsets->strainOffsets.count; ++k) {
        for (int e = 0; e < KIRI_STRAINS; ++e) {
            HashReal(hash, strainOffsets->strainOffsets.data[k].strain[e]);
        }
    }
}

static void HashFades(uint64_t* hash, const kiriFades* fades)
{
    HashReal(hash, fades->time);
    for (int32_t k = 0; k < fades->fading.count; ++k) {
        HashInt(hash, fades->fading.data[k].sample);
        HashReal(hash, fades->fading.data[k].left);
        HashVec3(hash, fades->fading.data[k].offset);
    }
}

static void HashRest(uint64_t* hash, const kiriSheetData* sheet)
{
    HashReal(hash, sheet->settings.sleepSpeed);
    HashReal(hash, sheet->rest.calm);
    HashInt(hash, sheet->rest.asleep);
    HashContacts(hash, sheet->rest.contacts.data, sheet->rest.contacts.count);
}

uint64_t kiriStateHash_Of(const kiriWorld* world)
{
    uint64_t hash = 14695981039346656037u;
    HashVec3(&hash, world->gravity);
    HashBytes(&hash, &world->budget, sizeof(world->budget));
    HashInt(&hash, world->turn);
    for (int32_t i = 0; i < world->sheets.count; ++i) {
        const kiriSheetData* sheet = world->sheets.data[i];
        HashSettings(&hash, sheet);
        HashMesh(&hash, &sheet->mesh);
        HashLayout(&hash, sheet);
        uint64_t pattern = kiriSolver_Hash(sheet->solver);
        HashBytes(&hash, &pattern, sizeof(pattern));
        HashWork(&hash, world, sheet);
        HashWaiting(&hash, world, sheet);
        HashRest(&hash, sheet);
        HashStrainOffsets(&hash, &sheet->strainOffsets);
        HashFades(&hash, &sheet->seen.fades);
        HashFades(&hash, &sheet->seen.pointFades);
        for (int32_t f = 0; f < sheet->frames.count; ++f) {
            HashFrame(&hash, &sheet->frames.data[f]);
        }
    }
    return hash;
}

/* ---- Grid, regions and shape, by what does not depend on indices ---- */

static void HashPlace(uint64_t* hash, const kiriGrid* grid, int32_t cell)
{
    HashInt(hash, cell == KIRI_NONE ? KIRI_NONE : grid->cells.data[cell].square);
    HashInt(hash, cell == KIRI_NONE ? KIRI_NONE : grid->cells.data[cell].triangle);
}

static void HashSteps(uint64_t* hash, const kiriGrid* grid, int32_t cell)
{
    kiriStepRun run = grid->runs.data[cell];
    for (int32_t s = run.first; s < run.end[KIRI_STEP_LENGTHS - 1]; ++s) {
        kiriStep step = grid->steps.data[s];
        HashPlace(hash, grid, step.cell);
        HashInt(hash, step.length);
    }
}

/* A sum, for a cell's faces come in no order. */
static uint64_t HashFaces(const kiriGrid* grid, int32_t cell)
{
    uint64_t sum = 0;
    for (int32_t f = grid->cells.data[cell].firstFace; f != KIRI_NONE;) {
        const kiriFace* face = &grid->faces.data[f];
        uint64_t hash = 14695981039346656037u;
        HashPlace(&hash, grid, face->cell[0]);
        HashPlace(&hash, grid, face->cell[1]);
        HashInt(&hash, face->axis);
        HashVec3(&hash, kiriVec3_Make(face->width, face->moment, 0.0));
        HashVec2(&hash, face->middle);
        sum += hash;
        f = face->next[face->cell[1] == cell];
    }
    return sum;
}

static void HashCellWeights(uint64_t* hash, const kiriShape* shape, int32_t cell)
{
    kiriSpan span = shape->spans.data[cell];
    for (int32_t k = span.first; k < span.first + span.count; ++k) {
        HashInt(hash, shape->weights.data[k].frame);
        HashReal(hash, shape->weights.data[k].value);
    }
}

static void HashCell(uint64_t* hash, const kiriSheetData* sheet, int32_t cell)
{
    uint64_t faces = HashFaces(&sheet->grid, cell);
    HashPlace(hash, &sheet->grid, cell);
    HashMoments(hash, &sheet->grid.cells.data[cell].material);
    HashSteps(hash, &sheet->grid, cell);
    HashBytes(hash, &faces, sizeof(faces));
    HashInt(hash, sheet->regions.field.owner.data[cell]);
    HashInt(hash, sheet->regions.field.distance.data[cell]);
    HashInt(hash, sheet->regions.onBorder.data[cell]);
    HashCellWeights(hash, &sheet->shape, cell);
}

uint64_t kiriStateHash_OfLayout(const kiriSheetData* sheet)
{
    uint64_t hash = 14695981039346656037u;
    HashMesh(&hash, &sheet->mesh);
    HashLayout(&hash, sheet);
    for (int32_t s = 0; s < sheet->grid.squareCell.count; ++s) {
        for (int32_t c = sheet->grid.squareCell.data[s]; c != KIRI_NONE; c = sheet->grid.cells.data[c].next) {
            HashCell(&hash, sheet, c);
        }
    }
    for (int32_t f = 0; f < sheet->frames.count; ++f) {
        HashBytes(&hash, &sheet->regions.material.data[f], sizeof(kiriTally));
        HashBytes(&hash, &sheet->shape.rigid.data[f], sizeof(int64_t));
        HashPlace(&hash, &sheet->grid, sheet->frames.data[f].site.cell);
    }
    return hash;
}
