/* The games. */
#ifndef GAMES_H
#define GAMES_H

#include "game.h"

#ifdef __cplusplus
extern "C" {
#endif

extern const GameType curtainGame; /* curtain.c */
extern const GameType netGame;     /* net.cpp */

#ifdef __cplusplus
}
#endif

#endif
