/* A frame at the end of a step: the velocities that follow from where its pose ended, and the history for the next
   step, by the formulas of kiri_frame.h. */
#ifndef KIRI_STEP_H
#define KIRI_STEP_H

#include "kiri_frame.h"

KIRI_C_BEGIN

/* `after` has the pose; velocities and history are written. */
void kiriStepEnd_Rigid(const kiriPrediction* prediction, const kiriStepping* stepping, const kiriFrameData* before,
                       kiriFrameData* after);
void kiriStepEnd_Affine(const kiriPrediction* prediction, const kiriStepping* stepping, const kiriFrameData* before,
                        kiriFrameData* after);

/* The host moves it: nothing of how it does is carried on. */
void kiriStepEnd_Held(const kiriPrediction* prediction, const kiriStepping* stepping, kiriFrameData* after);

KIRI_C_END

#endif
