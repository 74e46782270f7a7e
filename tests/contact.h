/* What `make contact` measures: each case says what came out, what law or peer it is held against, and how far it may
   be off. A file of cases has one function that runs them. */
#ifndef CONTACT_H
#define CONTACT_H

#include "kiri/kiri.h"
#include "scoped.h"

/* One line of the table. `law` is what should come out; the line is marked where |value - law| > tolerance. */
void Contact_Line(const char* name, const char* variant, double value, double law, double tolerance, const char* unit);

/* The same for a limit: the line is marked where value > limit. A line with the limit HUGE_VAL is not counted. */
void Contact_Limit(const char* name, const char* variant, double value, double limit, const char* unit);

/* Is this group of cases asked for? All are, where none is named. */
int Contact_IsAsked(const char* group);

/* m: how deep the deepest vertex of a sheet is in any obstacle of its world; below 0: none is. */
double Contact_Depth(const kiriWorld* world, kiriSheet sheet);

/* Of the processor, for this thread alone. */
double Contact_Milliseconds(void);

/* Files of cases. */
void Contact_MeasureLaws(void);      /* contact_laws.c: friction, stopping, momentum, energy, conveyor, push, speed */
void Contact_MeasureObstacles(void); /* contact_obstacles.c: depth at rest and worst, over obstacles */
void Contact_MeasureRest(void);      /* contact_rest.c: drapes that come to rest */
void Contact_MeasureSheets(void);    /* contact_sheets.c: piles, folds, pieces; costs of pairs */
void Contact_MeasureMeetings(void);  /* contact_meetings.c: sheets that meet sheets: momentum, heaps */
void Contact_MeasureFolds(void);     /* contact_folds.c: pieces that fold over themselves */
void Contact_MeasureBodies(void);    /* contact_bodies.c: bodies with mass that fall on a held cloth */
void Contact_MeasureBox2d(void);     /* contact_box2d.cpp: sheets among bodies of Box2D */

#endif
