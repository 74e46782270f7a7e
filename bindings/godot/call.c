/* One call: the script's arguments become the parameters of a function of C, what that writes the answer. */
#include "call.h"

#include <stdio.h>
#include <string.h>

enum { MOST_PARAMETERS = 12, FIRST_CAPACITY = 64 };

/* A parameter: a number, a struct, or where rows are. */
typedef union Value {
    double aligned;
    int32_t i32;
    int64_t i64;
    uint32_t id;
    void* pointer;
    char room[ROOM];
} Value;

typedef struct Call {
    const Method* method;
    Self* self;
    Self* world;
    const Variant* const* arguments;
    int count;
    int capacity; /* of lists */
    Value values[MOST_PARAMETERS + 1];
    void* passed[MOST_PARAMETERS + 1]; /* to C: where each is, or null */
    Scratch scratch;
    char wrong[MOST_TEXT];
} Call;

/* ---- Errors ---- */

void Fail(const Method* method, const char* why, const char* what)
{
    char line[3 * MOST_TEXT];
    snprintf(line, sizeof line, "%s.%s: %s%s%s", CLASS_NAMES[method->class], method->name, why,
             what != NULL && *what != 0 ? ": " : "", what != NULL ? what : "");
    PushError(line);
}

int Check(const Method* method, Self* world, kiriResult result)
{
    if (world != NULL) {
        world->last = result;
    }
    if (result < 0) { /* a line of C begins with its name for the call, and ends with the code; fields are in camelCase */
        const char* line = world != NULL && world->line[0] != 0 ? world->line : kiriGetResultText(result);
        const char* named = strncmp(line, "kiri", 4) == 0 ? strstr(line, ": ") : NULL;
        const char* why = named != NULL ? named + 2 : line;
        const char* code = strstr(why, " (KIRI_");
        const char* end = code != NULL ? code : why + strlen(why);
        char own[2 * MOST_TEXT];
        size_t size = 0;
        for (int isLow = 0; why != end && size < sizeof own - 32; ++why) { /* isLow: the word began with a small letter */
            int isSmall = *why >= 'a' && *why <= 'z', isBig = *why >= 'A' && *why <= 'Z';
            isLow = size == 0 || strchr(" .[&", why[-1]) != NULL ? isSmall : isLow;
            if (isBig && isLow) {
                own[size++] = '_';
            }
            own[size++] = (char)(isBig && isLow ? *why + 'a' - 'A' : *why);
        }
        snprintf(own + size, sizeof own - size, " (%s)", kiriGetResultName(result) + strlen("KIRI_"));
        Fail(method, own, NULL);
    }
    return result >= 0;
}

/* ---- In ---- */

/* Settings are changed from what they are. */
static void Fill(Call* call, const Struct* of, void* data)
{
    if (of->fill != NULL) {
        of->fill(data);
    } else if (of == &SHEET_SETTINGS && call->world != NULL) {
        kiriSheet_GetSettings(call->world->world, call->self->id, data);
    }
}

static int TakeStruct(Call* call, int i, const Variant* argument)
{
    const Parameter* parameter = &call->method->parameters[i];
    Fill(call, parameter->of, call->passed[i]);
    return ReadStruct(argument, parameter->of, call->world, &call->scratch, call->passed[i], call->wrong);
}

static int TakeRows(Call* call, int i, const Variant* argument)
{
    const Parameter* parameter = &call->method->parameters[i];
    int64_t count = ReadRows(argument, parameter, call->world, &call->scratch, &call->passed[i], call->wrong);
    if (count < 0 || count > INT32_MAX) {
        return 0;
    }
    if (call->method->parameters[parameter->lengthAt].type == TYPE_INT64) {
        call->values[parameter->lengthAt].i64 = count;
    } else {
        call->values[parameter->lengthAt].i32 = (int32_t)count;
    }
    return 1;
}

/* One argument. */
static int Take(Call* call, int i, const Variant* argument)
{
    const Parameter* parameter = &call->method->parameters[i];
    if (parameter->nullable && KindOf(argument) == KIND_NIL && parameter->form != FORM_IN) {
        call->passed[i] = NULL;
        return 1;
    }
    switch (parameter->form) {
    case FORM_IN:
        return ReadItem(argument, parameter->type, parameter->class, call->world, call->passed[i]);
    case FORM_IN_NUMBERS:
        return ReadNumbers(argument, parameter->type, parameter->count, call->passed[i]);
    case FORM_IN_ROWS:
        return TakeRows(call, i, argument);
    default:
        return TakeStruct(call, i, argument);
    }
}

