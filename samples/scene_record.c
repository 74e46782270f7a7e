#include "scene_record.h"

#include "sheets.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- Recording -------------------------------------------------------------------------------------------------- */

static void Write(void* user, const void* bytes, int32_t count)
{
    fwrite(bytes, 1, (size_t)count, user);
}

bool SceneRecord_Open(FILE** file, const char* path, kiriWorldDef* def)
{
    *file = fopen(path, "wb");
    if (*file == NULL) {
        fprintf(stderr, "cannot write %s\n", path);
        return false;
    }
    setvbuf(*file, NULL, _IONBF, 0);
    def->record = Write;
    def->user = *file;
    return true;
}

bool SceneRecord_Close(FILE* file, const char* path)
{
    bool fine = file == NULL || !ferror(file);
    fine = (file == NULL || fclose(file) == 0) && fine;
    if (!fine) {
        fprintf(stderr, "cannot write all of %s\n", path);
    }
    return fine;
}

/* ---- Notes ------------------------------------------------------------------------------------------------------ */

void Scene_NoteStart(const Scene* scene)
{
    char note[128];
    int length = snprintf(note, sizeof note, "scene %s %u %d", scene->type->name, scene->sheet, scene->gridResolution);
    kiriWorld_Note(scene->world, note, length);
}

static void AddNumbers(char* note, const char* word, const float* numbers, int32_t count)
{
    size_t length = strlen(note);
    length += (size_t)snprintf(note + length, SCENE_NOTE_SIZE - length, "%s %d", word, count);
    for (int32_t i = 0; i < count && length < SCENE_NOTE_SIZE; i++) {
        length += (size_t)snprintf(note + length, SCENE_NOTE_SIZE - length, " %.9g", numbers[i]);
    }
}

void Scene_NoteTick(Scene* scene)
{
    float blades[SCENE_MAX_STROKES][2];
    char note[SCENE_NOTE_SIZE] = "";
    AddNumbers(note, "pins", scene->targets[0], 3 * scene->pinCount);
    AddNumbers(note, " blades", blades[0], 2 * Scene_GetBlades(scene, blades, SCENE_MAX_STROKES));
    if (strcmp(note, scene->noted) != 0) {
        strcpy(scene->noted, note);
        kiriWorld_Note(scene->world, note, (int32_t)strlen(note));
    }
}

/* What comes after the word, up to `most` numbers; *count is how many. Null where it is not there, or wrong. */
static const char* TakeNumbers(const char* text, const char* word, float* numbers, int32_t most, int32_t* count)
{
    int length = 0;
    if (strncmp(text, word, strlen(word)) != 0 || sscanf(text + strlen(word), "%d%n", count, &length) != 1 ||
        *count < 0 || *count > most) {
        return NULL;
    }
    text += strlen(word) + (size_t)length;
    for (int32_t i = 0; i < *count; i++) {
        char* end;
        numbers[i] = strtof(text, &end);
        if (end == text) {
            return NULL;
        }
        text = end;
    }
    return text;
}

/* The blades are strokes that are just here. */
static void TakeTick(Scene* scene, const char* note)
{
    float pins[3 * SCENE_MAX_PINS], blades[2 * SCENE_MAX_STROKES];
    int32_t pinNumbers, bladeNumbers;
    note = TakeNumbers(note, "pins", pins, 3 * SCENE_MAX_PINS, &pinNumbers);
    if (note == NULL || TakeNumbers(note, " blades", blades, 2 * SCENE_MAX_STROKES, &bladeNumbers) == NULL) {
        return;
    }
    memcpy(scene->targets, pins, sizeof pins);
    scene->pinCount = pinNumbers / 3;
    scene->strokeCount = bladeNumbers / 2;
    for (int32_t i = 0; i < scene->strokeCount; i++) {
        scene->strokes[i] = (Stroke){ .taken = 1, .lastTick = INT32_MAX - 1 };
        memcpy(scene->strokes[i].tip, blades + 2 * i, sizeof scene->strokes[i].tip);
    }
}

/* True: it names the scene, which has a camera. */
static bool TakeNote(Scene* scene, const kiriReplay* at)
{
    char note[SCENE_NOTE_SIZE] = "", name[32];
    if (at->note == NULL || at->noteCount >= SCENE_NOTE_SIZE) {
        return false;
    }
    memcpy(note, at->note, (size_t)at->noteCount);
    unsigned sheet;
    int grid;
    if (sscanf(note, "scene %31s %u %d", name, &sheet, &grid) == 3 && Scene_FindType(name) != NULL && grid > 0) {
        scene->type = Scene_FindType(name);
        scene->sheet = sheet;
        scene->gridResolution = grid;
        return true;
    }
    TakeTick(scene, note);
    return false;
}

