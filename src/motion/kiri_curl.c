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
#define CURL_FIT 0.0054
#define CURL_FIRST (CURL_FIT + 1.0 / 45.0)
#define CURL_SECOND (CURL_FIT / 16.0)

static double CurledShare(double q, double* slope)
{
    double above = 1.0 + CURL_FIT * q, below = 1.0 + (CURL_FIRST + CURL_SECOND * q) * q;
    double share = sqrt(sqrt(above / below));
    *slope = 0.25 * share * (CURL_FIT / above - (CURL_FIRST + 2.0 * CURL_SECOND * q) / below);
    return share;
}

/* 1 - F is 1 - F^4 by 1 + F + F^2 + F^3. */
double kiriCurl_Held(double q, double* slope)
{
    double byQ, share = CurledShare(q, &byQ), below = 1.0 + (CURL_FIRST + CURL_SECOND * q) * q;
    double sum = (1.0 + share) * (1.0 + share * share), bySum = byQ * (1.0 + (2.0 + 3.0 * share) * share);
    double held = (1.0 / 45.0 + CURL_SECOND * q) / (below * sum);
    *slope = CURL_SECOND / (below * sum) - held * ((CURL_FIRST + 2.0 * CURL_SECOND * q) / below + bySum / sum);
    return held;
}

double kiriCurl_Factor(const kiriCurl* curl, double squaredAngle, double* slope)
{
    double byQ, share = CurledShare(curl->perSquare * squaredAngle, &byQ);
    double factor = sqrt(1.0 + curl->gain * (1.0 - share));
    *slope = -0.5 * curl->gain * curl->perSquare * byQ / factor;
    return factor;
}
