#include "kiri_clamp.h"

#include <string.h>

void kiriClamp_Shape(kiriClampRow* row, const kiriClampShape* shape, kiriVec2 site)
{
    kiriLink* link = &row->link;
    kiriVec2 off = kiriVec2_Sub(site, shape->from), left = { -shape->along.y, shape->along.x };
    double away = kiriVec2_Dot(off, left);
    row->foot = kiriVec2_Add(shape->from, kiriVec2_Scale(kiriVec2_Dot(off, shape->along), shape->along));
    row->isAffine = shape->isAffine;
    memset(link, 0, sizeof(*link));
    link->i = KIRI_NONE;
    link->j = row->frame;
    link->width = shape->width;
    link->moment = shape->moment;
    row->outer = shape->outer;
    row->material = shape->material;
    link->length = kiriMax(fabs(away), shape->least);
    link->normal = away < 0.0 ? kiriVec2_Scale(-1.0, left) : left;
    link->tangent = kiriVec2_Make(-link->normal.y, link->normal.x);
    link->span = kiriVec2_Scale(link->length, link->normal);
    kiriVec2 half = kiriVec2_Scale(0.5, link->span);
    link->centroid = shape->isAffine ? shape->centroid : kiriVec2_Add(shape->centroid, half);
    link->crossing = kiriVec2_Add(row->foot, half);
}

/* The line as a frame: what the strains of a link read of one that is held. */
static kiriFrameData LineFrame(const kiriClampRow* row)
{
    kiriFrameData frame;
    memset(&frame, 0, sizeof(frame));
    frame.site.at = frame.center = row->foot;
    frame.held = 1;
    return frame;
}

void kiriClamp_Measure(const kiriClampRow* row, const kiriFrameData* frame, const kiriPose* line, const kiriPose* pose,
                       double* strain, kiriFrameRow* rows)
{
    const kiriFrameData held = LineFrame(row);
    const kiriFrameData* const frames[2] = { &held, frame };
    const kiriPose* const poses[2] = { line, pose };
    if (row->isAffine) {
        kiriFrameRow both[KIRI_AFFINE_STRAINS][2];
        kiriAffine_Measure(&row->link, row->material, frames, poses, strain, rows != NULL ? both : NULL);
        for (int e = 0; rows != NULL && e < KIRI_AFFINE_STRAINS; ++e) {
            rows[e] = both[e][1];
        }
    } else {
        kiriStrainRow both[KIRI_STRAINS];
        kiriStrain_Measure(&row->link, row->material, frames, poses, strain, rows != NULL ? both : NULL);
        for (int e = 0; rows != NULL && e < KIRI_STRAINS; ++e) {
            memset(&rows[e], 0, sizeof(rows[e]));
            rows[e].by[0] = both[e].end[1].move;
            rows[e].by[1] = both[e].end[1].turn;
        }
    }
}

/* How many strains can be other than zero, see kiriElement_StrainCount. */
static int StrainCount(bool isAffine, bool isPlanar)
{
    return isAffine ? (isPlanar ? (int)KIRI_AFFINE_BENDING : (int)KIRI_AFFINE_STRAINS)
                    : (isPlanar ? (int)KIRI_PLANE_BENDING + 1 : (int)KIRI_STRAINS);
}

/* Along the line the material neither stretches nor curls, and beside it hardly: so it is as stiff as where both
   directions strain. */
static void SetRigidStiffness(kiriClampRow* row, const kiriMaterial* material)
{
    double h = (double)material->thickness, nu = (double)material->poissonsRatio, l = row->link.length;
    double membrane = (double)material->youngsModulus * h / (l * (1.0 - nu * nu)), bending = membrane * h * h / 12.0;
    kiriStrain_Stiffness(&row->link, material, row->stiffness);
    row->stiffness[KIRI_STRETCH] = membrane * row->link.width;
    row->stiffness[KIRI_BENDING] = bending * row->link.width;
    row->stiffness[KIRI_TWIST] = bending * (1.0 - nu) * (row->link.width + row->outer);
    row->stiffness[KIRI_NORMAL_GAP] = KIRI_NORMAL_GAP_BETA * bending * row->link.width / (l * l);
}

/* The same of an affine frame, whose rows of bending see twist too. */
static void SetAffineStiffness(kiriClampRow* row, const kiriMaterial* material)
{
    double h = (double)material->thickness, nu = (double)material->poissonsRatio, l = row->link.length;
    double W = row->link.width, membrane = (double)material->youngsModulus * h / l;
    double bending = membrane * h * h / (12.0 * (1.0 - nu * nu)), twisted = (1.0 - nu) * (W + row->outer) - W;
    kiriAffine_Stiffness(&row->link, material, row->stiffness);
    for (int a = 0; a < 3; ++a) {
        row->stiffness[KIRI_AFFINE_GAP + a] = KIRI_CLAMP_AFFINE_GAP * membrane * W;
        row->stiffness[KIRI_AFFINE_BENDING + a] = bending * W;
    }
    row->stiffness[KIRI_AFFINE_TWIST] = twisted > 0.0 ? bending * twisted : 0.0;
    row->stiffness[KIRI_AFFINE_NORMAL_GAP] = KIRI_NORMAL_GAP_BETA * bending * W / (l * l);
}

void kiriClamp_Begin(kiriClampRow* row, bool isPlanar, const kiriMaterial* material, double damping,
                     const kiriFrameData* frame, const kiriPose* start)
{
    row->strainCount = StrainCount(row->isAffine, isPlanar);
    row->stopping = false;
    row->isAffine ? SetAffineStiffness(row, material) : SetRigidStiffness(row, material);
    kiriClamp_Measure(row, frame, &row->start, start, row->startStrain, NULL);
    double share = damping * (row->isAffine ? 1.0 : kiriStrain_Damping(row->startStrain));
    for (int e = 0; e < row->strainCount; ++e) {
        row->loss[e] = share * row->stiffness[e];
    }
}

void kiriClamp_TakeOffsets(const kiriClampRow* row, const double* strain, double* pulling)
{
    for (int e = 0; e < row->strainCount; ++e) {
        pulling[e] = strain[e] - row->offset[e];
    }
    if (!row->isAffine && row->strainCount > KIRI_NORMAL_STOP) { /* the stop only pushes */
        double over = fabs(strain[KIRI_NORMAL_STOP]) - fabs(row->offset[KIRI_NORMAL_STOP]);
        pulling[KIRI_NORMAL_STOP] = over <= 0.0 ? 0.0 : strain[KIRI_NORMAL_STOP] > 0.0 ? over : -over;
    }
}

bool kiriClamp_IsStopped(const kiriClampRow* row, const double* strain)
{
    return !row->isAffine && row->strainCount > KIRI_NORMAL_STOP && strain[KIRI_NORMAL_STOP] != 0.0;
}

double kiriClamp_Noise(const kiriClampRow* row, const kiriPose* start)
{
    double reach = kiriVec3_Length(start->x) + row->link.length, sum = 0.0;
    for (int e = 0; e < row->strainCount; ++e) {
        bool isAngle = row->isAffine ? e >= KIRI_AFFINE_PLANE_BENDING && e < KIRI_AFFINE_NORMAL_GAP
                                     : e >= KIRI_PLANE_BENDING && e <= KIRI_TWIST;
        bool isStop = e == (row->isAffine ? (int)KIRI_AFFINE_NORMAL_STOP : (int)KIRI_NORMAL_STOP);
        sum += isStop ? 0.0 : (isAngle ? 1.0 : reach * reach) * row->stiffness[e];
    }
    return sum;
}
