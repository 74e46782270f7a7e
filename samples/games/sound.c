#include "sound.h"

#include <math.h>
#include <string.h>

static const float twoPi = 6.2831853f;

void Sounds_Init(Sounds* sounds)
{
    memset(sounds, 0, sizeof *sounds);
    sounds->seed = 1;
    for (int i = 0; i < SOUND_VOICES; i++) {
        sounds->voices[i].at = -1;
    }
}

/* A voice that hisses already goes on: a cut is one sound, however many ticks it takes. */
static SoundVoice* FindVoice(Sounds* sounds, int32_t type)
{
    SoundVoice* oldest = &sounds->voices[0];
    for (int i = 0; i < SOUND_VOICES; i++) {
        SoundVoice* voice = &sounds->voices[i];
        if (type == SOUND_CUT && voice->type == SOUND_CUT && voice->at >= 0) {
            return voice;
        }
        if (oldest->at >= 0 && (voice->at < 0 || voice->at > oldest->at)) {
            oldest = voice;
        }
    }
    return oldest;
}

void Sounds_Play(Sounds* sounds, int32_t type, float volume)
{
    SoundVoice* voice = FindVoice(sounds, type);
    bool goesOn = type == SOUND_CUT && voice->type == SOUND_CUT && voice->at >= 0;
    sounds->seed = sounds->seed * 1664525u + 1013904223u;
    voice->type = type;
    voice->volume = volume < 0.0f ? 0.0f : volume > 1.0f ? 1.0f : volume;
    voice->at = goesOn && voice->at > 400 ? 400 : goesOn ? voice->at : 0;
    voice->noise = goesOn ? voice->noise : sounds->seed;
    voice->low = goesOn ? voice->low : 0.0f;
}

static float GetNoise(SoundVoice* voice)
{
    voice->noise = voice->noise * 1664525u + 1013904223u;
    return (float)(voice->noise >> 8) / 8388608.0f - 1.0f;
}

/* Notes of equal length, one after the other. */
static float PlayNotes(float t, const float* pitches, int count, float length)
{
    int note = (int)(t / length);
    if (note >= count) {
        return 0.0f;
    }
    float since = t - (float)note * length;
    return (sinf(twoPi * pitches[note] * t) + 0.3f * sinf(2.0f * twoPi * pitches[note] * t)) * expf(-6.0f * since);
}

static float GetSample(SoundVoice* voice)
{
    static const float up[3] = { 523.3f, 659.3f, 784.0f }, down[2] = { 392.0f, 261.6f };
    float t = (float)voice->at / SOUND_RATE, noise;
    switch (voice->type) {
    case SOUND_CUT: /* noise without its low part */
        noise = GetNoise(voice);
        voice->low += 0.35f * (noise - voice->low);
        return 0.35f * (noise - voice->low) * fminf(1.0f, 120.0f * t) * expf(-28.0f * t);
    case SOUND_THUD: /* a drum whose pitch falls */
        voice->low += 0.04f * (GetNoise(voice) - voice->low);
        return (0.8f * sinf(twoPi * (50.0f * t + 1.5f * (1.0f - expf(-30.0f * t)))) + 1.2f * voice->low) *
               expf(-16.0f * t);
    case SOUND_CLACK:
        voice->low += 0.4f * (GetNoise(voice) - voice->low);
        return 0.7f * (voice->low * expf(-120.0f * t) + 0.5f * sinf(twoPi * 620.0f * t) * expf(-45.0f * t));
    case SOUND_SNAP:
        return 0.6f * (GetNoise(voice) * expf(-260.0f * t) + 0.4f * sinf(twoPi * 1500.0f * t) * expf(-60.0f * t));
    case SOUND_GOAL:
        return 0.4f * PlayNotes(t, up, 3, 0.12f);
    default:
        return 0.4f * PlayNotes(t, down, 2, 0.25f);
    }
}

void Sounds_Mix(Sounds* sounds, float* samples, int32_t count)
{
    memset(samples, 0, sizeof(float) * (size_t)count);
    for (int v = 0; v < SOUND_VOICES; v++) {
        SoundVoice* voice = &sounds->voices[v];
        for (int32_t i = 0; i < count && voice->at >= 0; i++) {
            samples[i] += voice->volume * GetSample(voice);
            voice->at = voice->at < SOUND_RATE ? voice->at + 1 : -1;
        }
    }
    for (int32_t i = 0; i < count; i++) {
        samples[i] = samples[i] / (1.0f + fabsf(samples[i])); /* never louder than the loudspeaker */
    }
}
