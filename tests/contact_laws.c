#include "contact.h"

void Contact_MeasureLaws(void)
{
}
