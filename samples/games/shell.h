/* Runs games: fixed ticks from an accumulator, pictures between the last two of them, in a window or from a script
   without one. Both do the same: they differ in who gives the time and the events. */
#ifndef SHELL_H
#define SHELL_H

#include "game.h"

/* What main does, with its arguments; `games` ends with null. */
int Shell_Run(int count, char** words, const GameType* const* games);

#endif
