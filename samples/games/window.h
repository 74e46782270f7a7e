/* A window by SDL2. It shows pictures, plays sounds and listens to mouse, keyboard and touch; nothing else knows
   SDL. */
#ifndef WINDOW_H
#define WINDOW_H

#include "game.h"

typedef struct Window Window;

/* Null: it says on stderr what failed. Without a loudspeaker it is silent. */
Window* Window_Open(const char* title, int32_t width, int32_t height, bool mute);
void Window_Close(Window* window);

/* What the shell itself answers to. */
typedef struct WindowWishes {
    bool quit, pause, slow; /* pause: the key was pressed; slow: it is down */
} WindowWishes;

/* What happened since the last call, for the tick of this number; of the moves of a pointer in a row only the last one.
   Returns how many events there were, `capacity` at most: others come with the next call. */
int32_t Window_Poll(Window* window, int32_t tick, GameEvent* events, int32_t capacity, WindowWishes* wishes);

double Window_GetSeconds(void);
void Window_Show(Window* window, const Image* image);
void Window_PlaySounds(Window* window, Sounds* sounds);

#endif
