/* Prints the table of extremes; an argument picks the cases whose names contain it. */
#include "extremes.h"

#include <stdio.h>
#include <string.h>
#include <time.h>

static void Print(const Extreme* e, const Outcome* o, double seconds)
{
    char recovered[16] = "never", shape[16] = "-";
    if (Extreme_Calm(e) >= 1.0) {
        strcpy(recovered, "-");
    } else if (o->recovered >= 0) {
        snprintf(recovered, sizeof(recovered), "%d", o->recovered);
    }
    if (o->shape >= 0.0) {
        snprintf(shape, sizeof(shape), "%.0e", o->shape);
    }
    printf("%-22s %-6s %8.0e %6d %9s %8.0e %8.0e %8s %8.0e %6d %4d %6.2f %s\n", e->name, o->finite ? "yes" : "NO",
           o->gain, o->gainTick, recovered, Extreme_Calm(e), o->elastic, shape, o->spacing, o->frames, o->solved,
           seconds, o->failed != NULL ? o->failed : "");
    fflush(stdout);
}

static bool IsWell(const Extreme* e, const Outcome* o)
{
    return o->finite && o->failed == NULL && o->gain <= Extreme_Gain(e) &&
           (o->recovered >= 0 || Extreme_Calm(e) >= 1.0);
}

/* Returns 1 where the case asks for more. */
static int Run(const Extreme* e, bool always)
{
    clock_t start = clock();
    Outcome outcome = Extreme_Run(e);
    bool well = IsWell(e, &outcome);
    if (always || !well) {
        Print(e, &outcome, (double)(clock() - start) / CLOCKS_PER_SEC);
    }
    return !well;
}

int main(int count, char** arguments)
{
    enum { RANDOM = 500 };
    int bad = 0;
    uint32_t seed = 12345;
    printf("%-22s %-6s %8s %6s %9s %8s %8s %8s %8s %6s %4s %6s\n", "case", "finite", "gain", "tick", "recovered",
           "calm", "elastic", "shape", "spacing", "frames", "sys", "s");
    for (int i = 0; i < extremeCount; ++i) {
        bad += count < 2 || strstr(extremes[i].name, arguments[1]) != NULL ? Run(&extremes[i], true) : 0;
    }
    for (int i = 0; count < 2 && i < RANDOM; ++i) {
        Extreme e = Extreme_Random(&seed);
        bad += Run(&e, false);
    }
    printf("%d fall short%s\n", bad, count < 2 ? ", also of 500 at random" : "");
    return bad != 0;
}
