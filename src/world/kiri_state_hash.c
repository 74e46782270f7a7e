#include "kiri_state_hash.h"

#include "../core/kiri_hash.h"
#include "../sheet/kiri_update.h"
#include "kiri_blade.h"

static void HashVec2(uint64_t* hash, kiriVec2 a)
{
    kiriHash_Double(hash, a.x);
    kiriHash_Double(hash, a.y);
}

static void HashVec3(uint64_t* hash, kiriVec3 a)
{
    kiriHash_Double(hash, a.x);
    kiriHash_Double(hash, a.y);
    kiriHash_Double(hash, a.z);
}

static void HashPoint(uint64_t* hash, kiriLatticePoint p)
{
    kiriHash_Pair(hash, p.x, p.y);
}

static void HashMesh(uint64_t* hash, const kiriMeshData* mesh)
{
    HashVec2(hash, mesh->origin);
    kiriHash_Double(hash, mesh->step);
    for (int32_t t = 0; t < mesh->triangles.count; ++t) {
        const kiriTriangle* triangle = &mesh->triangles.data[t];
        for (int k = 0; k < 3; ++k) {
            kiriHash_Pair(hash, triangle->vertex[k], triangle->twin[k]);
        }
        kiriHash_Int32(hash, triangle->marks & KIRI_TRIANGLE_OPEN);
    }
    for (int32_t v = 0; v < mesh->vertices.count; ++v) {
        HashPoint(hash, mesh->vertices.data[v].at);
    }
}

static void HashSkin(uint64_t* hash, const kiriSheetData* sheet, const kiriSkin* skin)
{
    for (int32_t i = 0; i < skin->spans.count; ++i) {
        kiriSpan span = skin->spans.data[i];
        kiriHash_Int32(hash, span.count);
        for (int32_t k = span.first; k < span.first + span.count; ++k) {
            kiriHash_Int32(hash, kiriSheet_FrameOf(sheet, skin->weights.data[k].label));
            kiriHash_Double(hash, skin->weights.data[k].value);
        }
    }
}

static void HashLink(uint64_t* hash, const kiriLink* link)
{
    kiriHash_Int32(hash, link->i);
    kiriHash_Int32(hash, link->j);
    HashVec3(hash, kiriVec3_Make(link->width, link->length, link->moment));
    kiriHash_Double(hash, link->outer);
    HashVec2(hash, link->span);
    HashVec2(hash, link->normal);
    HashVec2(hash, link->tangent);
    HashVec2(hash, link->centroid);
    HashVec2(hash, link->crossing);
    HashVec2(hash, link->sum);
    HashVec2(hash, link->spread[0]);
    HashVec2(hash, link->spread[1]);
}

static void HashCorner(uint64_t* hash, const kiriCorner* corner)
{
    kiriHash_Int32(hash, corner->count);
    for (int32_t k = 0; k < corner->count; ++k) {
        kiriHash_Int32(hash, corner->link[k]);
        HashVec2(hash, corner->weight[k]);
    }
    kiriHash_Double(hash, corner->area);
}

static void HashAreaElements(uint64_t* hash, const kiriAreaElements* elements)
{
    for (int32_t i = 0; i < elements->elements.count; ++i) {
        kiriHash_Double(hash, elements->elements.data[i].area);
        kiriHash_Int32(hash, elements->elements.data[i].count);
    }
    for (int32_t i = 0; i < elements->shares.count; ++i) {
        const kiriFrameShare* share = &elements->shares.data[i];
        kiriHash_Int32(hash, share->frame);
        kiriHash_Double(hash, share->weight);
        HashVec2(hash, share->slope);
        HashVec2(hash, share->move);
        HashVec2(hash, share->u);
        HashVec2(hash, share->v);
    }
}

static void HashPinShare(uint64_t* hash, const kiriPinShare* pinned)
{
    const kiriLineShare* share = &pinned->share;
    kiriHash_Int32(hash, pinned->pin);
    kiriHash_Int32(hash, share->frame);
    HashVec3(hash, kiriVec3_Make(share->length, share->first, share->second));
    for (int end = 0; end < 2; ++end) {
        kiriHash_Double(hash, share->ends[end]);
        kiriHash_Int32(hash, share->open[end]);
    }
}

