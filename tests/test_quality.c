#include "support.h"
#include "sweep.h"

/* A thousandth off is near enough here. */
static const Setting referenceSetting = { SWEEP_STRIP, 33, 1, 80, 2, 64, 0 };

static Setting settings[SWEEP_SETTINGS];
static Outcome outcomes[SWEEP_SETTINGS];
static int settingCount;

SETUP
{
    settingCount = Sweep_Settings(settings);
    bool ok = Sweep_Prepare(&referenceSetting);
    for (int i = 0; i < settingCount && ok; ++i) {
        ok = Sweep_Run(&settings[i], &outcomes[i]);
    }
    assert_true(ok);
}

static Outcome RunPreset(int32_t preset, Setting* setting)
{
    kiriQuality quality;
    Outcome outcome;
    assert_int_equal(kiriGetQuality(preset, &quality), KIRI_OK);
    *setting = Sweep_FromQuality(SWEEP_STRIP, &quality);
    assert_true(Sweep_Run(setting, &outcome));
    return outcome;
}

TEST(ReferenceIsConverged)
{
    Setting half = referenceSetting;
    Outcome outcome;
    half.substeps /= 2;
    assert_true(Sweep_Run(&half, &outcome));
    assert_true(outcome.error > 0.0 && outcome.error < 0.001);
}

TEST(NoPresetIsDominated)
{
    for (int32_t p = 0; p < KIRI_QUALITY_COUNT; ++p) {
        Setting setting;
        Outcome outcome = RunPreset(p, &setting);
        int better = Sweep_Dominating(settings, outcomes, settingCount, &setting, &outcome);
        if (better >= 0) {
            const Setting* s = &settings[better];
            fail_msg("preset %d: error %g at %g; %d frames, grid %d, %d iterations, %d substeps: %g at %g", p,
                     outcome.error, outcome.cost, s->columns, s->gridResolution, s->iterations, s->substeps,
                     outcomes[better].error, outcomes[better].cost);
        }
    }
}

/* And most settings are: the test above can fail. */
TEST(MostAreDominated)
{
    int dominated = 0;
    for (int i = 0; i < settingCount; ++i) {
        dominated += Sweep_Dominating(settings, outcomes, settingCount, &settings[i], &outcomes[i]) >= 0 ? 1 : 0;
    }
    assert_true(2 * dominated > settingCount);
}

/* What kiri.h says of them: at most so much, on other grids and with frames moved too; and no idle boast. */
static const double documented[KIRI_QUALITY_COUNT] = { 0.02, 0.008, 0.004 };

static void CheckErrors(int32_t preset, const double error[2])
{
    if (!(error[0] > 0.25 * documented[preset] && error[1] < documented[preset])) {
        fail_msg("preset %d: %.4f to %.4f, not up to %.3f", (int)preset, error[0], error[1], documented[preset]);
    }
}

TEST(ErrorsAreAsDocumented)
{
    for (int32_t p = 0; p < KIRI_QUALITY_COUNT; ++p) {
        kiriQuality quality;
        double error[2];
        assert_int_equal(kiriGetQuality(p, &quality), KIRI_OK);
        Setting setting = Sweep_FromQuality(SWEEP_STRIP, &quality);
        assert_true(Sweep_Range(&setting, error));
        CheckErrors(p, error);
    }
}

/* The most accurate one is as fine as the reference here, and left to `make trade`. */
TEST(ErrorsInTwoDimensions)
{
    static const Setting fine = { SWEEP_SQUARE, 9, 9, 60, 1, 16, 0 };
    assert_true(Sweep_Prepare(&fine));
    for (int32_t p = 0; p < KIRI_QUALITY_ACCURATE; ++p) {
        kiriQuality quality;
        Outcome outcome;
        assert_int_equal(kiriGetQuality(p, &quality), KIRI_OK);
        Setting setting = Sweep_FromQuality(SWEEP_SQUARE, &quality);
        assert_true(setting.columns == setting.rows && Sweep_Run(&setting, &outcome));
        const double error[2] = { outcome.error, outcome.error };
        CheckErrors(p, error);
    }
}

TEST(ErrorFallsAndCostGrows)
{
    Setting setting;
    Outcome before = RunPreset(0, &setting);
    for (int32_t p = 1; p < KIRI_QUALITY_COUNT; ++p) {
        Outcome outcome = RunPreset(p, &setting);
        assert_true(outcome.error < 0.5 * before.error && outcome.cost > before.cost);
        before = outcome;
    }
}
