#include "contact.h"

void Contact_MeasureSheets(void)
{
}