static int IsGiven(Form form)
{
    return form == FORM_IN || form == FORM_IN_STRUCT || form == FORM_IN_NUMBERS || form == FORM_IN_ROWS ||
           form == FORM_INOUT_STRUCT;
}

static int TakeArguments(Call* call)
{
    int next = 0;
    for (int i = 0; i < call->method->parameterCount; ++i) {
        const Parameter* parameter = &call->method->parameters[i];
        if (!IsGiven(parameter->form)) {
            continue;
        }
        int given = next < call->count;
        if (!given && parameter->nullable && parameter->form != FORM_IN) {
            call->passed[i] = NULL;
        } else if (given && !Take(call, i, call->arguments[next])) {
            char why[MOST_TEXT + 32];
            snprintf(why, sizeof why, "argument %d, %.100s, is not as it should be", next + 1, parameter->name);
            Fail(call->method, why, call->wrong);
            return 0;
        }
        ++next;
    }
    return 1;
}

/* ---- Out ---- */

static void* TakeRoom(Call* call, const Parameter* parameter, int64_t rows)
{
    static const int SIZES[] = { 0, 4, 4, 8, 8, 2, 1, 4, 8, 4, 4, 0 };
    int64_t taken = rows > 0 ? rows : 0; /* C says what is wrong with less */
    return taken > INT32_MAX ? NULL : TakeScratch(&call->scratch, taken * parameter->width * SIZES[parameter->type]);
}

/* Room for what is written to the host's arrays. */
static int MakeRoom(Call* call)
{
    for (int i = 0; i < call->method->parameterCount; ++i) {
        const Parameter* parameter = &call->method->parameters[i];
        if (parameter->form == FORM_CAPACITY) {
            if (parameter->type == TYPE_INT64) {
                call->values[i].i64 = call->capacity;
            } else {
                call->values[i].i32 = call->capacity;
            }
        }
        int64_t rows = parameter->form == FORM_OUT_LIST   ? call->capacity
                       : parameter->form == FORM_OUT_ROWS ? parameter->rows(call->passed)
                                                          : 0;
        if ((parameter->form == FORM_OUT_LIST || parameter->form == FORM_OUT_ROWS) &&
            (call->passed[i] = TakeRoom(call, parameter, rows)) == NULL) {
            Fail(call->method, "no memory for the answer", NULL);
            return 0;
        }
    }
    return 1;
}

static int64_t CountOf(const Call* call)
{
    for (int i = 0; i < call->method->parameterCount; ++i) {
        if (call->method->parameters[i].form == FORM_OUT_COUNT) {
            return call->method->parameters[i].type == TYPE_INT64 ? call->values[i].i64 : call->values[i].i32;
        }
    }
    return 0;
}

static int HasList(const Method* method)
{
    for (int i = 0; i < method->parameterCount; ++i) {
        if (method->parameters[i].form == FORM_OUT_LIST) {
            return 1;
        }
    }
    return 0;
}

/* Calls, and again with more room where a list did not fit. */
static int64_t CallFunction(Call* call)
{
    int64_t result = call->method->call(call->passed);
    if (HasList(call->method) && CountOf(call) > call->capacity) {
        call->capacity = (int)CountOf(call);
        result = MakeRoom(call) ? call->method->call(call->passed) : KIRI_ERROR_MEMORY;
    }
    return result;
}

static Variant GiveRows(const Call* call, int i)
{
    const Parameter* parameter = &call->method->parameters[i];
    int isView = parameter->form == FORM_OUT_VIEW;
    const void* rows = isView ? call->values[i].pointer : call->passed[i];
    int64_t count = parameter->form == FORM_OUT_ROWS ? parameter->rows(call->passed) : CountOf(call);
    return WriteRows(parameter->kind, parameter->type, parameter->class, parameter->of, parameter->width, call->world,
                     rows, count);
}

static Variant GiveStruct(const Call* call, int i)
{
    Variant made = NewDictionary();
    const Struct* of = call->method->parameters[i].of;
    if (of != &HIT || ((const kiriHit*)call->passed[i])->triangle >= 0) {
        WriteStruct(&made, of, call->world, call->passed[i]);
    }
    return made;
}

