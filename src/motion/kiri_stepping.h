/* Schemes of time stepping. Each step solves for the poses of the frames at its end,

       minimise  1/2 m |x - x*|^2 / h'^2 + V(x),

   and the schemes differ in four numbers only. With v, x before the step, h its length, e = gravity + force / m, and
   the history that the last step left (kiriHistory: q the velocity that inner forces gave in it, p = x+ - x - h v+, and
   a the inner acceleration at its end):

       v* = v + h e + c q + l a                   D  = (x - x*) / h'
       x* = x + h v + d p + h' (v* - v)           v+ = v* + D
                                                  q+ = c q + l a + D,  p+ = d p - (h - h') (v+ - v),  a+ = D / h'

       backward Euler   h' = h                    c = 0                  l = 0       d = 0
       trapezoid        h' = h / 2                c = 0                  l = h / 2   d = 0
       BDF2             h' = h (1 + r)/(1 + 2 r)  c = r^2 / (1 + 2 r)    l = 0       d = c      r = h / last h

   Second order in time: trapezoid and BDF2 by turns, so a pair is a step of TR-BDF2 (Bank et al. 1985; Hosea and
   Shampine 1996) whose halves are of one length. Backward Euler starts it, and takes its place where the past says
   nothing of the step: see ChooseSteppings in kiri_step_begin.c. Its next step may be the second of a pair.

   Turns, with Q, P and T for q, p and a. Affine frames: the same, by the columns of A, beside their free turn. Rigid
   frames: Q is angular momentum, T torque, P a rotation vector, in world axes; I is the inertia at the end, w the spin.

       A* = Cayley(d P) (free turn of A over h with L)       A' = A* + h' I^-1 (c Q + l T + h torque) x A*
       minimise  1/2 m |A r - A' r|^2 / h'^2 + V             G, G' = sum of m (A* r, A' r) x (A r) / h'
       L+ = L + G,  w+ = I^-1 L+,  Q+ = c Q + l T + G',  P+ = d P - (h - h') I^-1 (L+ - L),  T+ = G' / h' */
#ifndef KIRI_STEPPING_H
#define KIRI_STEPPING_H

#include "kiri_frame.h"

KIRI_C_BEGIN

typedef struct kiriStepping {
    double h;       /* s: the step */
    double part;    /* h': that of it over which inner forces act on the end */
    double c, l, d; /* shares of q, a (s) and p */
    double ahead;   /* r^2: of p, for where the iteration starts */
    bool isEuler;
    bool isHalf; /* the next may be the second of a pair */
} kiriStepping;

kiriStepping kiriStepping_Euler(double h);

/* The step that comes after this history, of frames that have one. */
kiriStepping kiriStepping_After(const kiriHistory* history, double h);

/* c q + l a, and the same of the turn. */
kiriVec3 kiriStepping_Inner(const kiriStepping* stepping, const kiriHistory* history);
kiriMat3 kiriStepping_InnerTurn(const kiriStepping* stepping, const kiriHistory* history);

KIRI_C_END

#endif