void kiriStateHash_AddLayout(uint64_t* hash, const kiriSheetData* sheet)
{
    HashMesh(hash, &sheet->mesh);
    const kiriLayout* layout = &sheet->layout;
    for (int32_t i = 0; i < sheet->links.links.count; ++i) {
        HashLink(hash, &sheet->links.links.data[i]);
    }
    for (int32_t i = 0; i < sheet->links.corners.count; ++i) {
        HashCorner(hash, &sheet->links.corners.data[i]);
    }
    HashAreaElements(hash, &layout->areaElements);
    for (int32_t i = 0; i < sheet->points.count; ++i) {
        HashPoint(hash, sheet->points.data[i].at);
        kiriHash_Int32(hash, sheet->points.data[i].frame);
    }
    HashSkin(hash, sheet, &sheet->vertexSkin);
    HashSkin(hash, sheet, &sheet->pointSkin);
    for (int32_t i = 0; i < layout->framePiece.count; ++i) {
        kiriHash_Int32(hash, layout->framePiece.data[i]);
    }
    for (int32_t i = 0; i < layout->pinFrame.count; ++i) {
        kiriHash_Int32(hash, layout->pinFrame.data[i]);
    }
    for (int32_t k = 0; k < layout->severed.count; ++k) {
        kiriHash_Int32(hash, layout->severed.data[k].pin);
        kiriHash_Int32(hash, layout->severed.data[k].link);
        kiriHash_Double(hash, layout->severed.data[k].part);
    }
    for (int32_t k = 0; k < layout->pinShares.count; ++k) {
        HashPinShare(hash, &layout->pinShares.data[k]);
    }
}

static void HashMat3(uint64_t* hash, const kiriMat3* m)
{
    HashVec3(hash, m->u);
    HashVec3(hash, m->v);
    HashVec3(hash, m->d);
}

static void HashHistory(uint64_t* hash, const kiriHistory* history)
{
    kiriHash_Double(hash, history->dt);
    kiriHash_Int32(hash, history->isHalf);
    kiriHash_Int32(hash, history->isHeld);
    HashVec3(hash, history->gain);
    HashVec3(hash, history->lag);
    HashVec3(hash, history->pull);
    HashMat3(hash, &history->turnGain);
    HashMat3(hash, &history->turnLag);
    HashMat3(hash, &history->turnPull);
}

static void HashWrench(uint64_t* hash, const kiriWrench* wrench)
{
    HashVec3(hash, wrench->force);
    HashVec3(hash, wrench->moment);
}

static void HashReaction(uint64_t* hash, const kiriReaction* reaction, const kiriWrench* bore)
{
    HashWrench(hash, &reaction->gain);
    HashWrench(hash, &reaction->pull);
    HashWrench(hash, bore);
}

static void HashFrame(uint64_t* hash, const kiriFrameData* frame)
{
    HashVec2(hash, frame->site.at);
    HashVec2(hash, frame->center);
    kiriHash_Double(hash, frame->mass);
    kiriHash_Int64(hash, frame->rigidAtStart);
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
    HashHistory(hash, &frame->history);
    HashVec3(hash, frame->force);
    HashVec3(hash, frame->torque);
    HashWrench(hash, &frame->load);
    HashVec3(hash, frame->support);
    HashPoint(hash, frame->anchor);
    kiriHash_Int32(hash, frame->held);
    if (frame->held) {
        HashVec3(hash, frame->heldPosition);
        HashMat3(hash, &frame->heldRotation);
        HashVec3(hash, frame->goalPosition);
        HashMat3(hash, &frame->goalRotation);
        HashVec3(hash, frame->heldOff);
        kiriHash_Int32(hash, frame->isOffKnown);
        HashReaction(hash, &frame->reaction, &frame->bore);
    }
}

