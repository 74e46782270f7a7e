/* How far sheets are from the truth, by frames, grid, substeps and the time of a tick: a table here, and a CSV file
   in build/accuracy. Results from outside (theory, the literature, shells and beams solved by other programs; see
   data/README.md) are the truth. `make trade` measures sheets that move against a much finer run. */
#include "accuracy.h"

#include "results.h"
#include "specimen.h"

#include <stdio.h>
#include <string.h>

static const Case* const families[] = { beamCases, plateCases, shellCases, cutCases, motionCases };

/* How many cases ran. `wanted`: the beginning of their names; null: all. */
static int RunCases(const char* data, const char* wanted)
{
    int ran = 0;
    for (int f = 0; f < (int)(sizeof families / sizeof families[0]); ++f) {
        for (const Case* c = families[f]; c->name != NULL; ++c) {
            if (wanted == NULL || strncmp(c->name, wanted, strlen(wanted)) == 0) {
                double start = ProcessorTime(NULL);
                c->run(data);
                printf("%-22s %.1f s\n\n", c->name, ProcessorTime(NULL) - start);
                ++ran;
            }
        }
    }
    return ran;
}

/* accuracy [data folder] [output folder] [case] */
int main(int argc, char** argv)
{
    const char* data = argc > 1 ? argv[1] : "tests/data";
    const char* output = argc > 2 ? argv[2] : "build/accuracy";
    const char* wanted = argc > 3 && argv[3][0] != '\0' ? argv[3] : NULL;
    Results_PrintHead();
    int ran = RunCases(data, wanted);
    Require(Results_Write(output), "cannot write the results");
    Require(ran > 0, "no such case");
    return 0;
}
