/* Borders and cuts of sheets as a drawing: SVG or FOLD, which import.h reads again. */
#ifndef EXPORT_H
#define EXPORT_H

#include "import.h"
#include "kiri/kiri.h"

#include <stdio.h>

/* Takes the borders and cuts of sheets that were one sheet, in the rest plane (mm). Sheets that came off count by their
   places in that sheet. False: drawing->error says why. Free the drawing in any case. */
bool Export_Take(const kiriWorld* world, const kiriSheet* sheets, int32_t count, Import* drawing);

/* Write a drawing that was taken or joined. SVG: black cuts, red mountains, blue valleys, green scores, in mm. FOLD: B, C,
   M, V and U. False: the file took not all of it. */
bool Export_WriteSvg(const Import* drawing, FILE* file);
bool Export_WriteFold(const Import* drawing, FILE* file);

#endif
