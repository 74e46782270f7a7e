#include "kiri_curl.h"

kiriCurl kiriCurl_Of(const kiriLink* link, const kiriMaterial* material, double curling)
{
    double nu = (double)material->poissonsRatio, h = (double)material->thickness;
    double W = 2.0 * link->outer - kiriLink_LoneWidth(link); /* of the strip */
    double inner = (1.0 - nu) * (link->width - link->outer), outer = (1.0 - nu * nu) * link->outer;
    double ratio = W * W / (link->length * h);
    kiriCurl curl = { nu * nu * curling / (inner + outer), 3.0 * (1.0 - nu * nu) * ratio * ratio };
    return curl;
}

/* F to 0.01, without functions other than the square root: with q = theta^4 it is 1 - q / 180 where theta is small,
   2 / theta where it is large. */
static double CurledShare(double q, double* slope)
{
    const double c = 0.0054, first = c + 1.0 / 45.0, second = c / 16.0;
    double above = 1.0 + c * q, below = 1.0 + (first + second * q) * q;
    double share = sqrt(sqrt(above / below));
    *slope = 0.25 * share * (c / above - (first + 2.0 * second * q) / below);
    return share;
}

double kiriCurl_Factor(const kiriCurl* curl, double squaredAngle, double* slope)
{
    double byQ, share = CurledShare(curl->perSquare * squaredAngle, &byQ);
    double factor = sqrt(1.0 + curl->gain * (1.0 - share));
    *slope = -0.5 * curl->gain * curl->perSquare * byQ / factor;
    return factor;
}
