/* Where pins and held frames hold the sheet in the steps of a tick.

   What the host moves goes on evenly: each step takes its part of the way.

   What is seen is what is held: a smooth surface (KIRI_SKINNING_SMOOTH) lies off where a frame by itself has a point. A
   pin holds that point of its frame, so its target is moved by as much as the frame's own point is off what was seen
   last; so is a held frame. A clamp's own point is its line: its pose is moved by what is seen off the line, more and
   more until the mean along the line is zero. All that it holds of a piece is moved as one: a line that bends would
   curl the sheet. That takes some ticks; when it changes no more the sheet may sleep. Hinges turn freely, so the
   surface does not bend at them, and is seen on the line anyway.

   An obstacle with mass yields to a pin. Its host will give it the impulses of the whole tick at once, before it moves
   it: so it does here. With W the velocity that an impulse gives the target, and J what the pin has given so far in the
   tick, the target is t W J away at the time t of the tick, and the force F of a step of h moves it by t h W F. */
#ifndef KIRI_FOLLOW_H
#define KIRI_FOLLOW_H

#include "kiri_pin.h"
#include "kiri_point.h"

KIRI_C_BEGIN

/* At the start of a tick of dt. */
void kiriFollow_Begin(kiriSheetData* sheet, double dt);

/* Before step i of n, of h seconds. */
void kiriFollow_Step(kiriSheetData* sheet, int32_t i, int32_t n, double h);

KIRI_C_END

#endif