/* ---- Replay ----------------------------------------------------------------------------------------------------- */

static bool ReadAll(SceneReplay* replay, const char* path)
{
    FILE* file = fopen(path, "rb");
    size_t room = 1 << 16, size = 0, count = 1;
    replay->bytes = malloc(room);
    while (file != NULL && replay->bytes != NULL && count > 0) {
        count = fread(replay->bytes + size, 1, room - size, file);
        size += count;
        if (size == room) {
            room *= 2;
            uint8_t* larger = realloc(replay->bytes, room);
            free(larger == NULL ? replay->bytes : NULL);
            replay->bytes = larger;
        }
    }
    bool fine = file != NULL && !ferror(file) && replay->bytes != NULL;
    if (file != NULL) {
        fclose(file);
    }
    replay->byteCount = (int64_t)size;
    return fine;
}

/* A sheet to look at, where no note names one. */
static void FindSheet(Scene* scene)
{
    int32_t count;
    if (scene->sheet == 0) {
        kiriWorld_GetSheets(scene->world, &scene->sheet, 1, &count);
    }
}

/* ---- Camera ----------------------------------------------------------------------------------------------------- */

enum { MOST_IDS = 1024, STEADY_TICKS = 60 };
#define GROWTH 1.5f /* of the box within which a camera stands still */

typedef struct Box {
    float lower[3], upper[3];
} Box;

static const Box noBox = { { INFINITY, INFINITY, INFINITY }, { -INFINITY, -INFINITY, -INFINITY } };

static void Box_Add(Box* box, const float lower[3], const float upper[3])
{
    for (int k = 0; k < 3; k++) {
        box->lower[k] = fminf(box->lower[k], lower[k]);
        box->upper[k] = fmaxf(box->upper[k], upper[k]);
    }
}

static float Box_GetSize(const Box* box)
{
    return fmaxf(fmaxf(box->upper[0] - box->lower[0], box->upper[1] - box->lower[1]), box->upper[2] - box->lower[2]);
}

static void AddPieceOf(kiriWorld* world, kiriSheet sheet, kiriFrame frame, Box* box)
{
    int32_t index;
    kiriPieceState piece;
    if (kiriFrame_GetPiece(world, frame, &index) == KIRI_OK && kiriSheet_GetPiece(world, sheet, index, &piece) == KIRI_OK) {
        Box_Add(box, piece.lower, piece.upper);
    }
}

/* Adds the pieces that pins and held frames hold. */
static void AddHeld(kiriWorld* world, kiriSheet sheet, Box* held)
{
    static uint32_t ids[MOST_IDS];
    int32_t count;
    kiriSheet_GetPins(world, sheet, ids, MOST_IDS, &count);
    for (int32_t i = 0; i < count && i < MOST_IDS; i++) {
        kiriPinState pin;
        kiriPointState point;
        kiriPin_GetState(world, ids[i], &pin);
        if (kiriSheet_GetPoint(world, sheet, pin.from, &point) == KIRI_OK) {
            AddPieceOf(world, sheet, point.frame, held);
        }
    }
    kiriSheet_GetFrames(world, sheet, ids, MOST_IDS, &count);
    for (int32_t i = 0; i < count && i < MOST_IDS; i++) {
        kiriFrameState frame;
        if (kiriFrame_GetState(world, ids[i], &frame) == KIRI_OK && frame.held) {
            AddPieceOf(world, sheet, ids[i], held);
        }
    }
}

/* The box around held pieces, or else around the largest piece of each sheet; and around moving pieces that are near. */
static Box GetSeen(kiriWorld* world)
{
    static kiriSheet sheets[MOST_IDS];
    Box seen = noBox, moving = noBox, largest = noBox;
    int32_t count;
    kiriWorld_GetSheets(world, sheets, MOST_IDS, &count);
    for (int32_t i = 0; i < count && i < MOST_IDS; i++) {
        kiriPieceState piece, most = { .area = 0.0 };
        AddHeld(world, sheets[i], &seen);
        for (int32_t k = 0; kiriSheet_GetPiece(world, sheets[i], k, &piece) == KIRI_OK; k++) {
            if (!piece.asleep) {
                Box_Add(&moving, piece.lower, piece.upper);
            }
            most = piece.area > most.area ? piece : most;
        }
        if (most.area > 0.0) {
            Box_Add(&largest, most.lower, most.upper);
        }
    }
    seen = Box_GetSize(&seen) > 0.0f ? seen : largest;
    float margin = 0.5f * Box_GetSize(&seen);
    for (int k = 0; k < 3 && margin > 0.0f; k++) {
        seen.lower[k] = fminf(seen.lower[k], fmaxf(moving.lower[k], seen.lower[k] - margin));
        seen.upper[k] = fmaxf(seen.upper[k], fminf(moving.upper[k], seen.upper[k] + margin));
    }
    return seen;
}

