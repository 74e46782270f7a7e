/* Why something is refused: one line, which names the item by its number. */
#ifndef KIRI_FAULT_H
#define KIRI_FAULT_H

#include "kiri_base.h"

#include <stdio.h>

KIRI_C_BEGIN

typedef struct kiriFault {
    char line[160]; /* "": the result says it all */
} kiriFault;

/* Writes the line. Numbers are long long: snprintf of the web build reads %s and %lld only. */
#define KIRI_SAY(fault, ...) ((void)snprintf((fault)->line, sizeof((fault)->line), __VA_ARGS__))

KIRI_C_END

#endif