static void HashSettings(uint64_t* hash, const kiriSheetData* sheet)
{
    const kiriMaterial* m = &sheet->settings.material;
    HashVec3(hash, kiriVec3_Make(m->youngsModulus, m->poissonsRatio, m->thickness));
    HashVec3(hash, kiriVec3_Make(m->density, m->airDamping, m->flexDamping));
    HashVec3(hash, kiriVec3_Make(sheet->settings.snap, sheet->shape.rigidWeight, sheet->settings.rigidArea));
    kiriHash_Double(hash, sheet->settings.crumbArea);
    kiriHash_Double(hash, sheet->settings.frameLength);
    kiriHash_Int32(hash, sheet->settings.mechanics.model);
    kiriHash_Int32(hash, sheet->settings.mechanics.planar);
    kiriHash_Int32(hash, sheet->settings.mechanics.timeStepping);
    kiriHash_Double(hash, sheet->settings.integrationPoints);
    kiriHash_Int32(hash, sheet->settings.integrationOrder);
    kiriHash_Int32(hash, sheet->settings.maxFrames);
    kiriHash_Int32(hash, sheet->settings.iterations);
    kiriHash_Double(hash, sheet->settings.collisionPoints);
    kiriHash_Int32(hash, sheet->settings.popping);
    kiriHash_Int32(hash, sheet->settings.eased);
    kiriHash_Double(hash, sheet->settings.friction);
    kiriHash_Double(hash, sheet->settings.contactThickness);
    kiriHash_Int32(hash, (int32_t)sheet->settings.groups);
    kiriHash_Int32(hash, sheet->settings.touchesSheets);
    HashVec3(hash, sheet->settings.air.velocity);
    HashVec3(hash, kiriVec3_Make(sheet->settings.air.density, sheet->settings.air.drag, sheet->settings.air.lift));
    if (sheet->settings.skinning != KIRI_SKINNING_LINEAR) {
        kiriHash_Int32(hash, sheet->settings.skinning); /* what fades is what is seen to jump */
    }
}

static void HashContacts(uint64_t* hash, const kiriSheetData* sheet)
{
    kiriHash_Int32(hash, sheet->contacts.count);
    for (int32_t i = 0; i < sheet->contacts.count; ++i) {
        const kiriContact* contact = &sheet->contacts.data[i].contact;
        kiriHash_Int32(hash, contact->point);
        if (contact->point < 0) {
            HashVec2(hash, kiriVec2_Make(contact->restPoint[0], contact->restPoint[1]));
        }
        HashVec3(hash, kiriVec3_Load(contact->normal));
        HashVec3(hash, kiriVec3_Load(contact->velocity));
        HashVec3(hash, kiriVec3_Make(contact->offset, contact->friction, contact->inverseMass));
        kiriHash_Double(hash, contact->pushSpeed);
        kiriHash_Int32(hash, contact->obstacle);
    }
}

/* Of the last tick that moved the sheet. */
static void HashTouch(uint64_t* hash, const kiriTouch* touch)
{
    kiriHash_Word(hash, touch->key);
    HashVec3(hash, touch->normal);
    HashVec3(hash, touch->velocity);
    kiriHash_Double(hash, touch->offset);
    kiriHash_Double(hash, touch->friction);
}

static void HashTouchForces(uint64_t* hash, const kiriTouchMemory* memory)
{
    for (int32_t i = 0; i < memory->forces.count; ++i) {
        kiriHash_Word(hash, memory->forces.data[i].key);
        HashVec3(hash, memory->forces.data[i].force);
    }
}

static void HashTouches(uint64_t* hash, const kiriTouchMemory* last, const kiriTouchMemory* slept)
{
    kiriHash_Int32(hash, last->touches.count + slept->touches.count);
    for (int32_t i = 0; i < last->touches.count; ++i) {
        HashTouch(hash, &last->touches.data[i]);
    }
    for (int32_t i = 0; i < slept->touches.count; ++i) {
        HashTouch(hash, &slept->touches.data[i]);
    }
    kiriHash_Int32(hash, last->forces.count + slept->forces.count);
    HashTouchForces(hash, last);
    HashTouchForces(hash, slept);
}

/* How far the work on a cut has come. Which items of it are done follows from how many, for their order does. What is
   made again after a refused allocation counts where it can change when a cut takes effect. */
