/* The main function of all test programs. */
#include "support.h"

#include <stdlib.h>

enum { MOST_TESTS = 64 };

static struct CMUnitTest tests[MOST_TESTS];
static int lines[MOST_TESTS], testCount;
static void (*beforeTests)(int count, char** words);

void Test_Add(const char* name, CMUnitTestFunction run, void* state, int line)
{
    if (testCount == MOST_TESTS) {
        abort();
    }
    int at = testCount++;
    for (; at > 0 && lines[at - 1] > line; --at) {
        lines[at] = lines[at - 1];
        tests[at] = tests[at - 1];
    }
    lines[at] = line;
    tests[at] = (struct CMUnitTest){ name, run, NULL, NULL, state };
}

void Test_SetUp(void (*setUp)(int count, char** words))
{
    beforeTests = setUp;
}

int main(int count, char** words)
{
    if (beforeTests != NULL) {
        beforeTests(count, words);
    }
    return _cmocka_run_group_tests("tests", tests, (size_t)testCount, NULL, NULL);
}
