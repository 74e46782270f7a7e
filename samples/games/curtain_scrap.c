/* Parts that came off: marks that fall into the basket count, the others are swept away. */
#include "curtain_parts.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum {
    BASKET_TICKS = 60,             /* a mark is ours when it has been in the basket for so long */
    LEAST_SCRAP_TICKS = GAME_RATE, /* when there are many scraps the oldest is swept away, but none younger than this */
    MANY_SCRAPS = 10,
    CRUMB_TICKS = 2 * GAME_RATE /* how often crumbs are swept away */
};

/* Of the same in one tick the first one is enough. */
static void AddNote(Curtain* curtain, const float place[3], const char* text)
{
    for (int32_t i = 0; i < MAX_NOTES; i++) {
        if (curtain->notes[i].since == curtain->tick && strcmp(curtain->notes[i].text, text) == 0) {
            return;
        }
    }
    Note* note = &curtain->notes[curtain->noteCount++ % MAX_NOTES];
    snprintf(note->text, sizeof note->text, "%s", text);
    memcpy(note->place, place, sizeof note->place);
    note->since = curtain->tick;
}

/* Whether a ring or a hand holds the piece. */
bool Curtain_IsHeld(const Curtain* curtain, const Cloth* cloth, int32_t piece)
{
    kiriPin pins[MAX_RINGS + MAX_HANDS];
    int32_t count = 0, other;
    kiriSheet_GetPins(curtain->world, cloth->sheet, pins, MAX_RINGS + MAX_HANDS, &count);
    for (int32_t i = 0; i < count && i < MAX_RINGS + MAX_HANDS; i++) {
        kiriPinState pin;
        kiriPointState point;
        if (kiriPin_GetState(curtain->world, pins[i], &pin) == KIRI_OK &&
            kiriSheet_GetPoint(curtain->world, cloth->sheet, pin.from, &point) == KIRI_OK &&
            kiriFrame_GetPiece(curtain->world, point.frame, &other) == KIRI_OK && other == piece) {
            return true;
        }
    }
    return false;
}

static bool IsInBasket(const Curtain* curtain, const kiriPieceState* piece)
{
    return fabs(piece->center[0] - curtain->basketX) < 0.5 * basketSize[0] &&
           fabs(piece->center[1] - basketY) < 0.5 * basketSize[1] && piece->center[2] < basketSize[2] + 0.05;
}

/* The mark whose middle is in the piece and that nobody has yet; -1: none. */
static int32_t FindMark(const Curtain* curtain, const Cloth* cloth, int32_t piece)
{
    for (int32_t m = 0; m < curtain->level->marks; m++) {
        kiriPointState point;
        int32_t other = -1;
        if (!cloth->collected[m] &&
            kiriSheet_GetPoint(curtain->world, cloth->sheet, curtain->level->mark[m].middle, &point) == KIRI_OK &&
            kiriFrame_GetPiece(curtain->world, point.frame, &other) == KIRI_OK && other == piece) {
            return m;
        }
    }
    return -1;
}

/* A hundred points for a mark that is cut to the line; none for one that is half as large again. */
static void Collect(Curtain* curtain, Cloth* cloth, int32_t mark, const kiriPieceState* piece)
{
    float corners[2 * MARK_CORNERS], wanted = Mark_GetOutline(&curtain->level->mark[mark], corners);
    float off = fabsf((float)piece->area - wanted) / wanted;
    int32_t points = (int32_t)(100.0f * fmaxf(0.0f, 1.0f - 2.0f * off));
    const float place[3] = { (float)piece->center[0], (float)piece->center[1], basketSize[2] };
    char text[24];
    snprintf(text, sizeof text, points > 0 ? "+%d" : "too rough", points);
    AddNote(curtain, place, text);
    cloth->collected[mark] = true;
    curtain->score += points;
    curtain->collected += points > 0;
    Sounds_Play(curtain->host.sounds, points > 0 ? SOUND_GOAL : SOUND_LOST, 0.8f);
}

/* True when the scrap is to be taken out of the list. */
static bool LookAtScrap(Curtain* curtain, Scrap* scrap)
{
    Cloth* cloth = &curtain->cloths[scrap->cloth];
    kiriPieceState state;
    int32_t piece, age = curtain->tick - scrap->offAt;
    if (kiriFrame_GetPiece(curtain->world, scrap->frame, &piece) != KIRI_OK ||
        kiriSheet_GetPiece(curtain->world, cloth->sheet, piece, &state) != KIRI_OK) {
        return true; /* it is gone */
    }
    if (!IsInBasket(curtain, &state)) {
        scrap->inBasketSince = 0;
    } else if (scrap->inBasketSince == 0) {
        scrap->inBasketSince = curtain->tick;
    } else if (curtain->tick - scrap->inBasketSince == BASKET_TICKS) {
        int32_t mark = FindMark(curtain, cloth, piece);
        if (mark >= 0) {
            Collect(curtain, cloth, mark, &state);
        }
    }
    bool tooMany = curtain->scrapCount > MANY_SCRAPS && age > LEAST_SCRAP_TICKS;
    if ((age > SCRAP_TICKS || tooMany) && !Curtain_IsHeld(curtain, cloth, piece)) {
        return kiriFrame_DestroyPiece(curtain->world, scrap->frame) >= 0; /* also where it waits */
    }
    return false;
}

/* From the oldest to the newest. */
void Curtain_LookAtScraps(Curtain* curtain)
{
    for (int32_t i = 0; i < curtain->scrapCount; i++) {
        if (LookAtScrap(curtain, &curtain->scraps[i])) {
            curtain->scrapCount--;
            memmove(&curtain->scraps[i], &curtain->scraps[i + 1], sizeof(Scrap) * (size_t)(curtain->scrapCount - i));
            i--;
        }
    }
}

void Curtain_AddScrap(Curtain* curtain, const kiriEvent* event)
{
    int32_t cloth = Curtain_FindCloth(curtain, event->sheet);
    if (cloth >= 0 && event->crumb == 0) {
        if (curtain->scrapCount == MAX_SCRAPS) {
            kiriFrame_DestroyPiece(curtain->world, curtain->scraps[0].frame);
            memmove(curtain->scraps, curtain->scraps + 1, sizeof(Scrap) * (size_t)--curtain->scrapCount);
        }
        curtain->scraps[curtain->scrapCount++] = (Scrap){ event->frame, cloth, curtain->tick, 0 };
    }
}

/* A ring or a hand. */
void Curtain_BreakPin(Curtain* curtain, kiriPin pin)
{
    for (int32_t i = 0; i < MAX_HANDS; i++) {
        curtain->hands[i].pin = curtain->hands[i].pin == pin ? 0 : curtain->hands[i].pin;
    }
    for (int32_t i = 0; i < MAX_CLOTHS * MAX_RINGS; i++) {
        Ring* ring = &curtain->cloths[i / MAX_RINGS].rings[i % MAX_RINGS];
        if (ring->pin == pin) {
            ring->pin = 0;
            AddNote(curtain, ring->target, "snap");
            Sounds_Play(curtain->host.sounds, SOUND_SNAP, 0.8f);
        }
    }
}

void Curtain_SweepCrumbs(Curtain* curtain)
{
    for (int32_t i = 0; i < MAX_CLOTHS && curtain->tick % CRUMB_TICKS == 0; i++) {
        int32_t count;
        if (curtain->cloths[i].sheet != 0) {
            kiriSheet_DropCrumbs(curtain->world, curtain->cloths[i].sheet, crumbArea, &count);
        }
    }
}
