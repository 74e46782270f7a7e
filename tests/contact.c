#define _POSIX_C_SOURCE 199309L
/* Measures contact against laws and peers: `make contact`, or `make contact CASE=laws` for one group. */
#include "contact.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <time.h>

static const char* asked = "";
static int lines, marked;

int Contact_IsAsked(const char* group)
{
    return asked[0] == '\0' || strcmp(asked, group) == 0;
}

double Contact_Milliseconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return 1e3 * (double)now.tv_sec + 1e-6 * (double)now.tv_nsec;
}

static void Print(const char* name, const char* variant, double value, const char* law, const char* unit, int isMissed)
{
    lines += law[0] != '\0';
    marked += isMissed;
    printf("%-28s %-34s %12.5g %18s %-8s %s\n", name, variant, value, law, unit, isMissed ? "MISSED" : "");
    fflush(stdout);
}

void Contact_Line(const char* name, const char* variant, double value, double law, double tolerance, const char* unit)
{
    char text[64];
    snprintf(text, sizeof text, "%.5g +- %.2g", law, tolerance);
    Print(name, variant, value, text, unit, !(fabs(value - law) <= tolerance));
}

void Contact_Limit(const char* name, const char* variant, double value, double limit, const char* unit)
{
    char text[64];
    snprintf(text, sizeof text, limit < HUGE_VAL ? "<= %.4g" : "", limit);
    Print(name, variant, value, text, unit, !(value <= limit));
}

int main(int argc, char** argv)
{
    asked = argc > 1 ? argv[1] : "";
    printf("%-28s %-34s %12s %18s\n", "case", "variant", "measured", "law or limit");
    if (Contact_IsAsked("laws")) {
        Contact_MeasureLaws();
    }
    if (Contact_IsAsked("obstacles")) {
        Contact_MeasureObstacles();
    }
    if (Contact_IsAsked("rest")) {
        Contact_MeasureRest();
    }
    if (Contact_IsAsked("sheets")) {
        Contact_MeasureSheets();
    }
    if (Contact_IsAsked("meetings")) {
        Contact_MeasureMeetings();
    }
    if (Contact_IsAsked("folds")) {
        Contact_MeasureFolds();
    }
    if (Contact_IsAsked("bodies")) {
        Contact_MeasureBodies();
    }
    if (Contact_IsAsked("box2d")) {
        Contact_MeasureBox2d();
    }
    printf("%d of %d lines missed\n", marked, lines);
    return 0;
}
