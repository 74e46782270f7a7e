#include "window.h"

#include <SDL2/SDL.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_FINGERS = 10, SOUND_BLOCK = 512, SOUND_AHEAD = 3 * SOUND_BLOCK };

struct Window {
    SDL_Window* window;
    SDL_Renderer* renderer;
    SDL_Texture* texture;
    int32_t width, height; /* of the pictures */
    SDL_AudioDeviceID loudspeaker;
    bool mute;
    double shown; /* s: when the last picture was to be seen */
    SDL_FingerID fingers[MAX_FINGERS];
    bool fingerDown[MAX_FINGERS];
};

static bool OpenPicture(Window* window, const char* title)
{
    SDL_SetHint(SDL_HINT_TOUCH_MOUSE_EVENTS, "0");
    SDL_SetHint(SDL_HINT_RENDER_SCALE_QUALITY, "linear");
    SDL_SetHint(SDL_HINT_FRAMEBUFFER_ACCELERATION, "0"); /* functions of libGL have the names of those of OSMesa */
    window->window = SDL_CreateWindow(title, SDL_WINDOWPOS_CENTERED, SDL_WINDOWPOS_CENTERED, GAME_WIDTH, GAME_HEIGHT,
                                      SDL_WINDOW_RESIZABLE | SDL_WINDOW_ALLOW_HIGHDPI);
    if (window->window != NULL) {
        window->renderer = SDL_CreateRenderer(window->window, -1, SDL_RENDERER_SOFTWARE);
    }
    if (window->renderer != NULL) {
        SDL_RenderSetLogicalSize(window->renderer, GAME_WIDTH, GAME_HEIGHT); /* events are scaled, too */
        window->texture = SDL_CreateTexture(window->renderer, SDL_PIXELFORMAT_RGB24, SDL_TEXTUREACCESS_STREAMING,
                                            window->width, window->height);
    }
    return window->texture != NULL;
}

static void OpenLoudspeaker(Window* window)
{
    SDL_AudioSpec wanted = { .freq = SOUND_RATE, .format = AUDIO_F32SYS, .channels = 1, .samples = SOUND_BLOCK };
    if (SDL_InitSubSystem(SDL_INIT_AUDIO) == 0) {
        window->loudspeaker = SDL_OpenAudioDevice(NULL, 0, &wanted, NULL, 0);
    }
    if (window->loudspeaker != 0) {
        SDL_PauseAudioDevice(window->loudspeaker, 0);
    }
}

Window* Window_Open(const char* title, int32_t width, int32_t height, bool mute)
{
    Window* window = calloc(1, sizeof(Window));
    if (window == NULL) {
        return NULL;
    }
    window->width = width;
    window->height = height;
    window->mute = mute;
    if (SDL_Init(SDL_INIT_VIDEO) != 0 || !OpenPicture(window, title)) {
        fprintf(stderr, "no window: %s\n", SDL_GetError());
        Window_Close(window);
        return NULL;
    }
    OpenLoudspeaker(window);
    return window;
}

void Window_Close(Window* window)
{
    if (window->loudspeaker != 0) {
        SDL_CloseAudioDevice(window->loudspeaker);
    }
    if (window->texture != NULL) {
        SDL_DestroyTexture(window->texture);
    }
    if (window->renderer != NULL) {
        SDL_DestroyRenderer(window->renderer);
    }
    if (window->window != NULL) {
        SDL_DestroyWindow(window->window);
    }
    SDL_Quit();
    free(window);
}

/* ---- Events ----------------------------------------------------------------------------------------------------- */

/* The pointer of a finger, 1 and up, and one for it when it is new; 0 when there are too many. */
static int32_t GetPointer(Window* window, SDL_FingerID finger)
{
    int32_t unused = -1;
    for (int32_t i = 0; i < MAX_FINGERS; i++) {
        if (window->fingerDown[i] && window->fingers[i] == finger) {
            return i + 1;
        }
        unused = unused < 0 && !window->fingerDown[i] ? i : unused;
    }
    if (unused >= 0) {
        window->fingers[unused] = finger;
    }
    return unused + 1;
}

static bool TranslateFinger(Window* window, const SDL_TouchFingerEvent* touch, GameEvent* event)
{
    event->pointer = GetPointer(window, touch->fingerId);
    if (event->pointer == 0) {
        return false;
    }
    event->type = touch->type == SDL_FINGERDOWN ? GAME_DOWN : touch->type == SDL_FINGERUP ? GAME_UP : GAME_MOVE;
    event->button = event->pointer == 1 ? GAME_LEFT : GAME_RIGHT;
    event->x = (int32_t)(touch->x * GAME_WIDTH);
    event->y = (int32_t)(touch->y * GAME_HEIGHT);
    window->fingerDown[event->pointer - 1] = event->type != GAME_UP;
    return true;
}