static void HashWork(uint64_t* hash, const kiriWorld* world, const kiriSheetData* sheet)
{
    const kiriUpdate* u = sheet->update;
    bool isLimited = world->budget.cells > 0 || world->budget.samples > 0;
    kiriHash_Int32(hash, isLimited && sheet->settings.fromScratch);
    kiriHash_Int32(hash, (isLimited || u->stage != KIRI_NONE) && (u->needsRebuild || u->isScratch));
    kiriHash_Int32(hash, u->isUnsettled);
    kiriHash_Int32(hash, u->stage);
    if (u->stage != KIRI_NONE) {
        kiriHash_Int32(hash, u->step);
        kiriHash_Int64(hash, u->spent);
        kiriHash_Int64(hash, world->ticks - u->cut.stamp);
        kiriHash_Int32(hash, u->cut.count);
        kiriHash_Int32(hash, u->cut.taken);
        kiriHash_Int32(hash, u->cut.meshChanged);
        kiriHash_Int32(hash, u->cut.settlesSites);
        kiriGrid_HashProgress(&sheet->grid, hash);
        kiriShape_HashProgress(&sheet->shape, hash);
    }
}

static void HashPin(uint64_t* hash, const kiriPinData* pin)
{
    HashPoint(hash, pin->at);
    HashVec3(hash, pin->target);
    HashVec3(hash, pin->lastTarget);
    HashVec3(hash, pin->off);
    kiriHash_Int32(hash, pin->offFrame != 0);
    kiriHash_Double(hash, pin->breakForce);
    kiriHash_Int32(hash, pin->anchor.obstacle != 0);
    HashVec3(hash, pin->anchor.local);
    kiriHash_Double(hash, pin->stiffness);
    HashReaction(hash, &pin->reaction, &pin->bore);
    if (pin->type == KIRI_PIN_POINT) {
        return;
    }
    kiriHash_Int32(hash, pin->type);
    HashPoint(hash, pin->to);
    HashVec3(hash, pin->rotation.u);
    HashVec3(hash, pin->rotation.v);
    HashVec3(hash, pin->lastRotation.u);
    HashVec3(hash, pin->lastRotation.v);
}

/* Pieces that go when the work at hand is done. */
static void HashLeaving(uint64_t* hash, const kiriSheetData* sheet)
{
    for (int32_t p = 0; p < sheet->layout.pieces.count; ++p) {
        if (sheet->layout.pieces.data[p].isGone) {
            kiriHash_Int32(hash, p);
        }
    }
    for (int32_t k = 0; k < sheet->leaving.count; ++k) {
        kiriHash_Int32(hash, (int32_t)sheet->leaving.data[k]);
    }
    if (sheet->leavingPaid > 0) {
        kiriHash_Int32(hash, (int32_t)sheet->leavingPaid);
    }
}

static void HashWaiting(uint64_t* hash, const kiriWorld* world, const kiriSheetData* sheet)
{
    for (int32_t i = 0; i < sheet->queue.count; ++i) {
        const kiriQueuedPoint* point = &sheet->queue.data[i];
        HashVec2(hash, point->to);
        kiriHash_Int32(hash, point->jump);
        kiriHash_Int32(hash, point->ends);
        kiriHash_Int64(hash, world->ticks - point->stamp);
        kiriHash_Int32(hash, point->cut->index);
    }
    for (int32_t i = 0; i < sheet->cuts.count; ++i) {
        HashVec2(hash, sheet->cuts.data[i]->tip.last);
        HashPoint(hash, sheet->cuts.data[i]->tip.blade.at);
        kiriHash_Int32(hash, sheet->cuts.data[i]->tip.blade.vertex);
        if (sheet->cuts.data[i]->tip.blade.phase != KIRI_BLADE_RESTS) {
            kiriHash_Int32(hash, sheet->cuts.data[i]->tip.blade.phase);
        }
        if (sheet->cuts.data[i]->tip.blade.owed > 0) {
            kiriHash_Int64(hash, sheet->cuts.data[i]->tip.blade.owed);
        }
        kiriHash_Int32(hash, sheet->cuts.data[i]->ended);
    }
    for (int32_t i = 0; i < sheet->pins.count; ++i) {
        HashPin(hash, &sheet->pins.data[i]);
    }
    HashContacts(hash, sheet);
    HashLeaving(hash, sheet);
}

