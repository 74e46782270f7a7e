#include "contact.h"

void Contact_MeasureObstacles(void)
{
}
