/* Materials and qualities for those who have no measurements of their own. */
#include "kiri_call.h"

/* What is measured has its source; the rest (damping, and what is called assumed) is chosen for its look.

   Paper: printing paper, 110 um, 2.92 GPa (Scientific Reports 4, 6275 (2014), table 2); 80 g/m^2; Poisson's ratio
   assumed. Cotton: bending stiffness 1.4e-5 N m, as of light denim in the KES test (Journal of Textiles 2016, 4614168,
   table 5, sample B: 0.144 gf cm^2/cm); half a millimetre and 200 g/m^2 assumed. Woven cloth stretches less than a
   plate that bends as easily: Young's modulus here is the one that bends right. Rubber: natural rubber, 1.5 to 2.5 MPa,
   920 to 930 kg/m^3, nearly incompressible (Ashby, Materials Selection in Mechanical Design, appendix on property
   ranges); 1 mm assumed. Foil: aluminium, 69 GPa, 0.33, 2700 kg/m^3 (the same appendix: 68 to 82 GPa, 2500 to 2900
   kg/m^3, alloys included); 16 um, as household foil. */
static const kiriMaterial materials[KIRI_MATERIAL_COUNT] = {
    { 2.92e9f, 0.3f, 1.1e-4f, 727.0f, 1.0f, 2e-3f },
    { 1.2e6f, 0.3f, 5e-4f, 400.0f, 0.8f, 2e-2f },
    { 2e6f, 0.49f, 1e-3f, 925.0f, 0.3f, 1e-2f },
    { 6.9e10f, 0.33f, 1.6e-5f, 2700.0f, 1.0f, 1e-3f },
};

kiriResult kiriGetMaterial(int32_t preset, kiriMaterial* material)
{
    if (!kiriCall_IsWithin(preset, 0, KIRI_MATERIAL_COUNT - 1) || material == NULL) {
        return KIRI_ERROR_ARGUMENT;
    }
    *material = materials[preset];
    return KIRI_OK;
}

/* Points of the front that `make accuracy` measures (tests/sweep.h has the scenes): no setting of the strip is more
   accurate at the same cost on a grid as coarse; and none of the square by more than a hundredth of the error, with
   half as many frames along. One Newton step in each of many substeps beats many steps in few. */
static const kiriQuality qualities[KIRI_QUALITY_COUNT] = {
    { 5, 20, 1, 2 },
    { 9, 40, 1, 4 },
    { 17, 80, 1, 8 },
};

kiriResult kiriGetQuality(int32_t preset, kiriQuality* quality)
{
    if (!kiriCall_IsWithin(preset, 0, KIRI_QUALITY_COUNT - 1) || quality == NULL) {
        return KIRI_ERROR_ARGUMENT;
    }
    *quality = qualities[preset];
    return KIRI_OK;
}
