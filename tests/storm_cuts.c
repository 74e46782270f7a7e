#include "storm.h"

#include "core/kiri_float.h" /* the storm gives the same bits on every machine */

/* ---- Cuts ---- */

void Storm_Cut(Storm* storm)
{
    enum { POINTS = 6 };
    float points[2 * POINTS];
    for (int32_t i = 0; i < POINTS; i++) {
        Storm_AnyRestPoint(storm, points + 2 * i);
    }
    kiriCut cut = 0;
    int32_t count = 2 + (int32_t)Storm_Random(storm, POINTS - 1);
    Storm_Note(storm, kiriSheet_Cut(storm->world, Storm_AnySheet(storm), points, count, &cut));
}

/* An octagon comes off. */
void Storm_CutDisc(Storm* storm)
{
    static const float corners[18] = { 1.0f, 0.0f,  0.7f,  0.7f, 0.0f,  1.0f, -0.7f, 0.7f, -1.0f,
                                       0.0f, -0.7f, -0.7f, 0.0f, -1.0f, 0.7f, -0.7f, 1.0f, 0.0f };
    float center[2], points[18], radius = Storm_Between(storm, 0.02f, 0.3f);
    Storm_AnyRestPoint(storm, center);
    for (int32_t i = 0; i < 18; i++) {
        points[i] = center[i % 2] + radius * corners[i];
    }
    kiriCut cut = 0;
    Storm_Note(storm, kiriSheet_Cut(storm->world, Storm_AnySheet(storm), points, 9, &cut));
}

/* A cut that goes on for many ticks, and curls. */
void Storm_GoOnCutting(Storm* storm)
{
    if (storm->cut == 0) {
        Storm_AnyRestPoint(storm, storm->tip);
        Storm_Note(storm, kiriBeginCut(storm->world, Storm_AnySheet(storm), storm->tip, &storm->cut));
    }
    storm->tip[0] += Storm_Between(storm, -0.1f, 0.15f);
    storm->tip[1] += Storm_Between(storm, -0.1f, 0.15f);
    Storm_Note(storm, kiriCut_Extend(storm->world, storm->cut, storm->tip, 1));
    if (Storm_Random(storm, 8) == 0) {
        Storm_Note(storm, kiriCut_End(storm->world, storm->cut));
        storm->cut = 0;
    }
}

void Storm_Slice(Storm* storm)
{
    float blade[12];
    for (int corner = 0; corner < 4; corner++) {
        Storm_AnyPlace(storm, blade + 3 * corner);
    }
    kiriCut cut;
    Storm_Note(storm, kiriSheet_Slice(storm->world, Storm_AnySheet(storm), blade, &cut));
}

void Storm_MoveBlade(Storm* storm)
{
    if (storm->blade == 0) {
        Storm_Note(storm, kiriBeginBlade(storm->world, Storm_Random(storm, 2) == 0 ? Storm_AnySheet(storm) : 0,
                                         &storm->blade));
        Storm_AnyPlace(storm, storm->edge[0]);
    }
    float direction[3];
    Storm_Vector(storm, 0.3f, direction);
    for (int i = 0; i < 3; i++) {
        storm->edge[0][i] += 0.5f * direction[i];
        storm->edge[1][i] = storm->edge[0][i] + Storm_Between(storm, -0.2f, 0.2f);
    }
    storm->edge[0][2] += 1.0f;
    storm->edge[1][2] -= 1.0f;
    Storm_Note(storm, kiriBlade_MoveEdge(storm->world, storm->blade, storm->edge[0], storm->edge[1]));
    storm->edge[0][2] -= 1.0f;
    if (Storm_Random(storm, 4) == 0) {
        float down[3] = { 0.1f, 0.1f, -1.0f };
        Storm_Note(storm, kiriBlade_MoveRay(storm->world, storm->blade, storm->edge[0], down, 2.0f));
        Storm_Note(storm, kiriBlade_End(storm->world, storm->blade));
        storm->blade = 0;
    }
}

/* ---- Pieces ---- */

void Storm_TakePiece(Storm* storm)
{
    kiriSheet detached = 0;
    int32_t dropped;
    switch (Storm_Random(storm, 6)) {
    case 0:
        Storm_Note(storm, kiriFrame_DestroyPiece(storm->world, Storm_AnyFrame(storm)));
        break;
    case 1:
        Storm_Note(storm, kiriSheet_DropCrumbs(storm->world, Storm_AnySheet(storm), 0.02f, &dropped));
        break;
    default:
        Storm_Note(storm, kiriFrame_DetachPiece(storm->world, Storm_AnyFrame(storm), &detached));
        Storm_KeepSheet(storm, detached);
        break;
    }
}

void Storm_TakeDetached(Storm* storm)
{
    const kiriEvent* events;
    int32_t count = 0;
    kiriWorld_GetEvents(storm->world, &events, &count);
    for (int32_t i = 0; i < count; i++) {
        bool isNew = events[i].type == KIRI_EVENT_PIECE_DETACHED;
        for (int32_t k = 0; isNew && k < storm->sheetCount; k++) {
            isNew = storm->sheets[k] != events[i].sheet;
        }
        if (isNew && storm->sheetCount < STORM_SHEETS) {
            storm->sheets[storm->sheetCount++] = events[i].sheet;
        }
    }
}