static int IsAnswer(Form form)
{
    return form >= FORM_OUT && form < FORM_OUT_COUNT;
}

static Variant Give(const Call* call, int i)
{
    const Parameter* parameter = &call->method->parameters[i];
    switch (parameter->form) {
    case FORM_OUT:
        return WriteItem(parameter->type, parameter->class, call->world, call->passed[i]);
    case FORM_OUT_NUMBERS:
        return WriteNumbers(parameter->kind, parameter->type, parameter->count, call->passed[i]);
    case FORM_OUT_STRUCT:
        return GiveStruct(call, i);
    default:
        return GiveRows(call, i);
    }
}

/* What C wrote: the one thing, or a dictionary of all of them. */
static Variant GiveAnswer(const Call* call, int64_t result)
{
    const Method* method = call->method;
    Variant answer = OfNil();
    int answers = 0, last = 0;
    for (int i = 0; i < method->parameterCount; ++i) {
        if (IsAnswer(method->parameters[i].form)) {
            ++answers;
            last = i;
        }
    }
    if (answers == 0) {
        return method->returns == RETURNS_TEXT ? OfText(call->values[method->parameterCount].pointer) : OfInt(result);
    }
    if (answers == 1) {
        return Give(call, last);
    }
    answer = NewDictionary();
    for (int i = 0; i < method->parameterCount; ++i) {
        if (IsAnswer(method->parameters[i].form)) {
            SetKey(&answer, method->parameters[i].name, Give(call, i));
        }
    }
    return answer;
}

/* Structs that were given and changed go back to their dictionaries. */
static void GiveBack(const Call* call)
{
    int next = 0;
    for (int i = 0; i < call->method->parameterCount; ++i) {
        const Parameter* parameter = &call->method->parameters[i];
        if (parameter->form == FORM_INOUT_STRUCT && next < call->count) {
            Variant same;
            CopyValue(&same, call->arguments[next]);
            WriteStruct(&same, parameter->of, call->world, call->passed[i]);
            DropValue(&same);
        }
        next += IsGiven(parameter->form);
    }
}

/* ---- The call ---- */

static int Begin(Call* call)
{
    const Method* method = call->method;
    if (method->class != CLASS_KIRI &&
        (call->world == NULL || (call->world->world == NULL && method->function != NULL))) {
        Fail(method, call->world == NULL ? "it belongs to no world" : "its world is gone", NULL);
        return 0;
    }
    if (call->count < method->requiredCount || call->count > method->argumentCount) {
        Fail(method, "that is not the number of arguments it takes", NULL);
        return 0;
    }
    for (int i = 0; i < method->parameterCount; ++i) {
        call->passed[i] = method->parameters[i].form == FORM_WORLD ? (void*)call->world->world : &call->values[i];
        if (method->parameters[i].form == FORM_SELF) {
            call->values[i].id = call->self->id;
        }
    }
    call->passed[method->parameterCount] = &call->values[method->parameterCount];
    return 1;
}

Variant Invoke(const Method* method, Self* self, const Variant* const* arguments, int count)
{
    Call call;
    memset(call.values, 0, (size_t)(method->parameterCount + 1) * sizeof *call.values);
    memset(&call.scratch, 0, sizeof call.scratch);
    call.wrong[0] = 0;
    call.method = method;
    call.self = self;
    call.world = self != NULL && method->class != CLASS_KIRI ? WorldOf(self) : NULL;
    call.arguments = arguments;
    call.count = count;
    call.capacity = FIRST_CAPACITY;
    Variant answer = OfNil();
    int good = Begin(&call);
    if (good && method->byHand != NULL) {
        return method->byHand(method, self, arguments, count);
    }
    if (good && TakeArguments(&call) && MakeRoom(&call)) {
        if (call.world != NULL && method->returns == RETURNS_RESULT) {
            call.world->line[0] = 0;
        }
        int64_t result = CallFunction(&call);
        good = method->returns != RETURNS_RESULT || Check(method, call.world, (kiriResult)result);
        if (good) {
            GiveBack(&call);
        }
        answer = good || method->answer == KIND_INT ? GiveAnswer(&call, result) : EmptyOf(method->answer);
    } else {
        answer = method->returns == RETURNS_RESULT && method->answer == KIND_INT ? OfInt(KIRI_ERROR_ARGUMENT)
                                                                                 : EmptyOf(method->answer);
    }
    FreeScratch(&call.scratch);
    return answer;
}
