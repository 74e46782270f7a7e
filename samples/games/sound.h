/* Sounds made by code. A game says what is to be heard; who shows the game takes the samples, or nobody does. */
#ifndef SOUND_H
#define SOUND_H

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

enum SoundType {
    SOUND_CUT,   /* a short hiss: call it again in each tick in which the blade cuts */
    SOUND_THUD,  /* something soft and heavy lands */
    SOUND_CLACK, /* something hard lands */
    SOUND_SNAP,  /* a thread breaks */
    SOUND_GOAL,  /* three notes up */
    SOUND_LOST,  /* two notes down */
    SOUND_COUNT
};

enum { SOUND_RATE = 44100, SOUND_VOICES = 16 };

typedef struct SoundVoice {
    int32_t type;
    int32_t at; /* samples played; below 0: not in use */
    float volume;
    uint32_t noise;
    float low; /* state of a filter */
} SoundVoice;

typedef struct Sounds {
    SoundVoice voices[SOUND_VOICES];
    uint32_t seed;
} Sounds;

void Sounds_Init(Sounds* sounds);

/* Volume 0 to 1. With all voices in use the oldest one ends. */
void Sounds_Play(Sounds* sounds, int32_t type, float volume);

/* The next samples, -1 to 1, mono. */
void Sounds_Mix(Sounds* sounds, float* samples, int32_t count);

#ifdef __cplusplus
}
#endif

#endif
