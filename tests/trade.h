/* What accuracy costs: table and CSV of the sweep in each scene. */
#ifndef KIRI_TEST_TRADE_H
#define KIRI_TEST_TRADE_H

#include <stdbool.h>
#include <stdint.h>

/* Prints the settings of a scene (sweep.h) that none other dominates; writes trade_<scene>.csv, all of them. */
bool Trade_Write(const char* folder, int32_t scene);

#endif