static void HashStrainOffsets(uint64_t* hash, const kiriStrainOffsets* strainOffsets)
{
    for (int32_t k = 0; k < strainOffsets->strainOffsets.count; ++k) {
        for (int e = 0; e < KIRI_STRAINS; ++e) {
            kiriHash_Double(hash, strainOffsets->strainOffsets.data[k].strain[e]);
        }
    }
}

static void HashPinHistory(uint64_t* hash, const kiriPinShares* shares)
{
    for (int32_t k = 0; k < shares->count; ++k) {
        for (int e = 0; e < KIRI_CLAMP_STRAINS; ++e) {
            kiriHash_Double(hash, shares->data[k].offset[e]);
        }
        for (int spring = 0; spring < 2; ++spring) {
            HashWrench(hash, &shares->data[k].reactions[spring].gain);
            HashWrench(hash, &shares->data[k].reactions[spring].pull);
        }
        HashWrench(hash, &shares->data[k].bore);
        HashVec3(hash, shares->data[k].off);
    }
}

static void HashFades(uint64_t* hash, const kiriFades* fades)
{
    kiriHash_Double(hash, fades->time);
    for (int32_t k = 0; k < fades->fading.count; ++k) {
        kiriHash_Int32(hash, fades->fading.data[k].sample);
        kiriHash_Double(hash, fades->fading.data[k].left);
        HashVec3(hash, fades->fading.data[k].offset);
    }
}

static void HashRest(uint64_t* hash, const kiriSheetData* sheet)
{
    kiriHash_Double(hash, sheet->settings.sleepSpeed);
    const kiriPiece* pieces = sheet->layout.pieces.data;
    double least = pieces[0].rest.calm;
    for (int32_t p = 1; p < sheet->layout.pieces.count; ++p) {
        least = kiriMin(pieces[p].rest.calm, least);
    }
    kiriHash_Double(hash, least);
    kiriHash_Int32(hash, sheet->rest.asleep);
    for (int32_t p = 0; p < sheet->layout.pieces.count; ++p) {
        if (pieces[p].rest.calm != least || pieces[p].rest.asleep != sheet->rest.asleep) {
            kiriHash_Int32(hash, p);
            kiriHash_Double(hash, pieces[p].rest.calm);
            kiriHash_Int32(hash, pieces[p].rest.asleep);
        }
    }
    if (sheet->turns.next > 0) {
        kiriHash_Int32(hash, sheet->turns.next);
    }
    HashTouches(hash, &sheet->touches.last, &sheet->touches.slept);
}

/* What it gave sheets and took from them in the last tick does not matter for the coming ones. */
static void HashObstacle(uint64_t* hash, const kiriObstacleData* obstacle)
{
    const kiriObstacleShape* shape = &obstacle->shape;
    kiriHash_Int32(hash, shape->type);
    HashVec3(hash, kiriVec3_Make(shape->radius, shape->half, shape->rounding));
    for (int32_t i = 0; i < shape->count; ++i) {
        HashVec2(hash, shape->outline[i]);
    }
    HashVec3(hash, obstacle->position);
    HashMat3(hash, &obstacle->rotation);
    HashVec3(hash, obstacle->velocity);
    HashVec3(hash, obstacle->spin);
    HashVec3(hash, obstacle->surface);
    HashVec3(hash, kiriVec3_Make(obstacle->friction, obstacle->mass, obstacle->pushSpeed));
    HashMat3(hash, &obstacle->inverseInertia);
    HashVec3(hash, obstacle->center);
    kiriHash_Int32(hash, (int32_t)obstacle->body);
    kiriHash_Int32(hash, (int32_t)obstacle->groups);
    kiriHash_Double(hash, obstacle->drift);
}