/* Means over a second before and after: the path bends, but does not shake. */
static void Smooth(float* path, const float* from, int32_t ticks)
{
    for (int32_t i = 0; i < ticks; i++) {
        int32_t reach = i < ticks - 1 - i ? i : ticks - 1 - i;
        reach = reach < STEADY_TICKS ? reach : STEADY_TICKS;
        for (int k = 0; k < 3; k++) {
            double sum = 0.0;
            for (int32_t j = i - reach; j <= i + reach; j++) {
                sum += from[3 * j + k];
            }
            path[3 * i + k] = (float)(sum / (2 * reach + 1));
        }
    }
}

/* Axes of the camera; the last one points from its target to its eye. */
static const float right[3] = { 0.982f, -0.188f, 0.0f }, up[3] = { 0.055f, 0.285f, 0.957f }, back[3] = { -0.18f, -0.94f, 0.29f };
#define FIELD_OF_VIEW 38.0f /* degrees */

/* The distance from which a picture of 4 : 3 shows a box, with a border. */
static float GetDistance(const float sides[3])
{
    float most = 0.0f, half = 0.85f * tanf(0.5f * FIELD_OF_VIEW * 3.14159265f / 180.0f);
    for (int i = 0; i < 8; i++) {
        float across = 0.0f, along = 0.0f, near = 0.0f;
        for (int k = 0; k < 3; k++) {
            float at = 0.5f * sides[k] * (i >> k & 1 ? 1.0f : -1.0f);
            across += at * right[k];
            along += at * up[k];
            near += at * back[k];
        }
        most = fmaxf(most, near + fmaxf(fabsf(across) * 3.0f / 4.0f, fabsf(along)) / half);
    }
    return most;
}

/* Where the camera looks in each tick, and from how far: from one point if it shows all from there. */
static bool PlanCamera(SceneReplay* replay, const Box* boxes, int32_t ticks)
{
    Box all = noBox;
    float sides[3] = { 0.0f };
    replay->targets = malloc(sizeof(float) * 3 * (size_t)(ticks > 0 ? ticks : 1));
    float* middles = malloc(sizeof(float) * 3 * (size_t)(ticks > 0 ? ticks : 1));
    bool isFine = replay->targets != NULL && middles != NULL;
    for (int32_t i = 0; i < ticks; i++) {
        Box_Add(&all, boxes[i].lower, boxes[i].upper);
        for (int k = 0; k < 3; k++) {
            sides[k] = fmaxf(sides[k], boxes[i].upper[k] - boxes[i].lower[k]);
        }
    }
    replay->size = fmaxf(fmaxf(sides[0], sides[1]), sides[2]);
    bool stands = Box_GetSize(&all) <= GROWTH * replay->size;
    for (int k = 0; k < 3 && stands; k++) {
        sides[k] = all.upper[k] - all.lower[k];
    }
    replay->distance = GetDistance(sides);
    for (int32_t i = 0; isFine && i < 3 * ticks; i++) {
        const Box* box = stands || Box_GetSize(&boxes[i / 3]) <= 0.0f ? &all : &boxes[i / 3];
        middles[i] = 0.5f * (box->lower[i % 3] + box->upper[i % 3]);
    }
    if (isFine) {
        Smooth(replay->targets, middles, ticks);
    }
    free(middles);
    return isFine;
}

static void SetCamera(const SceneReplay* replay, Scene* scene, int64_t tick)
{
    if (replay->size > 0.0f && tick >= 0 && tick < replay->ticks) {
        scene->paced = *scene->type;
        scene->paced.size = replay->size;
        scene->paced.pegs = false;
        for (int k = 0; k < 3; k++) {
            scene->paced.camera.target[k] = replay->targets[3 * tick + k] / replay->size;
            scene->paced.camera.eye[k] = (replay->targets[3 * tick + k] + replay->distance * back[k]) / replay->size;
        }
        scene->paced.camera.fieldOfView = FIELD_OF_VIEW;
        scene->type = &scene->paced;
    }
}

