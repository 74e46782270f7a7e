/* What pointers and keys do: blades, hands that pull, the basket. */
#include "curtain_parts.h"

#include <math.h>
#include <string.h>

static const float basketPace = 0.5f;     /* m/s */
static const float handStiffness = 60.0f; /* N/m */
static const float handForce = 7.0f;      /* N: with more it slips out of the fingers */

static void LetGo(Curtain* curtain, Hand* hand)
{
    if (hand->pin != 0) {
        kiriDestroyPin(curtain->world, hand->pin); /* it may be gone already, with what it held */
    }
    hand->pin = 0;
}

static Hand* FindHand(Curtain* curtain, int32_t pointer)
{
    for (int32_t i = 0; i < MAX_HANDS; i++) {
        if (curtain->hands[i].pin != 0 && curtain->hands[i].pointer == pointer) {
            return &curtain->hands[i];
        }
    }
    return NULL;
}

/* A pin in the material that the ray meets. With all hands in use the first one lets go. */
static void Grab(Curtain* curtain, int32_t pointer, const float origin[3], const float direction[3])
{
    kiriSheet sheet = 0;
    kiriHit hit;
    kiriWorld_Raycast(curtain->world, origin, direction, 20.0f, &sheet, &hit);
    if (sheet == 0) {
        return;
    }
    Hand* hand = &curtain->hands[0];
    for (int32_t i = 0; i < MAX_HANDS && hand->pin != 0; i++) {
        hand = curtain->hands[i].pin == 0 ? &curtain->hands[i] : hand;
    }
    LetGo(curtain, hand);
    kiriPinDef def;
    kiriDefaultPinDef(&def);
    memcpy(def.restPoint, hit.restPoint, sizeof def.restPoint);
    memcpy(def.target, hit.position, sizeof def.target);
    def.stiffness = handStiffness;
    def.breakForce = handForce;
    if (kiriCreatePin(curtain->world, sheet, &def, &hand->pin) == KIRI_OK) {
        hand->cloth = Curtain_FindCloth(curtain, sheet);
        hand->pointer = pointer;
        hand->away = hit.distance - 0.08f; /* a little towards the player */
        memcpy(hand->target, hit.position, sizeof hand->target);
    }
}

static void MoveHand(Curtain* curtain, Hand* hand, const float origin[3], const float direction[3])
{
    for (int i = 0; i < 3; i++) {
        hand->target[i] = origin[i] + hand->away * direction[i];
    }
    hand->target[2] = fmaxf(hand->target[2], 0.02f);
    if (kiriPin_SetTarget(curtain->world, hand->pin, hand->target) != KIRI_OK) {
        hand->pin = 0; /* what it held is gone */
    }
}

static void PointerDown(Curtain* curtain, const GameEvent* event, const float origin[3], const float direction[3])
{
    Pointer* pointer = &curtain->pointers[event->pointer];
    if (event->button == GAME_RIGHT) {
        Grab(curtain, event->pointer, origin, direction);
        return;
    }
    Curtain_Keep(curtain);
    if (kiriBeginBlade(curtain->world, 0, &pointer->blade) == KIRI_OK) {
        kiriBlade_MoveRay(curtain->world, pointer->blade, origin, direction, 20.0f);
        pointer->trailCount = 0;
    }
}

static void PointerMove(Curtain* curtain, const GameEvent* event, const float origin[3], const float direction[3])
{
    Pointer* pointer = &curtain->pointers[event->pointer];
    Hand* hand = FindHand(curtain, event->pointer);
    if (pointer->blade != 0) {
        kiriBlade_MoveRay(curtain->world, pointer->blade, origin, direction, 20.0f);
    }
    if (hand != NULL) {
        MoveHand(curtain, hand, origin, direction);
    }
}

static void PointerUp(Curtain* curtain, const GameEvent* event)
{
    Pointer* pointer = &curtain->pointers[event->pointer];
    Hand* hand = FindHand(curtain, event->pointer);
    if (event->button == GAME_RIGHT && hand != NULL) {
        LetGo(curtain, hand);
    } else if (event->button == GAME_LEFT && pointer->blade != 0) {
        kiriBlade_End(curtain->world, pointer->blade);
        pointer->blade = 0;
    }
}

/* Space: hands that pull stay where they are; with none that does, all let go. */
void Curtain_KeepHands(Curtain* curtain)
{
    int32_t kept = 0;
    for (int32_t i = 0; i < MAX_HANDS; i++) {
        if (curtain->hands[i].pin != 0 && curtain->hands[i].pointer >= 0) {
            curtain->hands[i].pointer = -1;
            kept++;
        }
    }
    for (int32_t i = 0; i < MAX_HANDS && kept == 0; i++) {
        LetGo(curtain, &curtain->hands[i]);
    }
}

static void Key(Curtain* curtain, const GameEvent* event)
{
    float way = event->key == GAME_KEY_LEFT || event->key == 'a'    ? -1.0f
                : event->key == GAME_KEY_RIGHT || event->key == 'd' ? 1.0f
                                                                    : 0.0f;
    bool pressed = event->type == GAME_KEY_PRESSED;
    if (way != 0.0f && (pressed || curtain->basketSpeed * way > 0.0f)) {
        curtain->basketSpeed = pressed ? way * basketPace : 0.0f;
    } else if (event->key == ' ' && pressed) {
        Curtain_KeepHands(curtain);
    } else if (event->key == 'z' && pressed) {
        Curtain_Undo(curtain);
    }
}

void Curtain_Event(void* game, const GameEvent* event)
{
    Curtain* curtain = game;
    if (event->type == GAME_KEY_PRESSED || event->type == GAME_KEY_RELEASED) {
        Key(curtain, event);
        return;
    }
    if (event->pointer < 0 || event->pointer >= MAX_POINTERS) {
        return;
    }
    float origin[3], direction[3];
    CanvasCamera_GetRay(&curtainCamera, (float)event->x, (float)event->y, origin, direction);
    curtain->pointers[event->pointer].x = event->x;
    curtain->pointers[event->pointer].y = event->y;
    if (event->type == GAME_DOWN) {
        PointerDown(curtain, event, origin, direction);
    } else if (event->type == GAME_MOVE) {
        PointerMove(curtain, event, origin, direction);
    } else {
        PointerUp(curtain, event);
    }
}
