/* What accuracy costs: table, CSV and plot of the sweep. */
#ifndef KIRI_TEST_TRADE_H
#define KIRI_TEST_TRADE_H

#include <stdbool.h>

/* Prints the settings that none other dominates; writes trade.csv, all of them, and trade.png. */
bool Trade_Write(const char* folder);

#endif