/* ---- Ticks ------------------------------------------------------------------------------------------------------ */

kiriResult SceneReplay_Tick(SceneReplay* replay, Scene* scene)
{
    if (replay->isSave) {
        SetCamera(replay, scene, scene->tick++);
        kiriResult moved = kiriWorld_Tick(scene->world, 1.0f / 60.0f, 2);
        return moved == KIRI_OK ? KIRI_PENDING : moved;
    }
    int64_t ticks = replay->at.ticks;
    kiriResult result = KIRI_PENDING;
    while (result == KIRI_PENDING && replay->at.ticks == ticks) {
        result = kiriWorld_Replay(scene->world, replay->bytes, replay->byteCount, &replay->at);
        TakeNote(scene, &replay->at);
    }
    FindSheet(scene);
    SetCamera(replay, scene, replay->at.ticks - 1);
    scene->tick = (int32_t)replay->at.ticks;
    return result;
}

static bool StartScene(Scene* scene, const SceneType* type, const kiriWorldDef* def)
{
    *scene = (Scene){ .type = type, .pace = 1.0f, .gridResolution = 32 };
    kiriResult result = kiriCreateWorld(def, &scene->world);
    if (result != KIRI_OK) {
        fprintf(stderr, "no world: %s\n", kiriGetResultName(result));
    }
    return result == KIRI_OK;
}

/* Plays the whole file: counts its ticks, finds its faults, and plans the camera. */
static bool Check(SceneReplay* replay, Scene* scene)
{
    kiriResult result = KIRI_PENDING;
    int32_t ticks = 0, room = 0;
    Box* boxes = NULL;
    bool isFine = true;
    while (result == KIRI_PENDING && isFine && (!replay->isSave || ticks < SCENE_SAVE_TICKS)) {
        result = SceneReplay_Tick(replay, scene);
        if (result < 0) {
            fprintf(stderr, "%s\n", kiriWorld_GetLastError(scene->world));
        }
        if (scene->tick > ticks) {
            if (ticks == room) {
                room = 2 * room + 64;
                Box* larger = realloc(boxes, sizeof *boxes * (size_t)room);
                isFine = larger != NULL;
                boxes = isFine ? larger : boxes;
            }
            if (isFine) {
                boxes[ticks++] = GetSeen(scene->world);
            }
        }
    }
    replay->isRight = result == KIRI_OK || replay->isSave;
    isFine = isFine && PlanCamera(replay, boxes, ticks);
    replay->ticks = ticks;
    replay->at = (kiriReplay){ 0 };
    free(boxes);
    Scene_Stop(scene);
    return isFine;
}

bool SceneReplay_Start(SceneReplay* replay, const char* path, Scene* scene, const SceneType* type,
                       const kiriWorldDef* def)
{
    *replay = (SceneReplay){ 0 };
    if (!ReadAll(replay, path)) {
        fprintf(stderr, "cannot read %s\n", path);
        return false;
    }
    if (!StartScene(scene, type, def)) {
        return false;
    }
    replay->isSave = kiriWorld_Load(scene->world, replay->bytes, replay->byteCount) == KIRI_OK;
    if (!Check(replay, scene) || replay->ticks == 0) {
        fprintf(stderr, replay->ticks == 0 ? "%s has no ticks to show\n" : "%s: no memory\n", path);
        return false;
    }
    if (!StartScene(scene, type, def)) {
        return false;
    }
    if (replay->isSave) {
        kiriWorld_Load(scene->world, replay->bytes, replay->byteCount);
        FindSheet(scene);
        SetCamera(replay, scene, 0);
        return true;
    }
    kiriWorld_Replay(scene->world, replay->bytes, replay->byteCount, &replay->at);
    if (TakeNote(scene, &replay->at)) {
        replay->size = 0.0f; /* the scene has a camera */
        return true;
    }
    Scene_Stop(scene);
    replay->at = (kiriReplay){ 0 };
    bool isFine = StartScene(scene, type, def);
    SetCamera(replay, scene, 0);
    return isFine;
}

void SceneReplay_Free(SceneReplay* replay)
{
    free(replay->bytes);
    free(replay->targets);
    *replay = (SceneReplay){ .bytes = NULL };
}
