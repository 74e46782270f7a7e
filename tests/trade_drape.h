/* How cloths drape over a disc, in Kiri and with springs. */
#ifndef KIRI_TEST_TRADE_DRAPE_H
#define KIRI_TEST_TRADE_DRAPE_H

/* Prints drape coefficients and folds of the cloth presets. */
void Drape_Print(void);

#endif
