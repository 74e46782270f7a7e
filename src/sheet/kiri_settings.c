#include "kiri_settings.h"

#include "kiri_motion.h"
#include "kiri_seen.h"

#include <string.h>

/* Of a grid square: thinner sheets would need a finer search for what touches. */
#define LEAST_CONTACT_THICKNESS 0.05

kiriSheetSettings kiriSettings_Of(const kiriSheetDef* def)
{
    kiriSheetSettings given;
    memset(&given, 0, sizeof(given));
    given.material = def->material;
    given.maxFrames = def->maxFrames > 0 && def->maxFrames < def->frameCount ? def->frameCount : def->maxFrames;
    given.crumbArea = def->crumbArea;
    given.friction = def->friction;
    given.contactThickness = def->contactThickness;
    given.groups = def->groups;
    given.touchesSheets = def->touchesSheets;
    given.iterations = def->iterations;
    given.sleepSpeed = def->sleepSpeed;
    given.skinning = def->skinning;
    given.timeStepping = def->timeStepping;
    given.fadeTime = def->fadeTime;
    given.normals = def->normals;
    return given;
}

static double ContactThickness(const kiriSheetSettings* given, double square)
{
    double least = LEAST_CONTACT_THICKNESS * square, own = given->material.thickness;
    return given->contactThickness > 0.0f ? given->contactThickness : kiriMax(own, least);
}

void kiriSettings_Take(kiriSettings* settings, const kiriSheetSettings* given, double square)
{
    settings->given = *given;
    settings->given.cookie = 0;
    settings->material = given->material;
    settings->maxFrames = given->maxFrames;
    settings->crumbArea = given->crumbArea;
    settings->friction = given->friction;
    settings->contactThickness = ContactThickness(given, square);
    settings->groups = given->groups;
    settings->touchesSheets = given->touchesSheets != 0;
    settings->iterations = given->iterations;
    settings->sleepSpeed = given->sleepSpeed;
    settings->skinning = given->skinning;
    settings->mechanics.timeStepping = given->timeStepping;
    settings->fadeTime = settings->popping ? 0.0 : given->fadeTime;
}

void kiriSettings_Apply(kiriSheetData* sheet)
{
    const kiriSettings* settings = &sheet->settings;
    sheet->shape.rigidWeight = settings->rigidWeight;
    sheet->shape.eased = settings->eased;
    sheet->seen.surface.skinning = settings->skinning;
    sheet->seen.surface.wantsNormals = settings->given.normals != 0;
    sheet->seen.fades.time = sheet->seen.pointFades.time = settings->fadeTime;
    sheet->seen.fades.least = sheet->seen.pointFades.least = settings->leastFade;
}

/* ---- Change --------------------------------------------------------------------------------------------------- */

static bool IsSameMaterial(const kiriMaterial* a, const kiriMaterial* b)
{
    return a->youngsModulus == b->youngsModulus && a->poissonsRatio == b->poissonsRatio &&
           a->thickness == b->thickness && a->density == b->density && a->airDamping == b->airDamping &&
           a->flexDamping == b->flexDamping;
}

static bool AreSameSettings(const kiriSheetSettings* a, const kiriSheetSettings* b)
{
    return IsSameMaterial(&a->material, &b->material) && a->maxFrames == b->maxFrames && a->crumbArea == b->crumbArea &&
           a->friction == b->friction && a->contactThickness == b->contactThickness && a->groups == b->groups &&
           a->touchesSheets == b->touchesSheets && a->iterations == b->iterations && a->sleepSpeed == b->sleepSpeed &&
           a->skinning == b->skinning && a->timeStepping == b->timeStepping && a->fadeTime == b->fadeTime &&
           a->normals == b->normals;
}

/* The solver counts corners only where Poisson's ratio is above 0. What it had staged for an update is staged again
   before the commit: PrepareCommit and the commit are of one tick. */
static bool StageSolver(kiriSheetData* sheet, const kiriSheetSettings* given)
{
    kiriSystem system;
    memset(&system, 0, sizeof(system));
    system.mechanics = sheet->settings.mechanics;
    system.material = given->material;
    system.frameCount = sheet->frames.count;
    system.links = sheet->links.links.data;
    system.linkCount = sheet->links.links.count;
    system.corners = sheet->links.corners.data;
    system.cornerCount = sheet->links.corners.count;
    system.areaElements = &sheet->layout.areaElements;
    return kiriSolver_Stage(sheet->solver, &system, sheet->layout.framePiece.data, sheet->layout.pieces.count);
}

/* Poses and velocities stay. The next commit takes masses from the regions' exact moments again. */
static void Weigh(kiriSheetData* sheet, const kiriMaterial* before)
{
    const kiriMaterial* now = &sheet->settings.material;
    double was = (double)before->density * before->thickness, is = (double)now->density * now->thickness;
    for (int32_t i = 0; i < sheet->frames.count; ++i) {
        kiriFrameData* frame = &sheet->frames.data[i];
        frame->mass = is * frame->area;
        for (int k = 0; k < 3; ++k) {
            frame->inertia[k] *= is / was;
        }
        memset(&frame->history, 0, sizeof(frame->history));
        sheet->regions.dirty.data[i] = 1;
    }
    kiriLinks_BeginAgain(&sheet->links);
}

/* Without fadeTime links and clamps do not go on with their strains (kiri_strain_offset.h). */
static void DropOffsets(kiriSheetData* sheet)
{
    sheet->strainOffsets.strainOffsets.count = 0;
    for (int32_t k = 0; k < sheet->layout.pinShares.count; ++k) {
        memset(sheet->layout.pinShares.data[k].offset, 0, sizeof(sheet->layout.pinShares.data[k].offset));
    }
}

bool kiriSettings_Change(kiriSheetData* sheet, const kiriSheetSettings* given)
{
    kiriSheetSettings before = sheet->settings.given;
    if (AreSameSettings(&before, given)) {
        return true;
    }
    bool looksOther = sheet->seen.isElsewhere || given->skinning != before.skinning;
    bool isOther = !IsSameMaterial(&given->material, &before.material);
    if ((looksOther && !kiriView_ReserveFades(sheet, sheet->points.count, given->fadeTime)) ||
        (isOther && !StageSolver(sheet, given))) {
        return false;
    }
    kiriSettings_Take(&sheet->settings, given, sheet->mesh.step * sheet->mesh.squares.side);
    kiriSettings_Apply(sheet);
    sheet->seen.isElsewhere |= looksOther;
    if (sheet->seen.surface.wantsNormals) {
        kiriSurface_NeedNormals(&sheet->seen.surface);
    }
    if (!kiriSheet_KeepsStrains(sheet)) {
        DropOffsets(sheet);
    }
    if (isOther) {
        kiriSolver_Commit(sheet->solver);
        Weigh(sheet, &before.material);
    }
    kiriMotion_Wake(sheet);
    return true;
}