/* Which sheet it is, and which of its cuts: ids are no part of the state. */
static void HashLayer(uint64_t* hash, const kiriWorld* world, const kiriLayer* layer)
{
    const kiriSlot *sheet = kiriPool_Find(&world->sheetIds, layer->sheet),
                   *cut = kiriPool_Find(&world->cutIds, layer->cut);
    int32_t index = KIRI_NONE;
    for (int32_t i = 0; sheet != NULL && i < world->sheets.count; ++i) {
        index = world->sheets.data[i] == sheet->owner ? i : index;
    }
    kiriHash_Int32(hash, index);
    kiriHash_Int32(hash, cut != NULL ? ((const kiriCutData*)cut->owner)->index : KIRI_NONE);
    HashVec2(hash, layer->rest);
    HashVec3(hash, layer->at);
    kiriHash_Double(hash, layer->share);
    kiriHash_Int32(hash, layer->loop.isOpen);
    kiriHash_Int32(hash, layer->loop.isPassed);
    HashVec2(hash, layer->loop.start);
    HashVec2(hash, layer->loop.near);
    kiriHash_Double(hash, layer->loop.length);
    kiriHash_Double(hash, layer->loop.then);
}

static void HashBlade(uint64_t* hash, const kiriWorld* world, const kiriBladeData* blade)
{
    const kiriSlot* sheet = kiriPool_Find(&world->sheetIds, blade->sheet);
    kiriHash_Int32(hash, blade->sheet == 0 ? 0 : sheet == NULL ? 1 : 2);
    kiriHash_Int32(hash, blade->isPlaced);
    HashVec3(hash, blade->edge[0]);
    HashVec3(hash, blade->edge[1]);
    kiriHash_Double(hash, blade->elapsed);
    kiriHash_Int32(hash, blade->layers.count);
    for (int32_t i = 0; i < blade->layers.count; ++i) {
        HashLayer(hash, world, &blade->layers.data[i]);
    }
}

static void HashPairs(uint64_t* hash, const kiriPairs* pairs)
{
    for (int32_t i = 0; i < pairs->pairs.count; ++i) {
        kiriHash_Int32(hash, pairs->pairs.data[i].side);
        kiriHash_Int32(hash, pairs->pairs.data[i].touches);
    }
    for (int32_t i = 0; i < pairs->felt.count; ++i) {
        HashVec3(hash, pairs->felt.data[i].force);
    }
}

uint64_t kiriStateHash_Of(const kiriWorld* world)
{
    uint64_t hash = KIRI_HASH_START;
    HashVec3(&hash, world->gravity);
    kiriHash_Int32(&hash, world->budget.triangles);
    kiriHash_Int32(&hash, world->budget.cells);
    kiriHash_Int32(&hash, world->budget.samples);
    kiriHash_Int32(&hash, world->budget.iterations);
    kiriHash_Int32(&hash, world->turn);
    bool isLimited = world->budget.triangles > 0 || world->budget.cells > 0 || world->budget.samples > 0;
    kiriHash_Int32(&hash, isLimited && world->ticks % 2 == 1); /* whose turn it is */
    if (world->samplesDue > 0) {
        kiriHash_Int64(&hash, world->samplesDue);
    }
    for (int32_t i = 0; i < world->blades.count; ++i) {
        HashBlade(&hash, world, world->blades.data[i]);
    }
    HashPairs(&hash, &world->pairs);
    for (int32_t i = 0; i < world->sheets.count; ++i) {
        const kiriSheetData* sheet = world->sheets.data[i];
        HashSettings(&hash, sheet);
        kiriStateHash_AddLayout(&hash, sheet);
        uint64_t pattern = kiriSolver_Hash(sheet->solver);
        kiriHash_Word(&hash, pattern);
        HashWork(&hash, world, sheet);
        HashWaiting(&hash, world, sheet);
        HashRest(&hash, sheet);
        HashStrainOffsets(&hash, &sheet->strainOffsets);
        HashPinHistory(&hash, &sheet->layout.pinShares);
        HashFades(&hash, &sheet->seen.fades);
        HashFades(&hash, &sheet->seen.pointFades);
        for (int32_t f = 0; f < sheet->frames.count; ++f) {
            HashFrame(&hash, &sheet->frames.data[f]);
        }
    }
    for (int32_t i = 0; i < world->obstacles.count; ++i) {
        HashObstacle(&hash, world->obstacles.data[i]);
    }
    return hash;
}