static bool TranslateKey(const SDL_KeyboardEvent* key, GameEvent* event)
{
    SDL_Keycode code = key->keysym.sym;
    event->type = key->type == SDL_KEYDOWN ? GAME_KEY_PRESSED : GAME_KEY_RELEASED;
    if ((code >= 'a' && code <= 'z') || (code >= '0' && code <= '9') || code == ' ') {
        event->key = code;
    } else {
        event->key = code == SDLK_LEFT    ? GAME_KEY_LEFT
                     : code == SDLK_RIGHT ? GAME_KEY_RIGHT
                     : code == SDLK_UP    ? GAME_KEY_UP
                     : code == SDLK_DOWN  ? GAME_KEY_DOWN
                                          : 0;
    }
    return event->key != 0 && key->repeat == 0;
}

static bool TranslateMouse(const SDL_Event* from, GameEvent* event)
{
    if (from->type == SDL_MOUSEMOTION) {
        event->type = GAME_MOVE;
        event->x = from->motion.x;
        event->y = from->motion.y;
        return from->motion.which != SDL_TOUCH_MOUSEID;
    }
    event->type = from->type == SDL_MOUSEBUTTONDOWN ? GAME_DOWN : GAME_UP;
    event->button = from->button.button == SDL_BUTTON_LEFT ? GAME_LEFT : GAME_RIGHT;
    event->x = from->button.x;
    event->y = from->button.y;
    return from->button.which != SDL_TOUCH_MOUSEID;
}

/* What the shell answers to itself. */
static bool IsWish(Window* window, const SDL_Event* from, WindowWishes* wishes)
{
    if (from->type == SDL_QUIT) {
        return wishes->quit = true;
    }
    if (from->type != SDL_KEYDOWN && from->type != SDL_KEYUP) {
        return false;
    }
    bool down = from->type == SDL_KEYDOWN, pressed = down && from->key.repeat == 0;
    switch (from->key.keysym.sym) {
    case SDLK_ESCAPE:
        return wishes->quit = true;
    case SDLK_p:
        wishes->pause = wishes->pause != pressed;
        return true;
    case SDLK_s:
        wishes->slow = down;
        return true;
    case SDLK_m:
        window->mute = window->mute != pressed;
        return true;
    default:
        return false;
    }
}

static bool Translate(Window* window, const SDL_Event* from, GameEvent* event)
{
    switch (from->type) {
    case SDL_MOUSEMOTION:
    case SDL_MOUSEBUTTONDOWN:
    case SDL_MOUSEBUTTONUP:
        return TranslateMouse(from, event);
    case SDL_KEYDOWN:
    case SDL_KEYUP:
        return TranslateKey(&from->key, event);
    case SDL_FINGERDOWN:
    case SDL_FINGERUP:
    case SDL_FINGERMOTION:
        return TranslateFinger(window, &from->tfinger, event);
    default:
        return false;
    }
}

int32_t Window_Poll(Window* window, int32_t tick, GameEvent* events, int32_t capacity, WindowWishes* wishes)
{
    int32_t count = 0;
    SDL_Event from;
    while (count < capacity && SDL_PollEvent(&from)) {
        GameEvent event = { .tick = tick };
        if (IsWish(window, &from, wishes) || !Translate(window, &from, &event)) {
            continue;
        }
        GameEvent* last = count > 0 ? &events[count - 1] : NULL;
        if (last != NULL && last->type == GAME_MOVE && event.type == GAME_MOVE && last->pointer == event.pointer) {
            *last = event;
        } else {
            events[count++] = event;
        }
    }
    return count;
}

/* ---- Pictures and sounds ---------------------------------------------------------------------------------------- */

double Window_GetSeconds(void)
{
    return (double)SDL_GetPerformanceCounter() / (double)SDL_GetPerformanceFrequency();
}

/* No faster than games tick. */
void Window_Show(Window* window, const Image* image)
{
    SDL_UpdateTexture(window->texture, NULL, image->rgb, 3 * image->width);
    SDL_SetRenderDrawColor(window->renderer, 0, 0, 0, 255);
    SDL_RenderClear(window->renderer);
    SDL_RenderCopy(window->renderer, window->texture, NULL, NULL);
    SDL_RenderPresent(window->renderer);
    double now = Window_GetSeconds(), next = window->shown + 1.0 / GAME_RATE;
    if (now < next) {
        SDL_Delay((uint32_t)(1e3 * (next - now)));
    }
    window->shown = next > now - 0.1 ? next : now;
}

/* Keeps some blocks ready, so that a late picture is not heard. */
void Window_PlaySounds(Window* window, Sounds* sounds)
{
    float samples[SOUND_BLOCK];
    while (window->loudspeaker != 0 &&
           SDL_GetQueuedAudioSize(window->loudspeaker) < SOUND_AHEAD * (uint32_t)sizeof(float)) {
        Sounds_Mix(sounds, samples, SOUND_BLOCK);
        if (window->mute) {
            memset(samples, 0, sizeof samples);
        }
        if (SDL_QueueAudio(window->loudspeaker, samples, sizeof samples) != 0) {
            break;
        }
    }
}
